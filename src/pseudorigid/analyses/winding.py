"""How orbits that start on y = 0 wind round the fixed point, and how fast neighbours part."""

import numpy as np

from ..dynamics import fixed_point
from ..dynamics.ball import Ball
from ..dynamics.tangent_orbits import begin, propagate_with_tangent, weight


def fixed(ball, energy):
    """Place and rotation number of the symmetric fixed point.

    Parameters
    ----------
    ball : Ball
    energy : float
        In m omega^2 R^2.

    Returns
    -------
    place : float
        Where it is on y = 0, in section radii from the centre.
    rotation : float
        Its rotation number, NaN where it is not elliptic.
    """
    e = energy / (ball.g * ball.g)
    middle, radius = Ball(ball.k, 1.0).section(e)
    place, _, rotation = fixed_point.numbers(ball.k, e)
    return (place - middle) / radius, rotation


def winding(ball, energy, place, impacts):
    """Rotation numbers around the fixed point, and exponents.

    Parameters
    ----------
    ball : Ball
    energy : float
        In m omega^2 R^2.
    place : ndarray, shape (n,)
        Starts on y = 0, in section radii from the centre.
    impacts : int
        Of each orbit.

    Returns
    -------
    rotation : ndarray, shape (n,)
        Turns an impact, a weighted Birkhoff average.
    exponent : ndarray, shape (n,)
        Of a tangent vector, nats an impact, between the middles of the second and the last quarter.

    References
    ----------
    Das, Saiki, Sander and Yorke, Quantitative quasiperiodicity, Nonlinearity 30 (2017); the
    weights here are (t (1 - t))^3.
    """
    unit = Ball(ball.k, 1.0)  # lengths in g R: neither number depends on the unit
    e = energy / (ball.g * ball.g)
    middle, radius = unit.section(e)
    at, about = fixed(ball, energy)
    orbits = begin(ball.k, unit.start(place, e), middle + radius * at, about)
    quarter = impacts // 4
    turning = np.array([(0, impacts)])
    growing = np.array([(quarter, quarter), (impacts - quarter, quarter)])
    turned, growth = np.zeros((1, place.size)), np.zeros((2, place.size))
    propagate_with_tangent(orbits, ball.k, 0, impacts, turning, growing, turned, growth)
    exponent = (growth[1] - growth[0]) / (quarter * (impacts - 2.0 * quarter))
    return turned[0] / weight(impacts), exponent
