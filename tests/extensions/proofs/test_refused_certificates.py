"""Certificates that prove nothing: altered, foreign, unreadable, or of less than the statement."""

import re
from fractions import Fraction
from math import atan2, pi, tan

import pytest
from certificates import (
    ONE_OF_EACH,
    by_both,
    numbers,
    refused,
    with_bounds,
    with_field,
    with_rows,
)
from flint import arb
from second_checker import STATEMENTS, ImpactMap, prove_orbit
from second_checker import NotProvedError as SecondNotProvedError
from slowly import slowly

from extensions.proofs import THEOREMS, Surface
from extensions.proofs.checkers import fixed_point, horseshoe, jump, periodic
from extensions.proofs.checkers.certificate import NotProvedError
from extensions.proofs.checkers.hsets import HSet
from extensions.proofs.search import jump as jump_search
from extensions.proofs.search.fixed_point import propose_elliptic, propose_unique
from extensions.proofs.search.periodic import approximate_points
from extensions.proofs.theorems import statements
from pseudorigid import Ball, symmetric_orbits

ORBITS = [name for name, theorem in THEOREMS.items() if theorem.checker is periodic.check]
CHECKERS = ["package", *slowly("second")]
# Fields of which leading digits are changed.
FIELDS = {
    "points", "radius", "saddles", "approach", "middle", "width", "twist", "energy", "point",
    "near_image", "far_image", "outer_end", "inner_end", "speed", "roots", "energy_below",
    "energy_up_to", "theta_below", "theta", "trace_above", "zero", "resonance",
    "event",
}  # fmt: skip

# A theorem, a field, and the place of one of its sets: first ones, inner ones and last ones.
SETS = [("horseshoe-outer", "approach", 0), ("horseshoe-inner", "approach", -2),
        ("entropy-lower", "sets", 0), ("no-circle", "chain", 1)]  # fmt: skip
# Columns of a set that are multiplied by a factor and moved by half the columns so much further on.
CHANGES = [((2, 3), Fraction("1.3"), None), ((4, 5), Fraction("0.7"), None),
           ((0, 1), 1, 2), ((0, 1), 1, 4)]  # fmt: skip


@pytest.mark.parametrize(("checker", "name", "field", "place"), [
    *(("package", *sets) for sets in SETS),
    *slowly(("package", "entropy-lower", "chains", -1)),
    *slowly(*(("second", *sets) for sets in SETS if sets[0] in STATEMENTS)),
])  # fmt: skip
@pytest.mark.parametrize(("columns", "factor", "shift"), CHANGES)
def test_sets_that_are_wider_thinner_or_shifted_are_refused(
    checker, name, field, place, columns, factor, shift
):
    rows = numbers(THEOREMS[name].text(), field)
    values = [Fraction(a) for a in rows[place]]
    for i in columns:
        values[i] = values[i] * factor + (values[i + shift] / 2 if shift else 0)
    rows[place] = [f'"{value}"' for value in values]
    reason = refused(name, with_rows(THEOREMS[name].text(), field, rows), checker)
    assert re.search("cover|floor|set", reason) or (checker == "second" and "cone" in reason)


@pytest.mark.parametrize(("checker", "name"), by_both(ONE_OF_EACH))
@pytest.mark.parametrize(("field", "value"), [("k", "1/4"), ("g", "1/24"), ("energy", "1/99")])
def test_certificates_of_another_ball_or_energy_are_refused(checker, name, field, value):
    text = THEOREMS[name].text()
    other = with_field(text, field, f'"{value}"')
    if other != text:
        reason = refused(name, other, checker)
        # the zero of the twist is proved at the certificate's own energy
        assert "the certificate is of" in reason or (name, field) == ("twist-zero", "energy")


