"""The march in ball arithmetic: each bound at its worst case, wide balls, and near touches."""

import math
from dataclasses import replace

import mpmath
import numpy as np
import pytest
from flint import arb, ctx
from mpmath import mpf

from helpers.flights import FAMILIES, draw, near_grazing, near_miss, on_the_rim
from helpers.independent_solver import Gap, first_root
from pseudorigid.verified import flight
from pseudorigid.verified.flight import Flight, UndecidedError, launch


def corners(*balls):
    """Every choice of the ends and the midpoint of some balls, as floats."""
    sides = [sorted({float(a.lower()), float(a.mid()), float(a.upper())}) for a in balls]
    return np.array(np.meshgrid(*sides)).reshape(len(sides), -1).T.tolist()


def gaps(its, count=27):
    """Gaps of the flights with some choices of x, c, s in balls."""
    chosen = corners(its.x, its.c, its.s)
    for state in chosen[:: max(1, len(chosen) // count)]:
        x, c, s = map(mpf, state)
        if s >= 0:
            yield Gap(x, -s - c, c, s, mpf(float(its.g)))


def flights_of(family, seed, count, width=0.0):
    """Flights of a family of hard states, in balls of a relative width."""
    for k, g, x, v, w in draw(family, seed, count):
        s = v + w
        its = launch(*map(arb, (k, g, x, v, w, s)))
        b, c = (arb(float(a)) for a in (its.b, its.c))
        wide = (arb(a, abs(float(a)) * width) for a in (c, s))
        yield Flight(arb(x, abs(x) * width), b, *wide, its.g)


# ---- the gap and its derivatives


def test_the_gap_its_derivatives_and_the_end_are_those_of_the_equations():
    """Of eq. (21) with (25), (26) and (28), written out once more."""
    with ctx.workprec(200), mpmath.workdps(50):
        k, g, x, v, w, t = map(mpf, ("0.2", "0.04", "0.3", "0.07", "0.05", "1.7"))
        s = v + w
        b, c = v - 2 * k * s / (1 + k), w - 2 * s / (1 + k)

        def position(t):
            return x * mpmath.cos(t) - c * mpmath.sin(t)

        def gap(t):
            return x + b * t + g * t * t / 2 - position(t)

        numbers = [arb(mpmath.nstr(a, 48)) for a in (k, g, x, v, w, s)]
        its, time = launch(*numbers), arb("1.7")
        true = [mpmath.diff(gap, t, n) for n in range(4)]
        found = its.derivatives(time)
        assert its.height(time).overlaps(found[0]) and its.slope(time).overlaps(found[1])
        end = (position(t), mpmath.diff(lambda t: b * t + g * t * t / 2, t),
               -mpmath.diff(position, t))  # fmt: skip
        for value, number in zip((*found, *its.end(time), its.b, its.c), (*true, *end, b, c),
                                 strict=True):  # fmt: skip
            assert abs(value - arb(mpmath.nstr(number, 40))) < 1e-18


# ---- bounds at their worst case


def worst(t, f, d, curvature, jerk, most, jerk_bound):
    """The largest gap at t with f''' <= jerk + jerk_bound t, or jerk_bound, and f'' <= most."""
    times = np.linspace(0.0, t, 2001)
    if jerk is None:
        bend = curvature + jerk_bound * times
    else:
        bend = curvature + max(jerk, 0.0) * times + jerk_bound * times**2 / 2
    bend = np.minimum(bend, most)
    return f + d * t + np.trapezoid((t - times) * bend, times)


@pytest.mark.parametrize("jerk", [None, -0.3, 0.0, 0.4])
@pytest.mark.parametrize("width", [0.0, 0.05])
def test_the_worst_gap_stays_negative_for_a_step(jerk, width):
    """With a curvature for which the step is as long as the bound holds, or nearly so."""
    random, long_steps = np.random.default_rng(3), 0
    for factor in np.repeat([1 - 1e-3, 1 + 1e-3, 0.5, 2.0, -1.0], 30):
        f, d = -(10 ** random.uniform(-3, 0)), random.normal()
        most, jerk_bound = 10 ** random.uniform(-1, 1), 10 ** random.uniform(-2, 1)
        reach = 2 * flight._parabola_root(f, d, most)
        growth = jerk_bound if jerk is None else max(jerk, 0.0) + jerk_bound * reach / 4
        tight = -2 * (f + d * reach) / reach**2 - growth * reach / 3
        curvature = min(factor * tight, most)
        balls = [arb(a - width * abs(a), width * abs(a)) for a in (f, d, curvature)]
        known = None if jerk is None else arb(jerk - width, width)
        step = float(flight._step(*balls, known, arb(most), arb(jerk_bound)))
        assert step > 0
        top = None if jerk is None else float(known.upper())
        for share in (0.25, 0.5, 0.75, 1.0):
            assert worst(share * step, f, d, curvature, top, most, jerk_bound) < 1e-6 * abs(f)
        assert step >= 0.999 * flight._parabola_root(f, d, most)
        long_steps += step > 1.9 * flight._parabola_root(f, d, most)
    assert long_steps > 30


def test_a_step_that_is_proposed_too_long_is_not_taken(monkeypatch):
    root = flight._parabola_root
    at = arb(-1), arb(0.5), arb(1), None, arb(1), arb(1e-9)
    assert 0.9 * root(-1, 0.5, 1) < flight._step(*at) < root(-1, 0.5, 1)
    monkeypatch.setattr(flight, "_parabola_root", lambda *of: 1.00001 * root(*of))
    assert flight._step(*at) == 0 and flight._step(arb(0), *at[1:]) == 0
    assert flight._step(arb(-1, 2), *at[1:]) == 0


@pytest.mark.parametrize(("x", "c", "s", "why"), [
    (0.1, 0.3, 0.2, "s > 0"), (-0.3, 0.3, 0.2, "s > 0, x < -g"), (-0.3, 0.3, 0.0, "s = 0, x < -g"),
    (-0.3, -0.3, 0.0, "s = 0, x < -g"), (-0.25, 0.3, 0.0, "x = -g"), (0.1, -0.3, 1e-6, "nearly"),
])  # fmt: skip
@pytest.mark.parametrize("width", [0.0, 0.02])
def test_the_worst_gap_stays_negative_for_the_first_step(x, c, s, why, width):
    exact = why == "x = -g"
    balls = [arb(a, 0.0 if exact and a != c else width * abs(a)) for a in (x, c, s)]
    its = Flight(balls[0], None, *balls[1:], arb(0.25))
    with ctx.workprec(64):
        amplitude = (its.x * its.x + its.c * its.c).sqrt()
        t = flight._first_step(its, amplitude.upper())
    a = float(amplitude.upper())
    bounds = []
    for px, pc, ps in corners(*balls):
        if exact:
            bounds.append(-pc / 6 + a * float(t) / 24)
        else:
            bounds.append(-ps + (0.25 + px) * float(t) / 2 + a * float(t) ** 2 / 6)
    assert -0.01 * a * (1 + float(t)) < max(bounds) < 0  # sharp for the worst of them


# "c > 0" cannot fail alone at x = -g: a step t > 0 implies it.
@pytest.mark.parametrize(("x", "c", "s", "reason"), [
    (0.1, 0.1, arb(0), "may be grazing"), (0.1, 0.1, arb(0, 1e-9), "may be grazing"),
    (0.1, 0.1, arb(-1), "may be grazing"), (-0.5, 0.1, arb(0, 1e-9), "may be grazing"),
    (-0.5, 0.1, arb(-1), "may be grazing"), (arb(-0.5, 0.3), 0.1, arb(0), "may be grazing"),
    (-0.25, -0.1, arb(0), "may rest"), (-0.25, 0, arb(0), "may rest"),
    (-0.25, arb(0.1, 0.2), arb(0), "may rest"), (arb(-0.25, 1e-9), 0.1, arb(0), "may be grazing"),
])  # fmt: skip
def test_a_flight_that_may_not_leave_the_floor_is_undecided(x, c, s, reason):
    x, c = (a if isinstance(a, arb) else arb(a) for a in (x, c))
    with pytest.raises(UndecidedError, match=reason):
        Flight(x, -s - c, c, s, arb(0.25)).first_root()
    for g in (arb(0), arb(0.25, 0.3)):
        with pytest.raises(UndecidedError, match="g is not proved to be positive"):
            Flight(arb(-1), arb(-0.6), arb(0.1), arb(0.5), g).first_root()


@pytest.mark.parametrize("width", [0.0, 1e-14, 0.01, 0.1])
def test_the_interval_of_a_long_flight_is_below_the_floor(width):
    """Its bound x + A + b t + g t^2/2 is negative at both ends, for each choice in the balls."""
    random, some = np.random.default_rng(4), 0
    for _ in range(200):
        (x, c), s, g = random.normal(size=2), 10 ** random.uniform(-1, 1.5), random.random()
        balls = [arb(a, width * abs(a)) for a in (x, c, s, g)]
        its = Flight(balls[0], None, *balls[1:])
        amplitude = (its.x * its.x + its.c * its.c).sqrt()
        found = flight._long_flight(its, amplitude)
        if found is None:
            square = 2 * g * (x + math.hypot(x, c))
            assert width > 0 or s + c <= 0 or (s + c) ** 2 < 1.01 * square
            continue
        some += 1
        low, high = map(float, found)
        assert low < high
        for x, c, s, g in corners(*balls):
            height, b = x + math.hypot(x, c), -s - c
            for t in (low, high):
                assert height + b * t + g * t * t / 2 < 1e-12
            if width == 0:
                root = math.sqrt(b * b - 2 * g * height)
                assert low < (-b - root) / g * (1 + 1e-8) + 1e-8
                assert high > (-b + root) / g * (1 - 2e-6)
    assert some > 30 or width > 1e-3


@pytest.mark.parametrize("family", [near_grazing, near_miss, on_the_rim])
def test_an_interval_isolates_the_first_root_of_flights_near_a_touch(family):
    """f < 0 before it, f' > 0 on it, and f > 0 at its end."""
    decided = 0
    for its in flights_of(family, 5, 40):
        try:
            with ctx.workprec(128):
                low, high = flight._isolate(its)
        except UndecidedError:
            continue
        decided += 1
        with mpmath.workdps(60):
            gap = Gap(*(mpf(float(a)) for a in (its.x, -its.s - its.c, its.c, its.s, its.g)))
            low, high = (mpf(a.str(40, radius=False)) for a in (low, high))
            assert gap(low) < 0 < gap(high) and low < first_root(gap)[0] < high
            assert min(gap.slope(low + (high - low) * i / 40) for i in range(41)) > 0
    assert decided > 12


@pytest.mark.parametrize("family", FAMILIES)
def test_a_root_of_wide_balls_contains_those_of_their_flights(family):
    """Where the balls' width is far above the rounding."""
    decided = 0
    for its in flights_of(family, 6, 20, width=1e-5):
        try:
            root = its.first_root()
        except UndecidedError:
            continue
        decided += 1
        with mpmath.workdps(40):
            for gap in gaps(its, 6):
                tau = first_root(gap)[0]
                assert root.overlaps(arb(mpmath.nstr(tau, 30), float(tau) * 1e-25))
    assert decided > 3 or family is on_the_rim


def test_a_root_at_which_the_slope_may_vanish_is_undecided():
    """Newton's method cannot take one step with all bits; it takes at least one."""
    its = Flight(arb("0.1"), arb("-0.4"), arb("0.1"), arb("0.3"), arb("0.25"))
    root = its.first_root()
    assert its.slope(arb(1, 1)).contains(0)
    with pytest.raises(UndecidedError, match="two impacts may be one"):
        flight._refine(its, arb(0), arb(2))
    with pytest.raises(UndecidedError, match="two impacts may be one"):
        flight._refine(replace(its, x=arb("0.1", 3)), root.lower(), root.upper())
    for low, high in ((root.lower() - 0.1, root.upper() + 0.05), (root.lower(), root.upper())):
        assert flight._refine(its, low, high).overlaps(root)


def test_a_march_that_reaches_no_root_is_undecided(monkeypatch):
    """Its steps end, or become too short; and a start that is not below the floor is none."""
    its = Flight(arb("-0.6"), arb("-0.4"), arb("0.1"), arb("0.3"), arb("0.25"))
    for name, value in (("_MOST_STEPS", 0), ("_step", lambda *_: arb(0))):
        with monkeypatch.context() as patch, pytest.raises(UndecidedError, match="may touch"):
            patch.setattr(flight, name, value)
            flight._isolate(its)
    for start in (arb(20), arb("nan")):
        with pytest.raises(UndecidedError, match="may touch"):
            flight._isolate(its, start)
