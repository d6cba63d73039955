"""Jacobian, exponents, one-form and area: equations (32)-(42) of the paper."""

from collections.abc import Iterator

import sympy as sp

from .impacts import flight_after_impact, map_residuals
from .symbols import Formula, action, b, c, energy, flight, g, k, rebound, tau, v, w, x, zero

DIRECTION = sp.symbols("dx dv dw", real=True)
_DIGITS = 40
_SMALL = sp.Float("1e-25")  # differences that are only rounding


def tangent_map() -> list[sp.Expr]:
    """Tangent map of one impact and flight on DIRECTION, by implicit differentiation of f = 0."""
    position, speed, strain, rate = flight_after_impact()
    gap = position + strain
    pairs = list(zip((x, v, w), DIRECTION, strict=True))
    dtau = -sum(gap.diff(a) * d for a, d in pairs) / gap.diff(tau)
    new = (-strain, speed, rate)
    return [sum(n.diff(a) * d for a, d in pairs) + n.diff(tau) * dtau for n in new]


def jacobian_matrix() -> sp.Matrix:
    """Jacobian matrix (33) of the map."""
    rows = map(sp.expand, tangent_map())
    return sp.Matrix([[row.coeff(d) for d in DIRECTION] for row in rows])


def _flight_examples() -> Iterator[dict[sp.Symbol, sp.Expr]]:
    """Yield exact values of x, v, w, tau, k and g of flights that end in an impact."""
    for numbers in ((31, -7, 42, 260), (-12, 35, 9, 117), (25, 18, -3, 571)):
        pairs = zip((x, v, w, tau), numbers, strict=True)
        values = {k: sp.Rational(1, 5)} | {a: sp.Rational(number, 100) for a, number in pairs}
        position, strain = flight(x, *rebound(v, w), tau)
        rest = (position + strain).subs(g, 0)
        yield values | {g: (-2 * rest / tau**2).subs(values)}


def jacobian() -> Formula:
    """Derive (33) from the nine linear equations that differentiating (28) gives."""
    (x1, v1, w1), lines = map_residuals(-1)
    lines = sp.Matrix(lines)
    implicit = -lines.jacobian((x1, v1, w1)).LUsolve(lines.jacobian((x, v, w)))
    _, speed, strain, rate = flight_after_impact()
    direct = jacobian_matrix()
    agree = True
    for values in _flight_examples():
        after = {x1: -strain, v1: speed, w1: rate}
        end = {name: value.subs(values).evalf(_DIGITS) for name, value in after.items()}
        difference = (implicit.subs(values | end) - direct.subs(values)).evalf(_DIGITS)
        agree &= max(abs(a) for a in difference) < _SMALL
    return Formula(bool(agree))


def exponents() -> Formula:
    """Check (32) on a constant Jacobian e^rate: without 1/i the limit is infinite."""
    i, rate = sp.symbols("i rate", positive=True)
    growth = i * rate
    return Formula(sp.limit(growth, i, sp.oo) == rate, sp.limit(growth / i, i, sp.oo) == rate)


def determinants() -> Formula:
    """Derive the Jacobian's determinants: s/s' in (x, xdot, udot), s = xdot + udot; 1 in (x, y).

    The first telescopes along an orbit, so the three exponents add up to 0. The second makes two of
    them opposite, so the third is 0.
    """
    matrix = jacobian_matrix()
    slope = sp.Matrix([[energy(x, v, w).diff(a) for a in (x, v, w)]])
    chart = sp.Matrix([[1, 0, 0], [0, 1, -k]])  # dx and dy, y = v - k w
    _, speed, _, rate = flight_after_impact()
    good = True
    for values in _flight_examples():
        numbers = matrix.subs(values).evalf(_DIGITS)
        ratio = ((v + w) / (speed + rate)).subs(values).evalf(_DIGITS)
        basis = sp.Matrix.hstack(*slope.subs(values).evalf(_DIGITS).nullspace())
        flat = chart.subs(values).evalf(_DIGITS)
        area = (flat * numbers * basis).det() / (flat * basis).det()
        good &= abs(numbers.det() - ratio) < _SMALL
        good &= abs(area - 1) < _SMALL
    return Formula(bool(good))


def one_form() -> Formula:
    """Derive (34)-(39): the form on the section, and that the impact keeps it."""
    velocity, rate, position, strain = sp.symbols("xd ud X U", real=True)
    lagrangian = velocity**2 / 2 + k * rate**2 / 2 + g * position - k * strain**2 / 2
    form = lagrangian.diff(velocity), lagrangian.diff(rate)
    on_section = (form[0] - form[1]).subs({velocity: v, rate: w})  # du = -dx
    speed, after = rebound(v, w)
    change = (speed - k * after) - (v - k * w)
    return Formula(zero(form[0] - velocity, form[1] - k * rate, on_section - (v - k * w), change))


def area() -> Formula:
    """Derive (40)-(42) although flight times vary (Poincare and Cartan).

    The action's differential is xdot dx + k udot du between the ends plus tau dE. At fixed energy
    the form's change is therefore exact, and its differential is kept.
    """
    position, strain = flight(x, b, c, tau)
    speed, rate = position.diff(tau), strain.diff(tau)
    conditions = [action(x, b, c, tau).diff(tau) - speed**2 - k * rate**2, action(x, b, c, 0)]
    start = {x: b - k * c, b: 0, c: 0, tau: 0}
    for variable in (x, b, c, tau):
        end = speed * position.diff(variable) + k * rate * strain.diff(variable)
        change = action(x, b, c, tau).diff(variable) - (end - start[variable])
        conditions.append(change - tau * energy(x, b, c).diff(variable))
    return Formula(zero(*conditions))


def reversible() -> Formula:
    """Derive that the reversor (x, v, w) -> (x, -b, -c) undoes a flight, so that P^-1 = R P R."""
    position, speed, strain, rate = flight_after_impact()
    reflected = tuple(-a for a in rebound(speed, rate))
    back, back_strain = flight(-strain, *rebound(*reflected), tau)
    # back at x, and there with the velocities of R
    place = -back_strain - x
    velocity = rebound(*reflected)[0] + g * tau + rebound(v, w)[0]
    closes = (back - x) + (position + strain)  # X(t) returns as U does where the gap is 0
    return Formula(None, zero(place, velocity, closes))
