"""The checker of invariant curves: premises, enclosures, and the formulas of theory/curves.md."""

from fractions import Fraction
from functools import partial, reduce
from itertools import pairwise, product
from math import cos, exp, factorial, pi, sin
from types import SimpleNamespace

import mpmath
import numpy as np
import pytest
from flint import acb, arb, ctx

from extensions.proofs import Surface
from extensions.proofs.checkers import circle, complex_flight, curve, periodic
from extensions.proofs.checkers.certificate import Certificate, NotProvedError
from helpers.parts.certificates import refused, told, with_bounds, with_field
from helpers.parts.small_curve import SMALL
from helpers.sections import BALL
from pseudorigid.verified.flight import UndecidedError

PAPER, TEXT = Surface("1/5", "1/25", "1/100"), SMALL.text()
CENTRE = arb("0.02"), arb("-0.01")


@pytest.fixture(autouse=True)
def bits():
    with ctx.workprec(100):
        yield


def number(z):
    """A complex number of Arb as one of mpmath."""
    return mpmath.mpc(*(mpmath.mpf(float(a)) for a in (z.real, z.imag)))


def wave_sum(waves, t):
    """The polynomial with coefficients c_q at a complex t, term by term."""
    total = waves[0]
    for q, c in enumerate(waves[1:], 1):
        total += c * (2 * q * acb(t)).exp_pi_i() + c.conjugate() * (-2 * q * acb(t)).exp_pi_i()
    return total


def ellipse(x=0.1, y=0.1, centre=CENTRE, turns=1):
    """A curve that turns clockwise, with a small second wave."""
    zeros = [acb(0)] * (turns - 1)
    return ([acb(centre[0]), *zeros, acb(x / 2), *zeros, acb(x / 40)],
            [acb(centre[1]), *zeros, acb(0, y / 2), *zeros, acb(0, y / 50)])  # fmt: skip


def near(point, radius):
    """Points within a radius of one, in the directions of the axes."""
    return [[a + radius * s for a in point] for s in (0, 1, -1, acb(0, 1), acb(0, -1))]


def inside(boxes, points):
    return all(acb(a).contains(acb(b)) for z in points for a, b in zip(boxes, z, strict=True))


# ---- trigonometric polynomials


WAVES = [acb(0.3), acb(0.2, -0.5), acb(-0.4, 0.1), acb(0.05, 0.3), acb(0.7, 0.2), acb(-0.1, 0.6)]


@pytest.mark.parametrize(("count", "offset", "height"), [(16, 0, 0), (4, 0.3, 0), (7, 0.5, 0.02)])
def test_values_derivatives_and_turned_polynomials_are_those_of_the_sum(count, offset, height):
    """Also on fewer points than waves."""
    step, turn = arb(2) ** -40, arb("0.17")
    values = circle.values(WAVES, count, offset, height)
    slopes = circle.values(circle.derivative(WAVES), count, offset, height)
    turned = circle.values(circle.rotated(WAVES, turn), count, offset, height)
    for j in range(count):
        t = acb((arb(j) + arb(offset)) / count, arb(height))
        before, here, after = (wave_sum(WAVES, t + a) for a in (-step, 0, step))
        assert abs(values[j] - here) < 1e-25
        assert abs(slopes[j] - (after - before) / (2 * step)) < 1e-15
        assert abs(turned[j] - wave_sum(WAVES, t + turn)) < 1e-25
    if count == 16:
        found = circle.transform(circle.real_values(WAVES, 16), 5)
        assert all(abs(a - b) < 1e-25 for a, b in zip(found, WAVES, strict=True))


@pytest.mark.parametrize(("quotients", "denominator"), [([5, 1, 3], 23), ([9], 9), ([2, 4], 9)])
def test_the_sum_of_small_divisors_ends_below_the_convergents_denominator(quotients, denominator):
    omega, divisors = circle.noble(quotients)
    value = reduce(lambda value, a: 1 / (a + value), reversed(quotients), (5**0.5 - 1) / 2)
    terms = [sin(pi * q * value) ** -2 for q in range(1, denominator)]
    assert float(omega) == pytest.approx(value, abs=1e-15)
    assert float(divisors) == pytest.approx(sum(terms), rel=1e-12)


@pytest.mark.parametrize(("quotients", "repeating", "reason"), [
    ([5], [], "rational"), ([5], [1, 1], "do not end in ones"), ([], [1], "not whole"),
    ([5, 0], [1], "not whole"), ([5.0], [1], "not whole"), ([100, 101], [1], "too large"),
])  # fmt: skip
def test_each_premise_of_a_noble_number_is_looked_at(quotients, repeating, reason):
    with pytest.raises(NotProvedError, match=reason):
        circle.noble(quotients, repeating)


