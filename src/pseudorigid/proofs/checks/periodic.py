"""Periodic orbits, by interval Newton on the shooting map F_i = P(z_i) - z_(i+1).

Theorem (Moore; Neumaier, Interval Methods for Systems of Equations, 1990): let X be a box with
midpoint c and A a regular interval matrix that contains DF on X. If N = c - A^-1 F(c) lies in the
interior of X, then F has exactly one zero in X, and it is in N.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import combinations

from flint import arb, arb_mat, ctx

from ..enclosure.flight import UndecidedError
from ..enclosure.surface import Impact, Surface, ball_of
from .certificate import Certificate, Finding, NotProvedError, box, check_stated, lowest

BITS = 256  # twice what points to CLOSE need, and room for the periods
CLOSE = Fraction(1, 10**30)  # largest distance of a certificate's point from the orbit's

Window = tuple[tuple[Fraction, Fraction], tuple[Fraction, Fraction]]  # of x and of xdot
Points = Sequence[Sequence[arb]]  # (x, y) of each


@dataclass(frozen=True)
class Orbit:
    """An enclosed periodic orbit."""

    points: tuple[tuple[arb, arb], ...]  # (x, y = xdot - k udot)
    impacts: tuple[Impact, ...]  # after each point
    matrix: arb_mat  # the product of DP along the orbit, from the first point
    type: str  # "elliptic", "hyperbolic" or "inverse hyperbolic"
    radius: Fraction  # of the boxes around the centres in which it is the only orbit

    @property
    def trace(self) -> arb:
        """Trace of the matrix."""
        return self.matrix[0, 0] + self.matrix[1, 1]


def check(text: str, surface: Surface, **bounds) -> Finding:
    """Prove a certificate's orbit; the bounds are those of `prove_stated`.

    The digits are of the first point and of the period, which is the sum of the flight times.
    """
    with ctx.workprec(BITS):
        certificate = Certificate(text, "periodic orbit", surface)
        orbit = prove_stated(certificate, surface, **bounds)
        x, y = orbit.points[0]
        xdot, udot = surface.velocities(x, y)
        period = sum((impact.tau for impact in orbit.impacts), arb(0))
        digits = {"x": x, "xdot": xdot, "udot": udot, "period": period, "trace": orbit.trace}
        margins = {"radius": float(orbit.radius), "trace": lowest(abs(abs(orbit.trace) - 2))}
        return Finding(digits, margins, {"orbit": orbit})


def check_only_fixed_point(text: str, k: Fraction, g: Fraction, energy: Fraction) -> Finding:
    """Prove that the map has one fixed point at each energy from -g^2/(2k) up to a given one.

    This verifies the two inequalities of the argument in docs/proofs.md.
    """
    with ctx.workprec(BITS):
        certificate = Certificate(text, "only fixed point", ball=(k, g))
        certificate.check("energy_up_to", energy)
        theta = certificate.number("theta_below")
        square = (2 * k * energy / (g * g) + 1) / (1 + k)  # theta^2 is at most this
        if not (theta - Fraction(1, 100)) ** 2 < square <= theta**2:
            raise NotProvedError("theta is not proved to be below the stated one")
        room = 3 * arb.pi() / 2 - ball_of(theta)
        if not (room > 0 and theta * k < 2):
            raise NotProvedError("a second fixed point is not excluded")
        margins = {"theta": lowest(room), "earlier": lowest(ball_of(2 - theta * k))}
        return Finding({"energies up to": ball_of(energy)}, margins)


def prove_stated(
    certificate: Certificate,
    surface: Surface,
    *,
    period: int,
    type: str,
    radius: Fraction,
    window: Window | None = None,
) -> Orbit:
    """Prove that an orbit meets its certificate, has a prime period and a type, and is alone.

    It is alone in boxes of at least the radius, and has a point in the window. The boxes are larger
    than the certificate's by CLOSE, so that they contain the stated boxes around the orbit's own
    points. Raises NotProvedError.
    """
    centres, size = certificate.numbers("points", 2), certificate.radius(radius)
    if len(centres) != period:
        raise NotProvedError(f"the certificate has {len(centres)} points, not {period}")
    orbit = prove(surface, centres, size + CLOSE)
    if orbit.type != type:
        raise NotProvedError(f"the orbit is {orbit.type}, not {type}")
    for point, centre in zip(orbit.points, centres, strict=True):
        check_stated("orbit's point", point, centre, CLOSE)
    check_window(surface, orbit, window)
    return replace(orbit, radius=size)


def prove(surface: Surface, centres: Sequence[Sequence[Fraction]], radius: Fraction) -> Orbit:
    """Prove that one orbit has a point within `radius` of each centre (x, y), per coordinate.

    Raises NotProvedError where no orbit, more than one, or a shorter one cannot be excluded.
    """
    if not radius > 0:
        raise NotProvedError(f"a radius of {float(radius):g} is no size of a box")
    boxes = [box(centre, radius) for centre in centres]
    try:
        image = newton_image(surface, boxes)
        for inner, outer in zip(image, boxes, strict=True):
            if not all(o.contains_interior(i) for i, o in zip(inner, outer, strict=True)):
                raise NotProvedError("the Newton image of the boxes does not lie inside them")
        orbit = enclose(surface, _narrow(surface, image), radius)
    except (UndecidedError, ZeroDivisionError) as error:
        raise NotProvedError(f"the boxes around the orbit: {error}") from None
    check_distinct(orbit.points)
    return orbit


def check_distinct(points: Points) -> None:
    """Check that no two of some enclosed points may be one."""
    for first, second in combinations(points, 2):
        if all(a.overlaps(b) for a, b in zip(first, second, strict=True)):
            raise NotProvedError("two points may be one: the period may be shorter")


def prove_saddles(
    certificate: Certificate,
    surface: Surface,
    period: int,
    radius: Fraction,
    window: Window | None,
) -> Orbit:
    """Prove that a hyperbolic orbit is alone near the centres of a certificate's saddles' sets."""
    with ctx.workprec(BITS):
        centres = [row[:2] for row in certificate.numbers("saddles", 6)]
        if len(centres) != period:
            raise NotProvedError(f"the certificate has {len(centres)} saddles, not {period}")
        orbit = prove(surface, centres, radius)
        if orbit.type != "hyperbolic":
            raise NotProvedError(f"the orbit at the sets is {orbit.type}, not hyperbolic")
        check_window(surface, orbit, window)
        return orbit


def newton_image(surface: Surface, boxes: Points) -> list[list[arb]]:
    """Return the image N of boxes (x, y) under interval Newton on the shooting map."""
    n = len(boxes)
    slopes, residuals = arb_mat(2 * n, 2 * n), arb_mat(2 * n, 1)
    centres = [[a.mid() for a in box_] for box_ in boxes]
    for i, centre in enumerate(centres):
        after = (i + 1) % n
        rows, _ = surface.jacobian(*boxes[i])
        image = surface.impact(*centre)
        for r in range(2):
            for c in range(2):
                slopes[2 * i + r, 2 * i + c] += rows[r][c]
            slopes[2 * i + r, 2 * after + r] -= 1
            residuals[2 * i + r, 0] = image[r] - centres[after][r]
    step = slopes.solve(residuals, algorithm="precond")
    return [[centres[i][r] - step[2 * i + r, 0] for r in range(2)] for i in range(n)]


def _narrow(surface: Surface, boxes: list[list[arb]]) -> list[list[arb]]:
    """Narrow the boxes around the orbit's points as far as the precision allows."""
    while True:
        narrow = [
            [a.intersection(b) for a, b in zip(*pair, strict=True)]
            for pair in zip(newton_image(surface, boxes), boxes, strict=True)
        ]
        if not narrow[0][0].rad() < boxes[0][0].rad() / 2:
            return narrow
        boxes = narrow


