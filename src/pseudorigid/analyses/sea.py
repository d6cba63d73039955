"""Where orbits start in the stages that follow many of them: in the sea, or over the section."""

import numpy as np

_PLASTIC = 1.324717957244746  # the real root of p^3 = p + 1, to the nearest double
_INSIDE = 1.0 - 2.0**-40  # of the squared radius: closer to the rim, rounding may leave the disk


def section_points(ball, energy, orbits):
    """Points spread uniformly over the section's area, islands and sea alike.

    They are the points of the sequence R2 in the section's disk, (x, y = xdot - k udot),
    where the map keeps area: no randomness, and more evenly spread than random points.

    Parameters
    ----------
    ball : Ball
    energy : float
        In m omega^2 R^2.
    orbits : int
        How many points.

    Returns
    -------
    x, y : ndarray, shape (orbits,)
        The points; `ball.state_xy` makes states of them.

    References
    ----------
    Roberts, The unreasonable effectiveness of quasirandom sequences (2018).
    """
    centre, radius = ball.section(energy)
    step = np.array([1.0 / _PLASTIC, 1.0 / (_PLASTIC * _PLASTIC)])
    # the disk holds 0.785 of its square, and of any 2 n + 16 points more than n
    square = np.arange(2 * orbits + 16)[:, None] * step + 0.5
    across, up = 2.0 * (square - np.floor(square)).T - 1.0
    (inside,) = np.nonzero(across * across + up * up < _INSIDE)
    across, up = across[inside[:orbits]], up[inside[:orbits]]
    high = np.sqrt(ball.k * (1.0 + ball.k)) * radius
    return centre + radius * across, high * up


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
