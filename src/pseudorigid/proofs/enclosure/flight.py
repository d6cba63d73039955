"""The first root of the gap, enclosed and proved to be the first, for numbers, balls and jets.

After an impact f(t) = -s t + g t^2/2 + c (sin t - t) + x (1 - cos t), which is eq. (21) with (26)
where s = -(b + c), and every parameter enters once. With A = sqrt(x^2 + c^2), |f'''| <= A and
f'' <= g + A, so that a parabola lies above f from any time on. Marching from root to root of such
parabolas f stays below zero: the parabola is convex, and it is below zero at both ends of a step,
the later end rounded down. The march ends where f' > 0 up to a time with f > 0: one root there,
and none before.
"""

import math

from flint import arb, ctx

from .jets import Jet

MARCH_BITS = 64  # one word of the processor: a march needs no more unless it nearly touches
# Of a parabola's root, which is rounded to nearest: the rest is far more than its rounding, so that
# the check in balls succeeds that the parabola is below zero there.
_BELOW_ROOT = 1.0 - 1e-6
# Steps that know f'', then steps that know f''' too: near grazing the first kind crawls. It comes
# first because certificates state margins of what it encloses.
_PLAIN_STEPS, _MOST_STEPS = 400, 800


class UndecidedError(ArithmeticError):
    """What is asked cannot be decided for this set of states at this precision."""


class Gap:
    """f of a set of flights, eq. (21) with (26), from an impact on.

    Parameters
    ----------
    x, c, s : arb or Jet
        Position at the impact, rate of strain after it, and s = xdot + udot before it.
    g : arb
        Gravity.
    """

    def __init__(self, x, c, s, g):
        self.x, self.c, self.s, self.g = x, c, s, g

    def height(self, t):
        """f(t)."""
        sine, cosine = t.sin_cos()
        return t * (self.g * t / 2 - self.s) + self.c * (sine - t) + self.x * (1 - cosine)

    def slope(self, t):
        """f'(t)."""
        sine, cosine = t.sin_cos()
        return self.g * t - self.s + self.c * (cosine - 1) + self.x * sine

    def at(self, t):
        """f, f' and f'' at t."""
        sine, cosine = t.sin_cos()
        x, c, gt = self.x, self.c, self.g * t
        versine = 1 - cosine
        height = t * (gt / 2 - self.s) + c * (sine - t) + x * versine
        return height, gt - self.s - c * versine + x * sine, self.g + x * cosine - c * sine

    def third_derivative(self, t):
        """f'''(t)."""
        sine, cosine = t.sin_cos()
        return -self.x * sine - self.c * cosine

    def rounded(self):
        """The same flights in balls of the context's precision."""
        return Gap(+self.x, +self.c, +self.s, +self.g)


def first_root(x, c, s, g, after=None):
    """The time of the next impact: the smallest t > 0 with f(t) = 0.

    Parameters
    ----------
    x, c, s : arb or Jet
        Position at the impact, rate of strain after it, and s = xdot + udot before it.
    g : arb
        Gravity.
    after : arb, optional
        A time up to which f < 0 is known, for impacts that graze.

    Returns
    -------
    arb or Jet
        For every choice of parameters in the balls its first root is in the result, and is
        simple. Of a jet, the Taylor coefficients of that root.

    Raises
    ------
    UndecidedError
        Where an earlier touch of the floor cannot be excluded, or s may be zero.
    """
    if isinstance(x, Jet):
        root = first_root(x.constant, c.constant, s.constant, g, after)
        return _expand(Gap(x, c, s, g), root)
    gap = Gap(x, c, s, g)
    return refine(gap, *isolate(gap, after))


def isolate(gap, after=None):
    """Two times between which the first root of the gap is, and no other.

    Works with MARCH_BITS, and where they do not decide with up to the context's.

    Parameters
    ----------
    gap : Gap
        Of balls.
    after : arb, optional
        A time up to which f < 0 is known, for impacts that graze.

    Returns
    -------
    low, high : arb
        Exact: f < 0 on (0, low], and one root in (low, high), where f' > 0.

    Raises
    ------
    UndecidedError
        Where an earlier touch of the floor cannot be excluded.
    """
    most, bits = ctx.prec, MARCH_BITS
    while True:
        with ctx.workprec(bits):
            try:
                return _march(gap.rounded(), after)
            except UndecidedError:
                if bits >= most:
                    raise
        bits = min(2 * bits, most)


