"""The method of inflections and the march agree with an independent solver, and so do their counts.

The states are those on which the march is tested, of many balls. Within rounding errors of a touch
either of two roots is right.
"""

import math

import mpmath
import numpy as np
import pytest
from flights import FAMILIES, by_mpmath, draw
from independent_solver import judge
from slowly import slowly

from pseudorigid.dynamics.ball import Ball
from pseudorigid.kernel.formulas import impact_coefficients, rebound
from study import stages, states
from study.methods import inflections
from study.methods.counted_methods import (
    BEST_SCAN,
    INFLECTIONS,
    LANDING,
    OURS,
    SIMPLE_INFLECTIONS,
    careful_method,
)

# Relative error over max(1, condition) that is allowed to inflections; measured 5.0e-16.
TAU = 1e-15


def tau(state, care):
    k, g, x, v, w = state
    b, c, s = rebound(v, w, k, impact_coefficients(k))
    return inflections.first_impact(x, b, c, s, g, care)[0]


@pytest.mark.parametrize(("count", "judged"), [(500, 10), *slowly((100_000, 300))])
@pytest.mark.parametrize("family", FAMILIES)
def test_inflections_march_and_an_independent_solver_agree(family, count, judged):
    """The solver decides wherever inflections and march differ, and at `judged` states."""
    for i, state in enumerate(draw(family, 7, count)):
        march = Ball(*state[:2]).time_to_impact(*state[2:])
        times = march, tau(state, inflections.BEST), tau(state, inflections.SIMPLE)
        if i < judged or not all(abs(time - march) <= TAU * march for time in times):
            truth = judge(*state)
            for time in times:
                assert by_mpmath(time, truth) <= TAU, (state, times, truth)


def test_angles_are_those_of_the_independent_solver():
    random = np.random.default_rng(3)
    points = random.normal(size=(2000, 2)) * 10.0 ** random.uniform(-9, 9, (2000, 2))
    points = [*points.tolist(), *((y, x) for y in (0.0, 1.0, -1.0) for x in (1.0, -1.0))]
    for y, x in points:
        truth = mpmath.atan2(y, x) % (2 * mpmath.pi)
        off = abs(inflections.angle(y, x) - truth)
        assert min(off, 2 * mpmath.pi - off) <= 2.5 * math.ulp(float(truth)), (y, x)


# Evaluations a flight of 20,000 states: uniform, in the sea, near grazing.
WORK = (
    (OURS, (2.31, 2.26, 2.15)),
    (INFLECTIONS, (2.49, 2.41, 2.79)),
    (SIMPLE_INFLECTIONS, (3.38, 3.37, 2.71)),
    (BEST_SCAN, (3.07, 2.91, 2.76)),
    (careful_method(1.0, LANDING), (4.58, 4.55, 6.37)),
    (careful_method(1.0), (5.55, 5.56, 11.6)),
)


def test_evaluations_of_a_flight():
    sea = stages.certified_orbit(states.BALL, states.chaotic(), 20_000)[0]
    sets = states.uniform(20_000), sea, states.grazing(20_000)
    for method, work in WORK:
        counts = [method.solve(states.BALL, *columns)[1].mean() for columns in sets]
        assert counts == pytest.approx(work, rel=0.01), method.name


@pytest.mark.parametrize("count", [10**5, *slowly(2 * 10**7)])
def test_inflections_differ_at_no_flight_of_the_sea(count):
    data = stages.missed_flights([INFLECTIONS, SIMPLE_INFLECTIONS], count)
    assert data["missed"].values[:, -1].tolist() == [0, 0, 0]


def test_a_touch_within_rounding_is_passed_by_the_march():
    """The march passes it, and the independent solver says that no double can tell."""
    x, c, s, g = 0.015822721625902772, -8.115302795974968, 12.388447259011823, 0.6346446127100052
    b, k = -s - c, 0.2
    xdot, udot, _ = rebound(b, c, k, impact_coefficients(k))
    truth = judge(k, g, x, xdot, udot)
    time = Ball(k, g).time_to_impact(x, xdot, udot)
    assert min(abs(time - root) for root in (truth.tau, truth.rival)) < 1e-6
    assert truth.depth < 1e-15


def test_recorded_touches_within_rounding_are_counted_again():
    data = stages.recorded("search").isel(drawn=2)
    assert str(data["families"].values) == "touches_within_rounding"
    names = data["searched_name"].values.tolist()
    for method in (OURS, INFLECTIONS):
        row = data.isel(searched=names.index(method.name))
        assert 0 < int(row["passed"]) < int(row["failed"]) < int(row["tried"])
        found = row["found"].values.T
        assert stages.wrong_roots([method], found).all()
