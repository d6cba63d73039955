"""Orbits of exact starts: against independent orbits of many digits, killed, resumed, refused."""

import json
from decimal import Decimal
from fractions import Fraction

import mpmath
import numpy as np
import pytest
from flint import arb, ctx

from pseudorigid import Ball
from pseudorigid.dynamics.orbits import scene_orbits
from pseudorigid.proofs import true_orbit, true_scene_orbits
from pseudorigid.proofs.enclosure import surface
from pseudorigid.proofs.true_orbits import checkpoints, enclosed_run, orbit, start

BALL = Ball(k=0.2, g=0.04)
PAPER = {"k": "1/5", "g": "1/25", "energy": "1/100"}
NAMES = ("x", "xdot", "udot", "tau")


def independent(impacts, digits, x="2/5"):
    """The same orbit from `digits` decimal digits down to 60.

    The kernel says which root it is, Newton's method gives its digits. Rows of x, xdot, udot, tau
    as mpf.
    """
    rows = []
    state = None
    for i in range(impacts):
        level = digits - (digits - 60) * i // impacts
        with mpmath.workdps(level):
            k, g, energy = mpmath.mpf(1) / 5, mpmath.mpf(1) / 25, mpmath.mpf(1) / 100
            if state is None:
                x = mpmath.mpf(Fraction(x).numerator) / Fraction(x).denominator
                s = mpmath.sqrt((1 + k) * (2 * energy + 2 * g * x - k * x * x) / k)
                state = x, k * s / (1 + k), s / (1 + k)
            x, v, w = state
            s = v + w
            b, c = v - 2 * k * s / (1 + k), w - 2 * s / (1 + k)
            t = mpmath.mpf(BALL.time_to_impact(*map(float, state)))
            known = 12
            while known < level:
                known *= 2
                with mpmath.workdps(min(known, level) + 10):
                    cosine, sine = mpmath.cos_sin(t)
                    gap = x + t * (b + g * t / 2) - x * cosine + c * sine
                    t = t - gap / (b + g * t + x * sine + c * cosine)
            cosine, sine = mpmath.cos_sin(t)
            state = x * cosine - c * sine, b + g * t, x * sine + c * cosine
            rows.append((*state, t))
    return rows


def assert_rounded(data, rows):
    for i, row in enumerate(rows):
        for name, true in zip(NAMES, row, strict=True):
            assert data[name].values[i] == float(true), (i, name)


def test_each_value_is_the_nearest_double():
    assert_rounded(true_orbit(**PAPER, x="2/5", y="0", impacts=600), independent(600, 130))


@pytest.mark.slow
def test_each_value_of_4000_impacts_is_the_nearest_double():
    assert_rounded(true_orbit(**PAPER, x="2/5", impacts=4000), independent(4000, 3763))


def test_numbers_may_be_given_in_several_ways():
    text = true_orbit(**PAPER, x="2/5", impacts=50)
    other = true_orbit(Fraction(1, 5), Decimal("0.04"), "0.01", 50, x=Decimal("0.4"), y=0)
    assert text.identical(other)


def test_the_double_orbit_leaves_the_true_one_where_it_must():
    data = true_orbit(**PAPER, x="2/5", impacts=200)
    ours = np.empty((1, 200, 4))
    BALL.map.history(*(np.array([a]) for a in BALL.state_xy(0.4, 0.0, 0.01)), 0.2, 0.04, ours)
    apart = np.abs(ours[0, :, 0] - data["x"].values)
    assert apart[:20].max() < 1e-12
    assert 60 < np.argmax(apart > 1e-3) < 150


def test_more_bits_give_the_same_orbit(monkeypatch):
    data = true_orbit(**PAPER, x="2/5", impacts=300)
    monkeypatch.setattr(orbit, "bits_needed", lambda *_: 3000)
    more = true_orbit(**PAPER, x="2/5", impacts=300)
    assert more.attrs["bits"] == 3000
    assert data.equals(more)


def test_a_run_short_of_bits_starts_over_with_more(monkeypatch):
    data = true_orbit(**PAPER, x="2/5", impacts=300)
    monkeypatch.setattr(orbit, "bits_needed", lambda *_: 100)
    more = true_orbit(**PAPER, x="2/5", impacts=300)
    assert more.attrs["bits"] > 150
    assert data.equals(more)


