"""Jets, interval Newton and periodic orbits: enclosures, and premises one by one."""

from fractions import Fraction
from itertools import product
from operator import mul
from types import SimpleNamespace

import pytest
from certificates import numbers, refused, with_rows
from flint import acb, arb, ctx

from extensions.proofs import THEOREMS, Surface
from extensions.proofs.checkers import newton, periodic
from extensions.proofs.checkers.certificate import NotProvedError
from extensions.proofs.enclosure import jets
from extensions.proofs.enclosure.jets import Jet

PAPER = Surface("1/5", "1/25", "1/100")


@pytest.fixture(autouse=True)
def bits():
    with ctx.workprec(160):
        yield


# ---- jets


def sine_cosine(x):
    return x.sin_cos()


EXPRESSIONS = {
    "ring": lambda x, y: 3 - x * y * y * 2 + (x - 1) * (-y) + y / 4,
    "inverse": lambda x, y: (x + 2) / (3 + x * y) - 1 / (1 + y),
    "root": lambda x, y: jets.square_root(2 + x + y * y * x) * y,
    "sine": lambda x, y: sine_cosine(x * y + x)[0] * y + sine_cosine(y - x)[1],
}


@pytest.mark.parametrize("name", EXPRESSIONS)
@pytest.mark.parametrize("kind", [arb, acb])
@pytest.mark.parametrize("order", [1, 3, 5])
def test_a_series_is_the_function_up_to_its_order(name, kind, order):
    """Next to a point, and over a ball it encloses the series at the ball's points."""
    function, at, h = EXPRESSIONS[name], (kind("0.3"), kind("0.7")), arb("1e-5")
    if kind is acb and name == "sine":
        return  # only flights at complex points use it, whose sine test_curve_checker.py tests
    if kind is acb:
        at = acb("0.3", "0.2"), acb("0.7", "-0.1")
    series = function(*Jet.plane(order, *at))
    for u, v in ((1, 0), (0, 1), (1, -2)):
        powers = ((u * h) ** i * (v * h) ** j for i, j in series.algebra.monomials)
        total = sum(map(mul, series.coefficients, powers), kind(0))
        assert abs(total - function(at[0] + u * h, at[1] + v * h)) < 1e4 * h ** (order + 1)
    ball = arb(0, 0.05) if kind is arb else acb(arb(0, 0.05), arb(0, 0.05))
    wide = function(*Jet.plane(order, *(a + ball for a in at)))
    for u, v in product((-0.0499, 0.0499), repeat=2):
        inner = function(*Jet.plane(order, at[0] + u, at[1] + v))
        pairs = zip(wide.coefficients, inner.coefficients, strict=True)
        assert all(a.contains(b) for a, b in pairs)


def test_monomials_with_a_parameter_have_a_degree_of_their_own():
    series = jets.algebra(2, 2, 1)
    assert series.order == 3 and len(series.monomials) == 6 * 2
    x, y, t = Jet.series(series, arb(0), arb(0), arb(2))
    product_ = x * y * t * (1 + t)
    assert product_[1, 1, 0] == 6 and product_[1, 1, 1] == 5
    assert Jet.constant_of(series, arb(4)).constant == 4


def test_a_polynomial_of_jets_is_substituted_term_by_term():
    z, w = Jet.plane(3, acb(0), acb(0))
    first, second = z * 2 + w * w, w - z * w
    found = (z * z * w + w * 3 + 5).at(first, second)
    expected = first * first * second + second * 3 + 5
    assert all(abs(a - b) < 1e-40 for a, b in
               zip(found.coefficients, expected.coefficients, strict=True))  # fmt: skip
    for bad in ((z + 1, w), (z, w + 1)):
        with pytest.raises(ValueError, match="not 0 at 0"):
            z.at(*bad)


def test_the_root_of_a_wide_complex_set_has_those_of_its_points():
    square = acb(arb(2, 0.5), arb(1, 0.4))
    root = jets.square_root(square)
    for u, v in product((-0.499, 0, 0.499), (-0.399, 0, 0.399)):
        assert root.contains(acb(2 + u, 1 + v).sqrt())
    assert root.rad() < 0.4
    for bad in (acb(arb(0, 0.1), 1), arb(0), arb(-1), Jet.plane(1, arb(-1), arb(0))[0]):
        with pytest.raises(ArithmeticError, match="not proved to be analytic"):
            jets.square_root(bad)


# ---- interval Newton


def squares(values):
    """Equations x^2 = 1/4 and y = x, with zeros at +-(1/2, 1/2)."""
    x, y = values
    return [x * x - arb(0.25), y - x], [[2 * x, arb(0), arb(7)], [arb(-1), arb(1), arb(9)]]


