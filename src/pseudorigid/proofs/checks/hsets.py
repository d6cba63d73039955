"""Sets in the plane, covering relations between them, and the cone condition.

An h-set is a parallelogram c + p u + q s, |p|, |q| <= 1, with one expanding and one contracting
direction: its exit set are the two edges p = -1 and p = 1. N covers M, N => M, if the image of N
stays within |q'| < 1 in the coordinates (p', q') of M, and the images of N's two exit edges lie
beyond p' = -1 and p' = 1, on opposite sides: with one expanding direction this suffices for the
covering relation of Zgliczynski and Gidea (2004). The pair satisfies the cone condition if

    Q(z1' - z2') > Q(z1 - z2),   Q = p^2 - q^2,   for all z1 != z2 of N with images z1', z2',

for which it suffices that D^T Q D - Q is positive definite for every D in the interval hull of the
derivatives on N, in these coordinates (Kokubu, Wilczak and Zgliczynski 2007).
"""

from dataclasses import dataclass
from itertools import product

from flint import arb

from ..enclosure.jets import Jet, algebra
from .certificate import NotProvedError, lowest

UNIT = arb(0, 1)  # from -1 to 1
SQUARE = arb(0.5, 0.5)  # from 0 to 1


@dataclass(frozen=True)
class HSet:
    """The parallelogram c + p u + q s, |p|, |q| <= 1, in the chart.

    Parameters
    ----------
    name : str
    centre, u, s : (arb, arb)
        c, the expanding and the contracting vector.
    """

    name: str
    centre: tuple
    u: tuple
    s: tuple

    def box(self, p=UNIT, q=UNIT):
        """A box around the points with these p and q."""
        return [c + p * u + q * s for c, u, s in zip(self.centre, self.u, self.s, strict=True)]

    def coordinates(self, dx, dy):
        """(p, q) of the vector (dx, dy)."""
        (ux, uy), (sx, sy) = self.u, self.s
        area = ux * sy - uy * sx
        return (dx * sy - dy * sx) / area, (ux * dy - uy * dx) / area

    def place(self, x, y):
        """(p, q) of the point (x, y)."""
        return self.coordinates(x - self.centre[0], y - self.centre[1])

    def contains(self, x, y):
        """Whether every point of the box (x, y) is proved to be inside."""
        return all(abs(a) < 1 for a in self.place(x, y))

    def apart(self, other):
        """Whether the two sets are proved to be disjoint: by one of the sides of either."""
        for one, two in ((self, other), (other, self)):
            corners = [one.place(*two.box(arb(p), arb(q))) for p, q in product((-1, 1), repeat=2)]
            for axis in range(2):
                values = [corner[axis] for corner in corners]
                if all(v > 1 for v in values) or all(v < -1 for v in values):
                    return True
        return False

    def mirrored(self, name):
        """The image under the reversor (x, y) -> (x, -y), its two directions exchanged."""
        return HSet(name, *((x, -y) for x, y in (self.centre, self.s, self.u)))


@dataclass(frozen=True)
class Local:
    """P on a whole h-set, in its coordinates and those of a target, to second order.

    P(p, q) = centre + slopes (p, q) + bends (p^2, p q, q^2) with some bends of these balls.

    Parameters
    ----------
    centre : (arb, arb)
    slopes : ((arb, arb), (arb, arb))
        A row for p' and for q'.
    bends : ((arb, arb, arb), (arb, arb, arb))
        The same.
    """

    centre: tuple
    slopes: tuple
    bends: tuple

    def edge(self, side):
        """The target's p' of the points with p = side (-1 or 1)."""
        (s, t), (pp, pq, qq) = self.slopes[0], self.bends[0]
        return self.centre[0] + side * s + UNIT * (t + side * pq) + pp + qq * SQUARE

    def across(self):
        """The target's q' of all points."""
        (s, t), (pp, pq, qq) = self.slopes[1], self.bends[1]
        return self.centre[1] + UNIT * (abs(s) + abs(t) + abs(pq)) + pp * SQUARE + qq * SQUARE

    def hull(self):
        """An interval matrix that contains DP at every point, hence its convex hull."""
        return [
            [s + UNIT * (2 * abs(pp) + abs(pq)), t + UNIT * (2 * abs(qq) + abs(pq))]
            for (s, t), (pp, pq, qq) in zip(self.slopes, self.bends, strict=True)
        ]


def local(surface, source, target):
    """The map on an h-set, in its own coordinates and those of a target.

    Parameters
    ----------
    surface : Surface
    source, target : HSet

    Returns
    -------
    Local

    Raises
    ------
    UndecidedError
        Where a flight from the set may touch the floor earlier.
    """
    thin = _image(surface, source, target, algebra(2, 1), arb(0))
    wide = _image(surface, source, target, algebra(2, 2), UNIT)
    return Local(
        tuple(jet.constant for jet in thin),
        tuple(tuple(jet.coefficients[1:]) for jet in thin),
        tuple(tuple(jet.coefficients[3:]) for jet in wide),
    )


def _image(surface, source, target, plane, value):
    p, q = (Jet.variable(plane, i, value) for i in (0, 1))
    image = surface.impact(*source.box(p, q))
    return target.place(image.x, image.y)


def covering(at, source, target):
    """Prove that source covers target.

    Parameters
    ----------
    at : Local
        Of the two.
    source, target : HSet
        Their names are for the message.

    Returns
    -------
    float, float
        How far beyond the target's edges the exit edges land, and how much room is left within
        |q'| < 1, both in units of the target's half widths.

    Raises
    ------
    NotProvedError
        Where it is not proved.
    """
    low, high = at.edge(-1), at.edge(1)
    if high < 0:
        low, high = high, low
    room = 1 - abs(at.across()).upper()
    if not (low < -1 and high > 1):
        raise NotProvedError(f"{source.name} does not cover {target.name}: "
                        "its edges are not proved to land beyond the target")  # fmt: skip
    if not room > 0:
        raise NotProvedError(f"{source.name} does not cover {target.name}: "
                        "its image is not proved to fit between the target's edges")  # fmt: skip
    return min(lowest(-low - 1), lowest(high - 1)), lowest(room)


def cones(at, source, target):
    """Prove the cone condition of source and target.

    Parameters
    ----------
    at : Local
        Of the two.
    source, target : HSet
        Their names are for the message.

    Returns
    -------
    float
        A lower bound of the least eigenvalue of D^T Q D - Q.

    Raises
    ------
    NotProvedError
        Where it is not proved.
    """
    (a, b), (c, d) = at.hull()
    first, mixed, last = a * a - c * c - 1, a * b - c * d, b * b - d * d + 1
    determinant = first * last - mixed * mixed
    if not (first > 0 and determinant > 0):
        raise NotProvedError(f"cone condition not proved from {source.name} to {target.name}")
    return lowest(determinant / (first + last))