def test_the_bound_holds_the_true_orbit():
    place = exact_start()
    run = enclosed_run.Run(place.surface, place, 150, 200)
    rows = independent(150, 80)
    for row in rows:
        run.step()
        x, y = run._box(400)
        with ctx.workprec(400), mpmath.workdps(80):
            true = [arb(mpmath.nstr(a, 75)) for a in (row[0], row[1] - row[2] / 5)]
            assert abs(x.mid() - true[0]) < x.rad() + arb("1e-70")
            assert abs(y.mid() - true[1]) < y.rad() + arb("1e-70")


def exact_start():
    return start.Start(surface.Surface("1/5", "1/25", "1/100"), {"x": "2/5", "y": 0})


def test_plain_balls_are_a_second_opinion():
    """Without a frame, in one coordinate each: many more bits, the same orbit."""
    data = true_orbit(**PAPER, x="2/5", impacts=100)
    paper = surface.Surface("1/5", "1/25", "1/100")
    with ctx.workprec(1200):
        x, y = surface.ball_of(Fraction(2, 5)), arb(0)
        for i in range(100):
            image = paper.impact(x, y)
            x, y = image.x, image.y
            assert x.rad() < arb(2) ** -80
            assert float(x) == data["x"].values[i]
            assert float(image.tau) == data["tau"].values[i]


def test_starts_of_a_scene_are_fractions_of_the_radius():
    starts, impacts = ["0.534522", "-0.440981"], [60, 40]
    data = true_scene_orbits(**PAPER, starts=starts, impacts=impacts)
    ours = scene_orbits(BALL, 0.01, [0.534522, -0.440981], impacts)
    assert data.sizes == ours.sizes
    assert set(data.variables) == set(ours.variables)
    for name in NAMES:
        assert np.abs(data[name] - ours[name]).max() < 1e-7
    assert data["start"].equals(ours["start"])
    assert data["row_size"].equals(ours["row_size"])


def test_starts_of_a_scene_may_be_points():
    starts = [{"x": 0.1, "xdot": 0.05}, {"x": 0.3, "y": -0.02}, 0.5]
    exact = [{"x": "0.1", "xdot": "0.05"}, {"x": "0.3", "y": Decimal("-0.02")}, "0.5"]
    data = true_scene_orbits(**PAPER, starts=exact, impacts=25)
    ours = scene_orbits(BALL, 0.01, starts, 25)
    assert set(data.variables) == set(ours.variables)
    for name in data.variables:
        assert data[name].attrs == ours[name].attrs
        assert np.nanmax(np.abs(data[name] - ours[name])) < 1e-9


def test_the_elliptic_orbit_returns_for_as_long_as_one_looks():
    # near it: a thousand impacts on one invariant curve, errors far below a double's
    data = true_orbit(**PAPER, x="0.0212", impacts=1000)
    assert data.attrs["bits"] < 400
    assert np.abs(data["x"] - 0.0212).max() < 3e-3


# ---- killed and resumed


def test_a_killed_run_goes_on_where_it_was(tmp_path, monkeypatch):
    monkeypatch.setattr(checkpoints, "EVERY", 0.0)
    whole = true_orbit(**PAPER, x="2/5", impacts=200)
    file = tmp_path / "orbit.npz"
    step, steps = enclosed_run.Run.step, []

    def dies(run):
        if len(steps) == 120:
            raise KeyboardInterrupt
        steps.append(run.count)
        step(run)

    monkeypatch.setattr(enclosed_run.Run, "step", dies)
    with pytest.raises(KeyboardInterrupt):
        true_orbit(**PAPER, x="2/5", impacts=200, checkpoint=file)
    assert file.exists()
    steps.clear()
    monkeypatch.setattr(enclosed_run.Run, "step", lambda run: (steps.append(run.count), step(run)))
    data = true_orbit(**PAPER, x="2/5", impacts=200, checkpoint=file)
    assert steps == list(range(120, 200))
    assert data.identical(whole)
    assert not file.exists()


