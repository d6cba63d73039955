"""The spread of exponents: uniform starts, blocks, regular orbits, and cells that orbits enter."""

import math

import numpy as np
import pytest
import xarray as xr
from sections import BALL

from extensions.claims.analyses.sea import section_points
from extensions.claims.analyses.spread import spread
from extensions.claims.analyses.stretches import in_sea, stretches
from extensions.claims.ledger import chaos
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
    any_, all_, least = (spreading[f"entered_{name}"].values for name in ("any", "all", "least"))
    assert np.all(all_ <= least) and np.all(least <= any_)
    assert np.all(np.diff(any_) >= 0) and np.all(np.diff(least) >= 0)
    assert 0.5 * 144 < any_[-1] <= 144
    sea = in_sea(spreading)
    paths = [orbit(BALL, state, 1 << 13) for state in np.transpose(starts(spreading))[sea]]
    entered = [cells_of(path) for path in paths]
    counts = [len(set.union(*entered)), len(set.intersection(*entered)), min(map(len, entered))]
    assert counts == [any_[-1], all_[-1], least[-1]]


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


def test_the_largest_exponent_of_a_stretch_is_the_largest_by_value():
    chaotic = np.array([[1.2, 1.0, 0.8], [1.0, 1.3, 0.7]])
    blocks = xr.Dataset({"exponent": (("block", "orbit", "index"), chaotic[None])})
    blocks["type"] = "orbit", ["chaotic"] * 2
    long = stretches(blocks.assign_attrs(block_impacts=100), 100)
    assert np.array_equal(long, [1.2, 1.3])
