"""Certificates of horseshoes: sets at the saddles and along a connection between two of them.

Work is in coordinates in which the map stretches by the same factor rho at each saddle. A set's
expanding side is tangent to the unstable manifold, its contracting side, the mirror image at the
mirrored set, tangent to the stable one; so the map is all but diagonal from set to set. Along the
chain the sets grow by the manifold's stretch divided by one factor kappa > 1, which is what they
stretch beyond each other.
"""

import math
from dataclasses import dataclass

import numpy as np
from flint import arb, ctx

from ..checks.certificate import NotProvedError
from .certificate_text import decimal, decimals, header, rows
from .periodic import polished

BITS = 320  # for an orbit that starts DEEP rounds nearer to its saddle than a double can tell
DEEP = 100  # rounds about the saddles before the float's start of the connection
START = 1e-7  # distance of that start from its saddle, in units of the expanding side
DIGITS = 20  # ten beyond the width of the smallest sets
NEARER = 1e-45  # of that start's distance, at least: beyond it BITS hold no difference
NEWTON_STEPS = 12  # at most; each doubles the digits
FAR = 0.1  # in R: neighbours that are further apart have a jump of the map between them
MOST_IMAGES = 60  # rounds from the float's start to y = 0, at most
# The search tries sizes from the largest down by halves. The chain begins where it is by SHARE as
# far from its saddle as the image of the saddle's set reaches: farther out the margins of the
# first sets shrink, nearer to the saddle the chain has more sets than it needs.
SIZES = [1e-3 * 0.5**i for i in range(31)]
SHARE = 0.65
MOST_STEPS = 400  # of a chain; a multiplier so near 1 that it needs more is refused


@dataclass(frozen=True)
class Plan:
    """Which connection, and the shape of the sets.

    Parameters
    ----------
    side : int
        1 the outer, -1 the inner unstable branches.
    steps : int
        Sets of the chain on either side of its middle one.
    size : float
        Of the sets at the saddles, in (x, y).
    room : float
        How much wider than its image, or narrower, a set is where chain and saddles meet.
    """

    side: int
    steps: int
    size: float
    room: float


@dataclass(frozen=True)
class _Connection:
    """A hyperbolic orbit and an orbit that leads from its points back to them.

    Parameters
    ----------
    surface : Surface
    saddles, expanding : list of (arb, arb)
        The orbit's points, and their unstable directions, all stretched by `rho`.
    mirror : list of int
        The index of each point's mirror image.
    rho : arb
    points, tangents : list of (arb, arb)
        Of the connection.
    middle : int
        Index of its point on y = 0.
    """

    surface: object
    saddles: list
    expanding: list
    mirror: list
    rho: object
    points: list
    tangents: list
    middle: int

    def first(self, steps):
        """The index of the saddle near which a chain of so many steps begins."""
        return (self.middle - steps) % len(self.saddles)

    def distance(self, steps):
        """How far from its saddle the chain begins, in units of the expanding side."""
        first = self.first(steps)
        contracting = _mirror(self.expanding[self.mirror[first]])
        place = self.points[self.middle - steps]
        return abs(_along(place, self.saddles[first], self.expanding[first], contracting))


def _connect(surface, ball, points, side, steps):
    """The _Connection by the branches of a side, with `steps` points after y = 0."""
    saddles = polished(surface, points, NEWTON_STEPS)
    mirror = _mirror_images(saddles)
    rho, expanding = _directions(surface, saddles, side)
    multiplier = rho ** len(points)
    numbers = [[float(a) for a in pair] for pair in (saddles[0], expanding[0])]
    sigma, impacts = _start(ball, float(surface.energy), *numbers, float(multiplier), len(points))
    deep = min(DEEP, int(math.log(NEARER) / -math.log(float(multiplier))))
    impacts += len(points) * deep
    sigma = arb(sigma) / multiplier**deep
    track = _follow_to_axis(surface, saddles[0], expanding[0], sigma, impacts, steps)
    return _Connection(surface, saddles, expanding, mirror, rho, *track, impacts)


def propose(surface, ball, points, plan, prove):
    """A certificate of a horseshoe.

    Parameters
    ----------
    surface : Surface
    ball : Ball
        Near the surface's.
    points : list of (float, float)
        The hyperbolic orbit, (x, y); its own mirror image.
    plan : Plan
    prove : callable
        What a checker finds of a text, with margins [(beyond, room), ...] of the coverings, in
        order, among its parts.

    Returns
    -------
    str

    Raises
    ------
    ValueError
        An orbit that is not its own mirror image, a branch that does not meet y = 0, or a plan
        whose chain does not begin at its saddle.
    """
    with ctx.workprec(BITS):
        found = _connect(surface, ball, points, plan.side, plan.steps)
        return _with_margins(found, plan, prove)


