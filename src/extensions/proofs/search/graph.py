"""Certificates of graphs of h-sets: sets at the points of saddles, and chains between them.

Lines along the expanding side of each set are mapped forwards. Wherever their images cross a set
from edge to edge there is a connection, which leads from a strip of the one to the other. Of
connections whose strips overlap, those are chosen that give the largest growth, and the ones that
the checker does not accept are left out. A set is centre + p u + q s, |p|, |q| <= 1, with u its
expanding and s its contracting side.
"""

from bisect import bisect_left
from collections.abc import Sequence
from fractions import Fraction
from math import ceil, floor
from typing import NamedTuple

import numpy as np
from flint import ctx
from scipy.sparse.csgraph import connected_components

from pseudorigid.dynamics.periodic import symmetric_orbits
from pseudorigid.dynamics.variables import chart, states_of
from pseudorigid.verified.flight import NotProvedError

from ..checkers import graph, hsets
from ..enclosure.surface import Surface
from .certificate_text import Theorem, header, rows
from .chains import DoubleMap, Parallelogram, chain

_LEAST_TRACE = 4.0  # of a saddle whose points get sets
_LINE_POINTS = 2001  # along a line through a set
_FEWEST_POINTS = 12  # of a line's points in a strip
_ROOM = 0.98  # largest |q| of an image in its target
_STEP = 1.5  # largest step in p from one point of a line's image to the next
_WIDENINGS = 6  # of a strip, by a twelfth each, to make its lines end beyond the target's edges
_CENTRE_DIGITS, _SIDE_DIGITS, _STRIP_DIGITS = 9, 4, 5
_MARGIN = 0.03  # of the coverings along a chain
_HIGHEST = 1.0  # end of the bisection; the map's entropy is lower
_ITERATIONS = 40  # of the weights, at each entropy
_ENTROPY_ERROR = 1e-4  # of the largest growth that is found


class Crossing(NamedTuple):
    """A connection from the strip low <= p <= high of one set to another."""

    source: int
    target: int
    impacts: int
    low: float
    high: float


class Growth(NamedTuple):
    """The largest entropy of crossings whose strips are disjoint."""

    entropy: float
    weights: np.ndarray  # of the sets; the checker decides whether they prove the growth
    chosen: list[int]  # numbers of the crossings


def propose(theorem: Theorem, periods: Sequence[int], size: float, impacts: int) -> str:
    """Return a certificate of the graph whose number of paths grows fastest, as far as is found.

    There are sets at the points of the symmetric saddles of these periods. `size` is the square
    root of a quarter of a set's area in (x, y), and `impacts` the largest number of impacts of a
    connection.
    """
    surface = theorem.bounds["surface"]
    double_map = DoubleMap(surface)
    sets = _sets(double_map, periods, size)
    candidates = dict(enumerate(_crossings(double_map, sets, impacts)))
    chains: dict[int, list[str]] = {}
    while True:
        chosen = _largest_growth(candidates, len(sets)).chosen
        new = [number for number in chosen if number not in chains]
        if not new:
            break
        for number in new:
            proved = _proved(surface, double_map, sets, candidates[number])
            if proved is None:
                del candidates[number]
            else:
                candidates[number], chains[number] = proved
    candidates = {number: candidates[number] for number in chosen}
    kept, crossings, growth = _best_component(candidates, len(sets))
    numbers = sorted(crossings, key=lambda it: (crossings[it].source, crossings[it].low))
    connections = [(crossings[number], chains[number]) for number in numbers]
    return _text(surface, {i: sets[i] for i in kept}, connections, growth)


def _sets(double_map: DoubleMap, periods: Sequence[int], size: float) -> list[Parallelogram]:
    """Return parallelograms of one area at the points of the saddles, with rounded numbers."""
    sets = []
    for period in periods:
        orbits = symmetric_orbits(double_map.ball, double_map.energy, period)
        for i in np.flatnonzero(np.abs(orbits["trace"].values) > _LEAST_TRACE):
            points = chart(double_map.ball.k, *states_of(orbits.isel(orbit=i))).T
            sets += _at_saddles(double_map, points, size)
    return sets


