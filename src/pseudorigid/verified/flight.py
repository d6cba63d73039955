"""One flight in ball arithmetic: the gap, its first root with a proof, and the state at its end.

After an impact the gap is f(t) = -s t + g t^2/2 + c (sin t - t) + x (1 - cos t), which is eq. (21)
with (26) and s = -(b + c); every parameter enters once. The march steps from root to root of
parabolas that lie above f.
"""

import math
from dataclasses import dataclass
from typing import Any

from flint import arb, ctx

_MARCH_BITS = 64  # one machine word: a march needs more only if the ball nearly touches the floor
# A step is shortened by far more than the rounding of the parabola's root, so that the check in
# ball arithmetic that the parabola is negative there succeeds.
_STEP_FACTOR = 1.0 - 1e-6
_START_FACTOR = 1 - arb(2) ** -20  # of the first step from the rim, for the same reason
# The first steps bound f'' alone, the later ones f''' too: near grazing the first kind crawls. It
# comes first because the certificates state margins that it gives.
_PLAIN_STEPS, _MOST_STEPS = 400, 800


class NotProvedError(Exception):
    """The reason why a statement is not taken as proved."""


class UndecidedError(NotProvedError, ArithmeticError):
    """A question that cannot be decided for this set of states at this precision."""


@dataclass(frozen=True)
class Flight:
    """Flights after an impact, eq. (26), and their gap f(t), eq. (21).

    x, b = xdot and c = udot are those after the impact, s = xdot + udot is that before it. They and
    the times are arb, acb, or series of these; g is an arb. `first_root` needs arb alone.
    """

    x: Any
    b: Any
    c: Any
    s: Any
    g: arb

    def derivatives(self, t: Any) -> tuple[Any, Any, Any, Any]:
        """Return f, f', f'' and f''' at t."""
        sine, cosine = t.sin_cos()
        x, c = self.x, self.c
        height, slope = self.height_and_slope(t, sine, cosine)
        return height, slope, self.g + x * cosine - c * sine, -x * sine - c * cosine

    def height(self, t: Any) -> Any:
        """Return f at t."""
        return self.height_and_slope(t, *t.sin_cos())[0]

    def slope(self, t: Any) -> Any:
        """Return f' at t."""
        return self.height_and_slope(t, *t.sin_cos())[1]

    def height_and_slope(self, t: Any, sine: Any, cosine: Any) -> tuple[Any, Any]:
        """Return f and f' at t, from sine and cosine of t."""
        versine = 1 - cosine
        height = t * (self.g * t / 2 - self.s) + self.c * (sine - t) + self.x * versine
        return height, self.g * t - self.s - self.c * versine + self.x * sine

    def end(self, tau: Any) -> tuple[Any, Any, Any]:
        """Return x, xdot and udot at the end of flights of this duration, eq. (28)."""
        sine, cosine = tau.sin_cos()
        x, c = self.x, self.c
        return x * cosine - c * sine, self.b + self.g * tau, x * sine + c * cosine

    def rounded(self) -> "Flight":
        """Return the flights in balls of the context's precision."""
        return Flight(+self.x, +self.b, +self.c, +self.s, +self.g)

    def first_root(self) -> arb:
        """Enclose the time of the next impact: the smallest t > 0 with f(t) = 0.

        The ball contains the first root, which is simple, for every choice of parameters in the
        balls (arb). Raises UndecidedError where an earlier touch of the floor cannot be excluded, g
        may not be positive, or s may be zero, except s = 0 with x < -g, or with x = -g and c > 0.
        """
        return _refine(self, *_isolate(self))


def launch(k: arb, g: arb, x: Any, v: Any, w: Any, s: Any) -> Flight:
    """Return the flight after an impact at x with the velocities v and w, eq. (25).

    s is v + w, which the sum of two balls would round.
    """
    return Flight(x, v - 2 * k * s / (1 + k), w - 2 * s / (1 + k), s, g)


def flight_from_rim(g: arb, xdot: arb, beyond: arb) -> tuple[Flight, arb]:
    """Return flights from points of the rim, s = 0, x = -g - beyond, and their first root.

    Raises UndecidedError as `first_root` does, and where not beyond >= 0: there the ball stays on
    the floor, or the bound of the first step does not hold.
    """
    if not beyond >= 0:
        raise UndecidedError("a point of the rim may have x > -g")
    flight, start = Flight(-g - beyond, xdot, -xdot, arb(0), g), None
    if xdot < 0:  # f/t^2 <= -beyond/2 + xdot t/6 + A t^2/24
        amplitude = (flight.x * flight.x + xdot * xdot).sqrt()
        start = (_START_FACTOR * -4 * xdot / amplitude).lower()
    return flight, _refine(flight, *_isolate(flight, start))


def _isolate(flight: Flight, start: arb | None = None) -> tuple[arb, arb]:
    """Return exact low, high: f < 0 on (0, low], f' > 0 on (low, high) and f(high) > 0.

    `start` is a time up to which f < 0 is known.
    """
    if not flight.g > 0:  # else parabolas need not be convex
        raise UndecidedError("g is not proved to be positive")
    most, bits = ctx.prec, _MARCH_BITS
    while True:
        with ctx.workprec(bits):
            try:
                return _march(flight.rounded(), start)
            except UndecidedError:
                if bits >= most:
                    raise
        bits = min(2 * bits, most)


