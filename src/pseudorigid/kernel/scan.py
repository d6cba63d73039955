"""Scan for the next impact: constant steps until the gap changes sign, then bisection.

This reads the paper's "variant of the bisection method", for which it gives no step, and serves
only for comparison. A scan can step over an impact; the ball then passes through the floor, and its
energy does not show it. Every flight is therefore also computed by `flight.first_impact`, and late
impacts are counted.
"""

import math

from .arithmetic import sincos
from .compiled import jit
from .flight import first_impact

# Steps after which a scan gives up. A flight takes about 3 time units, or 3e7 steps of 1e-7.
MOST = 50_000_000
# Time beyond the tolerance by which a scan's impact is late if an earlier one was missed. Where the
# ball almost touches the floor, the first impact is only known to the root of a rounding, 1e-8.
TOUCH = 1e-6


@jit
def gap(t, x, b, c, g):
    """Return f(t), eq. (21), with its terms as in the paper."""
    sine, cosine = sincos(t)
    return (x + t * (b + 0.5 * g * t)) + (c * sine - x * cosine)


@jit
def scan(x, b, c, g, step, tolerance):
    """Find the next impact by steps and bisection, without a guarantee that it is the first.

    Bisection ends with a bracket no longer than the tolerance or of neighbouring doubles. Returns
    its middle and the evaluations of the gap. The time is NaN for input that is not finite, and if
    the gap keeps its sign over MOST steps.
    """
    if not abs(x) + abs(b) + abs(c) + g < math.inf:
        return math.nan, 0
    low = 0.0
    high = 0.0
    count = 0
    while True:
        count += 1
        high = count * step
        if gap(high, x, b, c, g) > 0.0:
            break
        low = high
        if not count < MOST:
            return math.nan, count
    while high - low > tolerance:
        middle = 0.5 * (low + high)
        if middle in (low, high):
            break
        count += 1
        if gap(middle, x, b, c, g) > 0.0:
            high = middle
        else:
            low = middle
    return 0.5 * (low + high), count


@jit
def scanned_impact(x, b, c, s, g, root_finder):
    """Return the scan's tau, position and udot, and 1 if it missed an earlier impact, else 0.

    `root_finder` is (step, tolerance) in 1/omega. Raises ArithmeticError if no impact is found.
    """
    step, tolerance = root_finder
    tau, count = scan(x, b, c, g, step, tolerance)
    if math.isnan(tau) and count:
        raise ArithmeticError("the scan for the next impact does not end")
    first, _, _, _ = first_impact(x, b, c, s, g)
    sine, cosine = sincos(tau)
    missed = 1 if tau > first + tolerance + TOUCH else 0
    return tau, x * cosine - c * sine, x * sine + c * cosine, missed
