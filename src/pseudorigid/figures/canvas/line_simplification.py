"""Leave out the vertices of a line that lie on a straight piece of it.

Where two edges of a line are almost parallel, matplotlib's rasteriser joins them at the
intersection of two almost parallel lines. The last bit of a product then decides the shade of a
pixel, and that bit depends on the processor: on aarch64 the rasteriser is compiled with fused
multiply-add.
"""

import math

import numpy as np

_AHEAD = 64  # vertices between a kept one and the one in whose direction u is measured
_SAFETY = 1.0 - 1e-6  # of the tolerance; rounding errors of slopes are far smaller


def bends(across, up, tolerance):
    """Return the indices of the vertices to keep, which include both ends.

    A line through them passes the others within `tolerance`, at least 1. Coordinates are whole
    numbers.
    """
    x, y = np.asarray(across, dtype=np.int64), np.asarray(up, dtype=np.int64)
    keep, lists = [0], (x.tolist(), y.tolist())
    while keep[-1] < len(x) - 1:
        keep.append(_end_of_piece(x, y, *lists, keep[-1], tolerance))
    return keep


def _end_of_piece(x, y, xs, ys, first, tolerance):
    """Return the last vertex up to which each chord from `first` passes the vertices between.

    Most chords are known to pass without a look at all of these: let u be the coordinate in the
    direction of one chord, v the other one, in its units. A chord of slope m passes a vertex within
    the tolerance if |v - m u| is at most that, so that each vertex bounds m. The vertex lies beside
    the chord, too, if |v| < u/2, |m| < 1/2 and u + |v m| is at most the chord's u.
    """
    x0, y0, ahead = xs[first], ys[first], min(first + _AHEAD, len(xs) - 1)
    du, dv = xs[ahead] - x0, ys[ahead] - y0
    near = _SAFETY * tolerance * math.sqrt(du * du + dv * dv)
    least, most, farthest, widest = -0.5, 0.5, 0, 0
    u, v = _turned(xs, ys, first + 1, x0, y0, du, dv)
    for i in range(first + 1, len(xs) - 1):
        if 2 * abs(v) < u:
            least, most = max(least, (v - near) / u), min(most, (v + near) / u)
            farthest, widest = max(farthest, u), max(widest, abs(v))
        else:
            least = math.inf
        u, v = _turned(xs, ys, i + 1, x0, y0, du, dv)
        slope = v / u if u > 0 else math.nan
        surely = least <= slope <= most and farthest + widest * abs(slope) < u - 1
        if not (surely or _passes(x, y, first, i + 1, tolerance)):
            return i
    return len(xs) - 1


def _turned(xs, ys, i, x0, y0, du, dv):
    """Return u and v of a vertex."""
    wide, high = xs[i] - x0, ys[i] - y0
    return wide * du + high * dv, high * du - wide * dv


def _passes(x, y, first, last, tolerance):
    """Return whether the chord from one vertex to another passes those between."""
    inner = slice(first + 1, last)
    wide, high = x[last] - x[first], y[last] - y[first]
    dx, dy = x[inner] - x[first], y[inner] - y[first]
    length_squared = wide * wide + high * high
    along = dx * wide + dy * high
    off = np.abs(dx * high - dy * wide)
    near = off <= tolerance * np.sqrt(float(length_squared))
    between = (along >= 0) & (along <= length_squared)
    return length_squared > 0 and (near & between).all()
