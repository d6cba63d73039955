"""Rotation number and exponent of orbits that start on the symmetry line y = 0."""

import numpy as np

from pseudorigid.dynamics import fixed_point
from pseudorigid.dynamics.ball import Ball
from pseudorigid.kernel.tangents import turns_and_growth
from pseudorigid.kernel.verdict import GROWTH_THRESHOLD

LOCKED = 3e-9  # turns an impact; rotation numbers as near to a fraction are taken for it


def symmetric_fixed_point(ball: Ball, energy: float) -> tuple[float, float]:
    """Return the fixed point's place on y = 0 and its rotation number, NaN if not elliptic."""
    e = energy / (ball.g * ball.g)
    centre, radius = Ball.dimensionless(ball.k).section(e)
    x, _, rotation = fixed_point.numbers(ball.k, e)
    return (x - centre) / radius, rotation


def regular(exponent: np.ndarray, impacts: int) -> np.ndarray:
    """Return which orbits have the growth of regular ones, by one threshold.

    `exponent` is that of `winding`, the growth divided by half the number of impacts. Along a line
    of starts this finds the edges of islands. A chaotic orbit that sticks to an island may pass.
    """
    return exponent * (0.5 * impacts) < GROWTH_THRESHOLD


def winding(
    ball: Ball, energy: float, place: np.ndarray, impacts: int
) -> tuple[np.ndarray, np.ndarray]:
    """Return rotation numbers around the fixed point, and exponents, of orbits.

    `place` has their starts on y = 0, in section radii from the centre. Both numbers are those of
    `kernel.tangents.turns_and_growth`.
    """
    unit_ball = Ball.dimensionless(ball.k)  # lengths in g R: neither number depends on the unit
    e = energy / (ball.g * ball.g)
    centre, radius = unit_ball.section(e)
    fixed_place, fixed_rotation = symmetric_fixed_point(ball, energy)
    fixed_x = centre + radius * fixed_place
    return turns_and_growth(ball.k, unit_ball.start(place, e), fixed_x, fixed_rotation, impacts)
