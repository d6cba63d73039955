"""Starts of many orbits, spread over the section or over a part of y = 0 in the chaotic sea."""

import math

import numpy as np

from pseudorigid.dynamics.ball import Ball, State

_PLASTIC_NUMBER = 1.324717957244746  # the real root of p^3 = p + 1, to the nearest double
_MAX_SQUARED_RADIUS = 1.0 - 2.0**-40  # closer to the rim, rounding may leave the disk


def section_points(ball: Ball, energy: float, orbits: int) -> tuple[np.ndarray, np.ndarray]:
    """Return points (x, y = xdot - k udot) spread uniformly over the section, islands included.

    The map keeps area in these coordinates. The points are those of the quasirandom sequence R2 in
    the section's disk (Roberts, The unreasonable effectiveness of quasirandom sequences, 2018).
    """
    width, height = half_axes(ball, energy)
    step = np.array([1.0 / _PLASTIC_NUMBER, 1.0 / (_PLASTIC_NUMBER * _PLASTIC_NUMBER)])
    # the disk holds 0.785 of its square, and of any 2 n + 16 points more than n
    square = np.arange(2 * orbits + 16)[:, None] * step + 0.5
    across, up = 2.0 * (square - np.floor(square)).T - 1.0
    (inside,) = np.nonzero(across * across + up * up < _MAX_SQUARED_RADIUS)
    across, up = across[inside[:orbits]], up[inside[:orbits]]
    return ball.section(energy)[0] + width * across, height * up


def half_axes(ball: Ball, energy: float) -> tuple[float, float]:
    """Return the half axes of the section, an ellipse in (x, y)."""
    radius = ball.section(energy)[1]
    return radius, math.sqrt(ball.k * (1.0 + ball.k)) * radius


def sea_states(ball: Ball, energy: float, between: tuple[float, float], orbits: int) -> np.ndarray:
    """Return states just before an impact, (3, orbits), evenly over a part of y = 0.

    Rows are x, xdot, udot. `between` has the part's ends in section radii. Raises ValueError unless
    -1 <= from < to <= 1.
    """
    low, high = between
    if not -1.0 <= low < high <= 1.0:
        raise ValueError(f"between = {between!r} is not allowed: -1 <= from < to <= 1")
    start = low + (high - low) * (np.arange(orbits) + 0.5) / orbits
    return as_array(ball.start(start, energy))


def as_array(state: State) -> np.ndarray:
    """Return a state, or states, as an array (3, n)."""
    return np.stack([np.atleast_1d(a) for a in state])
