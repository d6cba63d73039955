"""Reported quantities of the paper's figures, each against another way to compute it."""

import statistics

import numpy as np
import pytest
import xarray as xr

from helpers.samples import SCENES, exponents, orbits
from paper.figures import portrait, reports
from pseudorigid import Ball, orbit
from pseudorigid.dynamics.lyapunov import scene_exponents
from pseudorigid.dynamics.motion import scene_motion
from pseudorigid.dynamics.periodic import symmetric_orbits

BALL = Ball(0.2, 0.04)
BLOCK = {"ball": {"k": 0.2, "g": 0.04}, "energy": 0.01}


def test_the_largest_exponents_their_mean_and_their_sample_deviation():
    data = exponents()
    data["exponent"] = data["exponent"] * [[1.0], [1.1], [1.3]]
    found = reports.exponents({}, data)
    ends = data["exponent"].values[-1]
    largest = [max(row) for row in ends.tolist()]  # in the order of the starts, as their errors
    assert found["largest exponent"] == ", ".join(f"{value:.4f}" for value in largest)
    mean, spread = statistics.mean(largest), statistics.stdev(largest)
    assert (
        found["mean largest exponent (chaotic)"] == f"{mean:.4f}, standard deviation {spread:.4f}"
    )
    assert found["impacts of each orbit"] == "200,000"
    one = data.isel(orbit=[0])
    assert reports.exponents({}, one)["mean largest exponent (chaotic)"] == f"{ends[0].max():.4f}"


def test_a_portraits_energy_speed_and_extent():
    data = orbit(BALL, BALL.start(0.3, 0.01), 50).rename(impact="point").expand_dims("orbit")
    found = reports.portrait(BLOCK, data)
    assert found["energy"] == "0.01" and (found["orbits"], found["impacts"]) == ("1", "50")
    speeds = data["xdot"].values + data["udot"].values
    assert float(found["least speed of contact"]) == pytest.approx(speeds.min(), rel=0.05)
    least, most = map(float, found["x"].split(" to "))
    assert (least, most) == pytest.approx(
        (data["x"].values.min(), data["x"].values.max()), abs=6e-5
    )


