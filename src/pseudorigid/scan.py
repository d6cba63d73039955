"""The paper's way to the next impact, for comparison: steps of constant length until the gap
changes sign, then bisection (the paper: "a variant of the bisection method").

A scan can step over an impact. The ball then passes through the floor, and its energy does not
show it; so every flight is also computed by the certified march, and those that came too late are
counted.
"""

import math
from dataclasses import dataclass
from functools import cached_property

from .arithmetic import sincos
from .ball import Ball
from .compiled import jit
from .flight import first_impact
from .impact import flight_derivatives, rebound, tangent, transfer

# A flight takes some 3 time units; a scan that needs more steps than this gives up.
MOST = 50_000_000
# Where the ball all but touches the floor, the first impact is known to the root of a rounding.
TOUCH = 1e-6


@jit
def gap(t, x, b, c, g):
    """f(t) of eq. (21) as it stands in the paper."""
    sine, cosine = sincos(t)
    return (x + t * (b + 0.5 * g * t)) + (c * sine - x * cosine)


@jit
def scan(x, b, c, g, step, tolerance):
    """(tau, evaluations) of the flight from x with velocities b, c.

    The bisection ends with a bracket no longer than the tolerance, or of neighbouring doubles. NaN
    where the gap does not change sign within MOST steps, and for input that is not finite.
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
def flight(x, b, c, s, g, how):
    """The flight from x with velocities b, c, s = -(b + c): (tau, P, Q, missed).

    `how` is (step, tolerance); missed is 1 where an earlier impact was flown past. Raises
    ArithmeticError where the scan ends without an impact.
    """
    step, tolerance = how
    tau, count = scan(x, b, c, g, step, tolerance)
    if math.isnan(tau) and count:
        raise ArithmeticError("the scan for the next impact does not end")
    first, _, _, _ = first_impact(x, b, c, s, g)
    sine, cosine = sincos(tau)
    missed = 1 if tau > first + tolerance + TOUCH else 0
    return tau, x * cosine - c * sine, x * sine + c * cosine, missed


@jit
def step(x, v, w, k, g, head, low, how):
    """(x', v', w', tau, missed): the state just before the impact that the scan finds."""
    b, c, s = rebound(v, w, k, head, low)
    tau, p, q, missed = flight(x, b, c, s, g, how)
    v = b + g * tau
    return p, v, max(q, -v), tau, missed


@jit
def step_with_flight(x, v, w, k, g, head, low, how):
    """`step` with what `impact.tangent` needs: the scan's counterpart of that of `impact`."""
    b, c, s = rebound(v, w, k, head, low)
    p, v, q, tau, missed = step(x, v, w, k, g, head, low, how)
    sine, cosine, tau_x, tau_s, tau_c = flight_derivatives(x, b, c, s, g, tau)
    return p, v, q, tau, sine, cosine, tau_x, tau_s, tau_c, missed


@jit
def _steps(x, v, w, k, g, impacts, tau, how):
    head, low = transfer(k)
    missed = 0
    for i in range(x.size):
        for _ in range(impacts):
            x[i], v[i], w[i], tau[i], late = step(x[i], v[i], w[i], k, g, head, low, how)
            missed += late
    return missed


@jit
def _steps_back(x, v, w, k, g, impacts, tau, how):
    head, low = transfer(k)
    missed = 0
    for i in range(x.size):
        for _ in range(impacts):
            tau[i], p, q, late = flight(x[i], -v[i], -w[i], v[i] + w[i], g, how)
            b, c, _ = rebound(g * tau[i] - v[i], q, k, head, low)
            x[i], v[i], w[i] = p, -b, max(-c, b)
            missed += late
    return missed


@jit
def _history(x, v, w, k, g, out, how):
    head, low = transfer(k)
    missed = 0
    for i in range(x.size):
        a, b, c = x[i], v[i], w[i]
        for j in range(out.shape[1]):
            a, b, c, t, late = step(a, b, c, k, g, head, low, how)
            out[i, j, 0], out[i, j, 1], out[i, j, 2], out[i, j, 3] = a, b, c, t
            missed += late
        x[i], v[i], w[i] = a, b, c
    return missed


@jit
def _jacobians(x, v, w, k, g, impacts, out, how):
    head, low = transfer(k)
    missed = 0
    for i in range(x.size):
        a, b, c = x[i], v[i], w[i]
        for m in range(3):
            for j in range(3):
                out[i, m, j] = 1.0 if m == j else 0.0
        for _ in range(impacts):
            a, b, c, _, sine, cosine, tau_x, tau_s, tau_c, late = step_with_flight(
                a, b, c, k, g, head, low, how
            )
            missed += late
            for j in range(3):
                out[i, 0, j], out[i, 1, j], out[i, 2, j] = tangent(
                    out[i, 0, j], out[i, 1, j], out[i, 2, j],
                    k, g, head, low, a, c, sine, cosine, tau_x, tau_s, tau_c,
                )  # fmt: skip
    return missed


class ScannedMap:
    """The loops of `impact` over the scan's flights, and how many impacts those missed so far."""

    def __init__(self, step, tolerance):
        self.how = float(step), float(tolerance)
        self.impacts = 0
        self.missed = 0

    def steps(self, x, v, w, k, g, impacts, tau):
        """`ensemble.steps`."""
        self.count(impacts * x.size, _steps(x, v, w, k, g, impacts, tau, self.how))

    def steps_back(self, x, v, w, k, g, impacts, tau):
        """`impact.steps_back`."""
        self.count(impacts * x.size, _steps_back(x, v, w, k, g, impacts, tau, self.how))

    def history(self, x, v, w, k, g, out):
        """`ensemble.history`."""
        self.count(out.shape[1] * x.size, _history(x, v, w, k, g, out, self.how))

    def jacobians(self, x, v, w, k, g, impacts, out):
        """`impact.jacobians`, along the scan's own orbits."""
        self.count(impacts * x.size, _jacobians(x, v, w, k, g, impacts, out, self.how))

    def count(self, impacts, missed):
        """Add to the impacts that were computed, and to those that were flown past."""
        self.impacts += impacts
        self.missed += missed


@dataclass(frozen=True)
class ScannedBall(Ball):
    """A Ball whose flights are found by the paper's scan and bisection.

    Args:
        step: the scan's step in time, 0 < step < inf.
        tolerance: the length at which the bisection ends, 0 < tolerance < inf.

    `map.missed` of `map.impacts` impacts that it computed so far were flown past.
    """

    step: float
    tolerance: float

    def __post_init__(self):
        super().__post_init__()
        for name in ("step", "tolerance"):
            value = getattr(self, name)
            if not 0.0 < value < math.inf:
                raise ValueError(f"{name} = {value!r} is not allowed: above 0, finite")

    @cached_property
    def map(self):
        return ScannedMap(self.step, self.tolerance)

    @property
    def scan(self):
        return self.map.how
