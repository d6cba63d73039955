"""Chains of h-sets along an orbit that leads from one h-set to another, in doubles.

Where an orbit of `impacts` impacts leads from a source to a target, sets are laid around its points
one after the other. Their expanding sides are images of the source's, and their contracting sides
preimages of the target's. Backwards from the target, each set is made just so wide that its edges
land beyond the next one; forwards from the source, just so high that its image fits.
"""

from itertools import pairwise
from typing import NamedTuple

import numpy as np

from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.variables import chart

from ..enclosure.surface import Surface
from .periodic import nearest_ball

_EDGE = np.linspace(-1.0, 1.0, 9)
_ONE = np.ones(_EDGE.size)
_P = np.concatenate([_EDGE, _EDGE, -_ONE, _ONE])  # around a set; its exit edges come last
_Q = np.concatenate([-_ONE, _ONE, _EDGE, _EDGE])
_LOW, _HIGH = slice(-2 * _EDGE.size, -_EDGE.size), slice(-_EDGE.size, None)
_SWEEPS = 6  # until widths and heights fit each other
_STRIP_POINTS = 65  # along the strip in which the orbit is sought


class Parallelogram(NamedTuple):
    """Points centre + p u + q s, |p|, |q| <= 1, in doubles."""

    centre: np.ndarray
    u: np.ndarray
    s: np.ndarray

    def points(self, p: np.ndarray, q: np.ndarray) -> np.ndarray:
        """Return x and y of the points with these p and q."""
        return self.centre[:, None] + np.outer(self.u, p) + np.outer(self.s, q)

    def coordinates(self, points: np.ndarray) -> np.ndarray:
        """Return p and q of points."""
        return np.linalg.solve(self.sides(), points - self.centre[:, None])

    def sides(self) -> np.ndarray:
        """Return the sides as columns."""
        return np.stack([self.u, self.s], axis=1)


class Chain(NamedTuple):
    """A strip low <= p <= high of the source, and the sets between it and the target."""

    low: float
    high: float
    sets: list[Parallelogram]


class DoubleMap:
    """The impact map on a surface in doubles, in the chart (x, y)."""

    def __init__(self, surface: Surface) -> None:
        self.ball: Ball = nearest_ball(surface)
        self.energy = float(surface.energy)

    def step(self, points: np.ndarray, impacts: int = 1) -> np.ndarray:
        """Return the images of points (2, n); raises ValueError for one outside the section."""
        k, g = self.ball.k, self.ball.g
        for _ in range(impacts):
            x, y = points
            square = ((1.0 + k) * (2.0 * self.energy + x * (2.0 * g - k * x)) - y * y) / k
            if not np.all(square > 0.0):
                raise ValueError("a point is outside the section")
            s = np.sqrt(square)
            state = x, (y + k * s) / (1.0 + k), (s - y) / (1.0 + k)
            points = chart(k, *self.ball.after(state)[:3])
        return points

    def jacobian(self, point: np.ndarray) -> np.ndarray:
        """Return DP at one point."""
        x, y = point
        state = self.ball.state_xy(x, y, self.energy)
        return np.array(self.ball.chart_jacobian(*state), dtype=float)


