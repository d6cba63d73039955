"""Graphs of coverings: entropy, refused certificates, and the growth of a material line."""

from functools import cache
from itertools import pairwise

import numpy as np
import pytest
from certificates import numbers, refused, with_rows
from flint import ctx

from extensions.proofs import THEOREMS
from extensions.proofs.search.chains import DoubleMap, Parallelogram

SMALL = "entropy-lower"
TEXT = THEOREMS[SMALL].text()


@cache
def proved(name):
    """The parts of the finding about a theorem's own certificate, and the digits."""
    finding = THEOREMS[name].prove()
    return finding.parts, finding.digits


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


# ---- no invariant circle


CIRCLE = THEOREMS["no-circle"]


def test_points_of_the_unstable_manifold_land_on_both_sides_of_the_jump_set():
    """The image of the last set but one, mapped once more, jumps."""
    parts, _ = proved("no-circle")
    p = np.linspace(-1.0, 1.0, 2001)
    points = in_doubles(parts["chain"][-1]).points(p, 0.0 * p)
    images = DoubleMap(CIRCLE.bounds["surface"]).step(points)
    assert np.count_nonzero(np.hypot(*np.diff(images, axis=1)) > 0.05) == 1


def test_a_loop_around_an_elliptic_orbit_is_refused():
    points = numbers(THEOREMS["six-elliptic"].text(), "points")
    sides = (row[2:] for row in numbers(CIRCLE.text(), "saddles"))
    saddles = [[*point, *side] for point, side in zip(points, sides, strict=True)]
    assert "not hyperbolic" in refused("no-circle", with_rows(CIRCLE.text(), "saddles", saddles))
