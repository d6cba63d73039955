"""The method of inflections and the march agree with an independent solver, and so do their counts.

The states are those on which the march is tested, of many balls. Within rounding errors of a touch
either of two roots is right.
"""

import math

import mpmath
import numpy as np
import pytest

from helpers.flights import FAMILIES, by_mpmath, draw
from helpers.independent_solver import judge
from helpers.sections import ball_of
from helpers.slowly import slowly
from pseudorigid.kernel.formulas import impact_coefficients, rebound
from study import stages, states
from study.methods import inflections
from study.methods.counted_methods import (
    BEST_SCAN,
    COUNTS,
    INFLECTIONS,
    LANDING,
    OURS,
    ROTATED_MARCH,
    ROTATED_SCAN,
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
        march = ball_of(*state[:2]).time_to_impact(*state[2:])
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


# Sines with cosines, rotations and inverse functions of a flight: uniform, near grazing, in the
# sea, and at touches of 1e-6. The page of the study has these numbers.
NONE = (0.0, 0.0, 0.0, 0.0)
WORK = {
    OURS: ((2.31, 2.16, 2.27, 6.38), NONE, NONE),
    INFLECTIONS: ((2.06, 1.93, 2.08, 8.64), NONE, (0.42, 0.87, 0.35, 2.0)),
    ROTATED_SCAN: ((2.06, 1.67, 2.07, 5.64), (0.34, 0.64, 0.30, 1.72), NONE),
    ROTATED_MARCH: ((2.01, 1.71, 2.01, 4.16), (0.35, 0.45, 0.31, 2.97), NONE),
    BEST_SCAN: ((3.08, 2.77, 2.93, 11.4), NONE, NONE),
    SIMPLE_INFLECTIONS: ((2.13, 1.58, 2.14, 8.93), NONE, (1.24, 1.12, 1.23, 2.0)),
    careful_method(1.0, LANDING): ((4.58, 6.38, 4.56, 11.7), NONE, NONE),
}


def test_what_a_flight_costs():
    data = stages.counts([*WORK])
    for i, work in enumerate(WORK.values()):
        for name, wanted in zip(COUNTS, work, strict=True):
            assert data[name].values[i] == pytest.approx(wanted, rel=0.02), (i, name)


def test_rotations_find_the_roots_of_the_march():
    """Also where the gap has a maximum near 0, and at wide angles after long flights."""
    sea, _ = stages.certified_orbit(states.BALL, states.chaotic(), 50_000)
    touches = [states.near_miss(height, 300) for height in (1e-3, -1e-3, 1e-9, -1e-9)]
    for columns in (sea, states.uniform(20_000), states.grazing(20_000), *touches):
        truth = OURS.solve(states.BALL, *columns)[0]
        for method in (ROTATED_SCAN, ROTATED_MARCH):
            tau, _ = method.solve(states.BALL, *columns)
            assert not stages.is_wrong(tau, truth).any()
            if columns.shape[1] >= 20_000:  # no touches, whose roots are flat
                assert np.median(np.abs(tau / truth - 1.0)) < 3e-16


def test_orbits_by_rotation_keep_the_energy():
    start = states.chaotic()
    for method in (ROTATED_SCAN, ROTATED_MARCH, BEST_SCAN):
        track, _ = method.orbit(states.BALL, start, 20_000)
        assert stages.energy_drift(states.BALL, start, track)[-1] < 1e-11


@pytest.mark.parametrize("count", [10**5, *slowly(2 * 10**7)])
def test_inflections_and_rotations_differ_at_no_flight_of_the_sea(count):
    methods = [INFLECTIONS, SIMPLE_INFLECTIONS, ROTATED_SCAN, ROTATED_MARCH]
    assert not stages.missed_flights(methods, count)["missed"].values[:, -1].any()


def test_a_touch_within_rounding_is_passed_by_the_march():
    """The march passes it, and the independent solver says that no double can tell."""
    x, c, s, g = 0.015822721625902772, -8.115302795974968, 12.388447259011823, 0.6346446127100052
    b, k = -s - c, 0.2
    xdot, udot, _ = rebound(b, c, k, impact_coefficients(k))
    truth = judge(k, g, x, xdot, udot)
    time = ball_of(k, g).time_to_impact(x, xdot, udot)
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
