"""Periodic orbits with and without symmetry: brute force, digits, chains and equal bits."""

import math

import numpy as np
import pytest

from helpers.cycles import PERIODS, SETTINGS, check, compare_with_brute_force
from helpers.sections import BALL
from helpers.slowly import slowly
from pseudorigid import Ball, periodic_orbits, symmetric_orbits
from pseudorigid.dynamics import ensemble, newton
from pseudorigid.dynamics.variables import chart


def disk(ball, energy, orbits):
    """The points of orbits in section radii, (orbit, point, 2)."""
    centre, radius = ball.section(energy)
    y = orbits["xdot"] - ball.k * orbits["udot"]
    points = (orbits["x"] - centre) / radius, y / (radius * math.sqrt(ball.k * (1.0 + ball.k)))
    return np.stack([part.values for part in points], axis=-1)


@pytest.mark.parametrize(("k", "g", "energy", "period", "count"), [
    (1 / 3, 0.03, 0.02, 3, 4),
    *slowly(
        (0.2, 0.04, 0.0599, 5, 4),
        (0.2, 0.04, 0.01, 20, 24),
        (1 / 3, 0.03, 0.02, 5, 6),
        (0.7, 0.2, 0.1, 11, 8),
        (1.0, 0.1, 0.05, 8, 8),
    ),
])  # fmt: skip
def test_brute_force_finds_no_orbit_that_is_missing(k, g, energy, period, count):
    ball = Ball(k, g)
    orbits = periodic_orbits(ball, energy, period)
    check(ball, energy, period, orbits)
    assert (orbits.sizes["orbit"], orbits.attrs["unsolved"]) == (count, 0)
    assert compare_with_brute_force(ball, energy, orbits, symmetric=False) > 0


@pytest.mark.parametrize(("k", "g", "energy", "periods"), [
    (1 / 3, 0.03, 0.02, (1, 2, 3)),
    *slowly((0.2, 0.02, 0.03, (7,)), *((*one, PERIODS) for one in SETTINGS)),
])  # fmt: skip
def test_the_symmetric_orbits_are_among_them_with_the_same_bits(k, g, energy, periods):
    ball = Ball(k, g)
    for period in periods:
        every = periodic_orbits(ball, energy, period)
        symmetric = symmetric_orbits(ball, energy, period)
        check(ball, energy, period, every)
        assert every.attrs["unsolved"] == 0
        variables = ("x", "xdot", "udot", "tau")
        both = (np.stack([d[name].values for name in variables], 1) for d in (every, symmetric))
        every_bits, bits = ({orbit.tobytes() for orbit in points} for points in both)
        assert bits <= every_bits
        alone = every.isel(orbit=~every["symmetric"].values)
        mirrored = disk(ball, energy, alone)[:, :, None] - disk(ball, energy, alone)[:, 0] * (1, -1)
        assert np.all(np.max(np.abs(mirrored), axis=-1).min(axis=1).min(axis=0, initial=1.0) < 1e-9)


@pytest.mark.slow
def test_a_chain_with_traces_of_2_to_rounding_is_two_orbits():
    """Rounding would make each point that is found near the chain an orbit of its own."""
    ball = Ball(1.0, 0.3)
    orbits = periodic_orbits(ball, -0.03, 11)
    assert orbits["type"].values.tolist() == ["elliptic", "hyperbolic"]
    assert orbits["symmetric"].values.all()


@pytest.mark.parametrize("period", [6, 7])
def test_symmetric_orbits_from_the_grid_alone_start_on_a_line(monkeypatch, period):
    expected = symmetric_orbits(BALL, 0.01, period)
    monkeypatch.setattr(newton, "distinct_orbits", lambda *arguments: ([], 1.0))
    orbits = periodic_orbits(BALL, 0.01, period)
    assert orbits["symmetric"].values.all()
    np.testing.assert_allclose(orbits["trace"], expected["trace"], rtol=1e-11)
    points = disk(BALL, 0.01, orbits)
    first, second = points[:, 0], points[:, 1]
    off_r, off_rp = np.abs(first[:, 1]), np.max(np.abs(first - second * (1, -1)), axis=1)
    assert np.all(np.minimum(off_r, off_rp) < 1e-12)


def test_the_number_of_threads_does_not_change_a_bit(monkeypatch):
    found = []
    for number in (1, 3):
        monkeypatch.setattr(ensemble, "threads", lambda number=number: number)
        found.append(periodic_orbits(Ball(1 / 3, 0.03), 0.02, 3))
    assert found[0].identical(found[1])
    assert found[0].sizes["orbit"] == 4


@pytest.mark.parametrize(("k", "g", "energy", "period", "count", "traces"), [
    (1 / 3, 0.02, 0.02, 6, 25, (7739.07, -9120.85)),
    *slowly(
        (0.2, 0.01, 0.02, 4, 15, ()),
        (0.25, 0.005, 0.01, 3, 28, ()),
        (1 / 3, 0.02, 0.02, 5, 15, ()),
    ),
])  # fmt: skip
def test_unstable_orbits_at_high_energies_are_found(k, g, energy, period, count, traces):
    """At E/g^2 of 50 and more; Newton's method from 1,400^2 starts shows at most as many."""
    ball = Ball(k, g)
    orbits = periodic_orbits(ball, energy, period)
    check(ball, energy, period, orbits)
    assert (orbits.sizes["orbit"], orbits.attrs["unsolved"]) == (count, 0)
    for trace in traces:  # a pair of mirror images each
        assert np.sum(np.abs(orbits["trace"].values / trace - 1.0) < 1e-5) == 2
    if period == 6:  # a search by 400^2 starts misses an orbit here
        points = chart(k, *(orbits[name].values for name in ("x", "xdot", "udot")))
        place = 0.0341431882504158, 0.0187101025390912
        gaps = [abs(a - b) for a, b in zip(points, place, strict=True)]
        assert np.min(np.maximum(*gaps)) < 1e-9


def test_a_coarse_search_says_that_it_is(monkeypatch):
    monkeypatch.setattr(newton, "SEARCHES", ((60, 0),))
    few = periodic_orbits(Ball(1 / 3, 0.02), 0.02, 6)
    assert few.sizes["orbit"] < 25 and few.attrs["least_points_seen"] < 0.2
    assert few.attrs["points_seen"] < 0.7
    whole = periodic_orbits(BALL, 0.01, 6)
    assert whole.attrs["points_seen"] == whole.attrs["least_points_seen"] == 1.0
