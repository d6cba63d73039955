"""The sets of states on which methods are compared, the same on every machine.

A set is an array (3, count): x, xdot, udot just before an impact of the paper's ball. Each has a
seed of its own, so that none changes with another; which numbers these are does not matter.
"""

import numpy as np

from ..dynamics.ball import Ball
from ..kernel.arithmetic import sincos_each
from ..kernel.impact_law import impact_coefficients, rebound

BALL = Ball(k=0.2, g=0.04)
ENERGY = 0.01
CHAOTIC = 0.534522  # Figure 2's start in the sea, in section radii
# The double nearest to 10**-n, for n = 0 to 14, which a power function need not give.
TEN_TO_MINUS = np.array([float(f"1e-{n}") for n in range(15)])


def chaotic():
    """The start of Figure 2's chaotic sea, a state of three floats."""
    return BALL.start(CHAOTIC, ENERGY)


def uniform(count):
    """States uniform on the section in its canonical coordinates, where the map keeps areas."""
    centre, radius = BALL.section(ENERGY)
    # Of the square 0.785 is in the disk; the 20 are for small counts.
    pairs = np.random.default_rng(1).uniform(-1.0, 1.0, (2 * count + 20, 2))
    a, b = pairs[pairs[:, 0] * pairs[:, 0] + pairs[:, 1] * pairs[:, 1] < 1.0][:count].T
    y = b * radius * np.sqrt(BALL.k * (1.0 + BALL.k))
    return np.array(BALL.state_xy(centre + a * radius, y, ENERGY))


def grazing(count):
    """States with s = xdot + udot from 1e-12 to 1e-2, evenly by decade, on both sides of x = -g."""
    random = np.random.default_rng(2)
    side = np.where(np.arange(count) % 2 == 0, 1.0, -1.0)
    decade = 3 + random.integers(0, 10, count)
    return _near_rim(random, side, random.uniform(1.0, 10.0, count) * TEN_TO_MINUS[decade])


def grazing_at(exponent, side, count):
    """States at a distance from grazing, s = xdot + udot = 0.

    Parameters
    ----------
    exponent : int
        s is 10**-exponent.
    side : {1, -1}
        x above or below -g: a ball that grazes comes back at once, or leaves.
    count : int

    Returns
    -------
    ndarray, shape (3, count)
    """
    random = np.random.default_rng([3, exponent, side + 1])
    return _near_rim(random, np.full(count, float(side)), np.full(count, TEN_TO_MINUS[exponent]))


def _near_rim(random, side, s):
    """x up to 0.3 away from -g, y within 0.15, and the given s = xdot + udot."""
    x = -BALL.g + side * random.uniform(0.0, 0.3, s.size)
    y = random.uniform(-0.15, 0.15, s.size)
    xdot = (y + BALL.k * s) / (1.0 + BALL.k)
    return np.array([x, xdot, np.maximum(s - xdot, -xdot)])


def near_miss(height, count):
    """States whose flight has a local maximum of the gap at a time of 1 to 6.

    x, b and c enter the gap linearly, so that a maximum of given time and height is a pair of
    equations.

    Parameters
    ----------
    height : float
        Of the maximum: above 0 the ball touches the floor there, if only just, below it does not.
    count : int

    Returns
    -------
    ndarray, shape (3, count)
    """
    random = np.random.default_rng([4, int(height > 0)])
    k, g = BALL.k, BALL.g
    states = []
    while len(states) < count:
        x = random.uniform(-0.3, 0.3)
        t = random.uniform(1.0, 6.0)
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
        if gaps[:-11].max() < 0.0:  # nothing earlier; the last tenths belong to the maximum
            xdot, udot, _ = rebound(
                b, c, k, impact_coefficients(k)
            )  # the impact law is an involution
            states.append((x, xdot, udot))
    return np.array(states).T.copy()