def _refine(flight: Flight, low: arb, high: arb) -> arb:
    """Narrow a root by interval Newton, T = t - f(t)/f'(T), with twice the bits at each level."""
    root = low.union(high)
    levels = [ctx.prec]
    while levels[-1] > 2 * _MARCH_BITS:
        levels.append(levels[-1] // 2 + 8)
    for bits in reversed(levels):
        with ctx.workprec(bits):
            at_level, better = flight.rounded(), True
            while better and (slope := at_level.slope(root)) > 0:
                middle = root.mid()
                narrow = (middle - at_level.height(middle) / slope).intersection(root)
                better = (
                    narrow.rad() < root.rad() * 0.75 and narrow.rel_accuracy_bits() <= bits - 16
                )
                root = narrow
    if better:  # not one step with all bits
        raise UndecidedError("two impacts may be one: the slope of the gap may vanish")
    return root


def _march(flight: Flight, start: arb | None) -> tuple[arb, arb]:
    """Isolate the first root at the context's precision."""
    amplitude = (flight.x * flight.x + flight.c * flight.c).sqrt()
    curvature_bound, jerk_bound = (flight.g + amplitude).upper(), amplitude.upper()
    t = _first_step(flight, jerk_bound) if start is None else start
    negative = _long_flight(flight, amplitude)
    for count in range(_MOST_STEPS):
        if negative is not None and negative[0] < t < negative[1]:
            t = negative[1]
        height, slope, curvature, jerk = flight.derivatives(t)
        if not height < 0:
            break
        if slope > 0:
            high = (t - 2 * height.lower() / slope.lower()).mid()
            if flight.slope(t.union(high)) > 0 and flight.height(high) > 0:
                return t, high
        known_jerk = None if count < _PLAIN_STEPS else jerk.upper()
        step = _step(height, slope, curvature, known_jerk, curvature_bound, jerk_bound)
        if not step > abs(t) * arb(2) ** (-ctx.prec // 2):
            break
        t = (t + step).lower()  # the parabola is known to be negative up to here
    raise UndecidedError("the ball may touch the floor earlier: a touch cannot be told from a miss")


def _step(
    height: arb, slope: arb, curvature: arb, jerk: arb | None, curvature_bound: arb, jerk_bound: arb
) -> arb:
    """Return a time within which f stays negative, from f, f', f'' and perhaps f''' here, or 0."""
    # f(t + h) <= f + f' h + m h^2/2 for h <= reach, m = min(mean_curvature(reach), g + A)
    f, d, m = (float(a) for a in (height.upper(), slope.upper(), curvature_bound))
    if not f < 0.0:
        return arb(0)

    def mean_curvature(reach: arb) -> arb:
        if jerk is None:
            return (curvature + jerk_bound * reach / 3).upper()
        growth = max(jerk, arb(0)) + jerk_bound * reach / 4
        return (curvature + growth * reach / 3).upper()

    reach = arb(2.0 * _parabola_root(f, d, m))
    if jerk is not None:
        while _parabola_root(f, d, min(m, max(0.0, float(mean_curvature(2 * reach))))) > 2 * reach:
            reach *= 2
    bound = mean_curvature(reach)
    if bound < curvature_bound:
        curvature_bound = bound if bound > 0 else arb(0)
    root = _parabola_root(f, d, float(curvature_bound))
    step = arb(min(_STEP_FACTOR * root, float(reach)))
    return step if height + step * (slope + step * curvature_bound / 2) < 0 else arb(0)


def _parabola_root(f: float, d: float, m: float) -> float:
    """Return the positive root of f + d h + m h^2/2, f < 0 and m >= 0; infinity if none."""
    root = math.sqrt(d * d - 2.0 * m * f)
    if d > 0.0:
        return -2.0 * f / (d + root)
    return (root - d) / m if m > 0.0 else math.inf


def _first_step(flight: Flight, jerk_bound: arb) -> arb:
    """Return a time up to which f < 0.

    f/t <= -s + (g + x) t/2 + A t^2/6; where s = 0 = g + x, f/t^3 <= -c/6 + A t/24.
    """
    s, curvature = flight.s, flight.g + flight.x
    if s == 0 and curvature == 0:
        t = arb(_STEP_FACTOR) * (4 * flight.c / jerk_bound).lower()
        if not (flight.c > 0 and t > 0):
            raise UndecidedError("the ball may rest on the floor")
        return t.lower()
    if not (s > 0 or (s == 0 and curvature < 0)):
        raise UndecidedError("the impact may be grazing: xdot + udot may be zero")
    half, third = curvature.upper() / 2, jerk_bound / 6
    root = (half * half + 4 * third * s.lower()).sqrt()
    t = 2 * s.lower() / (half + root) if half > 0 else (root - half) / (2 * third)
    t = (arb(_STEP_FACTOR) * t).mid()
    if not -s + t * (half + t * third) < 0:
        raise UndecidedError("the impact may be grazing: xdot + udot may be zero")
    return t


def _long_flight(flight: Flight, amplitude: arb) -> tuple[arb, arb] | None:
    """Return the interval on which f <= x + A + b t + g t^2/2 < 0, or None."""
    b = -flight.s - flight.c
    height = flight.x + amplitude
    square = b * b - 2 * flight.g * height
    if not (b < 0 and square > 0):
        return None
    root = square.sqrt()
    low = ((root - b).lower() * arb(2) ** -40 + (-b - root)) / flight.g
    high = (root - b) * arb(_STEP_FACTOR) / flight.g
    low, high = low.mid(), high.mid()
    if not (low < high and all(height + t * (b + flight.g * t / 2) < 0 for t in (low, high))):
        return None
    return low, high