@pytest.mark.parametrize("order", [1, 5])
@pytest.mark.parametrize(("q", "height", "half"), [
    (1, 0, 0), (1, 0.4, 0), (2, 0.1, 0.02), (1, -0.4, 0),
])  # fmt: skip
def test_the_remainder_of_a_cell_is_that_of_taylors_theorem(q, height, half, order, monkeypatch):
    """A wave's last derivative is almost the bound at some of these cells."""
    monkeypatch.setattr(circle, "ORDER", order)
    waves, power = [acb(0)] * (q + 1), order + 1
    for phase, count in product((1, acb(0, 1)), (8, 64)):
        waves[q] = acb(0.5, 0.2) * phase
        cells = circle.Cells(waves, count, height, half)
        reach = (0.25 / count**2 + half**2) ** 0.5
        growth = exp(2 * pi * q * (abs(height) + half))
        bound = 2 * float(abs(waves[q])) * (2 * pi * q * reach) ** power * growth
        assert float(cells.rest.real.rad()) == pytest.approx(bound / factorial(power), rel=1e-6)
        assert cells.rest.imag.rad() == (cells.rest.real.rad() if height or half else 0)
        for j, u, v in product(range(count), (-1, 1), (-1, 1)):
            away = acb(arb(u) / (2 * count), arb(half) * v)
            true = wave_sum(waves, acb((arb(j) + arb(0.5)) / count, arb(height)) + away)
            rest = true - circle.evaluate(cells.taylor(j), away)
            if not (height or half):  # a real polynomial
                true, rest = acb(true.real), acb(rest.real)
            assert cells.box.contains(away * (1 - arb(2) ** -40))
            assert cells.rest.contains(rest) and cells[j].contains(true)


def test_all_curves_near_one_are_in_its_cells(monkeypatch):
    """With large r and beta, at the corners of cells."""
    monkeypatch.setattr(curve, "NEAR", arb("0.01"))
    monkeypatch.setattr(curve, "NEAR_SLOPE", arb("0.1"))
    one, height, half = ellipse(), arb("0.03"), arb("0.01")
    slope = curve._slope_of(one)
    points, slopes = curve._inflated_cells(one, 16, height, half)
    for (j, u), v in product(((0, 0), (3, 0.999), (15, 0.5)), (-0.999, 0.999)):
        t = acb(arb(j + u) / 16, height + half * v)
        assert inside(points[j], near([wave_sum(w, t) for w in one], arb("0.00999")))
        assert inside(slopes[j], near([wave_sum(w, t) for w in slope], arb("0.0999")))
    for j, u in product(range(16), (0, 0.5, 0.999)):
        true = [wave_sum(w, arb(j + u) / 16).real for w in one]
        shifted = [[a + s * arb("0.00999") for a in true] for s in (-1, 1)]
        assert inside(curve._real_cells(one, 16)[j], shifted)


# ---- flights at complex points


def complex_root(x, y, start):
    """The flight's root near `start` at a complex point, in 30 digits."""
    k, g, energy = mpmath.mpf(1) / 5, mpmath.mpf(1) / 25, mpmath.mpf(1) / 100
    s = mpmath.sqrt(((1 + k) * (2 * energy + 2 * g * x - k * x * x) - y * y) / k)
    c = -(y + s) / (1 + k)
    return mpmath.findroot(lambda t: g * t * t / 2 - s * t + c * (mpmath.sin(t) - t)
                           + x * (1 - mpmath.cos(t)), start)  # fmt: skip


@pytest.mark.parametrize(("rx", "ry"), [(0.01, 0), (0, 0.01), (0.002, 0.002)])
def test_a_wide_box_has_the_flight_times_of_its_points(rx, ry):
    x, y, known = 0.1, 0.05, acb(PAPER.impact(arb(0.1), arb(0.05)).tau)
    root = complex_flight.unique_root(PAPER, *(acb(arb(a, r), arb(0, r))
                                               for a, r in ((x, rx), (y, ry))), known)  # fmt: skip
    for sign in (-1, 1, 1j, -1j, (1 + 1j)):
        true = complex_root(x + rx * sign, y + ry * sign, number(known))
        assert root.contains(acb(float(true.real), float(true.imag)))
    assert root.rad() < 0.7


@pytest.mark.parametrize(("change", "known", "reason"), [
    ({"_WIDER": 0.1}, 2.4097385286702887, "may not be analytic"),  # the image is not inside the set
    ({}, 1.25, "slope of the gap may vanish"), ({"_ATTEMPTS": 0}, 2.4, "may not be analytic"),
])  # fmt: skip
def test_a_root_that_is_not_proved_to_be_the_only_one_is_refused(
    change, known, reason, monkeypatch
):
    for name, value in change.items():
        monkeypatch.setattr(complex_flight, name, value)
    box = acb(arb(0.1, 0.003), arb(0, 0.003)), acb(arb(0.05, 0.003))
    with pytest.raises(UndecidedError, match=reason):
        complex_flight.unique_root(PAPER, *box, acb(known))


# ---- the certificate


