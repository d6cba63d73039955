"""Every impact drawn: that each computed impact is the first one, and how far it is off."""

import time

import numpy as np

from ...dynamics.starts import start_state
from ...dynamics.variables import states_of
from ..reference_solver import impact_errors
from .statements import Result

LIMIT = 1e-6  # an error beyond this is no rounding: another impact was taken


def prove_impacts(k, g, before, after, tau, name="impacts"):
    """Prove that each of many impacts is the first one.

    Parameters
    ----------
    k, g : int, Fraction, Decimal or str
        The ball, exact.
    before, after : ndarray, shape (3, n)
        As for `reference_solver.impact_errors`.
    tau : ndarray, shape (n,)
        As for `reference_solver.impact_errors`.
    name : str
        Of the result.

    Returns
    -------
    Result
        margins: worst error.
    """
    begin = time.perf_counter()
    errors = impact_errors(k, g, before, after, tau)
    worst, reason = float(np.max(errors, initial=0.0)), ""
    if not errors.size:
        reason = "there are no impacts"
    elif worst == np.inf:
        reason = f"impact {np.argmax(errors)} grazes: which one is first is not decided"
    elif not worst < LIMIT:
        reason = f"impact {np.argmax(errors)} is off by {worst:.3g}: not the first one"
    statement = f"each of {errors.size:,} impacts computed is the first one, to within {LIMIT:g}"
    seconds = time.perf_counter() - begin
    return Result(name, statement, name, reason, {}, {"worst error": worst}, seconds)


def of_orbits(ball, energy, orbits, starts):
    """All impacts of a scene's orbits.

    Parameters
    ----------
    ball : Ball
    energy : float
        In m omega^2 R^2.
    orbits : xarray.Dataset
        As from `scene_orbits`.
    starts : list
        Of the orbits, each as in `starts.start_state`.

    Returns
    -------
    before, after : ndarray, shape (3, n)
        x, xdot, udot just before an impact and just before the next one.
    tau : ndarray, shape (n,)
        The flights' times (1/omega).
    """
    state = states_of(orbits)
    before = np.roll(state, 1, axis=1)
    sizes = orbits["row_size"].values
    first = np.cumsum(sizes) - sizes
    before[:, first] = np.array([start_state(ball, energy, start) for start in starts]).T
    return before, state, orbits["tau"].values


def of_periodic(orbit):
    """The impacts of one periodic orbit.

    Parameters
    ----------
    orbit : xarray.Dataset
        One of `symmetric_orbits`.

    Returns
    -------
    before, after, tau : ndarray
        As from `of_orbits`.
    """
    state = states_of(orbit)
    return state, np.roll(state, -1, axis=1), orbit["tau"].values


def of_states(ball, states):
    """The next impacts of states, computed here.

    Parameters
    ----------
    ball : Ball
    states : ndarray, shape (3, n)
        x, xdot, udot just before an impact.

    Returns
    -------
    before, after, tau : ndarray
        As from `of_orbits`.
    """
    *after, tau = ball.impact(*states)
    return states, np.array(after), tau
