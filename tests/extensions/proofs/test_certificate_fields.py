"""Reading of certificates, and the small functions by which checkers compare: each condition."""

from fractions import Fraction
from math import inf, nan

import pytest
from flint import arb, ctx

from extensions.proofs import Surface
from extensions.proofs.checkers.certificate import (
    MOST_DIGITS,
    Certificate,
    Finding,
    NotProvedError,
    box,
    check_stated,
    check_within,
    holds_throughout,
    lower_bound,
    naming,
)
from extensions.proofs.enclosure.surface import ball_of
from helpers.parts.certificates import told

BALL = Fraction(1, 5), Fraction(1, 25)
PAPER = Surface(*BALL, "1/100")
TEXT = 'kind = "test"\nk = "1/5"\ng = "1/25"\nenergy = "1/100"\n'


def of(field, **given):
    return Certificate(TEXT + field, "test", **given)


@pytest.mark.parametrize(("text", "given", "reason"), [
    ("kind = ", {}, "cannot be read"), (f"{TEXT}a = {'[' * 10_000}", {}, "cannot be read"),
    ('kind = "tes"', {}, "not one of kind 'test'"),
    ("", {}, "not one of kind 'test'"),
    (TEXT.replace("1/5", "1/4"), {"surface": PAPER}, "of k 1/4, not 1/5"),
    (TEXT.replace("1/25", "1/24"), {"surface": PAPER}, "of g 1/24, not 1/25"),
    (TEXT.replace("1/100", "1/99"), {"surface": PAPER}, "is of k = 1/5, g = 1/25, E = 1/99, the"),
    (TEXT.replace("1/5", "1/4"), {"ball": BALL}, "of k 1/4, not 1/5"),
    (TEXT.replace("1/25", "1/24"), {"ball": BALL}, "of g 1/24, not 1/25"),
    (TEXT.replace('"1/5"', "0.2"), {"ball": BALL}, ""),
    (TEXT.replace('"1/5"', "1"), {"ball": (Fraction(1), BALL[1])}, "k is missing or of another"),
    (TEXT.replace("1/100", "-1/250"), {"surface": PAPER}, "energy = -1/250 is not allowed"),
    (TEXT, {"surface": PAPER}, ""),
    *((TEXT.replace("1/5", k).replace("1/25", g), {"ball": (Fraction(k), Fraction(g))}, reason)
      for k, g, reason in (("0", "1/25", "no ball has"), ("6/5", "1/25", "no ball has"),
                           ("1/5", "0", "no ball has"), ("1/5", "-1", "no ball has"),
                           ("-1/5", "1/25", "no ball has"), ("1", "9", ""))),
])  # fmt: skip
def test_a_certificate_has_its_kind_its_ball_and_its_energy(text, given, reason):
    with told(reason):
        Certificate(text, "test", **given)


LONG, ZEROS = "9" * MOST_DIGITS, "0" * MOST_DIGITS


FORM, ROW, TWO = "missing or of another form", "no row of 2 numbers", Fraction(2)


@pytest.mark.parametrize(("value", "method", "given", "expected"), [
    ("0.1", "number", [], Fraction(1, 10)), (LONG, "number", [], int(LONG)),
    ("[[1, 0.5], [2, 3]]", "numbers", [2], [[1, Fraction(1, 2)], [2, 3]]),
    ("[1, 2, 3]", "row", [3], [1, 2, 3]), ("7", "whole", [], 7), ("[]", "whole_numbers", [], []),
    ("[1, 2]", "whole_numbers", [], [1, 2]), ("2", "at_least", [TWO], 2),
    ("2", "at_most", [TWO], 2), ("2", "check", [TWO], None),
    *((number, "number", [], "more than 100 digits")
      for number in (f"1{ZEROS}", f"-1{ZEROS}", f'"1/1{ZEROS}"')),
    ("nan", "number", [], "not an exact number"),
    ('"\u0661/\u0665"', "number", [], "not an exact number"), ("1", "number", [str], FORM),
    ("1\na = 1", "number", [], "cannot be read"), ("[]", "numbers", [2], "no rows"),
    ("[[1, 2], [1]]", "numbers", [2], ROW), ("[[1, 2], [1, 2, 3]]", "numbers", [2], ROW),
    ('[[1, 2], "12"]', "numbers", [2], ROW), ("[1, 2]", "row", [3], "no row of 3 numbers"),
    ("true", "whole", [], FORM), ("[1, 1.5]", "whole_numbers", [], "no list of whole numbers"),
    ("[1, true]", "whole_numbers", [], "no list of whole numbers"),
    ("1.9", "at_least", [TWO], "a is 1.9, not 2 as stated"),
    ("2.1", "at_most", [TWO], "a is 2.1, not above 0 and at most 2"),
    ("0", "at_most", [TWO], "a is 0, not above 0 and at most 2"),
    ("3", "check", [TWO], "of a 3, not 2"),
])  # fmt: skip
def test_a_field_has_its_form_and_its_bounds(value, method, given, expected):
    with told(expected if isinstance(expected, str) else ""):
        assert getattr(of(f"a = {value}"), method)("a", *given) == expected


