"""What proves nothing: altered, foreign and unreadable certificates, other balls, wrong bounds."""

import dataclasses
import re
from fractions import Fraction
from math import atan2, pi, tan

import pytest
from certificates import numbers
from flint import arb, ctx

from pseudorigid import Ball, symmetric_orbits
from pseudorigid.proofs import THEOREMS, Surface
from pseudorigid.proofs.checks import horseshoe, jump, periodic
from pseudorigid.proofs.checks.certificate import Finding, NotProvedError
from pseudorigid.proofs.checks.hsets import HSet
from pseudorigid.proofs.enclosure.surface import ball_of
from pseudorigid.proofs.search import approximate_orbits
from pseudorigid.proofs.search import horseshoe as horseshoes
from pseudorigid.proofs.search import jump as jumps
from pseudorigid.proofs.search.periodic import propose_only_fixed_point

BALL = Ball(k=0.2, g=0.04)
TWISTS = [n for n in THEOREMS if n.startswith("twist-") and n != "twist-zero"]
HORSESHOES = ["horseshoe-outer", "horseshoe-inner"]
ORBITS = [name for name, theorem in THEOREMS.items() if theorem.checker is periodic.check]


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
    nested = "[" * 10_000
    digits = text.replace('k = "1/5"', 'k = "\u0661/\u0665"')  # 1/5 in Arabic digits
    for broken in ("", text[: len(text) // 2], without, another, re.sub(r"\d+", "x", text)):
        refused(name, broken)
    assert "cannot be read" in refused(name, text + f"more = {nested}")
    assert "is not an exact number" in refused(name, digits)


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
        jump.check(text, at, radius=Fraction(1), length=Fraction(0), jump=Fraction(0))


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


# ---- certificates that are consistent and prove less than the statement


def replaced(text, field, rows):
    """The certificate with other rows of a field."""
    lines = "".join(f"  [{', '.join(row)}],\n" for row in rows)
    return re.sub(rf"^{field} = \[\n.*?^\]", f"{field} = [\n{lines}]", text,
                  flags=re.DOTALL | re.MULTILINE)  # fmt: skip


@pytest.mark.parametrize(
    ("energy", "roots"),
    [("-3/1000", ("1/10", "3/10")), ("0.00129", ("-0.03", "0.43")), ("0", ("0", "0.4")),
     ("-0.004", ("0.2", "0.2"))],
)  # fmt: skip
def test_the_map_is_not_proved_smooth_below_a_lower_energy_only(energy, roots):
    text = THEOREMS["diffeomorphism"].text().replace("11/6250", energy)
    text = re.sub("roots = .*", f'roots = ["{roots[0]}", "{roots[1]}"]', text)
    assert f"not {Fraction(11, 6250)}" in refused("diffeomorphism", text)


def test_one_fixed_point_up_to_a_lower_energy_is_refused():
    ball = Fraction(1, 5), Fraction(1, 25)
    text = propose_only_fixed_point(*ball, Fraction(1, 100))
    assert periodic.check_only_fixed_point(text, *ball, Fraction(1, 100))
    assert "up to 1/100" in refused("one-fixed-point", text)


@pytest.mark.parametrize("name", [*ORBITS, *TWISTS])
def test_an_orbit_elsewhere_shorter_or_longer_is_refused(name):
    theorem = THEOREMS[name]
    text, points = theorem.text(), numbers(theorem.text(), "points")
    period = theorem.bounds["period"]
    (low, high), xdot = theorem.bounds["window"]
    elsewhere = (low + 1, high + 1), xdot
    with pytest.raises(NotProvedError, match="window"):
        theorem.checker(text, **theorem.bounds | {"window": elsewhere})
    for rows in (points + points, points[:-1] or points * 2):
        assert f"points, not {period}" in refused(name, replaced(text, "points", rows))
    ((x, y),) = approximate_orbits.points(theorem.bounds["surface"], 1, "elliptic")
    refused(name, replaced(text, "points", [[repr(x), repr(y)]] * period))
    smaller = theorem.bounds["radius"] / 2
    assert "as stated" in refused(name, re.sub("radius = .*", f'radius = "{smaller}"', text))


def test_the_boxes_are_those_around_the_orbit_s_own_points(monkeypatch):
    sizes = []
    prove = periodic.prove

    def watched(surface, centres, radius):
        sizes.append(radius)
        return prove(surface, centres, radius)

    monkeypatch.setattr(periodic, "prove", watched)
    theorem = THEOREMS["six-elliptic"]
    orbit = theorem.prove(theorem.text()).parts["orbit"]
    assert orbit.radius == theorem.bounds["radius"]
    rows = numbers(theorem.text(), "points")
    with ctx.workprec(256):
        off = max(
            abs(value - arb(middle)).upper()
            for point, centre in zip(orbit.points, rows, strict=True)
            for value, middle in zip(point, centre, strict=True)
        )
        assert 0 < off < ball_of(sizes[0] - orbit.radius)


STRONGER = [
    *((name, "radius", lambda radius: radius * Fraction(101, 100)) for name in [*ORBITS, *TWISTS]),
    *((name, "window", lambda window: tuple((low, low) for low, _ in window))
      for name in [*ORBITS, *TWISTS, *HORSESHOES]),
    *((name, "crossing", lambda sides: (sides[0] + Fraction(1, 1000), sides[1] + 1))
      for name in HORSESHOES),
    *((name, "entropy", lambda entropy: entropy * Fraction(102, 100)) for name in HORSESHOES),
    ("one-fixed-point", "energy", lambda energy: energy * Fraction(101, 100)),
    ("diffeomorphism", "energy", lambda energy: energy * Fraction(101, 100)),
    ("jump-set", "length", lambda length: length + Fraction(1, 10**4)),
    ("jump-set", "jump", lambda jump: jump + Fraction(1, 10**3)),
    ("twist-zero", "width", lambda width: width / 2),
]  # fmt: skip


@pytest.mark.parametrize(("name", "bound", "change"), STRONGER)
def test_a_stronger_statement_is_not_proved_by_the_same_certificate(name, bound, change):
    theorem = THEOREMS[name]
    stronger = theorem.bounds | {bound: change(theorem.bounds[bound])}
    assert dataclasses.replace(theorem, bounds=stronger).check().verdict == "not proved"


@pytest.mark.parametrize("name", THEOREMS)
def test_every_number_of_a_statement_is_given_to_its_checker(name):
    """A statement prints the bounds that its checker is given, and names of the paper."""
    theorem = THEOREMS[name]
    given = []
    for value in theorem.bounds.values():
        stack = [value]
        while stack:
            one = stack.pop()
            if isinstance(one, Surface):
                stack += [one.energy]
            elif isinstance(one, tuple):
                stack += one
            elif isinstance(one, (int, Fraction)):
                given += [str(one), f"{float(one):g}"]
    text = re.sub(r"y = 0|eq\. \(31\)|k/2|g\^2/?|\(2k\)|\(1 \+", "", theorem.statement)
    for number in re.findall(r"(?<![\w^])-?\d[\d./]*(?:e-?\d+)?", text):
        assert number in given, number


def test_a_longer_chain_is_refused_for_its_entropy():
    theorem = THEOREMS["horseshoe-outer"]
    surface = theorem.bounds["surface"]
    less = dataclasses.replace(theorem, bounds=theorem.bounds | {"entropy": Fraction(0)})
    ball, points = (
        approximate_orbits.ball(surface),
        approximate_orbits.points(surface, 6, "hyperbolic"),
    )
    plan = horseshoes.Plan(side=1, steps=72, size=3e-5, room=1.06)
    text = horseshoes.propose(surface, ball, points, plan, less.prove)
    assert less.check(text).verdict == "proved"
    assert "entropy is not proved" in refused("horseshoe-outer", text)


@pytest.mark.parametrize("margin", ["-1.0", "nan", "inf", "-inf", '"-1e-9"'])
def test_margins_that_are_negative_or_no_number_are_refused(margin):
    text = THEOREMS["horseshoe-outer"].text()
    rows = [[margin, margin] for _ in numbers(text, "margins")]
    assert "margin" in refused("horseshoe-outer", replaced(text, "margins", rows))


@pytest.mark.parametrize("margin", [-0.004, 0.0, float("nan"), float("inf")])
def test_a_finding_with_a_margin_that_is_not_positive_is_refused(margin):
    with pytest.raises(NotProvedError, match="the margin room"):
        Finding({}, {"beyond": 1.0, "room": margin})


def test_an_orbit_run_through_twice_is_no_orbit_of_twice_the_period():
    surface = Surface("1/3", "1/25", "1/10")
    near = approximate_orbits.ball(surface)
    found = symmetric_orbits(near, 0.1, 3)
    saddles = [i for i in range(found.sizes["orbit"]) if "hyper" in found["type"].values[i]]
    points = approximate_orbits.chart(near, found.isel(orbit=saddles[0]))
    centres = [[Fraction(a) for a in point] for point in points]
    radius = Fraction(1, 10**9)
    assert len(periodic.prove(surface, centres, radius).points) == 3
    with pytest.raises(NotProvedError, match="period may be shorter"):
        periodic.prove(surface, centres * 2, radius)


@pytest.mark.parametrize("centre", [0.7, 0.785, 0.79, 1.2, 1.5707])
def test_the_angle_is_the_acute_one_also_where_it_may_be_right(centre):
    """The angle between (x, y) and (x, -y), for all slopes of a wide ball."""
    sides = (arb(1), arb(0)), (arb(0), arb(1))
    tangents = [tan(min(centre + off, 1.57)) for off in (-0.1, -0.03, 0.04, 0.1)]
    slope = arb(tangents[0]).union(arb(tangents[-1]))
    angle = horseshoe._crossing(HSet("M_0", (arb(0), arb(0)), *sides), slope)
    for tangent in tangents:
        half = atan2(tangent, 1.0)
        assert angle.overlaps(arb(min(2 * half, pi - 2 * half), 1e-12))


def test_a_band_of_no_width_or_backwards_is_refused():
    text = THEOREMS["twist-zero"].text()
    for width in ("0", "-1e-13", "nan", "inf"):
        reason = refused("twist-zero", re.sub("width = .*", f"width = {width}", text))
        assert "wide" in reason or "width" in reason
    smaller = re.sub("radius = .*", "radius = 1e-3", text)
    assert "as stated" in refused("twist-zero", smaller)


def test_a_jump_set_of_coarser_points_or_of_part_of_the_curve_is_refused(monkeypatch):
    theorem = THEOREMS["jump-set"]
    coarse = theorem.text().replace("radius = 1e-28", "radius = 1e-27")
    assert "not at most" in refused("jump-set", coarse)
    # another point of the curve is as good: the statement is about the one that is printed
    other = jumps.propose(theorem.bounds["surface"], "-0.05", "1e-28")
    assert theorem.check(other).digits["point x"] != theorem.check().digits["point x"]
    assert theorem.check(other).verdict == "proved"
    # not so one near the inner end, where the jump vanishes
    inner = jumps.propose(theorem.bounds["surface"], "-0.117", "1e-28")
    assert "within 0.27" in refused("jump-set", inner)
    for speed in ("0.2", "-0.2", "nan"):
        assert refused("jump-set", theorem.text().replace("speed = 0.02", f"speed = {speed}"))
    whole = jump.curve
    monkeypatch.setattr(jump, "curve", lambda surface, count: whole(surface, count)[:-2])
    assert "longer than 0.4048" in refused("jump-set", theorem.text())


@pytest.mark.parametrize("number", ["1e-999999999", "1e999999999", '"1e400"', "1e400", "1_0.5",
                                    "true", "0x10", '"1/0"', "[1]"])  # fmt: skip
@pytest.mark.parametrize("name", ["six-elliptic", "twist-zero", "jump-set"])
def test_a_number_out_of_bounds_is_one_line(name, number):
    refused(name, re.sub("radius = .*", f"radius = {number}", THEOREMS[name].text()))


@pytest.mark.parametrize("name", THEOREMS)
def test_a_ball_or_energy_of_too_many_digits_is_one_line(name):
    text = THEOREMS[name].text()
    for field in ("k", "g", "energy", "energy_up_to", "energy_below"):
        for number in ("1e-999", "1e999", "1e-9999", "1e9999"):
            other = re.sub(rf'^{field} = ".*"$', f'{field} = "{number}"', text, flags=re.MULTILINE)
            if other != text:
                reason = refused(name, other)
                assert "digits" in reason or "not an exact number" in reason


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
