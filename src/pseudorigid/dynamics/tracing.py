"""Polyline of a branch, as fine and as long as requested.

Where two neighbours are too far apart or the line bends too much, a point is inserted at the mean
of their parameters u.
"""

import math

import numpy as np

from ..kernel.arithmetic import sincos
from .branch import POINTS_OF_IMAGE, Branch

Window = tuple[float, float, float, float]  # x_low, x_high, xdot_low, xdot_high

# Length of a side, as a share of the largest one, below which its bend is ignored. Without this
# limit a corner of the line would be refined for ever.
FINEST = 1e-3
# Largest side outside a window, in section radii, as for the paper's whole branches.
COARSE = 0.01
MOST_VERTICES = 3_000_000


def trace(
    branch: Branch, length: float, distance: float, bend: float, window: Window | None
) -> np.ndarray:
    """Return the polyline (3, n) of a branch, image by image until it is long enough.

    The arguments are those of `manifolds.trace_manifold`. The branch's `ended` is set if it ends
    before. Raises ValueError for too many points or images.
    """
    straight = sincos(bend * (math.pi / 180.0))[1]
    u, states, travelled = np.empty(0), np.empty((3, 0)), np.zeros(1)
    for image in range(branch.images):
        if branch.weak and not branch.is_accurate(image, u, states):
            branch.ended = float(travelled[-1])
            break
        new_u = image + np.arange(POINTS_OF_IMAGE) / POINTS_OF_IMAGE
        states = np.append(states, branch.next(new_u, u, states), axis=1)
        u = np.append(u, new_u)
        while (coarse := _too_coarse(branch, u, states, distance, straight, window)).any():
            at = np.flatnonzero(coarse) + 1
            middle = (0.5 * (u[:-1] + u[1:]))[coarse]
            new_states = branch.next(middle, u, states)
            u, states = np.insert(u, at, middle), np.insert(states, at, new_states, axis=1)
            if u.size > MOST_VERTICES:
                raise ValueError(
                    f"a manifold of more than {MOST_VERTICES} points: make length shorter"
                )
        sides = _sides(states) / branch.radius
        jumps = _is_jump(u) & (sides > 1e-6)
        travelled = np.cumsum(np.where(jumps, 0.0, sides))
        if travelled[-1] >= length:
            break
    else:
        raise ValueError(
            f"a manifold is {travelled[-1]:.3g} section radii long after {branch.images} images, "
            f"with a multiplier of {branch.multiplier:.6g}: make length shorter"
        )
    last = int(np.searchsorted(travelled, length)) + 1
    states = np.concatenate([branch.base(), states[:, : last + 1]], axis=1)
    keep = np.append(True, ~jumps[:last])
    if window is not None:
        keep &= _meets(states, window, 0.0)
    return _pieces(states, keep)


def _sides(vertices: np.ndarray) -> np.ndarray:
    """Return the lengths of the sides of a polyline."""
    steps = np.diff(vertices, axis=1)
    return np.sqrt(np.sum(steps * steps, axis=0))


def _is_jump(u: np.ndarray) -> np.ndarray:
    """Return where u cannot be halved further, so that a remaining gap is a jump of the map."""
    middle = 0.5 * (u[:-1] + u[1:])
    return (u[1:] - u[:-1] < 2.0**-40) | (middle == u[:-1]) | (middle == u[1:])


def _too_coarse(
    branch: Branch,
    u: np.ndarray,
    states: np.ndarray,
    distance: float,
    straight: float,
    window: Window | None,
) -> np.ndarray:
    """Return which sides of the polyline need a point in their middle."""
    if window is None:
        drawn, inside = states / branch.radius, np.ones(u.size - 1, bool)
        coarse = ~inside
    else:
        sizes = np.array([window[1] - window[0], window[3] - window[2]])
        drawn = states[:2] / sizes[:, None]
        inside = _meets(states, window, 1.0)
        coarse = _sides(states) > COARSE * branch.radius
    step, sides = np.diff(drawn, axis=1), _sides(drawn)
    cosine = np.sum(step[:, 1:] * step[:, :-1], axis=0)
    bends = cosine < straight * sides[1:] * sides[:-1]
    bends &= np.maximum(sides[1:], sides[:-1]) > FINEST * distance
    # Halve the longer of the two sides of a bend, or both if their lengths are similar.
    fine = sides > distance
    fine[:-1] |= bends & (sides[:-1] >= 0.5 * sides[1:])
    fine[1:] |= bends & (sides[1:] >= 0.5 * sides[:-1])
    return ((fine & inside) | coarse) & ~_is_jump(u)


def _meets(states: np.ndarray, window: Window, margin: float) -> np.ndarray:
    """Return whether a side's box, widened by `margin` times its longer edge, meets the window."""
    low = np.minimum(states[:2, 1:], states[:2, :-1])
    high = np.maximum(states[:2, 1:], states[:2, :-1])
    widen = margin * np.max(high - low, axis=0)
    least, most = np.reshape(window, (2, 2, 1)).swapaxes(0, 1)
    return np.all((low - widen <= most) & (high + widen >= least), axis=0)


def _pieces(states: np.ndarray, keep: np.ndarray) -> np.ndarray:
    """Return the vertices of the sides to keep, with a row of NaN between separate pieces."""
    ends = np.concatenate([[False], keep]) | np.concatenate([keep, [False]])
    gap = ends[:-1] & ends[1:] & ~keep  # a single dropped side separates two pieces
    (rows,) = np.nonzero(ends)
    breaks = np.nonzero((np.diff(rows) > 1) | gap[rows[:-1]])[0] + 1
    return np.insert(states[:, rows], breaks, np.nan, axis=1)