@pytest.mark.parametrize("margin", [-0.1, 0.0, inf, -inf, nan])
def test_each_margin_is_positive_and_finite(margin):
    assert Finding({}, {"beyond": 5e-324, "room": 1e308}).margins
    for margins in ({"room": margin, "beyond": 1.0}, {"beyond": 1.0, "room": margin}):
        with pytest.raises(NotProvedError, match="the margin room is"):
            Finding({}, margins)


@pytest.mark.parametrize(("values", "reason"), [
    ((arb(1), arb(2)), ""), ((arb(1, 0.05), arb(2.05)), ""), ((arb(0.95), arb(1.95)), ""),
    ((arb(1), arb(2.2)), "the event is not the stated one, near 2"),
    ((arb(1), arb(1.8)), "the event is not the stated one, near 2"),
    ((arb(1.2), arb(2)), "the event is not the stated one, near 1"),
    ((arb(1), arb(2.125)), "not the stated one"), ((arb(1), arb(2, 0.2)), "enclosed too widely"),
    ((arb(1), arb("nan")), "enclosed too widely"),
])  # fmt: skip
def test_enclosures_are_near_the_stated_numbers(values, reason):
    with told(reason):
        check_stated("event", values, [Fraction(1), Fraction(2)], Fraction(1, 10))
    with pytest.raises(NotProvedError, match="too widely"):  # not below the error
        check_stated("event", [arb(1.125)], [Fraction(1)], Fraction(1, 8))


@pytest.mark.parametrize(("value", "inside"), [
    (arb(0.5, 0.4), True), (arb(0.1, 0.2), False), (arb(0.9, 0.2), False), (arb(0), False),
    (arb(1), False), (arb(-1), False), (arb(2), False), (arb("nan"), False),
])  # fmt: skip
def test_a_quantity_lies_within_its_limits(value, inside):
    with told("" if inside else "the energy is not proved to lie where"):
        check_within("energy", value, (Fraction(0), Fraction(1)))


@pytest.mark.parametrize("place", [0, 0.001, 0.3, 0.5, 0.77, 1])
def test_a_property_that_fails_at_one_place_does_not_hold_throughout(place):
    tried = []

    def holds(t):
        tried.append(t)
        return t.rad() < 0.3 and not t.contains(place)

    assert not holds_throughout(holds, arb(0), arb(1), arb(1e-3))
    assert min(float(t.rad()) for t in tried) > 2.4e-4
    tried.clear()
    assert holds_throughout(lambda t: tried.append(t) or t.rad() < 0.1, arb(0), arb(1), arb(1e-3))
    pieces = [t for t in tried if t.rad() < 0.1]
    for at in (0, 0.0625, 0.3, 0.5, 0.9, 1):
        assert any(t.contains(at) for t in pieces)


@pytest.mark.parametrize(("low", "high", "width"), [
    (arb(0, 1e-9), arb(1), arb(1)), (arb(0), arb(1, 1e-9), arb(1)), (arb(1), arb(0), arb(1)),
    (arb(0), arb(1), arb(0)), (arb(0), arb(1), arb(-1)), (arb(0), arb(1), arb("nan")),
])  # fmt: skip
def test_an_interval_has_exact_ends_in_order_and_a_width(low, high, width):
    with pytest.raises(NotProvedError, match="an interval is not one"):
        holds_throughout(lambda _: True, low, high, width)


@pytest.mark.parametrize("bits", [53, 20, 400])
def test_a_box_contains_all_points_within_its_radius(bits):
    centre, radius = [Fraction(1, 3), Fraction(-2, 7)], Fraction(1, 10**9)
    with ctx.workprec(bits):
        sides = box(centre, radius)
    with ctx.workprec(600):
        for side, c in zip(sides, centre, strict=True):
            for end in (c - radius, c, c + radius):
                assert side.lower() <= ball_of(end) <= side.upper()
            assert side.rad() < 1.1e-9 or bits == 20
    for wrong in (Fraction(0), -radius):
        with pytest.raises(NotProvedError, match="is no size of a box"):
            box(centre, wrong)


@pytest.mark.parametrize("text", ["1/3", "-1/3", "0", "1e-320", "-1e-320", "5", "-7"])
def test_a_lower_bound_is_rounded_down(text):
    value = ball_of(Fraction(text))
    for it in (value, value + arb(0, 1e-3)):
        low = lower_bound(it)
        assert arb(low) <= it.lower()
        assert low >= float(it.lower()) * (1 - 4.5e-16 if it > 0 else 1 + 4.5e-16) - 1e-323
    with ctx.workprec(200):
        for change in (Fraction(1, 10**40), -Fraction(1, 10**40)):
            value = ball_of(Fraction(text) + change)
            assert arb(lower_bound(value)) <= value


def test_a_reason_begins_with_what_could_not_be_enclosed():
    with pytest.raises(NotProvedError, match=r"^the box: no$"), naming("the box"):
        raise NotProvedError("no")