def chain(
    double_map: DoubleMap,
    source: Parallelogram,
    target: Parallelogram,
    impacts: int,
    strip: tuple[float, float],
    margin: float,
) -> Chain | None:
    """Return a chain from a part of a strip of the source to the target; None if none fits.

    `margin` is how far a set's edges land beyond the next one, and the room left in it, in units of
    its half widths.
    """
    try:
        start, sign = _start(double_map, source, target, impacts, strip)
        frames = _frames(double_map, source, target._replace(u=sign * target.u), impacts, start)
        slopes = [_slopes(double_map, *pair) for pair in pairwise(frames)]
        stretch, squeeze = zip(*slopes, strict=True)
        wide, high = np.zeros((2, impacts + 1, 2))
        wide[-1] = high[0] = high[-1] = -1.0, 1.0
        for t in reversed(range(impacts)):
            wide[t] = wide[t + 1] * (1.0 + margin) / stretch[t]
        for t in range(impacts - 1):
            high[t + 1] = high[t] * squeeze[t]
        for _ in range(_SWEEPS):
            for t in reversed(range(impacts)):
                p, _ = _image(double_map, frames, wide, high, t)
                beyond = margin * np.ptp(wide[t + 1]) / 2.0
                wide[t, 0] -= (p[_LOW].max() - (wide[t + 1, 0] - beyond)) / stretch[t]
                wide[t, 1] -= (p[_HIGH].min() - (wide[t + 1, 1] + beyond)) / stretch[t]
            for t in range(impacts):
                _, q = _image(double_map, frames, wide, high, t)
                room = margin * np.ptp(q) / 2.0
                if t < impacts - 1:
                    high[t + 1] = q.min() - room, q.max() + room
    except (ValueError, np.linalg.LinAlgError):
        return None
    low, up = start + wide[0]
    fits = np.abs(q).max() < 1.0 - margin / 2.0 and np.all(wide[:, 0] < wide[:, 1])
    if not (fits and -1.0 < low < up < 1.0):
        return None
    return Chain(low, up, [_part(frames[t], wide[t], high[t]) for t in range(1, impacts)])


def _start(
    double_map: DoubleMap,
    source: Parallelogram,
    target: Parallelogram,
    impacts: int,
    strip: tuple[float, float],
) -> tuple[float, float]:
    """Return the p of an orbit to the target's middle, and the sign of the slope of its end's p.

    Raises ValueError if the strip does not reach the target.
    """
    p = np.linspace(*strip, _STRIP_POINTS)
    ends, _ = target.coordinates(double_map.step(source.points(p, 0.0 * p), impacts))
    crossings = np.flatnonzero(ends[:-1] * ends[1:] <= 0.0)
    if not crossings.size:
        raise ValueError("the strip does not reach the target")
    i = crossings[0]
    rise = ends[i + 1] - ends[i]
    return p[i] - ends[i] * (p[i + 1] - p[i]) / rise, np.sign(rise)


def _frames(
    double_map: DoubleMap, source: Parallelogram, target: Parallelogram, impacts: int, start: float
) -> list[Parallelogram]:
    """Return frames along an orbit: images of the source's side u, preimages of the target's s."""
    points = [source.points(np.array([start]), np.zeros(1))]
    for _ in range(impacts):
        points.append(double_map.step(points[-1]))
    centres = [point[:, 0] for point in points[:-1]]
    matrices = [double_map.jacobian(centre) for centre in centres]
    expanding, contracting = [source.u], [target.s]
    for matrix in matrices[:-1]:
        expanding.append(_unit(matrix @ expanding[-1]))
    for matrix in reversed(matrices[1:]):
        contracting.append(_unit(np.linalg.solve(matrix, contracting[-1])))
    sides = zip(centres, expanding, [source.s, *reversed(contracting[1:])], strict=True)
    return [*(Parallelogram(*it) for it in sides), target]


def _slopes(
    double_map: DoubleMap, frame: Parallelogram, following: Parallelogram
) -> tuple[float, float]:
    """Return by how much the map stretches one frame's side u and shrinks its s, in the next."""
    slopes = np.linalg.solve(following.sides(), double_map.jacobian(frame.centre) @ frame.sides())
    return slopes[0, 0], abs(slopes[1, 1])


def _image(
    double_map: DoubleMap, frames: list[Parallelogram], wide: np.ndarray, high: np.ndarray, t: int
) -> np.ndarray:
    """Return p and q, in the frame after frame t, of the image of the boundary of its set."""
    boundary = _part(frames[t], wide[t], high[t]).points(_P, _Q)
    return frames[t + 1].coordinates(double_map.step(boundary))


def _part(frame: Parallelogram, wide: np.ndarray, high: np.ndarray) -> Parallelogram:
    """Return the part of a frame's plane with p and q between these."""
    centre = frame.centre + wide.mean() * frame.u + high.mean() * frame.s
    return Parallelogram(centre, np.ptp(wide) / 2.0 * frame.u, np.ptp(high) / 2.0 * frame.s)


def _unit(vector: np.ndarray) -> np.ndarray:
    """Return a vector divided by its length."""
    return vector / np.linalg.norm(vector)
