"""One branch of the manifolds at a point of a hyperbolic orbit, as a function of one parameter.

An unstable branch of a point z of period n starts as the segment z + sigma e, sigma_0 <= sigma <=
lambda sigma_0, along the unstable direction e with the multiplier lambda, and its images under P^n
continue it. The whole part of the parameter u counts the images, and the fractional part runs along
the segment. By the reversor, a stable branch is the mirror image of the unstable branch of the
mirrored point. `tracing` makes a polyline of a branch; its points are called vertices here.

If the multiplier is below WEAK, many images lie between the segment and the end of a branch.
Rounding errors made halfway to the next saddle then grow, beyond that saddle, as fast as the
distance from its own branch, and points mapped from the segment scatter along the line. Each image
is therefore mapped from the previous one. If there is a vertex at u - 1, its image has the bits of
the point mapped from the segment. Otherwise the point at u is the image of a point on the cubic
through the four vertices around u - 1, unless a jump of the map separates them. The point where two
images join is the end of one orbit from the segment's start and of one from its end. The distance
of the two measures the rounding errors, and the branch ends where it exceeds LARGEST_SPLIT times
the image's extent. For the paper's ball at E = 0.001 and 0.0012 (multipliers 1.34 and 1.46), over
0.5 section radii at the default distance and bend, vertices lie within 2e-6 section radii of a line
drawn ten times as finely.
"""

import math

import numpy as np

from ..kernel.arithmetic import log
from .ball import Ball, Rows
from .variables import chart

# Length of the first segment, in section radii; its distance from the branch is about the square.
SEGMENT = 1e-6
POINTS_OF_IMAGE = 16  # initial number; tracing inserts more
MOST_IMAGES = 400  # at a multiplier of WEAK or more; below, as many as give the same growth
WEAK = 1.5  # multiplier at which a branch takes 35 images from SEGMENT to the section's size
LARGEST_SPLIT = 0.1  # a larger one would be visible


