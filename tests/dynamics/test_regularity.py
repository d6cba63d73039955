"""The criteria for regular orbits agree with each other, and none decides too early."""

import numpy as np
import pytest

import pseudorigid
from pseudorigid import Ball, lyapunov_spectrum
from pseudorigid.dynamics import fixed_point, regularity
from pseudorigid.dynamics.lyapunov import scene_exponents
from pseudorigid.dynamics.orbits import scene_orbits
from pseudorigid.dynamics.regularity import around_fixed_point, first_turn, regular, regular_bound
from pseudorigid.dynamics.rotation import winding
from pseudorigid.dynamics.verdict import classify_orbits
from pseudorigid.kernel import verdict

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


SLOW = [  # k, g, energy, starts, impacts of chaotic orbits that short runs take for regular ones
    (0.2, 0.04, 0.001, [0.894427], 400),
    (0.2, 0.04, 0.01, [0.6, 0.62, 0.65], 10),
    (0.2, 0.04, 0.01, [0.9999999, 0.99999999999, 1.0 - 1e-16], 500),
    (1e-6, 1e-9, 1e-7, [-0.3, 0.2, 0.6], 200),
]


@pytest.mark.parametrize(("k", "g", "energy", "starts", "impacts"), SLOW)
def test_no_run_that_is_too_short_calls_a_chaotic_orbit_regular(k, g, energy, starts, impacts):
    ball = Ball(k, g)
    for types in (
        scene_orbits(ball, energy, starts, impacts)["type"].values,
        scene_exponents(ball, energy, starts, impacts, 5)["type"].values,
        pseudorigid.classify_orbits(ball, ball.start(starts, energy))["type"].values,
    ):
        assert "regular" not in types and types[0] == "chaotic"
        assert np.all((types == "chaotic") | (np.array(starts) > 0.999999999))


def test_no_run_that_is_too_short_calls_a_regular_orbit_chaotic():
    for impacts in (1, 2, 7):
        types = scene_exponents(BALL, 0.01, [-0.2, 0.1, 0.5], impacts, 1)["type"].values
        assert types.tolist() == ["regular", "regular", "chaotic"]


def test_an_orbit_without_a_whole_turn_is_undecided_and_one_that_makes_it_late_is_not():
    """The least energy is -0.004, where nothing turns; nearby all is regular."""
    starts = [0.3, -0.5]
    for above, word in ((1e-12, "undecided"), (1e-7, "regular")):
        energy = above - 0.004
        assert scene_orbits(BALL, energy, starts, 3)["type"].values.tolist() == [word] * 2
        assert scene_exponents(BALL, energy, starts, 3, 3)["type"].values.tolist() == [word] * 2
    found = pseudorigid.classify_orbits(BALL, BALL.start([0.3, -0.2], [energy, 0.01]), 100)
    assert found["type"].values.tolist() == ["undecided", "regular"]
    assert found["followed"].values.tolist() == [2000, 500]


def test_turns_are_those_of_the_angle_around_the_fixed_point():
    states = BALL.start(np.linspace(-0.99, 0.99, 30), 0.01)
    orbits, centre, expected = around_fixed_point(BALL, states)
    found = first_turn(BALL.k, orbits, centre, expected, 500)
    x, v, w = np.moveaxis(Ball.dimensionless(BALL.k).history(orbits, 500)[..., :3], -1, 0)
    p = np.column_stack([orbits[0], x]) - centre[0]
    q = np.column_stack([orbits[1] - 0.2 * orbits[2], v - 0.2 * w]) / 0.24**0.5
    turns = -np.diff(np.arctan2(q, p), axis=1) / (2.0 * np.pi)
    turns -= np.floor(turns - (expected[0] - 0.5))
    exact = np.cumsum(turns, axis=1)
    at = np.arange(30)
    assert np.all(exact[at, found - 1] > 0.98)
    assert np.all(exact[at, found - 2] < 1.02)


@pytest.mark.parametrize("energy", [-0.003, 0.01, 0.0374, 0.055])
def test_the_elliptic_fixed_point_is_regular(energy):
    """It makes no turns, and rounding errors decide the angles around it."""
    x = fixed_point.numbers(BALL.k, energy / BALL.g**2)[0] * BALL.g
    start = {"x": x, "y": 0.0}
    assert scene_orbits(BALL, energy, [start], 5)["type"].item() == "regular"
    found = pseudorigid.classify_orbits(BALL, BALL.state_xy(x, 0.0, energy))
    assert found["type"].item() == "regular"


# Halves of the winding number, growth, log of the vector's length -> regular, strict, lenient,
# decided before the end, and the same at the end; by the rule in the docstring of dynamics.verdict.
RULE = [
    ((0.1, 0.1), 1.0, 9.0, "1111", "1111"),
    ((0.1, 0.1), 1.2, 9.0, "0000", "1011"),  # above half the threshold
    ((0.1, 0.1001), 1.0, 9.0, "0000", "1111"),  # winding numbers that differ
    ((0.1001, 0.1), 1.0, 9.0, "0000", "1111"),
    ((0.1, 0.1), 2.1, 9.0, "0000", "1011"),
    ((0.1, 0.1), 2.3, 9.0, "0000", "0011"),  # above the threshold
    ((0.1, 0.1), 4.3, 20.0, "0000", "0011"),
    ((0.1, 0.1), 4.5, 20.0, "0001", "0001"),  # above twice the threshold
    ((0.1, 0.1), 4.5, 14.0, "0000", "0001"),  # a vector that may be that of a regular orbit
    ((0.1, 0.1), float("nan"), 9.0, "0001", "0001"),
]


@pytest.mark.parametrize(("halves", "growth", "size", "before", "at_end"), RULE)
def test_the_rule_of_verdicts(halves, growth, size, before, at_end):
    weights, quarter = (4.0, 2.0, 2.0), 100
    turned = (0.4, 2.0 * halves[0], 2.0 * halves[1])
    for end, expected in ((False, before), (True, at_end)):
        given = turned, weights, (300.0, 300.0 + quarter * growth), quarter, size, end
        winding, found, *flags = verdict.judge(*given)
        assert (winding, found) == (0.1, pytest.approx(growth, nan_ok=True))
        assert "".join(str(int(flag)) for flag in flags) == expected


def test_each_orbit_is_judged_by_its_own_sums():
    turned = np.array([[0.4, 0.8, 0.4], [0.2, 0.4, 0.2], [0.2, 0.4, 0.21]])
    grown = np.array([[3.0, 3.0, 3.0], [103.0, 903.0, 103.0]])
    winding, growth, verdicts = np.empty(3), np.empty(3), np.empty((3, 4), bool)
    sizes, weights = np.array([9.0, 20.0, 9.0]), (4.0, 2.0, 2.0)
    verdict.judge_each(turned, weights, grown, 100, sizes, False, winding, growth, verdicts)
    assert (winding.tolist(), growth.tolist()) == ([0.1, 0.2, 0.1], [1.0, 9.0, 1.0])
    assert verdicts.tolist() == [[True] * 4, [False, False, False, True], [False] * 4]
