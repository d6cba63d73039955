"""Motion in time, between the impacts of an orbit."""

from collections.abc import Iterator
from itertools import cycle, pairwise
from typing import Any, SupportsFloat

import numpy as np
import xarray as xr

from ..kernel.arithmetic import sincos_each
from ..kernel.formulas import impact_coefficients, rebound
from .ball import Ball, require_ball
from .inputs import StateLike, not_allowed, number
from .periods import orbit_of_type, require_own
from .variables import LENGTH, NAMES, TIME, states_of, variables

# Samples of each flight. The error of a chord is then 1e-5 of Figure 3's size.
SAMPLES = 200
# Flights of a motion; more than 2 million samples cannot be drawn.
MOST_FLIGHTS = 10_000
_ALLOWED = "one state or one orbit of symmetric_orbits"
_SAMPLE_NAMES = {
    "t": ("time", TIME),
    "position": ("position of the mass centre, downwards", LENGTH),
    "strain": "strain",
}
_IMPACT_NAMES = {
    "impact_t": ("time of impact", TIME),
    "impact_position": ("position at impact, downwards", LENGTH),
}


def motion(ball: Ball, start: StateLike, duration: SupportsFloat) -> xr.Dataset:
    """Compute x(t) and u(t), eq. (26), from an impact on.

    Parameters
    ----------
    ball : Ball
    start : (x, xdot, udot) or xarray.Dataset
        One state, as for `orbit`, or one orbit of `symmetric_orbits`, whose points are repeated.
    duration : float
        In 1/omega.

    Returns
    -------
    xarray.Dataset
        t, position and strain on `sample`, with both ends of each flight, where position = -strain
        exactly; impact_t and impact_position on `impact`.

    Raises
    ------
    ValueError
        More than one state, points of another function's orbit or of another ball's, a state with
        xdot + udot < 0, or more than MOST_FLIGHTS flights.

    Examples
    --------
    >>> from pseudorigid import Ball, motion
    >>> ball = Ball(k=0.2, g=0.04)
    >>> motion(ball, ball.start(0.6, energy=0.01), duration=16).sizes["impact"]
    7
    """
    require_ball(ball)
    duration = number("duration", duration, "0 or more", lambda value: value >= 0.0)
    points: list[tuple[Any, ...]] = []
    if isinstance(start, xr.Dataset) and "point" in start.dims:
        # Elsewhere tau is the time since the previous impact, not that to the next one.
        complete = all(name in start and start[name].dims == ("point",) for name in NAMES)
        if not (complete and start["x"].size and "multiplier" in start):
            raise not_allowed("start", start, _ALLOWED)
        require_own(ball, start)
        points = [*zip(*(start[name].values.tolist() for name in NAMES), strict=True)]
        start = points[0][:3]
    state = ball.moving(start)
    if state[0].shape:
        raise not_allowed("start", start, _ALLOWED)
    flights = cycle(points) if points else _flights(ball, *(float(a) for a in state))
    coefficients = impact_coefficients(ball.k)
    samples: list[tuple[np.ndarray, ...]] = []
    impacts: list[tuple[float, float]] = []
    time = 0.0
    for (x, xdot, udot, tau), (next_x, *_) in pairwise(flights):
        if len(impacts) == MOST_FLIGHTS:
            raise not_allowed("duration", duration, f"at most {MOST_FLIGHTS:,} flights")
        impacts.append((time, x))
        b, c, _ = rebound(xdot, udot, ball.k, coefficients)
        t = tau * (np.arange(SAMPLES + 1) / SAMPLES)
        t = np.append(t[time + t < duration], duration - time) if time + tau > duration else t
        sine, cosine = sincos_each(t)
        position = x + t * (b + 0.5 * ball.g * t)
        strain = c * sine - x * cosine
        # At impacts strain = -position exactly: neither is computed there.
        position[0], strain[0] = x, -x
        if time + tau <= duration:
            position[-1], strain[-1] = next_x, -next_x
        samples.append((time + t, position, strain))
        time += tau
        if not time <= duration:  # also where tau is NaN
            break
    data = variables("sample", np.concatenate(samples, axis=1), _SAMPLE_NAMES)
    data |= variables("impact", np.transpose(impacts), _IMPACT_NAMES)
    return xr.Dataset(data, attrs={"k": ball.k, "g": ball.g})


def _flights(ball: Ball, x: Any, xdot: Any, udot: Any) -> Iterator[tuple[Any, ...]]:
    """Yield x, xdot, udot of each impact from a state on, and tau of the flight after it."""
    while True:
        *after, tau = ball.impact(x, xdot, udot)
        yield x, xdot, udot, tau
        x, xdot, udot = after


def scene_motion(
    ball: Ball, energy: float, periodic: xr.Dataset, period: int, type: str, duration: float
) -> xr.Dataset:
    """Compute the motion of a periodic orbit from an impact on (Figures 3 and 4).

    A ball's map that scans for impacts, and may miss some, may leave the points of the orbit. Then
    the first point is followed impact by impact.

    >>> from pseudorigid import Ball, symmetric_orbits
    >>> ball = Ball(k=0.2, g=0.04)
    >>> scene_motion(ball, 0.01, symmetric_orbits(ball, 0.01, 1), 1, "elliptic", 16).sizes["impact"]
    6
    """
    orbit = orbit_of_type(ball, energy, periodic, type, period)
    first = states_of(orbit)[:, 0]
    return motion(ball, orbit if ball.map.certified else first, duration)
