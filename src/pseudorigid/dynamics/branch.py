"""One branch of the manifolds of a hyperbolic orbit's point, as a function of one parameter.

An unstable branch of a point z of period n starts as the segment z + sigma e, sigma_0 <= sigma <=
lambda sigma_0, along the unstable direction e, and its images under P^n continue it: a branch has
one parameter u, whose whole part counts the images and whose rest walks along the segment. The
reversor makes the stable branches: they are unstable ones of the mirrored point, mirrored.

Where the multiplier is below WEAK, many images lie between the segment and the end of a branch.
Roundings halfway to the next saddle grow after it like what tells the branch from that saddle's
own, and points that come from the segment on their own go to and fro along the line. There each
image is mapped from the one before: a vertex from the one at u - 1, which changes no bit; a point
between vertices from the cubic through the four vertices around u - 1, unless a jump of the map
parts them. How far roundings have come shows where two images join: two orbits lead there. The
branch ends where these are apart by more than KNOWN times the image's extent. Of the paper's ball
at E = 0.001 and 0.0012 (multipliers 1.34 and 1.46), over 0.5 section radii at the default distance
and bend, vertices lie within 2e-6 section radii of a line drawn ten times as finely.
"""

import numpy as np

from ..kernel.arithmetic import log
from .variables import chart

# End of the first segment in section radii: it misses the branch by about its square.
START = 1e-6
FRESH = 16  # points of an image to begin with; where they are too few, more are inserted
MOST_IMAGES = 400  # of a multiplier of at least WEAK; else so many that they grow as much
WEAK = 1.5  # takes 35 images from START to the section's size; smaller multipliers take more
KNOWN = 0.1  # more would be seen


