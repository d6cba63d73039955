"""The last invariant curve: convergents, residues on both sides of breakup, choice of nobles."""

import math

import numpy as np
import pytest

from extensions.atlas import last_curve
from helpers.independent_solver import periodic_point
from helpers.sections import BALL
from pseudorigid import Ball, rotation_number

ENERGY = 0.01


def test_convergents_of_noble_numbers():
    assert last_curve.fractions([0, 1], 5) == [(1, 1), (1, 2), (2, 3), (3, 5), (5, 8)]
    assert last_curve.value([0, 1]) == pytest.approx(0.5 * (math.sqrt(5.0) - 1.0), rel=1e-15)
    for noble in ([0, 5, 1, 15], [0, 5, 1, 17]):
        p, q = last_curve.fractions(noble, 8)[-1]
        assert abs(p / q - last_curve.value(noble)) < 1.0 / (q * q)


def test_residues_on_either_side_of_breakup():
    nobles = [[0, 5, 1, 15], [0, 5, 1, 17]]
    edge = last_curve.last_curve(BALL, ENERGY, 6, (-0.2, -0.0325639), 100, nobles)
    size = np.abs(edge["residue"].values)
    assert edge["period"].values.min() >= 50
    assert size[0, -1] < 0.01 < 0.1 * size[0, 1]
    assert np.all(np.diff(size[1, 1:]) > 0.0) and size[1, -1] > 10.0
    assert np.all(edge["closure"].values < 1e-7)
    starts = edge["x"].values[:, 0], edge["y"].values[:, 0]
    turns = rotation_number(BALL, BALL.state_xy(*starts, ENERGY), 60_000)
    assert turns[0] == pytest.approx(float(edge["rotation"].values[0]), abs=2e-6)


def test_a_residue_is_that_of_newtons_method_in_sixty_digits():
    orbit = last_curve.OrbitSearch(BALL, ENERGY, (-0.2, -0.0325639)).orbit(4, 23)
    start = BALL.start(orbit.start, ENERGY)
    (x, v, w), product = periodic_point(BALL, ENERGY, start, 23)
    assert abs(float(v - w * BALL.k)) < 1e-10 and abs(float(x) - start[0]) < 1e-9
    residue = float((3 - product[0, 0] - product[1, 1] - product[2, 2]) / 4)
    assert orbit.residue == pytest.approx(residue, rel=1e-3)


def test_what_does_not_close_is_no_orbit(monkeypatch):
    """A zero of the turns that is none, and an orbit of a multiple of its period."""
    search = last_curve.OrbitSearch(BALL, ENERGY, (-0.2, -0.0325639))
    for turns, period in ((4, 23), (9, 52)):
        excess = search._excess_turns(turns, period)
        orbits = [search._solve(excess, period, each) for each in search._brackets(excess, 64)]
        assert orbits
        for start, _, closure in orbits:
            state = BALL.start(start, ENERGY)
            off = np.ravel(BALL.after(state, period)[:3]) - state
            assert np.max(np.abs(off)) / search.radius == closure < 1e-9
    monkeypatch.setattr(last_curve, "_bisect", lambda function, above, below: 0.3 * above)
    assert search._solve(search._excess_turns(4, 22), 22, (-0.2, -0.0325639)) is None
    with pytest.raises(ValueError, match="no symmetric orbit of rotation number 4/22"):
        search.orbit(4, 22)


def test_brackets_are_cells_in_which_a_function_changes_its_sign():
    search = last_curve.OrbitSearch(BALL, ENERGY, (0.0, 1.0))
    found = list(search._brackets(lambda at: (at - 0.13) * (at - 0.55), 10))
    assert np.allclose(found, [(0.1, 0.2), (0.6, 0.5)])  # first where the function is positive
    assert last_curve._bisect(lambda at: 0.55 - at, 0.5, 0.6) == pytest.approx(0.55, abs=1e-15)


@pytest.mark.parametrize(
    ("ball", "energy", "between"),
    [(BALL, 0.005, (-0.2, 0.3)), (Ball(1 / 3, 0.04), 0.01, (-0.2, 0.2))],
)
def test_nobles_are_chosen_on_either_side_of_the_last_curve(ball, energy, between):
    """Residues fall for the inner number and not for the outer one."""
    found = last_curve.last_curve(ball, energy, 4, between, 10)
    inside, outside = np.abs(found["residue"].values[:, -1])
    assert inside < 0.25 < outside
    assert np.all(found["closure"].values < 1e-9)


def test_a_noble_number_between_two_numbers():
    for ends in ((0.16, 0.17), (0.2346, 0.2345), (0.3, 0.3 + 1e-9), (1 / 3, 0.333)):
        noble = last_curve.noble_between(*ends)
        assert min(ends) < last_curve.value(noble) < max(ends)


@pytest.mark.parametrize(("between", "nobles", "message"), [
    ((0.55, 0.65), None, "^between = .* is not allowed: begin among curves"),
    ((-0.4, -0.3), None, "^between = .* is not allowed: begin among curves"),
    ((-0.2, -0.1), [[0, 4, 1]], "no symmetric orbit of rotation number 1/5 = 0.2"),
])  # fmt: skip
def test_parts_without_the_last_curve_or_an_orbit_are_refused(between, nobles, message):
    with pytest.raises(ValueError, match=message):
        last_curve.last_curve(BALL, ENERGY, 2, between, 10, nobles)
