"""Orbits of exact starts: against independent orbits of many digits, and refusals."""

import mpmath
import numpy as np
import pytest
from exact_orbits import state_at
from independent_solver import flight
from sections import BALL

from extensions.proofs import true_orbit
from extensions.proofs.true_orbits import orbit as orbit_module
from extensions.proofs.true_orbits.orbit import true_scene_orbits
from pseudorigid.dynamics.orbits import scene_orbits

PAPER = {"k": "1/5", "g": "1/25", "energy": "1/100"}
NAMES = ("x", "xdot", "udot", "tau")


def independent(impacts, digits):
    """The orbit of (2/5, 0) as rows of x, xdot, udot, tau, from `digits` decimal digits down to 60.

    The kernel says which root it is, and Newton's method gives its digits.
    """
    rows = []
    with mpmath.workdps(digits):
        k, g, energy, x = (mpmath.mpf(a) / b for a, b in ((1, 5), (1, 25), (1, 100), (2, 5)))
        state = state_at(k, g, energy, x, 0)
    for i in range(impacts):
        level = digits - (digits - 60) * i // impacts
        with mpmath.workdps(level):
            gap, b, c = flight(k, g, *state)
            t, known = mpmath.mpf(BALL.time_to_impact(*map(float, state))), 12
            while known < level:
                known *= 2
                with mpmath.workdps(min(known, level) + 10):
                    t -= gap(t) / gap.slope(t)
            cosine, sine = mpmath.cos_sin(t)
            state = gap.x * cosine - c * sine, b + g * t, gap.x * sine + c * cosine
            rows.append((*state, t))
    return rows


@pytest.mark.parametrize(
    ("impacts", "digits"), [(600, 130), pytest.param(2000, 450, marks=pytest.mark.slow)]
)
def test_each_value_is_the_nearest_double(impacts, digits):
    data = true_orbit(**PAPER, x="2/5", y="0", impacts=impacts)
    expected = np.array([[float(a) for a in row] for row in independent(impacts, digits)])
    for name, column in zip(NAMES, expected.T, strict=True):
        np.testing.assert_array_equal(data[name].values, column)


@pytest.mark.parametrize("bits", [3000, 100])
def test_a_run_with_more_or_too_few_bits_gives_the_same_orbit(bits, monkeypatch):
    data = true_orbit(**PAPER, x="2/5", impacts=300)
    monkeypatch.setattr(orbit_module, "_bits_needed", lambda *_: bits)
    other = true_orbit(**PAPER, x="2/5", impacts=300)
    assert other.attrs["bits"] == bits if bits == 3000 else other.attrs["bits"] > 150
    assert data.equals(other)


@pytest.mark.parametrize(("starts", "impacts"), [
    ([0.534522, -0.440981], [40, 25]),
    ([{"x": 0.1, "xdot": 0.05}, {"x": 0.3, "y": -0.02}, 0.5], 25),
])  # fmt: skip
def test_starts_of_a_scene_may_be_fractions_of_the_radius_or_points(starts, impacts):
    data = true_scene_orbits(BALL, 0.01, starts, impacts)
    doubles = scene_orbits(BALL, 0.01, starts, impacts)
    assert data.sizes == doubles.sizes
    assert set(data.variables) == set(doubles.variables)
    for name in data.variables:
        assert data[name].attrs == doubles[name].attrs
        if name == "type":
            assert data[name].equals(doubles[name])
        else:
            assert np.nanmax(np.abs(data[name] - doubles[name])) < 1e-7


# ---- bad input


@pytest.mark.parametrize(("match", "change"), [
    ("k = 0.2", {"k": 0.2}),
    ("impacts = 2.5", {"impacts": 2.5}),
    ("x and y, or start", {"x": None}),
    ("x and y, or start", {"start": "0.5"}),
    ("fraction", {"x": None, "start": {"x": "0.1", "z": "0"}}),
    ("x = 3/5, y = 0 is not inside", {"x": "3/5"}),
    ("is not inside", {"energy": "0", "x": "2/5"}),  # exactly on the rim: 2 g x = k x^2
    ("[0-9]+ GB", {"impacts": 10**12}),
])  # fmt: skip
def test_bad_input_is_refused_in_one_line(match, change):
    with pytest.raises((ValueError, MemoryError), match=match) as error:
        true_orbit(**{**PAPER, "x": "2/5", "impacts": 10} | change)
    assert "\n" not in str(error.value)


def test_a_start_that_grazes_is_refused(monkeypatch):
    # a point of the jump set to 28 digits: 64 bits cannot tell its touch from a miss
    monkeypatch.setattr(orbit_module, "_bits_needed", lambda *_: 90)
    x, y = "0.1500343560691206835267020387", "-0.1446215630131739871189398710"
    with pytest.raises(ValueError, match=r"impact 0: .* touch"):
        true_orbit(**PAPER, x=x, y=y, impacts=10)
