"""The landing of the certified march, for the methods that share it."""

import math

from pseudorigid.kernel.arithmetic import quadrant
from pseudorigid.kernel.compiled import jit
from pseudorigid.kernel.flight import gap, newton, rotated, series

Landing = tuple[float, float, float, int]  # tau, P, Q, and the sines and cosines of a flight
Impact = tuple[float, float, float, int, int]  # the same, and rotations or inverse functions


@jit
def land(
    low: float, high: float, t: float,
    f: float, df: float, ddf: float, p: float, q: float,
    x: float, b: float, c: float, s: float, g: float, amplitude: float, count: int,
) -> Landing:  # fmt: skip
    """Return the only root between `low` and `high`, where the gap rises, from a point t there.

    The steps are those of `pseudorigid.kernel.flight`: a series, or else Newton's method.
    """
    while f != 0.0:
        h, applies, accurate = series(f, df, ddf, p, q, t, amplitude)
        if not (df > 0.0 and applies):
            h = newton(f, df, ddf, p, q) if df > 0.0 or ddf > 0.0 else math.inf
        elif accurate:
            p, q = rotated(p, q, h)
            return t + h, p, q, count
        if f < 0.0 and df <= 0.0 and ddf < 0.0:  # the maximum is below 0 by rounding
            p, q = rotated(p, q, -df / ddf)
            return t - df / ddf, p, q, count
        after = t + h
        if not low < after < high:
            after = 0.5 * (low + high)
        if after in (t, low, high):
            break
        t = after
        f, df, ddf, p, q = gap(t, x, b, c, s, g, quadrant(t))
        count += 1
        if f < 0.0:
            low = t
        else:
            high = t
    return t, p, q, count
