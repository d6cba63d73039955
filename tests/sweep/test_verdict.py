"""Verdicts on orbits: those that are safe stay, and what they rest on."""

import numpy as np
import pytest

from pseudorigid import Ball
from pseudorigid.dynamics import fixed_point
from pseudorigid.sweep import cell, verdict


def judged(k, e, starts, impacts):
    """The verdicts on the orbits of a cell."""
    theta = fixed_point.half_time(k, e)
    rotation = fixed_point.rotation(fixed_point.trace(k, theta))
    centre, expected = np.full(starts, fixed_point.place(k, theta)), np.full(starts, rotation)
    return verdict.classify_orbits(
        k, cell.sunflower_points(k, e, starts), centre, expected, impacts
    )


def test_lengths_double_up_to_the_last():
    assert verdict.lengths_to_decide(4000) == [500, 1000, 2000, 4000]
    assert verdict.lengths_to_decide(4001) == [500, 1000, 2000, 4000, 4001]
    assert verdict.lengths_to_decide(300) == [300]
    assert verdict.lengths_to_decide(500) == [500]


def test_a_verdict_that_is_safe_stays():
    """Orbits decided before the end are those decided by a longer run, with the same numbers."""
    short, long = judged(0.2, 6.25, 300, 2000), judged(0.2, 6.25, 300, 8000)
    early = short.followed < 2000
    assert 0.8 < early.mean() < 1.0
    for name in ("regular", "strict", "lenient", "winding", "growth", "exponent", "followed"):
        one, other = (getattr(verdicts, name)[early] for verdicts in (short, long))
        assert np.array_equal(one, other)
    assert np.array_equal(short.strict[early], short.lenient[early])
    assert np.all(long.followed[~early] > 1000)


def test_an_orbit_is_judged_alone_as_in_company():
    k, e = 0.2, 0.625
    many = judged(k, e, 40, 1000)
    states = np.array(cell.sunflower_points(k, e, 40))
    theta = fixed_point.half_time(k, e)
    rotation = fixed_point.rotation(fixed_point.trace(k, theta))
    for i in (0, 7, 39):
        one = verdict.classify_orbits(
            k, states[:, [i]], [fixed_point.place(k, theta)], [rotation], 1000
        )
        for name in ("regular", "winding", "growth", "exponent", "followed"):
            assert np.array_equal(getattr(one, name), getattr(many, name)[[i]])


def test_growth_is_the_mean_logarithm_of_a_tangent_vector():
    """By one Jacobian at a time, and numpy's logarithm."""
    k, e, impacts = 0.2, 6.25, 400
    found = judged(k, e, 6, impacts)
    ball = Ball(k=k, g=1.0)
    for i, start in enumerate(np.array(cell.sunflower_points(k, e, 6)).T):
        state = start
        vector, logs = np.array([0.0, k * state[2], -state[1]]), []
        for _ in range(impacts):
            vector = ball.jacobian(*state) @ vector
            state = ball.impact(*state)[:3]
            logs.append(np.log(np.abs(vector).sum()))
        growth = np.mean(logs[300:]) - np.mean(logs[100:200])
        assert found.growth[i] == pytest.approx(growth, abs=1e-4)
        assert found.exponent[i] == pytest.approx((logs[399] - logs[99]) / 300, abs=1e-4)


def test_the_winding_number_of_a_small_circle_is_the_fixed_points_own():
    k, e = 0.2, 6.25
    theta = fixed_point.half_time(k, e)
    ball = Ball(k=k, g=1.0)
    place = fixed_point.place(k, theta)
    states = np.array(ball.state_xy(place + 1e-4, 0.0, e))[:, None]
    rotation = fixed_point.rotation(fixed_point.trace(k, theta))
    found = verdict.classify_orbits(k, states, [place], [rotation], 2000)
    assert found.regular[0]
    assert found.winding[0] == pytest.approx(rotation, abs=1e-7)


def test_orbits_that_go_on_keep_their_order_in_memory(monkeypatch):
    """In another order all that follows them would be compiled again."""
    levels, follow = [], verdict.propagate_with_tangent

    def watched(orbits, k, start, stop, *sums):
        levels.append(stop)
        assert all(array.flags.c_contiguous for array in (orbits, *sums))
        follow(orbits, k, start, stop, *sums)

    monkeypatch.setattr(verdict, "propagate_with_tangent", watched)
    cell.cell(0.2, 6.25, 50, 1000)
    assert levels == [500, 1000]
