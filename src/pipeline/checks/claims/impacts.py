"""Checks of claims of the paper's section 3 and how it computes: map, energy, bounds, figures."""

import json

import numpy as np

from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.ensemble import ImpactMap

from .schema import HOLDS, PROVED, derived, formula, numbers_of, verdict_of

ROUNDING = 1e-13  # of an energy, over an orbit
SHOWN = (1e-3, 1e-5, 1e-7)  # distances from the jump curve


def diffeomorphism(algebra, jumps, proved):
    """Measure the curve along which the map jumps at the highest energy, and how steep it is."""
    energy, length = float(jumps["energy"].values[0]), float(jumps["length"].values[0])
    if not (length > 0.0 and formula(algebra, "smooth")[1]):
        return HOLDS, f"no jump at E = {energy:g}", ""
    return verdict_of(
        False,
        said="proved" if all(proved.values()) else "computed",
        energy=energy,
        length=length,
        length_error=float(jumps["length_error"].values[0]),
        second=_second_length(jumps),
        threshold=numbers_of(algebra)["smooth"],
        **_steepness(jumps),
    )


def _steepness(jumps):
    """Return the numbers that say how the largest derivative grows towards the jump curve."""
    h = jumps["distance"].values
    touched, missed = (jumps[f"derivative_{side}"].values for side in ("touched", "missed"))
    rows = [int(np.argmin(np.abs(h - at))) for at in SHOWN]
    power = np.log(touched[rows[-1]] / touched[rows[-2]]) / np.log(h[rows[-1]] / h[rows[-2]])
    return {
        "touched": ", ".join(f"{touched[row]:.3g}" for row in rows),
        "distances": ", ".join(f"{h[row]:g}" for row in rows),
        "power": power,
        "missed": missed[rows[-1]],
    }


def _second_length(jumps):
    """Length and error of the curve at the energy next below the first that has one, as text."""
    energy, length = jumps["energy"].values, jumps["length"].values
    below = np.flatnonzero((length > 0.0) & (energy < energy[0]))
    if not below.size:
        return ""
    row = int(below[np.argmax(energy[below])])
    error = float(jumps["length_error"].values[row])
    return f", {length[row]:.12f} (to {error:.0e}) at E = {energy[row]:g}"


def energy_surface(algebra, sea):
    """Compare the errors in energy of the sea with rounding, beside the algebra."""
    error = float(sea["energy_error"].max())
    kept = formula(algebra, "conserved_energy", "jump_conditions")[0] and error < ROUNDING
    bound = f"below {ROUNDING:.0e}" if error < ROUNDING else f"{error:.1e}"
    return verdict_of(kept, proved=True, bound=bound)


def half_of_it(*portraits):
    """Find the least contact speed of the orbits of two portraits."""
    speeds = [portrait["xdot"].values + portrait["udot"].values for portrait in portraits]
    least = min(float(speed.min()) for speed in speeds)
    return verdict_of(least >= 0.0, least=least, count=sum(speed.size for speed in speeds))


def never_inside_out(algebra, sea):
    """Find the least strain of the sea, beside the bound that algebra gives."""
    least = float(sea["least_strain"].min())
    bounded = formula(algebra, "bound_in_flight")[0] and least > -1.0
    return verdict_of(bounded, proved=True, least=least)


def bisection(lyapunov):
    """Count the impacts that scan and bisection miss, and find the least contact speed."""
    missed, impacts = (int(lyapunov.attrs[name]) for name in ("impacts_missed", "impacts"))
    method = json.loads(lyapunov.attrs["config"])["method"]
    least = _least_contact_speed(lyapunov, method, impacts)
    holds = missed == 0 and least >= 0.0
    return verdict_of(holds, missed=missed, impacts=impacts, least=least, step=method["scan"])


def _least_contact_speed(lyapunov, method, impacts):
    """The least contact speed of the orbits of a dataset of exponents, with a method's impacts."""
    k, g, energy = (float(lyapunov.attrs[name]) for name in ("k", "g", "energy"))
    ball = Ball(k, g, map=ImpactMap((method["scan"], method["tolerance"])))
    starts = lyapunov["start"].values
    out = np.empty((starts.size, impacts // starts.size, 4))
    ball.map.history(*ball.start(starts, energy), k, g, out)
    return float((out[..., 1] + out[..., 2]).min())


def figure_2(orbits):
    """Count the starts and points of Figure 2."""
    return _portrait(orbits, 8, 45_000)


def figure_8(orbits, line):
    """Count the starts and points of Figure 8, and read the regular share at its energy."""
    word, drawn = _portrait(orbits, 6, 35_000)
    energy, g = (float(orbits.attrs[name]) for name in ("energy", "g"))
    row = int(np.argmin(np.abs(line["energy"].values - energy / g**2)))
    share, low, high = (
        float(line[f"regular{end}"].values[0, row]) for end in ("", "_low", "_high")
    )
    return verdict_of(word == HOLDS and low > 0.5, share=share, low=low, high=high, **drawn)


def jacobian(algebra):
    """Look up the formula of the Jacobian, which was compared at some states and not proved."""
    word, numbers = derived(algebra, "jacobian")
    return HOLDS if word == PROVED else word, numbers


def third_exponent(algebra, found):
    """Find the largest middle exponent, beside the algebra of the energy."""
    middle = float(np.abs(found["exponent"].values[:, :, 1].mean(axis=0)).max())
    impacts = int(found.attrs["block_impacts"]) * found.sizes["block"]
    kept = formula(algebra, "conserved_energy", "jump_conditions")[0]
    return verdict_of(kept and middle < 100.0 / impacts, middle=middle, impacts=impacts)


def _portrait(orbits, starts, points):
    """Compare a portrait's numbers of starts and points with the paper's, the latter to 5 %."""
    found, total = orbits.sizes["orbit"], int(orbits["row_size"].sum())
    as_said = found == starts and abs(total - points) < 0.05 * points
    return verdict_of(as_said, starts=found, points=total)
