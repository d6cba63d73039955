"""The twist at all energies, by other methods, and the certificates that are refused."""

from fractions import Fraction
from itertools import pairwise

import pytest
from certificates import numbers, refused, with_field, with_rows
from flint import arb, ctx

from extensions.proofs import THEOREMS, Surface
from extensions.proofs.checkers import one_zero, periodic
from extensions.proofs.checkers.certificate import NotProvedError
from extensions.proofs.checkers.fixed_point import energy_at
from extensions.proofs.checkers.twist import normal_form
from extensions.proofs.enclosure.surface import ball_of
from extensions.proofs.search.periodic import approximate_points

NAME = "twist-one-zero"
BALL = Fraction(1, 5), Fraction(1, 25)


def at(theta, ball=BALL):
    """cos(omega) and theta tau_1 at one theta."""
    pairs = one_zero.over_band(*ball, Fraction(theta), Fraction(theta))[:2]
    return [value for value, _ in pairs]


@pytest.mark.parametrize("theta", ["0.4", "1.5", "2.05", "2.3"])
def test_the_twist_is_that_of_birkhoffs_normal_form(theta):
    """The normal form takes flights and the fixed point from the map over a ball instead."""
    with ctx.workprec(periodic.BITS):
        cosine, twist = at(theta)
        energy = energy_at(*map(ball_of, BALL), arb(theta))
        surface = Surface(*BALL, Fraction(float(energy)))
        point = approximate_points(surface, 1, "elliptic")
        centres = [[Fraction(a) for a in z] for z in point]
        orbit = periodic.prove(surface, centres, Fraction(1, 10**8))
        form = normal_form(surface, orbit)
        assert abs(orbit.trace / 2 - cosine) < 1e-13
        assert abs(form.twists[0] - twist / arb(theta)) < 1e-11


@pytest.mark.slow
def test_bands_enclose_the_values_inside_them_and_slopes_are_those_of_differences():
    with ctx.workprec(one_zero.BITS):
        for ends in (("0", "0.05"), ("1.97", "1.98"), ("2.3", "2.305")):
            low, high = map(Fraction, ends)
            *pairs, _ = one_zero.over_band(*BALL, low, high)
            values = [at(low + (high - low) * n / 3) for n in range(4)]
            for place, (value, slope) in enumerate(pairs):
                assert all(value.overlaps(row[place]) for row in values)
                for a, b in pairwise(values):
                    assert slope.overlaps((b[place] - a[place]) * 3 / arb(float(high - low)))


@pytest.mark.parametrize("kind", ["sine", "versine"])
def test_coefficients_over_a_ball_enclose_those_at_its_points(kind):
    with ctx.workprec(one_zero.BITS):
        terms = one_zero._even_function(kind, arb(3.31, 0.02), 3)
        for point in (3.295, 3.325):
            inner = one_zero._even_function(kind, arb(point), 3)
            assert all(ball.contains(term) for ball, term in zip(terms, inner, strict=True))


def test_a_function_falls_through_zero_once_only():
    plus, minus, falls = (arb(1), arb(0, 9)), (arb(-1), arb(0, 9)), (arb(0, 1), arb(-1))

    def margin(rows):
        return one_zero.margin_of_one_zero([one_zero.Enclosed(*row) for row in rows], "zero")

    assert margin([plus, falls, falls, minus, minus]) == 1
    for rows in (
        [plus, minus, plus, minus],
        [plus, falls, minus, falls, minus],
        [falls, minus],
        [plus, falls],
        [plus, plus],
        [plus, (arb(0, 1), arb(1)), minus],
        [plus, (arb("nan"), arb("nan")), minus],
    ):
        with pytest.raises(NotProvedError, match="only one"):
            margin(rows)


def test_other_bands_are_refused():
    text = THEOREMS[NAME].text()
    edges = numbers(text, "edges")
    for rows, reason in (
        (edges[1:], "do not rise from"),
        ([edges[0], edges[2], edges[1], *edges[3:]], "do not rise from"),
        (edges[:-2], "not proved to reach"),
        (edges[:1], "edges, not 2"),
        ([edges[0], *edges[15:]], ""),
    ):
        assert reason in refused(NAME, with_rows(text, "edges", rows))


@pytest.mark.parametrize("name", ["zero", "resonance"])
@pytest.mark.parametrize(("row", "reason"), [
    ("[1.9, 1.91]", "certificate's theta"), ("[1.98, 2.2]", "statement's energies"),
    ("[2.0, 2.0]", "no interval"), ("[1.9, 3.1]", "no interval"),
])  # fmt: skip
def test_a_zero_elsewhere_or_less_precise_is_refused(name, row, reason):
    """A wide interval is consistent, and proves less than the statement."""
    assert reason in refused(NAME, with_field(THEOREMS[NAME].text(), name, row))


def test_no_band_contains_the_resonance_of_order_three():
    """At this ball it lies below E = 0.01; the twist has a pole there."""
    ball = Fraction(3, 10), Fraction(1, 50)
    with ctx.workprec(one_zero.BITS):
        at("2.14", ball)
        with pytest.raises(NotProvedError, match="third power"):
            one_zero.over_band(*ball, Fraction("2.25"), Fraction("2.27"))