@pytest.mark.parametrize(("field", "value", "reason"), [
    *((field, value, "out of range") for field, value in (
        ("strip", 0), ("strip", 1), ("strip", 2), ("loss", 0), ("loss", -0.001), ("columns", 7),
        ("columns", 4097), ("rows", 0), ("rows", 1001), ("more_rows", 0), ("more_rows", 1001))),
    ("loss", 0.01, "too narrow"),  # 6 times this is the strip's half width
    ("strip", 0.2, "strip"), ("rows", 6.0, "another form"), ("radius", 1e-7, "as stated"),
    ("share", 0.0068, "not 0.0069 as stated"), ("error", 1e-30, "not above 0 and at most"),
    ("error", 0, "not above 0 and at most"), ("repeating", [], "rational"),
    ("quotients", [5, 1, 1, 2, 20, *[1] * 120, 10**12], "too large"),  # far behind
])  # fmt: skip
def test_each_number_of_a_certificate_is_looked_at(field, value, reason):
    assert reason in refused(SMALL, with_field(TEXT, field, value))


def test_the_cells_reach_the_edge_of_the_wide_strip():
    """4 rows of cells below the strip's edge and 3 beyond; the first curve is the certificate's."""
    certificate = Certificate(TEXT, "invariant curve", PAPER)
    claim = curve._read(certificate, Fraction("0.0069"), Fraction("1e-35"), None)
    numbers = [claim.strip, claim.wide, claim.height, claim.loss, claim.error, claim.share]
    assert [float(a) for a in numbers] == pytest.approx(
        [0.06, 0.105, 0.015, 0.0098, 1e-35, 0.0069], abs=0, rel=1e-12)  # fmt: skip
    assert (claim.columns, claim.rows, claim.all_rows) == (64, 4, 7)
    x, y = np.array(certificate.numbers("coefficients", 2), dtype=float).T
    angles = 2 * pi * 0.2 * np.arange(x.size)
    expected = np.cos(angles) @ x, np.sin(angles) @ y
    assert [float(a) for a in curve._points(claim.curve, 5)[1]] == pytest.approx(expected)


@pytest.mark.parametrize("ends", [("0.17864", "0.1787"), ("0.1786", "0.17861")])
def test_the_rotation_number_lies_between_both_ends(ends):
    assert "statement's interval" in refused(SMALL, rotation=tuple(map(Fraction, ends)))


# ---- the error of a curve


@pytest.mark.parametrize("period", [1, 2])
def test_errors_are_those_of_each_curves_image(period):
    """At points that are not on the grid; P(K_1) belongs to K_0, turned."""
    first, omega = ellipse(0.05, 0.04), arb("0.17")
    curves, errors = curve._curves(PAPER, first, period, omega, 128)
    assert len(curves) == period and len(errors) == 2 * period
    for waves in curves[1:]:
        assert all(c.is_exact() and len(w) == 3 for w in waves for c in w)
        assert all(w[0].imag == 0 for w in waves)
    at = arb("0.3141")
    for i, here in enumerate(curves):
        there, t = (first, at + omega) if i == period - 1 else (curves[i + 1], at)
        image = PAPER.impact(*(wave_sum(w, at).real for w in here))
        for r in (0, 1):
            expected = wave_sum(there[r], t).real + wave_sum(errors[2 * i + r], at).real
            assert abs(image[r] - expected) < 1e-9


def test_the_bound_of_the_error_is_the_readmes_sum():
    """With few points and a wide strip, so that aliasing and tail are as large as the rest."""
    claim = SimpleNamespace(wide=arb("0.03"), strip=arb("0.02"))
    waves = [[acb(0.1, 0.2), acb(-0.3), acb(0, 0.2)], [acb(0.5), acb(0.4, 0.3), acb(-0.7, 0.1)]]
    largest, wide, strip, points, cut = 2 * 0.9, 0.03, 0.02, 7, 2
    z, totals = exp(-2 * pi * wide), []
    for row in waves:
        total = sum(2 * largest * exp(-2 * pi * (wide - strip) * q) for q in range(cut + 1, 900))
        for q in range(-cut, cut + 1):
            alias = sum(largest * z ** abs(q + m * points) for m in range(-90, 91) if m)
            total += (float(abs(row[abs(q)])) + alias) * exp(2 * pi * strip * abs(q))
        totals.append(total)
    bound = curve._bound_of_error(waves[::-1], cut, points, arb("0.9"), claim)
    assert float(bound) == pytest.approx(max(totals), rel=1e-9)
    assert float(curve._bound_of_error(waves[:1], cut, points, arb("0.9"), claim)) == (
        pytest.approx(totals[0], rel=1e-9))  # fmt: skip


# ---- the theorem


SIZES = {"tangent": 2.0, "normal": 6.0, "twist": 5.0, "torsion": 0.7, "derivative": 4.0,
         "second_derivative": 300.0, "image": 1.0}  # fmt: skip
LOSS = 0.004


