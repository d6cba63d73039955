"""Proofs that each impact of an orbit or a picture is the first one, with bounds on its error."""

from collections.abc import Callable

import numpy as np
import xarray as xr

from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.orbits import start_state
from pseudorigid.dynamics.variables import states_of
from study.enclosure.surface import Exact
from study.reference_solver import impact_errors

from .statements import Result

_LARGEST_ERROR = 1e-6  # a larger one is no rounding error: another impact was taken

Impacts = tuple[np.ndarray, np.ndarray, np.ndarray]


def prove_impacts(
    k: Exact,
    g: Exact,
    *impacts: np.ndarray,
    name: str = "impacts",
    progress: Callable[[int], None] | None = None,
) -> Result:
    """Prove that each of many impacts is the first one; arguments as for `impact_errors`.

    The impacts are `before`, `after` and `tau`. The Result has the margin worst error.
    """
    errors = impact_errors(k, g, *impacts, progress=progress)
    worst, reason = float(np.max(errors, initial=0.0)), ""
    if not errors.size:
        reason = "there are no impacts"
    elif worst == np.inf:
        reason = f"impact {np.argmax(errors)} grazes: which one is first is not decided"
    elif not worst < _LARGEST_ERROR:
        reason = f"impact {np.argmax(errors)} is off by {worst:.3g}: not the first one"
    statement = (
        f"each of {errors.size:,} impacts computed is the first one, to within {_LARGEST_ERROR:g}"
    )
    return Result(name, statement, name, reason, {}, {"worst error": worst})


def of_orbits(ball: Ball, energy: float, orbits: xr.Dataset, starts: list) -> Impacts:
    """Return `before`, `after` and `tau` of all impacts of a dataset of `scene_orbits`.

    The starts are in the form that `starts.start_state` takes.
    """
    state = states_of(orbits)
    before = np.roll(state, 1, axis=1)
    sizes = orbits["row_size"].values
    first = np.cumsum(sizes) - sizes
    before[:, first] = np.array([start_state(ball, energy, start) for start in starts]).T
    return before, state, orbits["tau"].values


def of_periodic(orbit: xr.Dataset) -> Impacts:
    """Return `before`, `after` and `tau` of the impacts of one orbit of `symmetric_orbits`."""
    state = states_of(orbit)
    return state, np.roll(state, -1, axis=1), orbit["tau"].values


def of_states(ball: Ball, states: np.ndarray) -> Impacts:
    """Compute the next impacts of states x, xdot, udot, (3, n): `before`, `after` and `tau`."""
    *after, tau = ball.impact(*states)
    return states, np.array(after), tau
