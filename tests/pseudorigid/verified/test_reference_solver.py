"""Proved flights and orbits against an independent solver of sixty digits."""

import mpmath
import pytest
from flint import arb, ctx
from mpmath import mpf

from helpers.flights import FAMILIES, TAU, by_mpmath, draw
from helpers.independent_solver import exact_map, judge
from helpers.sections import BALL, ball_of
from pseudorigid.verified import reference_solver
from pseudorigid.verified.flight import UndecidedError
from pseudorigid.verified.reference_solver import first_root, orbit


@pytest.mark.slow
@pytest.mark.parametrize("family", FAMILIES)
def test_both_reference_solvers_agree(family):
    """Two methods that find the first root independently agree to 40 digits."""
    decided = 0
    for state in draw(family, 2, 500):
        true = judge(*state)
        tau = ball_of(*state[:2]).time_to_impact(*state[2:])
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


@pytest.mark.parametrize(("x", "v", "w", "stays"), [
    (0.1, 0.05, -0.05, True), (-0.25, 0.1, -0.1, True), (-0.25, 0.0, 0.0, True),
    (-0.25, -0.1, 0.1, False), (-0.5, 0.1, -0.1, False), (-0.5, 0.0, 0.0, False),
    (0.1, 0.05, -0.04, False), (-0.25, 0.1, -0.05, False),
])  # fmt: skip
def test_a_ball_stays_where_it_is_pressed_onto_the_floor(x, v, w, stays):
    """s = 0 and x > -g, or x = -g with udot <= 0, all exact in doubles; g = 1/4."""
    root = first_root(0.25, 0.25, x, v, w)
    assert (root == 0) == stays
    assert stays or root.rel_accuracy_bits() >= 150
    state = reference_solver.impact(*map(arb, (0.25, 0.25, x, v, w)))
    assert (state[:3] == (x, v, w)) == stays


@pytest.mark.parametrize("failure", ["None", "UndecidedError"])
def test_bits_are_doubled_until_a_question_is_decided(failure, monkeypatch):
    used = []

    def compute(least):
        used.append(ctx.prec)
        if ctx.prec >= least:
            return arb(7)
        if failure == "None":
            return None
        raise UndecidedError("bits")

    assert reference_solver.decided(lambda: compute(400), 100) == 7 and used == [100, 200, 400]
    assert reference_solver.decided(lambda: compute(10**6), 3000) is None
    assert used[3:] == [3000, 6000]
    monkeypatch.setattr(reference_solver, "impact", lambda *_: (None, None, None, arb(1, 0.1)))
    with pytest.raises(ArithmeticError, match="cannot tell a touch from a miss"):
        first_root(0.2, 0.04, 0.1, 0.05, 0.05)
