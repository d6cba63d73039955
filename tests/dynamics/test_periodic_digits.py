"""Periodic points and their traces in 40 digits."""

import mpmath
import pytest
from cycles import points_of
from independent_solver import exact_jacobian, exact_map
from mpmath import mpf

from pseudorigid import Ball, symmetric_orbits


def high_precision(ball, state, period):
    """Return P^n and its 3 x 3 Jacobian at a state in 40 digits."""
    product = mpmath.eye(3)
    for _ in range(period):
        product = mpmath.matrix(exact_jacobian(ball.k, ball.g, *state)) * product
        state = exact_map(mpf(ball.k), mpf(ball.g), *state)[:3]
    return state, product


@pytest.mark.parametrize(
    ("k", "g", "energy", "period"),
    [
        (0.2, 0.04, 0.01, 1),
        (0.2, 0.04, 0.01, 6),
        (0.2, 0.04, 0.01, 9),
        (0.2, 0.04, 0.001, 10),
        (0.2, 0.04, 0.001, 12),
        (0.05, 0.004, 0.003, 5),
        (1.0, 0.1, 0.05, 3),
        (0.33, 0.1, 0.06, 11),
    ],
)
def test_trace_and_points_in_forty_digits(k, g, energy, period):
    """Newton's method in 40 digits moves a point and its trace only by roundings."""
    ball = Ball(k, g)
    orbits = symmetric_orbits(ball, energy, period)
    assert orbits.sizes["orbit"] > 0
    with mpmath.workdps(60):
        for i in range(orbits.sizes["orbit"]):
            points = points_of(orbits, i)
            z = mpmath.matrix([mpf(a) for a in points[:3, 0]])
            for _ in range(2):
                after, product = high_precision(ball, z, period)
                x, v, w = z
                # Orbits form a family, so the energy is prescribed.
                missing = v * v / 2 + ball.k * w * w / 2 - ball.g * x + ball.k * x * x / 2
                system = mpmath.matrix(4, 3)
                system[:3, :] = product - mpmath.eye(3)
                system[3, :] = mpmath.matrix([[mpf(ball.k) * x - ball.g, v, mpf(ball.k) * w]])
                right = mpmath.matrix([*(a - b for a, b in zip(z, after, strict=True)), 0])
                right[3] = mpf(energy) - missing
                z += mpmath.lu_solve(system, right)
            moved = max(abs(float(a - b)) for a, b in zip(z, points[:3, 0], strict=True))
            trace = float(product[0, 0] + product[1, 1] + product[2, 2] - 1)
            size = max(1.0, *(abs(float(a)) for a in product))
            assert moved < 2e-15 * max(1.0, size / 50)
            assert abs(trace - float(orbits["trace"][i])) < 2e-13 * size * size
