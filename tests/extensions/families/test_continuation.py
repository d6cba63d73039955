"""Pseudo-arclength continuation follows curves that have a closed form."""

from itertools import pairwise
from types import SimpleNamespace

import numpy as np
import pytest

from extensions.families.continuation import curve
from extensions.families.continuation.curve import (
    Point,
    at_parameter,
    continue_both_ways,
    continue_curve,
    locate,
    solve_at,
)
from extensions.families.continuation.family import Family, _find_events


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


def circle(q, p):
    return q * q + p * p - 1.0, 2.0 * q, 2.0 * p


def line(q, p):
    return q, 1.0, 0.0


def gaps(points):
    places = np.array([point.place for point in points])
    return np.max(np.abs(np.diff(places, axis=0)), axis=1)


def test_no_step_is_longer_than_the_limit():
    for function, place in ((circle, (0.9, 0.3)), (line, (0.0, 0.0))):
        system = Plane(function)
        points, _ = continue_curve(system, solve_at(system, place, 1.0), 1.0, never)
        assert 0.9 * curve.LARGEST_STEP < gaps(points).max() < 1.01 * curve.LARGEST_STEP


def test_a_curve_that_ends_is_followed_to_its_end():
    class Half(Plane):
        def point(self, place):
            return super().point(place) if place[1] <= 1.0 else None

    system = Half(line)
    points, (first, last) = continue_both_ways(system, solve_at(system, (0.0, 0.0), 0.1), never)
    assert (first, last) in {("range", "blocked"), ("blocked", "range")}
    ps = [point.p for point in points]
    assert (min(ps), max(ps)) == (-5.0, pytest.approx(1.0, abs=1e-9))
    assert sorted(ps) in (ps, ps[::-1]) and ps.count(0.0) == 1
    start = solve_at(system, (0.0, -4.0), 0.1)
    for sign in (1.0, -1.0):
        part, reason = continue_curve(system, start, sign, lambda point: abs(point.p) < 3.5)
        if reason == "collapse":
            assert 3.4 < abs(part[-1].p) < 3.5 < abs(part[-2].p)
            break
    assert reason == "collapse"


def test_a_step_to_a_neighbouring_curve_is_noticed():
    """Zeros beside q = 0, nearer than a step; quantities that jump, and vectors that turn."""
    for gap in (1e-3, 1e-2):
        system = Plane(
            lambda q, p, g=gap: (q * (q - g * (1 + p * p)), 2 * q - g * (1 + p * p), -2 * g * q * p)
        )
        points, _ = continue_curve(system, solve_at(system, (0.0, 0.0), 1e-4), 1.0, never)
        assert max(abs(point.q) for point in points) < 1e-12

    class Jumping(Plane):
        controls, separation = 0.0, 1.0

        def point(self, place):
            found, beyond = super().point(place), place[1] > 1.0
            control = np.array([self.controls * beyond])
            return found._replace(
                controls=control, separations=(np.array([self.separation if beyond else 1.0]),)
            )

    for controls, separation, reason in (
        (0.1, 1.0, "range"), (0.3, 1.0, "blocked"), (-0.3, 1.0, "blocked"),
        (0.0, 0.7, "range"), (0.0, 0.5, "blocked"), (0.0, -1.0, "blocked"),
    ):  # fmt: skip
        system = Jumping(line)
        system.controls, system.separation = controls, separation
        start = solve_at(system, (0.0, 0.0), 0.1)
        ends = {continue_curve(system, start, sign, never)[1] for sign in (1.0, -1.0)}
        assert ends == {"range", reason}


def test_a_jump_of_the_equation_is_no_solution():
    jump = Plane(lambda q, p: (1.0 if q > 0.3 else -1.0, 1e12, 0.0))
    assert solve_at(jump, (0.3, 0.0), 1.0) is None
    assert solve_at(Plane(lambda q, p: (q * q + 1.0, 2.0 * q, 0.0)), (0.3, 0.0), 1.0) is None
    far = Plane(lambda q, p: (q - 1.0, 1.0, 0.0))
    assert solve_at(far, (0.0, 0.0), 0.4) is None and solve_at(far, (0.0, 0.0), 0.6).q == 1.0