def _at_saddles(double_map: DoubleMap, points: np.ndarray, size: float) -> list[Parallelogram]:
    """Return parallelograms along the eigenvectors at the points of one saddle."""
    matrices, sets = [double_map.jacobian(z) for z in points], []
    for i, point in enumerate(points):
        turned = matrices[i:] + matrices[:i]
        values, vectors = np.linalg.eig(np.linalg.multi_dot(turned[::-1]))
        u, s = (vectors[:, j].real for j in np.argsort(-np.abs(values)))
        scale = size / np.sqrt(abs(u[0] * s[1] - u[1] * s[0]))
        rounded = (
            np.array([float(f"{value:.{_CENTRE_DIGITS}g}") for value in side])
            for side in (point, scale * u, scale * s)
        )
        sets.append(Parallelogram(*rounded))
    return sets


def _crossings(double_map: DoubleMap, sets: list[Parallelogram], impacts: int) -> list[Crossing]:
    """Return the strips of all sets that cross another set within so many impacts."""
    found = []
    line, edges = np.linspace(-1.0, 1.0, _LINE_POINTS), np.array([-1.0, 0.0, 1.0])
    p, q = np.tile(line, edges.size), np.repeat(edges, line.size)
    for source, source_set in enumerate(sets):
        points = source_set.points(p, q)
        for count in range(1, impacts + 1):
            points = double_map.step(points)
            for target, target_set in enumerate(sets):
                image = target_set.coordinates(points).reshape(2, edges.size, line.size)
                found += [
                    Crossing(source, target, count, line[i], line[j]) for i, j in _runs(*image)
                ]
    return found


def _runs(p: np.ndarray, q: np.ndarray) -> list[tuple[int, int]]:
    """Return the ends of the parts of three lines that cross |p| < 1 within |q| < 1.

    p and q have a row for each of the source's lines q = -1, 0, 1. Parts with a jump are left out.
    """
    inside = np.abs(p[1]) < 1.0
    changes = np.flatnonzero(np.diff(inside))
    begins, ends = changes[~inside[changes]], changes[inside[changes]] + 1
    # An end without a beginning is dropped, and so is a beginning without an end.
    pairs = zip(begins, ends[int(inside[0]) :], strict=False)
    wide = [_crossing_range(p, low, high) for low, high in pairs if high - low > _FEWEST_POINTS]
    return [
        (low, high)
        for low, high in filter(None, wide)
        if np.abs(np.diff(p[:, low:high])).max() < _STEP and np.abs(q[:, low:high]).max() < _ROOM
    ]


