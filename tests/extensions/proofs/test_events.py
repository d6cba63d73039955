"""Births, doublings and ends of orbits: right in another map, and weaker certificates refused."""

import re
from fractions import Fraction

import mpmath
import pytest
from certificates import refused, with_field
from flint import arb, ctx
from independent_solver import exact_map

from extensions.proofs import THEOREMS
from extensions.proofs.checkers import events, fixed_point
from pseudorigid.dynamics.fixed_point import resonance

CHECKERS = (fixed_point.check_resonance, events.check_doubling, events.check_grazing)
EVENTS = [name for name, theorem in THEOREMS.items() if theorem.checker in CHECKERS]
BOXED = [name for name in EVENTS if "radius" in THEOREMS[name].bounds]


@pytest.fixture(scope="module")
def results():
    return {name: THEOREMS[name].check() for name in EVENTS}


def values_of(results, name, *names):
    """Some digits of a theorem as numbers of mpmath."""
    return [mpmath.mpf(results[name].digits[n].strip("[").split()[0]) for n in names]


# ---- an independent map of 60 digits


def flights(k, g, state, count):
    """The state after some flights."""
    for _ in range(count):
        *state, _ = exact_map(k, g, *state)
    return state


def apex_rate(k, g, state):
    """The rate of strain where the centre is highest after an impact."""
    x, v, w = state
    s = v + w
    t = -(v - 2 * k * s / (1 + k)) / g
    return x * mpmath.sin(t) + (w - 2 * s / (1 + k)) * mpmath.cos(t)


@pytest.mark.parametrize("name", ["six-elliptic-end", "six-inverse-birth"])
def test_orbits_that_graze_at_rest_close(name, results):
    """At the proved energy and, with a small contact speed or gap, where the slopes say."""
    with mpmath.workdps(60):
        k, g = mpmath.mpf(1) / 5, mpmath.mpf(1) / 25
        energy, by_speed, by_gap = values_of(results, name, "energy", "dE/ds", "dE/dh")

        def condition(last):
            return apex_rate(k, g, last) if "birth" in name else last[1] - k * last[2]

        def longer(speed, energy):
            v, w = k * speed / (1 + k), speed / (1 + k)
            x = (g - mpmath.sqrt(g * g + k * (2 * energy - v * v - k * w * w))) / k
            return condition(flights(k, g, (x, v, w), 3))

        def shorter(gap, energy):
            a = (g - mpmath.sqrt(g * g + 2 * k * (energy - g * gap))) / k
            t = mpmath.findroot(lambda t: -gap + g * t * t / 2 + a * (1 - mpmath.cos(t)), first)
            return condition(flights(k, g, (a * mpmath.cos(t), g * t, a * mpmath.sin(t)), 2))

        *_, first = exact_map(k, g, (g - mpmath.sqrt(g * g + 2 * k * energy)) / k, 0, 0)
        small = mpmath.mpf(10) ** -10
        assert abs(longer(mpmath.mpf(0), energy)) < 1e-26
        for closing, slope in ((longer, by_speed), (shorter, by_gap)):
            assert abs(closing(small, energy + slope * small)) < 1e-16
            assert abs(closing(small, energy)) > 1e-13


def test_the_orbit_that_grazes_in_flight_closes(results):
    with mpmath.workdps(60):
        k, g = mpmath.mpf(1) / 5, mpmath.mpf(1) / 25
        energy, y = values_of(results, "six-hyperbolic-end", "energy", "y")
        v = y / (1 + k)
        x = (g - mpmath.sqrt(g * g + k * (2 * energy - (1 + k) * v * v))) / k
        assert abs(apex_rate(k, g, (x, -v, v))) < 1e-25  # backwards
        assert abs(apex_rate(k, g, flights(k, g, (x, v, -v), 2))) < 1e-25


def test_the_orbit_that_doubles_closes_and_has_its_trace(results):
    with mpmath.workdps(60):
        k, g = mpmath.mpf(1) / 5, mpmath.mpf(1) / 25
        energy, x = values_of(results, "six-elliptic-doubling", "energy", "x")
        step = mpmath.mpf(10) ** -20

        def image(x, y, count):
            s = mpmath.sqrt(((1 + k) * (2 * energy + 2 * g * x - k * x * x) - y * y) / k)
            x, v, w = flights(k, g, (x, (y + k * s) / (1 + k), (s - y) / (1 + k)), count)
            return x, v - k * w

        assert abs(image(x, mpmath.mpf(0), 3)[1]) < 1e-25
        trace = image(x + step, mpmath.mpf(0), 6)[0] - image(x - step, mpmath.mpf(0), 6)[0]
        trace += image(x, step, 6)[1] - image(x, -step, 6)[1]
        assert abs(trace / (2 * step) + 2) < 1e-15


def test_the_birth_is_at_the_closed_form(results):
    (energy,) = values_of(results, "six-birth", "energy")
    assert abs(energy / (resonance(0.2, 1, 6) * mpmath.mpf("0.0016")) - 1) < 1e-14


def test_derivatives_are_those_of_differences():
    """Of the conditions of a grazing orbit and of a doubling, by each unknown."""
    bounds = THEOREMS["six-hyperbolic-end"].bounds
    ball, halves = (bounds["k"], bounds["g"]), bounds["halves"]
    with ctx.workprec(256):
        step = arb(10) ** -30
        for values, system in (
            (("0.0427265259", "0.1671754304"), lambda *v: events.grazing(*ball, v, halves)),
            (("0.0108252527", "0.3054433593"), lambda *v: events.doubling(*ball, v, 6)),
        ):
            a, b = map(arb, values)
            rows = system(a, b)[1]
            ends = (a + step, b), (a - step, b), (a, b + step), (a, b - step)
            images = [system(*end)[0] for end in ends]
            for i, (ahead, behind) in enumerate((images[:2], images[2:])):
                for row, high, low in zip(rows, ahead, behind, strict=True):
                    slope = (high - low) / (2 * step)
                    assert abs(slope - row[i]) < arb("1e-20") * (1 + abs(row[i]))


# ---- refusals


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
    ("six-birth", "rotation", Fraction(1, 7), "period 6"),
    ("six-birth", "energies", (Fraction("0.0073"), Fraction("0.007378")), "where"),
    ("six-elliptic-doubling", "trace", 2, "-2"),
    ("six-elliptic-doubling", "positions", (Fraction("0.3"), Fraction("0.305")), "where"),
    *((name, "energies", (Fraction("0.02"), Fraction("0.03")), "where") for name in BOXED),
    *((name, "sides", tuple(-s for s in THEOREMS[name].bounds["sides"]), "exist")
      for name in BOXED if "sides" in THEOREMS[name].bounds),
    ("six-elliptic-end", "periods", (7, 6), "periods 6, 5"),
    ("six-elliptic-end", "halves", ((3, "apex"),), "periods 7, 6"),
    ("six-hyperbolic-end", "halves", ((1, "apex"), (1, "apex")), ""),
    *((name, "radius", 10 * THEOREMS[name].bounds["radius"], "as stated") for name in BOXED),
])  # fmt: skip
def test_a_stronger_or_another_statement_is_not_proved(name, bound, value, reason):
    assert reason in refused(name, **{bound: value})
