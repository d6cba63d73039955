"""Checks of claims of the paper's sections 1 to 3: model, map, energy, bounds and figures."""

import json
import math
from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from paper.values import BALL, FIGURES
from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.ensemble import ImpactMap
from pseudorigid.dynamics.variables import states_of

from ..analyses.clusters import STRAIN
from ..analyses.sea import ratio
from ..analyses.strains import least_flight_strain
from ..analyses.stretches import stretches
from .lookup import bounds_of, derived, enclosed, formula, numbers_of, regular_share
from .outcomes import CORRECTED, FALSE, HOLDS, PROVED, Outcome, Series, outcome_of

APPRECIABLE = 0.1  # share of the energy
FLIGHT_ERROR = 1e-13  # of a position after a flight that is computed twice
PARAMETER_ROUNDING = 1e-12  # of k and g, which are computed from decimals
DENSITY_RATIO = 5.0  # Young's modulus over rho g R, for which claims.toml gives an example
ENERGY_ROUNDING = 1e-13  # of an energy, over an orbit
DISTANCES = (1e-3, 1e-5, 1e-7)  # from the jump curve, at which the derivative is given
POINTS_TOLERANCE = 0.05  # relative, of the paper's approximate numbers of points


def strain_energy(clusters: xr.Dataset, spread: xr.Dataset) -> Outcome:
    """Compare the mean share of strain energy over the sea with zero and its standard error."""
    strain, kinetic = (clusters[f"{name}_energy"].values for name in ("strain", "kinetic"))
    time = clusters["time"].values
    mean, error = ratio(strain * time, (strain + kinetic) * time)
    exponent = stretches(spread, int(spread.attrs["block_impacts"])).mean()
    large = mean - 3 * error > APPRECIABLE and exponent > 0.0
    return outcome_of(large, mean=mean, exponent=exponent, standard_error=error)


def homogeneous(algebra: xr.Dataset, orbits: xr.Dataset) -> Outcome:
    """Compare the k of Figure 2 with that of a homogeneous ball."""
    solid = numbers_of(algebra)["euler_tensor"]
    used = abs(orbits.attrs["k"] - solid) < PARAMETER_ROUNDING
    word = CORRECTED if used and formula(algebra, "euler_tensor")[1] else FALSE
    return Outcome(word, {"solid": solid})


def flights_after_impacts(algebra: xr.Dataset, orbits: xr.Dataset) -> Outcome:
    """Follow post-impact states by (26), beside the algebra of (25), its own inverse."""
    k, g = (float(orbits.attrs[name]) for name in ("k", "g"))
    x, v, w = states_of(orbits)
    b, c = ((1 - k) * v - 2 * k * w) / (1 + k), -(2 * v + (1 - k) * w) / (1 + k)
    inside = np.ones(x.size, bool)
    inside[np.cumsum(orbits["row_size"].values) - 1] = False  # an orbit's last impact
    t, follows = orbits["tau"].values[1:][inside[:-1]], x[1:][inside[:-1]]
    x, b, c = (values[inside] for values in (x, b, c))
    position, strain = x + b * t + 0.5 * g * t * t, c * np.sin(t) - x * np.cos(t)
    error = max(np.abs(position - follows).max(), np.abs(strain + follows).max())
    holds = error < FLIGHT_ERROR and (b + c).max() <= 0.0
    holds = holds and formula(algebra, "jump_conditions", "one_form")[0]
    return outcome_of(holds, True, count=t.size, error=error)


def parameters(algebra: xr.Dataset, orbits: xr.Dataset) -> Outcome:
    """Compare the parameters of Figure 2 with the paper's, and relate them to a material."""
    numbers = numbers_of(algebra)
    ratio, solid = numbers["softness"], numbers["euler_tensor"]
    energy, k, g = (float(orbits.attrs[name]) for name in ("energy", "k", "g"))
    same = (energy, g) == (FIGURES["fig2"]["energy"], BALL["g"])
    same = same and abs(k - BALL["k"]) < PARAMETER_ROUNDING and abs(k - solid) < PARAMETER_ROUNDING
    holds = same and formula(algebra, "softness")[0]
    example = abs(ratio - DENSITY_RATIO) < 1e-9
    return outcome_of(holds, energy=energy, k=k, g=g, ratio=ratio, example=bool(example))


def diffeomorphism(algebra: xr.Dataset, jumps: xr.Dataset, proved: Mapping[str, bool]) -> Outcome:
    """Measure the curve along which the map jumps at the highest energy, and how steep it is."""
    energies, lengths = jumps["energy"].values, jumps["length"].values
    if not (lengths[0] > 0.0 and formula(algebra, "smooth")[1]):
        return Outcome(HOLDS, {"energy": energies[0]}, case="smooth")
    errors = jumps["length_error"].values
    lower = np.flatnonzero((lengths > 0.0) & (energies < energies[0]))
    numbers: dict[str, Any] = {"said": all(proved.values()), "second": bool(lower.size)}
    numbers |= {"energy": energies[0], "length": lengths[0], "length_error": errors[0]}
    if lower.size:
        row = lower[np.argmax(energies[lower])]
        numbers |= {"second_length": lengths[row], "second_error": errors[row]}
        numbers["second_energy"] = energies[row]
    near = jumps.sel(distance=list(DISTANCES), method="nearest")
    h, touched, missed = (
        near[name].values for name in ("distance", "derivative_touched", "derivative_missed")
    )
    power = np.log(touched[-1] / touched[-2]) / np.log(h[-1] / h[-2])
    numbers |= {"touched": Series(touched), "distances": Series(h), "missed": missed[-1]}
    threshold = numbers_of(algebra)["smooth"]
    return outcome_of(False, **numbers, power=power, threshold=threshold)


