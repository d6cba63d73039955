"""Proved flight times, orbits and errors of impacts, of states given as doubles.

A state of three doubles need not lie on a given energy surface; it is taken exactly as it is. Where
the precision does not decide which impact is the first, it is raised.
"""

from collections.abc import Sequence

import numpy as np
from flint import arb, ctx

from .enclosure import flight
from .enclosure.flight import UndecidedError
from .enclosure.surface import Exact, ball_of, exact

_START_BITS, _MOST_BITS = 256, 8192  # a touch closer than 1e-2000 is not decided
_ACCURACY_BITS = 150  # of a proved flight time: nearly three times a double's
_ORBIT_BITS = 512  # an impact in the chaotic sea loses a third of a bit: enough for 1,000 impacts
_IMPACT_BITS = 96  # at first: a double's 53, and room for cancellation

Number = float | arb


def first_root(k: Number, g: Number, x: Number, v: Number, w: Number) -> arb:
    """Prove the time of the next impact: the smallest t > 0 with f(t) = 0, eq. (21) with (26).

    Parameters
    ----------
    k, g, x, v, w
        The ball, and a state just before an impact with v + w >= 0.

    Returns
    -------
    arb
        With a relative radius of at most 2**-150; 0 where the ball is pressed onto the floor.

    Raises
    ------
    ArithmeticError
        A root is double, as far as the last bits can tell.
    """
    bits = _START_BITS
    while bits <= _MOST_BITS:
        with ctx.workprec(bits):
            try:
                tau = _impact(*(arb(a) for a in (k, g, x, v, w)))[3]
                if tau == 0 or tau.rel_accuracy_bits() >= _ACCURACY_BITS:
                    return tau
            except UndecidedError:
                pass
        bits *= 2
    raise ArithmeticError("the reference solver cannot tell a touch from a miss")


def _impact(k: arb, g: arb, x: arb, v: arb, w: arb) -> tuple[arb, arb, arb, arb]:
    """Return x', v', w' and tau of the next impact; tau = 0 where the ball is pressed down."""
    b, c, s = flight.rebound(k, v, w)
    curvature = g + x
    if s == 0 and (curvature > 0 or (curvature == 0 and c <= 0)):
        return x, v, w, arb(0)
    return flight.fly(x, b, c, s, g)


def flight_times(ball, x: np.ndarray, xdot: np.ndarray, udot: np.ndarray) -> list[float]:
    """Return the proved flight time of each state, rounded to a double.

    The doubles k and g of the ball are taken as exact. Raises ArithmeticError where a touch of the
    floor cannot be told from a miss.
    """
    states = zip(x.tolist(), xdot.tolist(), udot.tolist(), strict=True)
    return [float(first_root(ball.k, ball.g, *state)) for state in states]


def orbit(ball, state: Sequence[float], impacts: int) -> list[tuple[float, float, float]]:
    """Compute the orbit of a state to 512 bits.

    The doubles k and g of the ball are taken as exact. Returns x, xdot, udot of each impact without
    the start, rounded to doubles. Raises UndecidedError where a flight may graze.
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
    k: Exact, g: Exact, before: np.ndarray, after: np.ndarray, tau: np.ndarray
) -> np.ndarray:
    """Bound the errors of impacts that were computed in doubles.

    Parameters
    ----------
    k, g
        The ball, exact.
    before, after : ndarray, shape (3, n)
        x, xdot, udot just before an impact and just before the next one, as computed.
    tau : ndarray, shape (n,)
        Durations of the flights, as computed.

    Returns
    -------
    ndarray, shape (n,)
        Upper bounds of the largest error of x', xdot', udot' and tau, with `before` taken as exact;
        infinite where the next impact is not proved.

    Raises
    ------
    ValueError
        k or g is not an exact number.
    """
    exact_k, exact_g = exact("k", k), exact("g", g)
    bounds = np.full(tau.size, np.inf)
    columns = (*before.tolist(), *after.tolist(), tau.tolist())
    for i, (x, v, w, *computed) in enumerate(zip(*columns, strict=True)):
        bits = _IMPACT_BITS
        while bits <= _MOST_BITS:
            with ctx.workprec(bits):
                try:
                    proved = _impact(ball_of(exact_k), ball_of(exact_g), arb(x), arb(v), arb(w))
                except UndecidedError:
                    bits *= 2
                    continue
                error = max(abs(a - b).upper() for a, b in zip(proved, computed, strict=True))
                bounds[i] = np.nextafter(float(error), np.inf)
                break
    return bounds
