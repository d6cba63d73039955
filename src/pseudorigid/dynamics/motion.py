"""Motion in time between the impacts of a periodic orbit."""

import itertools

import numpy as np
import xarray as xr

from ..kernel.arithmetic import sincos_each
from ..kernel.impact_law import impact_coefficients, rebound
from .ball import Ball
from .variables import LENGTH, TIME, of_type, variables

# Samples of each flight. The error of a chord is then 1e-5 of Figure 3's size.
SAMPLES = 200
# Flights of a motion; more than 2 million samples cannot be drawn.
MOST_FLIGHTS = 10_000


def _flights(ball, orbit):
    """Yield (x, xdot, udot, tau) of each flight from a periodic orbit's first point."""
    columns = (orbit[name].values.tolist() for name in ("x", "xdot", "udot", "tau"))
    points = list(zip(*columns, strict=True))
    if ball.map.certified:
        yield from itertools.cycle(points)
    *state, _ = points[0]
    while True:
        *after, tau = ball.impact(*state)
        yield (*state, tau)
        state = after


def scene_motion(
    ball: Ball, energy: float, periodic: xr.Dataset, period: int, type: str, duration: float
) -> xr.Dataset:
    """Compute x(t) and u(t), eq. (26), of a periodic orbit from an impact on (Figures 3 and 4).

    The orbit's own points are repeated. If the ball's map may miss impacts, they are no orbit of
    it, and the first point is followed impact by impact instead. `duration` is in 1/omega; a
    ValueError is raised if it is that of more than MOST_FLIGHTS flights. On `sample`, both ends of
    each flight are included, where position = -strain exactly.

    >>> from pseudorigid import Ball, symmetric_orbits
    >>> ball = Ball(k=0.2, g=0.04)
    >>> scene_motion(ball, 0.01, symmetric_orbits(ball, 0.01, 1), 1, "elliptic", 16).sizes["impact"]
    6
    """
    orbit = of_type(periodic, type, period)
    mean = float(orbit["tau"].mean())
    if not duration <= MOST_FLIGHTS * mean:
        raise ValueError(
            f"duration = {duration!r} is not allowed: at most {MOST_FLIGHTS:,} flights, whose mean "
            f"along this orbit is {mean:.3g}"
        )
    flights = _flights(ball, orbit)
    following = next(flights)
    coefficients = impact_coefficients(ball.k)
    columns, impacts, time = [], [], 0.0
    while time <= duration:
        (x, xdot, udot, tau), following = following, next(flights)
        impacts.append((time, x))
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
        columns.append((time + t, position, strain))
        time += tau
    position_text = "position of the mass centre, downwards", LENGTH
    names = {"t": ("time", TIME), "position": position_text, "strain": "strain"}
    data = variables("sample", np.concatenate(columns, axis=1), names)
    position_text = "position at impact, downwards", LENGTH
    names = {"impact_t": ("time of impact", TIME), "impact_position": position_text}
    return xr.Dataset(data | variables("impact", np.transpose(impacts), names))
