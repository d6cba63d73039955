"""Truncated series: each operation against values at displaced points, and enclosures of sets."""

from decimal import Decimal
from fractions import Fraction
from itertools import product
from math import prod

import numpy as np
import pytest
from flint import acb, arb, ctx

from extensions.proofs import Surface, proved_impacts
from extensions.proofs.enclosure import jets, surface
from extensions.proofs.enclosure.jets import Jet, algebra, square_root
from extensions.proofs.enclosure.surface import ball_of, exact
from helpers.parts.certificates import told
from helpers.sections import sea
from pseudorigid.dynamics.variables import chart
from pseudorigid.verified import reference_solver
from pseudorigid.verified.flight import UndecidedError, launch

PAPER, K, G = Surface("1/5", "1/25", "1/100"), Fraction(1, 5), Fraction(1, 25)
OPERATIONS = {
    "+": lambda a, b: 2 + (a + b) + arb("0.5"), "-": lambda a, b: 3 - (a - b) - arb("0.5"),
    "*": lambda a, b: arb("0.7") * (a * b) * 3, "/": lambda a, b: 2 / a + a / b + b / 7,
    "negative": lambda a, b: -(a * a * b), "sqrt": lambda a, b: (a + b * b).sqrt(),
    "square_root": lambda a, b: square_root(a * b + 1),
    "sine": lambda a, b: (a * b).sin_cos()[0], "cosine": lambda a, b: (a - b * b).sin_cos()[1],
    "impact x": lambda a, b: PAPER.impact(a / 10, b / 100).x,
    "impact tau": lambda a, b: PAPER.impact(a / 10, b / 100).tau,
}  # fmt: skip


def value_of(jet, *steps):
    """The sum of a series' terms at displacements."""
    total = 0
    for monomial, coefficient in zip(jet.algebra.monomials, jet.coefficients, strict=True):
        powers = (step**power for step, power in zip(steps, monomial, strict=True))
        total = total + prod(powers, start=coefficient)
    return total


@pytest.mark.parametrize("order", [1, 2, 3])
@pytest.mark.parametrize("name", OPERATIONS)
def test_a_series_has_the_values_of_its_function_nearby(name, order):
    """Up to terms of the next order, which are there."""
    with ctx.workprec(500):
        x, y, h = arb("0.8"), arb("1.3"), arb(10) ** -20
        jet = OPERATIONS[name](*Jet.plane(order, x, y))
        off = abs(value_of(jet, h, -2 * h) - OPERATIONS[name](x + h, y - 2 * h))
        assert off < 1e4 * h ** (order + 1)
        if name not in "+-" and not (name == "*" and order > 1) and order < 3:
            assert off > 1e-4 * h ** (order + 1)
        assert jet.constant.overlaps(OPERATIONS[name](x, y))


def test_powers_of_a_parameter_have_an_order_of_their_own():
    series = algebra(2, 2, 1)
    assert series.order == 3 and len(series.monomials) == 6 * 2
    x, y, t = Jet.series(series, arb(2), arb(3), arb(5))
    assert [(x * y * t * (1 + t))[0, 0, n] for n in (0, 1)] == [180, 66]
    assert [(x * y * t)[m] for m in ((1, 1, 1), (0, 0, 1), (1, 0, 0))] == [1, 6, 15]
    assert Jet.constant_of(series, arb(4)).constant == 4


@pytest.mark.parametrize("order", [1, 2, 3, 5])
def test_the_root_of_a_complex_series_is_its_square_root(order):
    with ctx.workprec(300):
        x, y = Jet.plane(order, acb(2, 1), acb(1, -3))
        square = 2 + x * y + x * x * x
        root = square_root(square)
        for a, b in zip((root * root).coefficients, square.coefficients, strict=True):
            assert abs(a - b) < 1e-80
        assert root.constant.real > 0


def test_the_root_of_a_wide_complex_set_has_those_of_its_points():
    square = acb(arb(2, 0.5), arb(1, 0.4))
    root = square_root(square)
    for u, v in product((-0.499, 0, 0.499), (-0.399, 0, 0.399)):
        assert root.contains(acb(2 + u, 1 + v).sqrt())
    assert root.rad() < 0.4
    for bad in (acb(arb(0, 0.1), 1), acb(-1, 1), arb(0), Jet.plane(1, arb(-1), arb(0))[0]):
        with pytest.raises(ArithmeticError, match="not proved to be analytic"):
            square_root(bad)


def test_series_are_substituted_for_the_variables():
    x, y = Jet.plane(3, acb(0), acb(0))
    first, second = x + 2 * y * y, y - x * y
    found = (3 + x * x * y - 5 * y + x).at(first, second)
    wanted = 3 + first * first * second - 5 * second + first
    assert all(abs(a) < 1e-14 for a in (found - wanted).coefficients)
    for place in ((first + 1, second), (first, second + acb(0, 1e-9))):
        with pytest.raises(ValueError, match="not 0 at 0"):
            x.at(*place)


# ---- a surface


