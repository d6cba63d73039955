"""Invariants, inverse, scaling and Jacobian of the impact map."""

import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from helpers.independent_solver import exact_jacobian, judge
from helpers.sections import BALL, ball_of, sea
from pseudorigid.dynamics.ball import Ball
from pseudorigid.kernel import flight

# Tolerances: about 1.4 times the largest errors of 20,000 states of each ball, or of 300 and 40
# states where the reference solver is used.
STATE = 2.5e-16
DETERMINANT = 2.7e-15
JACOBIAN = 8e-16
INVERSE = 1.4e-16
ENERGY = 1e-11  # relative, over a million impacts; the largest error of these orbits is 7.8e-12

BALLS = (BALL, Ball(0.01, 0.003), Ball(1 / 3, 0.1), Ball(1.0, 1e-4), Ball.dimensionless(1.0))


def states(ball, count):
    """Return states at E/g^2 = 6.25 as in Figure 2."""
    return sea(count, 6.25 * ball.g**2, ball)


def sizes(ball, x, v, w):
    return np.abs(x) + np.abs(v) + np.abs(w) + ball.g


def spread(matrices):
    """Return the largest entry of each matrix, at least 1."""
    return np.maximum(1.0, np.abs(matrices).max(axis=(-1, -2)))


def test_energy_over_a_million_impacts():
    """Check orbits in the sea and in islands of Figure 2 every 5,000 impacts."""
    state = BALL.state_xy(np.array([0.40, 0.0735, 0.2532]), 0.0, 0.01)
    for _ in range(200):
        state = BALL.after(state, 5_000)[:3]
        assert np.max(np.abs(BALL.energy(*state) / 0.01 - 1.0)) < ENERGY


@pytest.mark.parametrize("ball", BALLS, ids=str)
def test_state_against_the_reference_solver(ball):
    state = states(ball, 60)
    found = np.array(ball.impact(*state)).T
    for start, (*end, tau) in zip(zip(*state, strict=True), found, strict=True):
        true = judge(ball.k, ball.g, *start)
        slack = STATE * max(1.0, true.condition) * max(1.0, tau)
        for a, b in zip(end, true.state, strict=True):
            assert abs(a - float(b)) <= slack * sizes(ball, *end), start


@pytest.mark.parametrize("ball", BALLS, ids=str)
def test_area_is_kept(ball):
    """In (x, v, w) the chart's determinant 1 at fixed energy becomes (v + w)/(v' + w')."""
    state = states(ball, 3000)
    _, v, w, _ = ball.impact(*state)
    j = ball.jacobian(*state)
    scale = np.prod(np.linalg.norm(j, axis=-1), axis=-1)  # of the determinant's rounding errors
    ratio = (v + w) / (state[1] + state[2])
    assert np.max(np.abs(np.linalg.det(j) * ratio - 1.0) / (scale * ratio)) < DETERMINANT


@pytest.mark.parametrize("ball", BALLS[:4], ids=str)
def test_jacobian_against_the_reference_solver(ball):
    for state in zip(*states(ball, 12), strict=True):
        exact = np.array(exact_jacobian(ball.k, ball.g, *state), dtype=float)
        found = ball.jacobian(*state)
        speed = sum(ball.impact(*state)[1:3])
        slack = 1.0 + sizes(ball, *state) / speed
        assert np.abs(found - exact).max() <= JACOBIAN * slack * spread(exact), state


@pytest.mark.parametrize("s", [1e-12, 1e-6])
@pytest.mark.parametrize("share", [-0.9, 0.0, 2.0])
def test_jacobian_of_tiny_flights(share, s):
    """For x > -g a grazing flight is tiny, and no entry may suffer cancellation."""
    state = (share * BALL.g, 0.1, s - 0.1)
    exact = np.array(exact_jacobian(BALL.k, BALL.g, *state, step=s * 1e-20), dtype=float)
    assert np.allclose(BALL.jacobian(*state), exact, rtol=1e-14, atol=1e-14)


@pytest.mark.parametrize("ball", BALLS, ids=str)
def test_inverse(ball):
    """F^-1 F = F F^-1 = identity, to roundings times their growth on the way back."""
    state = states(ball, 3000)
    size = sizes(ball, *state)
    calls = ball.impact, ball.inverse_impact
    for there, back in (calls, calls[::-1]):
        *middle, tau = there(*state)
        *again, tau_again = back(*middle)
        # The way back stretches errors by the inverse of the Jacobian of the way there.
        forward = there == ball.impact
        j = ball.jacobian(*(state if forward else middle))
        stretch = spread(np.linalg.inv(j) if forward else j)
        speed = np.minimum(state[1] + state[2], middle[1] + middle[2])
        slack = INVERSE * stretch * (1.0 + tau) * (1.0 + size / speed)
        for a, b in zip(again, state, strict=True):
            assert np.all(np.abs(a - b) <= slack * size)
        assert np.all(np.abs(tau_again - tau) <= slack * (1.0 + tau))


# Squares of such lengths overflow or underflow; the march once did not end.
@example(-1000, 0.2, 0.04, -0.05, 0.1, 0.3)
@example(-700, 0.2, 0.04, -0.05, 0.1, 0.3)
@example(700, 0.2, 0.04, -0.05, 0.1, 0.3)
@example(1000, 0.2, 0.04, -0.05, 0.1, 0.3)
@settings(deadline=None)
@given(
    st.integers(-60, 60), st.floats(0.01, 1.0), st.floats(1e-4, 1.0),
    *[st.floats(-2.0, 2.0, allow_subnormal=False)] * 3,
)  # fmt: skip
def test_scaling_by_a_power_of_two(power, k, g, x, v, w):
    """(x, v, w, g) -> L (x, v, w, g) keeps every bit of tau."""
    assume(not any(0 < abs(a) < 1e-30 for a in (x, v, w, v + w)))
    v, w = (v, w) if v + w >= 0 else (-v, -w)
    scale = 2.0**power
    one, two = ball_of(k, g), ball_of(k, g * scale)
    *state, tau = one.impact(x, v, w)
    *scaled, tau_scaled = two.impact(x * scale, v * scale, w * scale)
    assert tau == tau_scaled and scaled == [a * scale for a in state]
    assert np.array_equal(
        one.jacobian(x, v, w), two.jacobian(x * scale, v * scale, w * scale), equal_nan=True
    )


def test_a_march_has_few_evaluations():
    """Even flights of thousands of vibrations take few evaluations."""
    evaluations = []
    for g in (1e-4, 1e-2, 1.0):
        rng = np.random.default_rng(10)
        for x, b, c in rng.uniform(-1.0, 1.0, (4000, 3)):
            if b + c < 0:
                evaluations.append(flight.first_impact(x, b, c, -(b + c), g)[3])
    assert np.mean(evaluations) < 3.5 and max(evaluations) < 60


GRAZING = [  # k, g, x, v, w of states after which v + w rounds below 0
    (0.2, 0.04, 0.155648106167019, -0.023445528561517902, 0.5923544812922338),
    (0.2, 0.04, 0.18964814879470163, -0.11182542919889939, 0.3291613738069797),
]


@pytest.mark.parametrize(("k", "g", "x", "v", "w"), GRAZING)
def test_an_impact_that_grazes_stays_on_the_section(k, g, x, v, w):
    for many in (1, 16):  # one after the other, and together
        _, v_next, w_next, _ = Ball(k, g).after([np.full(many, a) for a in (x, v, w)])
        assert np.all(v_next + w_next == 0.0)
