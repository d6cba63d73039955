"""A branch as a polyline: as fine as a picture needs it, as long as it is wanted.

Where two neighbours are too far apart or the line bends too much, a point is inserted at the middle
of the branch's parameter u.
"""

import numpy as np

from ..kernel.arithmetic import sincos
from .branch import FRESH

# A bend counts while a neighbouring side is longer than this share of the distance allowed: else a
# corner of the line would be refined without end.
FINEST = 1e-3
# Outside a window the line is followed with sides of this length, in section radii: that of the
# paper's whole branches.
COARSE = 0.01
MOST_VERTICES = 3_000_000
DEGREE = float.fromhex("0x1.1df46a2529d39p-6")  # pi/180


def trace(branch, length, distance, bend, window):
    """The polyline of a branch, image by image until it is long enough.

    Parameters
    ----------
    branch : Branch
        Its `ended` is set where it ends before.
    length, distance, bend, window
        Of `manifolds.trace_manifold`.

    Returns
    -------
    ndarray, shape (3, n)

    Raises
    ------
    ValueError
        Too many points or images.
    """
    straight = sincos(bend * DEGREE)[1]
    u, states, travelled = np.empty(0), np.empty((3, 0)), np.zeros(1)
    for image in range(branch.images):
        if branch.weak and not branch.known(image, u, states):
            branch.ended = float(travelled[-1])
            break
        fresh = image + np.arange(FRESH) / FRESH
        states = np.append(states, branch.next(fresh, u, states), axis=1)
        u = np.append(u, fresh)
        while (coarse := _too_coarse(branch, u, states, distance, straight, window)).any():
            at = np.flatnonzero(coarse) + 1
            middle = (0.5 * (u[:-1] + u[1:]))[coarse]
            fresh = branch.next(middle, u, states)
            u, states = np.insert(u, at, middle), np.insert(states, at, fresh, axis=1)
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


def _sides(vertices):
    steps = np.diff(vertices, axis=1)
    return np.sqrt(np.sum(steps * steps, axis=0))


def _is_jump(u):
    """Where u cannot be halved any further: what is still apart there is a jump of the map."""
    middle = 0.5 * (u[:-1] + u[1:])
    return (u[1:] - u[:-1] < 2.0**-40) | (middle == u[:-1]) | (middle == u[1:])


def _too_coarse(branch, u, states, distance, straight, window):
    """Which sides of the polyline need a point in their middle."""
    drawn, inside, coarse = states / branch.radius, True, False
    if window is not None:
        sizes = np.array([window[1] - window[0], window[3] - window[2]])
        drawn = states[:2] / sizes[:, None]
        inside = _meets(states, window, 1.0)
        coarse = _sides(states) > COARSE * branch.radius
    step, sides = np.diff(drawn, axis=1), _sides(drawn)
    cosine = np.sum(step[:, 1:] * step[:, :-1], axis=0)
    bends = cosine < straight * sides[1:] * sides[:-1]
    bends &= np.maximum(sides[1:], sides[:-1]) > FINEST * distance
    # a bend is mended by halving the longer of its two sides, both where they are alike
    fine = sides > distance
    fine[:-1] |= bends & (sides[:-1] >= 0.5 * sides[1:])
    fine[1:] |= bends & (sides[1:] >= 0.5 * sides[:-1])
    return ((fine & inside) | coarse) & ~_is_jump(u)


def _meets(states, window, margin):
    """Whether the box around a side, widened by `margin` of its longer edge, meets the window."""
    low = np.minimum(states[:2, 1:], states[:2, :-1])
    high = np.maximum(states[:2, 1:], states[:2, :-1])
    widen = margin * np.max(high - low, axis=0)
    least, most = np.reshape(window, (2, 2, 1)).swapaxes(0, 1)
    return np.all((low - widen <= most) & (high + widen >= least), axis=0)


def _pieces(states, keep):
    """The vertices of the sides that are kept, a row of NaN between separate pieces."""
    ends = np.concatenate([[False], keep]) | np.concatenate([keep, [False]])
    gap = ends[:-1] & ends[1:] & ~keep  # two kept pieces that only a dropped side parts
    (rows,) = np.nonzero(ends)
    parted = np.nonzero((np.diff(rows) > 1) | gap[rows[:-1]])[0] + 1
    return np.insert(states[:, rows], parted, np.nan, axis=1)
