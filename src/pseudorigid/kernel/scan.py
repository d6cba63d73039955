"""A reading of the paper's way to the next impact, for comparison.

Steps of constant length until the gap changes sign, then bisection (the paper, which gives no step:
"a variant of the bisection method").

A scan can step over an impact. The ball then passes through the floor, and its energy does not
show it; so every flight is also computed by the certified march, and those that came too late are
counted.
"""

import math

from .arithmetic import sincos
from .compiled import jit
from .flight import first_impact

# A scan that needs more steps than this gives up: a flight takes some 3 time units, so that steps
# of 1e-7 are still within it.
MOST = 50_000_000
# An impact later than the certified one by more than the tolerance and this was missed. Where the
# ball all but touches the floor, the first impact is known to the root of a rounding, 1e-8.
TOUCH = 1e-6


@jit
def gap(t, x, b, c, g):
    """f(t) of eq. (21) as it stands in the paper."""
    sine, cosine = sincos(t)
    return (x + t * (b + 0.5 * g * t)) + (c * sine - x * cosine)


@jit
def scan(x, b, c, g, step, tolerance):
    """The time of the next impact by steps and bisection, not certified.

    Parameters
    ----------
    x, b, c, g : float
        Position at the impact before (R), velocities just after it, and gravity.
    step : float
        Length of a step in time (1/omega).
    tolerance : float
        The bisection ends with a bracket no longer than this, or of neighbouring doubles.

    Returns
    -------
    tau : float
        The bracket's middle (1/omega); NaN where the gap does not change sign within MOST steps,
        and for input that is not finite.
    evaluations : int
        How often the gap was evaluated.
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
    """The flight after an impact by the scan, held against the certified one.

    Parameters
    ----------
    x, b, c, s, g : float
        As for `flight.first_impact`.
    root_finder : (float, float)
        Step and tolerance (1/omega).

    Returns
    -------
    tau, p, q : float
        The scan's time of flight, position and udot at its end.
    missed : int
        1 where an earlier impact was flown past.

    Raises
    ------
    ArithmeticError
        Where the scan ends without an impact.
    """
    step, tolerance = root_finder
    tau, count = scan(x, b, c, g, step, tolerance)
    if math.isnan(tau) and count:
        raise ArithmeticError("the scan for the next impact does not end")
    first, _, _, _ = first_impact(x, b, c, s, g)
    sine, cosine = sincos(tau)
    missed = 1 if tau > first + tolerance + TOUCH else 0
    return tau, x * cosine - c * sine, x * sine + c * cosine, missed
