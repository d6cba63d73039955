"""Periodic orbits with and without symmetry, by Newton's method from cells of the section.

A point lies on an orbit of period n if its images after half of n impacts, ahead and back in time,
are the same. Both images are computed at the corners of a grid. Where the difference may vanish in
a cell, Newton's method starts; where the difference is large there, since the map stretches or
jumps, the cell is first divided. The points of an orbit are found one by one, so that their number
says how complete the search is.
"""

from typing import SupportsFloat, SupportsIndex

import numpy as np
import xarray as xr

from ..kernel import formulas
from ..kernel.arithmetic import sincos_each
from ..kernel.closing import close
from .ball import Ball, require_ball
from .ensemble import in_threads
from .inputs import number, whole_number
from .periodic import dataset_of, distinct_orbits
from .variables import chart, described, states_of

# Searches: cells along the section's radius, half of their number along its half rim, and how often
# a cell is divided into four. The second one is made if the first one saw half of the points of an
# orbit, or fewer.
SEARCHES = (500, 3), (650, 4)
MOST_CELLS = 200_000  # that are divided at once
COARSE = 0.1  # difference of images across a cell, in section radii, above which it is divided
MARGIN = 0.2  # of the differences at the corners, for those between them
RIM = 1e-6  # part of the quarter turn from the centre to the rim that is left out
NEAR = 1e-7  # distance, in section radii, below which two points are the same
_Found = tuple[
    np.ndarray, bool, int
]  # an orbit, whether it is symmetric, how many points were seen


def periodic_orbits(ball: Ball, energy: SupportsFloat, period: SupportsIndex) -> xr.Dataset:
    """Find the orbits of a prime period, with and without symmetry, that two searches show.

    To those of `symmetric_orbits`, Newton's method from cells of the section adds the others. It
    can miss orbits near which the map stretches more than along those that it finds, and those
    without symmetry whose trace is closer to 2 than some 10^-7; `least_points_seen` tells. At E =
    0.01, k = 0.2 and g = 0.04 it finds 24 of period 20, of which 10 have no symmetry. Its time is
    proportional to the period.

    Parameters
    ----------
    ball : Ball
    energy : float
        Within `ball.energy_bounds()`.
    period : int
        Number of impacts, at least 1.

    Returns
    -------
    xarray.Dataset
        The variables and attributes of `symmetric_orbits`, as accurate, and on `orbit`: symmetric,
        whether the reversor (x, y = xdot - k udot) -> (x, -y) maps the orbit to itself. Orbits
        without symmetry come in pairs of mirror images. The first point of an orbit lies on a
        symmetry line, or has the largest x if the orbit has no symmetry. Attributes also: grid, the
        number of cells along the section's radius; points_seen, the share of the points of all
        these orbits that the cells showed one by one; least_points_seen, the share of the orbit
        with the fewest. An orbit is missing only if none of its points was seen: while both shares
        are near 1 that is unlikely, and if the least one is 1/period, one more may be missing.

    Raises
    ------
    ValueError
        The energy is not within the bounds, or the period is below 1.

    Notes
    -----
    What was seen once tells how much was not seen: A. Chao, Nonparametric estimation of the number
    of classes in a population, Scandinavian Journal of Statistics 11 (1984).

    Examples
    --------
    >>> from pseudorigid import Ball, periodic_orbits
    >>> orbits = periodic_orbits(Ball(k=1/3, g=0.03), 0.02, 3)
    >>> orbits["symmetric"].values.tolist()
    [False, False, True, True]
    """
    require_ball(ball)
    period, energy = whole_number("period", period), number("energy", energy)
    known, on_lines = distinct_orbits(ball, energy, period)
    orbits: list[_Found] = [(orbit, True, 1) for orbit in known]  # all fixed points are symmetric
    points = np.empty((2, 0))
    for cells, halvings in SEARCHES if period > 1 else ():
        found = _periodic_points(ball, energy, period, cells, halvings)
        points = np.append(points, found, axis=1)
        orbits = _orbits_through(ball, energy, period, known, points)
        if all(2 * seen > period for *_, seen in orbits):
            break
    solved = [(orbit, symmetric) for orbit, symmetric, _ in orbits]
    data = dataset_of(ball, energy, period, solved, on_lines)
    disk = _to_disk(ball, energy, states_of(data))
    symmetric = [_is_symmetric(orbit) for orbit in disk.swapaxes(0, 1)]
    meaning = "whether the reversor maps the orbit to itself"
    table = described({"symmetric": ("orbit", np.array(symmetric, dtype=bool), meaning)})
    shares = [seen / period for *_, seen in orbits] or [1.0]
    seen = {"points_seen": float(np.mean(shares)), "least_points_seen": min(shares)}
    return data.assign(table).assign_attrs(grid=cells if period > 1 else 0, **seen)


