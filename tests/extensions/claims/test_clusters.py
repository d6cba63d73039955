"""Clusters of impacts and flight times, against loops, quadrature and a known random process."""

import itertools
import math

import numpy as np
import pytest
import scipy.integrate

from extensions.claims.analyses import clusters as clusters_module
from extensions.claims.analyses.clusters import clusters
from extensions.claims.analyses.sea import ratio, sea_states, section_points
from helpers.sections import BALL
from pseudorigid import classify_orbits, orbit

ENERGY = 0.01
ORBITS = 29  # of which these are chaotic
CHAOTIC = 24


@pytest.fixture(scope="module")
def clustering():
    with pytest.MonkeyPatch.context() as patch:  # five groups of orbits
        patch.setattr(clusters_module, "_IMPACTS_TOGETHER", 5 * 1500)
        return clusters(BALL, ENERGY, ORBITS, 1500, [4.0, 6.5], 2, 80, 7)


def start_of(i):
    """Start of one of the chaotic orbits of `clustering`."""
    return sea_states(BALL, ENERGY, ORBITS)[:, i].tolist()


def test_clusters_are_those_of_a_loop_over_the_impacts(clustering):
    paths = [orbit(BALL, start_of(i), 1500) for i in range(CHAOTIC)]
    rows = [(path["x"].values, (path["xdot"] - 0.2 * path["udot"]).values, path["tau"].values)
            for path in paths]  # fmt: skip
    time = sum(tau.sum() for *_, tau in rows)
    for row, cut in ((0, 4.0), (1, 6.5)):
        begun = [np.flatnonzero(tau > cut) for *_, tau in rows]
        count = sum(map(len, begun))
        pairs = [(x[first], y[first], x[then], y[then])
                 for (x, y, _), at in zip(rows, begun, strict=True)
                 for first, then in itertools.pairwise(at)]  # fmt: skip
        found = clustering.isel(cut=row)
        assert int(found["count"]) == count
        size, period = CHAOTIC * 1500 / count, time / count
        assert float(found["cluster_impacts"]) == pytest.approx(size)
        assert float(found["period"]) == pytest.approx(period)
        expected = np.corrcoef(np.array(pairs).T)[:2, 2:]
        np.testing.assert_allclose(found["correlation"].values[0], expected, atol=1e-10)
        for measure in ("correlation", "dependence"):
            value, low, high = (found[f"{measure}{end}"].values for end in ("", "_low", "_high"))
            assert np.all(low < high)
            assert np.all((low <= value) & (value <= high)) or measure == "dependence"
    assert clustering.sizes["orbit"] == CHAOTIC


def test_energies_and_strains_are_those_of_quadrature(clustering):
    state, energy, kinetic, time, low = start_of(0), 0.0, 0.0, 0.0, 0.0
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
        low = min(low, u.min())
    first = clustering.isel(orbit=0)
    assert float(first["time"]) == pytest.approx(time, rel=1e-12)
    assert float(first["strain_energy"]) == pytest.approx(energy / time, rel=1e-9)
    assert float(first["kinetic_energy"]) == pytest.approx(kinetic / time, rel=1e-9)
    assert float(first["least_strain"]) == pytest.approx(low, abs=1e-6)
    assert np.all(clustering["energy_error"].values < 1e-14)
    assert int(clustering["flights"].sum()) == CHAOTIC * 1500


def test_times_between_clusters_do_not_depend_on_the_length_of_the_orbits():
    """Parts of orbits, in which the ends cut many clusters, have the same means on average."""
    states = np.zeros((1, 100_001, 4))
    states[0, 1:, 3] = np.random.default_rng(4).exponential(1.0, 100_000)
    _, whole = clusters_module._clusters(states[0], 0.2, 3.0)
    parts = states[0, 1:].reshape(5_000, 20, 4)
    parts = np.concatenate([np.zeros((5_000, 1, 4)), parts], axis=1)
    short = sum(clusters_module._clusters(part, 0.2, 3.0)[1] for part in parts)
    np.testing.assert_allclose(short / short[0], whole / whole[0], rtol=1e-12)


@pytest.mark.parametrize("memory", [0.0, 0.6])
def test_memory_of_an_autoregressive_process(memory):
    """a' = r a + sqrt(1 - r^2) noise has the correlation r^lag and the ratio r^(2 lag)."""
    random = np.random.default_rng(3)
    states = random.normal(size=(40, 2, 600))
    for i in range(1, 600):
        states[..., i] *= math.sqrt(1 - memory**2)
        states[..., i] += memory * states[..., i - 1]
    states[:, 1] = 3.0 * states[:, 1] + 1.0  # no measure depends on unit and origin
    resampled = random.integers(0, 40, (100, 40))
    correlation, dependence = clusters_module._memory(list(states), 2, resampled)
    for lag in (1, 2):
        expected = memory**lag * np.eye(2)
        value, low, high = correlation[:, lag - 1]
        np.testing.assert_allclose(value, expected, atol=0.03)
        assert np.all(low - 0.02 < expected) and np.all(expected < high + 0.02)
        # eight bins of a coordinate explain a little less than its value does
        np.testing.assert_allclose(dependence[0, lag - 1], memory ** (2 * lag), atol=0.03)


def test_the_sea_leaves_out_the_starts_in_islands():
    x, y = section_points(BALL, ENERGY, ORBITS)
    regular = classify_orbits(BALL, BALL.state_xy(x, y, ENERGY))["type"].values == "regular"
    states = sea_states(BALL, ENERGY, ORBITS)
    assert ORBITS - regular.sum() == CHAOTIC == states.shape[1]
    starts = np.array(BALL.state_xy(x, y, ENERGY))[:, ~regular]
    assert np.array_equal(states, BALL.after(starts, 16_000)[:3])
    with pytest.raises(ValueError, match="orbits = 1 is not allowed: "):
        sea_states(BALL, ENERGY, 1)


def test_a_ratio_of_sums_has_the_error_of_its_spread():
    random = np.random.default_rng(2)
    parts = random.uniform(1.0, 3.0, (400, 50))
    values, errors = zip(*(ratio(row + random.normal(size=50), row) for row in parts), strict=True)
    assert np.mean(values) == pytest.approx(1.0, abs=0.01)
    assert np.std(values) == pytest.approx(np.mean(errors), rel=0.1)


def test_what_chance_explains_is_no_memory():
    """Of 500 independent states in 64 cells, the cells would seem to explain an eighth."""
    random, found = np.random.default_rng(4), []
    for _ in range(40):
        cell, after = random.integers(0, 64, 500), random.normal(size=(2, 500))
        found.append(clusters_module._dependence(clusters_module._cell_sums(cell, after)))
    assert np.mean(found, axis=0) == pytest.approx([0.0, 0.0], abs=0.02)
    after = np.stack([cell, cell + random.normal(size=500)])
    known = clusters_module._dependence(clusters_module._cell_sums(cell, after.astype(float)))
    assert known[0] == pytest.approx(1.0) and 0.99 < known[1] < 1.0
