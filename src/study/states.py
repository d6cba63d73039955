"""Sets of states on which methods are compared, the same on every machine.

A set is an array (3, count) of x, xdot, udot just before an impact of the paper's ball. Each has
its own random seed, so that it does not change with another; the seeds' values do not matter.
"""

import numpy as np

from pseudorigid.dynamics.ball import Ball, State
from pseudorigid.kernel.arithmetic import sincos_each
from pseudorigid.kernel.formulas import impact_coefficients, rebound

BALL = Ball(k=0.2, g=0.04)
ENERGY = 0.01
CHAOTIC = 0.534522  # Figure 2's start in the sea, in section radii
# The doubles nearest to 10**-n for n = 0 to 14; a power function may give others.
TEN_TO_MINUS = np.array([float(f"1e-{n}") for n in range(15)])


def chaotic() -> State:
    """Return the start of Figure 2's chaotic sea."""
    return BALL.start(CHAOTIC, ENERGY)


def uniform(count: int) -> np.ndarray:
    """Return states uniform on the section in (x, y), coordinates in which the map keeps area."""
    centre, radius = BALL.section(ENERGY)
    # 0.785 of the square is in the disk; the 20 are for small counts
    a, b = np.random.default_rng(1).uniform(-1.0, 1.0, (2 * count + 20, 2)).T
    inside = np.flatnonzero(a * a + b * b < 1.0)[:count]
    a, b = a[inside], b[inside]
    y = b * radius * np.sqrt(BALL.k * (1.0 + BALL.k))
    return np.array(BALL.state_xy(centre + a * radius, y, ENERGY))


def grazing(count: int) -> np.ndarray:
    """Return states with s = xdot + udot from 1e-12 to 1e-2, evenly by decade, around x = -g."""
    random = np.random.default_rng(2)
    side = np.where(np.arange(count) % 2 == 0, 1.0, -1.0)
    decade = 3 + random.integers(0, 10, count)
    return _near_rim(random, side, random.uniform(1.0, 10.0, count) * TEN_TO_MINUS[decade])


def grazing_at(exponent: int, side: int, count: int) -> np.ndarray:
    """Return states with s = xdot + udot = 10**-exponent, at a distance from grazing.

    x is above -g for side 1, where a grazing ball comes back at once, and below for side -1, where
    it leaves the floor.
    """
    random = np.random.default_rng([3, exponent, side + 1])
    return _near_rim(random, np.full(count, float(side)), np.full(count, TEN_TO_MINUS[exponent]))


def _near_rim(random: np.random.Generator, side: np.ndarray, s: np.ndarray) -> np.ndarray:
    """Return states with x up to 0.3 away from -g, y within 0.15, and the given s."""
    x = -BALL.g + side * random.uniform(0.0, 0.3, s.size)
    y = random.uniform(-0.15, 0.15, s.size)
    xdot = (y + BALL.k * s) / (1.0 + BALL.k)
    return np.array([x, xdot, np.maximum(s - xdot, -xdot)])


def near_miss(height: float, count: int) -> np.ndarray:
    """Return states whose flight has a local maximum of the gap with a given height.

    The time of the maximum is 1 to 6. If the height is positive, the ball just touches the floor.
    The gap is linear in x, b and c, so a maximum of given time and height is a pair of linear
    equations.
    """
    random = np.random.default_rng([4, int(height > 0)])
    k, g = BALL.k, BALL.g
    states: list[tuple[float, ...]] = []
    while len(states) < count:
        x, t = random.uniform(-0.3, 0.3), random.uniform(1.0, 6.0)
        times = t * (np.arange(1, 201) / 200.0)
        sines, cosines = sincos_each(times)
        sine, cosine = sines[-1], cosines[-1]
        right = height - 0.5 * g * t * t - x * (1.0 - cosine)
        slope = -g * t - x * sine
        c = (right - t * slope) / (sine - t * cosine)
        b = slope - c * cosine
        if abs(c) > 1.0 or b + c > -1e-3 or g + x * cosine - c * sine > -0.02:
            continue  # too far out, too near to grazing, or no sharp maximum
        gaps = x + times * (b + 0.5 * g * times) - x * cosines + c * sines
        if gaps[:-11].max() < 0.0:  # no impact before; the last times belong to the maximum
            xdot, udot, _ = rebound(b, c, k, impact_coefficients(k))  # the law is an involution
            states.append((x, xdot, udot))
    return np.array(states).T.copy()
