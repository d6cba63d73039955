"""Orbits of an ensemble have the bits of single orbits, in lanes and in threads."""

import numpy as np
import pytest
from hypothesis import given, settings
from sections import BALL, any_sea, sea

from pseudorigid.dynamics import ensemble
from pseudorigid.kernel import impact, lanes


def orbit_by_orbit(states, ball, impacts):
    """Return the history (n, impacts, 4) of each state, computed orbit by orbit."""
    out = np.empty((states[0].size, impacts, 4))
    impact.history(*(a.copy() for a in states), ball.k, ball.g, out, None)
    return out


def in_lanes(states, ball, impacts):
    """Return the history (n, impacts, 4) of each state, computed in lanes."""
    out = np.empty((states[0].size, impacts, 4))
    tau = np.empty(states[0].size)
    ends = [a.copy() for a in states]
    lanes.steps(*ends, ball.k, ball.g, impacts, tau, out)
    assert np.array_equal(np.stack([*ends, tau], axis=1), out[:, -1], equal_nan=True)
    return out


def assert_same_bits(states, ball, impacts):
    alone = orbit_by_orbit(states, ball, impacts)
    assert np.array_equal(in_lanes(states, ball, impacts), alone, equal_nan=True)


@pytest.mark.parametrize("n", [1, 2, 33, lanes.LANES, lanes.LANES + 1])
def test_every_lane_has_the_bits_of_one_orbit(n):
    assert_same_bits(sea(n), BALL, 150)


@settings(max_examples=30, deadline=None)
@given(any_sea(40))
def test_lanes_for_any_ball_and_energy(ball_and_states):
    ball, states = ball_and_states
    assert_same_bits(states, ball, 40)


def test_states_that_leave_their_lane():
    """Mix ordinary states with ones on the rim, huge, tiny, NaN and infinite."""
    x, v, w = sea(60)
    x[3], v[3], w[3] = -0.04, 0.05, -0.05
    x[7], v[7], w[7] = 0.1, 0.05, -0.05
    x[11], v[11], w[11] = np.nan, 0.1, 0.1
    x[15], v[15], w[15] = 0.1, np.inf, 0.1
    x[19], v[19], w[19] = 2.0**300, 2.0**300, 2.0**300
    x[23], v[23], w[23] = 2.0**-300, 0.0, 2.0**-300
    x[27], v[27], w[27] = 0.0, 1e9, 0.0
    assert_same_bits((x, v, w), BALL, 5)


def test_few_flights_leave_their_lane():
    """`impact.step` may do few flights only, or lanes would gain nothing."""
    n, impacts = lanes.LANES, 300
    row, orbit = np.zeros(lanes.SIZE), np.empty(n, np.int64)
    for first, values in zip((lanes.X, lanes.V, lanes.W), sea(n), strict=True):
        row[first : first + n] = values
    coefficients = impact.impact_coefficients(BALL.k)
    alone = 0
    for _ in range(impacts):
        flying, orbit[:] = n, np.arange(n)
        lanes._begin_flights(row, n, BALL.k, BALL.g, coefficients)
        while flying:
            lanes._gaps(row, flying, BALL.g)
            lanes._find_ends(row, flying, BALL.g)
            lanes._land(row, flying, BALL.g)
            flying = lanes._close_up(row, orbit, flying)
            lanes._march(row, flying, BALL.g)
            lanes._choose(row, flying)
            for i in range(flying):
                odd = row[lanes.ODD + i]
                if odd == lanes._ALONE or (odd and not lanes._stride_alone(row, i, BALL.g)):
                    lanes._step_alone(row, orbit, i, BALL.k, BALL.g, coefficients)
                    alone += 1
    assert alone < 0.005 * n * impacts


@pytest.mark.parametrize("threads", ["1", "3", "8", "", "many"])
def test_threads_do_not_matter(threads, monkeypatch):
    states = sea(300)
    assert 3 * ensemble.MIN_IMPACTS_PER_THREAD < 300 * 400
    assert 3 * ensemble.MIN_ORBITS_PER_THREAD < 300
    expected = orbit_by_orbit(states, BALL, 400)
    monkeypatch.setenv("OMP_NUM_THREADS", threads)
    out = np.empty_like(expected)
    BALL.map.history(*(a.copy() for a in states), BALL.k, BALL.g, out)
    assert np.array_equal(out, expected)
    ends, tau = [a.copy() for a in states], np.empty(300)
    BALL.map.steps(*ends, BALL.k, BALL.g, 400, tau)
    assert np.array_equal(np.stack([*ends, tau], axis=1), expected[:, -1])


def test_no_impacts_leave_the_states():
    states = sea(40)
    ends = [a.copy() for a in states]
    BALL.map.steps(*ends, BALL.k, BALL.g, 0, np.empty(40))
    assert all(np.array_equal(a, b) for a, b in zip(ends, states, strict=True))
