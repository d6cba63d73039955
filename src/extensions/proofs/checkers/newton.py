"""Interval Newton for as many equations as unknowns.

Theorem (Moore; Neumaier, Interval Methods for Systems of Equations, 1990): let X be a box with
midpoint c and A a regular interval matrix that contains DF on X. If N = c - A^-1 F(c) lies in the
interior of X, then F has exactly one zero in X, and it is in N.
"""

from collections.abc import Callable, Sequence

from flint import arb, arb_mat

from pseudorigid.verified.flight import NotProvedError

# Values of the equations, and rows of their derivatives by the unknowns and perhaps by more.
System = Callable[[Sequence[arb]], tuple[list[arb], list[list[arb]]]]


def newton(system: System, values: Sequence[arb]) -> list[arb]:
    """Return the image N of a box; raises NotProvedError where A may be singular."""
    centre = [value.mid() for value in values]
    residuals, slopes = system(centre)
    if not all(value.is_exact() for value in values):
        _, slopes = system(values)
    return [c - step for c, step in zip(centre, solve(slopes, residuals), strict=True)]


def solve(slopes: list[list[arb]], right: list[arb]) -> list[arb]:
    """Solve linear equations; derivatives by other variables than the unknowns are left out."""
    matrix = arb_mat([row[: len(right)] for row in slopes])
    try:
        solution = matrix.solve(arb_mat([[value] for value in right]), algorithm="precond")
    except ZeroDivisionError:
        raise NotProvedError("the derivative over the boxes may be singular") from None
    return [value for (value,) in solution.table()]


def enclose_zero(system: System, values: Sequence[arb]) -> list[arb]:
    """Prove that a box has one zero of a system, and enclose it as far as the precision allows.

    Raises NotProvedError.
    """
    image = newton(system, values)
    if not all(outer.contains_interior(i) for i, outer in zip(image, values, strict=True)):
        raise NotProvedError("the Newton image of the boxes does not lie inside them")
    while True:
        pairs = zip(newton(system, image), image, strict=True)
        narrow = [a.intersection(b) for a, b in pairs]
        if not narrow[0].rad() < image[0].rad() / 2:
            return narrow
        image = narrow
