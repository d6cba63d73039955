"""Counts of symmetric orbits over periods, and the periods that an error names."""

import numpy as np
import pytest

from helpers.sections import BALL
from pseudorigid import Ball, count_orbits, residue, symmetric_orbits
from pseudorigid.dynamics.motion import scene_motion


def test_counts_are_those_of_the_orbits():
    counts = count_orbits(BALL, 0.01, 7)
    assert counts["count"].dims == ("period", "type")
    for period in range(1, 8):
        orbits = symmetric_orbits(BALL, 0.01, period)
        for kind in counts["type"].values:
            expected = np.count_nonzero(orbits["type"].values == kind)
            assert counts["count"].sel(period=period, type=kind) == expected
        here = counts.isel(orbit=counts["orbit_period"].values == period)
        assert np.array_equal(here["residue"].values, residue(orbits).values)
        assert here["orbit_type"].values.tolist() == orbits["type"].values.tolist()
    assert counts.attrs["line_points_seen"] == 1.0
    with pytest.raises(ValueError, match=r"^longest = 0 is not allowed: a whole number"):
        count_orbits(BALL, 0.01, 0)


@pytest.mark.filterwarnings("ignore:no sphere")
def test_an_orbit_that_does_not_exist_names_the_periods_that_do():
    ball = Ball(0.35, 0.08)
    counts = count_orbits(ball, 0.02, 12)["count"]
    periods = {
        kind: counts["period"].values[counts.sel(type=kind).values > 0].tolist()
        for kind in ("elliptic", "hyperbolic")
    }
    assert periods == {"elliptic": [1, 5], "hyperbolic": [5, 6, 7, 11, 12]}
    none = symmetric_orbits(ball, 0.02, 4)
    for kind, found in periods.items():
        words = f"none at all\\); periods up to 12 with one: {', '.join(map(str, found))}$"
        with pytest.raises(ValueError, match=f"^no {kind} orbit of period 4 .*{words}"):
            scene_motion(ball, 0.02, none, period=4, type=kind, duration=5.0)
