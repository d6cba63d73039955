"""Python refuses the balls and energies that config.yaml refuses, in the same words."""

import math
import sys

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import pseudorigid
from helpers.documents import good
from helpers.project import run
from pipeline import config
from pseudorigid import Ball
from pseudorigid.dynamics import bounds

PAPER = Ball(0.2, 0.04)
MESSAGE = "is not allowed: "
# Decimals at and beside bounds: k/2 - g, -g^2/(2k), k = g, k = 1, k = 0, flights of 10^6/omega.
BALLS = [
    *((0.2, 0.04, e) for e in (0.06, 0.059999999999999998, 0.060000000000000005, 0.3, -0.004)),
    *((0.2, 0.04, e) for e in (-0.0040000000000000001, -0.00399999999999999, -1.0, 0.01)),
    *((0.3, 0.1, e) for e in (0.05, 0.04999999999999999, -0.01666666666666667)),
    *((k, g, 0.001) for k, g in ((0.2, 0.2), (0.2, 0.19999999999999998), (0.2, 0.3), (0.2, 0.0))),
    *((k, 0.01, 0.001) for k in (0.0, -0.1, 1.0, 1.0000000000000002, 2.0)),
    (0.2, 1e-8, 0.01), (0.2, 1e-7, 0.00125), (0.2, 1e-7, 0.0012499999999), (1, 0.1, 0.4),
]  # fmt: skip


def words_of_python(k, g, energy):
    """Return the key that Python refuses and what it says is allowed, or None."""
    try:
        Ball(k, g).section(energy)
    except ValueError as error:
        key, words = str(error).split(MESSAGE)
        return key.split(" = ")[0], words
    return None


def words_of_config(k, g, energy):
    """Return the key that config.yaml refuses and what it says is allowed, or None."""
    document = good() | {"ball": {"k": k, "g": g}}
    document["scenes"] = {"one": document["scenes"]["a_motion"] | {"energy": energy}}
    try:
        config.check(document)
    except config.ConfigError as error:
        place, words = error.lines[0].split(f" {MESSAGE}expected ")
        return place.split(": ")[0].rpartition(".")[2], words
    return None


@pytest.mark.parametrize(("k", "g", "energy"), BALLS)
def test_both_doors_refuse_the_same_in_the_same_words(k, g, energy):
    assert words_of_python(k, g, energy) == words_of_config(k, g, energy)


def test_the_bounds_are_those_of_decimals():
    assert 0.06 < 0.5 * 0.2 - 0.04  # in doubles
    with pytest.raises(ValueError, match=r"^energy = 0\.06 is not allowed: a number below k/2 - g"):
        PAPER.section(0.06)
    assert PAPER.section(math.nextafter(0.06, 0.0))[1] > 0.0
    assert PAPER.energy_bounds() == (-0.004, 0.06)


@settings(deadline=None)
@given(st.decimals("0.001", "1", places=3), st.decimals("0.001", "1", places=3))
def test_the_range_of_doubles_is_that_of_the_decimals(k, share):
    k, g = float(k), float(k * share / 2)
    for beside, side in zip(bounds.energy_range(k, g), (-math.inf, math.inf), strict=True):
        assert not bounds.energy_mistake(k, g, beside)
        assert bounds.energy_mistake(k, g, math.nextafter(beside, side))


@pytest.mark.parametrize("energy", [0.06, 0.3, -0.004, -0.1])
def test_each_function_with_an_energy_refuses_it(energy):
    saddle = pseudorigid.symmetric_orbits(PAPER, 0.01, 6).isel(orbit=1)
    for call in (
        lambda: PAPER.section([0.01, energy]),
        lambda: PAPER.start(0.5, [0.01, energy]),
        lambda: PAPER.state(0.2, 0.0, energy),
        lambda: PAPER.state_xy(0.2, 0.0, energy),
        lambda: pseudorigid.symmetric_orbits(PAPER, energy, 1),
        lambda: pseudorigid.periodic_orbits(PAPER, energy, 1),
        lambda: pseudorigid.trace_manifold(PAPER, energy, saddle),
    ):
        with pytest.raises(ValueError, match=f"^energy = {energy} is not allowed: a number "):
            call()


def test_functions_that_follow_states_refuse_their_energy_and_maps_do_not():
    states = np.array(Ball.dimensionless(0.2).start([0.5, -0.2], [0.3 / 0.0016, 6.25])) * 0.04
    one = states[:, 0]
    for function in (
        lambda state: pseudorigid.orbit(PAPER, state, 10),
        lambda state: pseudorigid.lyapunov_spectrum(PAPER, state, 10),
        lambda state: pseudorigid.rotation_number(PAPER, state, 100),
        lambda state: pseudorigid.classify_orbits(PAPER, state, 100),
    ):
        for refused in (one, states):
            with pytest.raises(ValueError, match=r"^energy of the state = 0\.3\d* is not allowed"):
                function(tuple(refused))
        function(tuple(states[:, 1]))
        function(PAPER.start(0.5, math.nextafter(0.06, 0.0)))  # roundings are no mistake
    with pytest.raises(ValueError, match=r"^energy of the state"):
        pseudorigid.motion(PAPER, tuple(one), 5.0)
    assert np.isfinite(PAPER.impact(*one)).all() and np.isfinite(PAPER.jacobian(*one)).all()
    assert np.isfinite(PAPER.history(states, 5)).all()


def test_a_dimensionless_ball_has_the_map_of_all_balls_with_its_k():
    unit, ball = Ball.dimensionless(0.2), Ball(0.2, 2.0**-5)
    state = ball.start(0.5, 0.01)
    scaled = unit.start(0.5, 0.01 * 2.0**10)
    assert scaled == tuple(32.0 * a for a in state)
    *after, tau = ball.impact(*state)
    assert unit.impact(*scaled) == (*(32.0 * a for a in after), tau)
    assert unit.g == 1.0 and unit.energy_bounds() == (-2.5, math.inf)
    found = pseudorigid.symmetric_orbits(unit, 1000.0, 1)
    assert found.sizes["orbit"] > 1
    for call, name in (
        (lambda: unit.section(-2.5), "energy"),
        (lambda: Ball.dimensionless(0), "k"),
    ):
        with pytest.raises(ValueError, match=f"^{name} = "):
            call()


def test_python_warns_once_of_balls_that_no_sphere_has():
    code = (
        "from pseudorigid import Ball\nBall(1 / 3, 0.04)\nBall.dimensionless(0.5)\n"
        "for k in (0.35, 0.4, 0.35):\n    Ball(k, 0.04)\nBall(0.35, 0.04).start(0.5, 0.01)\n"
    )
    result = run(sys.executable, "-c", code)
    assert result.stdout == "" and result.stderr.count(bounds.NO_SPHERE) == 1
