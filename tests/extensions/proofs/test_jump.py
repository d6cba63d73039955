"""The jump set: each premise of its checkers, on flights and curves that are made up."""

from fractions import Fraction
from itertools import pairwise
from types import SimpleNamespace

import mpmath
import numpy as np
import pytest
from flint import arb, ctx

from extensions.proofs import THEOREMS, Surface
from extensions.proofs.checkers import hsets, jump, periodic
from extensions.proofs.checkers.certificate import NotProvedError
from extensions.proofs.checkers.hsets import hset
from extensions.proofs.enclosure.surface import Impact
from helpers.independent_solver import exact_map
from helpers.parts.certificates import told
from pseudorigid.verified import flight
from pseudorigid.verified.flight import UndecidedError

PAPER = Surface("1/5", "1/25", "1/100")
BELOW = Surface("1/5", "1/25", "11/6250")  # the energy at which the rim reaches x = -g
K, G, E = mpmath.mpf(1) / 5, mpmath.mpf(1) / 25, mpmath.mpf(1) / 100
SET = THEOREMS["jump-set"]
CIRCLE = THEOREMS["no-circle"]


def refuse(reason):
    raise NotProvedError(reason)


# ---- enclosures


def on_the_rim(xdot):
    """The state on the rim with x < -g."""
    return (G - mpmath.sqrt(G * G + K * (2 * E - (1 + K) * xdot * xdot))) / K, xdot, -xdot


def landing(xdot):
    """x, y, tau, s of the next impact from the rim."""
    x, v, w, tau = exact_map(K, G, *on_the_rim(xdot))
    return x, v - K * w, tau, v + w


@pytest.mark.parametrize(("angle", "width"), [
    (0.3, 1e-4), (0.5, 1e-3), (1.0, 0.05), (1.5, 0.05), (2.0, 0.05), (2.6, 0.05), (3.13, 0.01),
    (2.0, 1e-9),
])  # fmt: skip
def test_landings_of_wide_arcs_of_the_rim_contain_those_of_their_points(angle, width):
    with mpmath.workdps(40), ctx.workprec(128):
        wide, fastest = arb(angle, width), jump.fastest_touch(PAPER)
        rim, its = jump._rim_point(PAPER, wide), jump._landing(PAPER, wide)
        assert its.tau.rad() < 40 * width + 1e-8
        for at in np.linspace(-0.999999, 0.999999, 9):
            angle_at = mpmath.mpf(wide.mid().str(40, radius=False)) + mpmath.mpf(width) * at
            if angle_at > mpmath.pi:
                continue
            xdot = mpmath.cos(angle_at) * mpmath.mpf(fastest.str(38, radius=False))
            x = on_the_rim(xdot)[0]
            for value, true in zip((*rim, *its), (xdot, -G - x, *landing(xdot)), strict=True):
                assert value.overlaps(arb(mpmath.nstr(true, 36), 1e-30))


def test_the_points_stated_are_those_of_touching_flights():
    """The flight from `point` touches; the images are those of the touch and of the next impact."""
    with mpmath.workdps(40), ctx.workprec(jump.BITS):
        points = jump.stated_points(PAPER, arb("0.02"))
        xdot, fastest = mpmath.mpf("0.02"), mpmath.sqrt((2 * E - G * G * (2 + K)) / (1 + K))
        forwards, backwards = landing(-xdot), landing(xdot)
        inner = landing(-fastest)
        true = {
            "point": (backwards[0], -backwards[1]), "far image": forwards[:2],
            "near image": (on_the_rim(xdot)[0], -(1 + K) * xdot),
            "outer end": (-G, -(1 + K) * fastest), "inner end": (inner[0], -inner[1]),
        }  # fmt: skip
        assert points.keys() == true.keys()
        for name, values in true.items():
            for value, number in zip(points[name], values, strict=True):
                assert abs(value - arb(mpmath.nstr(number, 38))) < 1e-34, name


# ---- premises of the jump set


@pytest.mark.parametrize("name", ["check_landings", "_transversality"])
def test_the_jump_set_needs_each_of_its_parts(name, monkeypatch):
    monkeypatch.setattr(jump, name, lambda *_: refuse(name))
    assert SET.check().reason == name