@pytest.mark.parametrize(("box", "reason"), [
    ((arb(0.5, 0.2), arb(0.5, 0.4)), None),
    ((arb(0.2, 1), arb(0.2, 1)), "singular"),  # two zeros, and no singular slope at the middle
    ((arb(0.9, 0.2), arb(0.9, 0.2)), "does not lie inside"),
    ((arb(0.5, 0.2), arb(0.9, 0.2)), "does not lie inside"),
])  # fmt: skip
def test_a_box_with_one_zero_is_told_from_others(box, reason):
    if reason:
        with pytest.raises(NotProvedError, match=reason):
            newton.enclose_zero(squares, box)
    else:
        found = newton.enclose_zero(squares, box)
        assert all(a.contains(0.5) and a.rad() < 1e-40 for a in found)


def test_an_image_that_touches_the_boxs_side_proves_nothing():
    def system(values):
        return [values[0] - arb(0.5, 0.5)], [[arb(1)]]

    with pytest.raises(NotProvedError, match="does not lie inside"):
        newton.enclose_zero(system, [newton.newton(system, [arb(0.5, 0.5)])[0]])


# ---- periodic orbits


def orbit_of(rows, points=((0, 0),)):
    """Enclose a made-up orbit with the same derivative at each point."""
    surface = SimpleNamespace(jacobian=lambda x, y: ([[arb(a) for a in row] for row in rows], None))
    return periodic.enclose(surface, [tuple(map(arb, point)) for point in points])


@pytest.mark.parametrize(("trace", "type"), [
    (1.9, "elliptic"), (-1.9, "elliptic"), (2.1, "hyperbolic"), (-2.1, "inverse hyperbolic"),
    (arb(2, 0.01), None), (arb(-2, 0.01), None), (2, None), (arb("nan"), None),
])  # fmt: skip
def test_the_type_is_that_of_the_trace(trace, type):
    if type:
        assert orbit_of([[trace, 1], [-1, 0]]).type == type
    else:
        with pytest.raises(NotProvedError, match="type is not proved"):
            orbit_of([[trace, 1], [-1, 0]])


def test_derivatives_along_an_orbit_are_multiplied_in_order():
    derivatives = iter(([[0, 1], [-1, 0]], [[1, 3], [0, 1]]))
    surface = SimpleNamespace(
        jacobian=lambda x, y: ([[arb(a) for a in row] for row in next(derivatives)], None)
    )
    matrix = periodic.enclose(surface, [(arb(0), arb(0))] * 2).matrix
    assert [[float(a) for a in row] for row in matrix.table()] == [[-3, 1], [-1, 0]]


WINDOW = ((Fraction("0.0212"), Fraction("0.0213")), (Fraction("0.06"), Fraction("0.0601")))


@pytest.mark.parametrize(("axis", "end"), [*product((0, 1), (0, 1))])
def test_each_side_of_a_window_is_looked_at(axis, end):
    """With the orbit's other points far from it."""
    with ctx.workprec(periodic.BITS):
        orbit = THEOREMS["fixed-point"].prove().parts["orbit"]
        others = SimpleNamespace(type="elliptic", points=((arb(0), arb(0)), *orbit.points))
        periodic._check_properties(PAPER, others, "elliptic", WINDOW)
        window = [list(side) for side in WINDOW]
        window[axis][end] = window[axis][1 - end]  # no longer beyond the point on this side
        inner = (orbit.points[0][0], PAPER.velocities(*orbit.points[0])[0])[axis]
        window[axis][end] = Fraction(float(inner)) + (1 - 2 * end) * Fraction(1, 10**9)
        with pytest.raises(NotProvedError, match="statement's window"):
            periodic._check_properties(PAPER, others, "elliptic", window)


@pytest.mark.parametrize(("points", "distinct"), [
    ([(0, 0), (1, 0), (0, 1)], True), ([(0, 0), (1, 0), (0, 0)], False),
    ([(0, 0), (0, 0), (0, 1)], False), ([(0, 0), (1, 1), (arb(1, 0.1), arb(1, 0.1))], False),
])  # fmt: skip
def test_any_two_points_of_an_orbit_are_distinct(points, distinct):
    points = [tuple(map(arb, point)) for point in points]
    if distinct:
        periodic.check_distinct(points)
    else:
        with pytest.raises(NotProvedError, match="period may be shorter"):
            periodic.check_distinct(points)


def test_boxes_are_larger_than_the_certificates_by_the_points_error(monkeypatch):
    """So that they contain the stated boxes around the orbit's own points."""
    radii, prove = [], periodic.prove

    def recorded(surface, centres, radius):
        radii.append(radius)
        return prove(surface, centres, radius)

    monkeypatch.setattr(periodic, "prove", recorded)
    finding = THEOREMS["fixed-point"].prove()
    assert radii == [Fraction("4e-3") + Fraction(1, 10**30)]
    assert finding.margins == pytest.approx({"radius": 4e-3, "trace": 2 - 0.863285192982868})


@pytest.mark.parametrize("axis", [0, 1])
def test_points_agree_with_the_orbits_in_each_coordinate(axis):
    text = THEOREMS["fixed-point"].text()
    rows = numbers(text, "points")
    rows[0][axis] = f'"{Fraction(rows[0][axis]) + Fraction(2, 10**30)}"'
    assert "orbit's point is not the stated one" in refused(
        "fixed-point", with_rows(text, "points", rows))  # fmt: skip
