"""Criteria that tell regular orbits from chaotic ones.

The length exp(G) of a tangent vector grows in proportion to the number of impacts n on a regular
orbit, and like exp(lambda n), with a Lyapunov exponent lambda > 0, on a chaotic one.

The *growth* of an orbit of n impacts is the mean of G over its last quarter less the mean of G over
its second quarter. It is ln(7/3) = 0.85 on average on a regular orbit of any length, and lambda n/2
on a chaotic one. An orbit is regular if its growth is below GROWTH_THRESHOLD.

From exponents of whole orbits the growth cannot be computed. A second criterion serves for these:
an orbit is regular if its largest exponent is at most `regular_bound`.
tests/dynamics/test_regularity.py checks that both criteria agree.
"""

import numpy as np
import xarray as xr

from ..kernel.arithmetic import log
from ..kernel.verdict import GROWTH_THRESHOLD
from .ball import Ball
from .variables import states_of

_LEAST_IMPACTS = 2000  # behind a verdict on an orbit of a scene
_STRIDE = 10  # impacts
_BLOCK = 2000  # strides whose states are in memory at once


def regular(exponent: np.ndarray, impacts: int) -> np.ndarray:
    """Return which orbits are regular by their growth.

    `exponent` is that of `rotation.winding`: the growth divided by half the number of impacts.
    """
    return exponent * (0.5 * impacts) < GROWTH_THRESHOLD


def regular_bound(length: int) -> float:
    """Upper bound of a regular orbit's exponents over a whole orbit, 3 ln n/n.

    ln n/n is the exponent of a tangent vector that grows exactly like n; the factor of 3 leaves
    room for any other constant of proportionality.
    """
    return 3.0 * log(float(length)) / length


def chaotic_orbits(ball: dict[str, float], orbits: xr.Dataset) -> list[int]:
    """Return the indices of the orbits of a dataset of `scene_orbits` that are chaotic.

    An orbit with few impacts is followed further, since its growth tells little.
    """
    sizes, states = orbits["row_size"].values, np.array(states_of(orbits))
    first = np.cumsum(sizes) - sizes
    lengths = [max(size, _LEAST_IMPACTS) for size in sizes.tolist()]
    followed = zip(states[:, first].T, lengths, strict=True)
    growths = [_growth(Ball(ball["k"], ball["g"]), *each) for each in followed]
    return [index for index, growth in enumerate(growths) if not growth < GROWTH_THRESHOLD]


def _growth(ball: Ball, state: np.ndarray, impacts: int) -> float:
    """Return the growth of the tangent vector (1, 0, 0) along the orbit of a state.

    G is taken after each _STRIDE impacts. The two functions of the ball are those with which stages
    compute orbits and their periods, so that a drawing need not compile another loop.
    """
    x, v, w, total = 1.0, 0.0, 0.0, 0.0
    logarithms = np.empty(impacts // _STRIDE)
    for first in range(0, logarithms.size, _BLOCK):
        count = min(_BLOCK, logarithms.size - first)
        orbit = ball.history(state, count * _STRIDE)[0, :, :3].T
        before, state = orbit[:, ::_STRIDE], orbit[:, -1]
        jacobians = ball.jacobian(before[0], before[1], before[2], _STRIDE).tolist()
        for i, (of_x, of_v, of_w) in enumerate(jacobians, first):
            x, v, w = _product(of_x, x, v, w), _product(of_v, x, v, w), _product(of_w, x, v, w)
            length = abs(x) + abs(v) + abs(w)
            x, v, w = x / length, v / length, w / length
            total += log(length)
            logarithms[i] = total
    quarter = logarithms.size // 4
    return float(np.mean(logarithms[-quarter:]) - np.mean(logarithms[quarter : 2 * quarter]))


def _product(row: list[float], x: float, v: float, w: float) -> float:
    """Return the product of a matrix's row and a vector, in the order written."""
    return row[0] * x + row[1] * v + row[2] * w
