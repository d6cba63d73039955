"""Time to the next impact against a proved first root.

The states are families of hard ones, flights near grazing, flights that touch the floor, and
corners of k, g and E. A reference solver proves which root is the first; another root counts as an
infinite error. Errors of tau are relative, in units of its condition, which is 1/|f'(tau)| near a
double root.
"""

import hashlib
import math
import os
import sys

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from helpers.flights import FAMILIES, TAU, draw, error
from helpers.independent_solver import judge
from helpers.programs import run
from helpers.sections import BALL, ball_of
from helpers.slowly import slowly
from pseudorigid.dynamics.ball import Ball

# sha256 of the times in test_frozen_bits_of_many_flights
FROZEN = "17974d2c018124caaa0b355ed33a3819b44222e6f11b4825fe09d60f1405d4c0"


@pytest.mark.parametrize(
    ("seed", "count"), [(1, 400), *slowly(*((seed, 1250) for seed in range(100, 114)))]
)
@pytest.mark.parametrize("family", FAMILIES)
def test_tau_against_the_proved_root(family, seed, count):
    worst, state = max((error(state), state) for state in draw(family, seed, count))
    assert worst <= TAU, state


def test_frozen_bits_of_many_flights():
    """Times at 12,000 states of three balls have the same bits on every machine."""
    rng = np.random.default_rng(20)
    x, v, w = rng.random((3, 12_000)) - 0.5
    v, w = np.where(v + w < 0, -v, v), np.where(v + w < 0, -w, w)
    tau = np.concatenate([ball_of(0.2, g).time_to_impact(x, v, w) for g in (2.0**-12, 0.04, 0.9)])
    digest = hashlib.sha256(tau.astype("<f8").tobytes()).hexdigest()
    assert digest == FROZEN


def test_caps_raise():
    """With the cap at one evaluation flights end in an error, with the real cap in an impact."""
    states = (-0.22, -0.01, 0.48), (0.01, 0.45, -0.36)
    assert all(BALL.time_to_impact(*state) > 0.0 for state in states)
    code = (
        "from pseudorigid import Ball\nfrom pseudorigid.kernel import flight\n"
        f"flight.MOST_EVALUATIONS = 1\nfor state in {states}:\n"
        "    try: print(Ball(0.2, 0.04).impact(*state))\n"
        "    except ArithmeticError as e: print(e)\n"
    )
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(sys.path), "NUMBA_DISABLE_JIT": "1"}
    result = run(sys.executable, "-c", code, env=environment)
    words = [line.split()[1] for line in result.stdout.splitlines()]
    assert words == ["march", "landing"], result.stdout + result.stderr


def grazing(decade, g):
    """Yield states with v + w = 1e-decade, as small velocities or as a difference, about x = -g."""
    s = float(f"1e-{decade}")
    at_minus_g = math.nextafter(-g, 0.0), -g, math.nextafter(-g, -1.0)
    for x in (0.5 * g, 0.0, *at_minus_g, -1.5 * g, -9.0 * g):
        for v in (0.0, s, -0.7 * s, 0.3, -1e-3):
            if v + (s - v) > 0.0:
                yield 0.2, g, x, v, s - v


# From 1e-140 on squares and cubes of v + w leave the range of doubles. That once led to tau = -inf
# (g = 1e-4, x = w = 0, v = 0x1.e7c5f127bd87ep-466), a tau too small at x = -g, and an endless
# landing.
@pytest.mark.parametrize("g", [1e-4, 0.04, 1.0])
@pytest.mark.parametrize(
    "decade", [*range(1, 17, 3), 20, 40, 140, 300, *slowly(2, 8, 14, 100, 200)]
)
def test_towards_grazing(decade, g):
    """There, where squares of v + w decide at x = -g, an error of tau below 1e-40 is allowed."""
    for state in grazing(decade, g):
        off = error(state)
        if off > TAU and decade >= 140 and state[2] == -g:
            tau = ball_of(0.2, g).time_to_impact(*state[2:])
            off = abs(tau - float(judge(*state).tau)) / 1e-40 * TAU
        assert off <= TAU, [a.hex() for a in state]


@pytest.mark.parametrize("ball", [BALL, Ball(1 / 3, 1e-3), Ball(1.0, 1e-4), Ball(0.01, 0.009)])
@pytest.mark.parametrize("off", [1e-15, 1e-6])
def test_energies_at_both_bounds(ball, off):
    """Cover energies close to rest on the floor, and to eq. (31)."""
    low, high = ball.energy_bounds()
    for energy in (low + off * abs(low), high - off * abs(high)):
        for fraction in (-0.999999, -0.5, 0.0, 0.5, 0.999999):
            state = ball.start(fraction, energy)
            if state[1] + state[2] > 0.0:
                assert error((ball.k, ball.g, *state)) <= TAU, [a.hex() for a in state]
    assert ball.impact(ball.g / ball.k, 0.0, 0.0) == (ball.g / ball.k, 0.0, 0.0, 0.0)


@pytest.mark.parametrize("unit", [5e-324, 1e-320, 1e-312, 2.3e-308])
def test_subnormal_states(unit):
    """The error of subnormal impacts is that of some units of 5e-324 in b and c."""
    for x, v, w in ((3, 5, 7), (-4, 2, 9), (0, 1, 0), (100, -30, 31), (-200, 60, 60)):
        state = (x * unit, v * unit, w * unit)
        true = float(judge(0.2, 0.04, *state).tau)
        assert abs(BALL.time_to_impact(*state) - true) <= 1e-14 * true + 200 * 5e-324, state
        # With an equally small gravity nothing is small in comparison.
        tau = Ball(0.2, 8 * unit).time_to_impact(*state)
        assert 0.0 < tau < 1e3


def signed(low, high):
    """Return a strategy for 0 and floats of either sign with uniformly distributed logarithms."""
    sizes = st.floats(low, high).map(lambda a: 10.0**a)
    return st.one_of(sizes, sizes.map(lambda a: -a), st.just(0.0))


@settings(max_examples=400, deadline=None)
@given(
    st.floats(-12, 0) | st.just(-323.3), st.floats(-6, 2), signed(-9, 3), signed(-9, 3),
    signed(-9, 3), st.booleans(),
)  # fmt: skip
@example(-2.0, -4.0, -1.0, 1.0, -1.0, True)
def test_any_state_of_any_ball(k, g, x, v, w, near):
    """Cover k from 1e-12 to 1, and 5e-324, g from 1e-6 to 100, lengths to 1000 g, x near -g."""
    k, g = 10.0**k, 10.0**g
    x, v, w = x * g, v * g, w * g
    x = -g + 1e-6 * x if near else x
    v, w = (v, w) if v + w >= 0.0 else (-v, -w)
    state = (k, g, x, v, w)
    assert error(state) <= TAU, [a.hex() for a in state]