def readme(period, eps, divisors):
    """The theorem's numbers, as in theory/curves.md ("One step")."""
    sL, sN, sT, st, c1, c2 = *list(SIZES.values())[:3], 1 / SIZES["torsion"], 4.0, 300.0
    d = LOSS
    kappa = period * (3 / 32 + divisors * d**2) ** 0.5 + 2 * (period - 1) * d
    a2 = 2 * kappa * sL + st * (2 * sN * d + 2 * sT * sL * kappa)
    a1 = kappa * (2 * sN * d + sT * a2)
    a = sL * a1 + sN * a2 * d
    C = (2 * sL * sN * a1 * d + sN * (d**3 + 2 * sL * a1 * d + 2 * c1 * sN * a2 * d**2)
         + c2 * a**2 / 2)  # fmt: skip
    return 2**4 * C * eps / d**4, 2 * a * eps / d**2, 2 * a * eps / d**3


def theorem(period, eps, divisors):
    claim = SimpleNamespace(error=arb(eps), loss=arb(LOSS), divisors=arb(divisors))
    return curve._theorem(claim, curve.Bounds(*map(arb, SIZES.values())), period)


@pytest.mark.parametrize(("period", "divisors"), [(1, 0.0), (1, 5e4), (3, 2e4)])
def test_the_theorems_inequalities_are_the_readmes(period, divisors):
    eps = 1e-20
    margins, *lengths = theorem(period, eps, divisors)
    contraction, *expected = readme(period, eps, divisors)
    assert margins["contraction"] == pytest.approx(0.5 / contraction, rel=1e-12)
    assert margins["distance"] == pytest.approx(1e-10 / expected[0], rel=1e-12)
    assert margins["torsion"] == pytest.approx(0.7)
    assert [float(a) for a in lengths] == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize(("place", "limit", "reason"), [
    (0, 0.5, "steps"), (1, 1e-40, "curve may leave"), (2, 1e-40, "slope may leave"),
])  # fmt: skip
def test_each_inequality_is_checked(place, limit, reason, monkeypatch):
    """Just above and below its limit, the others being far from theirs."""
    for name, wide in (("NEAR", 1), ("NEAR_SLOPE", 2)):
        monkeypatch.setattr(curve, name, arb(limit if place == wide else 1e10))
    eps = limit / readme(1, 1.0, 100.0)[place]
    theorem(1, eps * 0.999, 100.0)
    with pytest.raises(NotProvedError, match=reason):
        theorem(1, eps * 1.001, 100.0)


# ---- the strip


def test_normals_have_determinant_one_with_slopes_and_no_pole():
    point, slope, centre = (acb(0.3, 0.1), acb(-0.2)), (acb(0.5), acb(0.1, 0.4)), (arb(0.1), arb(0))
    normal, distance, area = curve.normal_vector(point, slope, centre)
    assert abs(slope[0] * normal[1] - slope[1] * normal[0] - 1) < 1e-25
    assert float(distance) == pytest.approx(max(abs(0.2 + 0.1j), 0.2))
    assert float(area) == pytest.approx(abs((0.2 + 0.1j) * (0.1 + 0.4j) + 0.2 * 0.5))
    with pytest.raises(NotProvedError, match="may be parallel"):
        curve.normal_vector(point, (point[0] - centre[0], point[1]), centre)


def test_the_change_of_twist_is_bounded_term_by_term(monkeypatch):
    """T = det(DP N, N_+), N = (K - c)/A, A = det(K - c, L), and |det(a, b)| <= 2 |a| |b|."""
    r, beta = 0.001, 0.02
    monkeypatch.setattr(curve, "NEAR", arb(r))
    monkeypatch.setattr(curve, "NEAR_SLOPE", arb(beta))
    random = np.random.default_rng(4)
    for sL, sN, c1, c2, distance, area in random.uniform(0.5, 3, (3, 6)):
        of_area = 2 * r * sL + 2 * distance * beta
        of_normal = r / area + sN * of_area / area
        of_image = c2 * r * sN + c1 * of_normal  # of DP N
        expected = 2 * of_image * sN + 2 * c1 * sN * of_normal
        bound = curve._change_of_twist(*map(arb, (sL, sN, c1, c2, distance, area)))
        assert float(bound) == pytest.approx(expected, rel=1e-12)


def edge_bounds(sizes):
    return curve.EdgeBounds(*map(arb, sizes))


