"""One branch of the manifolds at a point of a hyperbolic orbit, as a polyline.

An unstable branch of a point z of period n starts as the segment z + sigma e, sigma_0 <= sigma <=
lambda sigma_0, along the unstable direction e with the multiplier lambda, and its images under P^n
continue it. The whole part of the parameter u counts the images, and the fractional part runs along
the segment. By the reversor, a stable branch is the mirror image of the unstable branch of the
mirrored point. Where two vertices of the polyline are too far apart or it bends too much, a vertex
is inserted at the mean of their parameters.

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

from ..kernel.arithmetic import log, sincos
from .ball import Ball, Rows
from .variables import chart

Window = tuple[float, float, float, float]  # x_low, x_high, xdot_low, xdot_high

# Length of the first segment, in section radii; its distance from the branch is about the square.
SEGMENT = 1e-6
POINTS_OF_IMAGE = 16  # initial number; refinement inserts more
MOST_IMAGES = 400  # at a multiplier of WEAK or more; below, as many as give the same growth
WEAK = 1.5  # multiplier at which a branch takes 35 images from SEGMENT to the section's size
LARGEST_SPLIT = 0.1  # a larger one would be visible
# Length of a side, as a share of the largest one, below which its bend is ignored. Without this
# limit a corner of the line would be refined for ever.
FINEST = 1e-3
# Largest side outside a window, in section radii, as for the paper's whole branches.
COARSE = 0.01
MOST_VERTICES = 3_000_000


class Branch:
    """Unstable branch, or its mirror image, a stable branch.

    `points` (3, n) are the orbit's states, and `saddle` is the index of the one that the branch
    leaves. The `side` is "outer" if the branch leaves away from the mean of the points, and "inner"
    otherwise. At one point of Figure 5's orbit the angle between these directions is 89.99 degrees;
    a rule that found the side at one point and mapped it along the orbit would swap inner and outer
    there and change the figure's data (docs/method.md).

    `multiplier` is the ratio of the lengths of successive images, which are mapped from one another
    if it is `weak`. `images` is the largest number of images. `u` and `states` (3, n) are the
    parameters and states of the vertices, in order. `ended` is the length, in section radii, at
    which rounding errors end the branch, or None. Raises ValueError if the orbit is elliptic, or if
    the branch is stable and the orbit not symmetric.
    """

    def __init__(
        self, ball: Ball, energy: float, points: np.ndarray, saddle: int, side: str, stable: bool
    ) -> None:
        self.ball, self.energy, self.mirrored = ball, energy, stable
        self.radius = ball.section(energy)[1]
        xy = chart(ball.k, *points)
        if stable:
            saddle = _mirror_image(xy, saddle, 1e-9 * self.radius)
        self.saddle, self.saddle_xy = points[:, saddle], xy[:, saddle]
        self.period = points.shape[1]
        x, xdot, udot = self.saddle
        self.multiplier, e = _unstable(ball.chart_jacobian(x, xdot, udot, self.period))
        # Outer is away from the orbit's mean point, in coordinates in which the section is round.
        scale = np.array([1.0, 1.0 / np.sqrt(ball.k * (1.0 + ball.k))])
        outward = (self.saddle_xy - xy.mean(axis=1)) * scale * (e * scale)
        e = e / np.sqrt(np.sum((e * scale) ** 2))
        sign = 1.0 if (np.sum(outward) > 0.0) == (side == "outer") else -1.0
        if self.multiplier < 0.0:  # images alternate between the sides, so take every second one
            self.period *= 2
            self.multiplier *= self.multiplier
        self.weak = self.multiplier < WEAK
        self.images = MOST_IMAGES
        if self.weak:
            self.images = int(MOST_IMAGES * log(WEAK) / log(self.multiplier))
        self.segment_start = SEGMENT * self.radius / self.multiplier * sign * e  # from the saddle
        self.ended: float | None = None
        self.u, self.states = np.empty(0), np.empty((3, 0))

    def trace(
        self, length: float, distance: float, bend: float, window: Window | None
    ) -> np.ndarray:
        """Return the polyline (3, n), computed image by image until it is long enough.

        The arguments are those of `manifolds.trace_manifold`. Raises ValueError for too many
        vertices or images.
        """
        least_cosine = sincos(bend * (math.pi / 180.0))[1]
        travelled = np.zeros(1)
        for image in range(self.images):
            if self.weak and not self._joins_previous(image):
                self.ended = float(travelled[-1])
                break
            new_u = image + np.arange(POINTS_OF_IMAGE) / POINTS_OF_IMAGE
            self._insert(np.full(POINTS_OF_IMAGE, self.u.size), new_u)
            while (coarse := self._too_coarse(distance, least_cosine, window)).any():
                middle = 0.5 * (self.u[:-1] + self.u[1:])
                self._insert(np.flatnonzero(coarse) + 1, middle[coarse])
                if self.u.size > MOST_VERTICES:
                    raise ValueError(
                        f"a manifold of more than {MOST_VERTICES} points: make length shorter"
                    )
            sides = _lengths_of_sides(self.states) / self.radius
            jumps = _is_jump(self.u) & (sides > 1e-6)
            travelled = np.cumsum(np.where(jumps, 0.0, sides))
            if travelled[-1] >= length:
                break
        else:
            raise ValueError(
                f"a manifold is {travelled[-1]:.3g} section radii long after {self.images} images, "
                f"with a multiplier of {self.multiplier:.6g}: make length shorter"
            )
        last = int(np.searchsorted(travelled, length)) + 1
        saddle = self._mirror(self.saddle[:, None])
        vertices = np.concatenate([saddle, self.states[:, : last + 1]], axis=1)
        kept = np.append(True, ~jumps[:last])
        if window is not None:
            kept &= _meets(vertices, window, 0.0)
        return _pieces(vertices, kept)

    def start_error(self) -> float:
        """Return the distance, in section radii, of the segment's end from its start's image."""
        return self._split(1) / self.radius

    def _insert(self, indices: np.ndarray, new_u: np.ndarray) -> None:
        """Insert vertices at the parameters `new_u` before these indices."""
        new_states = self._states_at(new_u)
        self.u = np.insert(self.u, indices, new_u)
        self.states = np.insert(self.states, indices, new_states, axis=1)

    def _states_at(self, u: np.ndarray) -> np.ndarray:
        """Return states (3, n) at the parameters u (n,), mapped from vertices on a weak branch."""
        if not self.weak or self.u.size < 2 * POINTS_OF_IMAGE:
            return self._from_segment(u)
        states, accurate = self._from_previous_image(u - 1.0)
        if not accurate.all():
            states[:, ~accurate] = self._from_segment(u[~accurate])
        return states

    def _from_segment(self, u: np.ndarray) -> np.ndarray:
        """Return states (3, n) at the parameters u (n,), each mapped from the first segment."""
        image = np.floor(u)
        sigma = 1.0 + (self.multiplier - 1.0) * (u - image)
        x, y = self.saddle_xy[:, None] + sigma * self.segment_start[:, None]
        states = np.stack(self.ball.state_xy(x, y, self.energy))
        for m in np.unique(image):
            selected = image == m
            states[:, selected] = self._mapped(states[:, selected], int(m))
        return self._mirror(states)

    def _from_previous_image(self, u: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the images of the states at parameters u, and which of them are accurate.

        States between vertices are interpolated from a stencil of four vertices.
        """
        ball = self.ball
        after = np.minimum(np.searchsorted(self.u, u), self.u.size - 1)
        is_vertex = self.u[after] == u
        stencil = np.clip(after - 2, 0, self.u.size - 4) + np.arange(4)[:, None]
        nodes, vertices = self.u[stencil], self._mirror(self.states[:, stencil])
        states = vertices[:, after - stencil[0], np.arange(u.size)]
        xy = chart(ball.k, *vertices)
        left = _parabola(nodes[:3], xy[:, :3], u)
        right = _parabola(nodes[1:], xy[:, 1:], u)
        accurate = np.ones(u.size, bool)
        if self.energy > ball.g * ball.g * (1.0 + 0.5 * ball.k):  # the map may jump
            extent = np.max(np.ptp(xy, axis=1), axis=0)
            accurate = np.all(np.abs(left - right) <= 0.5 * extent, axis=0)
        # the cubic through four nodes, as a mean of the two parabolas through three of them
        share = (u - nodes[0]) / (nodes[3] - nodes[0])
        x, y = left + share * (right - left)
        between = accurate & ~is_vertex
        states[:, between] = ball.state_xy(x[between], y[between], self.energy)
        return self._mirror(self._mapped(states, 1)), accurate | is_vertex

    def _mapped(self, states: np.ndarray, images: int) -> np.ndarray:
        """Return the images of states under the power `images` of P^period."""
        return self.ball.after(states, images * self.period)[:3]

    def _mirror(self, states: np.ndarray) -> np.ndarray:
        """Return the states, or their mirror images if the branch is stable."""
        return np.stack(self.ball.reflect(*states)) if self.mirrored else states

    def _joins_previous(self, image: int) -> bool:
        """Return whether rounding errors leave images `image - 1` and `image` joined."""
        if image < 2:
            return True
        extent = np.max(np.ptp(self.states[:, self.u >= image - 1], axis=1))
        return bool(self._split(image) <= LARGEST_SPLIT * extent)

    def _split(self, image: int) -> float:
        """Return the distance of the two orbits' ends where images `image - 1` and `image` join."""
        ends = self._from_segment(np.array([np.nextafter(float(image), 0.0), float(image)]))
        return float(np.max(np.abs(ends[:, 1] - ends[:, 0])))

    def _too_coarse(
        self, distance: float, least_cosine: float, window: Window | None
    ) -> np.ndarray:
        """Return which sides of the polyline need a vertex in their middle."""
        if window is None:
            scaled = self.states / self.radius
            inside, coarse = np.ones(self.u.size - 1, bool), np.zeros(self.u.size - 1, bool)
        else:
            sizes = np.array([window[1] - window[0], window[3] - window[2]])
            scaled = self.states[:2] / sizes[:, None]
            inside = _meets(self.states, window, 1.0)
            coarse = _lengths_of_sides(self.states) > COARSE * self.radius
        steps, sides = np.diff(scaled, axis=1), _lengths_of_sides(scaled)
        products = np.sum(steps[:, 1:] * steps[:, :-1], axis=0)
        bends = products < least_cosine * sides[1:] * sides[:-1]
        bends &= np.maximum(sides[1:], sides[:-1]) > FINEST * distance
        # Halve the longer of the two sides of a bend, or both if their lengths are similar.
        halved = sides > distance
        halved[:-1] |= bends & (sides[:-1] >= 0.5 * sides[1:])
        halved[1:] |= bends & (sides[1:] >= 0.5 * sides[:-1])
        return ((halved & inside) | coarse) & ~_is_jump(self.u)


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


