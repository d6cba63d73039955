"""Fixed points of the impact map agree with the closed form in 40 digits."""

import mpmath
import numpy as np
import pytest
from cycles import NAMES, SETTINGS
from mpmath import mpf

from pseudorigid import Ball, symmetric_orbits


def fixed_points(k, g, energy):
    """Return (theta, x, v, w) of all fixed points, by the closed form of `dynamics.fixed_point`.

    Roots theta beyond pi count only if the flight does not touch the floor earlier.
    """
    big = mpf(energy) * 2 * mpf(k) / mpf(g) ** 2 + 1

    def excess(theta):
        return (1 + mpf(k)) * theta**2 + (1 - theta * mpmath.cot(theta)) ** 2 - big

    found = []
    last = float(mpmath.sqrt(big / (1 + k)))
    # Nodes are dense near both ends, where cot is infinite.
    share = (1 - np.cos(np.pi * (np.arange(4000) + 1 / 3) / 4000)) / 2
    for branch in range(int(last / np.pi) + 1):
        theta = np.pi * (branch + share)
        q = theta / np.tan(np.pi * share)
        values = (1 + k) * theta**2 + (1 - q) ** 2 - float(big)
        for j in np.nonzero(values[:-1] * values[1:] <= 0)[0]:
            theta0 = mpmath.findroot(
                excess, theta[j : j + 2].tolist(), solver="anderson", tol=1e-50
            )
            v, w = g * theta0, g * theta0 / mpf(k)
            x = w * mpmath.cot(theta0)
            t = np.linspace(0, 2 * float(theta0), 20_001)[1:-1]
            gap = float(x) * (1 - np.cos(t)) - float(v) * t + 0.5 * g * t * t - float(w) * np.sin(t)
            if np.all(gap < 0):
                found.append((theta0, x, v, w))
    return found


FIXED = [
    *SETTINGS,
    (0.2, 0.004, 0.05),
    (0.2, 0.001, 0.09),
    (0.5, 0.01, 0.2),
    (1.0, 0.02, 0.4),
    (0.03, 0.0005, 0.01),
    (0.2, 0.04, -0.004 + 1e-9),
]


@pytest.mark.parametrize(("k", "g", "energy"), FIXED)
def test_fixed_points_against_the_closed_form(k, g, energy):
    ball = Ball(k, g)
    lowest, _ = ball.energy_bounds()
    radius = ball.section(energy)[1]
    # Effect on the points of a rounding of the terms of E
    limit = 1e-15 * (1 + abs(lowest) / (energy - lowest))
    with mpmath.workdps(40):
        expected = sorted(fixed_points(k, g, energy))
        found = symmetric_orbits(ball, energy, 1)
        assert found.sizes["orbit"] == len(expected)
        order = np.argsort(found["tau"].values[:, 0])
        for i, (theta, *state) in zip(order, expected, strict=True):
            stretch = max(1.0, abs(float(found["multiplier"][i])))
            assert abs(float(found["tau"][i, 0]) / 2 - theta) < limit * stretch * theta
            for name, value in zip(NAMES[:3], state, strict=True):
                assert abs(float(found[name][i, 0]) - value) < limit * stretch * radius


def test_any_ball_has_one_fixed_point_below_pi():
    random = np.random.default_rng(2)
    for _ in range(40):
        k = 10 ** random.uniform(-2, 0)
        g = 10 ** random.uniform(-4, 0)
        ball = Ball(k, g)
        lowest, _ = ball.energy_bounds()
        energy = lowest * (1 - 10 ** random.uniform(-3, 1.5))
        theta = symmetric_orbits(ball, energy, 1)["tau"].values[:, 0] / 2
        assert np.sum(theta < np.pi) == 1, (k, g, energy)
