"""Starts of orbits: on the symmetry line y = 0, or at a point of the section."""

import numpy as np

from .variables import LENGTH, RADIUS, SPEED, attributes_of


def start_state(ball, energy, start):
    """Return the state (x, xdot, udot) of a start.

    A start is a fraction of the section's radius along y = 0, from -1 to 1, or a mapping with x and
    either xdot or y = xdot - k udot. Of two states with this xdot, the one with the larger udot is
    taken. Raises ValueError for a start off the section.
    """
    if not isinstance(start, dict):
        return ball.start(start, energy)
    if "y" in start:
        return ball.state_xy(start["x"], start["y"], energy)
    return ball.state(start["x"], start["xdot"], energy)


def start_variables(starts, states) -> dict:
    """Return dataset variables on `orbit` for some starts and their states.

    `start` is the fraction, NaN where a start is a point. start_x and start_xdot are present if one
    is.
    """
    fractions = [np.nan if isinstance(start, dict) else start for start in starts]
    attributes = attributes_of("start along y = 0, in section radii from the centre", RADIUS)
    data = {"start": ("orbit", np.asarray(fractions, dtype=float), attributes)}
    if any(isinstance(start, dict) for start in starts):
        for i, (name, scale) in enumerate((("x", LENGTH), ("xdot", SPEED))):
            values = np.array([state[i] for state in states], dtype=float)
            data[f"start_{name}"] = ("orbit", values, attributes_of(f"{name} of the start", scale))
    return data
