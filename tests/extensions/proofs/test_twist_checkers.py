"""The fixed point and the twist: enclosures, and premises one by one."""

import json
from fractions import Fraction
from functools import partial
from itertools import product
from math import comb, factorial
from types import SimpleNamespace

import mpmath
import pytest
from flint import acb, arb, arb_mat, ctx

from extensions.proofs import THEOREMS, Surface
from extensions.proofs.checkers import fixed_point, one_zero, periodic, twist
from extensions.proofs.checkers.certificate import NotProvedError
from extensions.proofs.checkers.fixed_point import energy_at
from extensions.proofs.checkers.twist import NormalForm
from extensions.proofs.enclosure.jets import Jet, algebra
from extensions.proofs.enclosure.surface import ball_of
from extensions.proofs.search.fixed_point import propose_unique
from extensions.proofs.search.periodic import approximate_points
from helpers.parts.certificates import numbers, refused, told, with_bounds, with_field, with_rows

BALL = K, G = Fraction(1, 5), Fraction(1, 25)


@pytest.fixture(autouse=True)
def bits():
    with ctx.workprec(one_zero.BITS):
        yield


def changed(name, **fields):
    """The certificate of a theorem with other values of fields of one line."""
    text = THEOREMS[name].text()
    for field, value in fields.items():
        text = with_field(text, field, json.dumps(value))
    return text


def shifted(name, shift, field="theta"):
    """The ends of an interval of theta, moved."""
    (row,) = [line for line in THEOREMS[name].text().splitlines() if line.startswith(f"{field} =")]
    ends = (Fraction(end.strip(' "')) for end in row.partition("[")[2].strip("]").split(","))
    return [str(end + Fraction(shift)) for end in ends]


# ---- the closed form


@pytest.mark.parametrize(("name", "fields", "reason"), [
    ("one-fixed-point", {"theta_below": "3.64"}, "theta is not proved"),
    ("one-fixed-point", {"theta_below": "3.68"}, "theta is not proved"),
    *(("fixed-point-elliptic", {"theta": theta}, reason) for theta, reason in (
        (shifted("fixed-point-elliptic", "1e-37"), "highest energy"),
        (shifted("fixed-point-elliptic", "-1e-37"), "highest energy"),
        (shifted("fixed-point-elliptic", 0)[::-1], "1e-30"),
        ([f"3.14159265358979323846264338327950{end}" for end in (28, 29)], "between 0 and pi"))),
    ("fixed-point-elliptic", {"bands": 0}, "bands are not"),
    ("fixed-point-elliptic", {"bands": 10_001}, "bands are not"),
    ("six-birth", {"theta": shifted("six-birth", "1e-30")}, "fall through"),
    ("six-birth", {"theta": shifted("six-birth", "-1e-30")}, "fall through"),
    ("six-birth", {"event": ["0.00737847825251786581240357145338"]}, "event is not the stated"),
    ("unstable", {"theta": ["0", "2.1"]}, "do not rise"),
    ("unstable", {"theta": shifted("unstable", 0)[::-1]}, "do not rise"),
    ("unstable", {"theta": shifted("unstable", 0)[:1] * 2}, "do not rise"),
    ("unstable", {"theta": ["2.1", "3"]}, "do not rise"),
    ("unstable", {"theta": shifted("unstable", "1e-15")}, "1/4 once"),
    ("unstable", {"theta": shifted("unstable", "-1e-15")}, "1/4 once"),
    ("unstable", {"coefficients": ["1.74978424", "7.35932691733"]}, "normal form is not"),
    ("unstable", {"coefficients": ["1.74978423654", "7.35932692"]}, "normal form is not"),
    ("unstable", {"margin": "5.61"}, "not proved to be above"),
    ("unstable", {"margin": "5.59"}, "not 5.6 as stated"),
    ("fixed-point-elliptic", {"bands": 1}, "each band"),
    ("fixed-point-elliptic", {"trace_above": "-1/2"}, "not -0.46"),
    ("fixed-point-elliptic", {"trace_above": "-0.45"}, "not proved to be above"),
    ("twist-ten", {"twist": "-4416.404133650"}, "not the stated"),  # 1e-8 of it off
    ("twist-six", {"radius": "5e-05"}, "as stated"),
    *(("twist-zero", {"width": width}, reason) for width, reason in (
        ("0", "not above 0 and at most"), ("1e-12", "width"))),
    ("twist-zero", {"energy": "0.0291977581390"}, ""),  # 1e-13 off
])  # fmt: skip
def test_each_number_of_a_certificate_about_the_fixed_point_is_looked_at(name, fields, reason):
    assert reason in refused(name, changed(name, **fields))


