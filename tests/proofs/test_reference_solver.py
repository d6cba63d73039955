"""The reference solver in ball arithmetic: against the map, and where doubles decide nothing."""

import numpy as np
import pytest

from pseudorigid import Ball
from pseudorigid.proofs import reference_solver
from pseudorigid.study import states


def test_flight_times_agree_with_the_map():
    sets = [states.uniform(100), states.grazing(100), states.near_miss(-1e-9, 20)]
    sets += [states.grazing_at(e, side, 10) for e in (0, 6, 12) for side in (1, -1)]
    for columns in sets:
        truth = np.array(reference_solver.flight_times(states.BALL, *columns))
        assert np.abs(states.BALL.time_to_impact(*columns) / truth - 1).max() < 1e-14


@pytest.mark.parametrize(("k", "g"), [(1.0, 1.0), (0.01, 1e-4), (1 / 3, 0.3), (0.2, 1e-3)])
def test_flight_times_agree_for_other_balls_and_long_flights(k, g):
    random = np.random.default_rng(7)
    ball = Ball(k=k, g=g)
    x, v, w = random.uniform(-0.5, 0.5, (3, 40))
    w = np.maximum(w, 1e-3 - v)
    truth = np.array(reference_solver.flight_times(ball, x, v, w))
    errors = np.abs(ball.time_to_impact(x, v, w) / truth - 1)
    # where two roots nearly meet, tau is defined to the square root of a rounding error
    assert np.median(errors) < 1e-15
    assert errors.max() < 1e-7


def test_a_ball_pressed_onto_the_floor_stays_there():
    assert reference_solver.first_root(0.2, 0.04, 0.1, 0.05, -0.05) == 0
    at_rest = np.array([[-0.25], [0.0], [0.0]])  # x = -g, s = 0 and udot = 0
    assert reference_solver.impact_errors("1/5", "1/4", at_rest, at_rest, np.zeros(1)) < 1e-300
    # x = -0.04 as a double is not -1/25: the ball leaves the floor
    lifted = np.array([[-0.04], [0.0], [0.0]])
    assert reference_solver.impact_errors("1/5", "1/25", lifted, at_rest, np.zeros(1)) > 0.1
