"""The fixed point's closed forms against the map, and their inverses."""

import math

import numpy as np
import pytest

from pseudorigid import Ball
from pseudorigid.dynamics import fixed_point


@pytest.mark.parametrize("k", [0.05, 0.2, 1.0])
@pytest.mark.parametrize("e", [-0.3, 1.0, 6.25])
def test_the_numbers_of_the_fixed_point_are_those_of_the_map(k, e):
    ball = Ball.dimensionless(k)
    x, trace, rotation = fixed_point.numbers(k, e)
    state = ball.state_xy(x, 0.0, e)
    assert np.allclose(ball.impact(*state)[:3], state, atol=1e-12)
    (a, _), (_, d) = ball.chart_jacobian(*state, 1)
    assert trace == pytest.approx(a + d, abs=1e-10)
    if abs(trace) < 2.0:
        assert 2.0 * math.cos(2.0 * math.pi * rotation) == pytest.approx(trace, abs=1e-14)
    else:
        assert math.isnan(rotation)


def test_rotation_numbers_of_parabolic_points_are_defined_and_no_others():
    assert fixed_point.rotation(-2.0) == pytest.approx(0.5, abs=1e-8)
    assert fixed_point.rotation(2.0) == pytest.approx(0.0, abs=1e-7)
    for trace in (2.0 + 1e-15, -2.1, math.nan):
        assert math.isnan(fixed_point.rotation(trace))


@pytest.mark.parametrize(("turns", "impacts"), [(1, 2), (1, 3), (2, 7), (1, 12)])
def test_a_resonance_is_where_the_rotation_number_is_its_fraction(turns, impacts):
    for k in (0.1, 0.2, 0.5):
        e = fixed_point.resonance(k, turns, impacts)
        *_, rotation = fixed_point.numbers(k, e * (1.0 - 1e-12) if turns / impacts == 0.5 else e)
        assert rotation == pytest.approx(turns / impacts, abs=1e-6)
