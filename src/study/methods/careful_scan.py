"""A tuned scan: steps of constant length, a look at each maximum of the gap, a fast landing.

src/study/README.md describes its forms, of which the best takes whatever it can use from the march.
It has no proof: the gap's speed may rise and fall within one step.
"""

import math

from pseudorigid.kernel.arithmetic import quadrant
from pseudorigid.kernel.compiled import jit
from pseudorigid.kernel.flight import (
    amplitude_bound,
    first_step,
    gap,
    impact_free_time,
    rises_to_its_root,
    rotated,
)
from pseudorigid.kernel.impact import MOST_SCAN_STEPS

from .landing import Landing, land

# What a scan takes from the march. The first step is from a bound of the second derivative, or
# from the march's bound of the third; then its landing; then also from below, and impact-free time.
PARABOLA, CUBIC, LANDING, BEST = 0.0, 1.0, 2.0, 3.0
_DEEP = 0.1  # R; below it the parabola at a point near the maximum is trusted


@jit
def careful_scan(
    x: float, b: float, c: float, s: float, g: float, step: float, care: float
) -> Landing:
    """Return tau, P and Q at the next impact, and evaluations; tau is NaN if there is no root."""
    amplitude = math.sqrt(x * x + c * c)
    t = 2.0 * s / (g + amplitude) if care == PARABOLA else first_step(x, c, s, g, amplitude)
    t = min(t, step) if t > 0.0 else step
    bound, rise, rate, free = amplitude_bound(x, c), 0.0, 0.0, 0.0
    if care == BEST:
        rise, rate, free = impact_free_time(x, b, g, bound)
    low, rising, count = 0.0, False, 0
    while True:
        f, df, ddf, p, q = gap(t, x, b, c, s, g, quadrant(t))
        count += 1
        ends = care == BEST and f < 0.0 and rises_to_its_root(-f, df, ddf, q, g, bound)
        if ends or (care >= LANDING and f >= 0.0):
            low, high = (t, math.inf) if ends else (low, t)
            return land(low, high, t, f, df, ddf, p, q, x, b, c, s, g, bound, count)
        if f >= 0.0:
            break
        is_rising = df > 0.0
        if rising and not is_rising:
            top, f, df, ddf, looks = maximum(low, t, df, ddf, x, b, c, s, g)
            count += looks
            if f >= 0.0:
                t, p, q = top, ddf - g, df - (b + g * top)
                break
        low, rising = t, is_rising
        t += step
        if low < free and low * rate >= rise:
            t, rising = max(t, free), False
        if count > MOST_SCAN_STEPS:
            return math.nan, p, q, count
    high = t
    while f != 0.0:
        newton = -f / df if df != 0.0 else math.inf
        h = newton / (1.0 + 0.5 * newton * ddf / df) if df != 0.0 else math.inf
        after = t + h
        if low < after <= high:
            if abs(h) <= 1e-5 * t and abs(h * ddf) <= 1e-3 * abs(df):  # its error is h^3
                p, q = rotated(p, q, h)
                return after, p, q, count
        else:
            after = 0.5 * (low + high)
        if after in (low, high, t):
            break
        t = after
        f, df, ddf, p, q = gap(t, x, b, c, s, g, quadrant(t))
        count += 1
        if f < 0.0:
            low = t
        else:
            high = t
    return t, p, q, count


@jit
def maximum(
    low: float, high: float, df: float, ddf: float, x: float, b: float, c: float, s: float, g: float
) -> tuple[float, float, float, float, int]:
    """Return a time in (low, high), from Newton's method on f' from `high`, with f, f', f'' there.

    Last comes the number of evaluations. The search ends at the maximum, at f >= 0, or deep below.
    """
    t, f, looks, is_close = high, -math.inf, 0, False
    while f < 0.0 and looks < 20:
        after = t - df / ddf if ddf < 0.0 else low
        if not low < after < high:
            after = 0.5 * (low + high)
        is_close = abs(after - t) <= 1e-4 * after
        t = after
        f, df, ddf, _, _ = gap(t, x, b, c, s, g, quadrant(t))
        looks += 1
        if is_close or (ddf < 0.0 and f - 0.5 * df * df / ddf < -_DEEP):
            break
        if df > 0.0:
            low = t
        else:
            high = t
    return t, f, df, ddf, looks
