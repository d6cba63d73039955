"""The ball in the frames of a moving picture, and the impacts that it has made by then."""

import numpy as np
import xarray as xr

from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.variables import LENGTH, NAMES, of_rows, rows
from pseudorigid.kernel.arithmetic import sincos_each
from pseudorigid.kernel.formulas import impact_coefficients, rebound

_FIRST = 0.5  # 1/omega: the longest time between the first two frames of an orbit
_NAMES = {
    "followed": ("frame", "orbit that the ball follows"),
    "impacts": ("frame", "number of its impacts so far"),
    "position": ("frame", "position of the mass centre, downwards", LENGTH),
    "strain": ("frame", "strain"),
}


def scene_frames(ball: Ball, energy: float, orbits: xr.Dataset, frames: list[int]) -> xr.Dataset:
    """Compute position and strain, eq. (26), in `frames` frames of each orbit.

    An orbit begins at its first impact, in slow motion. The time between frames grows by a constant
    factor, so that the last frame shows the orbit's last impact.
    """
    coefficients = impact_coefficients(ball.k)
    values: list[tuple[float, ...]] = []
    for index, (span, count) in enumerate(zip(rows(orbits), frames, strict=True)):
        x, xdot, udot, tau = (orbits[name].values[span] for name in NAMES)
        impact_t = np.cumsum(np.append(0.0, tau[1:]))
        frame_t = _growing(float(impact_t[-1]), count)
        last = np.searchsorted(impact_t, frame_t, side="right") - 1
        t = frame_t - impact_t[last]
        b, c, _ = rebound(xdot[last], udot[last], ball.k, coefficients)
        sine, cosine = sincos_each(t)
        position = x[last] + t * (b + 0.5 * ball.g * t)
        strain = c * sine - x[last] * cosine
        values += zip([index] * count, last + 1, position, strain, strict=True)
    return xr.Dataset(of_rows(_NAMES, values))


def _growing(end: float, count: int) -> np.ndarray:
    """Return `count` times from 0 to `end` whose distances grow by a constant factor."""
    first, low, high = min(_FIRST, end / (count - 1)), 1.0, end / _FIRST + 1.0
    while (factor := 0.5 * (low + high)) not in (low, high):
        low, high = (factor, high) if _times(first, factor, count)[-1] < end else (low, factor)
    return np.append(_times(first, low, count)[:-1], end)


def _times(first: float, factor: float, count: int) -> np.ndarray:
    """Return times from 0 on whose distances grow from `first` by a factor."""
    steps = np.multiply.accumulate([first, *[factor] * (count - 2)])
    return np.append(0.0, np.cumsum(steps))
