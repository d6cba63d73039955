"""What proves nothing: altered, foreign and unreadable certificates, other balls, wrong bounds."""

import dataclasses
import re
from fractions import Fraction

import pytest
from certificates import numbers

from pseudorigid import Ball, symmetric_orbits
from pseudorigid.proofs import THEOREMS, Surface
from pseudorigid.proofs.checks import jump, periodic
from pseudorigid.proofs.checks.certificate import NotProvedError
from pseudorigid.proofs.search.periodic import propose_only_fixed_point

BALL = Ball(k=0.2, g=0.04)
TWISTS = [n for n in THEOREMS if n.startswith("twist-") and n != "twist-zero"]
HORSESHOES = ["horseshoe-outer", "horseshoe-inner"]


def refused(name, text):
    result = THEOREMS[name].check(text)
    assert result.verdict == "not proved"
    assert result.reason
    assert "\n" not in result.reason
    return result.reason


def altered(text, field, row, columns, change):
    """The certificate with numbers of one row of a field changed."""
    lines = text.splitlines(keepends=True)
    at = lines.index(f"{field} = [\n") + 1 + row
    values = [Fraction(a) for a in re.findall(r"-?\d[\d.e-]*", lines[at])]
    for column in columns:
        values[column] = Fraction(change(values, column))
    lines[at] = "  [" + ", ".join(f'"{value}"' for value in values) + "],\n"
    return "".join(lines)


@pytest.mark.parametrize("name", HORSESHOES)
@pytest.mark.parametrize("row", [0, 30, -2])
def test_horseshoes_refuse_altered_sets(name, row):
    text = THEOREMS[name].text()
    row = row % len(numbers(text, "approach"))
    wider = altered(text, "approach", row, (2, 3), lambda v, i: v[i] * Fraction("1.3"))
    assert "cover" in refused(name, wider)
    thinner = altered(text, "approach", row, (4, 5), lambda v, i: v[i] * Fraction("0.7"))
    assert "cover" in refused(name, thinner)
    shifted = altered(text, "approach", row, (0, 1), lambda v, i: v[i] + v[i + 2] / 2)
    assert "cover" in refused(name, shifted)
    across = altered(text, "approach", row, (0, 1), lambda v, i: v[i] + v[i + 4] / 2)
    assert "cover" in refused(name, across)


def test_horseshoes_refuse_the_other_connection_and_a_larger_entropy():
    outer, inner = (THEOREMS[name] for name in HORSESHOES)
    assert refused("horseshoe-outer", inner.text())
    with pytest.raises(NotProvedError, match="where the statement says"):
        outer.checker(inner.text(), **outer.bounds | {"entropy": Fraction(0)})
    with pytest.raises(NotProvedError, match="entropy is not proved"):
        outer.checker(outer.text(), **outer.bounds | {"entropy": Fraction("0.0186")})


def test_horseshoes_refuse_an_orbit_that_is_not_the_paper_s():
    theorem = THEOREMS["horseshoe-outer"]
    elsewhere = ((Fraction(0), Fraction("0.01")), (Fraction(0), Fraction(1)))
    with pytest.raises(NotProvedError, match="window"):
        theorem.checker(theorem.text(), **theorem.bounds | {"window": elsewhere})


@pytest.mark.parametrize("name", THEOREMS)
@pytest.mark.parametrize(("field", "value"), [("k", "1/4"), ("g", "1/24"), ("energy", "1/99")])
def test_certificates_of_another_ball_are_refused(name, field, value):
    text = THEOREMS[name].text()
    other = re.sub(rf'^{field} = ".*"$', f'{field} = "{value}"', text, flags=re.MULTILINE)
    if other != text:
        reason = refused(name, other)
        # the zero's certificate says itself at which energy it is
        assert "the certificate is of" in reason or (name, field) == ("twist-zero", "energy")


