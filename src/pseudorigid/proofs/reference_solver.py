"""The judge: flight times, orbits and impacts of doubles, proved in ball arithmetic.

A state of three doubles need not lie on any one energy surface: here it is taken as it is. Where
the precision does not decide which impact is first, it is raised.
"""

import numpy as np
from flint import arb, ctx

from .enclosure.flight import Gap, UndecidedError, isolate, refine
from .enclosure.surface import ball_of, exact

# At first, and where a touch of the floor is given up: it would be closer than 1e-2000.
START_BITS, MOST_BITS = 256, 8192
ACCURACY = 150  # bits of a flight time that are proved: nearly three times a double's
ORBIT_BITS = 512  # a third of a bit is lost an impact in the sea: good for 1,000 impacts
IMPACT_BITS = 96  # at first: a double's 53, and room for what cancels


def first_root(k, g, x, v, w):
    """The time of the next impact, proved: the smallest t > 0 with f(t) = 0, eq. (21) with (26).

    Parameters
    ----------
    k, g : float or arb
        The ball.
    x, v, w : float or arb
        A state just before an impact: x (R), xdot (R omega), udot (omega), v + w >= 0.

    Returns
    -------
    arb
        With a relative radius of at most 2**-150 (1/omega); 0 where the ball is pressed onto the
        floor.

    Raises
    ------
    ArithmeticError
        Where a root is double, as far as MOST_BITS can tell.
    """
    bits = START_BITS
    while bits <= MOST_BITS:
        with ctx.workprec(bits):
            try:
                root = _time(_after_impact(*(arb(a) for a in (k, g, x, v, w))))
                if root == 0 or root.rel_accuracy_bits() >= ACCURACY:
                    return root
            except UndecidedError:
                pass
        bits *= 2
    raise ArithmeticError("the judge cannot tell a touch from a miss")


def _after_impact(k, g, x, v, w):
    """The gap after the impact of a state, eq. (25)."""
    s = v + w
    return Gap(x, w - 2 * s / (1 + k), s, g)


def _time(gap):
    """The time of the next impact, 0 where the ball is pressed onto the floor."""
    bend = gap.g + gap.x
    if gap.s == 0 and (bend > 0 or (bend == 0 and gap.c <= 0)):
        return arb(0)
    return refine(gap, *isolate(gap))


def flight_times(ball, x, xdot, udot):
    """The proved flight time of each state.

    Parameters
    ----------
    ball : Ball
        Its k and g are taken as the doubles that they are.
    x, xdot, udot : ndarray, shape (n,)
        States just before an impact.

    Returns
    -------
    list of float
        tau (1/omega), rounded to a double.

    Raises
    ------
    ArithmeticError
        Where a touch of the floor cannot be told from a miss.
    """
    states = zip(x.tolist(), xdot.tolist(), udot.tolist(), strict=True)
    return [float(first_root(ball.k, ball.g, *state)) for state in states]


def orbit(ball, state, impacts):
    """The orbit of a state, computed to 512 bits.

    Parameters
    ----------
    ball : Ball
        Its k and g are taken as the doubles that they are.
    state : (float, float, float)
        x, xdot, udot just before an impact.
    impacts : int

    Returns
    -------
    list of (float, float, float)
        x, xdot, udot of each impact, the start excluded, rounded at the end.

    Raises
    ------
    UndecidedError
        Where a flight grazes to within the precision.
    """
    rows = []
    with ctx.workprec(ORBIT_BITS):
        k, g = arb(ball.k), arb(ball.g)
        x, v, w = (arb(float(a)) for a in state)
        for _ in range(impacts):
            x, v, w = (a.mid() for a in _impact(k, g, x, v, w)[:3])
            rows.append((float(x), float(v), float(w)))
    return rows


def impact_errors(k, g, before, after, tau):
    """Prove impacts that were computed in doubles: each the first one, with a bound on its error.

    Parameters
    ----------
    k, g : int, Fraction, Decimal or str
        The ball, exact.
    before, after : ndarray, shape (3, n)
        x, xdot, udot just before an impact and just before the next one, as computed.
    tau : ndarray, shape (n,)
        The flights' times (1/omega), as computed.

    Returns
    -------
    ndarray, shape (n,)
        Upper bounds of the largest error of x', xdot', udot' and tau, `before` taken as exact;
        infinite where the next impact is not proved.

    Raises
    ------
    ValueError
        A k or g that is no exact number.
    """
    exact_k, exact_g = exact("k", k), exact("g", g)
    bounds = np.full(tau.size, np.inf)
    columns = (*before.tolist(), *after.tolist(), tau.tolist())
    for i, (x, v, w, *found) in enumerate(zip(*columns, strict=True)):
        bits = IMPACT_BITS
        while bits <= MOST_BITS:
            with ctx.workprec(bits):
                try:
                    truth = _impact(ball_of(exact_k), ball_of(exact_g), arb(x), arb(v), arb(w))
                except UndecidedError:
                    bits *= 2
                    continue
                worst = max(abs(a - b).upper() for a, b in zip(truth, found, strict=True))
                bounds[i] = np.nextafter(float(worst), np.inf)
                break
    return bounds


def _impact(k, g, x, v, w):
    """(x', v', w', tau) of the next impact."""
    gap = _after_impact(k, g, x, v, w)
    tau = _time(gap)
    if tau == 0:
        return x, v, w, tau
    sine, cosine = tau.sin_cos()
    b = v - 2 * k * gap.s / (1 + k)
    return x * cosine - gap.c * sine, b + g * tau, x * sine + gap.c * cosine, tau
