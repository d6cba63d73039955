"""Where orbits of the chaotic sea start, for the stages that follow many of them."""

import numpy as np


def sea_states(ball, energy, between, orbits):
    """States spread evenly over a part of the symmetry line y = 0.

    Parameters
    ----------
    ball : Ball
    energy : float
        In m omega^2 R^2.
    between : (float, float)
        Ends of that part, as fractions of the section's radius.
    orbits : int
        How many states; they lie in the middles of as many equal parts.

    Returns
    -------
    start : ndarray, shape (orbits,)
        Fractions of the section's radius.
    x, xdot, udot : ndarray, shape (orbits,)
        The states just before an impact.

    Raises
    ------
    ValueError
        Ends out of order or beyond the section.
    """
    low, high = between
    if not -1.0 <= low < high <= 1.0:
        raise ValueError(f"between = {between!r} is not allowed: -1 <= from < to <= 1")
    start = low + (high - low) * (np.arange(orbits) + 0.5) / orbits
    return start, *ball.start(start, energy)