def refine(gap, low, high):
    """A root of the gap as narrow as the context's precision and the parameters allow.

    Interval Newton with twice the bits at each step: T = t - f(t)/f'(T).

    Parameters
    ----------
    gap : Gap
        Of balls.
    low, high : arb
        As from `isolate`.

    Returns
    -------
    arb

    Raises
    ------
    UndecidedError
        Where f' may vanish.
    """
    root = low.union(high)
    levels = [ctx.prec]
    while levels[-1] > 2 * MARCH_BITS:
        levels.append(levels[-1] // 2 + 8)
    for bits in reversed(levels):
        with ctx.workprec(bits):
            at_level = gap.rounded()
            while True:
                slope = at_level.slope(root)
                if not slope > 0:
                    if bits < levels[0]:
                        break  # these are too few to tell
                    raise UndecidedError("two impacts may be one: the slope of the gap may vanish")
                middle = root.mid()
                narrow = (middle - at_level.height(middle) / slope).intersection(root)
                better = narrow.rad() < root.rad() * 0.75
                root = narrow
                if not better or root.rel_accuracy_bits() > bits - 16:
                    break
    return root


def _expand(gap, root):
    """The jet of the root, by Newton steps on jets: its constant term solves f = 0 exactly."""
    time, exact = Jet.constant_of(gap.x.algebra, root), 0
    while exact < gap.x.algebra.order:
        height = gap.height(time)
        height.coefficients[0] = arb(0)
        time = time - height / gap.slope(time)
        exact = 2 * exact + 1
    return time


def _march(gap, after):
    x, c, s, g = gap.x, gap.c, gap.s, gap.g
    amplitude = (x * x + c * c).sqrt()
    bend = (g + amplitude).upper()
    jerk = amplitude.upper()
    t = _first_step(x, c, s, g, jerk) if after is None else after
    far = _long_flight(gap, amplitude)
    for count in range(_MOST_STEPS):
        if far is not None and far[0] < t < far[1]:
            t = far[1]
        height, slope, curve = gap.at(t)
        if not height < 0:
            break
        if slope > 0:
            high = (t - 2 * height.lower() / slope.lower()).mid()
            if gap.slope(t.union(high)) > 0 and gap.height(high) > 0:
                return t, high
        third_derivative = None if count < _PLAIN_STEPS else gap.third_derivative(t).upper()
        step = _step(height, slope, curve, bend, jerk, third_derivative)
        if not step > abs(t) * arb(2) ** (-ctx.prec // 2):
            break
        t = (t + step).lower()  # at most as far as the parabola is known to be below zero
    raise UndecidedError("the ball may touch the floor earlier: a touch cannot be told from a miss")


def _step(height, slope, curve, bend, jerk, third_derivative=None):
    """A time within which f stays below zero, from f, f', f'' and perhaps f''' here."""
    # f(t + h) <= f + f' h + m h^2/2 for h <= reach, m = min(grown(reach), g + A), or 0
    f, d, m = (float(a) for a in (height.upper(), slope.upper(), bend))
    if not f < 0.0:
        return 0

    def grown(reach):
        if third_derivative is None:
            return (curve + jerk * reach / 3).upper()
        return (curve + (max(third_derivative, arb(0)) + jerk * reach / 4) * reach / 3).upper()

    reach = arb(2.0 * _parabola_root(f, d, m))
    if third_derivative is not None:
        while _parabola_root(f, d, min(m, max(0.0, float(grown(2 * reach))))) > 2 * reach:
            reach *= 2
    flat = grown(reach)
    if flat < bend:
        bend = flat if flat > 0 else arb(0)
    step = arb(min(_BELOW_ROOT * _parabola_root(f, d, float(bend)), float(reach)))
    return step if height + step * (slope + step * bend / 2) < 0 else 0


def _parabola_root(f, d, m):
    """The positive root of f + d h + m h^2/2, f < 0, m >= 0; infinite where there is none."""
    root = math.sqrt(d * d - 2.0 * m * f)
    if d > 0.0:
        return -2.0 * f / (d + root)
    return (root - d) / m if m > 0.0 else math.inf


def _first_step(x, c, s, g, jerk):
    """A time up to which f < 0.

    From f/t <= -s + (g + x) t/2 + A t^2/6, or at s = 0 = g + x from f/t^3 <= -c/6 + A t/24.
    """
    bend = g + x
    if s == 0 and bend == 0:
        t = arb(_BELOW_ROOT) * (4 * c / jerk).lower()
        if not (c > 0 and t > 0):
            raise UndecidedError("the ball may rest on the floor")
        return t.lower()
    if not (s > 0 or (s == 0 and bend < 0)):
        raise UndecidedError("the impact may be grazing: xdot + udot may be zero")
    half, third = bend.upper() / 2, jerk / 6
    root = (half * half + 4 * third * s.lower()).sqrt()
    t = 2 * s.lower() / (half + root) if half > 0 else (root - half) / (2 * third)
    t = (arb(_BELOW_ROOT) * t).mid()
    if not -s + t * (half + t * third) < 0:
        raise UndecidedError("the impact may be grazing: xdot + udot may be zero")
    return t


def _long_flight(gap, amplitude):
    """(from, to) between which f <= x + A + b t + g t^2/2 < 0, or None."""
    b = -gap.s - gap.c
    rest = gap.x + amplitude
    square = b * b - 2 * gap.g * rest
    if not (b < 0 and square > 0):
        return None
    root = square.sqrt()
    low = ((root - b).lower() * arb(2) ** -40 + (-b - root)) / gap.g
    high = (root - b) * arb(_BELOW_ROOT) / gap.g
    low, high = low.mid(), high.mid()
    if not (low < high and all(rest + t * (b + gap.g * t / 2) < 0 for t in (low, high))):
        return None
    return low, high
