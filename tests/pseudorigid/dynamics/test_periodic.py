"""Periodic orbits: closure, prime periods, symmetry, stability, digits and completeness.

Fixed points are those of the closed form in 40 digits, and brute force over the whole section finds
no symmetric orbit that the search misses.
"""

import math

import mpmath
import numpy as np
import pytest
from mpmath import mpf

from helpers.cycles import NAMES, PERIODS, SETTINGS, check, compare_with_brute_force
from helpers.independent_solver import judge
from helpers.sections import BALL
from helpers.slowly import slowly
from pseudorigid import Ball, symmetric_orbits
from pseudorigid.dynamics import fixed_point, periodic
from pseudorigid.dynamics.periodic import _sign_changes
from pseudorigid.dynamics.variables import of_type


@pytest.mark.parametrize(
    ("k", "g", "energy"),
    [*SETTINGS[::7], *slowly(*(one for i, one in enumerate(SETTINGS) if i % 7))],
)
def test_orbits_of_periods_to_twelve(k, g, energy):
    ball = Ball(k, g)
    for period in PERIODS:
        orbits = symmetric_orbits(ball, energy, period)
        check(ball, energy, period, orbits)
        assert orbits.attrs["unsolved"] == 0, period


@pytest.mark.parametrize(("k", "g", "energy", "period", "trace"), [
    (0.33, 0.1, 0.06, 5, -204.586359),
    (1.0, 0.1, 0.05, 4, -3181.3),
    (0.2, 0.02, 0.03, 12, -2529.7),
    (0.8381357920683287, 0.1085487373774775, 0.024725646514105436, 7, -54.6626),
])  # fmt: skip
def test_orbits_that_are_hard_to_close_are_found(k, g, energy, period, trace):
    orbits = symmetric_orbits(Ball(k, g), energy, period)
    assert np.min(np.abs(orbits["trace"].values / trace - 1)) < 1e-4


def test_of_type_returns_one_orbit_or_names_the_available_types():
    orbits = symmetric_orbits(BALL, 0.01, 7)
    assert of_type(orbits, "hyperbolic").sizes == {"point": 7}
    for period, found in ((7, "inverse hyperbolic"), (2, "none at all")):
        with pytest.raises(ValueError, match=rf"no elliptic orbit of period {period}.*{found}"):
            of_type(symmetric_orbits(BALL, 0.01, period), "elliptic")


def test_orbits_on_a_chain_alternate_in_type_although_their_traces_are_2_to_rounding():
    """Resonances of high order split curves by less than a rounding; 2 - trace is +-2.4e-17."""
    orbits = symmetric_orbits(BALL, 0.001, 25)
    on_chain = np.abs(orbits["trace"].values - 2.0) < 1e-12
    assert orbits["type"].values[on_chain].tolist() == ["elliptic", "hyperbolic"]
    assert orbits.attrs["unsolved"] == 0


def fixed_points(k, g, energy):
    """Return (theta, x, v, w) of all fixed points, by the closed form of `dynamics.fixed_point`.

    Roots theta beyond pi count only if the flight does not touch the floor earlier.
    """
    big = mpf(energy) * 2 * mpf(k) / mpf(g) ** 2 + 1

    def excess(theta):
        return (1 + mpf(k)) * theta**2 + (1 - theta * mpmath.cot(theta)) ** 2 - big

    found = []
    last = float(mpmath.sqrt(big / (1 + k)))
    # Nodes are dense near both ends, where cot is infinite.
    share = (1 - np.cos(np.pi * (np.arange(4000) + 1 / 3) / 4000)) / 2
    for branch in range(int(last / np.pi) + 1):
        theta = np.pi * (branch + share)
        q = theta / np.tan(np.pi * share)
        values = (1 + k) * theta**2 + (1 - q) ** 2 - float(big)
        for j in np.nonzero(values[:-1] * values[1:] <= 0)[0]:
            theta0 = mpmath.findroot(
                excess, theta[j : j + 2].tolist(), solver="anderson", tol=1e-50
            )
            v, w = g * theta0, g * theta0 / mpf(k)
            x = w * mpmath.cot(theta0)
            if abs(judge(k, g, x, v, w).tau - 2 * theta0) < 1e-6:
                found.append((theta0, x, v, w))
    return found


FIXED = [
    *SETTINGS, (0.2, 0.004, 0.05), (0.2, 0.001, 0.09), (0.5, 0.01, 0.2), (1.0, 0.02, 0.4),
    (0.03, 0.0005, 0.01), (0.2, 0.04, -0.004 + 1e-9), *slowly((0.2, 3e-5, 0.09)),
]  # fmt: skip


