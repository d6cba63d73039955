"""Branches of the period-six saddles at the paper's values."""

import numpy as np
import pytest

from pseudorigid import Ball, symmetric_orbits, trace_manifold
from pseudorigid.dynamics.variables import of_type

BALL, ENERGY = Ball(0.2, 0.04), 0.01


@pytest.fixture(scope="module")
def saddle():
    return of_type(symmetric_orbits(BALL, ENERGY, 6), "hyperbolic")


@pytest.mark.parametrize("side", ["inner", "outer"])
def test_sides_and_bends_keep_their_promise(saddle, side):
    branch = trace_manifold(BALL, ENERGY, saddle, side=side, length=2.0, distance=0.01, bend=10.0)
    points = np.stack([branch[name].values for name in ("x", "xdot", "udot")])
    assert np.all(points[:, 0] == [saddle[name].values[0] for name in ("x", "xdot", "udot")])
    steps = np.diff(points, axis=1) / BALL.section(ENERGY)[1]
    sides = np.sqrt(np.sum(steps**2, axis=0))
    assert np.nanmax(sides) <= 0.01
    cosine = np.sum(steps[:, 1:] * steps[:, :-1], axis=0) / (sides[1:] * sides[:-1])
    drawn = np.maximum(sides[1:], sides[:-1]) > 1e-5
    assert np.nanmin(cosine[drawn]) >= np.cos(np.radians(10.0)) - 1e-12
    assert np.nansum(sides) == pytest.approx(2.0, abs=0.02)
    assert branch.attrs["start_error"] < 1e-10


def test_the_stable_branch_is_the_mirror_image(saddle):
    unstable = trace_manifold(BALL, ENERGY, saddle, 1, length=0.5)
    stable = trace_manifold(BALL, ENERGY, saddle, 0, stable=True, length=0.5)
    mirrored = BALL.reflect(*(unstable[name].values for name in ("x", "xdot", "udot")))
    # rounding may put points elsewhere on the line; none is further from it than a side is long
    across = mirrored[0][:, None] - stable["x"].values
    along = mirrored[1][:, None] - stable["xdot"].values
    near = np.min(np.sqrt(across**2 + along**2), axis=1)
    assert np.max(near) < 0.01 * BALL.section(ENERGY)[1]


def test_an_elliptic_orbit_has_none():
    elliptic = of_type(symmetric_orbits(BALL, ENERGY, 6), "elliptic")
    with pytest.raises(ValueError, match="elliptic"):
        trace_manifold(BALL, ENERGY, elliptic)
