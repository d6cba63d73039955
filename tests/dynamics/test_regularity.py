"""The criteria for regular orbits agree with each other."""

import numpy as np
import pytest

from pseudorigid import Ball, lyapunov_spectrum
from pseudorigid.dynamics import fixed_point, regularity
from pseudorigid.dynamics.orbits import scene_orbits
from pseudorigid.dynamics.regularity import regular, regular_bound
from pseudorigid.dynamics.rotation import winding
from pseudorigid.dynamics.verdict import classify_orbits

BALL, IMPACTS = Ball(0.2, 0.04), 20_000


def classified(states, energy):
    """Return the verdicts of `dynamics.verdict`, whose lengths are in g R."""
    x, _, rotation = fixed_point.numbers(BALL.k, energy / BALL.g**2)
    states, size = np.array(states) / BALL.g, len(states[0])
    return classify_orbits(BALL.k, states, np.full(size, x), np.full(size, rotation), IMPACTS)


@pytest.mark.parametrize("energy", [0.001, 0.01, 0.0265])
def test_the_criteria_agree_on_starts_along_the_symmetry_line(energy):
    """They are the growth, the exponents of whole orbits, and verdicts before the end."""
    start = np.linspace(-0.97, 0.97, 120)
    by_growth = regular(winding(BALL, energy, start, IMPACTS)[1], IMPACTS)
    states = BALL.start(start, energy)
    exponent = lyapunov_spectrum(BALL, states, IMPACTS, 1)["exponent"].values[0].max(axis=-1)
    assert np.array_equal(by_growth, exponent <= regular_bound(IMPACTS))
    assert np.array_equal(by_growth, classified(states, energy).regular)
    assert 5 < by_growth.sum() < 115


@pytest.mark.parametrize("impacts", [300, 8000])
def test_orbits_of_a_scene_get_the_verdicts_of_longer_ones(impacts):
    start = np.linspace(-0.97, 0.97, 40)
    data = scene_orbits(BALL, 0.01, start.tolist(), impacts)
    (chaotic,) = np.nonzero(~classified(BALL.start(start, 0.01), 0.01).regular)
    assert np.flatnonzero(data["type"].values == "chaotic").tolist() == chaotic.tolist()
    assert 5 < len(chaotic) < 35


def test_the_growth_does_not_depend_on_the_blocks_in_which_an_orbit_is_followed(monkeypatch):
    state = np.array(BALL.start(0.5, 0.01))
    whole = regularity._growth(BALL, state, 3000)
    monkeypatch.setattr(regularity, "_BLOCK", 7)
    assert regularity._growth(BALL, state, 3000) == whole
