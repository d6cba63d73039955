"""Rotation number and exponent of orbits, and which orbits are chaotic."""

import numpy as np
import xarray as xr

from . import fixed_point
from .ball import Ball
from .regularity import regular
from .tangent_orbits import begin, propagate_with_tangent, weight
from .variables import states_of

LOCKED = 3e-9  # turns an impact; rotation numbers as near to a fraction are taken for it
_LEAST_IMPACTS = 2000  # behind a verdict on an orbit


def symmetric_fixed_point(ball: Ball, energy: float) -> tuple[float, float]:
    """Return the fixed point's place on y = 0 and its rotation number, NaN if not elliptic."""
    e = energy / (ball.g * ball.g)
    centre, radius = Ball(ball.k, 1.0).section(e)
    x, _, rotation = fixed_point.numbers(ball.k, e)
    return (x - centre) / radius, rotation


def winding(
    ball: Ball, energy: float, place: np.ndarray, impacts: int
) -> tuple[np.ndarray, np.ndarray]:
    """Return rotation numbers around the fixed point, and exponents, of orbits.

    `place` has their starts on y = 0, in section radii from the centre. A rotation number, in turns
    an impact, is a weighted Birkhoff average with the weights (t (1 - t))^3 (Das, Saiki, Sander and
    Yorke, Nonlinearity 30, 2017). An exponent is the growth rate of a tangent vector, in nats an
    impact, from the middle of the second quarter to the middle of the last.
    """
    unit_ball = Ball(ball.k, 1.0)  # lengths in g R: neither number depends on the unit
    e = energy / (ball.g * ball.g)
    centre, radius = unit_ball.section(e)
    fixed_place, fixed_rotation = symmetric_fixed_point(ball, energy)
    fixed_x = centre + radius * fixed_place
    return turns_and_growth(ball.k, unit_ball.start(place, e), fixed_x, fixed_rotation, impacts)


def turns_and_growth(k, states, centre, expected, impacts) -> tuple[np.ndarray, np.ndarray]:
    """Return rotation numbers and exponents, as `winding` does, of states with lengths in g R.

    The other arguments are those of `tangent_orbits.begin`.
    """
    quarter = impacts // 4
    turning = np.array([(0, impacts)])
    growing = np.array([(quarter, quarter), (impacts - quarter, quarter)])
    orbits = begin(k, states, centre, expected)
    turned, growth = np.zeros((1, orbits.shape[1])), np.zeros((2, orbits.shape[1]))
    propagate_with_tangent(orbits, k, 0, impacts, turning, growing, turned, growth)
    exponent = (growth[1] - growth[0]) / (quarter * (impacts - 2.0 * quarter))
    return turned[0] / weight(impacts), exponent


def chaotic_orbits(ball: dict[str, float], orbits: xr.Dataset) -> list[int]:
    """Return the indices of the orbits of a dataset of `scene_orbits` that are chaotic.

    An orbit with few impacts is followed further, since its growth tells little.
    """
    sizes, found = orbits["row_size"].values, []
    states = np.array(states_of(orbits)) / ball["g"]
    for index, first in enumerate((np.cumsum(sizes) - sizes).tolist()):
        impacts = max(int(sizes[index]), _LEAST_IMPACTS)
        _, exponent = turns_and_growth(ball["k"], states[:, [first]], 0.0, np.nan, impacts)
        if not regular(exponent, impacts)[0]:
            found.append(index)
    return found
