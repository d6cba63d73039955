"""Proved flight times and orbits of states given as doubles.

A state of three doubles need not lie on a given energy surface; it is taken exactly as it is, and
so are the doubles k and g of a ball. Where the precision does not decide which impact is the first,
it is raised.
"""

from collections.abc import Callable

from flint import arb, ctx

from pseudorigid.dynamics.ball import Ball, State

from .flight import UndecidedError, launch

_START_BITS, _MOST_BITS = 256, 8192  # a touch closer than 1e-2000 is not decided
_ACCURACY_BITS = 150  # of a proved flight time: nearly three times a double's
_ORBIT_BITS = 512  # an impact in the chaotic sea loses a third of a bit: enough for 1,000 impacts

Number = float | arb


def first_root(k: Number, g: Number, x: Number, v: Number, w: Number) -> arb:
    """Prove the time of the next impact: the smallest t > 0 with f(t) = 0, eq. (21) with (26).

    x, v, w are a state just before an impact with v + w >= 0. The result has a relative radius of
    at most 2**-150; it is 0 where the ball is pressed onto the floor. Raises ArithmeticError if a
    root is double, as far as the last bits can tell.
    """

    def flight_time() -> arb | None:
        tau = impact(*map(arb, (k, g, x, v, w)))[3]
        return tau if tau == 0 or tau.rel_accuracy_bits() >= _ACCURACY_BITS else None

    tau = decided(flight_time, _START_BITS)
    if tau is None:
        raise ArithmeticError("the reference solver cannot tell a touch from a miss")
    return tau


def decided(compute: Callable[[], arb | None], bits: int) -> arb | None:
    """Return the first result that is not None, with bits doubled from these on, or None."""
    while bits <= _MOST_BITS:
        with ctx.workprec(bits):
            try:
                if (result := compute()) is not None:
                    return result
            except UndecidedError:
                pass
        bits *= 2
    return None


def impact(k: arb, g: arb, x: arb, v: arb, w: arb) -> tuple[arb, arb, arb, arb]:
    """Return x', v', w' and tau of the next impact; tau = 0 where the ball is pressed down."""
    flight, curvature = launch(k, g, x, v, w, v + w), g + x
    if flight.s == 0 and (curvature > 0 or (curvature == 0 and flight.c <= 0)):
        return x, v, w, arb(0)
    tau = flight.first_root()
    return *flight.end(tau), tau


def orbit(ball: Ball, state: State, impacts: int) -> list[tuple[float, float, float]]:
    """Compute the orbit of a state to 512 bits.

    Returns x, xdot, udot of each impact without the start, rounded to doubles. Raises
    UndecidedError where a flight may graze.
    """
    rows = []
    with ctx.workprec(_ORBIT_BITS):
        k, g = arb(ball.k), arb(ball.g)
        x, v, w = (arb(float(a)) for a in state)
        for _ in range(impacts):
            x, v, w = (a.mid() for a in impact(k, g, x, v, w)[:3])
            rows.append((float(x), float(v), float(w)))
    return rows
