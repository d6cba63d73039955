"""Tangent vectors along many orbits have the bits of those along single orbits."""

import numpy as np
import pytest
from hypothesis import given, settings
from sections import BALL, any_sea, sea

from pseudorigid import lyapunov_spectrum
from pseudorigid.kernel import impact, lanes, tangents
from pseudorigid.kernel.arithmetic import WIDE


def orbit_by_orbit(states, vectors, ball, impacts):
    """Return the vectors (3, n) after `impacts`, computed orbit by orbit."""
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


def in_chunks(states, vectors, ball, impacts, root_finder=None):
    """Return the vectors (3, n) and the states after `impacts`, computed in chunks."""
    x, v, w = (a.copy() for a in states)
    coefficients, out = impact.impact_coefficients(ball.k), vectors.copy()
    for first in range(0, x.size, tangents.GROUP):
        group, buffers = slice(first, first + tangents.GROUP), tangents.allocate_buffers()
        for done in range(0, impacts, tangents.CHUNK):
            count = min(tangents.CHUNK, impacts - done)
            tangents.advance_chunk(
                x[group], v[group], w[group], ball.k, ball.g, count, *buffers, root_finder
            )
            for row, i in np.ndindex(count, x[group].size):
                out[:, first + i] = tangents.push_tangent(
                    *out[:, first + i], ball.k, ball.g, coefficients, *buffers,
                    row * tangents.GROUP + i,
                )  # fmt: skip
    return out, (x, v, w)


def random_vectors(n):
    return np.random.default_rng(n).normal(size=(3, n))


MIN_ORBITS = lanes.MIN_ORBITS_FOR_LANES


@pytest.mark.parametrize("n", [1, MIN_ORBITS - 1, MIN_ORBITS, 33, tangents.GROUP + 2])
def test_every_vector_has_the_bits_of_one_orbit(n):
    states, vectors = sea(n), random_vectors(n)
    impacts = tangents.CHUNK + 9
    found, ends = in_chunks(states, vectors, BALL, impacts)
    assert np.array_equal(found, orbit_by_orbit(states, vectors, BALL, impacts))
    steps = [a.copy() for a in states]
    impact.steps(*steps, BALL.k, BALL.g, impacts, np.empty(n), None)
    assert np.array_equal(ends, steps)


@settings(max_examples=20, deadline=None)
@given(any_sea(lanes.MIN_ORBITS_FOR_LANES))
def test_vectors_for_any_ball_and_energy(ball_and_states):
    ball, states = ball_and_states
    vectors = random_vectors(states[0].size)
    found, _ = in_chunks(states, vectors, ball, 12)
    assert np.array_equal(found, orbit_by_orbit(states, vectors, ball, 12), equal_nan=True)


def test_long_flights_and_invalid_states():
    x, v, w = sea(40)
    x[5], v[5], w[5] = np.nan, 0.1, 0.1
    x[9], v[9], w[9] = 0.0, 0.0, 1e9
    x[13], v[13], w[13] = -0.04, 0.05, -0.05  # on the rim
    assert BALL.time_to_impact(x[9], v[9], w[9]) > WIDE
    found, _ = in_chunks((x, v, w), random_vectors(40), BALL, 5)
    expected = orbit_by_orbit((x, v, w), random_vectors(40), BALL, 5)
    assert np.array_equal(found, expected, equal_nan=True)
    assert np.all(np.isfinite(found[:, 9]))
    assert np.all(np.isnan(found[:, 5]))


def test_vectors_with_the_scan():
    states, vectors = sea(20), random_vectors(20)
    found, ends = in_chunks(states, vectors, BALL, 10, (0.1, 1e-12))
    steps = [a.copy() for a in states]
    impact.steps(*steps, BALL.k, BALL.g, 10, np.empty(20), (0.1, 1e-12))
    assert np.array_equal(ends, steps)
    exact, _ = in_chunks(states, vectors, BALL, 10)
    assert not np.array_equal(found, exact)
    assert found == pytest.approx(exact, rel=1e-4)


@pytest.mark.parametrize("threads", ["1", "3"])
def test_a_spectrum_depends_on_no_other_orbit_or_thread(threads, monkeypatch):
    monkeypatch.setenv("OMP_NUM_THREADS", threads)
    states = sea(tangents.GROUP + 40)
    many = lyapunov_spectrum(BALL, states, 500, 3)["exponent"].values
    for i in (0, 31, 32, tangents.GROUP - 1, tangents.GROUP, many.shape[1] - 1):
        one = lyapunov_spectrum(BALL, [a[i] for a in states], 500, 3)["exponent"].values
        assert np.array_equal(many[:, i], one)
