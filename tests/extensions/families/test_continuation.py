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


class Space:
    """The circle q^2 + r^2 = 1 on the plane p = q/2: two equations in three unknowns."""

    scale, limits = 1.0, (-5.0, 5.0)

    def point(self, place):
        q, r, p = place
        rows = (2.0 * q, 2.0 * r, 0.0), (-0.5, 0.0, 1.0)
        defect = q * q + r * r - 1.0, p - 0.5 * q
        return Point(place, defect, rows, np.array(place), (), np.empty(0))


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


def test_a_curve_in_space_closes():
    system = Space()
    start = solve_at(system, (0.6, 0.8, 0.3), 0.1)
    points, reason = continue_curve(system, start, 1.0, never)
    assert reason == "closed"
    for point in points:
        q, r, p = point.place
        assert abs(q * q + r * r - 1.0) < 1e-14
        assert abs(p - 0.5 * q) < 1e-15


def test_a_curve_does_not_jump_to_its_neighbour():
    """h = sin-like product of parallel curves 0.003 apart, far below the largest step."""
    gap = 0.003

    def function(q, p):
        u = q - 0.3 * p * p
        return (
            u * (u - gap) * (u + gap),
            3.0 * u * u - gap * gap,
            -0.6 * p * (3.0 * u * u - gap * gap),
        )

    system = Plane(function)
    points, _ = continue_curve(system, solve_at(system, (0.0, 0.0), 1e-4), 1.0, never)
    for point in points:
        assert abs(point.q - 0.3 * point.p**2) < 1e-12
