"""Certificates of horseshoes: sets at the saddles and along a connection between two of them.

In the coordinates used here the map stretches by the same factor rho at each saddle. A set's
expanding side is tangent to the unstable manifold. Its contracting side mirrors the expanding side
of the mirrored set and is tangent to the stable manifold, so the map is nearly diagonal from set to
set. Along the chain the sets grow by the manifold's stretch divided by one factor kappa > 1, which
is the factor by which they stretch beyond each other.
"""

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from flint import arb, ctx

from pseudorigid.verified.flight import NotProvedError

from ..checkers.certificate import Finding
from ..checkers.periodic import enclose
from ..enclosure.surface import Surface
from .certificate_text import Theorem, header, row, rows
from .chains import DoubleMap
from .periodic import points_of, polished

_BITS = 320  # for an orbit that starts _EXTRA_ROUNDS nearer to its saddle than a double can tell
_EXTRA_ROUNDS = 100  # rounds about the saddles before the connection's start in doubles
_START = 1e-7  # distance of that start from its saddle, in units of the expanding side
_DIGITS = 20  # ten beyond the width of the smallest sets
_LEAST_FACTOR = 1e-45  # on that start's distance: below it _BITS hold no difference
_NEWTON_STEPS = 12  # at most; each doubles the digits
_JUMP = 0.1  # in R: neighbours that are further apart have a jump of the map between them
_MOST_IMAGES = 60  # rounds from the start in doubles to y = 0, at most
# The search tries sizes from the largest down by halves. The chain begins where its distance from
# the saddle is _SHARE of the reach of the image of the saddle's set. Farther out the margins of the
# first sets shrink; nearer to the saddle the chain has more sets than it needs.
_SIZES = [1e-3 * 0.5**i for i in range(31)]
_SHARE = 0.65
_MOST_STEPS = 400  # of a chain; a multiplier so near 1 that it needs more is refused

Vector = Sequence[arb]


class Plan(NamedTuple):
    """The number and the shape of the sets."""

    steps: int  # sets of the chain on either side of its middle one
    size: float  # of the sets at the saddles, in (x, y)
    room: float  # factor between widths of a set and its image, where chain and saddles meet


class _Connection(NamedTuple):
    """A hyperbolic orbit and an orbit that leads from its points back to them."""

    surface: Surface
    saddles: list[list[arb]]
    expanding: list[list[arb]]  # sides of the saddles' sets
    mirror: list[int]  # index of each saddle's mirror image
    rho: arb  # by which an impact stretches them
    points: list[Vector]  # of the orbit that leads back
    tangents: list[Vector]  # of the unstable manifold there
    middle: int  # index of the point on y = 0

    def first(self, steps: int) -> int:
        """Return the index of the saddle near which a chain of so many steps begins."""
        return (self.middle - steps) % len(self.saddles)

    def contracting(self, saddle: int) -> list[arb]:
        """Return the contracting side of a saddle's set."""
        return _mirrored(self.expanding[self.mirror[saddle]])

    def distance(self, steps: int) -> arb:
        """Return how far from its saddle the chain begins, in units of the expanding side."""
        first, point = self.first(steps), self.points[self.middle - steps]
        from_saddle = [p - s for p, s in zip(point, self.saddles[first], strict=True)]
        return self.along(from_saddle, first)

    def along(self, vector: Vector, saddle: int) -> arb:
        """Return a vector's part along the expanding side of a saddle's set, in its units."""
        (ux, uy), (sx, sy) = self.expanding[saddle], self.contracting(saddle)
        return abs((vector[0] * sy - vector[1] * sx) / (ux * sy - uy * sx))


def propose(
    theorem: Theorem, side: str = "outer", plan: Plan | None = None, points: Sequence | None = None
) -> str:
    """Return a certificate of a horseshoe on a hyperbolic orbit near points (x, y).

    The side, "outer" or "inner", is that of the unstable branches. Without a plan the sets are the
    largest that the checker accepts. Raises ValueError if the orbit is not its own mirror
    image, the branch does not meet y = 0, the chain does not begin at its saddle, or no size of
    sets proves it: with the reason at the smallest.
    """
    if points is None:
        points = points_of(theorem, "hyperbolic")
    with ctx.workprec(_BITS):
        sign, most = 1 if side == "outer" else -1, _MOST_STEPS if plan is None else plan[0]
        connection = _connect(theorem.bounds["surface"], points, sign, most)
        if plan is not None:
            return _with_margins(connection, Plan(*plan), theorem.prove)
        rho = connection.rho
        room = float(rho.sqrt())
        most = min(most, connection.middle)
        reaches = [float(connection.distance(steps) / rho) for steps in range(most + 1)]
        reason = f"its multiplier {float(rho) ** len(points):.6g} is too near 1"
        for size in _SIZES:
            steps = next((n for n in range(1, most + 1) if reaches[n] < _SHARE * size), 0)
            if not steps:
                break
            try:
                return _with_margins(connection, Plan(steps, size, room), theorem.prove)
            except (NotProvedError, ArithmeticError) as error:
                reason = str(error)
    raise ValueError(f"no size of its sets from {_SIZES[0]:g} to {size:.2g} proves it: {reason}")