def _parabola(nodes: np.ndarray, values: np.ndarray, u: np.ndarray) -> np.ndarray:
    """Evaluate at u (n,) the parabolas through the values (2, 3, n) at nodes (3, n)."""
    a, b, c = nodes
    slope = (values[:, 1] - values[:, 0]) / (b - a)
    curvature = ((values[:, 2] - values[:, 1]) / (c - b) - slope) / (c - a)
    return values[:, 0] + (u - a) * (slope + (u - b) * curvature)


def _lengths_of_sides(vertices: np.ndarray) -> np.ndarray:
    """Return the lengths of the sides of a polyline."""
    steps = np.diff(vertices, axis=1)
    return np.sqrt(np.sum(steps * steps, axis=0))


def _is_jump(u: np.ndarray) -> np.ndarray:
    """Return where u cannot be halved further, so that a remaining gap is a jump of the map."""
    middle = 0.5 * (u[:-1] + u[1:])
    return (u[1:] - u[:-1] < 2.0**-40) | (middle == u[:-1]) | (middle == u[1:])


def _meets(vertices: np.ndarray, window: Window, margin: float) -> np.ndarray:
    """Return whether a side's box, widened by `margin` times its longer edge, meets the window."""
    low = np.minimum(vertices[:2, 1:], vertices[:2, :-1])
    high = np.maximum(vertices[:2, 1:], vertices[:2, :-1])
    widen = margin * np.max(high - low, axis=0)
    least, most = np.reshape(window, (2, 2, 1)).swapaxes(0, 1)
    return np.all((low - widen <= most) & (high + widen >= least), axis=0)


def _pieces(vertices: np.ndarray, kept: np.ndarray) -> np.ndarray:
    """Return the vertices of the sides that are kept, with a row of NaN between separate pieces."""
    ends = np.concatenate([[False], kept]) | np.concatenate([kept, [False]])
    gap = ends[:-1] & ends[1:] & ~kept  # a single dropped side separates two pieces
    (rows,) = np.nonzero(ends)
    breaks = np.nonzero((np.diff(rows) > 1) | gap[rows[:-1]])[0] + 1
    return np.insert(vertices[:, rows], breaks, np.nan, axis=1)
