"""Parallelograms in the plane, covering relations between them, and the cone condition.

An h-set is a parallelogram c + p u + q s, |p|, |q| <= 1, with one expanding and one contracting
direction. Its exit set are the two edges p = -1 and p = 1. theory/horseshoe.md defines the
relations, after Zgliczynski and Gidea (2004) and Kokubu, Wilczak and Zgliczynski (2007).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from typing import NamedTuple, TypeVar

from flint import arb

from pseudorigid.verified.flight import NotProvedError, UndecidedError

from ..enclosure.jets import Jet
from ..enclosure.surface import Surface, ball_of
from .certificate import Certificate, lower_bound, naming

UNIT = arb(0, 1)  # the interval from -1 to 1
MOST_CELLS = 600  # of a set, before its covering is given up
_SQUARE = arb(0.5, 0.5)  # the interval from 0 to 1

Vector = tuple[arb, arb]
Number = TypeVar("Number", arb, Jet)


@dataclass(frozen=True)
class HSet:
    """A named parallelogram: its centre, expanding vector u and contracting vector s in (x, y).

    Raises NotProvedError where u and s may be parallel.
    """

    name: str
    centre: Vector
    u: Vector
    s: Vector

    def __post_init__(self) -> None:
        if not abs(self.area) > 0:
            raise NotProvedError(f"{self.name}: its sides may be parallel")

    @property
    def area(self) -> arb:
        """Signed area of a quarter."""
        return self.u[0] * self.s[1] - self.u[1] * self.s[0]

    def box(self, p: Number, q: Number) -> tuple[Number, Number]:
        """Return a box around the points with these p and q."""
        (x, y), (ux, uy), (sx, sy) = self.centre, self.u, self.s
        return x + p * ux + q * sx, y + p * uy + q * sy

    def coordinates(self, x: Number, y: Number) -> tuple[Number, Number]:
        """Return (p, q) of the point (x, y)."""
        dx, dy = x - self.centre[0], y - self.centre[1]
        (ux, uy), (sx, sy) = self.u, self.s
        return (dx * sy - dy * sx) / self.area, (ux * dy - uy * dx) / self.area

    def contains(self, x: arb, y: arb) -> bool:
        """Whether every point of the box (x, y) is proved to be inside."""
        return all(abs(a) < 1 for a in self.coordinates(x, y))

    def is_disjoint(self, other: "HSet") -> bool:
        """Whether a side of either set is proved to separate the two."""
        for reference, moved in ((self, other), (other, self)):
            corners = [
                reference.coordinates(*moved.box(arb(p), arb(q)))
                for p, q in product((-1, 1), repeat=2)
            ]
            for values in zip(*corners, strict=True):
                if all(v > 1 for v in values) or all(v < -1 for v in values):
                    return True
        return False

    def mirrored(self, name: str) -> "HSet":
        """Return the image under the reversor (x, y) -> (x, -y), its two directions exchanged."""
        (x, y), (ux, uy), (sx, sy) = self.centre, self.u, self.s
        return HSet(name, (x, -y), (sx, -sy), (ux, -uy))


def hset(name: str, row: Sequence[Fraction]) -> HSet:
    """Return the set of a certificate's row: centre, expanding side, contracting side."""
    x, y, ux, uy, sx, sy = map(ball_of, row)
    return HSet(name, (x, y), (ux, uy), (sx, sy))


def read_sets(certificate: Certificate, field: str, name: str, first: int = 0) -> list[HSet]:
    """Return the sets of a certificate's field, named by this letter and a number from `first`."""
    rows = certificate.numbers(field, 6)
    return [hset(f"{name}_{i}", row) for i, row in enumerate(rows, first)]


def check_contained(sets: list[HSet], points: Sequence[Vector]) -> None:
    """Check that each set contains the point at its place."""
    for hset, point in zip(sets, points, strict=True):
        if not hset.contains(*point):
            raise NotProvedError(f"{hset.name} is not proved to contain the orbit's point")


@dataclass(frozen=True)
class LocalMap:
    """P on a whole h-set, to second order, in its coordinates (p, q) and those of a target.

    P(p, q) = centre + slopes (p, q) + curvatures (p^2, p q, q^2), for some curvatures in these
    balls; slopes and curvatures have a row for p' and one for q'.
    """

    centre: Vector
    slopes: tuple[Vector, Vector]
    curvatures: tuple[tuple[arb, arb, arb], tuple[arb, arb, arb]]

    def exit_edge(self, p: int) -> arb:
        """Enclose the target's p' of the points with p = -1 or p = 1."""
        (s, t), (pp, pq, qq) = self.slopes[0], self.curvatures[0]
        return self.centre[0] + p * s + UNIT * (t + p * pq) + pp + qq * _SQUARE

    def across(self) -> arb:
        """Enclose the target's q' of all points."""
        (s, t), (pp, pq, qq) = self.slopes[1], self.curvatures[1]
        return self.centre[1] + UNIT * (abs(s) + abs(t) + abs(pq)) + pp * _SQUARE + qq * _SQUARE

    def hull(self) -> list[list[arb]]:
        """Enclose DP at every point, and so its convex hull, in an interval matrix."""
        return [
            [s + UNIT * (2 * abs(pp) + abs(pq)), t + UNIT * (2 * abs(qq) + abs(pq))]
            for (s, t), (pp, pq, qq) in zip(self.slopes, self.curvatures, strict=True)
        ]


