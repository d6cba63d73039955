"""Balls and energies whose periodic orbits the tests search for."""

import numpy as np

from pseudorigid.dynamics.motion import scene_motion

NAMES = ("x", "xdot", "udot", "tau")
# (k, g, energy); orbits of the last four stretch the ball strongly.
SETTINGS = [
    (0.2, 0.04, 0.01),
    (0.2, 0.04, 0.001),
    (0.2, 0.04, -0.00399),
    (0.2, 0.04, 0.0599),
    (0.05, 0.004, 0.003),
    (0.01, 0.001, 0.0039),
    (0.02, 0.009, -0.001),
    (1 / 3, 0.03, 0.02),
    (1.0, 0.3, -0.03),
    (0.33, 0.1, 0.06),
    (1.0, 0.1, 0.05),
    (0.2, 0.02, 0.03),
    (0.7, 0.2, 0.1),
]
PERIODS = range(1, 13)


def points_of(orbits, i):
    """The points and flights of the i-th orbit, (4, period)."""
    return np.stack([orbits[name].values[i] for name in NAMES])


def motion_of(ball, orbit, duration):
    """The motion along one of the orbits that `symmetric_orbits` finds."""
    kind, orbits = orbit["type"].item(), orbit.expand_dims("orbit")
    period, energy = orbit.sizes["point"], orbit.attrs["energy"]
    return scene_motion(ball, energy, orbits, period, kind, duration)