def _orbits_through(
    ball: Ball, energy: float, period: int, known: list[np.ndarray], found: np.ndarray
) -> list[_Found]:
    """Return known orbits (4, period), and those of this prime period through found points (2, n).

    Points are in the disk, which is the section in units of its radius.
    """
    orbits: list[_Found] = []
    rest = found
    for orbit in known:
        points = _to_disk(ball, energy, _both_ways(ball, orbit[:3, 0], period))
        orbits.append((orbit, True, _count(found, points)))
        rest = _not_on(rest, points)
    while rest.size:
        states = _both_ways(ball, _from_disk(ball, energy, rest[:, 0]), period)
        points = _to_disk(ball, energy, states)
        distances = np.max(np.abs(points[:, 1:] - points[:, :1]), axis=0)
        rest = _not_on(rest[:, 1:], points)
        if np.any(distances < NEAR):
            continue  # the prime period is a divisor
        seen = _count(found, points)
        if _is_symmetric(points):
            orbits.append((_starting_at(ball, states, _on_line(*points)), True, seen))
        else:
            for each in (states, np.stack(ball.reflect(*states))[:, ::-1]):
                first = int(np.argmax(each[0]))
                orbits.append((_starting_at(ball, each, first), False, seen))
    return orbits


def _periodic_points(
    ball: Ball, energy: float, period: int, cells: int, halvings: int
) -> np.ndarray:
    """Return the points (2, n) of the upper half disk to which cells lead.

    The mirror image of an orbit is one too, so that one half is enough. Cells are those of latitude
    and longitude on the half sphere over the disk, since its height is the contact speed s, in
    which the map is smooth up to the rim.
    """
    quarter = 0.5 * np.pi
    step, turn = quarter / cells, quarter / cells  # a cell beyond each end of the symmetry line
    latitudes = step * np.arange(cells + 1)
    longitudes = turn * (np.arange(2 * cells + 2) - 0.5)
    corners = np.stack(np.meshgrid(latitudes, longitudes, indexing="ij"))
    at, coarse = _cells_with_a_root(corners, _gaps(ball, energy, period, corners))
    starts = [at + 0.5 * step]
    for halving in range(1, halvings + 1):
        corners = at[:, coarse, None, None][:, :MOST_CELLS]
        step = 0.5 * step
        corners = corners + step * np.indices((3, 3))[:, None]
        at, coarse = _cells_with_a_root(corners, _gaps(ball, energy, period, corners))
        starts.append((at if halving == halvings else at[:, ~coarse]) + 0.5 * step)
    x, y = _on_disk(np.concatenate(starts, axis=1))
    centre, (radius, height) = _disk(ball, energy)
    points = np.column_stack((centre + radius * x, height * y))

    def close_piece(piece: np.ndarray) -> int:
        close(piece, ball.k, ball.g, energy, period, radius)
        return 0

    in_threads(close_piece, period, points)
    x, y = points[~np.isnan(points[:, 0])].T
    return np.stack(((x - centre) / radius, y / height))


def _cells_with_a_root(corners: np.ndarray, gaps: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the first corners (2, n) of cells that may have a root, and which cells are coarse.

    `corners` and the `gaps` at them are (2, ..., i, j).
    """
    four = np.stack(
        [gaps[..., i : i - 1 or None, j : j - 1 or None] for i in (0, 1) for j in (0, 1)]
    )
    low, high = four.min(axis=0), four.max(axis=0)
    size = high - low
    margin = MARGIN * size
    held = np.all((low <= margin) & (high >= -margin), axis=0)
    return corners[..., :-1, :-1][:, held], size.max(axis=0)[held] > COARSE


def _gaps(ball: Ball, energy: float, period: int, corners: np.ndarray) -> np.ndarray:
    """Return how far images ahead and back in time are apart (2, ...), in the disk, of corners."""
    shape, (k, g) = corners.shape, (ball.k, ball.g)
    centre, (radius, height) = _disk(ball, energy)
    a, b = _on_disk(corners.reshape(2, -1))
    x, y = centre + radius * a, height * b
    ahead = ball.after(formulas.chart_state(k, g, energy, x, y), (period + 1) // 2)
    back = ball.after(formulas.chart_state(k, g, energy, x, -y), period // 2)
    (x, y), (p, q) = chart(k, *ahead[:3]), chart(k, *back[:3])
    return np.stack(((x - p) / radius, (y + q) / height)).reshape(shape)


def _on_disk(corners: np.ndarray) -> np.ndarray:
    """Return the points (2, n) of the disk under latitudes from the centre, and longitudes."""
    latitude = np.minimum(corners[0], 0.5 * np.pi * (1.0 - RIM))
    out, _ = sincos_each(latitude)
    sine, cosine = sincos_each(corners[1])
    return np.stack((out * cosine, out * sine))


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


def _count(found: np.ndarray, points: np.ndarray) -> int:
    """Return how many of the points (2, n) of an orbit, or their mirror images, were found."""
    return sum(_not_on(found, point[:, None]).shape[1] < found.shape[1] for point in points.T)


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
