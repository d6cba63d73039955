"""The motion between impacts, against the formulas of a flight."""

import numpy as np
import pytest

from pseudorigid import Ball, motion

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
