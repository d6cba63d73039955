"""Periodic orbits, by interval Newton on the shooting map F_i = P(z_i) - z_(i+1)."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from itertools import combinations
from typing import Any

from flint import arb, arb_mat, ctx

from pseudorigid.verified.flight import NotProvedError

from ..enclosure.surface import Impact, Surface, ball_of
from .certificate import Certificate, Finding, Window, box, check_stated, lower_bound, naming
from .newton import enclose_zero, newton

BITS = 256  # twice what points to CLOSE need, and room for the periods
CLOSE = Fraction(1, 10**30)  # largest distance of a certificate's point from the orbit's

Point = tuple[arb, arb]  # x and y = xdot - k udot


@dataclass(frozen=True)
class Orbit:
    """An enclosed periodic orbit."""

    points: tuple[Point, ...]
    impacts: tuple[Impact, ...]  # after each point
    matrix: arb_mat  # the product of DP along the orbit, from the first point
    type: str  # "elliptic", "hyperbolic" or "inverse hyperbolic"
    radius: Fraction  # of the boxes around the centres in which it is the only orbit

    @property
    def trace(self) -> arb:
        """Trace of the matrix."""
        return self.matrix[0, 0] + self.matrix[1, 1]


def check(text: str, surface: Surface, **bounds: Any) -> Finding:
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
        margins = {"radius": float(orbit.radius), "trace": lower_bound(abs(abs(orbit.trace) - 2))}
        return Finding(digits, margins, {"orbit": orbit})


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
    centres, size = certificate.numbers("points", 2), certificate.at_least("radius", radius)
    _check_count(centres, period, "points")
    orbit = prove(surface, centres, size + CLOSE)
    _check_properties(surface, orbit, type, window)
    for point, centre in zip(orbit.points, centres, strict=True):
        check_stated("orbit's point", point, centre, CLOSE)
    return replace(orbit, radius=size)


def prove_saddles(
    certificate: Certificate, surface: Surface, period: int, radius: Fraction, window: Window | None
) -> Orbit:
    """Prove that a hyperbolic orbit is alone near the centres of a certificate's saddles' sets."""
    with ctx.workprec(BITS):
        centres = [row[:2] for row in certificate.numbers("saddles", 6)]
        _check_count(centres, period, "saddles")
        orbit = prove(surface, centres, radius)
        _check_properties(surface, orbit, "hyperbolic", window)
        return orbit


def _check_count(centres: Sequence, period: int, name: str) -> None:
    if len(centres) != period:
        raise NotProvedError(f"the certificate has {len(centres)} {name}, not {period}")


def _check_properties(surface: Surface, orbit: Orbit, type: str, window: Window | None) -> None:
    """Check that an orbit has a type, and one of its points in the window, if one is given."""
    if orbit.type != type:
        raise NotProvedError(f"the orbit is {orbit.type}, not {type}")
    if window is None:
        return
    for x, y in orbit.points:
        sides = zip((x, surface.velocities(x, y)[0]), window, strict=True)
        if all(ball_of(low) < value < ball_of(high) for value, (low, high) in sides):
            return
    raise NotProvedError("no point of the orbit is proved to lie in the statement's window")


def prove(surface: Surface, centres: Sequence[Sequence[Fraction]], radius: Fraction) -> Orbit:
    """Prove that one orbit has a point within `radius` of each centre (x, y), per coordinate.

    Raises NotProvedError where no orbit, more than one, or a shorter one cannot be excluded.
    """
    boxes = [a for centre in centres for a in box(centre, radius)]
    with naming("the boxes around the orbit"):
        values = enclose_zero(partial(_shooting, surface), boxes)
    orbit = enclose(surface, _pairs(values), radius)
    check_distinct(orbit.points)
    return orbit


def _pairs(values: Sequence[arb]) -> list[Point]:
    """Return the points whose coordinates are in one list."""
    return list(zip(values[::2], values[1::2], strict=True))


def _shooting(surface: Surface, values: Sequence[arb]) -> tuple[list[arb], list[list[arb]]]:
    """Return F_i = P(z_i) - z_(i+1), and the rows of DF, over boxes around the z_i."""
    points, residuals, slopes = _pairs(values), [], []
    for i, point in enumerate(points):
        after = (i + 1) % len(points)
        rows, image = surface.jacobian(*point)
        for r in range(2):
            residuals.append(image[r] - points[after][r])
            slopes.append([arb(0)] * len(values))
            slopes[-1][2 * i : 2 * i + 2] = rows[r]
            slopes[-1][2 * after + r] -= 1
    return residuals, slopes


def newton_image(surface: Surface, points: Sequence[Sequence[arb]]) -> list[Point]:
    """Return the image of points (x, y) under one step of Newton's method to a periodic orbit."""
    return _pairs(newton(partial(_shooting, surface), [a for point in points for a in point]))


def check_distinct(points: Sequence[Point]) -> None:
    """Check that no two of some enclosed points may be one."""
    for first, second in combinations(points, 2):
        if all(a.overlaps(b) for a, b in zip(first, second, strict=True)):
            raise NotProvedError("two points may be one: the period may be shorter")


def enclose(
    surface: Surface, points: Sequence[Sequence[arb]], radius: Fraction = Fraction(0)
) -> Orbit:
    """Return the Orbit through enclosed points; raises NotProvedError if its type is undecided."""
    matrix = arb_mat([[1, 0], [0, 1]])
    impacts = []
    for x, y in points:
        rows, impact = surface.jacobian(x, y)
        matrix = arb_mat(rows) * matrix
        impacts.append(impact)
    trace = matrix[0, 0] + matrix[1, 1]
    if abs(trace) < 2:
        kind = "elliptic"
    elif abs(trace) > 2:
        kind = "hyperbolic" if trace > 2 else "inverse hyperbolic"
    else:
        raise NotProvedError("the trace may be 2 or -2: the orbit's type is not proved")
    return Orbit(tuple((x, y) for x, y in points), tuple(impacts), matrix, kind, radius)
