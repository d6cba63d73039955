"""Symbols of the derivations, and the model in them: impact law, flight, energy, action."""

from typing import NamedTuple

import sympy as sp

from pseudorigid.kernel import formulas

# Dimensional: radius, mass, inertia, stiffness EV0, gravity, time.
R, M, E0, EV0, GRAVITY, T = sp.symbols("R m E_0 E_V gamma t", positive=True)
# Dimensionless: inertia, gravity, time of flight; position x, velocities xdot and udot just before
# (v, w) and just after (b, c) an impact, and energy.
k, g, tau = sp.symbols("k g tau", positive=True)
x, v, w, b, c, E = sp.symbols("x v w b c E", real=True)
PAPER = {k: sp.Rational(1, 5), g: sp.Rational(1, 25)}


class Formula(NamedTuple):
    """The result of deriving one formula."""

    printed: bool | None  # whether it holds as printed; None if the paper prints none
    corrected: bool | None = None  # whether the corrected or unprinted one holds, if there is one
    value: float = float("nan")  # its number


def zero(*expressions: sp.Expr) -> bool:
    """Whether expressions are zero for all values of their symbols."""
    return all(sp.simplify(sp.expand(sp.expand_trig(e))) == 0 for e in expressions)


def rebound(v: sp.Expr, w: sp.Expr) -> tuple[sp.Expr, sp.Expr]:
    """Velocities b, c after an impact, by the code's own law on symbols."""
    coefficient = 2 / (1 + k), 0  # as a sum of two parts; this one is exact
    b, c, *_ = formulas.rebound(v, w, k, coefficient)
    return b, c


def flight(x: sp.Expr, b: sp.Expr, c: sp.Expr, t: sp.Expr) -> tuple[sp.Expr, sp.Expr]:
    """Position and strain a time t after an impact, eq. (26)."""
    return x + b * t + g * t**2 / 2, c * sp.sin(t) - x * sp.cos(t)


def energy(x: sp.Expr, v: sp.Expr, w: sp.Expr) -> sp.Expr:
    """Energy of a state, eq. (29)."""
    return v**2 / 2 + k * w**2 / 2 - g * x + k * x**2 / 2


def action(x: sp.Expr, b: sp.Expr, c: sp.Expr, t: sp.Expr) -> sp.Expr:
    """Integral of xdot^2 + k udot^2 over a flight, in closed form."""
    mixed = sp.sin(t) * sp.cos(t)
    strain = (x**2 * (t - mixed) + c**2 * (t + mixed)) / 2 + x * c * sp.sin(t) ** 2
    return b**2 * t + b * g * t**2 + g**2 * t**3 / 3 + k * strain
