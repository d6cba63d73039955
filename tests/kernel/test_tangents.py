"""Tangent vectors of many orbits have the bits that those of each orbit have alone."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from sections import sea

from pseudorigid import lyapunov_spectrum
from pseudorigid.dynamics.ball import Ball
from pseudorigid.kernel import impact, lanes, tangents
from pseudorigid.kernel.arithmetic import WIDE

BALL = Ball(k=0.2, g=0.04)


def alone(states, vectors, ball, impacts):
    """The vector (3, n) of each state after `impacts`, one orbit after the other."""
    coefficients = impact.impact_coefficients(ball.k)
    out = vectors.copy()
    for i in range(states[0].size):
        x, v, w = (float(a[i]) for a in states)
        vector = tuple(out[:, i])
        for _ in range(impacts):
            x, v, w, _, *flight, _ = impact.step_with_flight(
                x, v, w, ball.k, ball.g, coefficients, None
            )
            vector = impact.tangent(*vector, ball.k, ball.g, coefficients, x, w, *flight)
        out[:, i] = vector
    return out


def together(states, vectors, ball, impacts, how=None):
    """The same by stretches, and the states at the end."""
    x, v, w = (a.copy() for a in states)
    coefficients = impact.impact_coefficients(ball.k)
    out = vectors.copy()
    for first in range(0, x.size, tangents.GROUP):
        part = slice(first, min(first + tangents.GROUP, x.size))
        rooms = tangents.allocate_buffers()
        done = 0
        while done < impacts:
            count = min(tangents.CHUNK, impacts - done)
            tangents.advance_chunk(x[part], v[part], w[part], ball.k, ball.g, count, *rooms, how)
            for row in range(0, count * tangents.GROUP, tangents.GROUP):
                for i in range(part.stop - part.start):
                    at = row + i
                    out[:, first + i] = tangents.push_tangent(
                        *out[:, first + i], ball.k, ball.g, coefficients, *rooms, at
                    )
            done += count
    return out, (x, v, w)


def some_vectors(n):
    return np.random.default_rng(n).normal(size=(3, n))


@pytest.mark.parametrize(
    "n",
    [
        1,
        lanes.MIN_ORBITS_FOR_LANES - 1,
        lanes.MIN_ORBITS_FOR_LANES,
        lanes.LANES + 1,
        tangents.GROUP + 2,
    ],
)
def test_every_vector_has_the_bits_of_one_orbit(n):
    states, vectors = sea(n), some_vectors(n)
    impacts = tangents.CHUNK + 9
    found, ends = together(states, vectors, BALL, impacts)
    assert np.array_equal(found, alone(states, vectors, BALL, impacts))
    steps = [a.copy() for a in states]
    impact.steps(*steps, BALL.k, BALL.g, impacts, np.empty(n), None)
    assert np.array_equal(ends, steps)


@settings(max_examples=20, deadline=None)
@given(
    k=st.floats(0.01, 1.0),
    g=st.floats(1e-4, 1.0),
    share=st.floats(1e-6, 0.999),
    seed=st.integers(1, 1000),
)
def test_for_any_ball_and_energy(k, g, share, seed):
    ball = Ball(k=k, g=g)
    lowest, _ = ball.energy_bounds()
    states = sea(12 + seed % 9, lowest + share * (3.0 * abs(lowest) + 0.1), ball)
    vectors = some_vectors(states[0].size)
    found, _ = together(states, vectors, ball, 12)
    assert np.array_equal(found, alone(states, vectors, ball, 12), equal_nan=True)


def test_long_flights_and_states_that_are_none():
    x, v, w = sea(40)
    x[5], v[5], w[5] = np.nan, 0.1, 0.1
    x[9], v[9], w[9] = 0.0, 0.0, 1e9
    x[13], v[13], w[13] = -0.04, 0.05, -0.05  # on the rim
    assert BALL.time_to_impact(x[9], v[9], w[9]) > WIDE
    found, _ = together((x, v, w), some_vectors(40), BALL, 5)
    expected = alone((x, v, w), some_vectors(40), BALL, 5)
    assert np.array_equal(found, expected, equal_nan=True)
    assert np.all(np.isfinite(found[:, 9]))
    assert np.all(np.isnan(found[:, 5]))


def test_by_the_scan_as_well():
    states, vectors = sea(20), some_vectors(20)
    found, ends = together(states, vectors, BALL, 10, (0.1, 1e-12))
    steps = [a.copy() for a in states]
    impact.steps(*steps, BALL.k, BALL.g, 10, np.empty(20), (0.1, 1e-12))
    assert np.array_equal(ends, steps)
    exact, _ = together(states, vectors, BALL, 10)
    assert not np.array_equal(found, exact)
    assert found == pytest.approx(exact, rel=1e-4)


@pytest.mark.parametrize("threads", ["1", "3"])
def test_a_spectrum_does_not_depend_on_company_or_threads(threads, monkeypatch):
    monkeypatch.setenv("OMP_NUM_THREADS", threads)
    states = sea(tangents.GROUP + 40)
    many = lyapunov_spectrum(BALL, states, 500, 3)["exponent"].values
    for i in (0, 31, 32, tangents.GROUP - 1, tangents.GROUP, many.shape[1] - 1):
        one = lyapunov_spectrum(BALL, [a[i] for a in states], 500, 3)["exponent"].values
        assert np.array_equal(many[:, i], one)
