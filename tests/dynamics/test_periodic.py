"""Periodic orbits: closure, prime periods, symmetry, stability, digits and completeness."""

import numpy as np
import pytest
from cycles import NAMES, PERIODS, SETTINGS, points_of
from independent_solver import periodic_point
from sections import BALL
from slowly import slowly

from pseudorigid import Ball, symmetric_orbits
from pseudorigid.dynamics.variables import of_type


def tolerance(multiplier):
    return 1e-14 * max(1.0, abs(multiplier) / 50.0)


def check(ball, energy, period, orbits):
    """Check what holds for every result."""
    k = ball.k
    radius = ball.section(energy)[1]
    count = orbits.sizes["orbit"]
    assert orbits.sizes["point"] == period
    assert (orbits.attrs["energy"], orbits.attrs["period"]) == (energy, period)
    for name, variable in orbits.data_vars.items():
        assert variable.dims == (("orbit", "point") if name in NAMES else ("orbit",))
        assert variable.dtype == (object if name == "type" else float)
    assert np.all(np.diff(np.abs(orbits["multiplier"])) >= 0)
    seen = []
    for i in range(count):
        points = points_of(orbits, i)
        trace = float(orbits["trace"][i])
        multiplier = float(orbits["multiplier"][i])
        limit = tolerance(multiplier)
        # The orbit closes under single impacts from the first point.
        state = points[:3, 0]
        for j in range(period):
            assert np.array_equal(state, points[:3, j])
            *state, tau = ball.impact(*state)
            state = np.array(state)
            assert tau == points[3, j]
        gap = np.max(np.abs(state - points[:3, 0]))
        assert gap <= limit, (period, trace, gap)
        assert np.max(np.abs(ball.energy(*points[:3]) - energy)) < 1e-14 * (1 + radius) + 2 * limit
        # The period is prime, and no orbit occurs twice.
        x, y = points[0], points[1] - k * points[2]
        apart = np.hypot(x[:, None] - x, y[:, None] - y) + np.eye(period)
        assert period == 1 or np.min(apart) > 1e-8 * radius
        for other_x, other_y in seen:
            assert np.min(np.hypot(x[:, None] - other_x, y[:, None] - other_y)) > 1e-8 * radius
        seen.append((x, y))
        # The orbit is symmetric under (x, y) -> (x, -y).
        mirrored = np.min(np.hypot(x[:, None] - x, y[:, None] + y), axis=1)
        assert np.max(mirrored) < 1e-9 * radius
        # Trace, type, multiplier and rotation number follow from the Jacobians.
        product = np.eye(3)
        for state in points[:3].T:
            product = ball.jacobian(*state) @ product
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


@pytest.mark.parametrize(
    ("k", "g", "energy"),
    [*SETTINGS[::7], *slowly(*(one for i, one in enumerate(SETTINGS) if i % 7))],
)
def test_orbits_of_periods_to_twelve(k, g, energy):
    ball = Ball(k, g)
    for period in PERIODS:
        orbits = symmetric_orbits(ball, energy, period)
        check(ball, energy, period, orbits)
        assert orbits.attrs["unsolved"] == 0, period


@pytest.mark.parametrize(
    ("k", "g", "energy", "period", "trace"),
    [
        (0.33, 0.1, 0.06, 5, -204.586359),
        (1.0, 0.1, 0.05, 9, 2.496474),
        (1.0, 0.1, 0.05, 9, -80.8446),
        (1.0, 0.1, 0.05, 4, -3181.3),
        (0.2, 0.02, 0.03, 12, -2529.7),
        (0.8381357920683287, 0.1085487373774775, 0.024725646514105436, 7, -54.6626),
    ],
)
def test_orbits_that_are_hard_to_close_are_found(k, g, energy, period, trace):
    orbits = symmetric_orbits(Ball(k, g), energy, period)
    assert np.min(np.abs(orbits["trace"].values / trace - 1)) < 1e-4


def test_of_type_returns_one_orbit_or_names_the_available_types():
    orbits = symmetric_orbits(BALL, 0.01, 7)
    assert of_type(orbits, "hyperbolic").sizes == {"point": 7}
    for period, found in ((7, "inverse hyperbolic"), (2, "none at all")):
        with pytest.raises(ValueError, match=rf"no elliptic orbit of period {period}.*{found}"):
            of_type(symmetric_orbits(BALL, 0.01, period), "elliptic")


def test_a_scaled_problem_has_the_same_orbits_scaled():
    for period in (1, 6, 7):
        plain = symmetric_orbits(BALL, 0.01, period)
        scaled = symmetric_orbits(Ball(0.2, 0.04 / 8), 0.01 / 64, period)
        for name in ("x", "xdot", "udot"):
            assert np.array_equal(scaled[name].values, plain[name].values / 8)
        for name in ("tau", "trace", "multiplier", "rotation_number", "total_time"):
            assert np.array_equal(scaled[name].values, plain[name].values)


@pytest.mark.parametrize(
    ("k", "g", "energy", "period"),
    [
        *((0.2, 0.04, 0.01, period) for period in (1, 6)),
        (0.05, 0.004, 0.003, 5),
        *slowly(
            (0.2, 0.04, 0.01, 9),
            *((0.2, 0.04, 0.001, period) for period in (10, 12)),
            (1.0, 0.1, 0.05, 3),
            (0.33, 0.1, 0.06, 11),
        ),
    ],
)
def test_trace_and_points_in_sixty_digits(k, g, energy, period):
    """A Newton step in 60 digits moves a point only by roundings, and has its trace."""
    ball = Ball(k, g)
    orbits = symmetric_orbits(ball, energy, period)
    assert orbits.sizes["orbit"] > 0
    for i in range(orbits.sizes["orbit"]):
        first = points_of(orbits, i)[:3, 0]
        point, product = periodic_point(ball, energy, first, period)
        moved = max(abs(float(a - b)) for a, b in zip(point, first, strict=True))
        trace = float(product[0, 0] + product[1, 1] + product[2, 2] - 1)
        size = max(1.0, *(abs(float(a)) for a in product))
        assert moved < 2e-15 * max(1.0, size / 50)
        assert abs(trace - float(orbits["trace"][i])) < 2e-13 * size * size
