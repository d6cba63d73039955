"""Where the orbits of a cell start: evenly over one half of the section's area."""

import math

import numpy as np

from pseudorigid.kernel.arithmetic import sincos
from pseudorigid.kernel.compiled import jit

_GOLDEN_RATIO = 0.6180339887498949  # the smaller one


@jit
def sunflower_point(k: float, e: float, i: int, count: int) -> tuple[float, float, float]:
    """Return the state (x, v, w) of start i of `count`, lengths in g R.

    They lie on a golden spiral, over the half y >= 0. v is xdot, w is udot, s = v + w the contact
    speed.
    """
    energy = 2.0 * e + 1.0 / k  # twice the energy above that of the ball at rest
    area = (i + 0.5) / count  # share of the half disk that is nearer to the centre
    sine, cosine = sincos(math.pi * (i * _GOLDEN_RATIO - int(i * _GOLDEN_RATIO)))
    radius = math.sqrt(area)
    y = math.sqrt((1.0 + k) * energy) * radius * sine
    s = math.sqrt((1.0 + k) * energy / k) * math.sqrt(1.0 - area)
    x = 1.0 / k + math.sqrt(energy / k) * radius * cosine
    return x, (y + k * s) / (1.0 + k), (s - y) / (1.0 + k)


@jit
def sunflower_points(k: float, e: float, count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the states x, v, w (count,) of all starts."""
    x, v, w = np.empty(count), np.empty(count), np.empty(count)
    for i in range(count):
        x[i], v[i], w[i] = sunflower_point(k, e, i, count)
    return x, v, w
