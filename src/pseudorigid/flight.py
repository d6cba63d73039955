"""The time to the next impact: the smallest root of the gap, with a certificate.

After an impact at x with velocities b, c the gap is f(t) = X(t) + U(t), eq. (21) with (26):

    f   = x + b t + g t^2/2 - P        P = x cos t - c sin t
    f'  = b + g t + Q                  Q = x sin t + c cos t
    f'' = g + P,  f''' = -Q,  f'''' = -P,  |P|, |Q| <= A, A >= sqrt(x^2 + c^2)

While the ball flies f < 0. From a point t before the first root, f lies below

    f + f' h + M h^2/2,  0 < h <= S,  M = min(g + A, f'' + max(-Q, 0) S/3 + A S^2/12),

so a step to the root of that parabola, or to S where that is nearer, cannot pass the first root of
f. The march ends where f' > 0 and f'^2 >= 2 |f| max(0, A - g), or the sharper bound of f'' over
the step, shows that f rises all the way to its root: that root is then the next one and the only
one in reach. A is the octagon's bound max + (sqrt(2) - 1) min of |x|, |c|: it needs no square
root, and any bound will do.
"""

import math

from .arithmetic import sincos_tails
from .compiled import jit

# A flight takes 2 or 3 looks, a hard one some tens; past this cap something is wrong, and it
# raises.
MOST_LOOKS = 10_000
# What a last step may leave of tau: a tenth of a rounding.
_SLACK = 1e-17
_HUGE = 2.0**200
# sqrt(2) - 1 rounded up: the octagon around the circle, sqrt(a^2 + b^2) <= max + (sqrt(2) - 1) min.
_OCTAGON = 0.4142135623730952


@jit
def _launch(x, c, s, g, amplitude):
    """A first time at or before the root: that of -s + (g + x) t/2 + A t^2/6, which lies above
    f/t.
    """
    h = 0.5 * (g + x)
    root = math.sqrt(h * h + (2.0 / 3.0) * amplitude * s)
    if h == 0.0 and s == 0.0:
        return 4.0 * c / amplitude if c > 0.0 else 0.0
    return 2.0 * s / (h + root) if h >= 0.0 else 3.0 * (root - h) / amplitude


@jit
def _look(t, x, b, c, s, g):
    """f, f', f'', P, Q at t. Up to t = pi/4 the terms of f that cancel at 0 are left out by
    hand.
    """
    sine, cosine, n, sine_tail, cosine_tail = sincos_tails(t)
    p = x * cosine - c * sine
    q = x * sine + c * cosine
    near = n == 0.0
    f_near = t * (0.5 * (g + x) * t - s) + (c * sine_tail - x * cosine_tail)
    df_near = ((g + x) * t - s) + (x * sine_tail + c * (cosine_tail - 0.5 * t * t))
    ddf_near = (g + x) + (x * (cosine_tail - 0.5 * t * t) - c * sine)
    f_far = (x + t * (b + 0.5 * g * t)) - p
    df_far = b + g * t + q
    f = f_near if near else f_far
    df = df_near if near else df_far
    ddf = ddf_near if near else g + p
    return f, df, ddf, p, q


@jit
def _rises_to_its_root(depth, df, ddf, q, g, amplitude):
    """Whether f' > 0 from here to the root, depth = -f > 0 below it."""
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
def _stride(depth, df, ddf, q, g, amplitude):
    """A step from a point depth = -f > 0 below the root that cannot pass it."""
    most = g + amplitude
    root = math.sqrt(df * df + 2.0 * most * depth)
    sure = 2.0 * depth / (df + root) if df > 0.0 else (root - df) / most
    reach = 2.0 * sure
    while True:
        bend = min(most, ddf + reach * (max(-q, 0.0) / 3.0 + amplitude * reach / 12.0))
        square = df * df + 2.0 * bend * depth
        step = reach
        if square >= 0.0:
            if df > 0.0:
                step = 2.0 * depth / (df + math.sqrt(square))
            elif bend > 0.0:
                step = (math.sqrt(square) - df) / bend
        if step < reach or not 0.0 < reach < math.inf:
            return max(sure, step)
        reach *= 8.0  # near x = -g the gap bends far less than g + A: do not crawl