def _connect(surface: Surface, points: Sequence, side: int, steps: int) -> _Connection:
    """Follow the branches of a side, up to `steps` points after y = 0."""
    saddles = polished(surface, points, _NEWTON_STEPS)
    mirror = mirrors(saddles)
    rho, expanding = directions(surface, saddles, side)
    multiplier, period = rho ** len(points), len(points)
    start, impacts = _crossing(surface, saddles[0], expanding[0], float(multiplier), period)
    extra = min(_EXTRA_ROUNDS, int(math.log(_LEAST_FACTOR) / -math.log(float(multiplier))))
    impacts += period * extra
    sigma = arb(start) / multiplier**extra
    branch = surface, saddles[0], expanding[0]
    for _ in range(_NEWTON_STEPS):
        track, tangents = _follow(*branch, sigma, impacts)
        step = (track[-1][1] / tangents[-1][1]).mid()
        sigma = (sigma - step).mid()
        if abs(step) < abs(sigma) * arb(2) ** (-_BITS // 2):
            break
    track, tangents = _follow(*branch, sigma, impacts + steps)
    return _Connection(surface, saddles, expanding, mirror, rho, track, tangents, impacts)


def _with_margins(connection: _Connection, plan: Plan, prove: Callable[[str], Finding]) -> str:
    """Return the certificate of a plan, with the margins that its checker measures."""
    text = _text(connection, plan)
    zeros = ["[0.0, 0.0]"] * (len(connection.saddles) + 2 * plan.steps + 2)
    measured = prove(text + rows("margins", zeros)).parts["margins"]
    margins = (", ".join(f"{np.floor(m * 1e7) / 1e7:.7f}" for m in pair) for pair in measured)
    return text + rows("margins", (f"[{pair}]" for pair in margins))


def _times(matrix: Sequence[Vector], vector: Vector) -> list[arb]:
    """Return the product of a matrix, given as rows, and a vector."""
    return [(a * vector[0] + b * vector[1]).mid() for a, b in matrix]


def _length(vector: Vector) -> arb:
    return (vector[0] * vector[0] + vector[1] * vector[1]).sqrt().mid()


def _mirrored(vector: Vector) -> list[arb]:
    return [vector[0], -vector[1]]


def mirrors(saddles: Sequence[Vector]) -> list[int]:
    """Return the index of the mirror image of each point; ValueError if there is none."""
    indices = []
    for x, y in saddles:
        distances = [float(abs(x - a) + abs(y + b)) for a, b in saddles]
        indices.append(int(np.argmin(distances)))
        if min(distances) > 1e-20:
            raise ValueError("the orbit is not its own mirror image: no symmetric connection")
    return indices


def directions(
    surface: Surface, saddles: Sequence[Vector], side: int
) -> tuple[arb, list[list[arb]]]:
    """Return rho, the n-th root of the multiplier, and the unstable directions of n saddles.

    The first is outwards if `side` is 1, inwards if -1. The map takes each to rho times the next.
    """
    orbit = enclose(surface, saddles)
    half, (a, b) = orbit.trace / 2, orbit.matrix.table()[0]
    multiplier = half + (half * half - 1).sqrt()
    vector = [b, multiplier - a]
    vector = [(part / _length(vector)).mid() for part in vector]
    middle = [sum((z[i] for z in saddles), arb(0)) / len(saddles) for i in (0, 1)]
    outward = sum((vector[i] * (saddles[0][i] - middle[i]) for i in (0, 1)), arb(0))
    if (outward > 0) != (side > 0):
        vector = [-a for a in vector]
    rho = (multiplier.log() / len(saddles)).exp().mid()
    vectors = [vector]
    for z in saddles[:-1]:
        image = _times(surface.jacobian(*z)[0], vectors[-1])
        vectors.append([(a / rho).mid() for a in image])
    return rho, vectors


def _crossing(
    surface: Surface, saddle: Vector, vector: Vector, multiplier: float, period: int
) -> tuple[float, int]:
    """Find sigma and impacts: saddle + sigma vector is the first to meet y = 0 at an x > 0."""
    double_map = DoubleMap(surface)
    start, along = (np.array([[float(a)] for a in z]) for z in (saddle, vector))

    def refined(ends: tuple[float, float], impacts: int) -> float | None:
        """Refine the sigma that meets y = 0; None where y jumps across 0."""
        for _ in range(4):
            sigma = np.linspace(*ends, 1001)
            changes = _sign_changes(*double_map.step(start + along * sigma, impacts))
            if not changes.size:
                return None
            ends = float(sigma[changes[0]]), float(sigma[changes[0] + 1])
        return ends[0]

    ends = _START, _START * multiplier
    points = start + along * np.linspace(*ends, 1001)
    for impacts in range(_MOST_IMAGES * period):
        if _sign_changes(*points).size and (sigma := refined(ends, impacts)) is not None:
            return sigma, impacts
        points = double_map.step(points)
    raise ValueError("no branch of the orbit is seen to meet y = 0")


def _sign_changes(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return the indices after which y changes its sign, at x > 0 and without a jump."""
    near = (np.abs(np.diff(x)) < _JUMP) & (x[1:] > 0.0)
    return np.flatnonzero((y[:-1] * y[1:] <= 0.0) & near)


def _follow(
    surface: Surface, point: Vector, vector: Vector, sigma: arb, impacts: int
) -> tuple[list[Vector], list[Vector]]:
    """Return the points of the orbit of point + sigma vector, and their derivatives by sigma."""
    points: list[Vector] = [[(p + sigma * v).mid() for p, v in zip(point, vector, strict=True)]]
    tangents = [vector]
    for _ in range(impacts):
        matrix, image = surface.jacobian(*points[-1])
        points.append([image.x.mid(), image.y.mid()])
        tangents.append(_times(matrix, tangents[-1]))
    return points, tangents


def _text(connection: _Connection, plan: Plan) -> str:
    """Return the certificate without its margins."""
    surface, saddles, expanding, mirror, rho, points, tangents, middle = connection
    steps, first = plan.steps, connection.first(plan.steps)
    begin, end = middle - steps, middle + steps
    leaves = (first - 1) % len(saddles)
    enters = mirror[leaves]
    size, start = arb(plan.size), connection.distance(steps)
    widest = (size * rho - start) / plan.room * _length(expanding[first])
    if not widest > 0:
        raise ValueError(
            f"size = {plan.size:g} is too small for steps = {steps}: the chain begins "
            f"{float(start):.2g} from its saddle, beyond the saddle's set"
        )
    lengths = {i: _length(tangents[i]) for i in range(begin, end + 1)}
    directions = {i: [a / length for a in tangents[i]] for i, length in lengths.items()}
    # the last set's image is to be wider than the saddle's set by the factor `room`
    last = _times(surface.jacobian(*points[end])[0], directions[end])
    reach, stretch = connection.along(last, enters), lengths[end] / lengths[begin]
    kappa = ((widest * stretch * reach / (plan.room * size)).log() / (2 * steps)).exp()
    sides = {
        i: [widest * length / lengths[begin] / kappa ** (i - begin) * a for a in directions[i]]
        for i, length in lengths.items()
    }
    at_saddles = [
        [*z, *(size * a for a in u), *(size * a for a in connection.contracting(i))]
        for i, (z, u) in enumerate(zip(saddles, expanding, strict=True))
    ]
    approach = [
        [*points[i], *sides[i], *_mirrored(sides[2 * middle - i])] for i in range(begin, middle)
    ]
    return (
        header("horseshoe", surface)
        + f"leaves = {leaves}\nenters = {enters}\n"
        + "# a row: centre, expanding side, contracting side\n"
        + rows("saddles", (row(values, _DIGITS) for values in at_saddles))
        + "# up to y = 0; the rest of the chain is the mirror image\n"
        + rows("approach", (row(values, _DIGITS) for values in approach))
        + f"middle = {row((points[middle][0], *sides[middle]), _DIGITS)}\n"
        + "# of each covering: how far beyond its target's edges, and the room within the others\n"
    )
