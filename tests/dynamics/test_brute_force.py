"""Brute force over the whole section finds no symmetric orbit that the search misses."""

import numpy as np
import pytest
from cycles import PERIODS, SETTINGS
from slowly import slowly

from pseudorigid import Ball, orbit, symmetric_orbits


def brute_force(ball, energy, period, cells, steps=25):
    """Return symmetric orbits found by Newton's method in the chart from a grid of the section."""
    k, g = ball.k, ball.g
    centre, radius = ball.section(energy)
    height = radius * np.sqrt(k * (1 + k))
    grid = np.linspace(-0.9999, 0.9999, cells)
    x, y = (a.ravel() for a in np.meshgrid(grid, grid))
    inside = x * x + y * y < 0.9999
    x, y = centre + radius * x[inside], height * y[inside]

    def gap_and_derivatives(x, y):
        state = ball.state_xy(x, y, energy)
        s = state[1] + state[2]
        s_x, s_y = (1 + k) * (g - k * x) / (k * s), -y / (k * s)
        along_x = np.stack([np.ones_like(x), k * s_x / (1 + k), s_x / (1 + k)])
        along_y = np.stack([np.zeros_like(x), (1 + k * s_y) / (1 + k), (s_y - 1) / (1 + k)])
        jacobian = ball.jacobian(*state, impacts=period)
        by_x = np.einsum("nij,jn->in", jacobian, along_x)
        by_y = np.einsum("nij,jn->in", jacobian, along_y)
        after = ball.after(state, period)
        derivatives = (by_x[0], by_y[0], by_x[1] - k * by_x[2], by_y[1] - k * by_y[2])
        return after[0] - x, after[1] - k * after[2] - y, *derivatives

    with np.errstate(all="ignore"):
        for _ in range(steps):
            f, h, a, b, c, d = gap_and_derivatives(x, y)
            det = (a - 1) * (d - 1) - b * c
            dx, dy = ((1 - d) * f + b * h) / det, (c * f + (1 - a) * h) / det
            limit = np.minimum(1, 0.1 / np.hypot(dx / radius, dy / height))
            x, y = x + limit * dx, y + limit * dy
            good = ((x - centre) / radius) ** 2 + (y / height) ** 2 < 1
            x, y = x[good], y[good]
        f, h, a, _, _, d = gap_and_derivatives(x, y)
    solved = np.maximum(np.abs(f), np.abs(h)) < 1e-12
    found = []
    for x0, y0, trace in zip(x[solved], y[solved], (a + d)[solved], strict=True):
        if any(np.min(np.hypot(u - x0, v - y0)) < 1e-7 * radius for u, v, _ in found):
            continue
        points = orbit(ball, ball.state_xy(x0, y0, energy), period)
        u, v = points["x"].values, (points["xdot"] - k * points["udot"]).values
        if period > 1 and np.min(np.hypot(u[:-1] - x0, v[:-1] - y0)) < 1e-7 * radius:
            continue
        if np.min(np.hypot(u - x0, v + y0)) < 1e-7 * radius:
            found.append((u, v, trace))
    return found


def compare_with_brute_force(ball, energy, period, cells):
    """Check that the search finds each orbit of brute force with |trace| < 500."""
    radius = ball.section(energy)[1]
    orbits = symmetric_orbits(ball, energy, period)
    starts = orbits["x"].values[:, 0], (orbits["xdot"] - ball.k * orbits["udot"]).values[:, 0]
    expected = brute_force(ball, energy, period, cells)
    for u, v, trace in expected:
        near = [
            np.min(np.hypot(u - x, v - y)) < 1e-6 * radius for x, y in zip(*starts, strict=True)
        ]
        assert any(near) or abs(trace) > 500, (period, trace, u[0], v[0])
    return len(expected)


@pytest.mark.parametrize(
    ("k", "g", "energy", "periods"),
    [
        (0.2, 0.04, 0.01, (1, 2, 6)),
        (1.0, 0.1, 0.05, (3, 9)),
        (0.03, 0.0005, 0.01, (2,)),
        *slowly((0.05, 0.004, 0.003, (5, 7)), (0.33, 0.1, 0.06, (5,))),
    ],
)
def test_brute_force_finds_no_orbit_that_the_search_misses(k, g, energy, periods):
    found = [compare_with_brute_force(Ball(k, g), energy, period, 70) for period in periods]
    assert sum(found) > 0


@pytest.mark.slow
@pytest.mark.parametrize(("k", "g", "energy"), SETTINGS)
def test_brute_force_to_period_twelve(k, g, energy):
    for period in PERIODS:
        compare_with_brute_force(Ball(k, g), energy, period, 70)
