"""Certificates that prove nothing: altered, foreign, unreadable, or of less than the statement."""

import re
from fractions import Fraction

import pytest
from certificates import ONE_OF_EACH, by_both, numbers, refused, with_field, with_rows
from second_checker import STATEMENTS, ImpactMap, prove_orbit
from second_checker import NotProvedError as SecondNotProvedError
from slowly import slowly

from extensions.proofs import THEOREMS, Surface
from extensions.proofs.checkers import periodic
from extensions.proofs.checkers.certificate import NotProvedError
from extensions.proofs.search.periodic import approximate_points
from extensions.proofs.theorems import statements

ORBITS = [name for name, theorem in THEOREMS.items() if theorem.checker is periodic.check]
CHECKERS = ["package", *slowly("second")]
# Fields of which leading digits are changed.
FIELDS = {
    "points", "radius", "saddles", "approach", "middle", "width", "twist", "energy", "point",
    "near_image", "far_image", "outer_end", "inner_end", "speed", "roots", "energy_below",
    "energy_up_to", "theta_below", "theta", "trace_above", "zero", "resonance",
    "event",
}  # fmt: skip


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
    refused(name, text[: len(text) // 2], checker)
    assert "cannot be read" in refused(name, text + "more = " + "[" * 10_000, checker)
    arabic = text.replace('k = "1/5"', 'k = "\u0661/\u0665"')
    assert "not an exact number" in refused(name, arabic, checker)


@pytest.mark.parametrize(("checker", "name"), by_both([*ORBITS, "twist-six"]))
def test_more_or_fewer_points_than_the_period_are_refused(checker, name):
    text, period = THEOREMS[name].text(), THEOREMS[name].bounds["period"]
    points = numbers(text, "points")
    for rows in (points + points, points[:-1] or points * 3):
        assert f"points, not {period}" in refused(name, with_rows(text, "points", rows), checker)


@pytest.mark.parametrize(("prove", "at", "error"), [
    (periodic.prove, Surface, NotProvedError),
    *slowly((prove_orbit, ImpactMap, SecondNotProvedError)),
])  # fmt: skip
def test_an_orbit_run_through_twice_is_no_orbit_of_twice_the_period(prove, at, error):
    constants = [Fraction(value) for value in ("1/3", "1/25", "1/10")]
    points = approximate_points(Surface(*constants), 3, "hyperbolic")
    centres = [[Fraction(a) for a in point] for point in points]
    with pytest.raises(error, match="period may be shorter"):
        prove(at(*constants), centres * 2, Fraction(1, 10**9))


@pytest.mark.parametrize("checker", CHECKERS)
def test_an_orbit_of_another_type_is_refused(checker):
    reason = refused("six-elliptic", THEOREMS["six-hyperbolic"].text(), checker)
    assert "hyperbolic, not" in reason or "to be elliptic" in reason


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
