"""Periodic orbits with and without symmetry: a second search, digits, chains and equal bits.

The second search has a map of its own (a scan with steps of 0.01, and bisection), starts at random,
and solves with scipy.
"""

import math

import numpy as np
import pytest
from cycles import PERIODS, SETTINGS, check, check_last_bits
from scipy.optimize import brentq, root
from sections import BALL
from slowly import slowly

from pseudorigid import Ball, periodic_orbits, symmetric_orbits, trace_manifold
from pseudorigid.dynamics import ensemble, newton

TIMES = 0.01 * np.arange(1, 2000)  # longer than the flights below


def impact(k, g, x, v, w):
    """Return the state before the next impact, x'' = g and u'' = -u, with u = -x at an impact."""
    e = 2.0 * (v + w) / (1.0 + k)
    b, c = v - k * e, w - e

    def gap(t):
        return x + b * t + 0.5 * g * t * t - x * np.cos(t) + c * np.sin(t)

    heights = gap(TIMES)
    (rises,) = np.nonzero((heights[:-1] < 0.0) & (heights[1:] >= 0.0))
    if not heights[0] <= 0.0 or rises.size == 0:
        return math.nan, math.nan, math.nan
    t = brentq(gap, *TIMES[rises[0] : rises[0] + 2], xtol=1e-15)
    return x * math.cos(t) - c * math.sin(t), b + g * t, x * math.sin(t) + c * math.cos(t)


def second_search(ball, energy, period, starts):
    """Return points (x, y) of orbits of a prime period, in section radii, with |trace| < 1e4.

    The equations are that the first half of an orbit, and its other half run backwards, meet.
    """
    k, g = ball.k, ball.g
    centre, radius = ball.section(energy)
    height = radius * math.sqrt(k * (1.0 + k))

    def run(point, impacts):
        state = x, y = centre + radius * point[0], height * point[1]
        s = ((1.0 + k) * (2.0 * energy + 2.0 * g * x - k * x * x) - y * y) / k
        if not s > 0.0:
            return np.full((impacts + 1, 2), math.nan)
        s = math.sqrt(s)
        state, path = (x, (y + k * s) / (1.0 + k), (s - y) / (1.0 + k)), [point]
        for _ in range(impacts):
            state = impact(k, g, *state)
            path.append(((state[0] - centre) / radius, (state[1] - k * state[2]) / height))
        return np.array(path)

    mirror = np.array([1.0, -1.0])

    def defect(point):
        back = run(point * mirror, period // 2)[-1] * mirror
        return np.nan_to_num(run(point, period - period // 2)[-1] - back, nan=1.0)

    rng, found = np.random.default_rng(1), []
    for _ in range(starts):
        turn, size = 2.0 * math.pi * rng.random(), math.sqrt(rng.random())
        solution = root(defect, size * np.array([math.cos(turn), math.sin(turn)]), tol=1e-13)
        if not (solution.success and np.max(np.abs(solution.fun)) < 1e-11):
            continue
        path = run(solution.x, period)
        prime = period == 1 or np.min(np.max(np.abs(path[1:-1] - path[0]), axis=1)) > 1e-6
        if prime and np.max(np.abs(path[-1] - path[0])) < 1e-7:
            found.append(solution.x)
    return np.array(found).reshape(-1, 2)


def disk(ball, energy, orbits):
    """The points of orbits in section radii, (orbit, point, 2)."""
    centre, radius = ball.section(energy)
    y = orbits["xdot"] - ball.k * orbits["udot"]
    points = (orbits["x"] - centre) / radius, y / (radius * math.sqrt(ball.k * (1.0 + ball.k)))
    return np.stack([part.values for part in points], axis=-1)


@pytest.mark.parametrize(
    ("k", "g", "energy", "period", "starts", "count"),
    [
        (1 / 3, 0.03, 0.02, 3, 60, 4),
        (0.2, 0.04, 0.0599, 5, 120, 4),
        *slowly(
            (0.2, 0.04, 0.01, 20, 800, 24),
            (1 / 3, 0.03, 0.02, 5, 800, 6),
            (0.7, 0.2, 0.1, 11, 800, 8),
            (1.0, 0.1, 0.05, 8, 800, 8),
        ),
    ],
)
def test_a_second_search_finds_the_same_orbits(k, g, energy, period, starts, count):
    ball = Ball(k, g)
    orbits = periodic_orbits(ball, energy, period)
    check(ball, energy, period, orbits)
    assert (orbits.sizes["orbit"], orbits.attrs["unsolved"]) == (count, 0)
    points, seen = disk(ball, energy, orbits), np.zeros(count, dtype=bool)
    for point in second_search(ball, energy, period, starts):
        distances = np.max(np.abs(points - point), axis=2).min(axis=1)
        assert np.min(distances) < 1e-8
        seen[np.argmin(distances)] = True
    # few starts lead to orbits that are very unstable
    assert np.all(seen | (np.abs(orbits["trace"].values) > 1000.0))


@pytest.mark.parametrize(
    ("k", "g", "energy", "periods"),
    [
        (1 / 3, 0.03, 0.02, (1, 2, 3)),
        (0.2, 0.02, 0.03, (7,)),
        *slowly(*((*one, PERIODS) for one in SETTINGS)),
    ],
)
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


def test_orbits_without_symmetry_are_right_to_the_last_bit():
    orbits = periodic_orbits(BALL, 0.01, 20)
    assert (orbits.sizes["orbit"], int(orbits["symmetric"].sum())) == (24, 14)
    (alone,) = np.nonzero(~orbits["symmetric"].values)
    check_last_bits(BALL, 0.01, 20, orbits, int(alone[-1]))
    branch = trace_manifold(BALL, 0.01, orbits.isel(orbit=int(alone[-1])), length=0.1)
    assert branch.sizes["vertex"] > 10


def test_a_chain_with_traces_of_2_to_rounding_is_two_orbits():
    """Rounding would make each point that is found near the chain an orbit of its own."""
    ball = Ball(1.0, 0.3)
    orbits = periodic_orbits(ball, -0.03, 11)
    assert orbits["type"].values.tolist() == ["elliptic", "hyperbolic"]
    assert orbits["symmetric"].values.all()


@pytest.mark.parametrize("period", [6, 7])
def test_symmetric_orbits_from_the_grid_alone_start_on_a_line(monkeypatch, period):
    expected = symmetric_orbits(BALL, 0.01, period)
    monkeypatch.setattr(newton, "distinct_orbits", lambda *arguments: [])
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
