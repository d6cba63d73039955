"""Pseudo-arclength continuation follows curves that have a closed form."""

from itertools import pairwise

import numpy as np
import pytest

from extensions.families.continuation.curve import Point, continue_curve, locate, solve_at


class Plane:
    """The zeros of h(q, p), given with its derivatives."""

    scale, limits = 1.0, (-5.0, 5.0)

    def __init__(self, function):
        self.function = function

    def point(self, place):
        h, h_q, h_p = self.function(*place)
        return Point(place, (h,), ((h_q, h_p),), np.array(place), (), np.empty(0))


def turning_points(system, points):
    """The places at which the parameter turns."""

    def across(point):
        return point.gradients[0][0]

    return [
        locate(system, a, b, across).place
        for a, b in pairwise(points)
        if across(a) * across(b) < 0.0
    ]


def never(point):
    return False


def test_a_circle_closes_and_its_folds_are_exact():
    system = Plane(lambda q, p: (q * q + p * p - 1.0, 2.0 * q, 2.0 * p))
    points, reason = continue_curve(system, solve_at(system, (0.9, 0.3), 1.0), 1.0, never)
    assert reason == "closed"
    folds = turning_points(system, points)
    assert sorted(p for _, p in folds) == pytest.approx([-1.0, 1.0], abs=1e-15)


def test_a_cubic_has_its_two_folds_and_runs_to_both_limits():
    system = Plane(lambda q, p: (q * q * q - 3.0 * q - p, 3.0 * q * q - 3.0, -1.0))
    start = solve_at(system, (0.0, 0.0), 0.1)
    ends = []
    for sign in (1.0, -1.0):
        points, reason = continue_curve(system, start, sign, never)
        assert reason == "range"
        ((q, p),) = turning_points(system, points)
        assert (abs(q), abs(p)) == pytest.approx((1.0, 2.0), abs=1e-8)
        assert abs(p) == pytest.approx(2.0, abs=1e-15)
        ends.append(points[-1].p)
    assert sorted(ends) == [-5.0, 5.0]
