"""Births, doublings and ends of orbits: right in another map, and weaker certificates refused."""

import re
from fractions import Fraction

import mpmath
import numpy as np
import pytest
from flint import arb, ctx

from extensions.proofs import THEOREMS
from extensions.proofs.checkers import events, fixed_point
from extensions.proofs.checkers.certificate import Certificate, NotProvedError
from extensions.proofs.enclosure.jets import Jet
from helpers.exact_orbits import after, apex
from helpers.independent_solver import exact_map
from helpers.parts.certificates import refused, told, with_field
from pseudorigid.verified.flight import Flight, UndecidedError

CHECKERS = (fixed_point.check_resonance, events.check_doubling, events.check_grazing)
EVENTS = [name for name, theorem in THEOREMS.items() if theorem.checker in CHECKERS]
K, G = Fraction(1, 5), Fraction(1, 25)
BOXED = [name for name in EVENTS if "radius" in THEOREMS[name].bounds]


@pytest.fixture(scope="module")
def results():
    return {name: THEOREMS[name].check() for name in EVENTS}


def values_of(results, name, *names):
    """Some digits of a theorem as numbers of mpmath."""
    return [mpmath.mpf(results[name].digits[n].strip("[").split()[0]) for n in names]


# ---- an independent map of 60 digits


@pytest.mark.parametrize("name", ["six-elliptic-end", "six-inverse-birth"])
def test_orbits_that_graze_at_rest_close(name, results):
    """At the proved energy and, with a small contact speed or gap, where the slopes say."""
    with mpmath.workdps(60):
        k, g = mpmath.mpf(1) / 5, mpmath.mpf(1) / 25
        energy, by_speed, by_gap = values_of(results, name, "energy", "dE/ds", "dE/dh")

        def condition(last):
            return apex(k, g, last)[1] / k if "birth" in name else last[1] - k * last[2]

        def longer(speed, energy):
            v, w = k * speed / (1 + k), speed / (1 + k)
            x = (g - mpmath.sqrt(g * g + k * (2 * energy - v * v - k * w * w))) / k
            return condition(after(k, g, (x, v, w), 3))

        def shorter(gap, energy):
            a = (g - mpmath.sqrt(g * g + 2 * k * (energy - g * gap))) / k
            t = mpmath.findroot(lambda t: -gap + g * t * t / 2 + a * (1 - mpmath.cos(t)), first)
            return condition(after(k, g, (a * mpmath.cos(t), g * t, a * mpmath.sin(t)), 2))

        *_, first = exact_map(k, g, (g - mpmath.sqrt(g * g + 2 * k * energy)) / k, 0, 0)
        small = mpmath.mpf(10) ** -10
        assert abs(longer(mpmath.mpf(0), energy)) < 1e-26
        for closing, slope in ((longer, by_speed), (shorter, by_gap)):
            assert abs(closing(small, energy + slope * small)) < 1e-16
            assert abs(closing(small, energy)) > 1e-13


