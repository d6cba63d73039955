"""Certificates of graphs of h-sets: sets at the points of saddles, and chains between them.

Lines along the expanding side of each set are mapped forwards. Wherever their images cross a set
from edge to edge there is a connection, which leads from a strip of the one to the other. Of
connections whose strips overlap, those are chosen that give the largest growth, and the ones that
the checker does not accept are left out.
"""

from collections.abc import Sequence
from fractions import Fraction
from typing import NamedTuple

import numpy as np
from flint import ctx
from scipy.sparse.csgraph import connected_components

from pseudorigid.dynamics.periodic import symmetric_orbits
from pseudorigid.dynamics.variables import chart, states_of

from ..checks import graph, hsets
from ..checks.certificate import NotProvedError
from .certificate_text import header, rows
from .chains import DoubleMap, Parallelogram, chain

_LEAST_TRACE = 4.0  # of a saddle whose points get sets
_LINE_POINTS = 2001  # along a line through a set
_FEWEST_POINTS = 12  # of a line's points in a strip
_ROOM = 0.98  # largest |q| of an image in its target
_STEP = 1.5  # largest step in p from one point of a line's image to the next
_WIDENINGS = 6  # of a strip by a twelfth, until all lines land beyond the target's edges
_CENTRE_DIGITS, _SIDE_DIGITS, _STRIP_DIGITS = 9, 4, 5
_MARGIN = 0.03  # of the coverings along a chain
_HIGHEST = 1.0  # entropy above any of this map


class Crossing(NamedTuple):
    """A connection from the strip low <= p <= high of one set to another."""

    source: int
    target: int
    impacts: int
    low: float
    high: float


def propose(theorem, periods: Sequence[int], size: float, impacts: int) -> str:
    """Return a certificate of a graph with the largest growth that is found.

    There are sets at the points of the symmetric saddles of these periods. `size` is the square
    root of a quarter of a set's area, in (x, y), and `impacts` the most of a connection.
    """
    surface = theorem.bounds["surface"]
    double_map = DoubleMap(surface)
    sets = _sets(double_map, periods, size)
    candidates = dict(enumerate(_crossings(double_map, sets, impacts)))
    texts: dict[int, list[str]] = {}
    while True:
        _, _, chosen = _best(candidates, len(sets))
        new = [i for i in chosen if i not in texts]
        if not new:
            break
        for i in new:
            proved = _proved(surface, double_map, sets, candidates[i])
            if proved is None:
                del candidates[i]
            else:
                candidates[i], texts[i] = proved
    return _text(surface, sets, [(candidates[i], texts[i]) for i in chosen])


def _sets(double_map: DoubleMap, periods: Sequence[int], size: float) -> list[Parallelogram]:
    """Return parallelograms of one area at the points of the saddles, with rounded numbers."""
    sets = []
    for period in periods:
        orbits = symmetric_orbits(double_map.ball, double_map.energy, period)
        for i in range(orbits.sizes["orbit"]):
            orbit = orbits.isel(orbit=i)
            if abs(orbit["trace"].item()) > _LEAST_TRACE:
                points = chart(double_map.ball.k, *states_of(orbit)).T
                sets += _at_saddles(double_map, points, size)
    return sets


def _at_saddles(double_map: DoubleMap, points: np.ndarray, size: float) -> list[Parallelogram]:
    """Return parallelograms along the eigenvectors at the points of a saddle."""
    matrices, sets = [double_map.jacobian(z) for z in points], []
    for i, point in enumerate(points):
        turned = matrices[i:] + matrices[:i]
        values, vectors = np.linalg.eig(np.linalg.multi_dot(turned[::-1]))
        u, s = (vectors[:, j].real for j in np.argsort(-np.abs(values)))
        scale = size / np.sqrt(abs(u[0] * s[1] - u[1] * s[0]))
        sides = (point, scale * u, scale * s)
        sets.append(Parallelogram(*(_rounded(side, _CENTRE_DIGITS) for side in sides)))
    return sets


