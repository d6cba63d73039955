"""Rotation numbers at the fixed point and in islands, plateaus, and the main island's edge."""

import numpy as np
import pytest
import xarray as xr

from extensions.atlas.symmetry_line import regular
from extensions.claims.analyses import rotation
from extensions.claims.ledger.chaos import discontinuous
from helpers.sections import BALL
from pseudorigid import symmetric_orbits

ENERGY = 0.01


def test_rotation_numbers_at_the_fixed_point_and_in_an_island():
    six = symmetric_orbits(BALL, ENERGY, 6)
    centre, radius = BALL.section(ENERGY)
    island = (float(six["x"].values[0].max()) - centre) / radius  # on y = 0
    fixed_at, fixed_rotation = rotation.symmetric_fixed_point(BALL, ENERGY)
    turns, grown = rotation.winding(BALL, ENERGY, np.array([fixed_at + 1e-5, island]), 20_000)
    assert turns[0] == pytest.approx(fixed_rotation, abs=1e-9)
    assert turns[1] == pytest.approx(1.0 / 6.0, abs=1e-12)
    assert np.all(regular(grown, 20_000))
    one = symmetric_orbits(BALL, ENERGY, 1)
    assert fixed_at * radius + centre == pytest.approx(float(one["x"].values[0, 0]), abs=1e-14)
    assert fixed_rotation == pytest.approx(float(one["rotation_number"].values[0]), abs=1e-14)


def test_plateaus_are_runs_of_one_fraction():
    place = np.arange(40.0)
    turns = 0.3 + 1e-3 * place
    turns[10:14] = 4.0 / 13.0
    turns[30:32] = 1.0 / 3.0  # too few starts
    assert rotation.plateaus(place, turns) == [(4, 13, 10.0, 13.0)]
    turns[20:24] = 0.5
    assert rotation.plateaus(place, turns) == [(1, 2, 20.0, 23.0), (4, 13, 10.0, 13.0)]
    turns[12], turns[22] = 0.31, 0.31
    assert rotation.plateaus(place, turns) == []


def test_main_island_ends_at_two_chaotic_starts():
    found = rotation.rotation(BALL, ENERGY, [0.026], 120, 3000, (-0.8, -0.7), 1000)
    good = regular(found["exponent"].values[0], 3000)
    size = int(found["island"].values[0])
    assert np.array_equal(found["type"].values[0] == "regular", good)
    assert np.all(regular(found["detail_exponent"].values, 1000)[found["detail_type"] == "regular"])
    assert good[:size].sum() >= size - 1
    assert not good[size] and not good[size + 1]
    # the separatrix of the period-six saddles crosses y = 0 at x = 0.18782
    centre, radius = BALL.section(ENERGY)
    assert found["place"].values[0, size - 1] < (0.18782 - centre) / radius
    step = found["place"].values[0, 1] - found["place"].values[0, 0]
    assert found["place"].values[0, size] > (0.18782 - centre) / radius - step


def test_changes_between_regular_and_chaotic_starts_are_counted_with_two_spacings():
    exponent = np.array([[0.0, 9.0] * 4, [0.0, 0.0, 0.0, 9.0, 9.0, 0.0, 9.0, 9.0]])
    data = xr.Dataset({"exponent": (("energy", "start"), exponent)}, {"energy": [0.001, 0.01]})
    numbers = discontinuous(data.assign_attrs(impacts=2)).numbers
    assert [*numbers["counts"], *numbers["fewer"]] == [7, 3, 0, 1]
    assert numbers["starts"] == 8


def test_the_main_island_ends_before_two_chaotic_starts_or_nowhere():
    for starts, size in (("rrcrccr", 4), ("rrcrcr", 6), ("ccr", 0), ("rrrcc", 3)):
        assert rotation.island(np.array([each == "r" for each in starts])) == size
