"""The next impact to 60 digits, by a second method.

The gap f(t) = x + b t + g t^2/2 - x cos t + c sin t has f'' = g + x cos t - c sin t, whose zeros
are known in closed form. Between two of them f' is monotone and has at most one zero; between two
zeros of f' the gap is monotone and has at most one root. So no candidate is missed.

The doubles of a state are exact; b and c are computed from them with 60 digits.
"""

import math
from dataclasses import dataclass
from functools import cache
from itertools import pairwise

import mpmath
from mpmath import mp, mpf

mp.dps = 60

# Depth, relative to the terms of f, below which doubles cannot tell a near miss from a touch.
UNDECIDABLE = 1e-15


@dataclass(frozen=True)
class Verdict:
    """The next impact of a state in 60 digits, and how well doubles can know it."""

    tau: mpf
    slope: mpf  # f'(tau)
    state: tuple  # (x', v', w')
    depth: float  # least |f| / terms at a local maximum that decides which root is first, or inf
    rival: mpf | None  # other candidate for tau if depth < UNDECIDABLE
    condition: float  # terms / (tau |f'(tau)|): error of tau in roundings of its terms


class Gap:
    """f and its derivatives for one flight, from exact x, b, c, s = -(b + c) and g."""

    def __init__(self, x, b, c, s, g, size_b=None):
        self.x, self.b, self.c, self.s, self.g = x, b, c, s, g
        self.size_b = abs(b) if size_b is None else size_b  # size of the terms of b
        self.amplitude = mpmath.sqrt(x * x + c * c)

    def __call__(self, t):
        if t == 0:
            return mpf(0)
        cosine, sine = mpmath.cos_sin(t)
        return self.x * (1 - cosine) + t * (self.b + self.g * t / 2) + self.c * sine

    def slope(self, t):
        if t == 0:
            return -self.s
        cosine, sine = mpmath.cos_sin(t)
        return self.b + self.g * t + self.x * sine + self.c * cosine

    def bend(self, t):
        cosine, sine = mpmath.cos_sin(t)
        return self.g + self.x * cosine - self.c * sine

    def terms(self, t):
        """The size of the terms of f; for small t without those that cancel."""
        if t < mpmath.pi / 4:
            rest = abs(self.c) * t / 6 + abs(self.x) * t * t / 24
            return self.s * t + (abs(self.g + self.x) / 2 + rest) * t * t
        return abs(self.x) + self.size_b * t + self.g * t * t / 2 + self.amplitude

    def starts_below(self):
        """Whether f < 0 just after 0: the sign of its first derivative that is not 0."""
        for derivative in (-self.s, self.g + self.x, -self.c, -self.x):
            if derivative != 0:
                return derivative < 0
        raise AssertionError("the gap is zero throughout")


def _solve(f, slope, low, high):
    """Find the root of f in [low, high], where f changes sign once, by bracketed Newton steps."""
    rising = f(high) > 0
    t = (low + high) / 2
    for step in range(4000):
        value = f(t)
        if value == 0:
            return t
        if (value > 0) == rising:
            high = t
        else:
            low = t
        steep = slope(t)
        after = t - value / steep if steep != 0 else low
        # Newton's method needs a thousand steps from 1 to a flight of 1e-300: take the mean
        # logarithm, or where low is 0 a number that falls towards 0 by ever larger factors.
        if not low < after < high or (high > 16 * low and step % 2):
            far = mpmath.sqrt(low * high) if low > 0 else high * min(high, mpf(1) / 16)
            after = far if high > 16 * low else (low + high) / 2
        if abs(after - t) <= abs(after) * mpf(10) ** -45:
            return after
        t = after
    raise AssertionError("Newton's method does not converge")


def _ends_of_pieces(gap, last, clear):
    """Yield 0, the zeros of f'' in order without most of those within `clear`, and `last`.

    f'' = g + A cos(t + phi), phi = atan2(c, x), so t = 2 pi n - phi -+ acos(-g/A).
    """
    yield mpf(0)
    if gap.amplitude > gap.g:
        turn, angle = 2 * mpmath.pi, mpmath.acos(-gap.g / gap.amplitude)
        zeros = sorted((sign * angle - mpmath.atan2(gap.c, gap.x)) % turn for sign in (1, -1))
        # If g + x = 0, one of them is 0 itself, up to the last of the 60 digits.
        floor = mpf(10) ** -40 if gap.g + gap.x == 0 else mpf(0)
        while zeros[0] < last:
            yield from (t for t in zeros if floor < t < last)
            turns = int((clear[1] - zeros[0]) / turn) - 1 if zeros[0] > clear[0] else 1
            zeros = [t + max(1, turns) * turn for t in zeros]
    yield last


def _monotone_pieces(gap):
    """Yield (low, high, f(low), f(high)) of monotone pieces of f that may hold a root, in order.

    With h = x + b t + g t^2/2, f is between h - A and h + A. Pieces on which f is below zero by
    more than a millionth of its largest term are left out.
    """
    square = gap.b * gap.b - 2 * gap.g * (gap.x - gap.amplitude)
    last = (-gap.b + mpmath.sqrt(square)) / gap.g + 1  # f > 0 from here on
    margin = (abs(gap.x) + gap.amplitude + (abs(gap.b) + gap.g * last) * (1 + last)) / 10**6
    square = gap.b * gap.b - 2 * gap.g * (gap.x + gap.amplitude + margin)
    root = mpmath.sqrt(max(square, 0))
    clear = (-gap.b - root) / gap.g, (-gap.b + root) / gap.g  # where h + A < -margin
    values = cache(lambda t: (gap(t), gap.slope(t)))
    for low, high in pairwise(_ends_of_pieces(gap, last, clear)):
        if clear[0] < low and high < clear[1]:
            continue
        (f_low, d_low), (f_high, d_high) = values(low), values(high)
        if d_low < 0 < d_high and max(f_low, f_high) < 0:
            continue  # a minimum
        if d_low * d_high < 0:
            # the tangents at both ends meet above a maximum
            meet = (f_high - f_low - d_high * (high - low)) / (d_low - d_high)
            if d_low > 0 > f_low + d_low * meet + margin:
                continue
            at = _solve(gap.slope, gap.bend, low, high)
            f_at = gap(at)
            yield low, at, f_low, f_at
            yield at, high, f_at, f_high
        else:
            yield low, high, f_low, f_high


