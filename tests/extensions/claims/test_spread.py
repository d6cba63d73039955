"""The spread of exponents: uniform starts, blocks, regular orbits, and cells that orbits enter."""

import math

import numpy as np
import pytest

from extensions.claims.analyses.sea import section_points
from extensions.claims.analyses.spread import spread
from extensions.claims.analyses.stretches import in_sea, spread_of_runs, stretches
from extensions.claims.ledger import chaos
from helpers.sections import BALL
from helpers.slowly import slowly
from pseudorigid import lyapunov_spectrum, orbit

ENERGY = 0.01


@pytest.fixture(scope="module")
def spreading():
    return spread(BALL, ENERGY, 20, 40_000, 8, [-0.44, 0.142183], 1 << 14, 12, 1 << 13)


def starts(dataset):
    """States in which the orbits start."""
    return BALL.state_xy(dataset["start_x"].values, dataset["start_y"].values, ENERGY)


def test_orbits_start_uniformly_over_the_whole_section():
    """Each of eight sectors, and of eight rings of equal area, has an eighth of the starts."""
    x, v, w = BALL.state_xy(*section_points(BALL, ENERGY, 4000), ENERGY)
    assert np.all(v + w > 0.0)
    assert np.max(np.abs(BALL.energy(x, v, w) - ENERGY)) < 1e-15
    centre, radius = BALL.section(ENERGY)
    across, up = (x - centre) / radius, (v - 0.2 * w) / (radius * math.sqrt(0.24))
    eighth = np.floor(4.0 * np.arctan2(up, across) / np.pi).astype(int) % 8
    ring = np.minimum((8.0 * (across**2 + up**2)).astype(int), 7)
    for parts in (eighth, ring):
        assert np.bincount(parts, minlength=8) == pytest.approx(500, abs=15)


def test_chaotic_orbits_are_those_with_exponents_in_longer_runs(spreading):
    states = starts(spreading)
    chaotic = lyapunov_spectrum(BALL, states, 100_000, 1)["exponent"].values[0, :, 0] > 1e-3
    assert np.array_equal(in_sea(spreading), chaotic)
    assert 0 < chaotic.sum() < chaotic.size


def test_blocks_add_up_to_the_exponents_of_the_whole(spreading):
    whole = lyapunov_spectrum(BALL, starts(spreading), 40_000, 1)["exponent"].values[0]
    np.testing.assert_allclose(spreading["exponent"].values.mean(axis=0), whole, atol=1e-13)
    sea = in_sea(spreading)
    assert stretches(spreading, 40_000) == pytest.approx(whole[sea, 0], abs=1e-13)
    assert stretches(spreading, 10_000).size == 4 * sea.sum()


def test_counts_of_cells_are_those_of_each_orbit(spreading):
    any_, least = (spreading[f"entered_{name}"].values for name in ("any", "least"))
    assert np.all(least <= any_)
    assert np.all(np.diff(any_) >= 0) and np.all(np.diff(least) >= 0)
    assert 0.5 * 144 < any_[-1] <= 144
    sea = in_sea(spreading)
    paths = [orbit(BALL, state, 1 << 13) for state in np.transpose(starts(spreading))[sea]]
    entered = [cells_of(path) for path in paths]
    counts = [len(set.union(*entered)), min(map(len, entered))]
    assert counts == [any_[-1], least[-1]]


def cells_of(path):
    """The cells of a 12 x 12 grid over the section that an orbit enters after its start."""
    centre, radius = BALL.section(ENERGY)
    x = (path["x"].values[1:] - centre) / radius
    y = (path["xdot"].values - 0.2 * path["udot"].values)[1:] / (radius * math.sqrt(0.24))
    return {(int(6 * (a + 1)), int(6 * (b + 1))) for a, b in zip(x, y, strict=True)}


def test_a_short_chaotic_orbit_in_an_island_s_place_is_noticed():
    data = spread(BALL, ENERGY, 4, 400, 4, [0.6, -0.2], 4, 4, 4)
    assert data["regular_type"].values.tolist() == ["chaotic", "regular"]
    assert chaos.regular_exponents(data).verdict == "does not hold"


@pytest.mark.parametrize(
    ("energy", "length", "message"),
    [(-0.003, 200, "orbits = 1 of 200 impacts .* none is chaotic"), (ENERGY, 10, "length = 10")],
)
def test_sections_without_chaos_and_uneven_blocks_are_refused(energy, length, message):
    with pytest.raises(ValueError, match=message):
        spread(BALL, energy, 1, length, 4, [0.1], 4, 4, 4)


def skewness(values):
    """Return the third central moment in units of the standard deviation."""
    return np.mean((values - values.mean()) ** 3) / values.std() ** 3


def second_table(ball, energy, states, length, block):
    """Exponents of runs by renormalizing one tangent vector, and by scipy their two moments.

    The vector is carried by the Jacobians of single impacts, and the errors are those of leaving
    out an orbit at a time, computed one by one.
    """
    paths = [ball.history(state, length)[0] for state in states]
    rows = []
    for state, path in zip(states, paths, strict=True):
        before = np.vstack((state, path[:-1, :3]))
        jacobians, vector, grown = ball.jacobian(*before.T), np.array([1.0, 0.0, 0.0]), []
        for jacobian in jacobians:
            vector = jacobian @ vector
            grown.append(math.log(np.linalg.norm(vector)))
            vector = vector / np.linalg.norm(vector)
        rows.append(np.reshape(grown, (-1, block)).mean(axis=1))
    rows, table = np.array(rows), []
    for count in (1, 2, 5, 10, 20):
        runs = rows[:, : rows.shape[1] // count * count].reshape(len(rows), -1, count).mean(axis=2)
        left_out = [np.delete(runs, i, axis=0).ravel() for i in range(len(runs))]
        pairs = [(values.std(), skewness(values)) for values in (runs.ravel(), *left_out)]
        errors = np.std(pairs[1:], axis=0) * math.sqrt(len(runs) - 1)
        table.append((pairs[0][0], errors[0], pairs[0][1], errors[1]))
    return np.array(table)


@pytest.mark.parametrize(("orbits", "length"), [(6, 4000), *slowly((24, 200_000))])
def test_the_table_of_runs_is_that_of_a_second_implementation(orbits, length):
    data = spread(BALL, ENERGY, orbits, length, 20, [0.1], 16, 2, 2)
    names = ["deviation", "deviation_error", "skewness", "skewness_error"]
    found = np.stack([data[name].values for name in names], axis=1)
    sea = np.transpose(starts(data))[in_sea(data)]
    assert data["run"].values.tolist() == [length // 20 * n for n in (1, 2, 5, 10, 20)]
    expected = second_table(BALL, ENERGY, sea, length, length // 20)
    np.testing.assert_allclose(found, expected, rtol=1e-6, atol=1e-6)


def test_one_orbit_and_one_run_have_no_error():
    data = spread_of_runs(np.ones((2, 1, 3)), 10)
    assert data["run"][1].tolist() == [10, 20]
    assert np.isnan(data["deviation_error"][1]).all() and np.isnan(data["skewness"][1]).all()
