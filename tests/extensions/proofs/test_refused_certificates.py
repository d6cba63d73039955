"""Certificates that prove nothing: altered, foreign, unreadable, or of less than the statement."""

import re
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from extensions.proofs import THEOREMS, Surface
from extensions.proofs.checkers import periodic
from extensions.proofs.checkers.certificate import NotProvedError
from extensions.proofs.search.periodic import approximate_points
from extensions.proofs.theorems import statements
from helpers.parts.certificates import ONE_OF_EACH, altered, numbers, refused, with_field, with_rows
from helpers.random_documents import FUZZ, spoilt

ORBITS = [name for name, theorem in THEOREMS.items() if theorem.checker is periodic.check]


@pytest.mark.parametrize("name", ONE_OF_EACH)
@pytest.mark.parametrize(("field", "value"), [("k", "1/4"), ("g", "1/24"), ("energy", "1/99")])
def test_certificates_of_another_ball_or_energy_are_refused(name, field, value):
    text = THEOREMS[name].text()
    other = with_field(text, field, f'"{value}"')
    if other != text:
        reason = refused(name, other)
        # the zero of the twist is proved at the certificate's own energy
        assert "the certificate is of" in reason or (name, field) == ("twist-zero", "energy")


@pytest.mark.parametrize("name", [*ORBITS, "twist-six"])
def test_more_or_fewer_points_than_the_period_are_refused(name):
    text, period = THEOREMS[name].text(), THEOREMS[name].bounds["period"]
    points = numbers(text, "points")
    for rows in (points + points, points[:-1] or points * 3):
        assert f"points, not {period}" in refused(name, with_rows(text, "points", rows))


def test_an_orbit_run_through_twice_is_no_orbit_of_twice_the_period():
    surface = Surface("1/3", "1/25", "1/10")
    points = approximate_points(surface, 3, "hyperbolic")
    centres = [[Fraction(a) for a in point] for point in points]
    with pytest.raises(NotProvedError, match="period may be shorter"):
        periodic.prove(surface, centres * 2, Fraction(1, 10**9))


def test_an_orbit_of_another_type_is_refused():
    assert "hyperbolic, not" in refused("six-elliptic", THEOREMS["six-hyperbolic"].text())


@pytest.mark.parametrize("name", THEOREMS)
def test_no_number_of_a_statement_is_typed(name):
    formulas = r"{.*?}|y = 0|g\^2/|\(2k\)|lambda\^\d"
    assert not re.search(r"\d", re.sub(formulas, "", THEOREMS[name].wording))


@pytest.mark.parametrize("name", THEOREMS)
def test_no_leading_digit_may_change(name):
    changes = altered(THEOREMS[name].text())
    assert changes
    for _, number, text in changes:
        assert refused(name, text), number


@pytest.mark.slow
@settings(FUZZ, max_examples=200)
@given(st.data())
def test_a_certificate_with_any_damage_is_checked_or_refused_in_one_line(data):
    """What is read is checked as it stands: changed points may prove the orbit too."""
    theorem = THEOREMS[data.draw(st.sampled_from(ORBITS))]
    text = data.draw(spoilt(theorem.text().encode())).decode(errors="replace")
    result = theorem.check(text)
    assert result.verdict in {"proved", "not proved"} and "\n" not in (result.reason or "")


def test_random_bytes_and_a_missing_file_are_no_certificate(monkeypatch, tmp_path):
    monkeypatch.setattr(statements.resources, "files", lambda package: tmp_path)
    assert "there is no such certificate" in refused("fixed-point")
    (tmp_path / "certificates").mkdir()
    (tmp_path / "certificates" / "fixed-point.toml").write_bytes(b"\xff\x00" * 1000)
    assert "the certificate cannot be read" in refused("fixed-point")
