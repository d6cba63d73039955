"""Certificates of periodic orbits, and the orbits in doubles from which all searches begin.

Centres are from Newton's method, and the square box around each is the largest one.
"""

from bisect import bisect_left
from collections.abc import Sequence

from flint import arb, ctx

from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.periodic import symmetric_orbits
from pseudorigid.dynamics.variables import chart, of_type, states_of

from ..checkers.periodic import newton_image
from ..enclosure.surface import Surface
from .certificate_text import Theorem, header, row, rows

BITS = 160
DIGITS = 36  # the checker compares thirty of them with the orbit
_LARGEST, _SMALLEST = 2, 12  # minus the decimal exponents of the radii that are tried


def nearest_ball(surface: Surface) -> Ball:
    """Return the Ball whose k and g are the doubles nearest to a surface's."""
    return Ball(k=float(surface.k), g=float(surface.g))


def points_of(theorem: Theorem, kind: str) -> list[list[float]]:
    """Return the points (x, y) near which a theorem states an orbit of this type."""
    return approximate_points(theorem.bounds["surface"], theorem.bounds["period"], kind)


def approximate_points(surface: Surface, period: int, kind: str) -> list[list[float]]:
    """Return the points (x, y) of the first symmetric orbit of this period and type."""
    ball = nearest_ball(surface)
    orbits = symmetric_orbits(ball, float(surface.energy), period)
    return chart(ball.k, *states_of(of_type(orbits, kind))).T.tolist()


def polished(surface: Surface, points: Sequence, steps: int = 8) -> list[list[arb]]:
    """Improve points (x, y) near a periodic orbit, by Newton's method on midpoints."""
    points, least = [[arb(a).mid() for a in point] for point in points], arb(2) ** (16 - ctx.prec)
    for _ in range(steps):
        points = [[a.mid() for a in point] for point in newton_image(surface, points)]
        # a coordinate that is no larger than rounding errors is 0
        points = [[a if abs(a) > least else arb(0) for a in point] for point in points]
    return points


def propose(theorem: Theorem, points: Sequence | None = None) -> str:
    """Return a certificate of an orbit near points (x, y), by default those of a symmetric orbit.

    Its radius is the largest for which the checker accepts it.
    """
    surface = theorem.bounds["surface"]
    if points is None:
        points = points_of(theorem, theorem.bounds["type"])
    with ctx.workprec(BITS):
        centres = centre_rows(polished(surface, points))
    return with_largest_radius(theorem, header("periodic orbit", surface), centres)


def centre_rows(points: Sequence) -> str:
    """Return the field with an orbit's points."""
    return rows("points", (row(point, DIGITS) for point in points))


def with_largest_radius(theorem: Theorem, before: str, after: str = "") -> str:
    """Return a text with the largest radius of one digit that the checker accepts, or the smallest.

    The line with the radius is between `before` and `after`. What holds for a radius must hold
    for smaller ones.
    """
    sizes = [f"{m}e-{e:02}" for e in range(_LARGEST, _SMALLEST + 1) for m in range(9, 0, -1)]
    texts = [f"{before}radius = {size}\n{after}" for size in sizes]
    holds = theorem.holds_for_any_radius
    return texts[bisect_left(texts, True, hi=len(texts) - 1, key=holds)]
