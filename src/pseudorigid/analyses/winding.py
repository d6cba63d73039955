"""Rotation numbers around the fixed point, and exponents, of orbits that start on y = 0."""

import numpy as np

from ..dynamics import fixed_point
from ..dynamics.ball import Ball
from ..dynamics.tangent_orbits import begin, propagate_with_tangent, weight


def symmetric_fixed_point(ball: Ball, energy: float) -> tuple[float, float]:
    """Return the fixed point's place on y = 0, in section radii, and its rotation number.

    The place is counted from the section's centre. The rotation number is NaN without an elliptic
    point.
    """
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
    states = unit_ball.start(place, e)
    orbits = begin(ball.k, states, centre + radius * fixed_place, fixed_rotation)
    quarter = impacts // 4
    turning = np.array([(0, impacts)])
    growing = np.array([(quarter, quarter), (impacts - quarter, quarter)])
    turned, growth = np.zeros((1, place.size)), np.zeros((2, place.size))
    propagate_with_tangent(orbits, ball.k, 0, impacts, turning, growing, turned, growth)
    exponent = (growth[1] - growth[0]) / (quarter * (impacts - 2.0 * quarter))
    return turned[0] / weight(impacts), exponent
