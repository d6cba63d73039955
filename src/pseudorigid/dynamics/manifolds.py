"""Stable and unstable manifolds of a hyperbolic periodic orbit, as ordered polylines.

An unstable branch of a point z of period n starts as the segment z + sigma e, sigma_0 <= sigma <=
lambda sigma_0, along the unstable direction e, and its images under P^n continue it: a branch has
one parameter u, whose whole part counts the images and whose rest walks along the segment. Where
two neighbours are too far apart or the line bends too much, a point is inserted at the middle of u
and mapped from the segment. The reversor makes the stable branches: they are unstable ones of the
mirrored point, mirrored.

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
import xarray as xr

from ..kernel.arithmetic import log, sincos
from .variables import of_type, variables

# End of the first segment in section radii: it misses the branch by about its square.
START = 1e-6
# A bend counts while a neighbouring side is longer than this share of the distance allowed: else a
# corner of the line would be refined without end.
FINEST = 1e-3
# Outside a window the line is followed with sides of this length, in section radii: that of the
# paper's whole branches.
COARSE = 0.01
FRESH = 16  # points of an image to begin with; where they are too few, more are inserted
MOST_IMAGES = 400  # of a multiplier of at least WEAK; else so many that they grow as much
WEAK = 1.5  # takes 35 images from START to the section's size; smaller multipliers take more
KNOWN = 0.1  # more would be seen
MOST_VERTICES = 3_000_000
MOST_IN_ALL = 10_000_000  # of a scene
DEGREE = float.fromhex("0x1.1df46a2529d39p-6")  # pi/180


def trace_manifold(
    ball,
    energy,
    orbit,
    saddle=0,
    *,
    stable=False,
    side="outer",
    length=1.0,
    distance=0.01,
    bend=10.0,
    window=None,
):
    """One branch of the manifolds of a hyperbolic orbit's point, from the point outwards.

    Parameters
    ----------
    ball : Ball
    energy : float
        The energy of the orbit (m omega^2 R^2).
    orbit : xarray.Dataset
        One orbit, x, xdot, udot on `point`, as from `variables.of_type`. An inverse hyperbolic one
        is traced under P^2n.
    saddle : int
        Index of the point.
    stable : bool
        The stable branch instead of the unstable one.
    side : {"outer", "inner"}
        "outer" leaves the point away from the middle of the orbit.
    length : float
        Arc length in (x, xdot, udot), in section radii.
    distance : float
        Largest side of the polyline, in section radii, or within a window in units of its size.
    bend : float
        Largest bend from side to side, in degrees, where a side is longer than FINEST * distance.
    window : (x_low, x_high, xdot_low, xdot_high), optional
        In R and R omega: only what passes through it is kept.

    Returns
    -------
    xarray.Dataset
        x, xdot, udot on `vertex`, in order, starting at the point; a row of NaN where the line is
        interrupted, by the window's edge or by a jump of the map. Attribute start_error: by how
        much, in section radii, the image of the first segment misses it; ended: the length, in
        section radii, where a branch is no longer known to rounding, if that is before `length`.

    Raises
    ------
    ValueError
        An orbit that is not hyperbolic or not of this energy, an argument out of range, or a branch
        of more than MOST_VERTICES points or MOST_IMAGES images.

    Examples
    --------
    >>> from pseudorigid import Ball, symmetric_orbits
    >>> ball = Ball(k=0.2, g=0.04)
    >>> six = of_type(symmetric_orbits(ball, 0.01, 6), "hyperbolic")
    >>> branch = trace_manifold(ball, 0.01, six, length=0.1, distance=0.05, bend=30)
    >>> sorted(branch.data_vars)
    ['udot', 'x', 'xdot']
    """
    points = np.stack(
        [np.asarray(orbit[name].values, dtype=float) for name in ("x", "xdot", "udot")]
    )
    _check(ball, energy, points, saddle, side, length, distance, bend, window)
    chart = np.stack([points[0], points[1] - ball.k * points[2]])
    if stable:  # the branch of the mirrored point, mirrored
        mirrored = chart[:, saddle] * np.array([1.0, -1.0])
        gaps = np.max(np.abs(chart - mirrored[:, None]), axis=0)
        saddle = int(np.argmin(gaps))
        if gaps[saddle] > 1e-9 * ball.section(energy)[1]:
            raise ValueError("the orbit is not symmetric: its stable manifold is no mirror image")
    branch = _Branch(ball, energy, points, chart, saddle, side, stable)
    vertices = _trace(branch, length, distance, bend, window)
    names = {
        "x": "position at impact, downwards",
        "xdot": "velocity of the mass centre just before impact",
        "udot": "strain rate just before impact",
    }
    attributes = {"start_error": branch.start_error()}
    if branch.ended is not None:
        attributes["ended"] = branch.ended
    return xr.Dataset(variables("vertex", vertices, names), attrs=attributes)


def _check(ball, energy, points, saddle, side, length, distance, bend, window):
    def refuse(name, value, allowed):
        raise ValueError(f"{name} = {value!r} is not allowed: {allowed}")

    if points.ndim != 2:
        raise ValueError("one orbit is needed: choose it with .isel(orbit=...)")
    if np.any(np.abs(ball.energy(*points) - energy) > 1e-9 * ball.k * ball.section(energy)[1] ** 2):
        refuse("energy", energy, f"the orbit's own, {float(ball.energy(*points[:, 0])):.6g}")
    if saddle not in range(points.shape[1]):
        refuse("saddle", saddle, f"an index from 0 to {points.shape[1] - 1}")
    if side not in ("inner", "outer"):
        refuse("side", side, "'inner' or 'outer'")
    for name, value in (("length", length), ("distance", distance)):
        if not 0.0 < value < np.inf:
            refuse(name, value, "above 0")
    if not 0.0 < bend < 180.0:
        refuse("bend", bend, "between 0 and 180 degrees")
    if window is not None and not (
        len(window) == 4 and window[0] < window[1] and window[2] < window[3]
    ):
        refuse("window", window, "(x_low, x_high, xdot_low, xdot_high)")


def scene_manifolds(
    ball,
    energy,
    periodic,
    period,
    type,
    resolution,
    branches=None,
    point=None,
    window=None,
    length=None,
):
    """Both manifolds of every point of an orbit: whole branches, or what a window shows of them.

    Parameters
    ----------
    ball : Ball
    energy : float
        In m omega^2 R^2.
    periodic : xarray.Dataset
        Orbits of this period, as from `symmetric_orbits`.
    period : int
        Of the orbit.
    type : {"hyperbolic", "inverse hyperbolic"}
        Of the orbit.
    resolution : mapping
        `distance` and `bend` of `trace_manifold`.
    branches : mapping, optional
        {side: {"length": L}}, in section radii: whole branches.
    point : int, optional
        Instead of branches: the index of the point that a window shows.
    window : mapping, optional
        {"x": [a, b], "xdot": [a, b]}, relative to that point, in section radii.
    length : float, optional
        How far the branches are followed then, in section radii.

    Returns
    -------
    xarray.Dataset
        x, xdot, udot on `vertex`, branch after branch; on `branch` row_size, stable (0 or 1),
        saddle and side. Attributes start_error and ended of `trace_manifold`, of all branches the
        worst; with a window window_x, window_xdot, point_x, point_xdot.

    Raises
    ------
    ValueError
        No such orbit, or what `trace_manifold` refuses.

    References
    ----------
    Kanso and Papadopoulos, Figures 5 and 6.

    Examples
    --------
    >>> from pseudorigid import Ball, symmetric_orbits
    >>> six = symmetric_orbits(Ball(k=0.2, g=0.04), 0.01, 6)
    >>> outer = {"outer": {"length": 0.1}}
    >>> how = {"distance": 0.05, "bend": 30}
    >>> scene_manifolds(Ball(k=0.2, g=0.04), 0.01, six, 6, "hyperbolic", how, outer).sizes["branch"]
    12
    """
    orbit = of_type(periodic, type, period)
    if window is None:
        how = {side: {"length": branches[side]["length"]} for side in sorted(branches)}
        about = {}
    else:
        radius = ball.section(energy)[1]
        centre = {name: float(orbit[name].values[point]) for name in ("x", "xdot")}
        edges = {name: [centre[name] + radius * edge for edge in window[name]] for name in centre}
        box = (*edges["x"], *edges["xdot"])
        how = {side: {"length": length, "window": box} for side in ("inner", "outer")}
        about = {f"window_{name}": edges[name] for name in centre}
        about |= {f"point_{name}": centre[name] for name in centre}
    requests = [
        (saddle, side, stable, how[side])
        for side in how
        for stable in (False, True)
        for saddle in range(period)
    ]
    return _collect(ball, energy, orbit, requests, resolution).assign_attrs(about)


def _collect(ball, energy, orbit, requests, resolution):
    traced, total = [], 0
    for saddle, side, stable, how in requests:
        more = {"stable": stable, "side": side} | resolution
        traced.append(trace_manifold(ball, energy, orbit, saddle, **how, **more))
        total += traced[-1].sizes["vertex"]
        if total > MOST_IN_ALL:
            raise ValueError(f"manifolds of more than {MOST_IN_ALL} points: make length shorter")
    whole = xr.concat(traced, "vertex", combine_attrs="override")
    whole.attrs["start_error"] = max(branch.attrs["start_error"] for branch in traced)
    if ended := [branch.attrs["ended"] for branch in traced if "ended" in branch.attrs]:
        whole.attrs["ended"] = min(ended)
    return whole.assign(
        row_size=(
            "branch",
            np.array([branch.sizes["vertex"] for branch in traced], dtype=np.int64),
            {"long_name": "number of vertices", "units": "1", "sample_dimension": "vertex"},
        ),
        stable=(
            "branch",
            np.array([stable for _, _, stable, _ in requests], dtype=np.int8),
            {"long_name": "1 on the stable manifold, 0 on the unstable one", "units": "1"},
        ),
        saddle=(
            "branch",
            np.array([saddle for saddle, *_ in requests], dtype=np.int64),
            {"long_name": "index of the orbit's point", "units": "1"},
        ),
        side=(
            "branch",
            np.array([side for _, side, *_ in requests], dtype=object),
            {"long_name": "side on which the branch leaves the point"},
        ),
    )


class _Branch:
    """An unstable branch as a function of u >= 0, mirrored where a stable one is wanted.

    Its side is the sign of the direction's product with that from the orbit's middle. At one point
    of Figure 5's orbit, x = -0.08267, y = -0.04873, these are at 89.99 degrees: the product is
    0.084485 - 0.084441 = 4.4e-5, and its sign is not that of the outer branches carried
    there by the map, which takes the other five to one another. So inner and outer, and with them
    the two lengths, are swapped there and at the mirrored point's stable branches. A rule that
    carried one clear side along the orbit would not do that, but would change the figure's data.
    """

    def __init__(self, ball, energy, points, chart, saddle, side, mirrored):
        self.ball, self.energy, self.mirrored = ball, energy, mirrored
        self.point, self.origin = points[:, saddle], chart[:, saddle]
        self.radius = ball.section(energy)[1]
        self.period = points.shape[1]
        (a, b), (c, d) = ball.chart_jacobian(*points[:, saddle], impacts=self.period)
        trace = a + d
        if abs(trace) <= 2.0:
            raise ValueError("the orbit is elliptic: it has no stable and unstable manifolds")
        root = np.sqrt((abs(trace) - 2.0) * (abs(trace) + 2.0))
        multiplier = np.copysign(0.5 * (abs(trace) + root), trace)
        # the larger of the two rows of J - lambda gives the direction
        e = np.array([b, multiplier - a]) if abs(b) > abs(c) else np.array([multiplier - d, c])
        # outer: away from the middle of the orbit, in the disk's own proportions
        scale = np.array([1.0, 1.0 / np.sqrt(ball.k * (1.0 + ball.k))])
        outward = (self.origin - chart.mean(axis=1)) * scale * (e * scale)
        e = e / np.sqrt(np.sum((e * scale) ** 2))
        sign = 1.0 if (np.sum(outward) > 0.0) == (side == "outer") else -1.0
        self.multiplier = float(multiplier)
        if self.multiplier < 0.0:  # the two sides change places: every second image
            self.period *= 2
            self.multiplier *= self.multiplier
        self.weak = self.multiplier < WEAK
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
        known = states[:, four]
        if self.mirrored:
            known = np.stack(ball.reflect(*known))
        columns = known[:, at - four[0], np.arange(at.size)]
        chart = np.stack([known[0], known[1] - ball.k * known[2]])
        first, second = (
            _interpolated(u[four[part]], chart[:, part], before)
            for part in (slice(0, 3), slice(1, 4))
        )
        good = np.ones(at.size, bool)
        if self.energy > ball.g * ball.g * (1.0 + 0.5 * ball.k):  # the map may jump
            extent = np.max(chart, axis=1) - np.min(chart, axis=1)
            good = np.all(np.abs(first - second) <= 0.5 * np.max(extent, axis=0), axis=0)
        share = (before - u[four[0]]) / (u[four[3]] - u[four[0]])
        x, y = first + share * (second - first)
        between = good & ~there
        columns[:, between] = ball.state_xy(x[between], y[between], self.energy)
        columns = [np.ascontiguousarray(a) for a in columns]
        ball.map.steps(*columns, ball.k, ball.g, self.period, np.empty(at.size))
        found = np.stack(ball.reflect(*columns) if self.mirrored else columns)
        return found, good | there

    def __call__(self, u):
        """States (3, n) at the parameters u (n,), each from the first segment."""
        image = np.floor(u)
        sigma = 1.0 + (self.multiplier - 1.0) * (u - image)
        start = self.origin[:, None] + sigma * self.first[:, None]
        states = np.stack(self.ball.state_xy(start[0], start[1], self.energy))
        for m in np.unique(image):
            (rows,) = np.nonzero(image == m)
            columns = [a.copy() for a in states[:, rows]]
            impacts = int(m) * self.period
            self.ball.map.steps(*columns, self.ball.k, self.ball.g, impacts, np.empty(rows.size))
            states[:, rows] = columns
        return np.stack(self.ball.reflect(*states)) if self.mirrored else states

    def known(self, image, u, states):
        """Whether two orbits to where images `image - 1` and `image` join agree that far."""
        if image < 2:
            return True
        ends = self(np.array([np.nextafter(float(image), 0.0), float(image)]))
        last = states[:, u >= image - 1]
        extent = np.max(np.max(last, axis=1) - np.min(last, axis=1))
        return np.max(np.abs(ends[:, 1] - ends[:, 0])) <= KNOWN * extent

    def base(self):
        """The point itself, (3, 1)."""
        state = self.ball.reflect(*self.point) if self.mirrored else self.point
        return np.array(state)[:, None]

    def start_error(self):
        """By how much the image of the segment's start misses its end, in section radii."""
        ends = self(np.array([np.nextafter(1.0, 0.0), 1.0]))
        return float(np.max(np.abs(ends[:, 1] - ends[:, 0])) / self.radius)