class Branch:
    """An unstable branch as a function of u >= 0, mirrored where a stable one is wanted.

    Its side is the sign of the direction's product with that from the orbit's middle. At one point
    of Figure 5's orbit, x = -0.08267, y = -0.04873, these are at 89.99 degrees: the product is
    0.084485 - 0.084441 = 4.4e-5, and its sign is not that of the outer branches carried
    there by the map, which takes the other five to one another. So inner and outer, and with them
    the two lengths, are swapped there and at the mirrored point's stable branches. A rule that
    carried one clear side along the orbit would not do that, but would change the figure's data.

    Parameters
    ----------
    ball : Ball
    energy : float
        In m omega^2 R^2.
    points : ndarray, shape (3, n)
        The states of the orbit.
    saddle : int
        The index of the point.
    side : {"outer", "inner"}
    stable : bool

    Attributes
    ----------
    radius, multiplier : float
        The section's radius, and by how much an image is longer than the one before.
    weak : bool
    images : int
        At most so many.
    ended : float or None
        The length, in section radii, where the branch is no longer known to rounding.

    Raises
    ------
    ValueError
        An elliptic orbit, or for a stable branch one that is not symmetric.
    """

    def __init__(self, ball, energy, points, saddle, side, stable):
        self.ball, self.energy, self.mirrored = ball, energy, stable
        self.radius = ball.section(energy)[1]
        places = chart(ball.k, *points)
        if stable:  # the branch of the mirrored point, mirrored
            mirrored = places[:, saddle] * np.array([1.0, -1.0])
            gaps = np.max(np.abs(places - mirrored[:, None]), axis=0)
            saddle = int(np.argmin(gaps))
            if gaps[saddle] > 1e-9 * self.radius:
                raise ValueError(
                    "the orbit is not symmetric: its stable manifold is no mirror image"
                )
        self.point, self.origin = points[:, saddle], places[:, saddle]
        self.period = points.shape[1]
        (a, b), (c, d) = ball.chart_jacobian(*self.point, impacts=self.period)
        trace = a + d
        if abs(trace) <= 2.0:
            raise ValueError("the orbit is elliptic: it has no stable and unstable manifolds")
        root = np.sqrt((abs(trace) - 2.0) * (abs(trace) + 2.0))
        multiplier = np.copysign(0.5 * (abs(trace) + root), trace)
        # the larger of the two rows of J - lambda gives the direction
        e = np.array([b, multiplier - a]) if abs(b) > abs(c) else np.array([multiplier - d, c])
        # outer: away from the middle of the orbit, in the disk's own proportions
        scale = np.array([1.0, 1.0 / np.sqrt(ball.k * (1.0 + ball.k))])
        outward = (self.origin - places.mean(axis=1)) * scale * (e * scale)
        e = e / np.sqrt(np.sum((e * scale) ** 2))
        sign = 1.0 if (np.sum(outward) > 0.0) == (side == "outer") else -1.0
        self.multiplier = float(multiplier)
        if self.multiplier < 0.0:  # the two sides change places: every second image
            self.period *= 2
            self.multiplier *= self.multiplier
        self.weak = self.multiplier < WEAK
        self.images = MOST_IMAGES
        if self.weak:
            self.images = int(MOST_IMAGES * log(WEAK) / log(self.multiplier))
        self.ended = None
        self.first = START * self.radius / self.multiplier * sign * e

    def next(self, fresh, u, states):
        """States (3, n) at the parameters `fresh` (n,), where `states` at `u` are known."""
        if not self.weak or u.size < 2 * FRESH:
            return self(fresh)
        found, good = self._forward(fresh - 1.0, u, states)
        if not good.all():
            found[:, ~good] = self(fresh[~good])
        return found

    def _forward(self, before, u, states):
        """The images of the states at the parameters `before`, and which of them can be trusted."""
        ball = self.ball
        at = np.minimum(np.searchsorted(u, before), u.size - 1)
        there = u[at] == before
        four = np.clip(at - 2, 0, u.size - 4) + np.arange(4)[:, None]
        known = self._mirror(states[:, four])
        columns = known[:, at - four[0], np.arange(at.size)]
        places = chart(ball.k, *known)
        first, second = (
            _interpolated(u[four[part]], places[:, part], before)
            for part in (slice(0, 3), slice(1, 4))
        )
        good = np.ones(at.size, bool)
        if self.energy > ball.g * ball.g * (1.0 + 0.5 * ball.k):  # the map may jump
            extent = np.max(np.ptp(places, axis=1), axis=0)
            good = np.all(np.abs(first - second) <= 0.5 * extent, axis=0)
        share = (before - u[four[0]]) / (u[four[3]] - u[four[0]])
        x, y = first + share * (second - first)
        between = good & ~there
        columns[:, between] = ball.state_xy(x[between], y[between], self.energy)
        return self._mirror(self._image(columns, 1)), good | there

    def __call__(self, u):
        """States (3, n) at the parameters u (n,), each from the first segment."""
        image = np.floor(u)
        sigma = 1.0 + (self.multiplier - 1.0) * (u - image)
        start = self.origin[:, None] + sigma * self.first[:, None]
        states = np.stack(self.ball.state_xy(*start, self.energy))
        for m in np.unique(image):
            there = image == m
            states[:, there] = self._image(states[:, there], int(m))
        return self._mirror(states)

    def _image(self, states, images):
        """The states so many images later."""
        ball, columns = self.ball, [np.array(a) for a in states]
        ball.map.steps(*columns, ball.k, ball.g, images * self.period, np.empty(columns[0].size))
        return np.stack(columns)

    def _mirror(self, states):
        return np.stack(self.ball.reflect(*states)) if self.mirrored else states

    def known(self, image, u, states):
        """Whether two orbits to where images `image - 1` and `image` join agree that far."""
        if image < 2:
            return True
        extent = np.max(np.ptp(states[:, u >= image - 1], axis=1))
        return self._gap(image) <= KNOWN * extent

    def _gap(self, image):
        """How far two orbits to where images `image - 1` and `image` join are apart."""
        ends = self(np.array([np.nextafter(float(image), 0.0), float(image)]))
        return np.max(np.abs(ends[:, 1] - ends[:, 0]))

    def base(self):
        """The point itself, (3, 1)."""
        return self._mirror(self.point[:, None])

    def start_error(self):
        """By how much the image of the segment's start misses its end, in section radii."""
        return float(self._gap(1) / self.radius)


def _interpolated(nodes, values, at):
    """The parabolas through values (2, 3, n) at nodes (3, n), at `at` (n,)."""
    a, b, c = nodes
    slope = (values[:, 1] - values[:, 0]) / (b - a)
    bend = ((values[:, 2] - values[:, 1]) / (c - b) - slope) / (c - a)
    return values[:, 0] + (at - a) * (slope + (at - b) * bend)
