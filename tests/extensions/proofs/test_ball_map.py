"""The ball map: images and derivatives of boxes, an independent map, exact numbers, and errors."""

from decimal import Decimal
from fractions import Fraction

import mpmath
import numpy as np
import pytest
from flint import arb, ctx
from independent_solver import exact_map
from sections import BALL, sea

from extensions.proofs import Surface, proved_impacts
from extensions.proofs.enclosure.surface import ball_of, exact
from pseudorigid.dynamics.variables import chart
from pseudorigid.verified import reference_solver
from pseudorigid.verified.flight import UndecidedError

PAPER, K, G = Surface("1/5", "1/25", "1/100"), Fraction(1, 5), Fraction(1, 25)


def points(count):
    """Points (x, y) uniform on the section."""
    return chart(BALL.k, *sea(count)).T


def test_a_box_encloses_the_images_and_derivatives_of_its_points():
    random = np.random.default_rng(8)
    for x, y in points(40):
        try:
            rows, image = PAPER.jacobian(arb(x, 1e-4), arb(y, 1e-4))
        except UndecidedError:
            continue
        for dx, dy in random.uniform(-1e-4, 1e-4, (5, 2)):
            inner, point = PAPER.jacobian(arb(x + dx), arb(y + dy))
            assert all(outer.contains(part) for outer, part in zip(image, point, strict=True))
            for wide, thin in zip(rows, inner, strict=True):
                assert all(a.contains(b) for a, b in zip(wide, thin, strict=True))


def test_an_independent_map_of_60_digits_lies_in_the_balls():
    with ctx.workprec(160), mpmath.workdps(60):
        k, g = mpmath.mpf(1) / 5, mpmath.mpf(1) / 25
        for x, y in points(20):
            v, w = (mpmath.mpf(a.str(50, radius=False)) for a in PAPER.velocities(arb(x), arb(y)))
            image = PAPER.impact(arb(x), arb(y))
            x1, v1, w1, tau = exact_map(k, g, mpmath.mpf(x), v, w)
            for ball, true in ((image.x, x1), (image.y, v1 - k * w1), (image.tau, tau)):
                assert abs(float(arb(mpmath.nstr(true, 50)) - ball)) < 1e-40


@pytest.mark.parametrize(("numbers", "name"), [
    *(((value, "1/25", "1/100"), "k = ")
      for value in (0.2, "1/x", "1/0", "nan", "1e99999", None, True, "0x1p3")),
    (("0", "1", "1"), "k = 0"), (("6/5", "1", "1"), "k = 6/5"), (("1/5", "0", "1"), "g = 0"),
    (("1/5", "1/25", "-1/250"), "energy = -1/250"),
])  # fmt: skip
def test_numbers_that_are_not_exact_or_out_of_range_are_refused(numbers, name):
    with pytest.raises(ValueError, match=f"^{name}") as error:
        Surface(*numbers)
    assert "\n" not in str(error.value)


def test_exact_numbers_are_fractions_decimals_and_text():
    for value in (Fraction(1, 5), Decimal("0.2"), "1/5", "0.2", " 2e-1 ", "+1 / 5"):
        assert exact("k", value) == Fraction(1, 5)


@pytest.mark.parametrize("place", range(4))
def test_an_impact_that_is_off_has_its_error_and_one_that_is_no_number_no_bound(place):
    before = np.array([[0.1], [0.05], [0.06]])
    exact = reference_solver.impact(*map(ball_of, (K, G)), *map(arb, before[:, 0]))
    impact = np.array([[float(a)] for a in exact])
    assert proved_impacts.impact_errors(K, G, before, impact[:3], impact[3]) < 1e-15
    impact[place] += 1e-3
    assert 1e-3 - 1e-15 < proved_impacts.impact_errors(K, G, before, impact[:3], impact[3]) < 1.1e-3
    impact[place] = np.nan
    assert proved_impacts.impact_errors(K, G, before, impact[:3], impact[3]) == np.inf