def test_the_orbit_that_grazes_in_flight_closes(results):
    """With a small contact speed or gap too: its other unknown, y, is solved for."""
    with mpmath.workdps(60):
        k, g = mpmath.mpf(1) / 5, mpmath.mpf(1) / 25
        names = "energy", "y", "dE/ds", "dE/dh"
        energy, y, *slopes = values_of(results, "six-hyperbolic-end", *names)

        def ends(energy, y, s, h):
            """The conditions forwards, and backwards from the mirror image."""
            v, w = (y + k * s) / (1 + k), (s - y) / (1 + k)
            x = (g - mpmath.sqrt(g * g + k * (2 * energy - 2 * g * h - v * v - k * w * w))) / k
            state, count = (x, v, w), 2
            if h:  # the first flight begins h below the floor
                t = mpmath.findroot(lambda t: -h + g * t * t / 2 + w * (mpmath.sin(t) - t)
                                    + x * (1 - mpmath.cos(t)), first)  # fmt: skip
                cosine, sine = mpmath.cos_sin(t)
                state, count = (x * cosine - w * sine, v + g * t, x * sine + w * cosine), 1
            mirrored = x, (k * s - y) / (1 + k), (s + y) / (1 + k)
            ahead = after(k, g, state, count)
            return apex(k, g, ahead)[1] / k, apex(k, g, mirrored)[1] / k

        x = (g - mpmath.sqrt(g * g + k * (2 * energy - y * y / (1 + k)))) / k
        *_, first = exact_map(k, g, x, y / (1 + k), -y / (1 + k))
        assert max(map(abs, ends(energy, y, 0, 0))) < 1e-25
        small = mpmath.mpf(10) ** -12
        for slope, (s, h) in zip(slopes, ((small, 0), (0, small)), strict=True):
            moved = mpmath.findroot(lambda e, y, s=s, h=h: ends(e, y, s, h), (energy, y))[0]
            assert abs((moved - energy) / small - slope) < 1e-7


def test_the_trace_falls_along_the_family_of_the_doubling(results):
    """By differences of the monodromy's trace, 4 A D - 2, between two energies."""
    with ctx.workprec(300):
        step, traces = arb(10) ** -20, []
        energy, x = (arb(results["six-elliptic-doubling"].digits[n]).mid() for n in ("energy", "x"))
        for e in (energy - step, energy + step):
            at = x
            for _ in range(6):
                _, y = events._after_impacts(K, G, (e, at), 3, order=1)
                at = (at - y.constant / y[0, 1, 0]).mid()
            x_end, y_end = events._after_impacts(K, G, (e, at), 3, order=1)
            traces.append(4 * x_end[0, 1, 0] * y_end[0, 0, 1] - 2)
        slope = arb(results["six-elliptic-doubling"].digits["slope of the trace"])
        assert abs((traces[1] - traces[0]) / (2 * step) - slope) < 1e-9


# ---- flights that are clear of the floor


def test_a_flight_proved_clear_is_below_the_floor_throughout():
    """Also one that begins at the rim, nearly touches at once, or comes back soon after it."""
    random, clear = np.random.default_rng(11), 0
    for i in range(150):
        x = -0.04 - random.choice([-1, 1]) * 10 ** random.uniform(-2.5, -0.3)
        c, s = random.normal(), random.choice([0.0, 10 ** random.uniform(-9, -0.5)])
        until = 10 ** random.uniform(-3, 0.8)
        wide = 0.0 if i % 2 else 1e-3 * min(abs(x + 0.04), 1)
        balls = arb(x, wide), None, arb(c, wide), arb(s), arb("0.04")
        try:
            events._check_clear(Flight(*balls), arb(until))
        except UndecidedError:
            continue
        clear += 1
        t = np.concatenate([np.geomspace(1e-6, until, 3000), np.linspace(0, until, 3000)[1:]])
        for dx in (-wide, wide):
            f = t * (0.02 * t - s) + c * (np.sin(t) - t) + (x + dx) * 2 * np.sin(t / 2) ** 2
            rounding = 1e-15 * (abs(c) * t + s * t + 0.02 * t**2 + abs(x) * t**2)
            assert np.all(f < rounding), (x, c, s, until)
    assert clear > 40


