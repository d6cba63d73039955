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

from .arithmetic import quadrant, quarter_turns
from .compiled import jit

# A flight takes 2 or 3 evaluations, a hard one some tens; past this cap something is wrong, and it
# raises.
MOST_EVALUATIONS = 10_000
# What a last step may leave of tau: a tenth of a rounding.
_SLACK = 1e-17
# A contact speed below this share of A counts as 0: its square would underflow.
_NO_SPEED = 1e-140
# Sizes from 1/HUGE to HUGE have fourth powers that neither over- nor underflow.
HUGE = 2.0**200
# 1/3!, 1/4!, ...: a product costs a third of a division
_R3, _R4, _R5, _R6, _R7 = (1.0 / n for n in (6.0, 24.0, 120.0, 720.0, 5040.0))
# sqrt(2) - 1 rounded up: the octagon around the circle, sqrt(a^2 + b^2) <= max + (sqrt(2) - 1) min.
_OCTAGON = 0.4142135623730952


@jit
def amplitude_bound(x, c):
    """A >= sqrt(x^2 + c^2)."""
    return max(abs(x), abs(c)) + _OCTAGON * min(abs(x), abs(c))


@jit
def first_step(x, c, s, g, amplitude):
    """A first time at or before the root.

    That of -s + (g + x) t/2 + A t^2/6, which lies above f/t.
    """
    h = 0.5 * (g + x)
    root = math.sqrt(h * h + (2.0 / 3.0) * s * amplitude)
    top = 2.0 * s if h >= 0.0 else 3.0 * (root - h)
    below = h + root if h >= 0.0 else amplitude
    if h == 0.0 and s == 0.0:
        top, below = 4.0 * max(c, 0.0), amplitude
    return top / below


@jit
def impact_free_time(x, b, g, amplitude):
    """A time up to which no impact happens, for long flights.

    Returns
    -------
    rise, rate, free : float
        No impact at t < free where t rate >= rise, as there f < b t + g t^2/2 + x + A < 0.
    """
    square = b * b - 2.0 * g * (x + amplitude)
    if not (b < 0.0 and square > 0.0):
        return 0.0, 0.0, 0.0
    rate = math.sqrt(square) - b
    return 2.0 * (x + amplitude), rate, rate * (1.0 / g)


@jit
def gap(t, x, b, c, s, g, trigonometry):
    """The gap and its derivatives at a time after an impact.

    Up to t = pi/4 the terms of f that cancel at 0 are left out by hand.

    Parameters
    ----------
    t : float
        Time since the impact (1/omega).
    x, b, c, s, g : float
        The flight, as for `first_impact`.
    trigonometry : tuple
        `quadrant` of t.

    Returns
    -------
    f, df, ddf, p, q : float
        f, f', f'', P and Q.
    """
    sine, cosine, sine_tail, cosine_tail, n = trigonometry
    a, d = quarter_turns(x, c, n)  # while sine and cosine are under way
    p = a * cosine - d * sine
    q = a * sine + d * cosine
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
def rises_to_its_root(depth, df, ddf, q, g, amplitude):
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
def sure_stride(depth, df, g, amplitude):
    """A step from a point depth = -f > 0 below the root that cannot pass it, as f'' <= g + A."""
    most = g + amplitude
    root = math.sqrt(df * df + 2.0 * most * depth)
    top = 2.0 * depth if df > 0.0 else root - df
    below = df + root if df > 0.0 else most
    return top / below


@jit
def stride(depth, df, ddf, q, g, amplitude, reach):
    """The same from a bound of f'' over the next `reach`, which the step does not exceed."""
    bend = min(
        g + amplitude, ddf + reach * (max(-q, 0.0) * (1.0 / 3.0) + amplitude * reach * (1.0 / 12.0))
    )
    square = df * df + 2.0 * bend * depth
    root = math.sqrt(square if square >= 0.0 else 0.0)
    top = 2.0 * depth if df > 0.0 else root - df
    below = df + root if df > 0.0 else bend
    met = square >= 0.0 and (df > 0.0 or bend > 0.0)
    return min(reach, top / below) if met else reach


