"""Time to the next impact: the smallest root of the gap, found by steps that do not pass it.

After an impact at x with velocities b, c the gap is f(t) = X(t) + U(t), eq. (21) with (26):

    f   = x + b t + g t^2/2 - P        P = x cos t - c sin t
    f'  = b + g t + Q                  Q = x sin t + c cos t
    f'' = g + P,  f''' = -Q,  f'''' = -P,  |P|, |Q| <= A, A >= sqrt(x^2 + c^2)

While the ball flies, f < 0. From a point t before the first root, f lies below the parabola

    f + f' h + M h^2/2,  0 < h <= S,  M = min(g + A, f'' + max(-Q, 0) S/3 + A S^2/12).

A step to the root of the parabola, or to S if that is nearer, cannot pass the first root of f. The
march ends where f' > 0 and a bound of f'' shows that f rises until its root, which is then the
first root and the only one within reach. docs/method.md proves both, for exact arithmetic. In
doubles the march may pass a touch that is within rounding errors of 0, or end at one.
"""

import math

from .arithmetic import WIDE, quadrant, quarter_turns
from .compiled import jit

# Evaluations of the gap in one flight beyond which something is wrong; 2 or 3 are usual.
MOST_EVALUATIONS = 10_000
# Relative error of tau that the last step may leave: a tenth of a rounding.
_SLACK = 1e-17
# Ratio of contact speed to A below which the speed counts as 0, because its square would underflow.
# This changes tau by up to 6e-47 at g + x = 0, and by less elsewhere.
_NO_SPEED = 1e-140
# Fourth powers of numbers between 1/HUGE and HUGE neither overflow nor underflow.
HUGE = 2.0**200
# 1/3!, 1/4!, ..., because a multiplication costs a third of a division.
_R3, _R4, _R5, _R6, _R7 = (1.0 / n for n in (6.0, 24.0, 120.0, 720.0, 5040.0))
# sqrt(2) - 1 rounded up: sqrt(a^2 + b^2) <= max(a, b) + (sqrt(2) - 1) min(a, b) for a, b >= 0.
_OCTAGON = 0.4142135623730952


@jit
def amplitude_bound(x, c):
    """Return the bound A >= sqrt(x^2 + c^2) of an octagon, which needs no square root."""
    return max(abs(x), abs(c)) + _OCTAGON * min(abs(x), abs(c))


@jit
def first_step(x, c, s, g, amplitude):
    """Return a time at or before the root: the root of -s + (g + x) t/2 + A t^2/6 >= f/t."""
    h = 0.5 * (g + x)
    root = math.sqrt(h * h + (2.0 / 3.0) * s * amplitude)
    numerator = 2.0 * s if h >= 0.0 else 3.0 * (root - h)
    denominator = h + root if h >= 0.0 else amplitude
    if h == 0.0 and s == 0.0:
        numerator, denominator = 4.0 * max(c, 0.0), amplitude
    return numerator / denominator


@jit
def impact_free_time(x, b, g, amplitude):
    """Return (rise, rate, free): no impact happens at t < free where t rate >= rise.

    There f < b t + g t^2/2 + x + A < 0. The three are 0 if there is no such time.
    """
    square = b * b - 2.0 * g * (x + amplitude)
    if not (b < 0.0 and square > 0.0):
        return 0.0, 0.0, 0.0
    rate = math.sqrt(square) - b
    return 2.0 * (x + amplitude), rate, rate * (1.0 / g)


@jit
def gap(t, x, b, c, s, g, trigonometry):
    """Return f, f', f'', P and Q at time t after an impact; `trigonometry` is `quadrant` of t.

    Up to t = pi/4 the terms of f that cancel at t = 0 are left out analytically.
    """
    sine, cosine, sine_tail, cosine_tail, n = trigonometry
    a, d = quarter_turns(x, c, n)  # the processor does this while it computes sine and cosine
    p = a * cosine - d * sine
    q = a * sine + d * cosine
    is_short = n == 0.0
    f_short = t * (0.5 * (g + x) * t - s) + (c * sine_tail - x * cosine_tail)
    df_short = ((g + x) * t - s) + (x * sine_tail + c * (cosine_tail - 0.5 * t * t))
    ddf_short = (g + x) + (x * (cosine_tail - 0.5 * t * t) - c * sine)
    f_long = (x + t * (b + 0.5 * g * t)) - p
    df_long = b + g * t + q
    f = f_short if is_short else f_long
    df = df_short if is_short else df_long
    ddf = ddf_short if is_short else g + p
    return f, df, ddf, p, q


