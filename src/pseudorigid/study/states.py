"""The states on which methods are compared, the same on every machine."""

import numpy as np

from ..dynamics.ball import Ball
from ..kernel import impact as kernel
from ..kernel.arithmetic import sincos

BALL = Ball(k=0.2, g=0.04)
ENERGY = 0.01
CHAOTIC = 0.534522  # Figure 2's start in the sea, in section radii


def uniform(count, seed=1):
    """States uniform on the section in its canonical coordinates, where the map keeps areas."""
    random = np.random.default_rng(seed)
    centre, radius = BALL.section(ENERGY)
    states = []
    while len(states) < count:
        a, b = random.uniform(-1.0, 1.0, 2)
        if a * a + b * b < 1.0:
            y = b * radius * np.sqrt(BALL.k * (1.0 + BALL.k))
            states.append(BALL.state_xy(centre + a * radius, y, ENERGY))
    return np.array(states).T.copy()


def grazing(count, smallest=12, seed=2):
    """States with s = xdot + udot from 1e-12 to 1e-2, evenly by decade, on both sides of x = -g."""
    random = np.random.default_rng(seed)
    side = np.where(np.arange(count) % 2 == 0, 1.0, -1.0)
    decade = 3 + random.integers(0, smallest - 2, count)
    s = random.uniform(1.0, 10.0, count) * _ten(-decade)
    return _near_rim(random, side, s)


def distance(exponent, side, count, seed=3):
    """States with s = 10**-exponent at x above (side 1) or below (-1) -g."""
    random = np.random.default_rng([seed, exponent, side + 1])
    return _near_rim(random, np.full(count, float(side)), np.full(count, float(_ten(-exponent))))


def _near_rim(random, side, s):
    """x up to 0.3 away from -g, y within 0.15, and the given s = v + w."""
    x = -BALL.g + side * random.uniform(0.0, 0.3, s.size)
    y = random.uniform(-0.15, 0.15, s.size)
    v = (y + BALL.k * s) / (1.0 + BALL.k)
    return x, v, np.maximum(s - v, -v)


def near_miss(depth, count, seed=4):
    """States whose flight has a local maximum of the gap at height `depth`, at a time of 1 to 6.

    depth > 0: the ball touches the floor there, if only just; depth < 0: it does not. x, b and c
    enter the gap linearly, so that a maximum of given time and height is a pair of equations.
    """
    random = np.random.default_rng([seed, int(depth > 0)])
    head, low = kernel.transfer(BALL.k)
    g = BALL.g
    states = []
    while len(states) < count:
        x = random.uniform(-0.3, 0.3)
        t = random.uniform(1.0, 6.0)
        sine, cosine = sincos(t)
        right = depth - 0.5 * g * t * t - x * (1.0 - cosine)
        slope = -g * t - x * sine
        c = (right - t * slope) / (sine - t * cosine)
        b = slope - c * cosine
        if abs(c) > 1.0 or b + c > -1e-3 or g + x * cosine - c * sine > -0.02:
            continue
        times = t * (np.arange(1, 200) / 200.0)
        waves = np.array([sincos(a) for a in times])
        gaps = x + times * (b + 0.5 * g * times) - x * waves[:, 1] + c * waves[:, 0]
        if gaps[:-10].max() < 0.0:  # nothing earlier
            v, w, _ = kernel.rebound(b, c, BALL.k, head, low)  # the impact law is an involution
            states.append((x, v, w))
    return np.array(states).T.copy()


def chaotic():
    """The start of Figure 2's chaotic sea."""
    return BALL.start(CHAOTIC, ENERGY)


def _ten(exponent):
    """10**exponent as correctly rounded as the decimal literal."""
    table = {int(e): float(f"1e{int(e)}") for e in np.unique(exponent)}
    values = np.array([table[int(e)] for e in np.ravel(exponent)])
    return values if np.ndim(exponent) else values[0]