@pytest.mark.parametrize(("bounds", "point", "reason"), [
    ({"jump": Fraction(-1)}, None, "images may be within -1"),
    ({"jump": Fraction("0.271")}, None, "images may be within 0.271"),
    ({"length": Fraction("0.40486")}, None, "longer than 0.40486"),
    *(({}, name, f"the {name} is not the stated one")
      for name in ("point", "near image", "far image", "outer end", "inner end")),
])  # fmt: skip
def test_each_number_of_the_jump_set_is_looked_at(bounds, point, reason, monkeypatch):
    numbers = SET.bounds | bounds
    if point:
        with ctx.workprec(jump.BITS):
            true = jump.stated_points(PAPER, arb("0.02"))
            other = true | {point: (true[point][0], true[point][1] + arb(2) ** -90)}
        monkeypatch.setattr(jump, "stated_points", lambda *_: other)
    monkeypatch.setattr(jump, "check_landings", lambda _: None)
    with pytest.raises(NotProvedError, match=reason):
        jump.check(SET.text(), **numbers)


def test_images_that_are_apart_in_x_or_in_y_are_apart(monkeypatch):
    monkeypatch.setattr(jump, "check_landings", lambda _: None)
    monkeypatch.setattr(jump, "check_stated", lambda *_: None)
    true = jump.stated_points(PAPER, arb("0.02"))
    for near, far, apart in (((0, 0), (0.4, 0), True), ((0, 0), (0, -0.4), True),
                             ((0, 0), (0.2, 0.2), False), ((0, 0), (0, 0), False)):  # fmt: skip
        images = {"near image": tuple(map(arb, near)), "far image": tuple(map(arb, far))}
        monkeypatch.setattr(jump, "stated_points", lambda *_, images=images: true | images)
        assert (SET.check().verdict == "proved") == apart


@pytest.mark.parametrize("error", [UndecidedError, None])
@pytest.mark.parametrize("angles", [(0.32, 0.321), (3.1415, 3.14159), (1.5, 1.50001)])
def test_landings_are_proved_at_every_angle_of_the_rim(angles, error, monkeypatch):
    """A flight that touches once more is undecided; one that lands must have s > 0."""
    low, high = map(arb, angles)
    landed = []

    def land(_, angle):
        landed.append(angle)
        bad = angle.overlaps(low.union(high))
        if bad and error:
            raise UndecidedError("a touch")
        return Impact(arb(0), arb(0), arb(1), arb(-1e-9 if bad else 1, 1e-8 if bad else 0))

    monkeypatch.setattr(jump, "_landing", land)
    with pytest.raises(NotProvedError, match="touch the floor a second time"):
        jump.check_landings(PAPER)
    low, high = arb(9), arb(10)
    jump.check_landings(PAPER)
    assert min(a.lower() for a in landed) <= arb(0.95).acos()
    assert max(a.upper() for a in landed) >= arb.pi()


@pytest.mark.parametrize(("share", "lands"), [(0.98, True), (1.02, False)])
def test_the_shortest_flights_land_by_an_inequality(share, lands, monkeypatch):
    """-(g + x) < xdot^2/(4 A), just below and above it."""
    beyond = bound_of_short_flights(share)
    monkeypatch.setattr(jump, "_rim_point", lambda *_: (arb("0.05"), arb(str(beyond))))
    monkeypatch.setattr(jump, "_landing", lambda *_: Impact(*map(arb, (0, 0, 1, 1))))
    with told("" if lands else "shortest flights from the rim"):
        jump.check_landings(PAPER)


def bound_of_short_flights(share):
    """-(g + x) at a share of the inequality's bound, for xdot = 0.05."""
    v = mpmath.mpf("0.05")
    return mpmath.findroot(lambda d: d - share * v * v / (4 * mpmath.hypot(G + d, v)), 0.01)


@pytest.mark.parametrize(("impact", "reason"), [
    (lambda it: it._replace(tau=it.tau + arb("1e-3")), "not touch the floor where it should"),
    (lambda it: it._replace(tau=it.tau * arb(1, 0.5)), "may not change sign"),
])  # fmt: skip
def test_the_gap_must_touch_and_change_its_sign(impact, reason, monkeypatch):
    whole = jump._landing_from_rim
    assert 0.3 < jump._transversality(PAPER, arb("0.02")) < 3
    monkeypatch.setattr(jump, "_landing_from_rim", lambda *at: impact(whole(*at)))
    with pytest.raises(NotProvedError, match=reason):
        jump._transversality(PAPER, arb("0.02"))


def test_only_rim_points_beyond_the_least_strain_have_angles():
    exact = Surface("1", "1/4", "11/32"), arb("0.5")  # the fastest, in doubles
    for given in (exact, *((PAPER, v) for v in (arb("0.1172"), arb("-0.1172"), arb(0, 0.2)))):
        with pytest.raises(NotProvedError, match="not one of a rim point with x < -g"):
            jump._rim_angle(*given)
    assert abs(jump._rim_angle(PAPER, jump.fastest_touch(PAPER) / -2) - arb.pi() * 2 / 3) < 1e-14


