"""Graphs of coverings: entropy, refused certificates, and the growth of a material line."""

from fractions import Fraction
from functools import cache
from itertools import pairwise

import numpy as np
import pytest
from certificates import numbers, refused, with_field, with_rows
from flint import arb, ctx
from slowly import slowly

from extensions.proofs import THEOREMS
from extensions.proofs.checks import jump
from extensions.proofs.checks.certificate import NotProvedError
from extensions.proofs.checks.hsets import HSet, LocalMap, covering
from extensions.proofs.search.chains import DoubleMap

SMALL = "entropy-lower"
TEXT = THEOREMS[SMALL].text()
GRAPHS = [SMALL, *slowly("entropy")]


@cache
def proved(name):
    """The finding about a theorem's own certificate."""
    return THEOREMS[name].prove()


def changed(text, field, row, columns, change):
    """The certificate with numbers of a row changed by a function of column and number."""
    rows = numbers(text, field)
    for column in columns:
        rows[row][column] = f'"{change(column, Fraction(rows[row][column]))}"'
    return with_rows(text, field, rows)


@pytest.mark.parametrize("name", GRAPHS)
def test_the_entropy_is_that_of_the_paths(name):
    """The logarithm of the spectral radius of the matrix with a vertex for each impact."""
    theorem = THEOREMS[name]
    finding = proved(name)
    sets, connections = finding.parts["graph"].sets, finding.parts["graph"].connections
    size = len(sets) + sum(it.impacts - 1 for it in connections)
    matrix, free = np.zeros((size, size)), len(sets)
    for it in connections:
        path = [it.source, *range(free, free + it.impacts - 1), it.target]
        free += it.impacts - 1
        for a, b in pairwise(path):
            matrix[a, b] += 1.0
    entropy = np.log(np.abs(np.linalg.eigvals(matrix)).max())
    with ctx.workprec(64):
        bound = float(finding.digits["entropy"])
    assert float(theorem.bounds["entropy"]) < bound < entropy < bound + 5e-4


def coverings(name):
    """Yield the source and the target of each covering that is proved."""
    parts = proved(name).parts
    if "edges" in parts:
        yield from parts["edges"]
    else:
        for it in parts["graph"].connections:
            yield from pairwise([it.strip, *it.chain, parts["graph"].sets[it.target]])


@pytest.mark.parametrize("name", [*GRAPHS, "horseshoe-outer"])
def test_coverings_hold_for_points_in_doubles(name):
    double_map = DoubleMap(THEOREMS[name].bounds["surface"])
    edge = np.linspace(-1.0, 1.0, 21)
    for source, target in coverings(name):
        (centre, u, s), (origin, *sides) = (
            [np.array([float(a) for a in side]) for side in (each.centre, each.u, each.s)]
            for each in (source, target)
        )
        ends = []
        for p in (-1.0, 1.0):
            image = double_map.step((centre + p * u)[:, None] + np.outer(s, edge))
            p_image, q_image = np.linalg.solve(np.stack(sides, 1), image - origin[:, None])
            assert np.abs(q_image).max() < 1
            ends.append(p_image)
        assert np.abs(ends).min() > 1
        assert np.all(np.sign(ends[0]) == -np.sign(ends[1]))


@pytest.mark.parametrize("reach", [arb(1, 0.1), arb(-1, 0.1), arb(0.5), arb(1)])
def test_a_covering_that_is_not_decided_is_refused(reach):
    zero, half = arb(0), arb(0.5)
    one = HSet("S", (zero, zero), (arb(1), zero), (zero, arb(1)))

    def local(slope):
        return LocalMap((zero, zero), ((slope, zero), (zero, half)), ((zero,) * 3,) * 2)

    assert covering(local(2 * arb(1, 0.1)), one, one)[0] > 0
    with pytest.raises(NotProvedError, match="not proved to land beyond"):
        covering(local(reach), one, one)