def test_a_motions_period_strain_and_impacts_within_the_axes():
    periodic = symmetric_orbits(BALL, 0.01, 1)
    motion = scene_motion(BALL, 0.01, periodic, period=1, type="elliptic", duration=16)
    block = BLOCK | {"type": "elliptic"}
    found = reports.motion(block, periodic, motion)
    flight = np.diff(motion["impact_t"].values)
    assert float(found["time of one period"]) == pytest.approx(flight[0], abs=1e-6)
    assert int(found["impacts drawn"]) == motion.sizes["impact"] == 1 + int(16 // flight[0])
    axes = {"t": {"limits": [1, 10]}, "displacement": {"limits": [-1, 1]}}
    within = reports.motion(block | {"axes": axes}, periodic, motion)
    times = motion["impact_t"].values
    assert int(within["impacts drawn"]) == np.sum((times >= 1) & (times <= 10))
    assert within["time"] == "1 to 10"
    at = -float(motion["impact_position"][0])
    for height, count in ((at, motion.sizes["impact"]), (-at, 0)):
        axes = {"displacement": {"limits": [height - abs(at), height + abs(at) / 2]}}
        found = reports.motion(block | {"axes": axes}, periodic, motion)
        assert int(found["impacts drawn"]) == count
    ends = motion["strain"].values.min(), motion["strain"].values.max()
    assert found["strain"] == "{:.4f} to {:.4f}".format(*ends)


def test_branches_meet_where_an_unstable_one_crosses_the_axis_but_not_in_a_saddle(monkeypatch):
    """A branch passes the axis between two points; in a saddle it has a point on it."""
    monkeypatch.setattr("paper.figures.tangle.drawn", lambda *_: (None, ["marks"]))
    sides = {
        "crosses": (0, [0.0, 1.0, 2.0, -1.0, -2.0]), "passes a saddle": (0, [1.0, 2.0, 0.0, -1.0]),
        "is stable": (1, [1.0, -1.0]), "stays": (0, [1.0, 2.0, 1.0]),
        "ends beyond": (0, [1.0, 1.0, 1e-8, -1e-8]), "ends on it": (0, [1.0, 1e-10, -1e-10]),
    }  # fmt: skip
    stable, ys = zip(*sides.values(), strict=True)
    y = np.concatenate(ys)  # = xdot - k udot
    state = {"x": 0.0 * y, "xdot": y + 0.2, "udot": y**0}
    data = xr.Dataset({name: ("vertex", values) for name, values in state.items()})
    data["row_size"] = "branch", [len(y) for y in ys]
    data["stable"], data["side"] = ("branch", [*stable]), ("branch", [*sides])
    found = reports.tangle_facts(BLOCK, None, None, data)
    assert found == {"seen": ["marks"], "meeting": ["crosses", "ends beyond"]}


def test_an_orbit_has_its_rotation_number_or_its_multiplier():
    six = symmetric_orbits(BALL, 0.01, 6)
    for kind, name in (("elliptic", "rotation number"), ("hyperbolic", "multiplier")):
        found = reports.about_orbit(six, BLOCK | {"type": kind})
        (orbit,) = np.flatnonzero(six["type"].values == kind)
        value = f"{float(six[name.replace(' ', '_')][orbit]):.6f}"
        assert found == {"orbit": f"{kind}, period 6", "energy": "0.01", name: value}


@pytest.mark.parametrize("turns", [1.2, 1.9, 2.2])
def test_a_branch_oscillates_if_it_turns_by_more_than_two_whole_turns(monkeypatch, turns):
    """In all: back and forth by a quarter of them each time. Straight lines do not."""
    monkeypatch.setattr("paper.figures.closeup.drawn", lambda *_: (None, True))
    angle = np.pi * turns / 2 * np.concatenate([np.arange(100), np.arange(100, -1, -1)] * 2) / 100
    steps = np.array([np.cos(angle), np.sin(angle)])
    line = np.hstack([np.zeros((2, 1)), np.cumsum(steps, axis=1)])
    x, xdot = np.hstack([np.outer([1.0, 1.0], np.arange(50.0)), line])
    data = xr.Dataset({"x": ("vertex", 2.0 * x), "xdot": ("vertex", 3.0 * xdot)})
    data["row_size"] = "branch", [50, line.shape[1]]
    data.attrs = {"window_x": [0.0, 2.0], "window_xdot": [0.0, 3.0]}
    assert reports.closeup_facts({}, data) == {"oscillates": turns > 2.0, "coincide": True}


def test_facts_of_a_portrait_count_what_is_seen(monkeypatch):
    monkeypatch.setattr("paper.figures.portrait.drawn", lambda *_: (None, np.array([7, 0, 5])))
    data = xr.Dataset({"type": ("orbit", ["regular", "regular", "chaotic"])})
    data["x"] = "point", np.zeros(20)
    found = reports.portrait_facts({}, data)
    assert (found["seen"], found["points"], found["unseen"]) == (12, 20, 1)
    assert (found["regular"], found["chaotic"], found["undecided"]) == (1, 1, 0)


def test_facts_of_exponents_have_the_ends_of_the_largest_chaotic_ones():
    data = exponents()
    data["exponent"] = data["exponent"] * [[1.0], [1.1], [1.3]]
    ends = np.sort(data["exponent"].values[-1].max(axis=1))
    for types, expected in ((["chaotic"] * 3, [ends[0], ends[-1]]), (["chaotic"], [ends[0]])):
        data["type"] = "orbit", [*types, "regular", "regular"][:3]
        found = reports.exponents_facts(SCENES["exponents"], data)
        assert found["largest"] == [f"{end:.4f}" for end in expected]
        assert found["chaotic"] == len(expected) + (len(types) == 3)


def test_two_regular_orbits_have_the_numbers_of_their_starts_and_one_has_none():
    data = orbits()
    for types, named in ((["regular"] * 2, {"1", "2"}), (["regular", "chaotic"], set())):
        data["type"] = "orbit", [*types, "chaotic"]
        figure = portrait.draw(SCENES["portrait"], data)
        assert {"1", "2"} & {text.get_text() for text in figure.texts} == named


def test_the_largest_exponent_is_the_largest_by_value():
    """After 100 impacts at this energy the exponents are not sorted by the order of the frame."""
    found = scene_exponents(BALL, 0.001, np.linspace(-0.99, 0.99, 40).tolist(), 100, 4)
    last = found["exponent"].values[-1]
    assert np.any(last[:, 0] < last.max(axis=1))
    numbers = reports.exponents(BLOCK | {"energy": 0.001}, found)
    ours = [float(text) for text in numbers["largest exponent"].split(", ")]
    assert np.allclose(ours, last.max(axis=1), atol=5.1e-5)


def test_a_mean_is_reported_of_orbits_of_one_type_only():
    starts = {"chaotic": [0.6, 0.62], "regular": [-0.2, 0.1], "undecided": [0.9999999999]}
    data = {kind: scene_exponents(BALL, 0.01, each, 500, 5) for kind, each in starts.items()}
    numbers = {kind: reports.exponents(BLOCK, each) for kind, each in data.items()}
    name = "mean largest exponent ({})".format
    assert all(each[name(kind)] for kind, each in numbers.items())
    every = [start for each in reversed(starts.values()) for start in each]
    mixed = reports.exponents(BLOCK, scene_exponents(BALL, 0.01, every, 500, 5))
    assert mixed[name("chaotic")] == numbers["chaotic"][name("chaotic")]
    assert name("regular") not in mixed
    few = scene_exponents(BALL, 0.01, starts["regular"] + starts["undecided"], 500, 5)
    assert not any("mean" in name for name in reports.exponents(BLOCK, few))
