"""Energies of events along families are right to 12 digits, against computations in 60 digits."""

import pytest
from mpmath import mp, mpf

from extensions.families.continuation.curve import solve_at
from extensions.families.continuation.half_orbit import ENERGY, FIX_R
from extensions.families.continuation.search import Search
from extensions.families.continuation.symmetric import Parameter, SymmetricOrbits
from helpers.exact_orbits import after, apex, at_rest, derivative, on_section
from helpers.parts.family_search import (
    PAPER,
    energy_of,
    rho,
    searched,
    six_born_at,
    up_to_period_six,
)

K, G = mpf("0.2"), mpf("0.04")


def fixed_energy(trace):
    """Energy of the fixed point with a trace, from the closed form (design, g = 1)."""

    def terms(theta):
        return 1 - theta * mp.cot(theta), 2 * theta - mp.sin(2 * theta)

    def excess(theta):
        c, rest = terms(theta)
        shear = c * rest / (theta * (1 + K))
        return 2 * (1 + K * (mp.cos(2 * theta) - shear)) / (1 + K) - trace

    theta = mp.findroot(excess, (mpf("0.7"), mpf("1.9")), solver="anderson")
    return G * G * ((1 + K) * theta**2 + terms(theta)[0] ** 2 - 1) / (2 * K)


def test_resonances_of_the_fixed_point_are_right_to_12_digits():
    """Against the closed form in 60 digits; the search does not use it."""
    found = Search(Parameter(ENERGY, 0.2, rho(PAPER, -0.003), rho(PAPER, 0.0599)), 8)
    system = SymmetricOrbits(FIX_R, 1, found.parameter)
    found.add(system, solve_at(system, (-0.25, rho(PAPER, 0.01)), 0.1))
    energies = {
        event.order: energy_of(found, event.point.p)
        for event in found.families[0].events
        if (event.kind, event.turns) == ("resonance", 1)
    }
    with mp.workdps(60):
        for order in (4, 5, 6, 7, 8):
            exact = fixed_energy(2 * mp.cos(2 * mp.pi / order))
            assert abs(energies[order] / exact - 1) < mpf("1e-12"), order


def test_the_births_of_the_three_period_six_orbits_are_right_to_12_digits():
    six = up_to_period_six()
    with mp.workdps(60):
        exact = fixed_energy(mpf(1))
        for line in (0, 1):
            family = six_born_at(six, line, "resonance")
            (end,) = (e for e in family.ends if e.kind == "resonance")
            assert abs(energy_of(six, end.p) / exact - 1) < mpf("1e-12")
        family = six_born_at(six, 1, "touch")
        (end,) = (e for e in family.ends if e.kind == "touch")

        def beyond(energy):
            """eta after a start at rest on the floor, which only touches it."""
            return apex(K, G, after(K, G, at_rest(K, G, energy), 3))[1]

        born = energy_of(six, end.p)
        exact = mp.findroot(beyond, (mpf(born), mpf(born) * (1 + mpf("1e-9"))), solver="secant")
        assert abs(born / exact - 1) < mpf("1e-12")


@pytest.mark.slow
def test_the_doubling_of_an_orbit_without_symmetry_is_right_to_12_digits():
    """Period 4 breaks its symmetry at E = 0.0380, and doubles its period at 0.0421."""
    found = searched(PAPER, 0.0378, 0.0424, 8, 2)
    (four,) = (f for f in found.families if f.period == 4 and f.line < 0)
    (event,) = (e for e in four.events if e.kind == "doubling")
    (child,) = (f for f in found.families if f.period == 8 and f.line < 0)
    (end,) = (e for e in child.ends if e.kind == "doubling")
    assert (end.family, end.p) == (four.number, event.point.p)
    unit, energy = PAPER.g / PAPER.k, energy_of(found, event.point.p)
    at_x, at_y, radius = event.point.place
    x = unit * (1.0 + radius * at_x)
    y = unit * radius * (PAPER.k * (1.0 + PAPER.k)) ** 0.5 * at_y
    with mp.workdps(60):

        def equations(energy, x, y):
            def end(x, y):
                return on_section(K, G, energy, x, y, 4)

            (a, _), (_, d) = (derivative(end, (x, y), i) for i in (0, 1))
            last = end(x, y)
            return last[0] - x, last[1] - y, a + d + 2

        exact = mp.findroot(equations, (energy, x, y), tol=mpf(10) ** -60)[0]
        assert abs(energy / exact - 1) < mpf("1e-12")