@pytest.fixture
def bounds_of(monkeypatch):
    """The constants that follow from made-up bounds over the edge of a strip of 2 columns."""
    claim = SimpleNamespace(centres=[CENTRE], omega=arb("0.17"), strip=arb("0.04"), columns=2)
    edge = [edge_bounds(sizes) for sizes in ((2, 6, 5, 4, 300, 0.5, 0.2),
                                            (1, 7, 4, 3, 200, 0.6, 0.1))]  # fmt: skip
    top = [((acb(0.1, 3), acb(-1)), acb(2)), ((acb(0), acb(0, 2)), acb(5))]
    counts = []

    def bounds(torsion, images=(1, 2), impact=None, edge=edge):
        def mean(surface, cycle, count):
            counts.append(count)
            assert [c for _, c in cycle] == [CENTRE, CENTRE]
            assert abs(cycle[1][0][0][1] / cycle[0][0][0][1] - acb(0.34).exp_pi_i()) < 1e-9
            return torsion

        monkeypatch.setattr(curve, "_torsion", mean)
        monkeypatch.setattr(curve, "_over_strip", lambda *_: ([], top))
        monkeypatch.setattr(curve, "_over_edge", lambda *_: edge)
        surface = SimpleNamespace(impact=impact or (lambda *point: (*map(arb, images), arb(9))))
        one = ellipse()
        return curve._bounds(surface, [one], [curve._real_cells(one, 2)], claim), counts

    return bounds


def test_the_constants_are_the_largest_over_the_edge_and_the_twists_mean_the_least(bounds_of):
    bounds, (count,) = bounds_of(arb(-40, 0.1))
    assert [float(a) for a in bounds[:3]] == [2, 7, 5]
    assert [float(a) for a in bounds[4:]] == pytest.approx([4, 300, abs(0.1 + 3j)])
    alias = 2 * sum(5 * exp(-2 * pi * 0.04 * count * m) for m in range(1, 200))
    change = float(curve._change_of_twist(*map(arb, (2, 7, 4, 300, 0.6, 0.1))))
    assert float(bounds.torsion) == pytest.approx(39.9 - alias - change, rel=1e-9)
    assert float(bounds_of(arb(40), (1, -7))[0].image) == 7


def test_each_premise_over_the_strip_is_looked_at(bounds_of):
    for torsion in (arb(0, 1), arb(-0.5), arb(0.5)):
        with pytest.raises(NotProvedError, match="twist's mean"):
            bounds_of(torsion)
    with pytest.raises(NotProvedError, match="not finite"):
        bounds_of(arb(40), edge=[edge_bounds((1, 1, 1, 1, "inf", 1, 1))])

    def impact(*point):
        if len(point) == 2:  # a box around the real curve, whose first roots are not decided
            raise UndecidedError("a touch")
        return arb(1), arb(2)

    with pytest.raises(NotProvedError, match="the strip around the curve: a touch"):
        bounds_of(arb(40), impact=impact)


STRIP = SimpleNamespace(columns=48, height=arb("0.005"), strip=arb("0.01"), rows=2, all_rows=3)


def test_cells_of_the_strip_have_the_points_of_all_curves_near_and_their_flights(monkeypatch):
    monkeypatch.setattr(curve, "NEAR", arb("1e-4"))
    one = ellipse(0.06, 0.05, (0.02, 0.0))
    below, top = curve._over_strip(PAPER, (one, CENTRE), STRIP)
    for cells, row in ((below, 1), (top, 2)):
        assert len(cells) == 48
        for j, (u, v) in product((0, 11, 30), ((0.01, 0.01), (0.99, 0.99), (0.5, 0.5))):
            t = acb(arb(j + u) / 48, STRIP.height * (row + v))
            x, y = (wave_sum(w, t) for w in one)
            point, root = cells[j]
            assert inside(point, near([x, y], arb("0.9999e-4")))
            true = complex_root(*map(number, (x + 5e-5, y - 5e-5)), 2.4)
            assert root.contains(acb(float(true.real), float(true.imag)))


def halved(side):
    """Cells half as high, on one side of their row's middle."""
    return lambda cells, one, count, middle, half: cells(
        one, count, middle + side * half / 2, half / 2)  # fmt: skip


def with_pole(row):
    """Cells with one in a row in which K - c and K' are parallel."""

    def altered(cells, one, count, middle, half):
        points, slopes = cells(one, count, middle, half)
        if abs(middle - STRIP.height * (row + 0.5)) < 1e-9:
            slopes[7] = tuple(a - c for a, c in zip(points[7], CENTRE, strict=True))
        return points, slopes

    return altered


@pytest.mark.parametrize(("altered", "reason"), [
    *((halved(side), "a point of its edge") for side in (-1, 1)), (with_pole(2), None),
    (with_pole(0), "may be parallel"), (with_pole(1), "may be parallel"),
])  # fmt: skip
def test_cells_without_a_point_of_their_edge_or_with_a_pole_are_refused(
    altered, reason, monkeypatch
):
    """Beyond the strip's edge, in row 2, poles do not matter."""
    monkeypatch.setattr(complex_flight, "unique_root", lambda *_: acb(1))
    monkeypatch.setattr(complex_flight, "point_root", lambda *_: acb(1))
    monkeypatch.setattr(curve, "_inflated_cells", partial(altered, curve._inflated_cells))
    with told(reason):
        curve._over_strip(PAPER, (ellipse(0.06, 0.05, (0.02, 0.0)), CENTRE), STRIP)