def _crossing_range(p: np.ndarray, low: int, high: int) -> tuple[int, int] | None:
    """Widen a part of lines until all of them begin and end beyond |p| = 1; None if that fails."""
    step, sign = max(1, (high - low) // 12), np.sign(p[1, high] - p[1, low])
    for _ in range(_WIDENINGS):
        if low < 0 or high >= p.shape[1]:
            return None
        on_low, on_high = np.all(sign * p[:, low] < -1.0), np.all(sign * p[:, high] > 1.0)
        if on_low and on_high:
            return low, high
        low, high = low - step * (not on_low), high + step * (not on_high)
    return None


def _largest_growth(crossings: dict[int, Crossing], count: int) -> Growth:
    """Find the largest entropy at which the weights of the sets still grow, by bisection.

    Each iteration takes the mean of a set's weight and of the largest sum, over disjoint strips, of
    exp(-entropy impacts) times the target's weight, and divides it by the largest mean. If that is
    above 1, the weights grow.
    """
    low, high = 0.0, _HIGHEST
    weights = np.ones(count)
    best, strips = Growth(low, weights, []), _in_order(crossings, count)
    while high - low > _ENTROPY_ERROR:
        entropy = (low + high) / 2.0
        for _ in range(_ITERATIONS):
            sums, chosen = _choose(strips, weights, entropy)
            sums = (sums + weights) / 2.0  # cycles of one length would oscillate
            factor = sums.max()
            weights = np.maximum(sums / factor, 1e-12)
        if factor > 1.0:
            low, best = entropy, Growth(entropy, weights, chosen)
        else:
            high = entropy
    return best


def _in_order(crossings: dict[int, Crossing], count: int) -> list[list[tuple[int, int, Crossing]]]:
    """Return (number, strips wholly below, crossing) of each set's strips, by upper ends."""
    strips: list[list[tuple[int, int, Crossing]]] = [[] for _ in range(count)]
    for number, it in sorted(crossings.items(), key=lambda pair: (pair[1].high, pair[0])):
        here = strips[it.source]
        limit = it.low - 10.0**-_STRIP_DIGITS
        here.append((number, bisect_left(here, limit, key=lambda strip: strip[2].high), it))
    return strips


def _choose(
    strips: list[list[tuple[int, int, Crossing]]], weights: np.ndarray, entropy: float
) -> tuple[np.ndarray, list[int]]:
    """Choose disjoint strips of the largest sum in each set: return the sums, and the numbers.

    This is weighted interval scheduling.
    """
    sums, chosen = np.zeros(weights.size), []
    values, discount = weights.tolist(), np.exp(-entropy)
    for source, here in enumerate(strips):
        best, taken = [0.0], []
        for _, below, crossing in here:
            with_it = best[below] + discount**crossing.impacts * values[crossing.target]
            taken.append(with_it > best[-1])
            best.append(max(with_it, best[-1]))
        sums[source], n = best[-1], len(here)
        while n:  # back through the choices
            number, below, _ = here[n - 1]
            if taken[n - 1]:
                chosen.append(number)
            n = below if taken[n - 1] else n - 1
    return sums, chosen


def _proved(
    surface: Surface, double_map: DoubleMap, sets: list[Parallelogram], crossing: Crossing
) -> tuple[Crossing, list[str]] | None:
    """Return a connection that the checker accepts, and the rows of its chain's sets, or None."""
    ends = sets[crossing.source], sets[crossing.target]
    strip = crossing.low, crossing.high
    found = chain(double_map, *ends, crossing.impacts, strip, _MARGIN)
    if found is None:
        return None
    unit = 10**_STRIP_DIGITS  # the strip's ends are rounded outwards
    low, high = Fraction(floor(found.low * unit), unit), Fraction(ceil(found.high * unit), unit)
    chain_rows = [_row(it) for it in found.sets]
    try:
        with ctx.workprec(graph.BITS):
            source, target = (_hset(_row(it, _CENTRE_DIGITS)) for it in ends)
            part = graph.part(source, "the strip", low, high)
            between = tuple(map(_hset, chain_rows))
            connection = graph.Connection(0, 1, low, high, part, between)
            graph.prove_connection(surface, [source, target], connection)
    except NotProvedError:
        return None
    return crossing._replace(low=float(low), high=float(high)), chain_rows


def _row(of: Parallelogram, digits: int = _SIDE_DIGITS) -> str:
    """Format a set as a row of a certificate."""
    centre = [f"{value:.{_CENTRE_DIGITS}g}" for value in of.centre]
    sides = [f"{value:.{digits}g}" for value in (*of.u, *of.s)]
    return f"[{', '.join([*centre, *sides])}]"


def _hset(row: str) -> hsets.HSet:
    """Return the set of a certificate's row, as the checker reads it."""
    return hsets.hset("a set", [Fraction(a) for a in row.strip("[]").split(", ")])


def _best_component(
    crossings: dict[int, Crossing], count: int
) -> tuple[list[int], dict[int, Crossing], Growth]:
    """Return the sets of the component that grows most, the crossings in it, and its growth."""
    joined = np.zeros((count, count))
    for it in crossings.values():
        joined[it.source, it.target] = 1.0
    _, component = connected_components(joined, connection="strong")
    parts: dict[int, dict[int, Crossing]] = {}
    for number, it in crossings.items():
        if component[it.source] == component[it.target]:
            parts.setdefault(component[it.source], {})[number] = it
    growths = {label: _largest_growth(part, count) for label, part in parts.items()}
    label = max(growths, key=lambda it: growths[it].entropy)
    return np.flatnonzero(component == label).tolist(), parts[label], growths[label]


def _text(
    surface: Surface,
    sets: dict[int, Parallelogram],
    connections: list[tuple[Crossing, list[str]]],
    growth: Growth,
) -> str:
    """Format the certificate of some sets and of the connections, each with its chain's rows."""
    place = {i: n for n, i in enumerate(sets)}
    lines = [
        f"[{place[it.source]}, {place[it.target]}, {it.low:.{_STRIP_DIGITS}f}, "
        f"{it.high:.{_STRIP_DIGITS}f}, {it.impacts}]"
        for it, _ in connections
    ]
    return (
        header("graph", surface)
        + "# a row: centre, expanding side, contracting side\n"
        + rows("sets", (_row(it, _CENTRE_DIGITS) for it in sets.values()))
        + "# from and to which set, the strip's ends in the first one's p, and impacts\n"
        + rows("connections", lines)
        + "# between the strip and the set, one connection after the other\n"
        + rows("chains", (line for _, chain_rows in connections for line in chain_rows))
        + "# the number of paths grows by this factor an impact, as the weights of the sets prove\n"
        + f"growth = {np.exp(growth.entropy - _ENTROPY_ERROR):.6f}\n"
        + f"weights = [{', '.join(f'{growth.weights[i]:.6g}' for i in sets)}]\n"
    )