def test_no_flight_touches_up_to_the_energy_of_the_first_touch():
    exact = Surface("1", "1/4", "3/32")  # 2 E = g^2 (2 + k) in doubles
    for surface in (BELOW, Surface("1/5", "1/25", "1/1000"), exact):
        with pytest.raises(NotProvedError, match="no flight touches the floor"):
            jump.fastest_touch(surface)
    assert jump.fastest_touch(Surface("1/5", "1/25", "11/6249")) > 0


# ---- the crossing

UNIT = hset("N", [0, 0, 1, 0, 0, 1])


@pytest.fixture
def crossing(monkeypatch):
    """Prove that the curve speed -> (p, q) crosses the unit square; xdot from -1 to 1."""

    def prove(p, q, low=-1, high=1):
        monkeypatch.setattr(
            jump, "_landing_from_rim",
            lambda _, speed: Impact(p(speed), -q(speed), arb(1), arb(1)),
        )  # fmt: skip
        return jump.prove_crossing(None, UNIT, arb(low), arb(high))

    return prove


@pytest.mark.parametrize("sign", [-1, 1])
def test_a_curve_crosses_from_edge_to_edge(crossing, sign):
    for p, q, margin in ((0.25, 1.5, 0.5), (-0.25, 1.5, 0.5), (0.75, 2, 0.25)):
        found = crossing(lambda t, p=p: arb(p) + 0 * t, lambda t, q=q: sign * q * t)
        assert margin - 1e-9 < found <= margin
    for low, high in ((-0.6, 1), (-1, 0.6), (0.7, 1), (-1, -0.7), (1, -0.6)):
        with pytest.raises(NotProvedError, match="N: the jump set may not reach both"):
            crossing(lambda t: 0 * t, lambda t: sign * 1.5 * t, low, high)
    # both ends beyond one edge, with the other edge reached in between
    for shape in (1, -1):
        with pytest.raises(NotProvedError, match="N: the jump set may not reach both"):
            crossing(lambda t: 0 * t, lambda t, shape=shape: shape * (3 * t * t - 1.5))
    assert crossing(lambda t: 0 * t, lambda t: sign * (t + t / 4), 1, -1) == 0.25
    for reach, aside in ((arb(1.2, 0.3), 0), (1.25, 0.25), (1.25, -0.25)):
        with pytest.raises(NotProvedError, match="N: the jump set may not reach both"):
            crossing(lambda t: 0 * t, lambda t, a=reach, b=aside: sign * a * t + b)


@pytest.mark.parametrize("sign", [-1, 1])
@pytest.mark.parametrize("place", [-1, -0.98, -0.3, 0.01, 0.6, 0.99, 1])
def test_a_curve_that_leaves_the_set_sideways_anywhere_does_not_cross(crossing, place, sign):
    def aside(t):
        return sign * 1.2 / (1 + 1e4 * ((t - place) ** 2).nonnegative_part())

    with pytest.raises(NotProvedError, match="N: the jump set may leave it sideways"):
        crossing(aside, lambda t: 1.5 * t)


# ---- the chain to the jump set


@pytest.fixture
def circle(monkeypatch):
    """Check the certificate with relations that are made up; returns the finding and the calls."""

    def check(old="", new="", **made):
        calls = []

        def relation(source, target, *values):
            calls.append(f"{source.name} {target.name}")
            return values if len(values) > 1 else values[0]

        points = [(arb(str(row[0])), arb(str(row[1]))) for row in SADDLES]
        parts = {
            (periodic, "prove_saddles"): lambda *_: SimpleNamespace(points=points),
            (hsets, "prove_hyperbolic"): lambda _, a, b: relation(
                a, b, (0.5 if a.name == "S_5" else 1.0, 1.0), 0.25 if a.name == "S_4" else 1, None),
            (hsets, "prove_covering"): lambda _, a, b: relation(a, b, (2.0, 0.75)),
            (jump, "check_landings"): lambda _: calls.append("landings"),
            (jump, "prove_crossing"): lambda _, last, low, high: calls.append(
                f"{last.name} {float(low):.4f} {float(high):.4f}") or 0.125,
        }  # fmt: skip
        for (module, name), value in parts.items():
            monkeypatch.setattr(module, name, made.get(name, value))
        assert old in CIRCLE.text()
        return CIRCLE.prove(CIRCLE.text().replace(old, new)), calls

    return check


SADDLES = [
    [float(a) for a in line.strip(" [],").split(", ")]
    for line in CIRCLE.text().partition("saddles = [\n")[2].partition("\n]")[0].splitlines()
]