def first_root(gap):
    """Find (tau, depth, rival) of a Gap, see Verdict."""
    if not gap.starts_below():
        return mpf(0), math.inf, None
    tau, depth, rival = None, math.inf, None
    for low, high, f_low, f_high in _monotone_pieces(gap):
        rises = f_high > f_low
        if rises and tau is not None:
            # the next root after a peak that barely came out of the floor
            if f_high > 0:
                if depth < UNDECIDABLE and rival is None and f_low < 0:
                    rival = _solve(gap, gap.slope, low, high)
                break
            continue
        if rises and f_high >= 0 and (f_low < 0 or low == 0):
            tau = high
            if f_high > 0:
                tau = _solve(gap, gap.slope, low, high)
        if rises and gap.bend(high) < 0:
            # `high` is a local maximum, or an inflection on the way up to it
            peak = float(abs(f_high) / gap.terms(high))
            if peak < depth and abs(gap.slope(high)) < mpf(10) ** -30 * gap.terms(high):
                depth = peak
                if tau is None and depth < UNDECIDABLE and rival is None:
                    rival = high
        if tau is not None and not depth < UNDECIDABLE:
            break
    if tau is None:
        raise AssertionError("no root was found")
    return tau, depth, rival


def judge(k, g, x, v, w):
    """Find the next impact of a state with v + w >= 0, just before an impact."""
    k, g, x, v, w = (mpf(float(a)) for a in (k, g, x, v, w))
    with mpmath.workdps(_digits(g, x, v, w)):
        gap, b, c = flight(k, g, x, v, w)
        tau, depth, rival = first_root(gap)
        cosine, sine = mpmath.cos_sin(tau)
        slope = gap.slope(tau)
        state = (x * cosine - c * sine, b + g * tau, x * sine + c * cosine)
        roundings = _condition(gap, tau)
    return Verdict(tau, slope, state, depth, rival, roundings)


def condition(k, g, x, v, w, tau):
    """The error of tau in roundings of its terms, see Verdict."""
    k, g, x, v, w = (mpf(float(a)) for a in (k, g, x, v, w))
    with mpmath.workdps(_digits(g, x, v, w)):
        return _condition(flight(k, g, x, v, w)[0], tau)


def _condition(gap, tau):
    slope = gap.slope(tau)
    if slope == 0:
        return math.inf
    return float(gap.terms(tau) / (tau * abs(slope))) if tau > 0 else 1.0


def _digits(g, x, v, w):
    """The working digits: 60, and more for short flights, in which the terms of f cancel."""
    size, s = abs(x) + abs(v) + abs(w) + g, v + w
    smallest = min(a for a in (s, abs(g + x), size) if a > 0)
    return 60 + 4 * max(0, int(mpmath.log10(size / smallest)))


def flight(k, g, x, v, w):
    """(Gap, b, c) of the flight after the impact of a 60-digit state."""
    s = v + w
    e = 2 * s / (1 + k)
    b, c = v - k * e, w - e
    return Gap(x, b, c, s, g, max(abs(v), k * e, abs(b))), b, c


def exact_map(k, g, x, v, w):
    """(x', v', w', tau) for 60-digit numbers, by the method of `judge`."""
    gap, b, c = flight(k, g, x, v, w)
    tau = first_root(gap)[0]
    cosine, sine = mpmath.cos_sin(tau)
    return x * cosine - c * sine, b + g * tau, x * sine + c * cosine, tau


def exact_jacobian(k, g, x, v, w, step=1e-20):
    """The rows of the Jacobian by central differences of exact_map, with an error of step^2."""
    k, g, *at = (mpf(a) for a in (k, g, x, v, w))

    def column(j):
        ends = ([a + sign * step * (i == j) for i, a in enumerate(at)] for sign in (1, -1))
        plus, minus = (exact_map(k, g, *end)[:3] for end in ends)
        return [(p - m) / (2 * step) for p, m in zip(plus, minus, strict=True)]

    return [list(row) for row in zip(*map(column, range(3)), strict=True)]


def periodic_point(ball, energy, state, period):
    """Do a step of Newton's method to a periodic point; return it and the Jacobian of P^n."""
    k, g, point = mpf(ball.k), mpf(ball.g), mpmath.matrix([mpf(a) for a in state])
    after, product = point, mpmath.eye(3)
    for _ in range(period):
        product = mpmath.matrix(exact_jacobian(k, g, *after)) * product
        after = exact_map(k, g, *after)[:3]
    x, v, w = point
    # Orbits form a family, so the energy is prescribed.
    missing = mpf(energy) - (v * v / 2 + k * w * w / 2 - g * x + k * x * x / 2)
    system = mpmath.matrix(4, 3)
    system[:3, :] = product - mpmath.eye(3)
    system[3, :] = mpmath.matrix([[k * x - g, v, k * w]])
    gaps = [a - b for a, b in zip(point, after, strict=True)]
    return point + mpmath.lu_solve(system, mpmath.matrix([*gaps, missing])), product