def test_bounds_over_the_edge_are_the_values_there_for_cells_without_width(monkeypatch):
    """Of L, N, T, DP and D^2 P, for the map (x^2 + 3 x y, 2 y^2 - x)."""
    here, there = (ellipse(0.06, 0.05, (0.02, 0.0)), CENTRE), (ellipse(0.1, 0.09), (arb(0), arb(0)))

    def values(one):
        return [*zip(*(circle.values(w, 8, arb(0.3), STRIP.strip) for w in one), strict=True)]

    monkeypatch.setattr(curve, "_inflated_cells", lambda one, *_: (
        values(one), values(curve._slope_of(one))))  # fmt: skip
    monkeypatch.setattr(curve, "_check_inside", lambda *_: None)
    for name in ("point_root", "unique_root"):
        monkeypatch.setattr(complex_flight, name, lambda *_: None)
    surface = SimpleNamespace(
        flight=lambda *_: None, impact=lambda x, y, root: (x * x + x * y * 3, y * y * 2 - x)
    )
    claim = SimpleNamespace(columns=2, strip=STRIP.strip)
    edge = curve._over_edge(surface, here, there, claim, [(None, None)] * 2)
    rows = (values(row) for one, _ in (here, there) for row in (one, curve._slope_of(one)))
    for found, (x, y), (u, v), (p, q), (r, s) in zip(edge, *rows, strict=True):
        a, b = x - CENTRE[0], y - CENTRE[1]
        area, after = a * v - b * u, p * s - q * r
        along, across = ((c * -a + d * -b) / area for c, d in ((2 * x + 3 * y, 3 * x), (-1, 4 * y)))
        true = (max(abs(u), abs(v)), max(abs(a / area), abs(b / area)),
                abs((across * p - along * q) / after),
                max(abs(2 * x + 3 * y) + abs(3 * x), 1 + abs(4 * y)), 2 + 2 * 3,
                max(abs(a), abs(b)), abs(area))  # fmt: skip
        assert [float(a) for a in found] == pytest.approx([float(a) for a in true], rel=1e-12)


def test_an_edge_cell_that_misses_its_middle_is_refused(monkeypatch):
    here, inflated = (ellipse(0.06, 0.05, (0.02, 0.0)), CENTRE), curve._inflated_cells
    below, _ = curve._over_strip(PAPER, here, STRIP)
    moved = [(tuple(a + 0.1 for a in point), root) for point, root in below]
    with pytest.raises(NotProvedError, match="a point of its edge"):
        curve._over_edge(PAPER, here, here, STRIP, moved)
    monkeypatch.setattr(curve, "_inflated_cells", lambda one, count, height: inflated(
        one, count, height + arb("1e-4")))  # fmt: skip
    with pytest.raises(NotProvedError, match="a point of its edge"):
        curve._over_edge(PAPER, here, here, STRIP, below)


def test_the_mean_of_the_twist_is_that_of_doubles():
    """With the derivatives of the package's kernel, around two centres."""
    count, centres = 12, (CENTRE, (arb("0.01"), arb("0.03")))
    curves = ellipse(0.1, 0.08), ellipse(0.12, 0.07, (0.01, 0.02))
    cycle = [*zip(curves, centres, strict=True), (curve._turned(curves[0], arb("0.17")), CENTRE)]

    def frame(one, centre, j):
        waves = (*one, *curve._slope_of(one))
        x, y, u, v = (float(wave_sum(w, arb(j) / count).real) for w in waves)
        p, q = x - float(centre[0]), y - float(centre[1])
        return (x, y), np.array([p, q]) / -(p * v - q * u)

    total = 0.0
    for here, there in pairwise(cycle):
        for j in range(count):
            (x, y), n = frame(*here, j)
            a, b = BALL.chart_jacobian(*BALL.state_xy(x, y, 0.01)) @ n
            total += a * frame(*there, j)[1][1] - b * frame(*there, j)[1][0]
    mean = float(curve._torsion(PAPER, cycle, count))
    assert mean == pytest.approx(total / (2 * count), rel=1e-8)


# ---- the discs


def circle_cells(count=36, at=None, angle=0.0):
    """Boxes around arcs of a clockwise circle; one reaches on to an angle, in degrees."""
    one = ellipse(0.1, 0.1, (0, 0))
    one = [[*w[:2], acb(0)] for w in one]
    cells = curve._real_cells(one, count)
    if at is not None:
        turn = -2 * pi * (at + 0.5) / count - angle * pi / 180
        x, y = cells[at]
        cells[at] = x.union(arb(0.1 * cos(turn))), y.union(arb(0.1 * sin(turn)))
    return one, cells, (arb(0), arb(0))