def enclose(surface: Surface, points: Points, radius: Fraction = Fraction(0)) -> Orbit:
    """Return the Orbit through enclosed points; raises NotProvedError if its type is undecided."""
    matrix = arb_mat([[1, 0], [0, 1]])
    impacts = []
    for point in points:
        rows, impact = surface.jacobian(*point)
        matrix = arb_mat(rows) * matrix
        impacts.append(impact)
    trace = matrix[0, 0] + matrix[1, 1]
    if abs(trace) < 2:
        kind = "elliptic"
    elif abs(trace) > 2:
        kind = "hyperbolic" if trace > 2 else "inverse hyperbolic"
    else:
        raise NotProvedError("the trace may be 2 or -2: the orbit's type is not proved")
    return Orbit(tuple(map(tuple, points)), tuple(impacts), matrix, kind, radius)


def check_window(surface: Surface, orbit: Orbit, window: Window | None) -> None:
    """Check that one of the orbit's points lies in a window, if one is given.

    Raises NotProvedError.
    """
    if window is None:
        return
    for x, y in orbit.points:
        sides = zip((x, surface.velocities(x, y)[0]), window, strict=True)
        if all(ball_of(low) < value < ball_of(high) for value, (low, high) in sides):
            return
    raise NotProvedError("no point of the orbit is proved to lie in the statement's window")
