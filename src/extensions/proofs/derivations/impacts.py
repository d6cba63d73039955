"""Flight, map, energy and bounds: equations (6), (8), (22) and (26)-(31) of the paper.

v, w are xdot, udot just before an impact, and b, c just after it. Each derivation returns a
Formula: whether the equation holds as printed (None if none is printed), whether it holds corrected
(None without a correction), and a number. `zero` says whether all its arguments vanish.
"""

import sympy as sp

from .symbols import PAPER, E, Formula, T, b, c, energy, flight, g, k, rebound, tau, v, w, x, zero


def flights() -> Formula:
    """Derive (26) and (27)."""
    position, strain = flight(x, b, c, T)
    start = [position, position.diff(T), strain, strain.diff(T)]
    conditions = [position.diff(T, 2) - g, strain.diff(T, 2) + strain]
    conditions += [a.subs(T, 0) - a0 for a, a0 in zip(start, (x, b, -x, c), strict=True)]
    speed = position.diff(T).subs({T: tau, b: rebound(v, w)[0]})
    printed = (speed - (1 - k) / (1 + k) * v + 2 * k / (1 + k) * w) / g - tau
    return Formula(zero(*conditions, printed))


def flow() -> Formula:
    """Derive that the flow between impacts keeps dx ^ dxdot + k du ^ dudot."""
    start = position, strain, speed, rate = sp.symbols("X U xd ud", real=True)
    end = sp.Matrix([
        position + speed * T + g * T**2 / 2,
        strain * sp.cos(T) + rate * sp.sin(T),
        speed + g * T,
        rate * sp.cos(T) - strain * sp.sin(T),
    ])  # fmt: skip
    moved = end.diff(T) - sp.Matrix([end[2], end[3], g, -end[1]])  # it solves (23)
    tangent = end.jacobian(start)
    form = sp.Matrix([[0, 0, 1, 0], [0, 0, 0, k], [-1, 0, 0, 0], [0, -k, 0, 0]])
    return Formula(zero(*moved, *(tangent.T * form * tangent - form)))


def flight_after_impact() -> tuple[sp.Expr, sp.Expr, sp.Expr, sp.Expr]:
    """Return position, xdot, strain and udot a time tau after the impact of x, v and w."""
    speed, rate = rebound(v, w)
    position, strain = flight(x, speed, rate, tau)
    return position, speed + g * tau, strain, strain.diff(tau)


def map_residuals(sign: int) -> tuple[tuple[sp.Symbol, ...], tuple[sp.Expr, ...]]:
    """Return x1, v1, w1 and (28) as residuals in them, with `sign` before 2k/(1+k) w in line 1."""
    x1, v1, w1 = sp.symbols("x1 v1 w1", real=True)
    first = (1 - k) / (1 + k) * v + sign * 2 * k / (1 + k) * w
    angle = (v1 - (1 - k) / (1 + k) * v + 2 * k / (1 + k) * w) / g
    minus_rate = 2 / (1 + k) * v + (1 - k) / (1 + k) * w
    return (x1, v1, w1), (
        g * (x1 - x) - v1**2 / 2 + first**2 / 2,
        x1 - x * sp.cos(angle) - minus_rate * sp.sin(angle),
        w1 - x * sp.sin(angle) + minus_rate * sp.cos(angle),
    )


def impact_map() -> Formula:
    """Derive (28), with the other sign in its first line."""
    position, speed, strain, rate = flight_after_impact()
    holds = []
    for sign in (1, -1):  # as printed, and corrected
        (x1, v1, w1), lines = map_residuals(sign)
        # the first line is about the centre, the others about the strain, u = -x at an impact
        pairs = zip(lines, (position, -strain, -strain), strict=True)
        holds.append(zero(*(line.subs({x1: place, v1: speed, w1: rate}) for line, place in pairs)))
    return Formula(*holds)


def conserved_energy() -> Formula:
    """Derive (29): the flight keeps the energy, and its surface is an ellipsoid."""
    position, strain = flight(x, b, c, tau)
    whole = position.diff(tau) ** 2 / 2 + k * strain.diff(tau) ** 2 / 2
    whole += -g * position + k * strain**2 / 2
    hessian = sp.hessian(energy(x, v, w), (x, v, w))
    convex = all(value.is_positive for value in hessian.eigenvals())
    return Formula(zero(whole - energy(x, b, c)) and convex)


def _end_of_section(sign: int) -> sp.Expr:
    """Return the largest (sign 1) or the smallest (sign -1) x on an energy surface."""
    return g / k + sign * sp.sqrt(2 * E / k + g**2 / k**2)


def energy_bound() -> Formula:
    """Check that (31) keeps x below 1: as printed for every g, corrected for g < k.

    The value is k/2 - g at k = 0.2, g = 0.04. The product (30) is negative between x = 2 g/k - 1
    and x = 1, not for all x < 1.
    """
    potential = k * x**2 / 2 - g * x
    limit = k / 2 - g
    largest = _end_of_section(1)
    follows = zero(
        potential - limit - k / 2 * (x - 1) * (x + 1 - 2 * g / k),
        potential.subs(x, largest) - E,
    )
    excess = sp.symbols("excess", positive=True)
    at_limit = largest.subs(E, limit)
    if_g_below_k = sp.simplify(at_limit.subs(k, g + excess)) == 1
    if_g_above_k = sp.simplify(at_limit.subs(g, k + excess)) == 1
    corrected = follows and if_g_below_k
    return Formula(corrected and if_g_above_k, corrected, float(limit.subs(PAPER)))


def bound_in_flight() -> Formula:
    """Derive (6), u > -1, in flight: the amplitude of u is at most the largest x at an impact."""
    square = sp.solve(energy(x, b, c) - E, c)[0] ** 2 + x**2
    strain, largest = flight(x, b, c, T)[1], _end_of_section(1)
    holds = zero(
        square - (2 * (E + g * x) - b**2) / k,
        2 * (E + g * largest) / k - largest**2,
        strain**2 + strain.diff(T) ** 2 - (x**2 + c**2),
    )
    return Formula(holds and bool(sp.diff(2 * (E + g * x) / k, x) > 0))


def smooth() -> Formula:
    """Derive the energy up to which no flight can touch the floor; value: at k = 0.2, g = 0.04.

    At a touch the gap f = x + u has f = f' = 0: a state on the rim, where f'' = g + x <= 0. At this
    energy the smallest x is -g.
    """
    energies = sp.solve(_end_of_section(-1) + g, E)
    threshold = g**2 * (1 + k / 2)
    holds = len(energies) == 1 and zero(energies[0] - threshold)
    return Formula(None, holds, float(threshold.subs(PAPER)))


def contact_speed() -> Formula:
    """Check (8) and (22). Printed: the contact speed is positive. Corrected: it is not negative.

    The gap x + u is negative before an impact, so its slope at zero, the contact speed, is not
    negative. It is 0 at a grazing impact: the rim v + w = 0 has states of every energy above the
    lowest.
    """
    speed = sp.solve(energy(x, v, -v) - E, v)
    inside = PAPER | {x: 0, E: sp.Rational(1, 100)}
    grazing = any(s.subs(inside).is_real and s.subs(inside) != 0 for s in speed)
    return Formula(not grazing, grazing)
