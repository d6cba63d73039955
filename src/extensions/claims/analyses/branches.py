"""How much branches of manifolds stretch and turn, and traces of the map by differences."""

import numpy as np

from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.variables import chart


def branch_stretching(ball: Ball, states: np.ndarray, impacts: int) -> float:
    """Return the length of a branch's image after some impacts, in lengths of the branch."""
    steps = np.diff(states, axis=1)
    # The tangent map adds no length where the map jumps.
    x, v, w = states[:, :-1]
    matrices = ball.jacobian(x, v, w, impacts=impacts)
    images = (matrices * steps.T[:, None, :]).sum(axis=2).T
    before, after = (np.hypot(*chart(ball.k, *vectors)) for vectors in (steps, images))
    return float(np.nansum(after) / np.nansum(before))


def half_turns(k: float, states: np.ndarray) -> float:
    """Return by how many half turns the direction of a branch in (x, y) changes in all."""
    x, y = np.diff(chart(k, *states), axis=1)
    direction = x + 1j * y
    return float(np.nansum(np.abs(np.angle(direction[1:] / direction[:-1]))) / np.pi)


def trace_by_differences(ball: Ball, point: np.ndarray, step: float, period: int) -> float:
    """Return the trace of the map's iterate on the energy surface by forward differences."""
    states = np.concatenate([point[:, None], point[:, None] + step * np.eye(3)], axis=1)
    after = ball.after(states, period)[:3]
    return sum(float(row[i + 1] - row[0]) for i, row in enumerate(after)) / step - 1.0
