"""Orbits of periods up to 40 have the digits that ball arithmetic encloses."""

from fractions import Fraction

import numpy as np
import pytest
from flint import arb, ctx

from extensions.proofs.checkers.periodic import enclose, newton_image
from extensions.proofs.enclosure.surface import Surface
from helpers.cycles import points_of
from helpers.slowly import slowly
from pseudorigid import Ball, periodic_orbits, symmetric_orbits

# Largest errors of orbits that are not polished: points in section radii, traces relative to 2.
OF_POINTS, OF_TRACES = 5e-12, 2e-12


def enclosed(surface, points):
    """Points (4, n) and trace of the orbit next to points, to some 40 digits."""
    k = surface.constants()[0]
    near = [[arb(x), (arb(v) - k * arb(w)).mid()] for x, v, w, _ in points.T.tolist()]
    for _ in range(2):
        near = [[a.mid() for a in point] for point in newton_image(surface, near)]
    orbit = enclose(surface, near)
    states = ((x, *surface.velocities(x, y)) for x, y in near)
    rows = [[*state, it.tau] for state, it in zip(states, orbit.impacts, strict=True)]
    return rows, orbit.trace


@pytest.mark.parametrize(("k", "g", "energy", "periods", "step"), [
    (0.2, 0.04, 0.01, (17, 40), 30), (1.0, 0.1, 0.05, (11,), 1),
    *slowly(
        (0.2, 0.04, 0.01, range(1, 41), 1),
        (0.2, 0.04, 0.001, range(1, 41), 1),
        (0.33, 0.1, 0.06, range(1, 41), 20),
        (1 / 3, 0.03, 0.02, (31,), 5),  # first points alone gave a sixfold trace
        (1.0, 0.1, 0.05, range(1, 41), 20),
    ),
])  # fmt: skip
def test_digits_of_points_times_and_traces(k, g, energy, periods, step):
    ball = Ball(k, g)
    radius = ball.section(energy)[1]
    polished = 0
    with ctx.workprec(256):
        surface = Surface(Fraction(k), Fraction(g), Fraction(energy))
        for period in periods:
            # At period 20 those without symmetry too.
            find = periodic_orbits if period == 20 else symmetric_orbits
            orbits = find(ball, energy, period)
            for i in range(0, orbits.sizes["orbit"], step):
                points, trace = points_of(orbits, i), float(orbits["trace"][i])
                rows, exact = enclosed(surface, points)
                off = [
                    [abs(float(a - b)) for a, b in zip(row, point, strict=True)]
                    for row, point in zip(rows, points.T.tolist(), strict=True)
                ]
                wrong = abs(float(exact - trace))
                growth = np.max(np.abs(ball.jacobian(*points[:3], impacts=period)))
                if growth > 51.0 or abs(trace - 2.0) < 0.99e-3:
                    polished += 1
                    # Where the trace is 2 to rounding, the enclosures' equations are singular.
                    right = np.all(off <= 0.51 * np.spacing(np.abs(points.T)))
                    assert right or abs(trace - 2.0) < 1e-15, (period, trace)
                    # The trace of an elliptic orbit is below 2, even if 2 is nearer.
                    last_bits = 1.01 if abs(trace) == np.nextafter(2.0, 0.0) else 0.51
                    assert wrong <= last_bits * np.spacing(abs(trace)), (period, trace)
                elif growth < 49.0:
                    assert np.max(off) < OF_POINTS * radius * 10, (period, trace)
                    assert wrong < OF_TRACES * max(2.0, abs(trace)), (period, trace)
    assert polished > 0