def local_map(surface: Surface, source: HSet, target: HSet) -> LocalMap:
    """Enclose the map on an h-set in its own coordinates and those of a target.

    Raises UndecidedError where a flight from the set may touch the floor earlier.
    """

    def image(order: int, value: arb) -> tuple[Jet, Jet]:
        p, q = Jet.plane(order, value, value)
        x, y, *_ = surface.impact(*source.box(p, q))
        return target.coordinates(x, y)

    (p, q), (over_p, over_q) = image(1, arb(0)), image(2, UNIT)
    return LocalMap(
        (p.coefficients[0], q.coefficients[0]),
        ((p[1, 0], p[0, 1]), (q[1, 0], q[0, 1])),
        (tuple(over_p.coefficients[3:]), tuple(over_q.coefficients[3:])),
    )


def covering_margins(local: LocalMap, source: HSet, target: HSet) -> tuple[float, float]:
    """Prove that source covers target; raises NotProvedError.

    Returns how far beyond the target's edges the exit edges land, and how much room is left within
    |q'| < 1, both in units of the target's half widths.
    """
    low, high = local.exit_edge(-1), local.exit_edge(1)
    if high < 0:
        low, high = high, low
    room = 1 - abs(local.across()).upper()
    failure = f"{source.name} does not cover {target.name}"
    if not (low < -1 and high > 1):
        raise NotProvedError(f"{failure}: its edges are not proved to land beyond the target")
    if not room > 0:
        raise NotProvedError(f"{failure}: its image is not proved to fit between the edges")
    return min(lower_bound(-low - 1), lower_bound(high - 1)), lower_bound(room)


def cone_margin(local: LocalMap, source: HSet, target: HSet) -> float:
    """Prove the cone condition; raises NotProvedError.

    Returns a lower bound of the least eigenvalue of D^T Q' D - Q, Q = p^2 - q^2, over all D in the
    hull.
    """
    (a, b), (c, d) = local.hull()
    first, mixed, last = a * a - c * c - 1, a * b - c * d, b * b - d * d + 1
    determinant = first * last - mixed * mixed
    if not (first > 0 and determinant > 0):
        raise NotProvedError(f"cone condition not proved from {source.name} to {target.name}")
    return lower_bound(determinant / (first + last))


def prove_hyperbolic(
    surface: Surface, source: HSet, target: HSet
) -> tuple[tuple[float, float], float, LocalMap]:
    """Prove that source covers target with the cone condition, and return both margins and P.

    Raises NotProvedError.
    """
    with naming(source.name):
        local = local_map(surface, source, target)
    return covering_margins(local, source, target), cone_margin(local, source, target), local


def prove_covering(surface: Surface, source: HSet, target: HSet) -> tuple[float, float]:
    """Prove that source covers target, on cells of the source that are halved where needed.

    Returns the margins of `covering_margins`. Raises NotProvedError.
    """
    x, y, *_ = surface.impact(*source.box(arb(1), arb(0)))
    right = target.coordinates(x, y)[0]
    side = 1 if right > 0 else -1  # on which the edge p = 1 lands
    beyond = room = float("inf")
    failure = f"{source.name} does not cover {target.name}"
    cells = [_Cell()]
    for _ in range(MOST_CELLS):
        if not cells:
            return beyond, room
        cell = cells.pop()
        try:
            local = local_map(surface, cell.of(source), target)
        except UndecidedError as error:
            failure = f"{source.name}: {error}"
            cells += cell.halves(source)
            continue
        at = [p for p in (-1, 1) if cell.p + p * cell.half_p == p]  # edges that the cell touches
        edges = [p * side * local.exit_edge(p) - 1 for p in at]
        left = 1 - abs(local.across()).upper()
        if left > 0 and all(edge > 0 for edge in edges):
            beyond = min([beyond, *map(lower_bound, edges)])
            room = min(room, lower_bound(left))
        elif any(edge < 0 for edge in edges) or abs(local.centre[1]) > 1:
            break
        else:
            cells += cell.halves(source)
    raise NotProvedError(failure)


class _Cell(NamedTuple):
    """The part of a set with these middles and half widths of p and q, which are exact."""

    p: float = 0.0
    q: float = 0.0
    half_p: float = 1.0
    half_q: float = 1.0

    def of(self, source: HSet) -> HSet:
        """Return the cell of a set as an HSet."""
        p, q, half_p, half_q = map(arb, self)
        (ux, uy), (sx, sy) = source.u, source.s
        u, s = (half_p * ux, half_p * uy), (half_q * sx, half_q * sy)
        return HSet(source.name, source.box(p, q), u, s)

    def halves(self, source: HSet) -> list["_Cell"]:
        """Return the two halves of the cell, cut across its longer side."""
        u, s = (float(x * x + y * y) for x, y in (source.u, source.s))
        p, q, half_p, half_q = self
        if half_p**2 * u > half_q**2 * s:
            return [_Cell(p + e * half_p / 2, q, half_p / 2, half_q) for e in (-1, 1)]
        return [_Cell(p, q + e * half_q / 2, half_p, half_q / 2) for e in (-1, 1)]
