"""Balls and energies whose periodic orbits are searched for."""

from functools import reduce

import numpy as np
import pytest

from pseudorigid import orbit

NAMES = ("x", "xdot", "udot", "tau")
# (k, g, energy); orbits of the last four stretch the ball strongly.
SETTINGS = [
    (0.2, 0.04, 0.01), (0.2, 0.04, 0.001), (0.2, 0.04, -0.00399), (0.2, 0.04, 0.0599),
    (0.05, 0.004, 0.003), (0.01, 0.001, 0.0039), (0.02, 0.009, -0.001), (1 / 3, 0.03, 0.02),
    (1.0, 0.3, -0.03), (0.33, 0.1, 0.06), (1.0, 0.1, 0.05), (0.2, 0.02, 0.03), (0.7, 0.2, 0.1),
]  # fmt: skip
PERIODS = range(1, 13)


def points_of(orbits, i):
    """The points and flights of the i-th orbit, (4, period)."""
    return np.stack([orbits[name].values[i] for name in NAMES])


def check(ball, energy, period, orbits):
    """Check what holds for every result."""
    k = ball.k
    radius = ball.section(energy)[1]
    count = orbits.sizes["orbit"]
    assert orbits.sizes["point"] == period
    assert (orbits.attrs["energy"], orbits.attrs["period"]) == (energy, period)
    assert np.all(np.diff(np.abs(orbits["multiplier"])) >= 0)
    seen = []
    for i in range(count):
        points = points_of(orbits, i)
        trace = float(orbits["trace"][i])
        multiplier = float(orbits["multiplier"][i])
        # The orbit closes under single impacts, to rounding.
        after = np.stack(ball.impact(*points[:3]))
        gap = np.max(np.abs(after[:3] - np.roll(points[:3], -1, axis=1)))
        slopes = np.max(np.abs(ball.jacobian(*points[:3])))
        assert gap <= 1e-14 * max(1.0, slopes / 10.0), (period, trace, gap)
        assert np.allclose(after[3], points[3], rtol=1e-14 * max(1.0, slopes / 10.0), atol=0.0)
        assert np.max(np.abs(ball.energy(*points[:3]) - energy)) < 1e-14 * (1 + radius)
        # The period is prime, and no orbit occurs twice.
        x, y = points[0], points[1] - k * points[2]
        distances = np.hypot(x[:, None] - x, y[:, None] - y) + np.eye(period)
        assert period == 1 or np.min(distances) > 1e-8 * radius
        for other_x, other_y in seen:
            assert np.min(np.hypot(x[:, None] - other_x, y[:, None] - other_y)) > 1e-8 * radius
        seen.append((x, y))
        # The orbit is symmetric under (x, y) -> (x, -y), or said not to be.
        mirrored = np.max(np.min(np.hypot(x[:, None] - x, y[:, None] + y), axis=1))
        if "symmetric" in orbits and not orbits["symmetric"].values[i]:
            assert mirrored > 1e-6 * radius
        else:
            assert mirrored < 1e-9 * radius
        # Trace, type, multiplier and rotation number follow from the Jacobians.
        product = reduce(lambda before, jacobian: jacobian @ before, ball.jacobian(*points[:3]))
        size = 1.0 + np.max(np.abs(product))
        assert abs(np.trace(product) - 1.0 - trace) < 1e-12 * size * size
        assert abs(np.linalg.det(product) - 1.0) < 1e-12 * size * size
        kind = "elliptic" if abs(trace) < 2 else "hyperbolic" if trace > 0 else "inverse hyperbolic"
        assert str(orbits["type"].values[i]) == kind
        half = max(abs(trace) / 2.0, 1.0)
        size = half + np.sqrt(half * half - 1.0)
        assert abs(multiplier) == pytest.approx(size, rel=1e-14)
        assert multiplier * trace > 0.0 or kind == "elliptic"
        rotation = np.arccos(np.clip(trace / 2, -1, 1)) / (2 * np.pi)
        assert float(orbits["rotation_number"][i]) == pytest.approx(rotation, abs=1e-9)
        assert float(orbits["total_time"][i]) == pytest.approx(np.sum(points[3]), rel=1e-15)


def brute_force(ball, energy, period, cells=45, steps=25):
    """Return the orbits that Newton's method in the chart finds from a grid of the section."""
    k = ball.k
    centre, radius = ball.section(energy)
    height = radius * np.sqrt(k * (1 + k))
    grid = np.linspace(-0.9999, 0.9999, cells)
    x, y = (a.ravel() for a in np.meshgrid(grid, grid))
    inside = x * x + y * y < 0.9999
    x, y = centre + radius * x[inside], height * y[inside]

    def image(x, y):
        after = ball.after(ball.state_xy(x, y, energy), period)
        return np.array([after[0], after[1] - k * after[2]])

    def gap_and_derivatives(x, y, step=1e-7 * radius):
        (a, c), (b, d) = (
            (image(x + dx, y + dy) - image(x - dx, y - dy)) / (2 * step)
            for dx, dy in ((step, 0.0), (0.0, step))
        )
        return *(image(x, y) - (x, y)), a, b, c, d

    with np.errstate(all="ignore"):
        for _ in range(steps):
            f, h, a, b, c, d = gap_and_derivatives(x, y)
            det = (a - 1) * (d - 1) - b * c
            dx, dy = ((1 - d) * f + b * h) / det, (c * f + (1 - a) * h) / det
            limit = np.minimum(1, 0.1 / np.hypot(dx / radius, dy / height))
            x, y = x + limit * dx, y + limit * dy
            good = ((x - centre) / radius) ** 2 + (y / height) ** 2 < 1 - 1e-5
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
        found.append((u, v, trace))
    return found


def compare_with_brute_force(ball, energy, orbits, symmetric):
    """Check that orbits are all those of brute force with |trace| < 500; return how many."""
    radius, period = ball.section(energy)[1], orbits.sizes["point"]
    starts = orbits["x"].values[:, 0], (orbits["xdot"] - ball.k * orbits["udot"]).values[:, 0]
    expected = [
        (u, v, trace)
        for u, v, trace in brute_force(ball, energy, period)
        if not symmetric or np.min(np.hypot(u - u[0], v + v[0])) < 1e-7 * radius
    ]
    for u, v, trace in expected:
        pairs = zip(*starts, strict=True)
        found = any(np.min(np.hypot(u - x, v - y)) < 1e-6 * radius for x, y in pairs)
        assert found or abs(trace) > 500, (period, trace, u[0], v[0])
    return len(expected)
