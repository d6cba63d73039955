"""Orbits: shapes, bits and memory; ragged orbits of a scene; motion between impacts."""

import tracemalloc

import numpy as np
import pytest

from helpers.sections import BALL
from pseudorigid import classify_orbits, lyapunov_spectrum, motion, orbit
from pseudorigid.dynamics.orbits import scene_orbits, start_state

NAMES = ("x", "xdot", "udot", "tau")
FRACTIONS = np.array([[-0.44, -0.1, 0.142], [0.17, 0.53, 0.9]])


def values(dataset):
    return np.stack([dataset[name].values for name in NAMES])


@pytest.mark.parametrize(("fractions", "dims"), [
    (0.534522, ()), (FRACTIONS[0], ("orbit",)), (FRACTIONS[0][:1], ("orbit",)),
    (FRACTIONS[:0, 0], ("orbit",)), (FRACTIONS, ("orbit_0", "orbit_1")),
])  # fmt: skip
@pytest.mark.parametrize("impacts", [1, 7, np.int64(17), 200.0])
def test_dims_follow_the_state_and_keep_last_returns_the_last_impact(fractions, dims, impacts):
    state = BALL.start(fractions, 0.01)
    exponent = lyapunov_spectrum(BALL, state, 5, records=1)["exponent"]
    assert exponent.dims == ("impact", *dims, "index")
    assert exponent.shape == (1, *np.shape(fractions), 3)
    found = orbit(BALL, state, impacts)
    last = orbit(BALL, state, impacts, keep="last")
    for name in NAMES:
        assert found[name].dims == ("impact", *dims)
        assert found[name].shape == (int(impacts), *np.shape(fractions))
        assert found[name].dtype == float
        assert found[name].attrs["units"] == "1" and found[name].attrs["long_name"]
        assert last[name].dims == dims
        assert last[name].values.tobytes() == found[name].values[-1].tobytes()
    assert found["impact"].values.tolist() == list(range(1, int(impacts) + 1))


def test_keep_last_takes_constant_memory():
    state = BALL.start([0.5] * 8, 0.01)
    orbit(BALL, state, 2, keep="last")
    tracemalloc.start()
    orbit(BALL, state, 500_000, keep="last")
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < 5_000_000  # all impacts would take 128 MB


def test_an_orbit_of_a_scene_that_grazes_exactly_is_undefined():
    starts = [-1.0, 1.0, 0.5, -0.2]  # the first one leaves the rim, the second one rests there
    types = scene_orbits(BALL, 0.01, starts, 20)["type"].values.tolist()
    assert types == ["undefined", "undefined", "chaotic", "regular"]
    assert types == classify_orbits(BALL, BALL.start(starts, 0.01))["type"].values.tolist()


def test_a_scene_is_a_ragged_array():
    starts, impacts = [-0.44, 0.534522, 0.1], [5, 1, 12]
    found = scene_orbits(BALL, 0.01, starts, impacts)
    assert found.sizes == {"point": 18, "orbit": 3}
    assert found["start"].values.tolist() == starts
    assert found["row_size"].values.tolist() == impacts
    assert found["row_size"].dtype == np.int64
    assert found["row_size"].attrs["sample_dimension"] == "point"
    at = 0
    for start, count in zip(starts, impacts, strict=True):
        alone = values(orbit(BALL, BALL.start(start, 0.01), count))
        assert values(found)[:, at : at + count].tobytes() == alone.tobytes()
        at += count
    energy = BALL.energy(*values(found)[:3])
    assert np.max(np.abs(energy - 0.01)) < 1e-16 * 20


def test_a_motion_of_impacts_whose_times_lie_before_them_is_refused():
    orbits = scene_orbits(BALL, 0.01, [0.6], [5])
    for start in (orbits, orbits.drop_vars("row_size")):
        with pytest.raises(ValueError, match="one state or one orbit of symmetric_orbits"):
            motion(BALL, start, 10.0)


def test_the_motion_from_a_state_that_is_not_finite_is_nan():
    found = motion(BALL, (np.nan, 0.1, 0.3), 10.0)
    assert found.sizes["impact"] == 1
    assert np.isnan(found["position"]).all() and np.isnan(found["strain"]).all()


def test_a_start_is_a_fraction_or_a_point_by_xdot_or_y():
    x, v, w = BALL.start(0.3, 0.01)
    y = v - BALL.k * w + 0.01
    by_y, by_xdot = {"x": x, "y": y}, {"x": x, "xdot": v}
    assert start_state(BALL, 0.01, 0.3) == (x, v, w)
    assert start_state(BALL, 0.01, by_xdot) == BALL.state(x, v, 0.01)
    found = start_state(BALL, 0.01, by_y)
    assert found == BALL.state_xy(x, y, 0.01)
    assert found[1] - BALL.k * found[2] == pytest.approx(y, abs=1e-15)
    data = scene_orbits(BALL, 0.01, [0.3, by_y], 2)
    assert data["start"].values.tolist() == [0.3, pytest.approx(np.nan, nan_ok=True)]
    assert data["start_xdot"].values.tolist() == [v, found[1]]
    assert "start_x" not in scene_orbits(BALL, 0.01, [0.3, 0.4], 2)
