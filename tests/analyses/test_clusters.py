"""Clusters of impacts and flight times: counted one by one, and against a known process."""

import itertools
import math

import numpy as np
import pytest
import scipy.integrate

from pseudorigid import Ball, orbit
from pseudorigid.analyses import clusters as clusters_module
from pseudorigid.analyses.clusters import clusters

BALL, ENERGY = Ball(0.2, 0.04), 0.01
SEA = (0.55, 0.68)


@pytest.fixture(scope="module")
def clustering():
    return clusters(BALL, ENERGY, SEA, 24, 1500, [4.0, 6.5], 2, 80, 7)


def paths():
    """The orbits of `clustering`, each as x, y, tau with the start first."""
    for i in range(24):
        start = SEA[0] + (SEA[1] - SEA[0]) * (i + 0.5) / 24
        state = BALL.start(start, ENERGY)
        path = orbit(BALL, state, 1500)
        y = path["xdot"].values - 0.2 * path["udot"].values
        yield path["x"].values, y, path["tau"].values


@pytest.mark.parametrize("row, cut", [(0, 4.0), (1, 6.5)])
def test_clusters_counted_one_by_one(clustering, row, cut):
    count, sizes, periods, pairs = 0, [], [], []
    for x, y, tau in paths():
        begun = [i for i in range(1500) if tau[i] > cut]
        count += len(begun)
        for one, other in itertools.pairwise(begun):
            sizes.append(other - one)
            periods.append(sum(tau[one + 1 : other + 1]))
            pairs.append((x[one], y[one], x[other], y[other]))
    assert int(clustering["count"].values[row]) == count
    assert float(clustering["cluster_impacts"].values[row]) == pytest.approx(np.mean(sizes))
    assert float(clustering["period"].values[row]) == pytest.approx(np.mean(periods))
    expected = np.corrcoef(np.array(pairs).T)[:2, 2:]
    np.testing.assert_allclose(clustering["correlation"].values[row, 0], expected, atol=1e-10)
    for measure in ("correlation", "dependence"):
        value, low, high = (clustering[f"{measure}{end}"].values for end in ("", "_low", "_high"))
        assert np.all(low < high)
        assert np.all((low <= value) & (value <= high)) or measure == "dependence"


def test_flight_times_are_all_counted(clustering):
    assert int(clustering["flights"].sum()) == 24 * 1500
    assert clustering.sizes["edge"] == clustering.sizes["bin"] + 1


def test_strain_energy_by_quadrature(clustering):
    head = BALL.start(SEA[0] + (SEA[1] - SEA[0]) * 0.5 / 24, ENERGY)
    state, energy, kinetic, time, low, high = head, 0.0, 0.0, 0.0, 0.0, 0.0
    for _ in range(1500):
        x, v, w = state
        jump = 2.0 * (v + w) / 1.2
        b, c = v - 0.2 * jump, w - jump
        *state, tau = BALL.impact(*state)
        t = np.linspace(0.0, tau, 4001)
        u = c * np.sin(t) - x * np.cos(t)
        energy += 0.1 * scipy.integrate.simpson(u * u, x=t)
        rates = (b + 0.04 * t) ** 2 / 2 + 0.1 * (c * np.cos(t) + x * np.sin(t)) ** 2
        kinetic += scipy.integrate.simpson(rates, x=t)
        time += tau
        low, high = min(low, u.min()), max(high, u.max())
    assert float(clustering["time"].values[0]) == pytest.approx(time, rel=1e-12)
    assert float(clustering["strain_energy"].values[0]) == pytest.approx(energy / time, rel=1e-9)
    assert float(clustering["kinetic_energy"].values[0]) == pytest.approx(kinetic / time, rel=1e-9)
    assert float(clustering["least_strain"].values[0]) == pytest.approx(low, abs=1e-6)
    assert float(clustering["largest_strain"].values[0]) == pytest.approx(high, abs=1e-6)
    assert np.all(clustering["energy_error"].values < 1e-14)


@pytest.mark.parametrize("memory", [0.0, 0.6])
def test_memory_of_a_process_that_is_known(memory):
    """Of the process a' = r a + sqrt(1 - r^2) noise the correlation is r^lag, the ratio r^2."""
    bits = np.random.default_rng(3)
    first = []
    for _ in range(40):
        noise = bits.normal(size=(2, 600))
        states = np.empty((2, 600))
        states[:, 0] = noise[:, 0]
        for i in range(1, 600):
            states[:, i] = memory * states[:, i - 1] + math.sqrt(1 - memory**2) * noise[:, i]
        first.append(states)
    chosen = bits.integers(0, 40, (100, 40))
    correlation, dependence = clusters_module._memory(first, 2, chosen)
    for lag in (1, 2):
        expected = memory**lag * np.eye(2)
        value, low, high = correlation[:, lag - 1]
        np.testing.assert_allclose(value, expected, atol=0.03)
        assert np.all(low - 0.02 < expected) and np.all(expected < high + 0.02)
        # eight bins of each coordinate explain a little less than the whole
        np.testing.assert_allclose(dependence[0, lag - 1], memory ** (2 * lag), atol=0.03)


def test_a_cut_beyond_all_flights_is_refused():
    with pytest.raises(ValueError, match=r"cuts = 9.0 is not allowed"):
        clusters(BALL, ENERGY, SEA, 2, 50, [9.0], 1, 4, 1)