@pytest.mark.parametrize(("k", "theta"), [(K, "4.75"), (Fraction(1), "3")])
def test_each_inequality_that_excludes_a_second_fixed_point_is_checked(k, theta):
    """theta is above 3 pi/2 with k theta < 2, and below it with k theta > 2."""
    energy = G**2 / (2 * k) * ((1 + k) * Fraction(theta) ** 2 - 1)
    theorem = with_bounds(THEOREMS["one-fixed-point"], k=k, energy=energy)
    assert "second fixed point" in refused(theorem, propose_unique(theorem))


@pytest.mark.parametrize(("name", "bounds", "reason"), [
    *(("six-birth", {"rotation": Fraction(a, b), "period": period}, "no two orbits")
      for a, b, period in ((1, 6, 12), (1, 4, 4), (1, 7, 7), (-1, 6, 6), (1, 2, 2), (1, 9, 9))),
    ("six-birth", {"energies": (Fraction("0.00738"), Fraction("0.0074"))}, "energy is not proved"),
    ("six-birth", {"energies": (Fraction("0.007"), Fraction("0.007378"))}, "energy is not proved"),
    *(("unstable", {"energies": tuple(map(Fraction, ends))}, "lie between") for ends in (
        ("0.03739517", "0.0373951713627"), ("0.0373951713626", "0.03739518"),
        ("0.03739517136261", "0.0373951713627"), ("0.0373951713626", "0.03739517136260"))),
])  # fmt: skip
def test_each_number_of_a_statement_about_the_fixed_point_is_looked_at(name, bounds, reason):
    assert reason in refused(name, None, **bounds)


@pytest.mark.parametrize("place", [0, 0.4, 0.99])
def test_the_trace_falls_on_all_bands(place, monkeypatch):
    """A rise anywhere from pi/2 to the last theta is seen."""
    end, bad = arb(2), ((arb.pi() / 2) * (1 - place) + 2 * arb(place)).lower()
    monkeypatch.setattr(fixed_point, "slope_at", lambda k, theta: arb(-2, 1))
    assert fixed_point._prove_falling_trace(arb(0.2), end, 7) == pytest.approx(1)
    monkeypatch.setattr(
        fixed_point, "slope_at", lambda k, theta: arb(-2, 2.5 if theta.contains(bad) else 1)
    )
    with pytest.raises(NotProvedError, match="on each band"):
        fixed_point._prove_falling_trace(arb(0.2), end, 7)
    with pytest.raises(NotProvedError, match="does not reach pi/2"):
        fixed_point._prove_falling_trace(arb(0.2), arb(1.5), 7)


def test_the_last_trace_and_the_last_band_reach_both_ends_of_theta(monkeypatch):
    given, trace_at, falling = {}, fixed_point.trace_at, fixed_point._prove_falling_trace

    def noted(name, function, k, theta, *more):
        given.setdefault(name, theta)
        return function(k, theta, *more)

    monkeypatch.setattr(fixed_point, "trace_at", partial(noted, "theta", trace_at))
    monkeypatch.setattr(fixed_point, "_prove_falling_trace", partial(noted, "end", falling))
    THEOREMS["fixed-point-elliptic"].prove()
    with ctx.workprec(400):
        low, high = (ball_of(Fraction(a)) for a in shifted("fixed-point-elliptic", 0))
        assert given["theta"].contains(low) and given["theta"].contains(high)
        assert given["end"] > high


# That the ends of theta, or edges, lie in (0, pi) is also a premise of energy_at, which refuses
# them too. The set of complex_flight is made from the known root, and so contains it.
@pytest.mark.parametrize(("function", "theta"), [
    *((fixed_point.energy_at, theta) for theta in (-1, 0, arb(3.1, 0.1), arb(0.1, 0.2))),
    *((fixed_point.trace_at, theta) for theta in (-1, 4)),
])  # fmt: skip
def test_theta_is_between_0_and_pi(function, theta):
    given = (arb(1), arb(1), arb(theta)) if function is energy_at else (arb(1), arb(theta))
    with pytest.raises(NotProvedError, match="between 0 and pi"):
        function(*given)


