"""The motion between impacts, against the formulas of a flight."""

import numpy as np
import pytest

from pseudorigid import Ball, motion, symmetric_orbits
from pseudorigid.dynamics.ensemble import ImpactMap
from pseudorigid.dynamics.motion import scene_motion
from pseudorigid.dynamics.variables import of_type

BALL = Ball(0.2, 0.04)


@pytest.mark.parametrize("duration", [2.0, 11.3, 40.0])
def test_a_motion_is_that_of_its_flights_and_ends_at_its_duration(duration):
    state = BALL.start(0.3, 0.01)
    found = motion(BALL, state, duration)
    t, position, strain = (found[name].values for name in ("t", "position", "strain"))
    assert t[0] == 0.0 and t[-1] == pytest.approx(duration) and np.all(np.diff(t) >= 0.0)
    begin, impacts = 0.0, []
    while begin <= duration:
        (x, v, w), k, g = state, BALL.k, BALL.g
        b, c = ((1 - k) * v - 2 * k * w) / (1 + k), -(2 * v + (1 - k) * w) / (1 + k)
        *state, tau = BALL.impact(x, v, w)
        s = np.clip(t - begin, 0.0, None)
        inside = (t > begin) & (t < begin + tau)
        height, rate = x + b * s + 0.5 * g * s * s, c * np.sin(s) - x * np.cos(s)
        assert np.allclose(position[inside], height[inside], atol=1e-12)
        assert np.allclose(strain[inside], rate[inside], atol=1e-12)
        impacts.append((begin, x))
        at = t == begin
        assert at.sum() >= 1 and np.all(position[at] == x) and np.all(strain[at] == -x)
        begin += tau
    assert found["impact_t"].values == pytest.approx([time for time, _ in impacts], abs=1e-12)
    assert np.all(found["impact_position"].values == [x for _, x in impacts])


def test_both_ends_of_each_flight_touch_exactly():
    found = motion(BALL, BALL.start(0.3, 0.01), 40.0)
    position, strain = found["position"].values, found["strain"].values
    ends = np.flatnonzero(np.isin(found["t"].values, found["impact_t"].values))
    assert ends.size == 2 * found.sizes["impact"] - 1 and np.all(position[ends] == -strain[ends])


def test_a_scene_follows_the_points_of_its_orbit_unless_the_map_may_miss_impacts():
    """The points of an unstable orbit close; its impacts one after the other leave it."""
    periodic = symmetric_orbits(BALL, 0.01, 6)
    scan = Ball(BALL.k, BALL.g, ImpactMap((0.1, 1e-12)))
    ends = []
    for ball in (BALL, scan):
        found = scene_motion(ball, 0.01, periodic, 6, "hyperbolic", 600)["impact_position"].values
        ends.append(np.ptp(found[::6][-3:]))
        first = float(of_type(periodic, "hyperbolic")["x"][0])
        assert found[0] == first
    assert ends[0] == 0.0 < ends[1] and scan.map.impacts > 100
