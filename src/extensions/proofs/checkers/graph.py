"""A graph of h-sets: sets, joined by chains of coverings, and its entropy from below.

A connection leads from a strip of one set B_i, low <= p <= high, to a whole set B_j: the strip
covers the first set of the connection's chain, each of these covers the next one, and the last one
covers B_j. theory/entropy.md has the theorem.
"""

from fractions import Fraction
from itertools import pairwise
from typing import NamedTuple

from flint import ctx

from pseudorigid.verified.flight import NotProvedError

from ..enclosure.surface import Surface, ball_of
from . import hsets
from .certificate import Certificate, Finding, lower_bound
from .hsets import HSet

BITS = 64  # the smallest sets are 1e-6 wide, and one machine word is 1e-19 fine


class Connection(NamedTuple):
    """A chain of coverings from the strip low <= p <= high of one set to another set."""

    source: int
    target: int
    low: Fraction
    high: Fraction
    strip: HSet
    chain: tuple[HSet, ...]

    @property
    def impacts(self) -> int:
        """Number of impacts from the strip to the target."""
        return len(self.chain) + 1


class Graph(NamedTuple):
    """Sets and the connections between them."""

    sets: list[HSet]
    connections: list[Connection]


def check(text: str, surface: Surface, *, entropy: Fraction) -> Finding:
    """Prove that the entropy of a certificate's graph, in nats per impact, is above the given one.

    The margins are the least over all relations, and over the gaps between the strips of a set. The
    parts are the graph and the growth.
    """
    certificate = Certificate(text, "graph", surface)
    with ctx.workprec(BITS):
        graph = read(certificate)
        apart = check_strips(graph)
        growth = certificate.number("growth")
        check_growth(graph, growth, certificate.row("weights", len(graph.sets)))
        bound = ball_of(growth).log()
        if not bound > ball_of(entropy):
            raise NotProvedError(f"the entropy is not proved to be above {float(entropy)}")
        margins = [prove_connection(surface, graph.sets, it) for it in graph.connections]
        beyond, room = map(min, zip(*margins, strict=True))
        return Finding(
            {"entropy": bound}, {"beyond": beyond, "room": room, "apart": apart}, {"graph": graph}
        )


def read(certificate: Certificate) -> Graph:
    """Return the graph of a certificate; raises NotProvedError where it is none."""
    sets = hsets.read_sets(certificate, "sets", "B")
    rows = iter(certificate.numbers("chains", 6))
    connections = []
    for n, row in enumerate(certificate.numbers("connections", 5)):
        *ends, low, high, impacts = row
        if not {*ends} <= set(range(len(sets))) or impacts < 1 or impacts.denominator != 1:
            raise NotProvedError(f"connection {n} does not lead from a set to a set")
        if not -1 <= low < high <= 1:
            raise NotProvedError(f"the strip of connection {n} is not a part of its set")
        source, target = map(int, ends)
        taken = [row for _, row in zip(range(int(impacts) - 1), rows, strict=False)]
        if len(taken) < impacts - 1:
            raise NotProvedError(f"the certificate lacks sets of connection {n}")
        chain = (hsets.hset(f"set {i} of connection {n}", row) for i, row in enumerate(taken, 1))
        strip = part(sets[source], f"the strip of connection {n}", low, high)
        connections.append(Connection(source, target, low, high, strip, tuple(chain)))
    if next(rows, None) is not None:
        raise NotProvedError("the certificate has more sets than its connections take")
    return Graph(sets, connections)


def part(of: HSet, name: str, low: Fraction, high: Fraction) -> HSet:
    """Return the strip low <= p <= high of a set."""
    (x, y), (ux, uy) = of.centre, of.u
    middle, half = ball_of((low + high) / 2), ball_of((high - low) / 2)
    return HSet(name, (x + middle * ux, y + middle * uy), (half * ux, half * uy), of.s)


def check_strips(graph: Graph) -> float:
    """Check that the strips of each set are disjoint, and return the least gap, in its p."""
    gaps = [Fraction(2)]
    for source in range(len(graph.sets)):
        strips = sorted((it.low, it.high) for it in graph.connections if it.source == source)
        gaps += [right[0] - left[1] for left, right in pairwise(strips)]
        if not min(gaps) > 0:
            raise NotProvedError(f"two strips of B_{source} overlap")
    return lower_bound(ball_of(min(gaps)))


def check_growth(graph: Graph, growth: Fraction, weights: list[Fraction]) -> None:
    """Check by positive weights that the number of paths grows by at least `growth` an impact.

    The sum of growth^-impacts times the target's weight, over the connections that leave a set, is
    to be at least the set's weight: exactly, in rational numbers.
    """
    if not growth > 1:
        raise NotProvedError("the growth is not above 1")
    sums = [Fraction(0)] * len(weights)
    for it in graph.connections:
        sums[it.source] += weights[it.target] / growth**it.impacts
    for i, (weight, total) in enumerate(zip(weights, sums, strict=True)):
        if not weight > 0:
            raise NotProvedError(f"the weight of B_{i} is not positive")
        if not total >= weight:
            raise NotProvedError(f"the growth is not proved: at B_{i} the weights do not grow")


def prove_connection(
    surface: Surface, sets: list[HSet], connection: Connection
) -> tuple[float, float]:
    """Prove the coverings of a connection, and return the least of each of their two margins.

    Raises NotProvedError.
    """
    path = [connection.strip, *connection.chain, sets[connection.target]]
    margins = [hsets.prove_covering(surface, *pair) for pair in pairwise(path)]
    beyond, room = map(min, zip(*margins, strict=True))
    return beyond, room