def energy_surface(algebra: xr.Dataset, clusters: xr.Dataset) -> Outcome:
    """Compare the errors in energy of the sea with rounding, beside the algebra."""
    error = clusters["energy_error"].values.max()
    small = error < ENERGY_ROUNDING
    kept = formula(algebra, "conserved_energy", "jump_conditions")[0] and small
    return outcome_of(kept, True, bound=bool(small), rounding=ENERGY_ROUNDING, error=error)


def contact_speeds(*portraits: xr.Dataset) -> Outcome:
    """Find the least contact speed of the orbits of two portraits."""
    speeds = np.concatenate([portrait["xdot"] + portrait["udot"] for portrait in portraits])
    return outcome_of(speeds.min() >= 0.0, least=speeds.min(), count=speeds.size)


def least_strain(algebra: xr.Dataset, clusters: xr.Dataset) -> Outcome:
    """Find the least strain of the sea, beside the bound that algebra gives."""
    least = clusters["least_strain"].values.min()
    return outcome_of(formula(algebra, "bound_in_flight")[0] and least > -1.0, True, least=least)


def infinitesimal(
    one: xr.Dataset, six: xr.Dataset, fig2: xr.Dataset, fig8: xr.Dataset, clusters: xr.Dataset
) -> Outcome:
    """Find the least strain of the figures, and the g below which their twins have small strain."""
    least = [float(motion["strain"].min()) for motion in (one, six)]
    least += [least_flight_strain(orbits.attrs["k"], orbits) for orbits in (fig2, fig8)]
    numbers: dict[str, Any] = {"least": Series(least), "strain": STRAIN}
    numbers |= {"compression": clusters["compression"].values.mean()}
    numbers |= {"percent": 100.0 * clusters["strained"].values.mean()}
    for name, orbits, strain in zip(("2", "8"), (fig2, fig8), least[2:], strict=True):
        g = orbits.attrs["g"]
        limit = _rounded_down(STRAIN * g / -strain)
        numbers |= {f"g{name}": limit, f"g{name}_tenth": 0.1 * limit}
        numbers[f"scaled{name}"] = orbits.attrs["energy"] / (g * g)
    small = min(least) > -STRAIN
    return Outcome(HOLDS, numbers, case="small") if small else Outcome(CORRECTED, numbers)


def _rounded_down(number: float) -> float:
    """Return a positive number with three digits, not above it."""
    unit = 10.0 ** (math.floor(math.log10(number)) - 2)
    return math.floor(number / unit) * unit


def bisection(lyapunov: xr.Dataset) -> Outcome:
    """Count the impacts that scan and bisection miss, and find the least contact speed."""
    missed, impacts = (int(lyapunov.attrs[name]) for name in ("impacts_missed", "impacts"))
    method = json.loads(lyapunov.attrs["config"])["method"]
    k, g, energy = (float(lyapunov.attrs[name]) for name in ("k", "g", "energy"))
    ball = Ball(k, g, map=ImpactMap((method["scan"], method["tolerance"])))
    starts = lyapunov["start"].values
    out = ball.history(ball.start(starts, energy), impacts // starts.size)
    least = (out[..., 1] + out[..., 2]).min()
    word = FALSE if least < 0.0 else CORRECTED if missed else HOLDS
    numbers = {"missed": missed, "impacts": impacts, "least": least, "step": method["scan"]}
    return Outcome(word, numbers)


def figure_2(orbits: xr.Dataset) -> Outcome:
    """Count the starts and points of Figure 2."""
    return _portrait(orbits, "fig2")


def figure_8(orbits: xr.Dataset, line: xr.Dataset, proved: Mapping[str, bool]) -> Outcome:
    """Count the starts and points of Figure 8, and read the regular share at its energy."""
    verdict, numbers, _ = _portrait(orbits, "fig8")
    share = regular_share(line, 0, orbits.attrs["energy"] / orbits.attrs["g"] ** 2)
    orbits_proved = [n for n, known in proved.items() if known and not n.startswith("curve-")]
    periods = Series(bounds_of(name)["period"] for name in orbits_proved)
    numbers = numbers | share | {"curves": enclosed(proved)}
    numbers |= {"elliptic": bool(periods), "periods": periods}
    return outcome_of(verdict == HOLDS and share["low"] > 0.5, **numbers)


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
