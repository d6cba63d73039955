"""Where the orbits of a scene start: on the symmetry line y = 0, or at a point of the section."""

import numpy as np

from .variables import LENGTH, RADIUS, SPEED, attributes_of


def start_state(ball, energy, start):
    """The state (x, xdot, udot) of a start.

    Parameters
    ----------
    ball : Ball
    energy : float
        In m omega^2 R^2.
    start : float or mapping
        A fraction of the section's radius along y = 0, from -1 to 1; or a point with x and
        either xdot or y = xdot - k udot.

    Returns
    -------
    x, xdot, udot : float
        Of two states with this xdot, that with the larger udot.

    Raises
    ------
    ValueError
        A start off the section.
    """
    if not isinstance(start, dict):
        return ball.start(start, energy)
    if "y" in start:
        return ball.state_xy(start["x"], start["y"], energy)
    return ball.state(start["x"], start["xdot"], energy)


def start_variables(starts, states):
    """Dataset variables that say where orbits start.

    Parameters
    ----------
    starts : list
        Each as for `start_state`.
    states : sequence of (x, xdot, udot)
        The starts' states.

    Returns
    -------
    dict
        On `orbit`: start, the fraction, NaN where it is a point; where one is, start_x and
        start_xdot.
    """
    fractions = [np.nan if isinstance(start, dict) else start for start in starts]
    about = attributes_of("start along y = 0, in section radii from the centre", RADIUS)
    data = {"start": ("orbit", np.asarray(fractions, dtype=float), about)}
    if any(isinstance(start, dict) for start in starts):
        for i, (name, scale) in enumerate((("x", LENGTH), ("xdot", SPEED))):
            values = np.array([state[i] for state in states], dtype=float)
            data[f"start_{name}"] = ("orbit", values, attributes_of(f"{name} of the start", scale))
    return data