@jit
def _correction(f, df, ddf, p, q, t, amplitude):
    """The step from t to the root nearby, and whether what it leaves is below the rounding of
    tau.
    """
    inverse = 1.0 / df
    u = -f * inverse
    a2 = 0.5 * ddf * inverse
    spread = 4.0 * (a2 * u) * (a2 * u) + amplitude * u * u * inverse
    if spread < 0.1:  # the inverse series of f, to fourth order
        a3 = (-1.0 / 6.0) * q * inverse
        a4 = (-1.0 / 24.0) * p * inverse
        tail = (2.0 * a2 * a2 - a3) + u * (a2 * (5.0 * a3 - 5.0 * a2 * a2) - a4)
        return u - u * (a2 * u - u * u * tail), spread * spread * abs(u) <= _SLACK * t
    # the parabola, and one Newton step on the sixth-order Taylor polynomial
    h = -2.0 * f / (df + math.sqrt(max(0.0, df * df - 2.0 * ddf * f)))
    rest = h * h * h * (-q / 6.0 + h * (-p / 24.0 + h * (q / 120.0 + h * p / 720.0)))
    slope = df + h * (ddf + h * (-0.5 * q + h * (-p / 6.0 + h * q / 24.0)))
    if slope > 0.5 * df:
        h -= rest / slope
    return h, False


@jit
def _turn(p, q, h):
    """P and Q a small step h later."""
    h2 = h * h
    versine = h2 * (-0.5 + h2 * (1.0 / 24.0 - h2 / 720.0))
    sine = h * (1.0 - h2 * (1.0 / 6.0 - h2 * (1.0 / 120.0 - h2 / 5040.0)))
    return p + (p * versine - q * sine), q + (q * versine + p * sine)


@jit
def _first_impact(x, b, c, s, g):
    amplitude = max(abs(x), abs(c)) + _OCTAGON * min(abs(x), abs(c))
    t = _launch(x, c, s, g, amplitude)
    if t == 0.0:
        return 0.0, x, c, 0
    # f < b t + g t^2/2 + x + A: between that parabola's roots there is no impact
    enter = math.inf
    leave = 0.0
    square = b * b - 2.0 * g * (x + amplitude)
    if b < 0.0 and square > 0.0:
        fast = math.sqrt(square) - b
        leave = fast / g
        enter = 2.0 * (x + amplitude) / fast
        if enter <= t < leave:
            t = leave
    f, df, ddf, p, q = _look(t, x, b, c, s, g)
    looks = 1
    low = t
    while f < 0.0 and not _rises_to_its_root(-f, df, ddf, q, g, amplitude):
        after = t + _stride(-f, df, ddf, q, g, amplitude)
        if after == t:
            return t, p, q, looks
        t = after
        if enter <= t < leave:
            t = leave
        f, df, ddf, p, q = _look(t, x, b, c, s, g)
        looks += 1
        if looks > MOST_LOOKS:
            raise ArithmeticError("the march to the next impact does not end")
        low = t
    high = math.inf
    while df > 0.0 and f != 0.0:
        h, last = _correction(f, df, ddf, p, q, t, amplitude)
        if last:
            p, q = _turn(p, q, h)
            return t + h, p, q, looks
        after = t + h
        if not low < after < high:
            after = 0.5 * (low + high)
        if after in (t, low, high):
            break
        t = after
        f, df, ddf, p, q = _look(t, x, b, c, s, g)
        looks += 1
        if looks > MOST_LOOKS:
            raise ArithmeticError("the landing on the next impact does not end")
        if f < 0.0:
            low = t
        else:
            high = t
    # a double root, to rounding: at the top f' = 0, the impact is grazing
    if df < 0.0 and ddf < 0.0:
        h = -df / ddf
        p, q = _turn(p, q, h)
        return t + h, p, q, looks
    return t, p, q, looks


@jit
def first_impact(x, b, c, s, g):
    """The flight from x with velocities b, c just after an impact, s = -(b + c) >= 0.

    Returns (tau, P, Q, looks): the smallest t > 0 with f(t) = 0, then x' = P and udot' = Q there,
    and how often the gap was evaluated. tau = 0 where the ball does not leave the floor; NaN for
    input that is not finite. Raises ArithmeticError at MOST_LOOKS.
    """
    size = abs(x) + abs(b) + abs(c) + abs(s) + g
    if 1.0 / _HUGE < size < _HUGE:
        return _first_impact(x, b, c, max(s, 0.0), g)  # s may be 0 to rounding, of either sign
    if not size < math.inf:
        return math.nan, math.nan, math.nan, 0
    # tau does not depend on the unit of length; fourth powers must neither over- nor underflow
    d = 1.0
    while 0.0 < size * d <= 1.0 / _HUGE:
        d *= _HUGE
    while size * d >= _HUGE:
        d /= _HUGE
    tau, p, q, looks = _first_impact(x * d, b * d, c * d, max(s, 0.0) * d, g * d)
    return tau, p / d, q / d, looks