def test_the_loop_is_closed_and_the_chain_leads_to_the_jump_set(circle):
    found, calls = circle()
    chain = [it.name for it in found.parts["chain"]]
    loop = [f"S_{i} S_{(i + 1) % 6}" for i in range(6)]
    links = [f"{a} {b}" for a, b in pairwise(["S_0", *chain])]
    assert calls[:-2] == loop + links and calls[-2] == "landings"
    assert calls[-1].startswith(f"{chain[-1]} ")
    assert chain == [f"M_{i}" for i in range(1, len(chain) + 1)]
    assert found.margins == {"beyond": 0.5, "room": 0.75, "cones": 0.25, "crossing": 0.125}
    for p, q in ((-1, -1), (1, 1), (1, -1), (-1, 1)):
        corner = found.parts["chain"][-1].box(arb(p), arb(q))[0]
        assert found.digits["jump set at x"].overlaps(corner)
    assert circle("leaves = 0", "leaves = 5")[1][6] == "S_5 M_1"


@pytest.mark.parametrize(("old", "new", "reason"), [
    ("leaves = 0", "leaves = 6", "does not begin at its saddles"),
    ("leaves = 0", "leaves = -1", "does not begin at its saddles"),
    ("0.211071120848482996929499820042, 0.0307", "0.212071120848482996929499820042, 0.0307",
     "S_0 is not proved to contain"),
])  # fmt: skip
def test_the_chain_begins_at_sets_around_the_orbit(circle, old, new, reason):
    with pytest.raises(NotProvedError, match=reason):
        circle(old, new)


@pytest.mark.parametrize("name", [
    "prove_saddles", "prove_hyperbolic", "prove_covering", "check_landings", "prove_crossing",
])  # fmt: skip
def test_the_chain_needs_each_of_its_parts(circle, name):
    with pytest.raises(NotProvedError, match=f"no {name}"):
        circle(**{name: lambda *_: refuse(f"no {name}")})


# ---- no touch below an energy


@pytest.mark.parametrize(("energy", "roots", "stated", "reason"), [
    ("11/6250", ("-1/25", "11/25"), "11/6250", ""), ("11/6250", ("11/25", "-1/25"), "11/6250", ""),
    ("11/6250", ("-1/25", "11/25"), "11/6251", "energy below 11/6250, not 11/6251"),
    ("11/6250", ("0", "2/5"), "11/6250", "product of factors"),  # another energy's
    ("11/6250", ("-11/250", "2/5"), "11/6250", "product of factors"),  # another g's
    ("0.00225", ("-0.05", "0.45"), "0.00225", "negative for x < -g"),
    ("0.00225", ("0.45", "-0.05"), "0.00225", "negative for x < -g"),
    ("-1/250", ("1/5", "1/5"), "-1/250", "margin above least"),
])  # fmt: skip
def test_the_map_is_smooth_where_both_factors_are_negative(energy, roots, stated, reason):
    text = (f'kind = "no touch"\nk = "1/5"\ng = "1/25"\nenergy_below = "{energy}"\n'
            f'roots = ["{roots[0]}", "{roots[1]}"]')  # fmt: skip
    bounds = Fraction(1, 5), Fraction(1, 25), Fraction(stated)
    with told(reason):
        margin = jump.check_smooth(text, *bounds).margins["above least"]
        assert margin == pytest.approx(11 / 6250 + 1 / 250)


def test_flights_from_the_rim_start_below_the_floor(monkeypatch):
    """Up to the start time the whole ball's bound -beyond/2 + xdot t/6 + A t^2/24 is negative."""
    starts = []
    monkeypatch.setattr(flight, "_isolate", lambda *at: starts.append(at[1]) or (arb(1), arb(2)))
    monkeypatch.setattr(flight, "_refine", lambda *_: None)
    wide = arb(-0.1, 0.02), arb(0.02, 0.01)
    for xdot, beyond in (wide, (arb(-0.3), arb(0)), (arb(0.1), arb(1))):
        flight.flight_from_rim(arb("0.04"), xdot, beyond)
        start, g = starts.pop(), mpmath.mpf("0.04")
        assert (start is None) == (xdot > 0)
        if start is not None:
            slow, far = -float(xdot.upper()), float(beyond.upper())
            amplitude = mpmath.hypot(g + far, -float(xdot.lower()))
            assert start <= 4 * slow / amplitude
            assert start > 3.9 * slow / amplitude * (1 if xdot.is_exact() else 0.8)
    with pytest.raises(UndecidedError, match="may have x > -g"):
        flight.flight_from_rim(arb("0.04"), arb(-0.1), arb(0, 1e-9))
