"""Graphs of coverings: entropy, refused certificates, and the growth of a material line."""

import tomllib
from fractions import Fraction
from functools import cache
from itertools import pairwise

import numpy as np
import pytest
from certificates import numbers, refused, with_field, with_rows
from flint import arb, ctx

from extensions.proofs import THEOREMS
from extensions.proofs.checkers import jump
from extensions.proofs.checkers.certificate import NotProvedError
from extensions.proofs.checkers.hsets import HSet, LocalMap, covering_margins
from extensions.proofs.search.chains import DoubleMap, Parallelogram

SMALL = "entropy-lower"
TEXT = THEOREMS[SMALL].text()


@cache
def proved(name):
    """The parts of the finding about a theorem's own certificate, and the digits."""
    finding = THEOREMS[name].prove()
    return finding.parts, finding.digits


def changed(row, column, change):
    """The certificate with a function applied to a number of a connection."""
    rows = numbers(TEXT, "connections")
    rows[row][column] = f'"{change(Fraction(rows[row][column]))}"'
    return with_rows(TEXT, "connections", rows)


def in_doubles(hset):
    """An h-set of a checker as one of a search."""
    sides = (hset.centre, hset.u, hset.s)
    return Parallelogram(*(np.array([float(a) for a in side]) for side in sides))


def test_the_entropy_is_that_of_the_paths():
    """The logarithm of the spectral radius of the matrix with a vertex for each impact."""
    parts, digits = proved(SMALL)
    sets, connections = parts["graph"].sets, parts["graph"].connections
    size = len(sets) + sum(it.impacts - 1 for it in connections)
    matrix, free = np.zeros((size, size)), len(sets)
    for it in connections:
        path = [it.source, *range(free, free + it.impacts - 1), it.target]
        free += it.impacts - 1
        for a, b in pairwise(path):
            matrix[a, b] += 1.0
    entropy = np.log(np.abs(np.linalg.eigvals(matrix)).max())
    with ctx.workprec(64):
        bound = float(digits["entropy"])
    assert float(THEOREMS[SMALL].bounds["entropy"]) < bound < entropy < bound + 5e-4


@pytest.mark.parametrize("name", [SMALL, "horseshoe-outer"])
def test_coverings_hold_for_points_in_doubles(name):
    double_map = DoubleMap(THEOREMS[name].bounds["surface"])
    edge = np.linspace(-1.0, 1.0, 21)
    parts, _ = proved(name)
    pairs = parts["edges"] if "edges" in parts else [
        pair for it in parts["graph"].connections
        for pair in pairwise([it.strip, *it.chain, parts["graph"].sets[it.target]])
    ]  # fmt: skip
    for source, target in (map(in_doubles, pair) for pair in pairs):
        left, right = (
            target.coordinates(double_map.step(source.points(np.full(edge.size, p), edge)))
            for p in (-1.0, 1.0)
        )
        assert np.abs([left[1], right[1]]).max() < 1
        assert np.abs([left[0], right[0]]).min() > 1
        assert np.all(np.sign(left[0]) == -np.sign(right[0]))


@pytest.mark.parametrize("reach", [arb(1, 0.1), arb(-1, 0.1), arb(0.5), arb(1)])
def test_a_covering_that_is_not_decided_is_refused(reach):
    zero, half = arb(0), arb(0.5)
    one = HSet("S", (zero, zero), (arb(1), zero), (zero, arb(1)))

    def local(slope):
        return LocalMap((zero, zero), ((slope, zero), (zero, half)), ((zero,) * 3,) * 2)

    assert covering_margins(local(2 * arb(1, 0.1)), one, one)[0] > 0
    with pytest.raises(NotProvedError, match="not proved to land beyond"):
        covering_margins(local(reach), one, one)


def test_overlapping_strips_and_a_doubled_connection_are_refused():
    rows, chains = numbers(TEXT, "connections"), numbers(TEXT, "chains")
    assert rows[0][0] == rows[1][0]  # two strips of one set, from left to right
    for beyond in (0, Fraction(1, 100)):
        upper = Fraction(rows[1][2]) + beyond
        assert "overlap" in refused(SMALL, changed(0, 3, lambda _, upper=upper: upper))
    doubled = with_rows(TEXT, "connections", [rows[0], *rows])
    doubled = with_rows(doubled, "chains", chains[: int(rows[0][4]) - 1] + chains)
    assert "overlap" in refused(SMALL, doubled)


def test_an_invented_connection_is_refused():
    rows = numbers(TEXT, "connections")
    for i in range(len(rows)):
        assert refused(SMALL, changed(i, 1, lambda a: 1 - a))
        assert "more sets" in refused(SMALL, changed(i, 4, lambda a: a - 1))
        assert "lacks sets" in refused(SMALL, changed(i, 4, lambda a: a + 1))
    direct = [[*rows[0][:2], "0.97", "0.98", "1"], *rows]  # one impact, without a chain
    assert "cover" in refused(SMALL, with_rows(TEXT, "connections", direct))
    for column, value in ((0, 2), (0, Fraction(1, 2)), (1, -1), (4, 0), (2, -2), (3, 2)):
        assert refused(SMALL, changed(-1, column, lambda _, value=value: value))


def test_a_growth_that_is_too_large_and_wrong_weights_are_refused():
    growth = Fraction(tomllib.loads(TEXT, parse_float=str)["growth"])
    for value in (growth * Fraction("1.001"), growth + 1, 10**6):
        assert "the weights do not grow" in refused(SMALL, with_field(TEXT, "growth", f'"{value}"'))
    for weights in ("[1.0, -1.0]", "[0.0, 0.0]", "[1.0, 1e-9]", "[1.0]"):
        assert refused(SMALL, with_field(TEXT, "weights", weights))


# ---- no invariant circle


CIRCLE = THEOREMS["no-circle"]


def test_points_of_the_unstable_manifold_land_on_both_sides_of_the_jump_set():
    """The image of the last set but one, mapped once more, jumps."""
    parts, _ = proved("no-circle")
    p = np.linspace(-1.0, 1.0, 2001)
    points = in_doubles(parts["chain"][-1]).points(p, 0.0 * p)
    images = DoubleMap(CIRCLE.bounds["surface"]).step(points)
    assert np.count_nonzero(np.hypot(*np.diff(images, axis=1)) > 0.05) == 1


def test_the_jump_set_must_cross_the_last_set():
    low, high = map(float, tomllib.loads(CIRCLE.text())["touches"])
    middle = (low + high) / 2
    for touches in ((low, middle), (middle, high), (high, high)):
        text = with_field(CIRCLE.text(), "touches", str(list(touches)))
        assert refused("no-circle", text)
    parts, _ = proved("no-circle")
    last = parts["chain"][-1]
    turned = HSet("N", last.centre, last.s, last.u)
    with ctx.workprec(jump.BITS), pytest.raises(NotProvedError, match="jump set"):
        jump.prove_crossing(CIRCLE.bounds["surface"], turned, arb(low), arb(high))


def test_a_chain_from_elsewhere_or_of_another_orbit_is_refused():
    for leaves in (1, 3, -1):
        assert refused("no-circle", with_field(CIRCLE.text(), "leaves", leaves))
    points = numbers(THEOREMS["six-elliptic"].text(), "points")
    sides = (row[2:] for row in numbers(CIRCLE.text(), "saddles"))
    saddles = [[*point, *side] for point, side in zip(points, sides, strict=True)]
    assert "not hyperbolic" in refused("no-circle", with_rows(CIRCLE.text(), "saddles", saddles))