@pytest.mark.parametrize(("k", "g", "energy"), FIXED)
def test_fixed_points_against_the_closed_form(k, g, energy):
    ball = Ball(k, g)
    lowest, _ = ball.energy_bounds()
    radius = ball.section(energy)[1]
    # Effect on the points of a rounding of the terms of E
    limit = 1e-15 * (1 + abs(lowest) / (energy - lowest))
    with mpmath.workdps(40):
        expected = sorted(fixed_points(k, g, energy))
        found = symmetric_orbits(ball, energy, 1)
        assert found.sizes["orbit"] == len(expected)
        order = np.argsort(found["tau"].values[:, 0])
        for i, (theta, *state) in zip(order, expected, strict=True):
            stretch = max(1.0, abs(float(found["multiplier"][i])))
            assert abs(float(found["tau"][i, 0]) / 2 - theta) < limit * stretch * theta
            for name, value in zip(NAMES[:3], state, strict=True):
                assert abs(float(found[name][i, 0]) - value) < limit * stretch * radius


@pytest.mark.parametrize(("k", "g", "energy", "periods"), [
    (0.2, 0.04, 0.01, (1, 2, 6)),
    (1.0, 0.1, 0.05, (3, 9)),
    (0.03, 0.0005, 0.01, (2,)),
    *slowly(*((*one, PERIODS) for one in SETTINGS)),
])  # fmt: skip
def test_brute_force_finds_no_orbit_that_the_search_misses(k, g, energy, periods):
    found, ball = 0, Ball(k, g)
    for period in periods:
        orbits = symmetric_orbits(ball, energy, period)
        found += compare_with_brute_force(ball, energy, orbits, symmetric=True)
    assert found > 0


@pytest.mark.parametrize("root", [0.03, 0.27, 0.46, 0.5751])
def test_a_sign_change_is_found_in_each_interval_up_to_the_ends_of_a_line(root):
    """The line lasts from 0.02 to 0.58, between two of the parameters at each end."""

    def value(parameters):
        on_line = (parameters > 0.02) & (parameters < 0.58)
        return np.where(on_line, parameters - root, np.nan)

    for parameters in (np.linspace(0.0, 1.0, 11), np.linspace(0.05, 0.55, 6)):
        low, high = _sign_changes(value, parameters)
        if parameters[0] < root < parameters[-1]:
            assert (low, high) == (pytest.approx([root]), np.nextafter(low, 1.0))
        else:
            assert low.size == high.size == 0


def test_the_symmetric_fixed_point_is_found_at_any_energy():
    """Some 1,800 fixed points lie along the line; the elliptic family's one is next to its end."""
    ball = Ball(0.2, 3e-5)
    orbits = symmetric_orbits(ball, 0.09, 1)
    x, trace, _ = fixed_point.numbers(ball.k, 0.09 / ball.g**2)
    nearest = int(np.argmin(np.abs(orbits["tau"].values[:, 0] - 2.0 * math.pi)))
    assert 0.0 < float(orbits["tau"][nearest, 0]) < 2.0 * math.pi
    assert abs(float(orbits["x"][nearest, 0]) / (ball.g * x) - 1.0) < 1e-9
    assert abs(float(orbits["trace"][nearest]) / trace - 1.0) < 1e-6
    assert orbits.attrs["unsolved"] == 0 and orbits.attrs["line_points_seen"] == 1.0


def test_the_search_counts_both_points_of_an_orbit_on_symmetry_lines(monkeypatch):
    for period in (1, 2, 5, 6, 7):
        assert symmetric_orbits(BALL, 0.01, period).attrs["line_points_seen"] == 1.0
    monkeypatch.setattr(periodic, "HALVINGS", 0)
    monkeypatch.setattr(periodic, "RESOLUTION", 60)
    orbits = symmetric_orbits(Ball(1 / 3, 0.02), 0.02, 6)
    assert orbits.sizes["orbit"] < 11 and orbits.attrs["line_points_seen"] < 0.9


def test_stretched_lines_are_searched_in_finer_cells(monkeypatch):
    """An orbit of period 3 at E/g^2 = 2,500 lies between equal cells, which see 81."""
    found = symmetric_orbits(Ball(0.2, 0.002), 0.01, 3)
    monkeypatch.setattr(periodic, "HALVINGS", 0)
    equal = symmetric_orbits(Ball(0.2, 0.002), 0.01, 3)
    bits = [{orbit.tobytes() for orbit in data["x"].values} for data in (found, equal)]
    assert found.sizes["orbit"] == 82 and bits[1] <= bits[0]
    assert equal.attrs["line_points_seen"] < found.attrs["line_points_seen"]