@pytest.mark.parametrize("name", THEOREMS)
def test_unreadable_certificates_are_refused(name):
    text = THEOREMS[name].text()
    another = re.sub(r"kind = .*", 'kind = "poem"', text)
    without = text.replace("k = ", "kk = ")
    for broken in ("", text[: len(text) // 2], without, another, re.sub(r"\d+", "x", text)):
        refused(name, broken)


def test_what_is_refused_without_a_reason_is_not_proved():
    def refuse(text, **bounds):
        raise NotProvedError

    result = dataclasses.replace(THEOREMS["fixed-point"], checker=refuse).check("")
    assert (result.verdict, result.reason) == ("not proved", "no reason is given")


def test_a_missing_certificate_is_refused(monkeypatch):
    def nothing(self):
        raise FileNotFoundError

    monkeypatch.setattr(type(THEOREMS["jump-set"]), "text", nothing)
    assert THEOREMS["jump-set"].check().reason == "there is no such certificate"


def test_boxes_without_an_orbit_are_refused():
    text = THEOREMS["fixed-point"].text()
    assert refused("fixed-point", text.replace("0.0212078", "0.0312078"))
    assert refused("fixed-point", text.replace("radius = 4e-03", "radius = 5e-03"))
    assert "as stated" in refused("fixed-point", text.replace("radius = 4e-03", "radius = 3e-03"))
    # the hyperbolic orbit's boxes hold no elliptic orbit, and the other way round
    assert "hyperbolic, not" in refused("six-elliptic", THEOREMS["six-hyperbolic"].text())
    # every second point twice: an orbit of half the period is no orbit of this one
    fixed = numbers(text, "points")[0]
    twice = THEOREMS["six-elliptic"].text()
    rows = "".join(f"  [{', '.join(fixed)}],\n" for _ in range(6))
    twice = re.sub(r"points = \[\n.*?\n\]", f"points = [\n{rows}]", twice, flags=re.DOTALL)
    assert "period may be shorter" in refused("six-elliptic", twice)


@pytest.mark.parametrize("name", TWISTS)
def test_a_twist_of_the_wrong_sign_or_size_is_refused(name):
    text = THEOREMS[name].text()
    line = re.search(r"^twist = (.*)$", text, re.MULTILINE)
    value = Fraction(line.group(1))
    for other in (-value, value * Fraction("1.00000001"), 0):
        reason = refused(name, text.replace(line.group(0), f'twist = "{other}"'))
        assert "not the stated" in reason


def test_a_band_without_a_zero_of_the_twist_is_refused():
    text = THEOREMS["twist-zero"].text()
    energy = Fraction(re.search(r'energy = "(.*)"', text).group(1))
    for other in (energy - Fraction("1e-13"), energy + Fraction("1e-13")):
        moved = re.sub(r'energy = ".*"', f'energy = "{other}"', text)
        assert refused("twist-zero", moved)
    assert "wide" in refused("twist-zero", text.replace("width = 1e-13", "width = 1e-12"))


def test_the_map_is_not_proved_smooth_above_its_threshold():
    text = THEOREMS["diffeomorphism"].text()
    for other in ("1/100", "11/6249", "11/6251"):
        assert "not 11/6250" in refused("diffeomorphism", text.replace("11/6250", other))
    with pytest.raises(NotProvedError, match="no flight touches the floor"):
        at = Surface("1/5", "1/25", "11/6250")
        text = THEOREMS["jump-set"].text().replace("1/100", "11/6250")
        jump.check(text, at, radius=Fraction(1), length=Fraction(0))


@pytest.mark.parametrize("energy", [-0.003, 0.001, 0.01, 0.03, 0.0599])
def test_the_search_in_doubles_finds_one_fixed_point_too(energy):
    assert symmetric_orbits(BALL, energy, 1).sizes["orbit"] == 1


def test_more_fixed_points_are_not_excluded_where_there_are_three():
    # k = 0.2, g = 0.01, E = 0.03: the search finds three
    assert symmetric_orbits(Ball(k=0.2, g=0.01), 0.03, 1).sizes["orbit"] == 3
    k, g, energy = Fraction(1, 5), Fraction(1, 100), Fraction(3, 100)
    text = propose_only_fixed_point(k, g, energy)
    with pytest.raises(NotProvedError, match="second fixed point is not excluded"):
        periodic.check_only_fixed_point(text, k, g, energy)


def leading_digits(text, fields):
    """(field, number, certificate) of every leading digit in these fields that is changed."""
    place, field = 0, None
    for line in text.splitlines(keepends=True):
        named = re.match(r"(\w+) = ", line)
        if named:
            field = named.group(1)
        if field in fields and not line.startswith(("#", "]")):
            for number in re.finditer(r"-?\d[\d.e-]*", line[named.end() if named else 0 :]):
                digit = re.search(r"[1-9]", number.group(0))
                if digit:
                    at = place + (named.end() if named else 0) + number.start() + digit.start()
                    for other in "123456789".replace(text[at], ""):
                        yield field, number.group(0), text[:at] + other + text[at + 1 :]
        place += len(line)


FIELDS = {
    "points", "radius", "saddles", "approach", "middle", "width", "twist", "energy", "point",
    "near_image", "far_image", "outer_end", "inner_end", "speed", "roots", "energy_below",
    "energy_up_to", "theta_below",
}  # fmt: skip


@pytest.mark.parametrize("name", THEOREMS)
def test_no_leading_digit_may_change(name):
    every = list(leading_digits(THEOREMS[name].text(), FIELDS))
    assert every
    if len(every) > 200:  # some of each field; more with -m slow
        fields = [[row for row in every if row[0] == name] for name in FIELDS]
        every = [row for rows in fields for row in rows[:: max(1, len(rows) // 4)]]
    for _, number, text in every:
        assert THEOREMS[name].check(text).verdict == "not proved", number


@pytest.mark.slow
@pytest.mark.parametrize("name", HORSESHOES)
def test_no_leading_digit_of_a_horseshoe_may_change(name):
    every = list(leading_digits(THEOREMS[name].text(), FIELDS))
    for _, number, text in every[:: len(every) // 1500]:
        assert THEOREMS[name].check(text).verdict == "not proved", number