def test_the_time_up_to_which_a_bound_shows_it_is_right_and_sharp(monkeypatch):
    """That bound is negative up to it for all flights in the balls, and not up to twice as long."""
    random, shorter = np.random.default_rng(12), 0
    for _ in range(200):
        x, c = -0.04 + random.normal() * 10 ** random.uniform(-2, 0), random.normal()
        s = random.choice([0.0, 10 ** random.uniform(-4, 0)])
        wide, spans = 0.2 * min(abs(x + 0.04), 0.1), []
        monkeypatch.setattr(events, "holds_throughout", lambda *at, to=spans: to.append(at) or True)
        its = Flight(arb(x, wide), None, arb(c, wide), arb(s), arb("0.04"))
        try:
            events._check_clear(its, arb(3))
        except UndecidedError:
            continue
        ((_, first, until, _),) = spans
        assert until == 3
        bend, jerk = 0.04 + x + wide, abs(c) + wide
        amplitude = float((its.x * its.x + its.c * its.c).sqrt().upper())

        def bounds(t, of=(bend, jerk, amplitude, s)):
            bend, jerk, amplitude, s = of
            rest = jerk * t / 6 + amplitude * t * t / 24
            return bend / 2 + rest, -s + t * (abs(bend) / 2 + rest)

        assert min(bounds(float(first))) < 1e-9
        assert first == 3 or min(bounds(2 * float(first))) > -1e-9
        shorter += first < 3
    assert shorter > 60


@pytest.mark.parametrize(("x", "c", "s", "until", "reason"), [
    (-0.3, 0.1, arb(0), 1, ""), (-0.3, 0.1, arb(0.1), 1, ""), (0.1, 0.1, arb(0.2), 1, ""),
    (-0.3, 0.1, arb(-1e-9), 1, "may be negative"), (-0.3, 0.1, arb(0, 1e-9), 1, "may be negative"),
    (0.1, 0.1, arb(0), 1, "may be grazing"), (-0.04, 0.1, arb(0), 1, "may be grazing"),
    (0.1, 0.1, arb(0.2), 20, "may come before the apex"),
])  # fmt: skip
def test_a_flight_that_may_touch_is_not_clear(x, c, s, until, reason):
    its = Flight(arb(x), -s - c, arb(c), s, arb("0.04"))
    with told(reason, UndecidedError):
        events._check_clear(its, arb(until))


def jets(*numbers):
    return [Jet.constant_of(events.algebra(2, 1), arb(a)) for a in numbers]


@pytest.mark.parametrize(("x", "b", "c", "reason"), [
    (-0.3, -0.2, 0.1, ""), (-0.3, 0.0, 0.1, "may have no apex"), (-0.3, 0.2, -0.3, "no apex"),
    (0.4, -0.2, 0.1, "may come before the apex"), (-0.3, -0.2, 0.3, "may be negative"),
])  # fmt: skip
def test_an_apex_needs_a_flight_that_is_clear_up_to_it(x, b, c, reason):
    its = Flight(*jets(x, b, c, -b - c), arb("0.04"))
    with told(reason, UndecidedError):
        rate = events._strain_rate_at_apex(its).constant
        assert abs(float(rate) - (x * np.sin(5) + c * np.cos(5))) < 1e-14


def test_a_rim_that_may_have_no_point_is_undecided():
    with pytest.raises(UndecidedError, match="no point of the rim"):
        events.grazing(K, G, [arb("-0.00400001")], ((3, "impact"),))
    with pytest.raises(UndecidedError, match="inside the section's rim"):
        events._after_impacts(K, G, (arb("0.01"), arb("0.6")), 1, order=1)


# ---- refusals


def test_an_orbit_run_through_more_than_once_does_not_double():
    """Three times the period-six orbit; and the fixed point at trace 0, whose square has -2."""
    name, other = "six-elliptic-doubling", {"radius": Fraction(1, 10**25)}
    text = with_field(THEOREMS[name].text(), "radius", "1e-25")
    assert "period may be shorter" in refused(name, text, **other, period=18)
    with ctx.workprec(256):
        low, high = arb(2), arb("2.2")
        for _ in range(200):
            theta = ((low + high) / 2).mid()
            falls = fixed_point.trace_at(arb("0.2"), theta) > 0
            low, high = (theta, high) if falls else (low, theta)
        energy = fixed_point.energy_at(arb(1) / 5, arb(1) / 25, theta)
        w = arb(1) / 25 * theta / (arb(1) / 5)
        event = [energy.mid().str(40, radius=False), (w / theta.tan()).mid().str(40, radius=False)]
    text = with_field(text, "event", str(event).replace("'", '"'))
    other |= {"period": 2, "energies": (Fraction(0), Fraction(1))}
    other |= {"positions": (Fraction(-1), Fraction(1))}
    assert "period may be shorter" in refused(name, text, **other)


