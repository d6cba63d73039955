"""Derivations by computer algebra: of the paper's formulas, and of the formulas of the code.

Code that is plain arithmetic is called with symbols, compiled code with numbers.
"""

import numpy as np
import pytest
import sympy as sp

from extensions.proofs.derivations import forms, impacts, model, symbols
from extensions.proofs.derivations.symbols import b, c, energy, flight, g, k, rebound, tau, v, w, x
from helpers.sections import BALL
from pseudorigid import Ball, orbit
from pseudorigid.dynamics import fixed_point

# Printed formulas that do not hold; each has a correction that does.
MISPRINTED = {
    "euler_tensor",  # (4): a third is missing
    "modes",  # section 2.1: two are excited, not three
    "shell",  # (5): a shell has k = 1/3
    "impulsive_forces",  # (9): a delta
    "scaled_impulse",  # (24): m omega R
    "impact_map",  # (28): a sign
    "energy_bound",  # (31): needs g < k
    "contact_speed",  # (8), (22): not negative; a grazing impact has none
    "exponents",  # (32): 1/i
}
NOT_PRINTED = {"softness", "smooth", "reversible"}


def test_the_misprints_are_found_and_no_others(derived):
    names = derived["formula"].values.tolist()
    assert len(names) == len(set(names)) == 27
    for name in names:
        row = derived.sel(formula=name)
        expected = (0, 1) if name in MISPRINTED else (-1, 1) if name in NOT_PRINTED else (1, -1)
        assert (row["printed"], row["corrected"]) == expected, name


def test_numbers_that_come_with_formulas(derived):
    value = derived["value"].to_series()
    assert value["euler_tensor"] == 0.2  # a solid sphere
    assert value["shell"] == pytest.approx(1 / 3, rel=1e-15) and value["modes"] == 2.0
    assert value["softness"] == 5.0  # Young's modulus is 5 rho g R
    assert value["energy_bound"] == pytest.approx(BALL.energy_bounds()[1], abs=1e-16)
    assert value["smooth"] == pytest.approx(0.00176, rel=1e-14)


# ---- a derivation can fail


@pytest.mark.parametrize("strain", [c * sp.cos(tau) - x * sp.sin(tau),
                                    x * sp.cos(tau) - c * sp.sin(tau)])  # fmt: skip
def test_a_wrong_flight_is_noticed(monkeypatch, strain):
    wrong = sp.Lambda((x, b, c, tau), (x + b * tau + g * tau**2 / 2, strain))
    monkeypatch.setattr(impacts, "flight", wrong)
    assert not impacts.flights().printed and not impacts.impact_map().corrected


def test_a_wrong_impact_law_action_or_energy_is_noticed(monkeypatch):
    monkeypatch.setattr(model, "rebound", lambda v, w: (rebound(v, w)[0], -rebound(v, w)[1]))
    assert not model.jump_conditions().printed
    stiffness = model._stiffness
    monkeypatch.setattr(model, "_stiffness", lambda young, nu: (2 * stiffness(young, nu)[0], 0))
    assert not model.momentum_balances().printed
    monkeypatch.setattr(forms, "action", lambda x, b, c, t: symbols.action(x, b, c, t) + x * t)
    assert not forms.area().printed
    monkeypatch.setattr(impacts, "energy", lambda x, v, w: symbols.energy(x, v, w) + v * w)
    assert not impacts.conserved_energy().printed and not impacts.bound_in_flight().printed


# ---- formulas of the code


def test_jacobian_of_the_code():
    matrix = forms.jacobian_matrix()
    for point in ((0.31, 0.02), (0.0, -0.05), (0.45, 0.1)):
        state = BALL.state_xy(*point, 0.01)
        values = dict(zip((x, v, w), state, strict=True)) | {k: BALL.k, g: BALL.g}
        values |= {tau: BALL.time_to_impact(*state)}
        expected = np.array(matrix.subs(values).evalf(), dtype=float)
        np.testing.assert_allclose(BALL.jacobian(*state), expected, rtol=1e-10, atol=1e-10)


def test_energy_of_the_code():
    values = {x: 0.2, v: -0.1, w: 0.5, k: 0.3, g: 0.07}
    expected = float(energy(x, v, w).subs(values))
    assert Ball(0.3, 0.07).energy(0.2, -0.1, 0.5) == pytest.approx(expected, rel=1e-15)


def test_map_28_has_many_solutions_and_the_code_takes_the_smallest():
    gap = sp.lambdify((x, v, w, k, g, tau), sum(flight(x, *rebound(v, w), tau)), "numpy")
    times = np.linspace(1e-3, 12.0, 12_000)
    path = orbit(BALL, BALL.state_xy(0.4, 0.0, 0.01), 200)
    most = 0
    for state in zip(*(path[name].values for name in ("x", "xdot", "udot")), strict=True):
        heights = gap(*state, BALL.k, BALL.g, times)
        roots = times[1:][heights[1:] * heights[:-1] < 0.0]
        first = BALL.time_to_impact(*state)
        if first > times[1]:
            assert abs(roots[0] - first) < 2e-3
        most = max(most, roots.size)  # every root solves (28), which omits the time of flight
    assert most > 1


def test_fixed_point_in_closed_form():
    theta = sp.symbols("theta", positive=True)
    speed, rate = g * theta, g * theta / k
    start = rate * sp.cot(theta)
    b, c = rebound(speed, rate)
    position, strain = flight(start, b, c, 2 * theta)
    assert symbols.zero((b + 2 * g * theta) - speed)
    assert symbols.zero((position - start).rewrite(sp.sin))
    assert sp.simplify((strain + start).rewrite(sp.tan)) == 0
    whole = energy(start, speed, rate) / g**2
    for value in (0.4, 1.1, 1.5002, 2.3):
        for inertia in (0.1, 0.2, 1.0 / 3.0):
            expected = float(whole.subs({theta: value, k: inertia}))
            assert fixed_point.energy(inertia, value) == pytest.approx(expected, rel=1e-13)


def test_trace_of_the_fixed_point():
    matrix = forms.jacobian_matrix()
    for inertia, theta in ((0.2, 1.5002), (0.3, 0.7), (0.1, 2.2)):
        values = {k: sp.Float(inertia, 40), g: sp.Float(1, 40), tau: sp.Float(2 * theta, 40)}
        half = values[tau] / 2
        values |= {v: half, w: half / values[k], x: half / sp.tan(half) / values[k]}
        trace = float(matrix.subs(values).evalf(30).trace()) - 1.0
        assert fixed_point.trace_at(inertia, theta) == pytest.approx(trace, rel=1e-12)
