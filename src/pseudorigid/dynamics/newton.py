"""Periodic orbits with and without symmetry, by Newton's method from a grid over the section."""

from collections.abc import Iterable, Iterator
from typing import SupportsFloat, SupportsIndex

import numpy as np
import xarray as xr

from ..kernel.closing import close
from .ball import Ball, require_ball
from .ensemble import in_threads
from .inputs import number, whole_number
from .periodic import dataset_of, distinct_orbits
from .variables import chart, described, states_of

# Starts to a side, in the rectangle around the section. Half of them are used, because the mirror
# image of an orbit is one too.
GRID = 400
NEAR = 1e-7  # distance, in section radii, below which two points are the same


def periodic_orbits(ball: Ball, energy: SupportsFloat, period: SupportsIndex) -> xr.Dataset:
    """Find the orbits of a prime period, with and without symmetry, that two searches show.

    To those of `symmetric_orbits`, Newton's method from a grid of starts over the section adds the
    others. It can miss some: very unstable ones, since few starts lead to them, and those without
    symmetry whose trace is closer to 2 than some 10^-7. At E = 0.01, k = 0.2 and g = 0.04 it finds
    24 of period 20, of which 10 have no symmetry. Its time is proportional to the period.

    Parameters
    ----------
    ball : Ball
    energy : float
        Above the lowest energy, -g^2/(2k).
    period : int
        Number of impacts, at least 1.

    Returns
    -------
    xarray.Dataset
        The variables and attributes of `symmetric_orbits`, as accurate, and on `orbit`: symmetric,
        whether the reversor (x, y = xdot - k udot) -> (x, -y) maps the orbit to itself. Orbits
        without symmetry come in pairs of mirror images. The first point of an orbit lies on a
        symmetry line, or has the largest x if the orbit has no symmetry. Attributes also: grid, the
        number of starts to a side.

    Raises
    ------
    ValueError
        The energy is below the lowest one, or the period is below 1.

    Examples
    --------
    >>> from pseudorigid import Ball, periodic_orbits
    >>> orbits = periodic_orbits(Ball(k=1/3, g=0.03), 0.02, 3)
    >>> orbits["symmetric"].values.tolist()
    [False, False, True, True]
    """
    require_ball(ball)
    period, energy = whole_number("period", period), number("energy", energy)
    known = [*distinct_orbits(ball, energy, period)]
    orbits = [*((orbit, True) for orbit in known), *_others(ball, energy, period, known)]
    data = dataset_of(ball, energy, period, orbits)
    points = _to_disk(ball, energy, states_of(data))
    symmetric = [_is_symmetric(orbit) for orbit in points.swapaxes(0, 1)]
    meaning = "whether the reversor maps the orbit to itself"
    table = described({"symmetric": ("orbit", np.array(symmetric, dtype=bool), meaning)})
    return data.assign(table).assign_attrs(grid=GRID)


def _others(
    ball: Ball, energy: float, period: int, known: Iterable[np.ndarray]
) -> Iterator[tuple[np.ndarray, bool]]:
    """Yield the orbits (4, period) that the grid adds to known ones, and whether each is symmetric.

    Points that Newton's method finds are in the disk, which is the section in units of its radius.
    """
    found = _periodic_points(ball, energy, period)
    for orbit in known:
        states = _both_ways(ball, orbit[:3, 0], period)
        found = _not_on(found, _to_disk(ball, energy, states))
    while found.size:
        states = _both_ways(ball, _from_disk(ball, energy, found[:, 0]), period)
        points = _to_disk(ball, energy, states)
        distances = np.max(np.abs(points[:, 1:] - points[:, :1]), axis=0)
        found = _not_on(found[:, 1:], points)
        if np.any(distances < NEAR):
            continue  # the prime period is a divisor
        if _is_symmetric(points):
            yield _starting_at(ball, states, _on_line(*points)), True
        else:
            for each in (states, np.stack(ball.reflect(*states))[:, ::-1]):
                yield _starting_at(ball, each, int(np.argmax(each[0]))), False


def _periodic_points(ball: Ball, energy: float, period: int) -> np.ndarray:
    """Return the points (2, n) of the disk to which Newton's method leads from the grid."""
    side = (2.0 * np.arange(GRID) + 1.0) / GRID - 1.0
    starts = np.stack(np.meshgrid(side, side[GRID // 2 :])).reshape(2, -1)
    starts = starts[:, np.sum(starts * starts, axis=0) < 1.0]
    centre, (radius, height) = _disk(ball, energy)
    points = np.column_stack((centre + radius * starts[0], height * starts[1]))

    def close_piece(piece: np.ndarray) -> int:
        close(piece, ball.k, ball.g, energy, period, radius)
        return 0

    in_threads(close_piece, period, points)
    x, y = points[~np.isnan(points[:, 0])].T
    return np.stack(((x - centre) / radius, y / height))


def _disk(ball: Ball, energy: float) -> tuple[float, tuple[float, float]]:
    """Return the section's centre, and its half axes along x and y."""
    centre, radius = ball.section(energy)
    return centre, (radius, radius * float(np.sqrt(ball.k * (1.0 + ball.k))))


def _to_disk(ball: Ball, energy: float, states: np.ndarray) -> np.ndarray:
    """Return the points (2, ...) of the disk of states (3, ...)."""
    centre, (radius, height) = _disk(ball, energy)
    x, y = chart(ball.k, *states)
    return np.stack(((x - centre) / radius, y / height))


def _from_disk(ball: Ball, energy: float, point: np.ndarray) -> np.ndarray:
    """Return the state (3,) at a point of the disk."""
    centre, (radius, height) = _disk(ball, energy)
    return np.stack(ball.state_xy(centre + radius * point[0], height * point[1], energy))


def _both_ways(ball: Ball, state: np.ndarray, period: int) -> np.ndarray:
    """Return the states (3, period) of an orbit, half of them ahead and half of them back in time.

    Their errors grow like the square root of the orbit's multiplier.
    """
    ahead = (period - 1) // 2
    out = ball.history(state, ahead)[0, :, :3].T
    back = ball.history(ball.reflect(*state), period - 1 - ahead)[0, :, :3].T
    return np.column_stack((state, out, np.stack(ball.reflect(*back))[:, ::-1]))


def _not_on(found: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Return those of some points (2, n) that are not on an orbit or its mirror image."""
    on_orbit = np.zeros(found.shape[1], dtype=bool)
    for x, y in points.T.tolist():
        on_orbit |= (np.abs(found[0] - x) < NEAR) & (np.abs(np.abs(found[1]) - abs(y)) < NEAR)
    return found[:, ~on_orbit]


def _is_symmetric(points: np.ndarray) -> bool:
    """Return whether one of the points (2, n) of an orbit is the mirror image of the first one."""
    apart = np.abs(points - points[:, :1] * np.array([[1.0], [-1.0]]))
    return bool(np.any(np.max(apart, axis=0) < NEAR))


def _on_line(x: np.ndarray, y: np.ndarray) -> int:
    """Return which point (n,) of a symmetric orbit is on Fix R or, mirrored by the next, Fix RP."""
    off_rp = np.maximum(np.abs(x - np.roll(x, -1)), np.abs(y + np.roll(y, -1)))
    return int(np.argmin(np.minimum(np.abs(y), off_rp)))


def _starting_at(ball: Ball, states: np.ndarray, first: int) -> np.ndarray:
    """Return the states and times of flight (4, n) of an orbit from its point `first` on."""
    states = np.roll(states, -first, axis=1)
    return np.vstack((states, ball.after(states)[3]))
