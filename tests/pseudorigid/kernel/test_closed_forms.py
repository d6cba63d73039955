"""Closed formulas have the bits of the functions that compute with them, and are exact."""

from fractions import Fraction

import numpy as np
import pytest

from helpers.sections import BALL
from pseudorigid.dynamics import fixed_point
from pseudorigid.kernel import closed_forms, formulas
from pseudorigid.kernel.arithmetic import sincos

K, G, ENERGY = BALL.k, BALL.g, np.linspace(-0.003, 0.05, 1000)


@pytest.mark.parametrize("k", [0.02, 0.2, 1 / 3, 1.0])
def test_the_fixed_point_has_the_bits_of_the_dynamics(k):
    for theta in np.linspace(0.01, 3.1, 200).tolist():
        expected = fixed_point.energy(k, theta), fixed_point.trace_at(k, theta)
        assert closed_forms.fixed_point(k, theta, sincos) == expected


def test_energies_have_the_bits_of_a_ball():
    x, xdot, udot = np.random.default_rng(1).uniform(0.0, 0.2, (3, 1000))
    energy = closed_forms.energy(K, G, x, xdot, udot)
    assert np.array_equal(energy, BALL.energy(x, xdot, udot))
    above = closed_forms.twice_energy_above_rest(K, G, ENERGY)
    assert np.array_equal(above / K, formulas.radius_squared(K, G, ENERGY))


def test_fractions_stay_exact():
    k, g, energy = Fraction("0.2"), Fraction("0.04"), Fraction("0.01")
    assert closed_forms.twice_energy_above_rest(k, g, energy) == Fraction("0.028")
    assert closed_forms.energy_bounds(k, g) == (Fraction("-0.004"), Fraction("0.06"))
