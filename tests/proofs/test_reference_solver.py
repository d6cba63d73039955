"""The judge in ball arithmetic: against the map, and where doubles decide nothing."""

import numpy as np
import pytest

from pseudorigid import Ball
from pseudorigid.proofs import reference_solver
from pseudorigid.study import states


def test_the_judge_agrees_with_the_map():
    sets = [states.uniform(100), states.grazing(100), states.near_miss(-1e-9, 20)]
    sets += [states.grazing_at(e, side, 10) for e in (0, 6, 12) for side in (1, -1)]
    for columns in sets:
        truth = np.array(reference_solver.flight_times(states.BALL, *columns))
        assert np.abs(states.BALL.time_to_impact(*columns) / truth - 1).max() < 1e-14


@pytest.mark.parametrize(("k", "g"), [(1.0, 1.0), (0.01, 1e-4), (1 / 3, 0.3), (0.2, 1e-3)])
def test_the_judge_agrees_for_other_balls_and_long_flights(k, g):
    random = np.random.default_rng(7)
    ball = Ball(k=k, g=g)
    x, v, w = random.uniform(-0.5, 0.5, (3, 40))
    w = np.maximum(w, 1e-3 - v)
    truth = np.array(reference_solver.flight_times(ball, x, v, w))
    tau = ball.time_to_impact(x, v, w)
    # where two roots all but meet, tau is defined to the root of a rounding
    assert np.median(np.abs(tau / truth - 1)) < 1e-15
    assert np.abs(tau / truth - 1).max() < 1e-7


def test_the_judge_knows_a_ball_at_rest():
    assert reference_solver.first_root(0.2, 0.04, 0.1, 0.05, -0.05) == 0