@pytest.mark.parametrize(("name", "reason"), [("six-birth", "fall"), ("unstable", "1/4 once")])
def test_a_trace_that_may_not_fall_is_refused(name, reason, monkeypatch):
    """Over the whole interval of theta, and `unstable` beyond it on both sides."""
    over = []
    slope_at = fixed_point.slope_at

    def recorded(k, theta):
        over.append(theta)
        return slope_at(k, theta)

    monkeypatch.setattr(fixed_point, "slope_at", recorded)
    assert THEOREMS[name].check().verdict == "proved"
    reach = Fraction(1, 2**30) if name == "unstable" else 0
    low, high = map(Fraction, shifted(name, 0))
    with ctx.workprec(400):
        assert all(over[0].contains(ball_of(end)) for end in (low - reach, high + reach))
    for slope in (arb(1), arb(-1, 1.1)):
        monkeypatch.setattr(fixed_point, "slope_at", lambda k, theta, slope=slope: slope)
        assert reason in refused(name)


@pytest.mark.parametrize("value", [arb(-1), arb(0, 1)])
def test_a_resonance_without_positive_twist_is_refused(value, monkeypatch):
    """By `twist-one-zero` there is none up to theta = pi/2, so the twist is made up."""
    monkeypatch.setattr(fixed_point, "normal_form", lambda *_: NormalForm((value,), arb(1)))
    assert "twist is not proved to be positive" in refused("six-birth")


def test_a_fixed_point_is_proved_over_a_band_around_an_energys_ball():
    energy, theta = arb("0.0073", "1e-20"), arb("1.37")
    energy = energy_at(ball_of(K), ball_of(G), theta) + arb(0, "1e-20")
    band, orbit = fixed_point._prove_over(*BALL, energy, theta)
    assert ball_of(band.energy) < energy < ball_of(band.energy + band.width)
    assert band.width < Fraction(3, 10**20)
    x, y = orbit.points[0]
    assert x.overlaps(ball_of(G / K) * theta * theta.cot()) and y.contains(0) and x.rad() < 1e-15


# ---- one zero of the twist


def at(theta, ball=BALL):
    """cos(omega) and theta tau_1 at one theta."""
    pairs = one_zero.over_band(*ball, Fraction(theta), Fraction(theta))[:2]
    return [value for value, _ in pairs]


@pytest.mark.parametrize("theta", ["0.4", "2.05"])
def test_the_twist_is_that_of_birkhoffs_normal_form(theta):
    """The normal form takes flights and the fixed point from the map over a ball instead."""
    with ctx.workprec(periodic.BITS):
        cosine, scaled = at(theta)
        energy = energy_at(*map(ball_of, BALL), arb(theta))
        surface = Surface(*BALL, Fraction(float(energy)))
        point = approximate_points(surface, 1, "elliptic")
        centres = [[Fraction(a) for a in z] for z in point]
        orbit = periodic.prove(surface, centres, Fraction(1, 10**8))
        form = twist.normal_form(surface, orbit)
        assert abs(orbit.trace / 2 - cosine) < 1e-13
        assert abs(form.twists[0] - scaled / arb(theta)) < 1e-11


def test_a_function_falls_through_zero_once_only():
    plus, minus, falls = (arb(1), arb(0, 9)), (arb(-1), arb(0, 9)), (arb(0, 1), arb(-1))

    def margin(rows):
        return one_zero.margin_of_one_zero([one_zero.Enclosed(*row) for row in rows], "zero")

    assert margin([plus, falls, falls, minus, minus]) == 1
    for rows in (
        [plus, minus, plus, minus], [plus, falls, minus, falls, minus], [falls, minus],
        [plus, falls], [plus, plus], [plus, (arb(0, 1), arb(1)), minus],
        [plus, (arb("nan"), arb("nan")), minus],
    ):  # fmt: skip
        with pytest.raises(NotProvedError, match="only one"):
            margin(rows)