class Branch:
    """Unstable branch as a function of u >= 0, or its mirror image, a stable branch.

    `points` (3, n) are the orbit's states, and `saddle` is the index of the one that the branch
    leaves. The `side` is "outer" if the branch leaves away from the mean of the points, and "inner"
    otherwise. At one point of Figure 5's orbit the angle between these directions is 89.99 degrees;
    a rule that found the side at one point and mapped it along the orbit would swap inner and outer
    there and change the figure's data (docs/method.md).

    `multiplier` is the ratio of the lengths of successive images, which are mapped from one another
    if it is `weak`. `images` is the largest number of images. `ended` is the length, in section
    radii, at which rounding errors end the branch, or None; `tracing` sets it. Raises ValueError if
    the orbit is elliptic, or if the branch is stable and the orbit not symmetric.
    """

    def __init__(
        self, ball: Ball, energy: float, points: np.ndarray, saddle: int, side: str, stable: bool
    ) -> None:
        self.ball, self.energy, self.mirrored = ball, energy, stable
        self.radius = ball.section(energy)[1]
        xy = chart(ball.k, *points)
        if stable:
            saddle = _mirror_image(xy, saddle, 1e-9 * self.radius)
        self.point, self.origin = points[:, saddle], xy[:, saddle]
        self.period = points.shape[1]
        x, xdot, udot = self.point
        multiplier, e = _unstable(ball.chart_jacobian(x, xdot, udot, self.period))
        # Outer is away from the orbit's mean point, in coordinates in which the section is round.
        scale = np.array([1.0, 1.0 / np.sqrt(ball.k * (1.0 + ball.k))])
        outward = (self.origin - xy.mean(axis=1)) * scale * (e * scale)
        e = e / np.sqrt(np.sum((e * scale) ** 2))
        sign = 1.0 if (np.sum(outward) > 0.0) == (side == "outer") else -1.0
        self.multiplier = multiplier
        if self.multiplier < 0.0:  # images alternate between the sides, so take every second one
            self.period *= 2
            self.multiplier *= self.multiplier
        self.weak = self.multiplier < WEAK
        self.images = MOST_IMAGES
        if self.weak:
            self.images = int(MOST_IMAGES * log(WEAK) / log(self.multiplier))
        self.ended: float | None = None
        self.first = SEGMENT * self.radius / self.multiplier * sign * e

    def next(self, new_u: np.ndarray, u: np.ndarray, states: np.ndarray) -> np.ndarray:
        """Return states (3, m) at the parameters `new_u` (m,), given the `states` (3, n) at `u`."""
        if not self.weak or u.size < 2 * POINTS_OF_IMAGE:
            return self(new_u)
        new_states, accurate = self._forward(new_u - 1.0, u, states)
        if not accurate.all():
            new_states[:, ~accurate] = self(new_u[~accurate])
        return new_states

    def _forward(
        self, before: np.ndarray, u: np.ndarray, states: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """Return the images of the states at parameters `before`, and which of them are accurate.

        States that are not among the `states` at `u` are interpolated.
        """
        ball = self.ball
        at = np.minimum(np.searchsorted(u, before), u.size - 1)
        is_vertex = u[at] == before
        four = np.clip(at - 2, 0, u.size - 4) + np.arange(4)[:, None]
        nearby = self._mirror(states[:, four])
        columns = nearby[:, at - four[0], np.arange(at.size)]
        xy = chart(ball.k, *nearby)
        first = _interpolated(u[four[:3]], xy[:, :3], before)
        second = _interpolated(u[four[1:]], xy[:, 1:], before)
        accurate = np.ones(at.size, bool)
        if self.energy > ball.g * ball.g * (1.0 + 0.5 * ball.k):  # the map may jump
            extent = np.max(np.ptp(xy, axis=1), axis=0)
            accurate = np.all(np.abs(first - second) <= 0.5 * extent, axis=0)
        # the cubic through four nodes, as a mean of the two parabolas through three of them
        share = (before - u[four[0]]) / (u[four[3]] - u[four[0]])
        x, y = first + share * (second - first)
        between = accurate & ~is_vertex
        columns[:, between] = ball.state_xy(x[between], y[between], self.energy)
        return self._mirror(self._image(columns, 1)), accurate | is_vertex

    def __call__(self, u: np.ndarray) -> np.ndarray:
        """Return states (3, n) at the parameters u (n,), each mapped from the first segment."""
        image = np.floor(u)
        sigma = 1.0 + (self.multiplier - 1.0) * (u - image)
        start = self.origin[:, None] + sigma * self.first[:, None]
        states = np.stack(self.ball.state_xy(start[0], start[1], self.energy))
        for m in np.unique(image):
            selected = image == m
            states[:, selected] = self._image(states[:, selected], int(m))
        return self._mirror(states)

    def _image(self, states: np.ndarray, images: int) -> np.ndarray:
        """Return the images of states under the power `images` of P^period."""
        return self.ball.after(states, images * self.period)[:3]

    def _mirror(self, states: np.ndarray) -> np.ndarray:
        """Return the states, or their mirror images if the branch is stable."""
        return np.stack(self.ball.reflect(*states)) if self.mirrored else states

    def is_accurate(self, image: int, u: np.ndarray, states: np.ndarray) -> bool:
        """Return whether the two orbits to where images `image - 1` and `image` join agree."""
        if image < 2:
            return True
        extent = np.max(np.ptp(states[:, u >= image - 1], axis=1))
        return bool(self._gap(image) <= LARGEST_SPLIT * extent)

    def _gap(self, image: int) -> float:
        """Return the distance of the two orbits' ends where images `image - 1` and `image` join."""
        ends = self(np.array([np.nextafter(float(image), 0.0), float(image)]))
        return float(np.max(np.abs(ends[:, 1] - ends[:, 0])))

    def base(self) -> np.ndarray:
        """Return the point of the orbit that the branch leaves, as an array (3, 1)."""
        return self._mirror(self.point[:, None])

    def start_error(self) -> float:
        """Return the distance, in section radii, of the segment's end from its start's image."""
        return self._gap(1) / self.radius


def _mirror_image(xy: np.ndarray, saddle: int, tolerance: float) -> int:
    """Return the index of the mirror image of the point `saddle` of an orbit (2, n)."""
    mirrored = xy[:, saddle] * np.array([1.0, -1.0])
    gaps = np.max(np.abs(xy - mirrored[:, None]), axis=0)
    image = int(np.argmin(gaps))
    if gaps[image] > tolerance:
        raise ValueError("the orbit is not symmetric: its stable manifold is no mirror image")
    return image


def _unstable(jacobian: Rows) -> tuple[float, np.ndarray]:
    """Return the unstable multiplier and eigenvector of an orbit's Jacobian."""
    (a, b), (c, d) = jacobian
    trace = a + d
    if abs(trace) <= 2.0:
        raise ValueError("the orbit is elliptic: it has no stable and unstable manifolds")
    root = math.sqrt((abs(trace) - 2.0) * (abs(trace) + 2.0))
    multiplier = math.copysign(0.5 * (abs(trace) + root), trace)
    # The larger row of J - multiplier gives the direction.
    e = [b, multiplier - a] if abs(b) > abs(c) else [multiplier - d, c]
    return multiplier, np.array(e)


def _interpolated(nodes: np.ndarray, values: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Evaluate at `at` (n,) the parabolas through the values (2, 3, n) at nodes (3, n)."""
    a, b, c = nodes
    slope = (values[:, 1] - values[:, 0]) / (b - a)
    bend = ((values[:, 2] - values[:, 1]) / (c - b) - slope) / (c - a)
    return values[:, 0] + (at - a) * (slope + (at - b) * bend)