def search(surface, ball, points, prove, side):
    """A certificate of a horseshoe, with the largest sets for which a checker takes one.

    Parameters
    ----------
    surface, ball, points, prove
        As for `propose`.
    side : int
        1 the outer, -1 the inner unstable branches.

    Returns
    -------
    str

    Raises
    ------
    ValueError
        As for `propose`, or where no size proves it: with the reason at the smallest.
    """
    with ctx.workprec(BITS):
        found = _connect(surface, ball, points, side, MOST_STEPS)
        room = float(found.rho.sqrt())
        most = min(MOST_STEPS, found.middle)
        reaches = [float(found.distance(steps) / found.rho) for steps in range(most + 1)]
        reason = f"its multiplier {float(found.rho) ** len(points):.6g} is too near 1"
        for size in SIZES:
            steps = next((n for n in range(1, most + 1) if reaches[n] < SHARE * size), None)
            if steps is None:
                break
            try:
                return _with_margins(found, Plan(side, steps, size, room), prove)
            except (NotProvedError, ArithmeticError) as error:
                reason = str(error)
    raise ValueError(f"no size of its sets from {SIZES[0]:g} to {size:.2g} proves it: {reason}")


def _with_margins(found, plan, prove):
    """The certificate of a plan, with the margins that its checker measures."""
    text = _text(found, plan)
    free = [["0.0", "0.0"]] * (len(found.saddles) + 2 * plan.steps + 2)
    measured = prove(text + rows("margins", free)).parts["margins"]
    margins = [[f"{np.floor(m * 1e7) / 1e7:.7f}" for m in pair] for pair in measured]
    return text + rows("margins", margins)


def _times(matrix, vector):
    return [(row[0] * vector[0] + row[1] * vector[1]).mid() for row in matrix]


def _length(vector):
    return (vector[0] * vector[0] + vector[1] * vector[1]).sqrt().mid()


def _mirror_images(saddles):
    """Index of the mirror image of each point; ValueError where the orbit has none."""
    found = []
    for x, y in saddles:
        gaps = [float(abs(x - a) + abs(y + b)) for a, b in saddles]
        found.append(int(np.argmin(gaps)))
        if min(gaps) > 1e-20:
            raise ValueError("the orbit is not its own mirror image: no symmetric connection")
    return found


def _directions(surface, saddles, side):
    """rho, and at each saddle the unstable direction, all stretched by rho; outer for side = 1."""
    slopes = [surface.jacobian(*z)[0] for z in saddles]
    vector = [arb(1), arb(0)]
    for _ in range(400):
        size = _length(vector)
        vector = [(a / size).mid() for a in vector]
        for matrix in slopes:
            vector = _times(matrix, vector)
    multiplier = _length(vector)
    vector = [(a / multiplier).mid() for a in vector]
    middle = [sum((z[i] for z in saddles), arb(0)) / len(saddles) for i in (0, 1)]
    outward = sum((vector[i] * (saddles[0][i] - middle[i]) for i in (0, 1)), arb(0))
    if (outward > 0) != (side > 0):
        vector = [-a for a in vector]
    rho = (multiplier.log() / len(saddles)).exp().mid()
    found = [vector]
    for matrix in slopes[:-1]:
        found.append([(a / rho).mid() for a in _times(matrix, found[-1])])
    return rho, found


def _start(ball, energy, saddle, vector, multiplier, period):
    """(sigma, impacts): where the branch saddle + sigma vector first meets y = 0 at an x > 0."""
    ends = START, START * multiplier
    _, state = _segment(ball, energy, saddle, vector, *ends)
    for impacts in range(MOST_IMAGES * period):
        if _changes(ball, state).size:
            sigma = _refined(ball, energy, saddle, vector, ends, impacts)
            if sigma is not None:
                return sigma, impacts
        ball.map.steps(*state, ball.k, ball.g, 1, np.empty(state[0].size))
    raise ValueError("no branch of the orbit is seen to meet y = 0")


def _refined(ball, energy, saddle, vector, ends, impacts):
    """The sigma from which y = 0 is met after so many impacts; None where y jumps across 0."""
    for _ in range(4):
        sigma, state = _segment(ball, energy, saddle, vector, *ends)
        ball.map.steps(*state, ball.k, ball.g, impacts, np.empty(sigma.size))
        changes = _changes(ball, state)
        if not changes.size:
            return None
        ends = sigma[changes[0]], sigma[changes[0] + 1]
    return ends[0]