def _rounded(values: Sequence[float], digits: int) -> np.ndarray:
    return np.array([float(f"{value:.{digits}g}") for value in values])


def _crossings(double_map: DoubleMap, sets: list[Parallelogram], impacts: int) -> list[Crossing]:
    """Return the strips of all sets that cross another set within so many impacts."""
    found = []
    line, edges = np.linspace(-1.0, 1.0, _LINE_POINTS), np.array([-1.0, 0.0, 1.0])
    p, q = np.tile(line, edges.size), np.repeat(edges, line.size)
    for source, of in enumerate(sets):
        points = of.points(p, q)
        for count in range(1, impacts + 1):
            points = double_map.step(points)
            for target, to in enumerate(sets):
                image = to.coordinates(points).reshape(2, edges.size, line.size)
                found += [
                    Crossing(source, target, count, line[i], line[j]) for i, j in _runs(*image)
                ]
    return found


def _runs(p: np.ndarray, q: np.ndarray) -> list[tuple[int, int]]:
    """Return the first and last points of the parts of lines that cross |p|, |q| < 1."""
    runs = []
    inside = np.abs(p[1]) < 1.0
    if not inside.any():
        return runs
    ends = np.flatnonzero(np.diff(inside.astype(int)))
    begins = ends[inside[ends + 1]]
    for begin, end in zip(begins, (ends[ends > i][:1] for i in begins), strict=True):
        if not end.size or end[0] - begin < _FEWEST_POINTS:
            continue
        low, high = begin, end[0] + 1
        step, sign = max(1, (high - low) // 12), np.sign(p[1, high] - p[1, low])
        for _ in range(_WIDENINGS):
            if low < 0 or high >= p.shape[1]:
                break
            on_low, on_high = np.all(sign * p[:, low] < -1.0), np.all(sign * p[:, high] > 1.0)
            if on_low and on_high:
                part = slice(low, high + 1)
                smooth = np.abs(np.diff(p[:, part])).max() < _STEP
                if smooth and np.abs(q[:, part]).max() < _ROOM:
                    runs.append((low, high))
                break
            low, high = low - step * (not on_low), high + step * (not on_high)
    return runs


def _best(candidates: dict[int, Crossing], count: int) -> tuple[float, np.ndarray, list[int]]:
    """Return the largest entropy of disjoint strips, by bisection, its weights and its choice."""
    low, high = 0.0, _HIGHEST
    weights = np.ones(count)
    best, strips = (weights, []), _sorted_strips(candidates, count)
    while high - low > 1e-4:
        entropy = (low + high) / 2.0
        for _ in range(40):
            sums, chosen = _choose(strips, weights, entropy)
            sums = (sums + weights) / 2.0
            factor = sums.max()
            weights = np.maximum(sums / factor, 1e-12)
        if factor > 1.0:
            low, best = entropy, (weights, chosen)
        else:
            high = entropy
    return low, *best


def _sorted_strips(candidates: dict[int, Crossing], count: int) -> list[list[tuple]]:
    """Return, for each set, its strips by their upper ends: (index, strips below it, crossing)."""
    strips = []
    for source in range(count):
        here = sorted((it.high, i) for i, it in candidates.items() if it.source == source)
        highs = [high for high, _ in here]
        strips.append([])
        for n, (_, i) in enumerate(here):
            limit = candidates[i].low - 10.0**-_STRIP_DIGITS
            below = int(np.searchsorted(highs[:n], limit))
            strips[-1].append((i, below, candidates[i].impacts, candidates[i].target))
    return strips


def _choose(strips: list[list[tuple]], weights: np.ndarray, entropy: float):
    """Choose disjoint strips of the largest sum in each set: the sums, and the choice."""
    sums, chosen = np.zeros(weights.size), []
    values, discount = weights.tolist(), np.exp(-entropy)
    for source, here in enumerate(strips):
        best, taken = [0.0], []
        for _, below, impacts, target in here:
            with_it = best[below] + discount**impacts * values[target]
            taken.append(with_it > best[-1])
            best.append(max(with_it, best[-1]))
        sums[source], n = best[-1], len(here)
        while n:
            index, below, *_ = here[n - 1]
            if taken[n - 1]:
                chosen.append(index)
            n = below if taken[n - 1] else n - 1
    return sums, chosen


def _proved(surface, double_map, sets, crossing) -> tuple[Crossing, list[str]] | None:
    """Return the connection that the checker accepts, and the rows of its chain's sets."""
    source, target = sets[crossing.source], sets[crossing.target]
    strip = crossing.low, crossing.high
    found = chain(double_map, source, target, crossing.impacts, strip, _MARGIN)
    if found is None:
        return None
    unit = 10.0**_STRIP_DIGITS  # the strip's ends are rounded outwards
    ends = np.floor(found.low * unit) / unit, np.ceil(found.high * unit) / unit
    strip, chain_rows = [f"{a:.{_STRIP_DIGITS}f}" for a in ends], [_row(it) for it in found.sets]
    try:
        with ctx.workprec(graph.BITS):
            graph.prove_connection(surface, *_connection(source, target, strip, chain_rows))
    except NotProvedError:
        return None
    low, high = map(float, strip)
    return crossing._replace(low=low, high=high), chain_rows


def _row(of: Parallelogram, digits: int = _SIDE_DIGITS) -> str:
    """Format a set as a row of a certificate."""
    centre = [f"{value:.{_CENTRE_DIGITS}g}" for value in of.centre]
    sides = [f"{value:.{digits}g}" for value in (*of.u, *of.s)]
    return f"[{', '.join([*centre, *sides])}]"


def _connection(source, target, strip, chain_rows):
    """Return the sets and the connection as the checker reads them."""
    ends, through = (
        [hsets.hset("a set", [Fraction(a) for a in line.strip("[]").split(", ")]) for line in lines]
        for lines in ([_row(it, _CENTRE_DIGITS) for it in (source, target)], chain_rows)
    )
    low, high = map(Fraction, strip)
    part = graph.part(ends[0], "the strip", low, high)
    return ends, graph.Connection(0, 1, low, high, part, tuple(through))


def _text(surface, sets, chosen) -> str:
    """Return the certificate of the component that grows most, with weights that prove it."""
    joined = np.zeros((len(sets), len(sets)))
    for crossing, _ in chosen:
        joined[crossing.source, crossing.target] = 1.0
    _, component = connected_components(joined, connection="strong")
    inner = [it for it in chosen if component[it[0].source] == component[it[0].target]]
    parts = {
        label: [it for it in inner if component[it[0].source] == label]
        for label in {int(component[crossing.source]) for crossing, _ in inner}
    }
    best = {
        label: _best({n: crossing for n, (crossing, _) in enumerate(part)}, len(sets))
        for label, part in parts.items()
    }
    label = max(best, key=lambda name: best[name][0])
    chosen, (entropy, weights, _) = parts[label], best[label]
    kept = np.flatnonzero(component == label)
    growth = f"{np.exp(entropy - 1e-4):.6f}"
    place = {int(i): n for n, i in enumerate(kept)}
    chosen.sort(key=lambda it: (it[0].source, it[0].low))
    connections = [
        f"[{place[it.source]}, {place[it.target]}, {it.low:.{_STRIP_DIGITS}f}, "
        f"{it.high:.{_STRIP_DIGITS}f}, {it.impacts}]"
        for it, _ in chosen
    ]
    return (
        header("graph", surface)
        + "# a row: centre, expanding side, contracting side\n"
        + rows("sets", (_row(sets[i], _CENTRE_DIGITS) for i in kept))
        + "# from and to which set, the strip's ends in the first one's p, and impacts\n"
        + rows("connections", connections)
        + "# between the strip and the set, one connection after the other\n"
        + rows("chains", (line for _, lines in chosen for line in lines))
        + "# the number of paths grows by this factor an impact, as the weights of the sets prove\n"
        + f"growth = {growth}\n"
        + f"weights = [{', '.join(f'{weights[i]:.6g}' for i in kept)}]\n"
    )