@jit
def rises_to_its_root(depth, df, ddf, q, g, amplitude):
    """Return whether f' > 0 from a point depth = -f > 0 below the root up to the root."""
    if not df > 0.0:
        return False
    square = df * df
    if square >= 2.0 * depth * (amplitude - g):
        return True
    if ddf * square >= depth * (max(q, 0.0) * df + 0.5 * amplitude * depth):
        return True
    # f'' >= m = f''(t) - max(Q, 0) h - A h^2/2 for steps up to h. The root is within h = depth/f'
    # where m >= 0, and within h = 3/2 depth/f' where m >= -8/9 f'^2/(2 depth); both times f'^2.
    bend = ddf * square - 1.5 * depth * (max(q, 0.0) * df + 0.75 * amplitude * depth)
    return square * square + 2.25 * depth * bend >= 0.0


@jit
def sure_stride(depth, df, g, amplitude):
    """Return a step that cannot pass the root from depth = -f > 0 below it, as f'' <= g + A."""
    most = g + amplitude
    root = math.sqrt(df * df + 2.0 * most * depth)
    numerator = 2.0 * depth if df > 0.0 else root - df
    denominator = df + root if df > 0.0 else most
    return numerator / denominator


@jit
def stride(depth, df, ddf, q, g, amplitude, limit):
    """Return a step up to `limit` that cannot pass the root, by a bound of f'' over `limit`."""
    bend = min(
        g + amplitude, ddf + limit * (max(-q, 0.0) * (1.0 / 3.0) + amplitude * limit * (1.0 / 12.0))
    )
    square = df * df + 2.0 * bend * depth
    root = math.sqrt(square if square >= 0.0 else 0.0)
    numerator = 2.0 * depth if df > 0.0 else root - df
    denominator = df + root if df > 0.0 else bend
    has_root = square >= 0.0 and (df > 0.0 or bend > 0.0)
    return min(limit, numerator / denominator) if has_root else limit


@jit
def longest_stride(depth, df, ddf, q, g, amplitude):
    """Return the longest of the steps that `sure_stride` and `stride` find admissible."""
    sure = sure_stride(depth, df, g, amplitude)
    limit = 2.0 * sure
    step = stride(depth, df, ddf, q, g, amplitude, limit)
    while step == limit and 0.0 < limit < math.inf:
        limit *= 8.0  # near x = -g, f'' is far below g + A, which alone would give tiny steps
        step = stride(depth, df, ddf, q, g, amplitude, limit)
    return max(sure, step)


@jit
def series(f, df, ddf, p, q, t, amplitude):
    """Return the step to a nearby root by the inverse series of f to fourth order.

    Also return whether the series applies, and whether its remainder is below a rounding of tau.
    """
    inverse = 1.0 / df
    u = -f * inverse
    u2 = u * u
    a2 = 0.5 * ddf * inverse
    a3 = -_R3 * q * inverse
    a4 = -_R4 * p * inverse
    tail = (2.0 * a2 * a2 - a3) + u * (5.0 * a2 * (a3 - a2 * a2) - a4)
    h = (u - a2 * u2) + (u * u2) * tail
    spread = u2 * (4.0 * a2 * a2 + amplitude * inverse)
    return h, spread < 0.05, spread * spread * abs(u) <= _SLACK * t


@jit
def newton(f, df, ddf, p, q):
    """Return the step to the root where `series` does not apply.

    It is the parabola's root and one Newton step on the sixth-order Taylor polynomial.
    """
    root = math.sqrt(max(0.0, df * df - 2.0 * ddf * f))
    inverse = 1.0 / root if root > 0.0 else 0.0  # of the parabola's slope at h
    h = -2.0 * f / (df + root)
    h2 = h * h
    rest = (h * h2) * (h2 * (_R5 * q + _R6 * p * h) - (_R3 * q + _R4 * p * h))
    bend = h2 * (_R4 * q * h2 - (0.5 * q + _R3 * p * h)) * inverse
    if abs(bend) < 0.5:
        h -= rest * inverse * (1.0 - bend)
    return h