def _segment(ball, energy, saddle, vector, low, high):
    """Parameters from low to high and the states at saddle + sigma vector."""
    sigma = np.linspace(low, high, 1001)
    place = (saddle[0] + sigma * vector[0], saddle[1] + sigma * vector[1])
    return sigma, [np.array(a) for a in ball.state_xy(*place, energy)]


def _changes(ball, state):
    """Where y changes sign from one state to the next, at x > 0, without a jump."""
    x, y = state[0], state[1] - ball.k * state[2]
    near = (np.abs(np.diff(x)) < FAR) & (x[1:] > 0.0)
    return np.flatnonzero((y[:-1] * y[1:] <= 0.0) & near)


def _follow(surface, point, vector, sigma, impacts):
    """Points of the orbit of point + sigma vector, and their derivatives by sigma."""
    points = [[(p + sigma * v).mid() for p, v in zip(point, vector, strict=True)]]
    tangents = [vector]
    for _ in range(impacts):
        matrix, image = surface.jacobian(*points[-1])
        points.append([image.x.mid(), image.y.mid()])
        tangents.append(_times(matrix, tangents[-1]))
    return points, tangents


def _follow_to_axis(surface, saddle, vector, sigma, before, after):
    """Points and tangents from `before` impacts before y = 0 to `after` impacts after it."""
    for _ in range(NEWTON_STEPS):
        points, tangents = _follow(surface, saddle, vector, sigma, before)
        step = (points[-1][1] / tangents[-1][1]).mid()
        sigma = (sigma - step).mid()
        if abs(step) < abs(sigma) * arb(2) ** (-BITS // 2):
            break
    return _follow(surface, saddle, vector, sigma, before + after)


def _mirror(vector):
    return [vector[0], -vector[1]]


def _text(found, plan):
    """The certificate without its margins."""
    surface, saddles, expanding = found.surface, found.saddles, found.expanding
    points, tangents, middle = found.points, found.tangents, found.middle
    count, steps, first = len(saddles), plan.steps, found.first(plan.steps)
    chain = range(middle - steps, middle + steps + 1)
    directions = {i: [a / _length(tangents[i]) for a in tangents[i]] for i in chain}
    begin, end = chain[0], chain[-1]
    leaves = (first - 1) % count
    enters = found.mirror[leaves]
    contracting = [_mirror(expanding[i]) for i in found.mirror]
    size, start = arb(plan.size), found.distance(steps)
    widest = (size * found.rho - start) / plan.room * _length(expanding[first])
    if not widest > 0:
        raise ValueError(
            f"size = {plan.size:g} is too small for steps = {steps}: the chain begins "
            f"{float(start):.2g} from its saddle, beyond the saddle's set"
        )
    # the last set's image is to be `allocate_buffers` times as wide as the saddle's set
    last = _times(surface.jacobian(*points[end])[0], directions[end])
    reach = _along(last, (0, 0), expanding[enters], contracting[enters])
    stretch = _length(tangents[end]) / _length(tangents[begin])
    kappa = ((widest * stretch * abs(reach) / (plan.room * size)).log() / (2 * steps)).exp()
    widths = {
        i: widest * _length(tangents[i]) / _length(tangents[begin]) / kappa ** (i - begin)
        for i in chain
    }
    sides = {i: [widths[i] * a for a in directions[i]] for i in chain}
    at_saddles = [
        [*z, *(size * a for a in u), *(size * a for a in s)]
        for z, u, s in zip(saddles, expanding, contracting, strict=True)
    ]
    approach = [[*points[i], *sides[i], *_mirror(sides[2 * middle - i])] for i in chain[:steps]]
    half = [decimal(a, DIGITS) for a in (points[middle][0], *sides[middle])]
    return (
        header("horseshoe", surface)
        + f"leaves = {leaves}\nenters = {enters}\n"
        + "# a row: centre, expanding side, contracting side\n"
        + rows("saddles", decimals(at_saddles, DIGITS))
        + "# up to y = 0; the rest of the chain is the mirror image\n"
        + rows("approach", decimals(approach, DIGITS))
        + f"middle = [{', '.join(half)}]\n"
        + "# of each covering: how far beyond its target's edges, and the room within the others\n"
    )


def _along(point, origin, expanding, contracting):
    """How far from the origin a point lies along the expanding side, in units of that side."""
    (ux, uy), (sx, sy) = expanding, contracting
    dx, dy = (p - o for p, o in zip(point, origin, strict=True))
    return (dx * sy - dy * sx) / (ux * sy - uy * sx)