def test_a_checkpoint_of_another_orbit_or_a_damaged_one_is_not_used(tmp_path, monkeypatch):
    monkeypatch.setattr(checkpoints, "EVERY", 0.0)
    whole = true_orbit(**PAPER, x="2/5", impacts=30)
    file = tmp_path / "orbit.npz"
    for content in (b"", b"PK\x03\x04 damaged", b"x" * 1000):
        file.write_bytes(content)
        assert true_orbit(**PAPER, x="2/5", impacts=30, checkpoint=file).identical(whole)
    run = enclosed_run.Run(exact_start().surface, exact_start(), 30, 300)
    run.step()
    checkpoints.save(
        file, identity=json.dumps(["another"]), state=run.state(), values=run.values[:1]
    )
    assert true_orbit(**PAPER, x="2/5", impacts=30, checkpoint=file).identical(whole)


def test_finished_orbits_of_a_scene_are_kept(tmp_path, monkeypatch):
    arguments = {**PAPER, "starts": ["0.5", "0.1"], "impacts": [40, 30]}
    whole = true_scene_orbits(**arguments)
    step = enclosed_run.Run.step

    def dies(run):
        if run.impacts == 30:
            raise KeyboardInterrupt
        step(run)

    monkeypatch.setattr(enclosed_run.Run, "step", dies)
    with pytest.raises(KeyboardInterrupt):
        true_scene_orbits(**arguments, folder=tmp_path / "kept")
    begun = []
    monkeypatch.setattr(
        enclosed_run.Run, "step", lambda run: (begun.append(run.impacts), step(run))
    )
    assert true_scene_orbits(**arguments, folder=tmp_path / "kept").identical(whole)
    assert set(begun) == {30}
    assert list(tmp_path.iterdir()) == []


def test_progress_ends_at_one(monkeypatch):
    said = []
    true_orbit(**PAPER, x="2/5", impacts=20, progress=lambda *what: said.append(what))
    assert said[-1][0] == 1.0
    assert said[-1][1] == 0.0
    true_scene_orbits(**PAPER, starts=["0.5"], impacts=[5], progress=lambda *w: said.append(w))
    assert said[-1] == (1.0, 0.0, 0)


# ---- bad input


def refuse(match, **change):
    arguments = {**PAPER, "x": "2/5", "y": "0", "impacts": 10} | change
    with pytest.raises(ValueError, match=match) as error:
        true_orbit(**arguments)
    assert "\n" not in str(error.value)


def test_bad_input_is_refused_in_one_line(monkeypatch):
    refuse("k = 0.2 is a rounded number", k=0.2)
    refuse("x = '1/x' is not an exact number", x="1/x")
    refuse("energy = -1 is not allowed: above -1/250", energy="-1")
    refuse("impacts = 0 is not allowed", impacts=0)
    refuse("impacts = 2.5 is not allowed", impacts=2.5)
    refuse("by x and y, or by start: by one of them", x=None)
    refuse("by x and y, or by start: by one of them", start="0.5")
    refuse("a start is a fraction .* or x and xdot", x=None, start={"x": "0.1", "z": "0"})
    refuse("x = 1/10, xdot = 1/2 is not inside", x=None, start={"x": "0.1", "xdot": "0.5"})
    refuse("x = 3/5, y = 0 is not inside the section's rim", x="3/5")
    # on the rim exactly: 2 g x = k x^2
    refuse("is not inside the section's rim", energy="0", x="2/5")
    refuse("start = 1 is not inside", x=None, start="1")
    refuse("need [0-9]+ GB of memory", impacts=10**12)
    monkeypatch.setattr(enclosed_run, "MOST_BITS", 200)
    refuse("300 impacts of this orbit need [0-9]+ bits, more than 200", impacts=300)


def test_a_start_that_grazes_is_refused(monkeypatch):
    # a point of the jump set to 28 digits: its flight touches, as far as 64 bits can tell
    monkeypatch.setattr(orbit, "bits_needed", lambda *_: 90)
    refuse(
        "the orbit cannot be followed beyond impact 0: .* touch",
        x="0.1500343560691206835267020387",
        y="-0.1446215630131739871189398710",
    )
