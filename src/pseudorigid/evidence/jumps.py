"""Where the map jumps: the states whose next flight just touches the floor.

A touch in flight, f = f' = 0, is a state on the section's rim, s = xdot + udot = 0, with x < -g:
to the right of x = -g the floor does not let the ball go. So the map jumps on the image of that arc
of the rim under the inverse, and the inverse on its image under the map; the reversor exchanges the
two curves. There is an arc where the rim reaches beyond -g, that is for E > g^2 (1 + k/2).
"""

import math

import numpy as np
import xarray as xr

from ..dynamics.variables import ENERGY, LENGTH, SPEED, chart, described
from ..kernel.arithmetic import sincos_each
from ..kernel.law import rebound, transfer

# The arc's ends are left out by so little: at x = -g rounding would decide whether the ball leaves.
_LEFT_OUT = 2.0**-46
_PLANE = "R, with 1/omega as unit of time"  # of lengths in the plane (x, y)
_HALVED = "by how much it differs from what half as many sides give"


def jumps(ball, energy, energies, sides):
    """The curves where the map jumps, at several energies, and the symmetry lines at the first.

    Parameters
    ----------
    ball : Ball
    energy : float
        The first of the energies (m omega^2 R^2).
    energies : sequence of float
        The others.
    sides : int
        Into how many sides a curve is divided, a multiple of four.

    Returns
    -------
    xarray.Dataset
        On energy: radius, of the section along y = 0, and length, of the curve in the plane
        (x, y = xdot - k udot), 0 where there is none, by Richardson's rule; length_error, by how
        much it differs from what half as many sides give, and what the ends left out make. On
        (energy, point), NaN where there is none: rim_x, rim_y, the arc of the rim; x, y, its image
        under the map, where the inverse jumps. The map jumps on the mirror image (x, -y). On one
        side of it the next impact is near (rim_x, -rim_y), on the other near the image of that,
        the point with the same index counted from the end. flight_x, flight_y (half_time, branch):
        the symmetry line Fix RP of flights symmetric in time, NaN where a flight is not the first
        to end. Attribute first_energy: from where on there are such curves, g^2 (1 + k/2).

    Raises
    ------
    ValueError
        A number of sides that four does not divide, or an energy below the lowest.

    References
    ----------
    The paper's section 3 calls the map (28) a diffeomorphism; that holds up to E = g^2 (1 + k/2).

    Examples
    --------
    >>> from pseudorigid import Ball
    >>> jumps(Ball(k=0.2, g=0.04), 0.01, [0.001], 40).sizes["energy"]
    2
    """
    if sides % 4:
        raise ValueError(f"sides = {sides} is not allowed: a multiple of four")
    levels = [float(energy), *map(float, energies)]
    curves = np.stack([_arc(ball, level, sides + 1) for level in levels], axis=1)
    fine, middle, coarse = (_lengths(curves[2:, :, ::step]) for step in (1, 2, 4))
    length = fine + (fine - middle) / 3.0
    error = np.abs(length - (middle + (middle - coarse) / 3.0)) + _LEFT_OUT * length
    radii = [ball.section(level)[1] for level in levels]
    flight_x, flight_y = _symmetric_flights(ball, energy, sides)
    curve, line = ("energy", "point"), ("half_time", "branch")
    data = {
        "rim_x": (curve, curves[0], "x of grazing states that leave the floor", LENGTH),
        "rim_y": (curve, curves[1], "y of these states", SPEED),
        "x": (curve, curves[2], "x of their next impact, where the inverse jumps", LENGTH),
        "y": (curve, curves[3], "y of their next impact", SPEED),
        "energy": ("energy", levels, "energy", ENERGY),
        "radius": ("energy", radii, "the section's radius along y = 0", LENGTH),
        "length": ("energy", length, "length of the curve in (x, y)", _PLANE),
        "length_error": ("energy", error, _HALVED, _PLANE),
        "flight_x": (line, flight_x, "x on the symmetry line Fix RP", LENGTH),
        "flight_y": (line, flight_y, "y on that line", SPEED),
    }
    first = ball.g * ball.g * (1.0 + 0.5 * ball.k)
    return xr.Dataset(described(data), attrs={"first_energy": first})


def _lengths(curves):
    """Lengths of polylines (2, n, vertices), 0 for those of NaN: (n,)."""
    steps = curves[:, :, 1:] - curves[:, :, :-1]
    return np.nansum(np.sqrt(np.sum(steps * steps, axis=0)), axis=1)


def _arc(ball, energy, points):
    """x, y of the arc of the rim with x < -g, and of its image: (4, points)."""
    centre, radius = ball.section(energy)
    k, g = ball.k, ball.g
    if not centre - radius < -g:
        return np.full((4, points), math.nan)
    # x = centre - radius (1 - t^2)/(1 + t^2), y = high 2 t/(1 + t^2), |t| < the t of x = -g
    high = math.sqrt(k * (1.0 + k)) * radius
    depth = (centre + g) / radius
    end = math.sqrt((1.0 - depth) / (1.0 + depth))
    t = end * (1.0 - _LEFT_OUT) * (1.0 - 2.0 * np.arange(points) / (points - 1.0))
    x = centre - radius * ((1.0 - t) * (1.0 + t) / (1.0 + t * t))
    y = high * (2.0 * t / (1.0 + t * t))
    states = x, y / (1.0 + k), -y / (1.0 + k)
    return np.stack([x, y, *chart(k, *ball.impact(*states)[:3])])


def _symmetric_flights(ball, energy, points):
    """(x, y) of the states whose flight is symmetric in time, (2, points, 2).

    A flight of length 2 theta has b = -g theta, x = a cos theta, c = -a sin theta, where a solves
    E = g^2 theta^2/2 + k a^2/2 - g a cos theta; NaN where it has no solution, where the state is
    off the section or where the floor ends the flight before.
    """
    _, radius = ball.section(energy)
    k, g = ball.k, ball.g
    theta = radius * math.sqrt(k) / g * (np.arange(points) + 0.5) / points
    sine, cosine = sincos_each(theta)
    square = g * g * cosine * cosine + k * (2.0 * energy - g * g * theta * theta)
    root = np.sqrt(np.where(square >= 0.0, square, math.nan))
    found = []
    for sign in (1.0, -1.0):
        a = (g * cosine + sign * root) / k
        v, w, _ = rebound(-g * theta, -a * sine, k, *transfer(k))
        good = v + w >= 0.0
        state = [np.where(good, column, math.nan) for column in (a * cosine, v, w)]
        tau = ball.time_to_impact(*state)
        # no earlier impact has ended the flight; where it grazes tau is good to 1e-8
        first = np.abs(tau - 2.0 * theta) <= 1e-7 * (1.0 + theta)
        found.append([np.where(first, column, math.nan) for column in (state[0], v - k * w)])
    return np.array(found).transpose(1, 2, 0)