@pytest.mark.parametrize(("drop", "equations"), [(0.09, 2), (0.11, 2), (0.09, 1)])
def test_a_defect_that_falls_to_a_tenth_is_progress_with_two_equations(drop, equations):
    """Newton's steps have the length 1 until the last one."""
    defects, rows = iter([drop, drop**2, drop**3, 0.0]), np.eye(equations + 1)

    def point(place):
        h = next(defects)
        gradients = ((h or 1.0) * rows[0], *rows[1:-1])
        return Point(place, (h, 0.0)[:equations], gradients, np.empty(0), (), None)

    found = curve.correct(SimpleNamespace(scale=1.0, point=point), tuple(rows[0]), rows[-1], 2.0)
    assert (found is not None) == ((drop, equations) == (0.09, 2))


@pytest.mark.parametrize("p", [0.3, 0.25, -0.7])
def test_the_point_at_a_parameter_lies_between_its_neighbours(p):
    system = Plane(circle)
    for q in (0.9, -0.9):
        points, _ = continue_curve(system, solve_at(system, (q, 0.0), 1.0), 1.0, never)
        for a, b in pairwise(points):
            if (a.p < p) != (b.p < p):
                found, true = at_parameter(system, a, b, p), np.copysign((1.0 - p * p) ** 0.5, a.q)
                assert found.p == p and found.q == pytest.approx(true, abs=1e-14)
                assert at_parameter(system, a, b, a.p) is a and at_parameter(system, a, b, b.p) is b


class Monitored(Plane):
    """The line q = 0, on which a monitored value changes its sign at p = 0.105."""

    residues, traces, period = 1.0, 0.0, 1

    def __init__(self, kind):
        super().__init__(line)
        self.monitors = [(kind, lambda point: point.p - 0.105)]

    def residue(self, point):
        return self.residues

    def trace(self, point):
        return self.traces * point.p


@pytest.mark.parametrize(
    ("kind", "residue", "found"),
    [("fold", 1e-7, 1), ("fold", 1e-9, 0), ("pitchfork", 1e-9, 0), ("doubling", 1e-9, 1)],
)
def test_signs_of_rounding_are_no_events(kind, residue, found):
    system = Monitored(kind)
    system.residues = residue
    points = [system.point((0.0, 0.01 * i)) for i in range(20)]
    family = Family(system, points, [])
    _find_events(family, 2)
    assert [event.kind for event in family.events] == [kind] * found
    for event in family.events:
        assert event.point.p == pytest.approx(0.105, abs=1e-15)
        assert family.points[int(event.curve_index)] is event.point
        assert event.order == (2 if kind == "doubling" else 1)
    assert [point.p for point in family.points] == sorted(point.p for point in family.points)


@pytest.mark.parametrize(("period", "longest"), [(1, 1), (1, 6), (2, 6), (3, 12)])
def test_resonances_are_found_where_children_are_short_and_always_the_strong_ones(period, longest):
    system = Monitored("fold")
    system.period, system.traces, system.monitors = period, 1.0, []
    family = Family(system, [system.point((0.0, -2.0 + 0.01 * i)) for i in range(401)], [])
    _find_events(family, longest)
    orders = range(3, max(4, longest // period) + 1)
    pairs = {(t, q) for q in orders for t in range(1, (q + 1) // 2) if np.gcd(t, q) == 1}
    assert {(event.turns, event.order) for event in family.events} == pairs
    for event in family.events:
        trace = 2.0 * np.cos(2.0 * np.pi * event.turns / event.order)
        assert event.point.p == pytest.approx(trace, abs=1e-14)