def test_the_box_of_an_event_is_larger_than_the_certificates_by_the_error_of_its_numbers(
    monkeypatch,
):
    radii = []
    monkeypatch.setattr(events, "box", lambda centre, radius: radii.append(radius))
    monkeypatch.setattr(events, "enclose_zero", lambda *_: [arb(1)])
    certificate = Certificate('kind = "a"\nevent = [1]\nradius = 1e-4', "a")
    assert events._prove_event(certificate, None, 1, Fraction(1, 10**4)) == [1]
    assert radii == [Fraction(1, 10**4) + Fraction(1, 10**30)]
    with pytest.raises(NotProvedError, match="as stated"):
        events._prove_event(certificate, None, 1, Fraction(2, 10**4))


@pytest.mark.parametrize("slope", [arb(1), arb(0), arb(-1, 2)])
def test_a_trace_that_may_not_fall_is_refused(slope, monkeypatch):
    monkeypatch.setattr(events, "_trace_slope", lambda *_: slope)
    assert "to fall through -2" in refused("six-elliptic-doubling")


@pytest.mark.parametrize("name", EVENTS)
def test_another_event_is_refused(name):
    """Its last digits but a few; and a resonance with another theta."""
    text = THEOREMS[name].text()
    event = re.search(r"^event = \[(.*)\]", text, re.MULTILINE).group(1).split(", ")
    for i, value in enumerate(event):
        other = [*event[:i], f'"{Fraction(value) + Fraction(1, 10**28)}"', *event[i + 1 :]]
        changed = with_field(text, "event", f"[{', '.join(other)}]")
        assert "not the stated one" in refused(name, changed)
    if theta := re.search(r"^theta = \[(.*)\]", text, re.MULTILINE):
        ends = [f'"{Fraction(end) + Fraction(1, 10**20)}"' for end in theta.group(1).split(", ")]
        other = with_field(text, "theta", f"[{', '.join(ends)}]")
        assert "fall through" in refused(name, other)


@pytest.mark.parametrize(("name", "bound", "value", "reason"), [
    ("six-elliptic-doubling", "trace", 2, "-2"), ("six-elliptic-doubling", "period", 7, "-2"),
    ("six-elliptic-doubling", "positions", (Fraction("0.3"), Fraction("0.305")), "where"),
    *((name, "energies", (Fraction("0.02"), Fraction("0.03")), "where") for name in BOXED),
    *((name, "sides", tuple(-s for s in THEOREMS[name].bounds["sides"]), "exist")
      for name in BOXED if "sides" in THEOREMS[name].bounds),
    ("six-elliptic-end", "periods", (7, 6), "periods 6, 5"),
    ("six-elliptic-end", "periods", (6, 6), "periods 6, 5"),
    ("six-hyperbolic-end", "periods", (6, 5), "periods 6, 4"),
    *((name, "sides", (first * a, second * -a), "longer|shorter")
      for name in BOXED if "sides" in THEOREMS[name].bounds
      for first, second in [THEOREMS[name].bounds["sides"]] for a in (-1, 1)),
    ("six-elliptic-end", "halves", ((3, "apex"),), "periods 7, 6"),
    ("six-hyperbolic-end", "halves", ((1, "apex"), (1, "apex")), ""),
    *((name, "radius", 10 * THEOREMS[name].bounds["radius"], "as stated") for name in BOXED),
])  # fmt: skip
def test_a_stronger_or_another_statement_is_not_proved(name, bound, value, reason):
    assert re.search(reason, refused(name, **{bound: value}))