def test_a_curve_turns_once_clockwise_within_its_cells(monkeypatch):
    one, cells, centre = circle_cells()
    curve._check_winding(one, cells, centre)
    backwards = one[0], [a.conjugate() for a in one[1]]
    wide = [[w[0], w[1] + acb(arb(0, 0.003)), w[2]] for w in one]
    for bad, boxes, where, reason in (
        (backwards, curve._real_cells(backwards, 36), centre, "turns 1.00 times"),
        (one, cells, (arb(1), arb(0)), "turns 0.*times|turns .*e-"),
        (one, cells, (arb("0.0999"), arb(0)), "too wide"),
        (one, circle_cells(36, 5, 86)[1], centre, "too wide"),  # from the middle before
        (one, circle_cells(36, 5, -86)[1], centre, "too wide"),  # from the one behind
        (wide, curve._real_cells(wide, 36), centre, "turns|too wide"),
    ):
        with pytest.raises(NotProvedError, match=reason):
            curve._check_winding(bad, boxes, where)
    monkeypatch.setattr(periodic, "CLOSE", Fraction(1, 5))  # the orbit's point may be outside
    with pytest.raises(NotProvedError, match="too wide"):
        curve._check_winding(one, cells, centre)


@pytest.mark.parametrize("place", range(3))
@pytest.mark.parametrize("pair", [(1, 1), (-1, -1), (arb(0, 1), 1), (-1, arb(0, 1))])
def test_each_turn_of_the_polygon_is_clockwise_and_not_too_wide(place, pair, monkeypatch):
    one, _, centre = circle_cells()
    monkeypatch.setattr(curve, "_lies_beyond", lambda *_: True)
    curve._polygon(one, centre, 36)
    calls = iter(range(108))
    monkeypatch.setattr(curve, "_turn", lambda *_: pair if next(calls) == 57 + place else (-1, 1))
    with pytest.raises(NotProvedError, match="polygon"):
        curve._polygon(one, centre, 36)


def test_the_polygon_is_inside_the_curve(monkeypatch):
    one, _, centre = circle_cells()
    beyond, turn, cells, turns = curve._lies_beyond, curve._turn, [], []

    def recorded(x_cells, y_cells, j, a, b):
        cells.append((x_cells[j], y_cells[j], a, b))
        return beyond(x_cells, y_cells, j, a, b)

    monkeypatch.setattr(curve, "_lies_beyond", recorded)
    monkeypatch.setattr(curve, "_turn", lambda *given: turns.append(given) or turn(*given))
    corners = curve._polygon(one, centre, 64)
    assert len(cells) == len(corners) == len(turns) / 3 == 64
    for j, (x, y, a, b) in enumerate(cells):
        for shift in (-0.12499, 0.5, 1.12499):
            assert inside((x, y), [[wave_sum(w, arb(j + shift) / 64).real for w in one]])
        (_, begin, first), (_, *edge), (_, last, end) = turns[3 * j : 3 * j + 3]
        assert first == a and edge == [a, b] and last == b
        for point, shift in ((begin, -0.125), (end, 1.125)):
            assert inside(point, [[wave_sum(w, arb(j + shift) / 64).real for w in one]])
        assert [float(v) for v in (*a, *b)] == [*corners[j], *corners[(j + 1) % 64]]
        assert np.hypot(*corners[j]) == pytest.approx(0.0999)
    for inset, count in ((Fraction(-1, 1000), 64), (Fraction(1, 1000), 20)):
        monkeypatch.setattr(curve, "_POLYGON_INSET", inset)
        with pytest.raises(NotProvedError, match="polygon"):
            curve._polygon(one, centre, count)


@pytest.mark.parametrize(("x", "y", "a", "b", "beyond"), [
    (0, 0.131, (0, 0), (1, 0), True), (0, 0.129, (0, 0), (1, 0), False),  # rest of y, and NEAR
    (-0.231, 0, (0, 0), (0, 1), True), (-0.229, 0, (0, 0), (0, 1), False),  # rest of x
    (0.2, -0.431, (1, -0.3), (0, -0.3), True), (0.2, -0.429, (1, -0.3), (0, -0.3), False),
    (1, 1.361, (0.5, 0.5), (1.5, 1.5), True), (1, 1.359, (0.5, 0.5), (1.5, 1.5), False),
])  # fmt: skip
def test_a_curve_lies_beyond_a_line_by_more_than_all_remainders(x, y, a, b, beyond, monkeypatch):
    monkeypatch.setattr(curve, "NEAR", arb("0.03"))
    cells = [SimpleNamespace(taylor=lambda j, v=v: [acb(v), acb(0, 5)], box=acb(0), rest=acb(rest))
             for v, rest in ((x, 0.2), (y, 0.1))]  # fmt: skip
    line = [tuple(map(arb, point)) for point in (a, b)]
    assert curve._lies_beyond(*cells, 0, *line) == beyond


def test_the_whole_disc_is_covered(monkeypatch):
    """Where flights are decided on narrow boxes only."""
    one, boxes, centre = circle_cells(128)
    pieces = []

    def impact(x, y):
        if x.rad() > 0.005 or y.rad() > 0.005:
            raise UndecidedError("wide")
        pieces.append((x, y))

    surface = SimpleNamespace(impact=impact)
    curve._check_disc(surface, boxes, centre)
    for radius, j in product(np.linspace(0, 1, 15), range(32)):
        at = [radius * wave_sum(w, arb(j + 0.37) / 32).real for w in one]
        assert any(x.contains(at[0]) and y.contains(at[1]) for x, y in pieces), (radius, j)
    monkeypatch.setattr(curve, "_MOST_HALVINGS", 1)
    with pytest.raises(NotProvedError, match="the disc inside the curve: wide"):
        curve._check_disc(surface, boxes, centre)