@pytest.mark.parametrize("kind", ["sine", "versine"])
@pytest.mark.parametrize(("terms", "more"), [(60, 8), (60, 0), (5, 0)])
@pytest.mark.parametrize("middle", [0.0, 3.2])
def test_the_even_functions_have_taylors_remainder(kind, terms, more, middle, monkeypatch):
    """Where the remainder, or what the power series leaves out, is the largest part."""
    monkeypatch.setattr(one_zero, "_SERIES_TERMS", terms)
    monkeypatch.setattr(one_zero, "_EXTRA_ORDERS", more)
    one_zero._power_series.cache_clear()
    order, reach = 3, 0.75
    found = one_zero._even_function(kind, arb(middle, reach), order)
    one_zero._power_series.cache_clear()
    first = 3 if kind == "sine" else 2
    sign = -1 if kind == "sine" else 1

    def coefficients(z, count):
        """Those of the power series, shifted, with enough terms."""
        with mpmath.workdps(40):
            return [sum(sign * (-1) ** j * comb(2 * j, n) * mpmath.mpf(z) ** (2 * j - n)
                        / mpmath.factorial(2 * j + first) for j in range((n + 1) // 2, 60))
                    for n in range(count)]  # fmt: skip

    at_middle, most = coefficients(middle, order + more + 1), order + more
    left_out = 2 * 100**terms / factorial(2 * terms)
    for z in (middle - 0.7499, middle, middle + 0.3, middle + 0.7499):
        inner = [arb(mpmath.nstr(a, 30)) for a in coefficients(z, order + 1)]
        assert all(ball.overlaps(a) for ball, a in zip(found, inner, strict=True))
    for n, ball in enumerate(found):
        rest = reach ** (most + 1 - n) / (2 * factorial(n) * factorial(most + 1 - n))
        spread = sum(comb(m, n) * (left_out + (abs(float(at_middle[m])) if m > n else 0))
                     * reach ** (m - n) for m in range(n, most + 1))  # fmt: skip
        assert float(ball.rad()) == pytest.approx(rest + spread, rel=1e-6)


def test_functions_of_angles_above_five_are_not_enclosed():
    one_zero._even_function("sine", arb(4.9), 2)
    for value in (arb(5.1), arb(-5.1), arb(4.8, 0.3)):
        with pytest.raises(NotProvedError, match="too wide"):
            one_zero._even_function("sine", value, 2)


@pytest.mark.parametrize(("low", "high"), [("0", "0.05"), ("1.2", "1.22"), ("2.2", "2.21")])
def test_fields_over_a_wide_band_enclose_those_inside(low, high, monkeypatch):
    """Also with polynomials of low degree, so that Lagrange's remainder is large."""
    k, g, ends = ball_of(K), ball_of(G), (arb(low), arb(high))
    for order in (1, 2, 5):
        monkeypatch.setattr(one_zero, "_PARAMETER_ORDER", order)
        over, at = one_zero._fields(k, g, ends[0].union(ends[1]))
        for share in ("0.001", "0.3", "0.5", "0.8", "0.999"):
            t = ends[0] + (ends[1] - ends[0]) * arb(share)
            inner = one_zero._series(k, g, t, 1)
            for r, (i, j) in product((0, 1), algebra(2, 3).monomials):
                value, slope = over[r][i, j].coefficients
                assert value.overlaps(inner[r][i, j, 0]) and slope.overlaps(inner[r][i, j, 1])
                assert value.is_finite() and slope.is_finite()
                if share == "0.5":
                    assert at[r][i, j].constant.overlaps(inner[r][i, j, 0])


@pytest.mark.parametrize(("low", "high"), [("-0.1", "0.1"), ("1", "0.9")])
def test_a_band_begins_at_zero_or_above_and_does_not_run_backwards(low, high):
    with pytest.raises(NotProvedError, match="is no band"):
        one_zero.over_band(*BALL, Fraction(low), Fraction(high))


@pytest.mark.parametrize("place", range(4))
def test_a_twist_that_is_not_finite_is_refused(place, monkeypatch):
    sizes = [arb("inf") if place == i else arb(1) for i in range(4)]
    jets = [Jet(algebra(1, 1), sizes[:2]), Jet(algebra(1, 1), sizes[2:])]
    monkeypatch.setattr(one_zero, "_fields", lambda *_: ([], []))
    monkeypatch.setattr(one_zero, "_cosine_and_twist", lambda *_: (*jets, arb(1)))
    with pytest.raises(NotProvedError, match="not finite"):
        one_zero.over_band(*BALL, Fraction(1), Fraction(2))


def field(push, back, diagonal=-0.5):
    """Made-up series of V to third order, with the given first derivatives."""
    one, order = algebra(1, 0), algebra(2, 3).monomials
    x, y = ({powers: Jet(one, [arb(0)]) for powers in order} for _ in "xy")
    x[1, 0], x[0, 1], y[1, 0] = (Jet(one, [arb(a)]) for a in (diagonal, push, back))
    return [x, y]


@pytest.mark.parametrize(("push", "back", "reason"), [
    (1, -1, None), (-1, 1, "elliptic"), (1, 1, "elliptic"), (arb(0, 1), -1, "elliptic"),
    (1, arb(0, 1), "elliptic"), (3, -3, "third power"),
])  # fmt: skip
def test_each_premise_of_the_twist_over_a_band_is_looked_at(push, back, reason):
    with told(reason):
        one_zero._cosine_and_twist(field(push, back), arb(1))


@pytest.mark.parametrize(("change", "reason"), [
    (lambda rows: [*rows, *([str(2.31 + n / 1e6)] for n in range(1000))], "edges, not 2"),
    (lambda rows: [["0.001"], *rows[1:]], "do not rise"),
    (lambda rows: [*rows[:5], rows[4], *rows[5:]], "do not rise"),
    (lambda rows: [*rows, ["3.2"]], "reach|pi"), (lambda rows: rows[:-2], "not proved to reach"),
    (lambda rows: rows[:1], "edges, not 2"),
])  # fmt: skip
def test_each_premise_of_the_edges_is_looked_at(change, reason):
    text = THEOREMS["twist-one-zero"].text()
    rows = change(numbers(text, "edges"))
    assert any(word in refused("twist-one-zero", with_rows(text, "edges", rows))
               for word in reason.split("|"))  # fmt: skip


@pytest.mark.parametrize("name", ["zero", "resonance"])
def test_each_end_of_an_interval_around_a_zero_is_looked_at(name, monkeypatch):
    """With a function that falls through zero in the certificate's interval."""
    row = [Fraction(a) for a in shifted("twist-one-zero", 0, name)]
    low, high = THEOREMS["twist-one-zero"].bounds[name]
    middle = (row[0] + row[1]) / 2
    monkeypatch.setattr(one_zero, "over_band", lambda k, g, a, b: SimpleNamespace(
        **{name: one_zero.Enclosed(ball_of(middle - a), arb(-1))}))  # fmt: skip
    one_zero._energy_of(row, *BALL, (low, high), name)
    width = Fraction(1, 10)
    for bad, bounds, reason in (
        ([row[0] - width, row[1] - width], (low, high), "certificate's theta"),
        ([row[0] + width, row[1] + width], (low, high), "certificate's theta"),
        (row, (high, high + 1), "statement's energies"),
        (row, (low - 1, low), "statement's energies"),
        ([Fraction(0), row[1]], (low, high), "no interval"),
        (row[::-1], (low, high), "no interval"),
        ([row[0], Fraction("2.5")], (low, high), "no interval"),
    ):
        with pytest.raises(NotProvedError, match=reason):
            one_zero._energy_of(bad, *BALL, bounds, name)


@pytest.mark.parametrize("name", ["zero", "resonance"])
def test_the_bands_reach_the_zero_and_the_resonance(name):
    bounds = THEOREMS["twist-one-zero"].bounds
    beyond = {name: (bounds[name][0], Fraction("0.061"))}
    assert "do not reach" in refused("twist-one-zero", **beyond)


# ---- normal forms


def shear(z, conjugate, size):
    """An area-preserving change of coordinates: p + size q^2."""
    q = (z + conjugate) * acb(0.5)
    return z + q * q * acb(0, size)


def map_of(angle, twists, size=0.3, order=5, resonant=0):
    """lambda, and the jet of a map with a known normal form in sheared coordinates."""
    z, w = Jet.plane(order, acb(0), acb(0))
    multiplier = acb(-2 * angle).exp_pi_i()
    # the series of exp(i (tau_1 I + tau_2 I^2)), I = z w/2
    action, one = z * w * acb(0.5), Jet.constant_of(z.algebra, acb(1))
    phase = (action * twists[0] + action * action * twists[1]) * acb(0, 1)
    normal = (one + phase + phase * phase * acb(0.5)) * z * multiplier
    normal = normal + w * w * w * multiplier * resonant
    old, new = shear(z, w, -size), shear(z, w, size)

    def conjugate(jet):
        return Jet(jet.algebra, [jet[j, i].conjugate() for i, j in jet.algebra.monomials])

    inner = normal.at(old, conjugate(old))
    return multiplier, new.at(inner, conjugate(inner))


@pytest.mark.parametrize("twists", [(2.0, 0.0), (-1.5, 3.0), (0.0, -3.0)])
def test_the_normal_form_is_that_of_a_map_with_known_twists(twists, monkeypatch):
    """The second twist depends on coordinates unless the first one is 0."""
    monkeypatch.setattr(twist, "complex_map", lambda *_: map_of(0.179, twists))
    form = twist.normal_form(None, None, 5)
    assert abs(form.twists[0] - twists[0]) < 1e-25 and len(form.twists) == 2
    if twists[0] == 0:
        assert abs(form.twists[1] - twists[1]) < 1e-25
    monkeypatch.setattr(twist, "complex_map", lambda *_: map_of(0.179, twists, 0))
    assert abs(twist.normal_form(None, None, 5).twists[1] - twists[1]) < 1e-25
    nearest = min(abs(complex(acb(-2 * 0.179 * j).exp_pi_i()) - 1) for j in range(1, 7))
    assert float(form.nonresonance) == pytest.approx(nearest)


@pytest.mark.parametrize(("turns", "order", "refused"), [
    (4, 3, True), (3, 3, True), (5, 3, False), (6, 5, True), (5, 5, True), (7, 5, False),
])  # fmt: skip
def test_powers_of_the_multiplier_up_to_the_order_plus_one_are_not_one(
    turns, order, refused, monkeypatch
):
    given = map_of(1 / arb(turns), (2.0, 0.0), order=order)
    monkeypatch.setattr(twist, "complex_map", lambda *_: given)
    with told(f"up to {order + 1} may be 1" if refused else ""):
        assert abs(twist.normal_form(None, None, order).twists[0] - 2) < 1e-25


@pytest.mark.parametrize("degree", [1, 2])
def test_a_map_that_does_not_keep_area_is_refused(degree, monkeypatch):
    multiplier, map_ = map_of(0.179, (2.0, 1.0))
    z, w = Jet.plane(5, acb(0), acb(0))
    growth = z * z * w if degree == 1 else z * z * w * z * w
    grown = map_ + growth * (1e-6 * multiplier)
    monkeypatch.setattr(twist, "complex_map", lambda *_: (multiplier, grown))
    with pytest.raises(NotProvedError, match="drifts"):
        twist.normal_form(None, None, 5)


def test_the_coefficients_at_the_resonance_are_those_of_a_known_map():
    a, b = twist.resonant_coefficients(*map_of(arb(0.25), (3.0, 0.0), 0.3, 3, acb(0.5, 2)))
    assert abs(a - acb(0, 1.5)) < 1e-25 and abs(b - acb(0.5, 2)) < 1e-25
    multiplier, map_ = map_of(arb(0.25), (3.0, 0.0), 0.3, 3)
    z, w = Jet.plane(3, acb(0), acb(0))
    with pytest.raises(NotProvedError, match="drifts"):
        twist.resonant_coefficients(multiplier, map_ + z * z * w * (1e-6 * multiplier))


def henon(sine, backwards):
    """A made-up surface whose map is Henon's quadratic one or its inverse, in slanted axes."""
    cosine, sine, slant = (1 - arb(sine) ** 2).sqrt(), arb(sine), arb(0.3)

    def impact(x, y):
        x = x - y * slant
        if backwards:
            x, y = x * cosine + y * sine, y * cosine - x * sine
            y = y + x * x
        else:
            y = y - x * x
            x, y = x * cosine - y * sine, x * sine + y * cosine
        return x + y * slant, y

    s = -sine if backwards else sine
    rows = [[cosine + slant * s, -s * (1 + slant * slant)], [s, cosine - slant * s]]
    orbit = SimpleNamespace(points=[(arb(0), arb(0))], matrix=arb_mat(rows), trace=2 * cosine)
    return SimpleNamespace(impact=impact), orbit


@pytest.mark.parametrize("sine", [0.9, -0.7])
def test_a_map_and_its_inverse_turn_with_opposite_twists(sine):
    """Whether y pushes x forward or back; the twist is that of the formula by |g_ij|^2."""
    (twist_of_map,), (twist_of_inverse,) = (
        twist.normal_form(*henon(sine, backwards)).twists for backwards in (False, True)
    )
    assert twist_of_map.overlaps(-twist_of_inverse) and abs(twist_of_map) > 0.1
    # y - x^2 before a rotation by a: g_20 = g_11 = g_02 = -i exp(i a)/2 in z = x + i y
    angle = mpmath.asin(sine)
    expected = -(3 * mpmath.cot(angle / 2) + mpmath.cot(3 * angle / 2)) / 8
    assert float(twist_of_map) == pytest.approx(float(expected), rel=1e-12)


@pytest.mark.parametrize("rows", [[[2, 1], [1, 1]], [[1, 1], [0, 1]], [[0, 1], [-1, arb(0, 3)]],
                                  [[0, arb(0, 1)], [-1, 0]]])  # fmt: skip
def test_a_point_that_may_not_be_elliptic_has_no_normal_form(rows):
    surface, orbit = henon(0.5, True)
    orbit.matrix = arb_mat([[arb(a) for a in row] for row in rows])
    orbit.trace = orbit.matrix[0, 0] + orbit.matrix[1, 1]
    with pytest.raises(NotProvedError, match="not proved to be elliptic"):
        twist.complex_map(surface, orbit, 3)


def test_a_twist_that_may_be_zero_is_refused(monkeypatch):
    """A stated twist is not 0 if it is near one that is not; one of 0 must be exact."""
    monkeypatch.setattr(twist, "normal_form", lambda *_: NormalForm((arb(0),), arb(1)))
    monkeypatch.setattr(twist, "check_stated", lambda *_: None)
    assert "twist may be zero" in refused("twist-fixed-point")


@pytest.mark.parametrize(("twists", "reason"), [
    ((1, -1, arb(0, 1), -5), None), ((arb(0, 1), -1, 0, -5), "fall through"),
    ((1, arb(0, 1), 0, -5), "fall through"), ((-1, 1, 0, -5), "fall through"),
    ((1, -1, 0, arb(0, 1)), "is not proved"), ((1, -1, 0, 5), "is not proved"),
])  # fmt: skip
def test_the_twist_falls_through_zero_and_the_second_one_is_negative(twists, reason, monkeypatch):
    low, high, between, second = map(arb, twists)
    surfaces, forms = [], iter(((low, arb(1)), (high, arb(1)), (between, second)))
    monkeypatch.setattr(twist, "normal_form", lambda surface, orbit, order: (
        surfaces.append((surface, order)) or NormalForm(next(forms), arb(1))))  # fmt: skip
    result = THEOREMS["twist-zero"].check()
    assert reason in result.reason if reason else result.verdict == "proved"
    (low, order), (high, _), (band, _) = surfaces
    assert (low.width, high.width, order) == (0, 0, 5)
    assert band == Surface(*BALL, low.energy, high.energy - low.energy)
    assert 0 < band.width == Fraction(1, 10**13)


@pytest.mark.parametrize(("k", "factor"), [
    ("1/20", 1.089), ("1/10", 1.367), ("1/5", 4.206), ("3/10", 3.414), ("1/3", 2.093),
])  # fmt: skip
def test_the_resonance_is_unstable_for_other_balls(k, factor):
    """The factors by which |B| exceeds |A| in src/extensions/atlas/README.md."""
    k, low, high = Fraction(k), Fraction(1, 100), Fraction(3)
    with ctx.workprec(fixed_point.BITS):
        for _ in range(170):
            middle = (low + high) / 2
            falls = fixed_point.trace_at(ball_of(k), ball_of(middle)) > 0
            low, high = (middle, high) if falls else (low, middle)
        ends = [energy_at(ball_of(k), ball_of(G), ball_of(end)) for end in (low, high)]
        band, orbit = fixed_point._prove_over(k, G, arb.union(*ends), ball_of(low))
        form = twist.complex_map(band, orbit, order=3)
        a, b = map(abs, twist.resonant_coefficients(*form))
        assert float(b / a) == pytest.approx(factor, abs=5e-4)
