"""Proved flights and orbits against an independent solver of sixty digits."""

import mpmath
import pytest
from flights import FAMILIES, TAU, by_mpmath, draw
from independent_solver import exact_map, judge
from mpmath import mpf
from sections import BALL

from pseudorigid.dynamics.ball import Ball
from pseudorigid.verified.reference_solver import first_root, orbit


@pytest.mark.slow
@pytest.mark.parametrize("family", FAMILIES)
def test_both_reference_solvers_agree(family):
    """Two methods that find the first root independently agree to 40 digits."""
    decided = 0
    for state in draw(family, 2, 500):
        true = judge(*state)
        tau = Ball(*state[:2]).time_to_impact(*state[2:])
        assert by_mpmath(tau, true) <= TAU, state
        try:
            root = first_root(*state)
        except ArithmeticError:
            assert true.depth < 1e-15 or true.slope == 0, state
            continue
        decided += 1
        with mpmath.workdps(60):
            mantissa, exponent = root.mid().man_exp()
            off = abs(mpmath.ldexp(mpf(int(mantissa)), int(exponent)) - true.tau)
            spare = true.tau * max(1, true.condition) if true.tau else 0
            assert off <= spare * mpf(10) ** -40, state
    assert decided > 490


def test_the_proved_orbit_is_that_of_sixty_digits():
    state = BALL.start(0.534522, 0.01)
    exact = [mpf(float(a)) for a in state]
    for row in orbit(BALL, state, 40):
        *exact, _ = exact_map(mpf(BALL.k), mpf(BALL.g), *exact)
        assert max(abs(a - float(b)) for a, b in zip(row, exact, strict=True)) < 1e-16


def test_a_ball_pressed_onto_the_floor_stays_there():
    assert first_root(0.2, 0.04, 0.1, 0.05, -0.05) == 0