def _interpolated(nodes, values, at):
    """The parabolas through values (2, 3, n) at nodes (3, n), at `at` (n,)."""
    a, b, c = nodes
    slope = (values[:, 1] - values[:, 0]) / (b - a)
    bend = ((values[:, 2] - values[:, 1]) / (c - b) - slope) / (c - a)
    return values[:, 0] + (at - a) * (slope + (at - b) * bend)


def _trace(branch, length, distance, bend, window):
    """The polyline (3, n) of a branch, image by image until it is `length` long."""
    straight = sincos(bend * DEGREE)[1]
    u = np.empty(0)
    states = np.empty((3, 0))
    most, travelled = MOST_IMAGES, np.zeros(1)
    if branch.weak:
        most = int(MOST_IMAGES * log(WEAK) / log(branch.multiplier))
    for image in range(most):
        if branch.weak and not branch.known(image, u, states):
            branch.ended = float(travelled[-1])
            break
        fresh = image + np.arange(FRESH) / FRESH
        states = np.append(states, branch.next(fresh, u, states), axis=1)
        u = np.append(u, fresh)
        while True:
            short = _too_coarse(branch, u, states, distance, straight, window)
            middle = 0.5 * (u[:-1] + u[1:])[short]
            if not middle.size:
                break
            at = np.nonzero(short)[0] + 1
            fresh = branch.next(middle, u, states)
            u, states = np.insert(u, at, middle), np.insert(states, at, fresh, axis=1)
            if u.size > MOST_VERTICES:
                raise ValueError(
                    f"a manifold of more than {MOST_VERTICES} points: make length shorter"
                )
        sides = _sides(states) / branch.radius
        jumps = _is_jump(u) & (sides > 1e-6)
        travelled = np.cumsum(np.where(jumps, 0.0, sides))
        if travelled[-1] >= length:
            break
    else:
        raise ValueError(
            f"a manifold is {travelled[-1]:.3g} section radii long after {most} images, with a "
            f"multiplier of {branch.multiplier:.6g}: make length shorter"
        )
    last = int(np.searchsorted(travelled, length)) + 1
    states, jumps = states[:, : last + 1], jumps[:last]
    states = np.concatenate([branch.base(), states], axis=1)
    keep = np.append(True, ~jumps)
    if window is not None:
        keep &= _meets(states, window, 0.0)
    return _pieces(states, keep)