def test_the_chart_is_that_of_the_energy():
    """v + w = s, v - k w = y, and the energy is the surface's; also for sets of points."""
    with ctx.workprec(200):
        k, g, energy = PAPER.constants()
        for point in (("0.1", "0.05"), ("-0.1", "-0.02"), ("0.5", "0.01")):
            x, y = map(arb, point)
            v, w = PAPER.velocities(x, y)
            assert abs(v * v / 2 + k * w * w / 2 - g * x + k * x * x / 2 - energy) < 1e-55
            assert abs(v - k * w - y) < 1e-55 and abs(v + w - PAPER.speed(x, y)) < 1e-55
            its, wanted = PAPER.flight(x, y), launch(k, g, x, v, w, v + w)
            assert all(abs(getattr(its, a) - getattr(wanted, a)) < 1e-55 for a in "xbcsg")
            after = PAPER.impact(x, y)
            assert all(a.overlaps(b) for a, b in zip(
                (after.x, after.y + k * (after.s - after.y) / (1 + k)), its.end(after.tau)[:2],
                strict=True))  # fmt: skip
        radius, middle = PAPER.radius(), g / k
        for side in (-1, 1):
            assert PAPER.speed(middle + side * radius * arb("0.999999"), arb(0)) > 0
            with pytest.raises(ArithmeticError, match="inside the section's rim"):
                PAPER.speed(middle + side * radius * arb("1.000001"), arb(0))
        assert abs(PAPER.area() - arb.pi() * radius * radius * (k * (1 + k)).sqrt()) < 1e-55


@pytest.mark.parametrize("edge", [arb(0), arb(0, 1e-9), acb(1, 1), acb(arb(0, 1e-9))])
def test_a_point_that_may_lie_on_the_rim_is_undecided(edge):
    """Above, at and next to the rim at y = 0: s^2 = 0 up to 1e-9, or has no positive real part."""
    k, g = PAPER.constants()[:2]
    with pytest.raises(ArithmeticError, match="inside the section's rim"):
        PAPER.speed(g / k + PAPER.radius() + edge, arb(0) if isinstance(edge, arb) else acb(0))


def test_a_wide_surface_has_each_energy_and_the_constants_of_each_precision():
    band = Surface("1/5", "1/25", "1/100", Fraction(1, 1000))
    for bits in (53, 200, 53):
        with ctx.workprec(bits):
            k, _, energy = band.constants()
            assert k.rel_accuracy_bits() > bits - 5
            for share in (0, 0.5, 1):
                assert energy.contains(arb(1) / 100 + arb(share) / 1000)
            assert energy.rad() < 1e-3 / 2 + 1e-9


@pytest.mark.parametrize(("numbers", "reason"), [
    *(((value, "1/25", "1/100"), "k = ")
      for value in (0.2, "1/x", "1/0", "nan", "1e99999", None, True, "0x1p3")),
    (("0", "1", "1"), "k = 0"), (("-1", "1", "1"), "k = -1"), (("1.01", "1", "1"), "k = 101/100"),
    (("1", "0", "1"), "g = 0"), (("1", "-1", "1"), "g = -1"), (("1", "1", "-1/2"), "energy = -1/2"),
    (("1", "1", "1", "-1"), "width = -1"), (("1", "1", "-0.4999999"), ""),
    (("1", "1", "9", "0"), ""),
])  # fmt: skip
def test_a_surface_has_exact_numbers_a_ball_and_an_energy_above_the_least(numbers, reason):
    with told(reason and f"^{reason}", ValueError):
        Surface(*numbers)


@pytest.mark.parametrize("text", ["1/3", "-2/7", "0", "1e-30", "12345678901234567890.5"])
def test_a_fraction_lies_in_its_ball_and_comes_back_from_its_midpoint(text):
    value = Fraction(text)
    for bits in (53, 300):
        with ctx.workprec(bits):
            ball = surface.ball_of(value)
            middle, radius = surface.fraction_of(ball), surface.fraction_of(arb(ball.rad()))
            assert abs(middle - value) <= radius <= abs(value) / 2 ** (bits - 2)
            assert jets.intersection(acb(ball), acb(arb(ball.mid(), 1))).real.contains(ball)


def test_a_box_encloses_the_images_and_derivatives_of_its_points():
    random = np.random.default_rng(8)
    for x, y in chart(0.2, *sea(40)).T:
        try:
            box = arb(x, 1e-4), arb(y, 1e-4)
            (rows, image), plain = PAPER.jacobian(*box), PAPER.impact(*box)
        except UndecidedError:
            continue
        for dx, dy in random.uniform(-1e-4, 1e-4, (5, 2)):
            inner, point = PAPER.jacobian(arb(x + dx), arb(y + dy))
            assert all(map(arb.contains, (*image, *plain), (*point, *point)))
            for wide, thin in zip(rows, inner, strict=True):
                assert all(a.contains(b) for a, b in zip(wide, thin, strict=True))


def test_exact_numbers_are_fractions_decimals_and_text():
    for value in (K, Decimal("0.2"), "1/5", "0.2", " 2e-1 ", "+1 / 5", "0.4/2"):
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
