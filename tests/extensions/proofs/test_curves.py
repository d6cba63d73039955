"""Invariant curves: what their checkers prove, and the certificates that they refuse."""

import re
from functools import cache
from math import pi, sqrt

import numpy as np
import pytest
from flint import arb, ctx
from matplotlib.path import Path

from extensions.claims.analyses.polygon import Polygon
from extensions.proofs import THEOREMS, prove_curve
from extensions.proofs.checkers import curve
from extensions.proofs.search import curve as search
from helpers.parts.small_curve import SMALL
from helpers.sections import BALL
from helpers.slowly import slowly
from pseudorigid import Ball, orbit
from pseudorigid.dynamics.variables import chart, states_of

CURVES = [name for name, theorem in THEOREMS.items() if theorem.checker is curve.check]


@cache
def bounds_and_finding(name):
    """The bounds of a theorem about a curve, and the finding of its checker."""
    theorem = SMALL if name == SMALL.name else THEOREMS[name]
    return theorem.bounds, theorem.prove()


def start_of(finding):
    """The x of the curve's point with t = 0, which is on y = 0."""
    waves = finding.parts["curve"][0]
    with ctx.workprec(200):
        return float(sum((2 * c.real for c in waves[1:]), waves[0].real))


def returns(bounds, x, count):
    """The returns (2, count) to one island of the orbit that starts at x on y = 0, in doubles."""
    period = bounds["period"]
    with ctx.workprec(64):
        state = (x, *(float(a) for a in bounds["surface"].velocities(arb(x), arb(0))))
    return chart(0.2, *states_of(orbit(BALL, state, count * period)))[:, period - 1 :: period]


def test_orbits_next_to_a_curve_have_its_rotation_number():
    """An independent computation in doubles, at the point of the curve with t = 0."""
    bounds, finding = bounds_and_finding(SMALL.name)
    points = [[float(a) for a in z] for z in finding.parts["orbit"].points]
    turns = search.turns(bounds["surface"], start_of(finding), points, 20_000)
    assert turns == pytest.approx(float(finding.digits["rotation number"]), abs=1e-9)


def test_the_area_is_a_little_more_than_that_of_the_polygon():
    """Orbits on both sides of the polygon are those of another test."""
    bounds, finding = bounds_and_finding(SMALL.name)
    area = float(finding.digits["area"])
    k, g, energy = 0.2, 0.04, float(bounds["surface"].energy)
    section = pi * (2 * energy + g * g / k) * sqrt((1 + k) / k)
    assert float(finding.digits["share"]) == pytest.approx(area / section, rel=1e-12)
    polygons = finding.parts["polygons"]
    assert len(polygons) == bounds["period"]
    assert 0.99 * area < Polygon(np.array(polygons[0]).T).area() < area


@pytest.mark.parametrize("name", [SMALL.name, *slowly(*CURVES)])
def test_an_orbit_just_inside_stays_inside_and_one_just_outside_stays_outside(name):
    bounds, finding = bounds_and_finding(name)
    centre = np.array([float(a) for a in finding.parts["orbit"].points[0]])
    polygon = np.array(finding.parts["polygons"][0])
    start = polygon[0] - centre  # on y = 0 up to rounding
    for factor, inside in ((0.99, True), (1.01, False)):
        z = returns(bounds, float(centre[0] + factor * start[0]), 5_000)
        assert Path(polygon).contains_points(z.T).tolist() == [inside] * z.shape[1]


@pytest.mark.slow
def test_the_curve_of_the_docstring_is_proved_and_within_the_bounds_of_the_energy():
    page = " ".join(prove_curve.__doc__.split())
    of, encloses = r"At k = (\S+), g = (\S+) and E = (\S+) ", r"the curve .* (\S+) encloses (\S+) "
    k, g, energy, rotation, share = map(float, re.search(of + encloses, page).groups())
    ball = Ball(k, g)
    low, high = ball.energy_bounds()
    assert low < energy < high
    certificate, finding = prove_curve(ball, energy, rotation)
    assert float(finding.digits["rotation number"]) == pytest.approx(rotation, abs=5e-4)
    assert share < float(finding.digits["share"]) < share + 1e-4
    assert 'kind = "invariant curve"' in certificate


@pytest.mark.slow
def test_a_curve_whose_coefficients_fall_slower_than_they_begin_gets_more_modes():
    """A resonance with 1/6 shows in the coefficients only below the noise of doubles."""
    assert float(prove_curve(BALL, 0.01, 0.171)[1].digits["share"]) > 0.14


@pytest.mark.parametrize(("energy", "rotation", "reason"), [
    (0.01, 0.25, "0.25 is too close to a fraction of small integers: the nearest that are not"),
    (0.01, 0.0, "rotation_number = 0.0 is not allowed: one number between 0 and 1"),
    (0.01, [0.1, 0.2], "rotation_number = [0.1, 0.2] is not allowed"),
    (float("nan"), 0.17, "energy = nan is not allowed: a finite number"),
    ("x", 0.17, "energy = 'x' is not an exact number"),
    (-1.0, 0.17, "energy = -1 is not allowed: above -0.004"),
    (5.0, 0.17, "energy = 5.0 is not allowed: a number below k/2 - g = 0.06"),
    *slowly(
        (0.01, 0.1301, "no curve with the rotation number 0.130118 was found on y = 0; nearest s"),
        # in the sea, in islands, and above the fixed point's number
        *((0.01, number, "was found on y = 0; nearest smooth curves found: 0.1")
          for number in (0.0201, 0.1612, 0.1675, 0.1789, 0.41, 0.9201)),
        *((0.001, number, "was found on y = 0; nearest smooth curves found: 0.")
          for number in (0.0503, 0.0909, 0.1001, 0.1221, 0.3105)),
        (0.01, 0.1688, "found, but it is too rough: it has more than 130 Fourier modes; nearest"),
    ),
])  # fmt: skip
def test_a_curve_that_cannot_be_proved_is_refused_in_one_line(energy, rotation, reason):
    with pytest.raises(ValueError, match=re.escape(reason)) as error:
        prove_curve(BALL, energy, rotation)
    assert "\n" not in str(error.value)


def test_a_curve_around_no_elliptic_point_is_refused():
    with pytest.raises(ValueError, match="no elliptic orbit of period 1") as error:
        prove_curve(Ball(0.2, 0.01), 0.08, 0.17)
    assert "\n" not in str(error.value)