def _sides(states):
    difference = states[:, 1:] - states[:, :-1]
    return np.sqrt(np.sum(difference * difference, axis=0))


def _is_jump(u):
    """Where u cannot be halved any further: what is still apart there is a jump of the map."""
    middle = 0.5 * (u[:-1] + u[1:])
    return (u[1:] - u[:-1] < 2.0**-40) | (middle == u[:-1]) | (middle == u[1:])


def _too_coarse(branch, u, states, distance, straight, window):
    """Which sides of the polyline need a point in their middle."""
    if window is None:
        drawn = states / branch.radius
        inside = True
        coarse = False
    else:
        sizes = np.array([window[1] - window[0], window[3] - window[2]])
        drawn = states[:2] / sizes[:, None]
        inside = _meets(states, window, 1.0)
        coarse = _sides(states) > COARSE * branch.radius
    step = drawn[:, 1:] - drawn[:, :-1]
    sides = np.sqrt(np.sum(step * step, axis=0))
    cosine = np.sum(step[:, 1:] * step[:, :-1], axis=0)
    bent = cosine < straight * sides[1:] * sides[:-1]
    bent &= np.maximum(sides[1:], sides[:-1]) > FINEST * distance
    # a bend is mended by halving the longer of its two sides, both where they are alike
    first = bent & (sides[:-1] >= 0.5 * sides[1:])
    second = bent & (sides[1:] >= 0.5 * sides[:-1])
    fine = sides > distance
    fine[:-1] |= first
    fine[1:] |= second
    return ((fine & inside) | coarse) & ~_is_jump(u)


def _meets(states, window, margin):
    """Whether the box around a side, widened by `margin` of its longer edge, meets the window."""
    low = np.minimum(states[:2, 1:], states[:2, :-1])
    high = np.maximum(states[:2, 1:], states[:2, :-1])
    widen = margin * np.max(high - low, axis=0)
    meets = True
    for axis in range(2):
        meets = (
            meets
            & (low[axis] - widen <= window[2 * axis + 1])
            & (high[axis] + widen >= window[2 * axis])
        )
    return meets


def _pieces(states, keep):
    """The vertices of the sides that are kept, a row of NaN between separate pieces."""
    ends = np.concatenate([[False], keep]) | np.concatenate([keep, [False]])
    gap = ends[:-1] & ends[1:] & ~keep  # two kept pieces that only a dropped side parts
    (rows,) = np.nonzero(ends)
    parted = np.nonzero((np.diff(rows) > 1) | gap[rows[:-1]])[0] + 1
    return np.insert(states[:, rows], parted, np.nan, axis=1)