def test_a_doubled_connection_and_overlapping_strips_are_refused():
    rows, chains = numbers(TEXT, "connections"), numbers(TEXT, "chains")
    doubled = with_rows(TEXT, "connections", [rows[0], *rows])
    doubled = with_rows(doubled, "chains", chains[: int(rows[0][4]) - 1] + chains)
    assert "overlap" in refused(SMALL, doubled)
    for i in (0, 1):
        assert rows[2 * i][0] == rows[2 * i + 1][0]  # two strips of one set, from left to right
        upper = Fraction(rows[2 * i + 1][2])
        for end in (upper, upper + Fraction(1, 100)):
            wider = changed(TEXT, "connections", 2 * i, [3], lambda *_, end=end: end)
            assert "overlap" in refused(SMALL, wider)


def test_an_invented_connection_is_refused():
    rows = numbers(TEXT, "connections")
    for i in range(len(rows)):
        assert refused(SMALL, changed(TEXT, "connections", i, [1], lambda _, a: 1 - a))
        shorter = changed(TEXT, "connections", i, [4], lambda _, a: a - 1)
        assert "more sets" in refused(SMALL, shorter)
        longer = changed(TEXT, "connections", i, [4], lambda _, a: a + 1)
        assert "lacks sets" in refused(SMALL, longer)
    direct = [[*rows[0][:2], "0.97", "0.98", "1"], *rows]  # one impact, without a chain
    assert "cover" in refused(SMALL, with_rows(TEXT, "connections", direct))
    for column, value in ((0, 2), (0, Fraction(1, 2)), (1, -1), (4, 0), (2, -2), (3, 2)):
        assert refused(SMALL, changed(TEXT, "connections", -1, [column], lambda *_, v=value: v))


def test_a_growth_that_is_too_large_and_wrong_weights_are_refused():
    growth = Fraction(
        numbers("growth = [\n" + TEXT.split("growth = ")[1][:8] + "\n]", "growth")[0][0]
    )
    for value in (growth * Fraction("1.001"), growth + 1, 10**6):
        assert "the weights do not grow" in refused(SMALL, with_field(TEXT, "growth", f'"{value}"'))
    for value in (1, 0, -1):
        assert "not above 1" in refused(SMALL, with_field(TEXT, "growth", f'"{value}"'))
    for weights in ("[1.0, 0.0]", "[1.0, -1.0]", "[0.0, 0.0]", "[1.0, 1e-9]", "[1.0]"):
        assert refused(SMALL, with_field(TEXT, "weights", weights))


# ---- no invariant circle


def test_points_of_the_unstable_manifold_land_on_both_sides_of_the_jump_set():
    """The image of the last set but one, mapped once more, jumps."""
    theorem = THEOREMS["no-circle"]
    chain = theorem.prove().parts["chain"]
    double_map = DoubleMap(theorem.bounds["surface"])
    last = chain[-1]
    p = np.linspace(-1.0, 1.0, 2001)
    points = np.array([float(a) for a in last.centre])[:, None] + np.outer(
        [float(a) for a in last.u], p
    )
    steps = np.hypot(*np.diff(double_map.step(points), axis=1))
    assert np.count_nonzero(steps > 0.05) == 1


def test_the_jump_set_must_cross_the_last_set():
    theorem = THEOREMS["no-circle"]
    text = theorem.text()
    low, high = (float(a) for a in text.split("touches = [")[1].split("]")[0].split(", "))
    middle = (low + high) / 2
    for touches in ((low, middle), (middle, high), (low + 1.0, high + 1.0), (high, high)):
        assert refused("no-circle", with_field(text, "touches", str(list(touches))))
    surface = theorem.bounds["surface"]
    with ctx.workprec(jump.BITS):
        last = theorem.prove(text).parts["chain"][-1]
        turned = HSet("N", last.centre, last.s, last.u)
        with pytest.raises(NotProvedError, match="jump set"):
            jump.prove_crossing(surface, turned, arb(low), arb(high))


def test_a_chain_from_elsewhere_or_of_another_orbit_is_refused():
    theorem = THEOREMS["no-circle"]
    text = theorem.text()
    for leaves in (1, 3, 6, -1):
        assert refused("no-circle", with_field(text, "leaves", leaves))
    assert "not hyperbolic" in refused(
        "no-circle",
        with_rows(text, "saddles", [
            [*row, *side[2:]] for row, side in zip(
                numbers(THEOREMS["six-elliptic"].text(), "points"), numbers(text, "saddles"),
                strict=True)
        ]),
    )  # fmt: skip
