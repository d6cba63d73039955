"""Lobes and flux by actions, by polygons and by counting, and angles of the traced branches."""

import numpy as np
import pytest
from flint import arb, ctx
from mpmath import mp, mpf

from extensions.claims import turnstile_flux
from extensions.claims.analyses import actions
from extensions.claims.analyses.polygon import Polygon
from extensions.proofs import Surface
from extensions.proofs.enclosure.jets import Jet
from helpers import independent_solver as judge
from helpers.sections import BALL
from pseudorigid import symmetric_orbits, trace_manifold

ENERGY = 0.01


def test_flights_in_balls_agree_with_an_independent_solver():
    with ctx.workprec(400):
        surface = Surface("0.2", "0.04", "0.01")
        x, y, action = actions.flight(surface, *Jet.plane(1, arb("0.3"), arb("0.02")))
        (a, b), (c, d) = x.coefficients[1:], y.coefficients[1:]
        area = a * d - b * c
        assert area.contains(1) and float(area.rad()) < 1e-80
        state = arb("0.3"), *surface.velocities(arb("0.3"), arb("0.02"))
        numbers = [mpf(a.mid().str(60, radius=False)) for a in state]
        exact = judge.exact_map(mpf("0.2"), mpf("0.04"), *numbers)
        for ours, wanted in ((x, exact[0]), (y, exact[1] - exact[2] / 5)):
            assert abs(mpf(ours.constant.mid().str(60, radius=False)) - wanted) < mpf(10) ** -45
        x, v, w = numbers
        jump = 2 * (v + w) / mpf("1.2")
        b, c = v - mpf("0.2") * jump, w - jump

        def squares(t):
            rate = x * mp.sin(t) + c * mp.cos(t)
            return (b + mpf("0.04") * t) ** 2 + mpf("0.2") * rate**2

        expected = mp.quad(squares, mp.linspace(0, exact[3], 8))
        assert abs(mpf(action.mid().str(50, radius=False)) - expected) < mpf(10) ** -40


def test_areas_by_action_and_by_counting_agree(flowing):
    assert np.all(flowing["area_error"] < 1e-15 * flowing["area"])
    inner, outer = (flowing.isel(side=row) for row in (0, 1))
    assert float(inner["area"]) == pytest.approx(8.789483773e-10, rel=1e-9)  # by independent code
    assert float(outer["digits"]) == pytest.approx(float(outer["area"]), rel=1e-15)
    # The area that an impact carries out of a region, and into it, counted on a grid of 400 x 400.
    centre, radius = BALL.section(ENERGY)
    high = radius * (0.2 * 1.2) ** 0.5
    middle = (2.0 * np.arange(400) + 1.0) / 400 - 1.0
    across, up = (a.ravel() for a in np.meshgrid(middle, middle))
    within = across * across + up * up < 1.0
    x, y = centre + radius * across[within], high * up[within]
    image = BALL.impact(*BALL.state_xy(x, y, ENERGY))
    for lobe, error in ((inner, 1e-5), (outer, 0.05 * float(outer["area"]))):
        region = Polygon(np.array([lobe["outline_x"].values, lobe["outline_y"].values]))
        before, after = region.contains(x, y), region.contains(image[0], image[1] - 0.2 * image[2])
        for carried in (before & ~after, after & ~before):
            area = radius * high * (2.0 / 400) ** 2 * int(carried.sum())
            assert abs(area - float(lobe["area"])) < error


def test_the_flux_out_of_the_region_gives_the_area_of_the_sea(flowing):
    sea = float(flowing["area"].values[1] / flowing["sea_out"].values[1])
    share = sea / flowing.attrs["section"]
    assert share == pytest.approx(0.83, abs=0.05)  # the atlas: 0.169 of it is regular
    assert float(flowing["sea_inside"].values[0]) == 0.0


def test_angles_are_those_of_the_traced_branches(flowing):
    """The angle follows from the slope at y = 0: the stable branch is the mirror image."""
    saddle = symmetric_orbits(BALL, ENERGY, 6).isel(orbit=1)
    for row, side in ((0, "inner"), (1, "outer")):
        line = trace_manifold(
            BALL, ENERGY, saddle, int(flowing["saddle"].values[row]),
            side=side, length=1.2, distance=1e-4, bend=2.0,
        )  # fmt: skip
        x, y = line["x"].values, line["xdot"].values - 0.2 * line["udot"].values
        at = int(np.flatnonzero(y[1:] * y[:-1] < 0.0)[0])
        near = slice(at - 20, at + 21)
        slope = np.polynomial.Polynomial.fit(y[near], x[near], 3).deriv()(0.0)
        sine = 2.0 * abs(slope) / (1.0 + slope * slope)
        assert sine == pytest.approx(abs(float(flowing["sine"].values[row, 0])), rel=1e-3)
        assert x[at] == pytest.approx(float(flowing["crossing_x"].values[row, 0]), abs=1e-4)


@pytest.mark.slow
def test_the_flux_through_both_turnstiles():
    """The inner branches almost coincide; certified digits are those of CLAIMS.md."""
    outer, inner = (turnstile_flux(BALL, 0.01, 6, side) for side in ("outer", "inner"))
    assert outer["area"].item() == pytest.approx(2.310716408e-4, rel=1e-9)
    assert inner["area"].item() == pytest.approx(8.789483773e-10, rel=1e-9)
    assert outer["area_error"].item() < 1e-30


@pytest.mark.parametrize(("arguments", "words"), [
    ((BALL, "low", 6), "energy = 'low' "),
    ((BALL, -1, 6), "energy = -1.0 "),
    ((BALL, 0.01, 5), "period = 5 "),
    ((BALL, 0.01, 6, "left"), "side = 'left' "),
    ((BALL, 0.001, 2), "no hyperbolic orbit of period 2 "),
])  # fmt: skip
def test_bad_input_of_the_flux_is_one_line(arguments, words):
    with pytest.raises(ValueError) as raised:
        turnstile_flux(*arguments)
    assert str(raised.value).startswith(words) and "\n" not in str(raised.value)
