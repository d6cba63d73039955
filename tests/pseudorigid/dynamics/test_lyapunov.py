"""Lyapunov exponents: an independent computation, known limits, history and bits."""

import math

import numpy as np
import pytest
import xarray as xr

from helpers.cycles import SETTINGS
from helpers.sections import BALL
from pseudorigid import Ball, lyapunov_spectrum, orbit
from pseudorigid.dynamics.lyapunov import scene_exponents
from pseudorigid.dynamics.variables import final_exponents
from pseudorigid.kernel import spectrum


def final(state, impacts, **options):
    return lyapunov_spectrum(BALL, state, impacts, **options)["exponent"].values[-1]


def by_numpy(ball, state, impacts):
    """Return the exponents from numpy's QR decomposition and one Jacobian at a time."""
    path = orbit(ball, state, impacts)
    columns = [
        np.append(a, path[name][:-1]) for a, name in zip(state, ("x", "xdot", "udot"), strict=True)
    ]
    frame, total = np.eye(3), np.zeros(3)
    for jacobian in ball.jacobian(*columns):
        frame, r = np.linalg.qr(jacobian @ frame)
        total += np.log(np.abs(np.diag(r)))
    return total / impacts


@pytest.mark.parametrize(("k", "g", "energy"), SETTINGS[::2])
def test_against_numpy_over_two_thousand_impacts(k, g, energy):
    ball = Ball(k, g)
    for start in (0.6, -0.3):
        state = ball.start(start, energy)
        exponents = lyapunov_spectrum(ball, state, 2000)["exponent"].values[-1]
        assert np.max(np.abs(exponents - by_numpy(ball, state, 2000))) < 1e-11


@pytest.mark.parametrize(
    ("impacts", "records"), [(1, 1), (7, 400), (1000, 7), (999, 400), (20_000, 1)]
)
def test_history_ends_with_the_final_value(impacts, records):
    """Over 20,000 impacts a vector grows beyond the range of doubles."""
    state = BALL.start(0.6, 0.01)
    found = lyapunov_spectrum(BALL, state, impacts, records)
    at = found["impact"].values
    assert at.dtype == np.int64
    assert (at.size, at[-1]) == (min(records, impacts), impacts)
    assert np.all(np.diff(at, prepend=0) > 0)
    full = lyapunov_spectrum(BALL, state, impacts, records=impacts)
    # Logarithms are summed in different groups, which changes roundings.
    expected = full["exponent"].values[at - 1]
    assert np.max(np.abs(found["exponent"].values - expected)) < 1e-13
    first = final(state, int(at[0]), records=1)
    assert np.max(np.abs(first - found["exponent"].values[0])) < 1e-13


def test_a_scene_has_a_history_for_each_start():
    starts = [0.6, 0.62]
    found = scene_exponents(BALL, 0.01, starts, 500, 5)
    assert dict(found["exponent"].sizes) == {"impact": 5, "orbit": 2, "index": 3}
    assert found["start"].values.tolist() == starts
    assert found["impact"].values.tolist() == [100, 200, 300, 400, 500]
    alone = lyapunov_spectrum(BALL, BALL.start(0.62, 0.01), 500, 5)["exponent"].values
    assert np.array_equal(alone, found["exponent"].values[:, 1])


def test_the_largest_exponent_is_the_largest_by_value():
    """After 100 impacts at this energy the exponents are not sorted by the order of the frame."""
    starts = np.linspace(-0.99, 0.99, 40).tolist()
    found = scene_exponents(BALL, 0.001, starts, 100, 4)
    last = found["exponent"].values[-1]
    assert np.any(last[:, 0] < last.max(axis=1))
    assert np.array_equal(final_exponents(found), np.sort(last, axis=1)[:, ::-1])


def test_few_orbits_do_not_compile_the_kernel_for_many(monkeypatch):
    monkeypatch.setattr(spectrum, "exponents_of_group", None)
    assert final(BALL.start([0.6, 0.62, 0.65], 0.01), 100).shape == (3, 3)


def test_the_time_is_the_sum_of_the_times_of_flight():
    """Its rounding errors are those of a plain sum."""
    for start in (0.534522, 0.6, -0.2):
        state = BALL.start(start, 0.01)
        found = lyapunov_spectrum(BALL, state, 200_000, 5)["time"]
        assert found.dims == ("impact",) and found.attrs["scale"] == "1/omega"
        flights = orbit(BALL, state, 200_000)["tau"].values
        assert np.array_equal(found, np.cumsum(flights)[found["impact"].values - 1])
        exact = math.fsum(flights)
        assert abs(float(found[-1]) - exact) < 2e-14 * exact


def test_exponents_per_time_are_those_per_impact_over_the_mean_flight():
    """Of many orbits, each has the bits that it has alone."""
    states = BALL.start(np.linspace(0.5, 0.7, 40), 0.01)
    found = lyapunov_spectrum(BALL, states, 1000, 4)
    flow = found["exponent"] * found["impact"] / found["time"]
    mean_flight = orbit(BALL, states, 1000)["tau"].mean("impact")
    assert np.allclose(flow[-1], found["exponent"][-1] / mean_flight, rtol=1e-12)
    for i in (0, 17, 39):
        alone = lyapunov_spectrum(BALL, [a[i] for a in states], 1000, 4)
        assert np.array_equal(alone["time"], found["time"][:, i])


def test_exponents_and_time_are_unknown_together():
    """After grazing, for a state that is not finite, and at the records of other orbits."""
    rim = BALL.start([1.0, 0.6, np.nan], 0.01)
    found = lyapunov_spectrum(BALL, rim, 10, 5)
    unknown = np.isnan(found["exponent"].values)
    assert unknown.any(axis=(0, 2)).tolist() == [True, False, True]
    many = lyapunov_spectrum(BALL, BALL.start([1.0] * 30 + [0.6] * 10, 0.01), 10, 5)
    scene = scene_exponents(BALL, 0.01, [0.6, 0.62], [10, 12], 4)
    assert np.isnan(scene["exponent"].values).any()
    for each in (found, many, scene):
        exponents, time = each["exponent"].values, each["time"].values
        assert np.array_equal(np.isnan(exponents).any(axis=-1), np.isnan(time))


def test_orbits_of_a_scene_are_called_chaotic_by_their_largest_exponents():
    data = scene_exponents(BALL, 0.01, [1.0, -0.2, 0.6], [400, 4000, 4000], 4)
    assert data["type"].values.tolist() == ["undefined", "regular", "chaotic"]


def test_final_exponents_are_each_orbit_s_own_last_record():
    exponent = np.arange(4 * 3 * 3.0).reshape(4, 3, 3)
    exponent[2:, 0], exponent[3, 1] = np.nan, np.nan
    found = final_exponents(xr.Dataset({"exponent": (("impact", "orbit", "index"), exponent)}))
    assert found.tolist() == [[11.0, 10.0, 9.0], [23.0, 22.0, 21.0], [35.0, 34.0, 33.0]]
