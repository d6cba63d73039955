"""Interval Newton and periodic orbits: enclosures, and premises one by one."""

from fractions import Fraction
from itertools import product
from types import SimpleNamespace

import pytest
from flint import arb, ctx

from extensions.proofs import THEOREMS, Surface
from extensions.proofs.checkers import newton, periodic
from extensions.proofs.checkers.certificate import NotProvedError
from helpers.parts.certificates import numbers, refused, told, with_rows

PAPER = Surface("1/5", "1/25", "1/100")


@pytest.fixture(autouse=True)
def bits():
    with ctx.workprec(160):
        yield


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
    with told(reason):
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
    with told("" if type else "type is not proved"):
        assert orbit_of([[trace, 1], [-1, 0]]).type == type


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
    with told("" if distinct else "period may be shorter"):
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