@pytest.mark.parametrize("place", range(2))
@pytest.mark.parametrize(("size", "turns", "columns", "reason"), [
    (0.06, 1, 64, r"the disc inside the curve: .*touch"),  # the jump set begins inside
    (0.01, 2, 128, "turns -2.00 times"), (0.01, 1, 20, "polygon"),
])  # fmt: skip
def test_each_disc_of_an_orbit_is_looked_at(size, turns, columns, reason, place):
    centre = arb("0.15"), arb("-0.144" if size == 0.06 else "0")
    good = tuple([*w[:2], acb(0)] for w in ellipse(0.01, 0.01, (0.15, 0)))
    curves, boxes = [good] * 2, [curve._real_cells(good, 64)] * 2
    curve._prove_discs(PAPER, curves, boxes, [(arb("0.15"), arb(0))] * 2)
    curves[place] = tuple(w[: turns + 1] for w in ellipse(size, size, centre, turns))
    boxes[place] = curve._real_cells(curves[place], columns)
    centres = [(arb("0.15"), arb(0))] * 2
    centres[place] = centre
    with pytest.raises(NotProvedError, match=reason):
        curve._prove_discs(PAPER, curves, boxes, centres)


# ---- the whole check, with made-up curves and bounds


@pytest.fixture
def made_up(monkeypatch):
    """Check the small theorem with parts of the check replaced."""
    sizes = curve.Bounds(*map(arb, (2, 6, 6, 1, 4, 200, 1)))

    def check(curves=None, error=None, distance="1e-20", slope="1e-18", **bounds):
        kept = {"_prove_discs": lambda *_: []}
        if curves:
            kept["_curves"] = lambda surface, first, *_: ([first, *curves], [])
            kept |= {"_bounds": lambda *_: sizes, "_bound_of_error": lambda *_: arb(error)}
        else:
            kept["_prove_error"] = lambda *_: ([], [], sizes)
        kept["_theorem"] = lambda *_: ({"torsion": 1.0}, arb(distance), arb(slope))
        for name, value in kept.items():
            monkeypatch.setattr(curve, name, value)
        return with_bounds(SMALL, **bounds).check(TEXT)

    return check


def moved(dx, dy):
    """The small theorem's first two waves around another centre."""
    x, y = ellipse(0.02, 0.02, (0.0212 + dx, dy))
    return x, y


@pytest.mark.parametrize(("curves", "overlap"), [
    ([moved(0, 0)], True), ([moved(0.2, 0)], False), ([moved(0, 0.2)], False),
    ([moved(0.2, 0), moved(0, 0)], True), ([moved(0.2, 0), moved(0.2, 0)], True),
    ([moved(0.2, 0), moved(-0.2, 0)], False),
])  # fmt: skip
def test_the_discs_inside_any_two_curves_are_disjoint(curves, overlap, made_up):
    result = made_up(curves, "1e-36")
    assert ("may overlap" in result.line()) == overlap and (result.verdict == "proved") != overlap


def test_the_error_is_below_the_stated_one(made_up):
    curves = [moved(0.2, 0)]
    assert made_up(curves, "0.999e-35").verdict == "proved"
    for error in ("1.001e-35", "nan"):
        assert "error is not proved to be below 1e-35: its bound" in made_up(curves, error).line()


def test_the_area_is_that_of_all_curves_within_the_distance(made_up):
    """It changes by at most the distance times twice |L| plus the distance of the slopes."""
    area = made_up()
    assert area.verdict == "proved"
    section = float(PAPER.area())
    inside = float(arb(area.digits["share"].split()[0].strip("["))) - 0.0069
    for factor, proved in ((0.99, True), (1.01, False)):
        for slope, size in (("0", 4), ("5", 9)):
            result = made_up(distance=f"{factor * inside * section / size:.12e}", slope=slope)
            assert (result.verdict == "proved") == proved
            assert proved or "not proved to enclose" in result.line()


@pytest.mark.parametrize(("rows", "reason"), [
    ([[1, 0]] * 2, "has 2 coefficients, not 3 to"),
    ([[1, 0]] * 3, ""), ([[1, 0]] * curve.MOST_MODES, ""),
    ([[1, 0]] * (curve.MOST_MODES + 1), "coefficients, not 3 to"),
    ([[1, 1]] * 3, "the coefficient of sin"),
])  # fmt: skip
def test_a_curve_has_a_bounded_number_of_coefficients(rows, reason):
    with told(reason):
        curve._first_curve(SimpleNamespace(numbers=lambda field, size: rows))
