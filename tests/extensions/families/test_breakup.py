"""The breakup of the last invariant curve beyond a resonance, found without counting orbits."""

import math
from fractions import Fraction

import numpy as np
import pytest

from extensions.atlas.last_curve import OrbitSearch
from extensions.atlas.symmetry_line import regular, symmetric_fixed_point, winding
from extensions.claims.analyses.jumps import jumps
from extensions.families.breakup import breakup, neighbour, noble_residue
from helpers.slowly import slowly
from pseudorigid import Ball, orbit
from pseudorigid.dynamics.variables import states_of

BALL = Ball(0.2, 0.04)
SEVENTH, STEP = 0.005636, 2e-5  # energy at which the last curve beyond 1/7 breaks


def at(energy):
    return BALL, energy


@pytest.mark.parametrize("fraction", [(0, 1), (1, 5), (2, 9), (2, 7), (3, 11), (5, 12)])
def test_neighbours_have_smaller_denominators_and_lie_next_to_the_fraction(fraction):
    p, q = fraction
    for below in (True, False):
        r, s = neighbour(p, q, below)
        assert s <= q and (r * q < p * s) == below
        assert abs(Fraction(r, s) - Fraction(p, q)) == Fraction(1, s * q)


def test_the_last_curve_breaks_between_energies_with_and_without_one(monkeypatch):
    monkeypatch.setattr("extensions.families.breakup._HALVINGS", 4)  # to STEP
    monkeypatch.setattr("extensions.families.breakup._NOBLES", 32)
    found = breakup(at, 1, 7, 0.0055, 0.0058)
    assert found == pytest.approx(SEVENTH, abs=STEP)
    assert math.isnan(breakup(at, 1, 7, 0.0050, 0.0052))  # whole at both ends


@pytest.mark.parametrize("best", [1, 3, 37, 300])
def test_the_last_of_many_curves_that_break_one_after_the_other(monkeypatch, best):
    """Made-up residues: the n-th curve breaks the earlier, the farther n is from the best one."""

    def residue(ball, energy, turns, order, n):
        breaks = 0.6 - 0.02 * abs(math.log2(n / best))
        return 0.25 * math.exp(50.0 * (energy - breaks))

    monkeypatch.setattr("extensions.families.breakup.noble_residue", residue)
    assert breakup(at, 1, 7, 0.0, 1.0) == pytest.approx(0.6, abs=2e-5)
    assert breakup(at, 1, 7, 1.0, 0.61) == math.inf or math.isnan(breakup(at, 1, 7, 1.0, 0.61))
    assert math.isnan(breakup(at, 1, 7, 0.0, 0.59))  # whole at the end
    assert math.isnan(breakup(at, 1, 7, 0.7, 0.9))  # broken at the beginning


@pytest.mark.parametrize(
    ("sizes", "largest"),
    [((0.1, 0.2), 0.2), ((0.2, -0.24), 0.24), ((-0.3, 0.1), 0.3), ((0.1, None), math.inf)],
)
def test_the_larger_residue_of_two_long_convergents_counts(monkeypatch, sizes, largest):
    asked = []

    def innermost(search, turns, period, cells):
        size = sizes[len(asked)]
        asked.append((turns, period))
        return None if size is None else (0.0, size, 0.0)

    monkeypatch.setattr(OrbitSearch, "innermost", innermost)
    assert noble_residue(BALL, 0.0055, 1, 7, 5) == largest
    # The neighbour of 1/7 below it is 0/1: the first convergents are 5/36 and 6/43.
    assert 500 <= asked[0][1] < 1300 and all(5 / 36 < p / q < 6 / 43 for p, q in asked)
    (p, q), *more = asked
    assert all(abs(p * s - q * r) == 1 for r, s in more)


@pytest.mark.parametrize("energy, some", slowly((0.01615, True), (0.0163, False)))
def test_no_regular_orbit_beyond_a_fifth_is_left_after_the_last_curve_breaks(energy, some):
    """The breakup at 1/5 lies between two energies with and without regular orbits beyond it."""
    assert 0.01615 < breakup(at, 1, 5, 0.0161, 0.0163) < 0.01621
    place, _ = symmetric_fixed_point(BALL, energy)
    turned, exponent = winding(BALL, energy, np.linspace(place, -0.999, 800), 16_000)
    assert np.any(turned[regular(exponent, 16_000)] < 0.2 - 1e-4) == some


def test_the_last_curve_beyond_a_fifth_touches_neither_rim_nor_jump():
    """An orbit of a long convergent at the breakup, whose rotation number is 0.1991."""
    energy = 0.0161797
    place, _ = symmetric_fixed_point(BALL, energy)
    search = OrbitSearch(BALL, energy, (place - 1e-3, -0.999))
    start, residue, _ = search.innermost(131, 658, 256)
    assert 0.2 < residue < 0.3
    x, v, w = states_of(orbit(BALL, BALL.start(start, energy), 658))
    k, g = BALL.k, BALL.g
    largest = math.sqrt((1.0 + k) / k * (2.0 * energy + g * g / k))
    assert np.min(v + w) / largest == pytest.approx(0.264, abs=0.001)
    _, radius = BALL.section(energy)
    high = radius * math.sqrt(k * (1.0 + k))  # of the section, in y
    curve = jumps(BALL, energy, [], 400)
    jump_x, jump_y = curve["x"].values[0], -curve["y"].values[0]
    across, up = (x[:, None] - jump_x) / radius, (v - k * w)[:, None] - jump_y
    distance = np.sqrt(across**2 + (up / high) ** 2)
    assert np.nanmin(distance) == pytest.approx(0.035, abs=0.001)
