"""Ball: its parameters, energy, section and states."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from helpers.sections import BALL, ball_of
from pseudorigid import Ball
from pseudorigid.dynamics.ensemble import ImpactMap

every = settings(deadline=None)
numbers = st.floats(-2.0, 2.0, allow_subnormal=False)
# Of any energy: eq. (31) bounds that of balls with g < k.
balls = st.builds(
    lambda k, share: ball_of(k, k / share), st.floats(0.01, 1.0), st.floats(1e-4, 1.0)
)


def test_balls_are_equal_by_value():
    assert [Ball(*ends).k for ends in ((1, 0.5), (1e-323, 5e-324), (1.0, 5e-324))] == [1, 1e-323, 1]
    assert Ball(0.2, 0.04) == BALL
    assert hash(Ball(0.2, 0.04)) == hash(BALL)
    assert repr(BALL) == "Ball(k=0.2, g=0.04, map=ImpactMap(scan=None))"
    scans = [Ball(0.2, 0.04, ImpactMap((0.1, tolerance))) for tolerance in (1e-6, 1e-6, 1e-5)]
    scans[0].impact(0.1, 0.1, 0.1)  # counts do not matter for equality
    assert scans[0] == scans[1] and hash(scans[0]) == hash(scans[1])
    assert len({BALL, *scans}) == 3 and len({repr(ball) for ball in (BALL, *scans)}) == 3
    assert eval(repr(scans[2])) == scans[2]
    with pytest.raises(AttributeError):
        BALL.k = 0.3


def test_the_energy_its_bounds_and_the_section():
    # 0.3^2/2 + 0.2 0.5^2/2 - 0.04 0.1 + 0.2 0.1^2/2
    assert BALL.energy(0.1, 0.3, 0.5) == pytest.approx(0.067, rel=1e-15)
    low, high = BALL.energy_bounds()
    assert (low, high) == (-0.004, 0.06)
    assert BALL.energy(0.2, 0.0, 0.0) == pytest.approx(low, rel=1e-14)
    assert BALL.section(0.01) == pytest.approx((0.04 / 0.2, math.sqrt(0.14)), rel=1e-15)
    assert BALL.section(math.nextafter(low, 1.0))[1] == pytest.approx(0.0, abs=1e-8)


@every
@given(balls, numbers, numbers, numbers)
def test_state_and_state_xy_give_the_energy_back(ball, x, v, w):
    v, w = (v, w) if v + w >= 0 else (-v, -w)
    energy = ball.energy(x, v, w)
    size = v * v + w * w + 2 * ball.g * abs(x) + x * x + 1e-300
    s = v + w
    try:
        again = ball.state_xy(x, v - ball.k * w, energy)
    except ValueError:
        assert ball.k * s * s <= 1e-14 * size  # on the rim
    else:
        assert again[0] == x
        assert again[1] + again[2] >= 0.0 or math.isclose(again[1], -again[2], rel_tol=1e-15)
        assert abs(ball.energy(*again) - energy) <= 1e-15 * size
        speeds = sum(map(abs, (v, w, *again[1:])))  # at rest only the latter are not 0
        assert abs((again[1] - ball.k * again[2]) - (v - ball.k * w)) <= 1e-15 * speeds
    try:
        again = ball.state(x, v, energy, math.copysign(1, w))
    except ValueError:
        assert ball.k * w * w <= 1e-14 * size or s <= 1e-7
    else:
        assert again[:2] == (x, v)
        assert again[2] * w >= 0.0
        assert abs(ball.energy(*again) - energy) <= 1e-15 * size


@every
@given(balls, st.floats(-1.0, 1.0), st.floats(-0.999, 10.0))
def test_a_start_has_the_energy_and_lies_on_the_symmetry_line(ball, fraction, height):
    energy = ball.energy_bounds()[0] * -height  # from just above the least energy
    x, v, w = ball.start(fraction, energy)
    centre, radius = ball.section(energy)
    size = v * v + w * w + 2 * ball.g * abs(x) + x * x
    rounded = ball.k * centre**2  # near the rim x is a difference of two numbers near the centre
    assert abs(ball.energy(x, v, w) - energy) <= 2e-15 * (size + rounded)
    assert abs(v - ball.k * w) <= 1e-15 * abs(v) and v + w >= 0.0
    assert x == pytest.approx(centre + fraction * radius, abs=1e-15 * size**0.5)


def test_states_that_do_not_exist_are_rejected():
    for method, arguments, message in (
        (BALL.state, (0.9, 0.0, 0.01), "no state"),
        (BALL.state, (0.2, -0.01, 0.01, -1), "section"),
        (BALL.state_xy, (0.2, 0.9, 0.01), "section"),
        (BALL.state, (0.2, 0.0, 0.01, 2), "branch = 2"),
    ):
        with pytest.raises(ValueError, match=message):
            method(*arguments)
