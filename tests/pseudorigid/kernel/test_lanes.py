"""Orbits of an ensemble have the bits of single orbits: states, tangent vectors and exponents."""

import numpy as np
import pytest
from hypothesis import given, settings

from helpers.sections import BALL, any_sea, ball_of, sea
from pseudorigid import lyapunov_spectrum
from pseudorigid.dynamics import ensemble
from pseudorigid.kernel import impact, lanes, tangents


def vectors_of(states):
    """Return a random tangent vector for each state, (3, n)."""
    return np.random.default_rng(states[0].size).normal(size=(3, states[0].size))


def orbit_by_orbit(states, ball, impacts):
    """Return the history (n, impacts, 4) of states and the last tangent vectors (3, n)."""
    coefficients = impact.impact_coefficients(ball.k)
    history, vectors = np.empty((states[0].size, impacts, 4)), vectors_of(states)
    for i, state in enumerate(zip(*states, strict=True)):
        x, v, w = state
        for j in range(impacts):
            x, v, w, tau, *flight, _ = impact.step_with_flight(
                x, v, w, ball.k, ball.g, coefficients, None
            )
            history[i, j] = x, v, w, tau
            vectors[:, i] = impact.tangent(
                *vectors[:, i], ball.k, ball.g, coefficients, x, w, *flight
            )
    return history, vectors


def in_chunks(states, ball, impacts):
    """Return the last states (3, n) and tangent vectors (3, n), computed in chunks."""
    ends, vectors = np.array(states), vectors_of(states)
    coefficients = impact.impact_coefficients(ball.k)
    for first in range(0, ends.shape[1], tangents.GROUP):
        group, buffers = slice(first, first + tangents.GROUP), tangents.allocate_buffers()
        for done in range(0, impacts, tangents.CHUNK):
            count = min(tangents.CHUNK, impacts - done)
            tangents.advance_chunk(
                *(row[group] for row in ends), ball.k, ball.g, count, *buffers, None
            )
            for row, i in np.ndindex(count, ends[0, group].size):
                vectors[:, first + i] = tangents.push_tangent(
                    *vectors[:, first + i], ball.k, ball.g, coefficients, *buffers,
                    row * tangents.GROUP + i,
                )  # fmt: skip
    return ends, vectors


def assert_same_bits(states, ball, impacts):
    """Compare lanes and chunks with single orbits, and return the tangent vectors."""
    expected, expected_vectors = orbit_by_orbit(states, ball, impacts)
    ends, tau, out = np.array(states), np.empty(len(expected)), np.empty_like(expected)
    lanes.iterate(*ends, ball.k, ball.g, impacts, tau, out)
    assert np.array_equal(out, expected, equal_nan=True)
    assert np.array_equal([*ends, tau], expected[:, -1].T, equal_nan=True)
    ends, vectors = in_chunks(states, ball, impacts)
    assert np.array_equal(ends, expected[:, -1, :3].T, equal_nan=True)
    assert np.array_equal(vectors, expected_vectors, equal_nan=True)
    return vectors


MIN_ORBITS = lanes.MIN_ORBITS_FOR_LANES


@pytest.mark.parametrize("n", [1, MIN_ORBITS - 1, MIN_ORBITS, 33, lanes.LANES, lanes.LANES + 1])
def test_every_lane_has_the_bits_of_one_orbit(n):
    assert_same_bits(sea(n), BALL, 2 * tangents.CHUNK + 9)


@settings(max_examples=30, deadline=None)
@given(any_sea(40))
def test_lanes_for_any_ball_and_energy(ball_and_states):
    ball, states = ball_and_states
    assert_same_bits(states, ball, 40)


def test_states_that_leave_their_lane():
    """Mix ordinary states with ones on the rim, huge, tiny, NaN and infinite, and long flights."""
    x, v, w = sea(60)
    x[3], v[3], w[3] = -0.04, 0.05, -0.05
    x[7], v[7], w[7] = 0.1, 0.05, -0.05
    x[11], v[11], w[11] = np.nan, 0.1, 0.1
    x[15], v[15], w[15] = 0.1, np.inf, 0.1
    x[19], v[19], w[19] = 2.0**300, 2.0**300, 2.0**300
    x[23], v[23], w[23] = 2.0**-300, 0.0, 2.0**-300
    x[27], v[27], w[27] = 0.0, 1e9, 0.0
    x[31], v[31], w[31] = 0.0, 0.0, 1e9
    x[35], v[35], w[35] = 0.1, -1e6, 2.5e6  # the first time of its march is wide
    vectors = assert_same_bits((x, v, w), BALL, 5)
    assert np.all(np.isnan(vectors[:, [11, 31, 35]]))
    unit = 2.0**300  # its fourth power overflows
    assert_same_bits(unit * np.array(sea(60)), ball_of(BALL.k, unit * BALL.g), 20)


def test_few_flights_leave_their_lane(monkeypatch):
    """`impact.step` may do few flights only, or lanes would gain nothing."""
    n, impacts, step_alone, alone = lanes.LANES, 300, lanes._step_alone, []

    def counted(*arguments):
        alone.append(arguments)
        step_alone(*arguments)

    monkeypatch.setattr(lanes, "_step_alone", counted)
    row, orbit = np.zeros(lanes.SIZE), np.empty(n, np.int64)
    for first, values in zip((lanes.X, lanes.V, lanes.W), sea(n), strict=True):
        row[first : first + n] = values
    for _ in range(impacts):
        coefficients = impact.impact_coefficients(BALL.k)
        lanes.advance.py_func(row, orbit, n, BALL.k, BALL.g, coefficients)
    assert len(alone) < 0.01 * n * impacts  # the last lane of an impact is always among them


@pytest.mark.parametrize("threads", ["1", "3", "8", "", "many"])
def test_threads_do_not_matter(threads, monkeypatch):
    states = sea(300)
    assert 3 * ensemble.MIN_IMPACTS_PER_THREAD < 300 * 400
    assert 3 * ensemble.MIN_ORBITS_PER_THREAD < 300
    monkeypatch.setenv("OMP_NUM_THREADS", threads)
    out = BALL.history(states, 400)
    assert np.array_equal(BALL.after(states, 400), out[:, -1].T)
    spectra = lyapunov_spectrum(BALL, states, 400, 3)["exponent"].values
    for i in (0, 31, 32, 149, 150, tangents.GROUP, 299):
        alone = [a[i] for a in states]
        assert np.array_equal(BALL.history(alone, 400)[0], out[i])
        alone = lyapunov_spectrum(BALL, alone, 400, 3)["exponent"].values
        assert np.array_equal(alone, spectra[:, i])