@jit
def rotated(p, q, h):
    """Return P and Q after a small further time h."""
    h2 = h * h
    h4 = h2 * h2
    versine = h2 * ((_R4 * h2 - 0.5) - _R6 * h4)
    rest = (h * h2) * ((_R3 - _R5 * h2) + _R7 * h4)  # h - sin h
    return p + ((p * versine + q * rest) - q * h), q + ((q * versine - p * rest) + p * h)


@jit
def _first_impact(x, b, c, s, g):
    amplitude = amplitude_bound(x, c)
    t = first_step(x, c, s, g, amplitude)
    if g + x > 0.0 and amplitude * t <= _SLACK * (g + x) and t < WIDE:
        # t is tau to a rounding, or 0
        p, q = rotated(x, c, t)
        return t, p, q, 0
    if s < _NO_SPEED * amplitude:
        s = 0.0
        t = first_step(x, c, s, g, amplitude)
    if t == 0.0:
        return 0.0, x, c, 0
    rise, rate, free = impact_free_time(x, b, g, amplitude)
    if t < free and t * rate >= rise:
        t = free
    f, df, ddf, p, q = gap(t, x, b, c, s, g, quadrant(t))
    evaluations = 1
    low = t
    while f < 0.0 and not rises_to_its_root(-f, df, ddf, q, g, amplitude):
        after = t + longest_stride(-f, df, ddf, q, g, amplitude)
        if after == t:
            return t, p, q, evaluations
        t = after
        if t < free and t * rate >= rise:
            t = free
        f, df, ddf, p, q = gap(t, x, b, c, s, g, quadrant(t))
        evaluations += 1
        if evaluations > MOST_EVALUATIONS:
            raise ArithmeticError("the march to the next impact does not end")
        low = t
    high = math.inf
    while df > 0.0 and f != 0.0:
        h, applies, accurate = series(f, df, ddf, p, q, t, amplitude)
        if not applies:
            h = newton(f, df, ddf, p, q)
        elif accurate:
            p, q = rotated(p, q, h)
            return t + h, p, q, evaluations
        after = t + h
        if not low < after < high:
            after = 0.5 * (low + high)
        if after in (t, low, high):
            break
        t = after
        f, df, ddf, p, q = gap(t, x, b, c, s, g, quadrant(t))
        evaluations += 1
        if evaluations > MOST_EVALUATIONS:
            raise ArithmeticError("the landing on the next impact does not end")
        if f < 0.0:
            low = t
        else:
            high = t
    # The root is double to rounding: the impact grazes at the maximum of f, where f' = 0.
    if df < 0.0 and ddf < 0.0:
        h = -df / ddf
        p, q = rotated(p, q, h)
        return t + h, p, q, evaluations
    return t if t < WIDE else math.nan, p, q, evaluations


@jit
def first_impact(x, b, c, s, g):
    """Find the first impact, eq. (21) with (26), after the one at x with velocities b, c after it.

    s = -(b + c) is the contact speed before the impact; rounding may make it negative, which counts
    as 0. Returns tau (1/omega), the position P(tau), udot Q(tau) and the number of evaluations of
    the gap. tau is 0 where the ball does not leave the floor. All but the number are NaN for input
    that is not finite, and for a flight that lasts 2^20/omega or longer. Raises ArithmeticError
    for a flight of more than MOST_EVALUATIONS evaluations.
    """
    size = abs(x) + abs(b) + abs(c) + abs(s) + g
    s = max(s, 0.0)
    if 1.0 / HUGE < size < HUGE:
        return _first_impact(x, b, c, s, g)
    if not size < math.inf:
        return math.nan, math.nan, math.nan, 0
    # tau does not depend on the unit of length, so choose one for which no fourth power overflows.
    d = 1.0
    while 0.0 < size * d <= 1.0 / HUGE:
        d *= HUGE
    while size * d >= HUGE:
        d /= HUGE
    tau, p, q, evaluations = _first_impact(x * d, b * d, c * d, s * d, g * d)
    return tau, p / d, q / d, evaluations