@pytest.mark.parametrize(("checker", "name"), by_both(ONE_OF_EACH))
def test_unreadable_certificates_are_refused(checker, name):
    text = THEOREMS[name].text()
    for broken in (
        "", text[: len(text) // 2], text.replace("k = ", "kk = "),
        with_field(text, "kind", '"poem"'), re.sub(r"\d+", "x", text),
    ):  # fmt: skip
        refused(name, broken, checker)
    assert "cannot be read" in refused(name, text + "more = " + "[" * 10_000, checker)
    arabic = text.replace('k = "1/5"', 'k = "\u0661/\u0665"')
    assert "not an exact number" in refused(name, arabic, checker)
    for field in ("points", "saddles", "approach", "middle", "margins", "roots", "leaves"):
        for value in ("5", "[]", "[[]]", "[[[1, 2], 3]]", "1979-05-27"):
            pattern = re.compile(rf"^{field} = (\[\n.*?^\]|.*?$)", re.DOTALL | re.MULTILINE)
            if (other := pattern.sub(f"{field} = {value}", text)) != text:
                refused(name, other, checker)
    for number in ("1e-999999999", '"1e999999999"', '"1_0.5"', "true", '"1/0"', "[1]"):
        for field in ("k", "energy", "energy_up_to", "energy_below", "radius"):
            if (other := with_field(text, field, number)) != text:
                refused(name, other, checker)


@pytest.mark.parametrize(("checker", "name"), by_both([*ORBITS, "twist-six"]))
def test_boxes_of_another_size_and_points_of_another_orbit_are_refused(checker, name):
    theorem = THEOREMS[name]
    text, points = theorem.text(), numbers(theorem.text(), "points")
    radius, period = theorem.bounds["radius"], theorem.bounds["period"]
    if name in ORBITS:
        smaller = with_field(text, "radius", f'"{radius / 2}"')
        assert "as stated" in refused(name, smaller, checker)
        refused(name, with_field(text, "radius", f'"{40 * radius}"'), checker)
    for rows in (points + points, points[:-1] or points * 2):
        assert f"points, not {period}" in refused(name, with_rows(text, "points", rows), checker)
    (point,) = approximate_points(theorem.bounds["surface"], 1, "elliptic")
    refused(name, with_rows(text, "points", [map(repr, point)] * period), checker)


@pytest.mark.parametrize("checker", CHECKERS)
def test_an_orbit_of_another_type_is_refused(checker):
    reason = refused("six-elliptic", THEOREMS["six-hyperbolic"].text(), checker)
    assert "hyperbolic, not" in reason or "to be elliptic" in reason


@pytest.mark.parametrize(("prove", "at", "error"), [
    (periodic.prove, Surface, NotProvedError),
    *slowly((prove_orbit, ImpactMap, SecondNotProvedError)),
])  # fmt: skip
def test_an_orbit_run_through_twice_is_no_orbit_of_twice_the_period(prove, at, error):
    constants = [Fraction(value) for value in ("1/3", "1/25", "1/10")]
    points = approximate_points(Surface(*constants), 3, "hyperbolic")
    centres = [[Fraction(a) for a in point] for point in points]
    radius = Fraction(1, 10**9)
    assert prove(at(*constants), centres, radius)
    with pytest.raises(error, match="period may be shorter"):
        prove(at(*constants), centres * 2, radius)


@pytest.mark.parametrize("checker", CHECKERS)
@pytest.mark.parametrize(("energy", "roots", "stated", "reason"), [
    ("11/6251", None, "11/6250", "not 11/6250|energy_below"),
    # consistent with the energy, which is not the statement's
    ("0.00129", ("-0.03", "0.43"), "11/6250", "not 11/6250|energy_below"),
    ("11/6250", ("-0.03", "0.43"), "11/6250", "product of factors"),
    ("0.00225", ("-0.05", "0.45"), "0.00225", "negative for x < -g"),  # flights touch below it
])  # fmt: skip
def test_the_map_is_not_proved_smooth_below_another_energy(energy, roots, stated, reason, checker):
    text = with_field(THEOREMS["diffeomorphism"].text(), "energy_below", f'"{energy}"')
    if roots:
        text = with_field(text, "roots", f'["{roots[0]}", "{roots[1]}"]')
    assert re.search(reason, refused("diffeomorphism", text, checker, energy=Fraction(stated)))


def only_fixed_point(k, g, energy):
    """The certificate of one fixed point up to an energy of a ball."""
    return propose_unique(with_bounds(THEOREMS["one-fixed-point"], k=k, g=g, energy=energy))


def elliptic(k, g, energy, trace):
    """The certificate of an elliptic fixed point up to an energy of a ball."""
    theorem = with_bounds(THEOREMS["fixed-point-elliptic"], k=k, g=g, energy=energy, trace=trace)
    return propose_elliptic(theorem)


def test_one_fixed_point_is_proved_neither_to_a_lower_energy_nor_where_there_are_three():
    ball, low = (Fraction(1, 5), Fraction(1, 25)), Fraction(1, 100)
    text = only_fixed_point(*ball, low)
    assert fixed_point.check_unique(text, *ball, low)
    assert "up to 1/100" in refused("one-fixed-point", text)
    assert symmetric_orbits(Ball(k=0.2, g=0.01), 0.03, 1).sizes["orbit"] == 3
    k, g, energy = Fraction(1, 5), Fraction(1, 100), Fraction(3, 100)
    text = only_fixed_point(k, g, energy)
    with pytest.raises(NotProvedError, match="second fixed point is not excluded"):
        fixed_point.check_unique(text, k, g, energy)


def test_the_fixed_point_is_proved_elliptic_neither_to_another_energy_nor_where_it_is_not():
    ball, trace = (Fraction(1, 5), Fraction(1, 25)), Fraction("-0.46")
    for energy in (Fraction(1, 20), Fraction(61, 1000)):
        text = elliptic(*ball, energy, Fraction("-0.5"))
        assert fixed_point.check_elliptic(text, *ball, energy, Fraction("-0.5"))
        assert f"up to {energy}" in refused("fixed-point-elliptic", text)
    # At k = 1 and this energy the fixed point has long been inverse hyperbolic.
    text = elliptic(Fraction(1), Fraction(1, 25), Fraction(1, 10), Fraction(-3))
    with pytest.raises(NotProvedError, match="not proved to be above"):
        fixed_point.check_elliptic(text, Fraction(1), Fraction(1, 25), Fraction(1, 10), trace * 10)


# ---- certificates that are consistent and prove less than the statement


STRONGER = [
    *((name, "radius", lambda radius: radius * Fraction(101, 100))
      for name in [*ORBITS, "twist-six"]),
    *((name, "window", lambda window: tuple((low, low) for low, _ in window))
      for name in [*ORBITS, "twist-six", "horseshoe-outer", "no-circle"]),
    ("horseshoe-outer", "crossing", lambda sides: (sides[0] + Fraction(1, 1000), sides[1] + 1)),
    *((name, "entropy", lambda entropy: entropy * Fraction(102, 100))
      for name in ("horseshoe-outer", "entropy", "entropy-lower")),
    *((name, "energy", lambda energy: energy * Fraction(101, 100))
      for name in ("one-fixed-point", "fixed-point-elliptic", "diffeomorphism", "twist-one-zero")),
    ("fixed-point-elliptic", "trace", lambda trace: trace * Fraction(99, 100)),
    ("jump-set", "length", lambda length: length + Fraction(1, 10**4)),
    ("jump-set", "jump", lambda jump: jump + Fraction(1, 10**3)),
    ("twist-zero", "width", lambda width: width / 2),
    ("unstable", "margin", lambda margin: margin + Fraction(1, 100)),
    ("unstable", "energies", lambda sides: (sides[0], sides[0] + (sides[1] - sides[0]) / 20)),
    *(("twist-one-zero", name, lambda sides: (sides[0], sides[0] + (sides[1] - sides[0]) / 5))
      for name in ("zero", "resonance")),
]  # fmt: skip


@pytest.mark.parametrize(("checker", "name", "bound", "change"), [
    *(("package", *row) for row in STRONGER),
    *slowly(*(("second", *row) for row in STRONGER if row[0] in STATEMENTS)),
])  # fmt: skip
def test_a_stronger_statement_is_not_proved_by_the_same_certificate(checker, name, bound, change):
    refused(name, None, checker, **{bound: change(THEOREMS[name].bounds[bound])})


@pytest.mark.parametrize("name", THEOREMS)
def test_no_number_of_a_statement_is_typed(name):
    formulas = r"{.*?}|y = 0|g\^2/|\(2k\)|lambda\^\d"
    assert not re.search(r"\d", re.sub(formulas, "", THEOREMS[name].wording))


@pytest.mark.parametrize("checker", CHECKERS)
@pytest.mark.parametrize(("margin", "reason"), [
    ("-1.0", "below 0"), ("nan", "margins"), ("inf", "margins"), ("0.9", "by less than is stated"),
])  # fmt: skip
def test_stated_margins_that_no_covering_has_are_refused(checker, margin, reason):
    text = THEOREMS["horseshoe-outer"].text()
    rows = [[margin, margin] for _ in numbers(text, "margins")]
    assert reason in refused("horseshoe-outer", with_rows(text, "margins", rows), checker)


@pytest.mark.parametrize("centre", [0.7, 0.785, 0.79, 1.2, 1.5707])
@pytest.mark.parametrize("signs", [(1, 1), (-1, 1), (1, -1)])
def test_the_crossing_angle_is_acute_even_near_a_right_angle(centre, signs):
    """The angle between (x, y) and (x, -y), for all slopes of a wide ball."""
    axes = (arb(signs[0]), arb(0)), (arb(0), arb(signs[1]))
    tangents = [tan(min(centre + offset, 1.57)) for offset in (-0.1, -0.03, 0.04, 0.1)]
    slope = arb(tangents[0]).union(arb(tangents[-1]))
    angle = horseshoe._crossing_angle(HSet("M_0", (arb(0), arb(0)), *axes), slope)
    for tangent in tangents:
        half = atan2(tangent, 1.0)
        assert angle.overlaps(arb(min(2 * half, pi - 2 * half), 1e-12))


def test_a_jump_set_of_coarser_points_or_of_part_of_the_curve_is_refused(monkeypatch):
    theorem = THEOREMS["jump-set"]
    # another point of the curve is as good: the statement is about the one that is printed
    other = theorem.check(jump_search.propose(theorem, "-0.05"))
    assert other.digits["point x"] != theorem.check().digits["point x"]
    assert other.verdict == "proved"
    # near the inner end the jump vanishes
    inner = jump_search.propose(theorem, "-0.117")
    assert "within 0.27" in refused("jump-set", inner)
    whole = jump.curve
    monkeypatch.setattr(jump, "curve", lambda surface, count: whole(surface, count)[:-2])
    assert "longer than 0.4048" in refused("jump-set")


def leading_digits(text):
    """(field, number, certificate) of each number of FIELDS with another leading digit."""
    start, field = 0, None
    for line in text.splitlines(keepends=True):
        named = re.match(r"(\w+) = ", line)
        field = named.group(1) if named else field
        values = named.end() if named else 0
        if field in FIELDS and not line.startswith(("#", "]")):
            for number in re.finditer(r"-?\d[\d.e-]*", line[values:]):
                if digit := re.search(r"[1-9]", number.group(0)):
                    at = start + values + number.start() + digit.start()
                    other = "2" if text[at] == "1" else "1"
                    yield field, number.group(0), f"{text[:at]}{other}{text[at + 1 :]}"
        start += len(line)


@pytest.mark.parametrize(("checker", "name"), by_both(THEOREMS))
def test_no_leading_digit_may_change(checker, name):
    """Of any number of a short certificate, and of one in each field of a long one."""
    changes = list(leading_digits(THEOREMS[name].text()))
    if len(changes) > 30:
        groups = ([change for change in changes if change[0] == field] for field in FIELDS)
        changes = [group[len(group) // 3] for group in groups if group]
    assert changes
    for field, number, changed in changes:
        if (checker, field) != ("second", "radius"):  # it proves larger boxes too
            assert refused(name, changed, checker), number


def test_random_bytes_and_a_missing_file_are_no_certificate(monkeypatch, tmp_path):
    monkeypatch.setattr(statements.resources, "files", lambda package: tmp_path)
    assert "there is no such certificate" in refused("fixed-point")
    (tmp_path / "certificates").mkdir()
    (tmp_path / "certificates" / "fixed-point.toml").write_bytes(b"\xff\x00" * 1000)
    assert "the certificate cannot be read" in refused("fixed-point")
