"""The motion in time between the impacts of a periodic orbit."""

import itertools

import numpy as np
import xarray as xr

from ..kernel.arithmetic import sincos_each
from ..kernel.impact_law import impact_coefficients, rebound
from .variables import LENGTH, TIME, of_type, variables

# Samples a flight is drawn with: at Figure 3's scale the chord of 1/200 of a flight is off by 1e-5.
SAMPLES = 200
# More flights than this are no picture: 2 million samples.
MOST_FLIGHTS = 10_000


def _flights(ball, orbit):
    """(x, xdot, udot, tau) of one flight after the other from a periodic orbit's first point."""
    columns = (orbit[name].values.tolist() for name in ("x", "xdot", "udot", "tau"))
    points = list(zip(*columns, strict=True))
    if ball.map.certified:
        yield from itertools.cycle(points)
    *state, _ = points[0]
    while True:
        *after, tau = ball.impact(*state)
        yield (*state, tau)
        state = after


def scene_motion(ball, energy, periodic, period, type, duration):
    """Motion in time along a periodic orbit of given period and type.

    Parameters
    ----------
    ball : Ball
    energy : float
        Of the orbits; they carry it themselves.
    periodic : xarray.Dataset
        Orbits of this period, as from `symmetric_orbits`.
    period : int
        Of the orbit.
    type : {"elliptic", "hyperbolic", "inverse hyperbolic"}
        Of the orbit.
    duration : float
        The length of time (1/omega).

    Returns
    -------
    xarray.Dataset
        As from `motion`.

    Raises
    ------
    ValueError
        No such orbit, or too long a duration.

    References
    ----------
    Kanso and Papadopoulos, eq. (26), Figures 3 and 4.

    Examples
    --------
    >>> from pseudorigid import Ball, symmetric_orbits
    >>> ball = Ball(k=0.2, g=0.04)
    >>> scene_motion(ball, 0.01, symmetric_orbits(ball, 0.01, 1), 1, "elliptic", 16).sizes["impact"]
    6
    """
    return motion(ball, of_type(periodic, type, period), duration)


def motion(ball, orbit, duration):
    """x(t) and u(t), eq. (26), along a periodic orbit from an impact at t = 0.

    The orbit's own points are repeated; a map that is not certified, for which they are no orbit,
    follows the first one impact by impact.

    Parameters
    ----------
    ball : Ball
    orbit : xarray.Dataset
        One orbit, x, xdot, udot, tau on `point`, as from `variables.of_type`.
    duration : float
        The length of time (1/omega).

    Returns
    -------
    xarray.Dataset
        On `sample` t (1/omega), position (x, in R) and strain (u), both ends of each flight
        included, where position = -strain exactly; impact_t and impact_position on `impact`.

    Raises
    ------
    ValueError
        A duration of more than MOST_FLIGHTS flights.
    """
    mean = float(orbit["tau"].mean())
    if not duration <= MOST_FLIGHTS * mean:
        raise ValueError(
            f"duration = {duration!r} is not allowed: at most {MOST_FLIGHTS:,} flights, whose mean "
            f"along this orbit is {mean:.3g}"
        )
    flights = _flights(ball, orbit)
    following = next(flights)
    coefficients = impact_coefficients(ball.k)
    columns = [[], [], []]
    impacts = [[], []]
    time = 0.0
    while time <= duration:
        (x, xdot, udot, tau), following = following, next(flights)
        impacts[0].append(time)
        impacts[1].append(x)
        b, c, _ = rebound(xdot, udot, ball.k, coefficients)
        t = tau * (np.arange(SAMPLES + 1) / SAMPLES)
        t = np.append(t[time + t < duration], duration - time) if time + tau > duration else t
        sine, cosine = sincos_each(t)
        position = x + t * (b + 0.5 * ball.g * t)
        strain = c * sine - x * cosine
        position[0], strain[0] = x, -x
        if time + tau <= duration:
            end = following[0]
            position[-1], strain[-1] = end, -end
        for column, values in zip(columns, (time + t, position, strain), strict=True):
            column.append(values)
        time += tau
    about = "position of the mass centre, downwards", LENGTH
    names = {"t": ("time", TIME), "position": about, "strain": "strain"}
    data = variables("sample", [np.concatenate(c) for c in columns], names)
    about = "position at impact, downwards", LENGTH
    names = {"impact_t": ("time of impact", TIME), "impact_position": about}
    return xr.Dataset(data | variables("impact", [np.array(c) for c in impacts], names))
