"""Proved flight times, orbits and errors of impacts, of states given as doubles.

A state of three doubles need not lie on a given energy surface; it is taken exactly as it is, and
so are the doubles k and g of a ball. Where the precision does not decide which impact is the first,
it is raised.
"""

from collections.abc import Callable

import numpy as np
from flint import arb, ctx

from pseudorigid.dynamics.ball import Ball, State

from .enclosure.flight import UndecidedError, launch
from .enclosure.surface import Exact, ball_of, exact

_START_BITS, _MOST_BITS = 256, 8192  # a touch closer than 1e-2000 is not decided
_ACCURACY_BITS = 150  # of a proved flight time: nearly three times a double's
_ORBIT_BITS = 512  # an impact in the chaotic sea loses a third of a bit: enough for 1,000 impacts
_IMPACT_BITS = 96  # at first: a double's 53, and room for cancellation

Number = float | arb


def first_root(k: Number, g: Number, x: Number, v: Number, w: Number) -> arb:
    """Prove the time of the next impact: the smallest t > 0 with f(t) = 0, eq. (21) with (26).

    x, v, w are a state just before an impact with v + w >= 0. The result has a relative radius of
    at most 2**-150; it is 0 where the ball is pressed onto the floor. Raises ArithmeticError if a
    root is double, as far as the last bits can tell.
    """

    def flight_time() -> arb | None:
        tau = _impact(*map(arb, (k, g, x, v, w)))[3]
        return tau if tau == 0 or tau.rel_accuracy_bits() >= _ACCURACY_BITS else None

    tau = _decided(flight_time, _START_BITS)
    if tau is None:
        raise ArithmeticError("the reference solver cannot tell a touch from a miss")
    return tau


def _decided(compute: Callable[[], arb | None], bits: int) -> arb | None:
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


def _impact(k: arb, g: arb, x: arb, v: arb, w: arb) -> tuple[arb, arb, arb, arb]:
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
            x, v, w = (a.mid() for a in _impact(k, g, x, v, w)[:3])
            rows.append((float(x), float(v), float(w)))
    return rows


def impact_errors(
    k: Exact,
    g: Exact,
    before: np.ndarray,
    after: np.ndarray,
    tau: np.ndarray,
    progress: Callable[[int], None] | None = None,
) -> np.ndarray:
    """Bound the errors of impacts that were computed in doubles, for an exact ball.

    `before` and `after`, shape (3, n), have x, xdot, udot just before an impact and just before the
    next one, and `tau` the durations of the flights. Returns upper bounds (n,) of the largest error
    of x', xdot', udot' and tau, with `before` taken as exact; infinite where the next impact is not
    proved. `progress` is called with the number of impacts done. Raises ValueError if k or g is not
    an exact number.
    """
    ball = exact("k", k), exact("g", g)
    bounds = np.full(tau.size, np.inf)
    for i, row in enumerate(np.vstack((before, after, tau)).T.tolist()):
        if progress is not None:
            progress(i)

        def error(state: list[float] = row[:3], computed: list[float] = row[3:]) -> arb:
            proved = _impact(*map(ball_of, ball), *map(arb, state))
            errors = [abs(a - b).upper() for a, b in zip(proved, computed, strict=True)]
            return max(errors) if all(it.is_finite() for it in errors) else arb("inf")

        if (largest := _decided(error, _IMPACT_BITS)) is not None:
            bounds[i] = np.nextafter(float(largest), np.inf)
    return bounds
