"""Every impact drawn: that each computed impact is the first one, and how far it is off."""

import time

import numpy as np

from ...dynamics.starts import start_state
from ..judge import impact_errors
from .statements import Result

LIMIT = 1e-6  # an error beyond this is no rounding: another impact was taken


def prove_impacts(k, g, before, after, tau, name="impacts"):
    """The Result for impacts computed in doubles; arguments as for `judge.impact_errors`."""
    begin = time.perf_counter()
    errors = impact_errors(k, g, before, after, tau)
    return impact_result(errors, name, time.perf_counter() - begin)


def impact_result(errors, name, seconds):
    """The Result from the errors of impacts, perhaps of several calls, and their seconds."""
    worst = float(np.max(errors, initial=0.0))
    reason = ""
    if not worst < LIMIT:
        place = int(np.argmax(errors))
        reason = (
            f"impact {place} is off by {worst:.3g}: not the first one"
            if worst < np.inf
            else f"impact {place} grazes: which one is first is not decided"
        )
    statement = f"each of {errors.size:,} impacts computed is the first one"
    verdict = "not proved" if reason else "proved"
    margins = {"worst error": worst}
    return Result(name, statement, name, verdict, reason, {}, margins, seconds)


def of_orbits(ball, energy, orbits, starts):
    """(before, after, tau) of all impacts of a scene's orbits, as `scene_orbits` makes them."""
    state = np.array([orbits[name].values for name in ("x", "xdot", "udot")])
    before = np.roll(state, 1, axis=1)
    sizes = orbits["row_size"].values
    first = np.cumsum(sizes) - sizes
    before[:, first] = np.array([start_state(ball, energy, start) for start in starts]).T
    return before, state, orbits["tau"].values


def of_periodic(orbit):
    """The same of one periodic orbit, as from `symmetric_orbits`."""
    state = np.array([orbit[name].values for name in ("x", "xdot", "udot")])
    return state, np.roll(state, -1, axis=1), orbit["tau"].values


def of_states(ball, states):
    """The same of states (3, n), whose next impacts are computed here."""
    *after, tau = ball.impact(*states)
    return states, np.array(after), tau