@jit
def longest_stride(depth, df, ddf, q, g, amplitude):
    """The longest of these steps."""
    sure = sure_stride(depth, df, g, amplitude)
    reach = 2.0 * sure
    step = stride(depth, df, ddf, q, g, amplitude, reach)
    while step == reach and 0.0 < reach < math.inf:
        reach *= 8.0  # near x = -g the gap bends far less than g + A: do not crawl
        step = stride(depth, df, ddf, q, g, amplitude, reach)
    return max(sure, step)


@jit
def series(f, df, ddf, p, q, t, amplitude):
    """The step to the root nearby, by the inverse series of f to fourth order.

    Returns
    -------
    h : float
    holds : bool
        Whether the series holds.
    last : bool
        Whether what it leaves is below the rounding of tau.
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
    """The step to the root where `series` does not hold.

    The parabola's root, and one Newton step on the sixth-order Taylor polynomial.
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
    """P and Q a small step h later."""
    h2 = h * h
    h4 = h2 * h2
    versine = h2 * ((_R4 * h2 - 0.5) - _R6 * h4)
    rest = (h * h2) * ((_R3 - _R5 * h2) + _R7 * h4)  # h - sin h
    return p + ((p * versine + q * rest) - q * h), q + ((q * versine - p * rest) + p * h)


@jit
def _first_impact(x, b, c, s, g):
    amplitude = amplitude_bound(x, c)
    t = first_step(x, c, s, g, amplitude)
    if g + x > 0.0 and amplitude * t <= _SLACK * (g + x):  # t to a rounding; maybe 0
        p, q = rotated(x, c, t)
        return t, p, q, 0
    if s < _NO_SPEED * amplitude:  # its square would underflow; it moves no tau by 1e-70
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
        h, near, last = series(f, df, ddf, p, q, t, amplitude)
        if not near:
            h = newton(f, df, ddf, p, q)
        elif last:
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
    # a double root, to rounding: at the top f' = 0, the impact is grazing
    if df < 0.0 and ddf < 0.0:
        h = -df / ddf
        p, q = rotated(p, q, h)
        return t + h, p, q, evaluations
    return t, p, q, evaluations


@jit
def first_impact(x, b, c, s, g):
    """The time of the next impact, certified to be the first.

    Parameters
    ----------
    x : float
        Position at the impact before (R).
    b, c : float
        xdot (R omega) and udot (omega) just after it, eq. (25).
    s : float
        -(b + c) >= 0, the contact speed before it; 0 where rounding makes it negative.
    g : float
        Gravity, eq. (20).

    Returns
    -------
    tau : float
        The smallest t > 0 with f(t) = 0, in 1/omega; 0 where the ball does not leave the floor, NaN
        for input that is not finite.
    p, q : float
        P(tau), the position there, and Q(tau), udot there.
    evaluations : int
        How often the gap was evaluated.

    Raises
    ------
    ArithmeticError
        At MOST_EVALUATIONS.

    References
    ----------
    Eq. (21) with (26); the paper has "a variant of the bisection method" for its smallest root.
    """
    size = abs(x) + abs(b) + abs(c) + abs(s) + g
    s = max(s, 0.0)  # it may be 0 to rounding, of either sign
    if 1.0 / HUGE < size < HUGE:
        return _first_impact(x, b, c, s, g)
    if not size < math.inf:
        return math.nan, math.nan, math.nan, 0
    # tau does not depend on the unit of length; fourth powers must neither over- nor underflow
    d = 1.0
    while 0.0 < size * d <= 1.0 / HUGE:
        d *= HUGE
    while size * d >= HUGE:
        d /= HUGE
    tau, p, q, evaluations = _first_impact(x * d, b * d, c * d, s * d, g * d)
    return tau, p / d, q / d, evaluations
