"""Starts of many orbits, spread over the section, and states of the chaotic ones among them."""

import math

import numpy as np

from pseudorigid.dynamics.ball import Ball, State
from pseudorigid.dynamics.verdict import classify_orbits

_PLASTIC_NUMBER = 1.324717957244746  # the real root of p^3 = p + 1, to the nearest double
_MAX_SQUARED_RADIUS = 1.0 - 2.0**-40  # closer to the rim, rounding may leave the disk
BEGINNING = 16_000  # impacts that decide which orbits are chaotic, and belong to no average


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


def sea_states(ball: Ball, energy: float, orbits: int) -> np.ndarray:
    """Return states just before an impact, (3, n), of the chaotic ones of orbits over the section.

    Rows are x, xdot, udot. The orbits start at `section_points`, as the map keeps area: averages
    over the chaotic ones are those of the sea from the first impact on. `classify_orbits` decides
    by their first BEGINNING impacts which are chaotic, and so prefers orbits that leave the edges
    of islands soon; the states are those after these impacts. Raises ValueError if fewer
    than two orbits are chaotic.
    """
    states = as_array(ball.state_xy(*section_points(ball, energy, orbits), energy))
    centre, expected = np.full(orbits, ball.section(energy)[0] / ball.g), np.full(orbits, math.nan)
    verdicts = classify_orbits(ball.k, states / ball.g, centre, expected, BEGINNING)
    chaotic = ~verdicts.regular
    if chaotic.sum() < 2:
        raise ValueError(
            f"orbits = {orbits} is not allowed: {chaotic.sum()} of them are chaotic, fewer than 2: "
            "give more orbits or another energy"
        )
    return ball.after(states[:, chaotic], BEGINNING)[:3]


def ratio(numerators: np.ndarray, denominators: np.ndarray) -> tuple[float, float]:
    """Return the ratio of two sums over orbits, and its standard error by the orbits' spread."""
    value = float(numerators.sum() / denominators.sum())
    apart, count = numerators - value * denominators, numerators.size
    error = math.sqrt(float(np.sum(apart * apart)) * count / (count - 1)) / denominators.sum()
    return value, float(error)


def as_array(state: State) -> np.ndarray:
    """Return a state, or states, as an array (3, n)."""
    return np.stack([np.atleast_1d(a) for a in state])
