"""Checks of claims of the paper's section 3 and how it computes: map, energy, bounds, figures."""

import json
from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.ensemble import ImpactMap
from pseudorigid.dynamics.paper import FIGURES

from .schema import HOLDS, PROVED, Outcome, Series, derived, formula, numbers_of, outcome_of

ROUNDING = 1e-13  # of an energy, over an orbit
DISTANCES = (1e-3, 1e-5, 1e-7)  # from the jump curve, at which the derivative is given
POINTS_TOLERANCE = 0.05  # relative, of the paper's approximate numbers of points


def diffeomorphism(algebra: xr.Dataset, jumps: xr.Dataset, proved: Mapping[str, bool]) -> Outcome:
    """Measure the curve along which the map jumps at the highest energy, and how steep it is."""
    energies, lengths = jumps["energy"].values, jumps["length"].values
    errors = jumps["length_error"].values
    if not (lengths[0] > 0.0 and formula(algebra, "smooth")[1]):
        return Outcome(HOLDS, {"energy": energies[0]}, case="smooth")
    numbers = {
        "said": all(proved.values()),
        "energy": energies[0],
        "length": lengths[0],
        "length_error": errors[0],
        "threshold": numbers_of(algebra)["smooth"],
    }
    lower = np.flatnonzero((lengths > 0.0) & (energies < energies[0]))
    numbers["second"] = bool(lower.size)
    if lower.size:
        row = int(lower[np.argmax(energies[lower])])
        numbers |= {"second_length": lengths[row], "second_error": errors[row]}
        numbers |= {"second_energy": energies[row]}
    return outcome_of(False, **numbers, **_steepness(jumps))


def _steepness(jumps: xr.Dataset) -> dict[str, Any]:
    """Return the numbers that say how the largest derivative grows towards the jump curve."""
    h = jumps["distance"].values
    touched, missed = (jumps[f"derivative_{side}"].values for side in ("touched", "missed"))
    rows = [int(np.argmin(np.abs(h - distance))) for distance in DISTANCES]
    power = np.log(touched[rows[-1]] / touched[rows[-2]]) / np.log(h[rows[-1]] / h[rows[-2]])
    return {
        "touched": Series(touched[rows]),
        "distances": Series(h[rows]),
        "power": power,
        "missed": missed[rows[-1]],
    }


def energy_surface(algebra: xr.Dataset, clusters: xr.Dataset) -> Outcome:
    """Compare the errors in energy of the sea with rounding, beside the algebra."""
    error = float(clusters["energy_error"].max())
    small = error < ROUNDING
    kept = formula(algebra, "conserved_energy", "jump_conditions")[0] and small
    return outcome_of(kept, True, bound=small, rounding=ROUNDING, error=error)


def half_of_it(*portraits: xr.Dataset) -> Outcome:
    """Find the least contact speed of the orbits of two portraits."""
    speeds = [portrait["xdot"].values + portrait["udot"].values for portrait in portraits]
    least = min(float(speed.min()) for speed in speeds)
    return outcome_of(least >= 0.0, least=least, count=sum(speed.size for speed in speeds))


def never_inside_out(algebra: xr.Dataset, clusters: xr.Dataset) -> Outcome:
    """Find the least strain of the sea, beside the bound that algebra gives."""
    least = float(clusters["least_strain"].min())
    bounded = formula(algebra, "bound_in_flight")[0] and least > -1.0
    return outcome_of(bounded, True, least=least)


def bisection(lyapunov: xr.Dataset) -> Outcome:
    """Count the impacts that scan and bisection miss, and find the least contact speed."""
    missed, impacts = (int(lyapunov.attrs[name]) for name in ("impacts_missed", "impacts"))
    method = json.loads(lyapunov.attrs["config"])["method"]
    least = _least_contact_speed(lyapunov, method, impacts)
    holds = missed == 0 and least >= 0.0
    return outcome_of(holds, missed=missed, impacts=impacts, least=least, step=method["scan"])


def _least_contact_speed(lyapunov: xr.Dataset, method: dict[str, float], impacts: int) -> float:
    """Return the least contact speed of the orbits of Figure 7, by a method with a scan."""
    k, g, energy = (float(lyapunov.attrs[name]) for name in ("k", "g", "energy"))
    ball = Ball(k, g, map=ImpactMap((method["scan"], method["tolerance"])))
    starts = lyapunov["start"].values
    out = np.empty((starts.size, impacts // starts.size, 4))
    x, v, w = ball.start(starts, energy)
    ball.map.history(x, v, w, k, g, out)
    return float((out[..., 1] + out[..., 2]).min())


def figure_2(orbits: xr.Dataset) -> Outcome:
    """Count the starts and points of Figure 2."""
    return _portrait(orbits, "fig2")


def figure_8(orbits: xr.Dataset, line: xr.Dataset) -> Outcome:
    """Count the starts and points of Figure 8, and read the regular share at its energy."""
    counted = _portrait(orbits, "fig8")
    energy, g = (float(orbits.attrs[name]) for name in ("energy", "g"))
    row = int(np.argmin(np.abs(line["energy"].values - energy / g**2)))
    share, low, high = (
        float(line[f"regular{end}"].values[0, row]) for end in ("", "_low", "_high")
    )
    holds = counted.verdict == HOLDS and low > 0.5
    return outcome_of(holds, share=share, low=low, high=high, **counted.numbers)


def _portrait(orbits: xr.Dataset, figure: str) -> Outcome:
    """Compare a portrait's numbers of starts and points with the paper's."""
    paper = FIGURES[figure]
    starts, points = orbits.sizes["orbit"], int(orbits["row_size"].sum())
    close = abs(points - paper["points"]) < POINTS_TOLERANCE * paper["points"]
    return outcome_of(starts == paper["starts"] and close, starts=starts, points=points)


def jacobian(algebra: xr.Dataset) -> Outcome:
    """Look up the formula of the Jacobian, which was compared at some states and not proved."""
    word, numbers, _ = derived(algebra, "jacobian")
    return Outcome(HOLDS if word == PROVED else word, numbers)


def third_exponent(algebra: xr.Dataset, spread: xr.Dataset) -> Outcome:
    """Find the largest middle exponent, beside the algebra of the energy."""
    middle = float(np.abs(spread["exponent"].values[:, :, 1].mean(axis=0)).max())
    impacts = int(spread.attrs["block_impacts"]) * spread.sizes["block"]
    kept = formula(algebra, "conserved_energy", "jump_conditions")[0]
    return outcome_of(kept and middle < 100.0 / impacts, middle=middle, impacts=impacts)
