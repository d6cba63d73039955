"""Reported quantities of the paper's figures, each against another way to compute it."""

import statistics

import numpy as np
import pytest
from samples import exponents

from paper.figures import reports
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
    largest = sorted(max(row) for row in ends.tolist())
    assert found["largest exponent"] == ", ".join(f"{value:.4f}" for value in largest)
    mean, spread = statistics.mean(largest), statistics.stdev(largest)
    assert found["their mean"] == f"{mean:.4f}, standard deviation {spread:.4f}"
    assert found["impacts of each orbit"] == "200,000"
    one = data.isel(orbit=[0])
    assert reports.exponents({}, one)["their mean"] == f"{ends[0].max():.4f}"


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


def test_the_largest_exponent_is_the_largest_by_value():
    """After 100 impacts at this energy the exponents are not sorted by the order of the frame."""
    found = scene_exponents(BALL, 0.001, np.linspace(-0.99, 0.99, 40).tolist(), 100, 4)
    last = found["exponent"].values[-1]
    assert np.any(last[:, 0] < last.max(axis=1))
    numbers = reports.exponents(BLOCK | {"energy": 0.001}, found)
    ours = [float(text) for text in numbers["largest exponent"].split(", ")]
    assert np.allclose(ours, np.sort(last.max(axis=1)), atol=5.1e-5)


def test_a_mean_is_reported_of_orbits_of_one_type_only():
    starts = {"chaotic": [0.6, 0.62], "regular": [-0.2, 0.1], "undecided": [0.9999999999]}
    data = {kind: scene_exponents(BALL, 0.01, each, 500, 5) for kind, each in starts.items()}
    numbers = {kind: reports.exponents(BLOCK, each) for kind, each in data.items()}
    assert all(each["their mean"] for each in numbers.values())
    every = [start for each in starts.values() for start in each]
    mixed = reports.exponents(BLOCK, scene_exponents(BALL, 0.01, every, 500, 5))
    assert mixed["mean of the chaotic ones"] == numbers["chaotic"]["their mean"]
    assert "their mean" not in mixed
    few = scene_exponents(BALL, 0.01, starts["regular"] + starts["undecided"], 500, 5)
    assert not any("mean" in name for name in reports.exponents(BLOCK, few))
