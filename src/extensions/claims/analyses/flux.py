"""Flux through the broken separatrices of a hyperbolic orbit: crossings, lobes and escape.

A region is closed in by the unstable branch of each saddle up to its first crossing with y = 0, or
that crossing's images, and from there by the stable branch into the neighbouring saddle. Each
impact carries one lobe out of the region and one of equal area into it (MacKay, Meiss and Percival,
Transport in Hamiltonian systems, Physica D 13, 1984).
"""

import math
from collections.abc import Sequence
from typing import Any, Literal, NamedTuple

import numpy as np
import xarray as xr
from flint import arb, ctx

from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.manifolds import trace_manifold
from pseudorigid.dynamics.periodic import symmetric_orbits
from pseudorigid.dynamics.variables import AREA, LENGTH, SPEED, chart, of_rows, of_type, states_of

from .actions import PrimaryPair, first_crossing, lobe, saddles_of
from .polygon import Polygon
from .sea import as_array, half_axes, ratio, sea_states

Side = Literal["inner", "outer"]
SIDES: tuple[Side, ...] = ("inner", "outer")
# The area of a lobe is computed twice, with these bits and from starts so many periods earlier, to
# see which digits agree. At 900 bits the flights of Figure 5's orbit are not enclosed.
_BITS, _PERIODS_EARLIER = (1800, 1200), (20, 30)
_PRECISION_FACTORS = (1, 2, 4)  # of the bits, tried in turn until flights are enclosed
_CORNERS, _VERTICES = 1201, 801  # of the lines kept for pictures
_MAX_BRANCH = 16.0  # length of a traced branch, section radii
_MAX_SIDE = 0.02  # side of a region's polygon, section radii
_HALVINGS = 30  # of a side; a side that is longer after them crosses a jump of the map
_BEND = 5.0  # degrees between the sides of traced lines
_DECIMAL = 2.302585092994046  # ln 10
_VARIABLES: dict[str, tuple[Any, ...]] = {
    "side": ("side", "which branch"),
    "area": ("side", "area of a lobe, by differences of action", AREA),
    "area_error": ("side", "its error", AREA),
    "digits": ("side", "area of a lobe in omega R^2, in decimals"),
    "region": ("side", "area closed in", AREA),
    "sea_inside": ("side", "share of the sea's impacts that are inside"),
    "sea_out": ("side", "share of the sea's impacts that leave"),
    "sea_out_error": ("side", "standard error of that share, between orbits"),
    "saddle": ("side", "index of the point that the branch leaves"),
    "target": ("side", "index of the point whose stable branch it meets"),
    "crossing_x": (("side", "crossing"), "x where a primary orbit meets y = 0", LENGTH),
    "sine": (("side", "crossing"), "sine of the angle from the unstable branch to the stable one"),
    "outline_x": (("side", "corner"), "x on the region's edge", LENGTH),
    "outline_y": (("side", "corner"), "y on the region's edge", SPEED),
    "branch_x": (("side", "vertex"), "x on the unstable branch", LENGTH),
    "branch_y": (("side", "vertex"), "y on that branch", SPEED),
}


def flux(
    ball: Ball, energy: float, period: int, distance: float,
    orbits: int, impacts: int, sides: Sequence[Side] = SIDES,
) -> xr.Dataset:  # fmt: skip
    """Compute crossings and lobes of both branches of the hyperbolic orbit, and their flux.

    Areas are those of (x, y = xdot - k udot), which the map keeps, eq. (42). `digits` are those
    that two starts and two precisions have in common. `branch_x`, `branch_y` run from one end of a
    lobe to the mirror image of its other end; their mirror image in y = 0 is the stable branch. A
    side without lobes has NaN, no digits, and an attribute missing_inner or missing_outer with the
    reason; ValueError is raised if no side has any. If a jump of the map cuts only the region's
    edge, the region's numbers are NaN. The sea is that of `sea_states`, and not followed for no
    `orbits`.

    >>> from pseudorigid import Ball
    >>> flux(Ball(k=0.2, g=0.04), 0.01, 5, 1e-2, 2, 100)
    Traceback (most recent call last):
    ...
    ValueError: period = 5 is not allowed: an even number
    """
    if period % 2:
        raise ValueError(f"period = {period} is not allowed: an even number")
    saddles = of_type(symmetric_orbits(ball, energy, period), "hyperbolic")
    branches = _Branches(ball, energy, saddles, distance)
    path = np.empty((2, 0, impacts))
    if orbits:
        out = ball.history(sea_states(ball, energy, orbits), impacts)
        path = np.array(chart(ball.k, *np.moveaxis(out[..., :3], -1, 0)))
    rows, missing = [], {}
    for side in sides:
        try:
            rows.append(_row(branches, side, path))
        except ValueError as error:
            missing[side] = str(error)
    if not rows:
        raise ValueError("; ".join(f"no {side} lobes: {why}" for side, why in missing.items()))
    attributes: dict[str, float | str] = {
        "section": math.pi * math.prod(half_axes(ball, energy)),
        "multiplier": float(saddles["multiplier"].values),
        "sea_impacts": path[0].size,
    }
    attributes |= {f"missing_{side}": why for side, why in missing.items()}
    lobes = xr.Dataset(of_rows(_VARIABLES, rows), attrs=attributes)
    fill = {"digits": "", "saddle": -1, "target": -1}  # the others are NaN
    return lobes.reindex(side=np.array(sides, dtype=object), fill_value=fill)


class _Branches(NamedTuple):
    """The branches of a hyperbolic orbit, traced with points at most `distance` radii apart."""

    ball: Ball
    energy: float
    saddles: xr.Dataset
    distance: float


def _row(branches: _Branches, side: Side, path: np.ndarray) -> tuple[Any, ...]:
    """Return the values of _VARIABLES for one side."""
    ball, _, saddles, _ = branches
    saddle, sign = _primary_branch(branches, side)
    (rough, _), (area, primary) = (
        _lobe(branches, saddle, sign, periods_earlier, bits)
        for bits, periods_earlier in zip(_BITS, _PERIODS_EARLIER, strict=True)
    )
    error = abs(area - rough).upper() + area.rad()
    digits = max(1, min(25, math.floor(float(-(error / area).log() / _DECIMAL))))
    traced = _traced_lobe(branches, saddle, side, primary)
    region = _region(branches, traced)
    closed_in, sea = math.nan, (math.nan,) * 3
    if not np.isnan(region[0, 0]):
        polygon = Polygon(region)
        closed_in, inside = polygon.area(), polygon.contains(*path)
        left = np.sum(inside[:, :-1] & ~inside[:, 1:], axis=1).astype(float)
        if left.size:
            steps = np.full(left.size, float(inside.shape[1] - 1))
            sea = inside.mean(), *ratio(left, steps)
    x, y = chart(ball.k, *states_of(saddles))
    target = int(np.argmin((x - x[saddle]) ** 2 + (y + y[saddle]) ** 2))
    areas = float(area), float(error), area.str(digits, radius=False), closed_in
    crossings = [(float(each.points[-1][0]), float(each.sine())) for each in primary]
    lines = *_thinned(region, _CORNERS), *_thinned(traced.branch(), _VERTICES)
    return side, *areas, *sea, saddle, target, *np.transpose(crossings), *lines


def _lobe(
    branches: _Branches, saddle: int, sign: int, periods_earlier: int, bits: int
) -> tuple[arb, PrimaryPair]:
    """Return `lobe` of the branch that leaves one of the saddles, with more bits if needed."""
    ball, energy, saddles, _ = branches
    for factor in _PRECISION_FACTORS:
        with ctx.workprec(factor * bits):
            try:
                return lobe(saddles_of(ball, energy, saddles)[saddle], sign, periods_earlier)
            except ArithmeticError as error:
                reason = str(error)
    raise ValueError(reason)


def _thinned(line: np.ndarray, count: int) -> np.ndarray:
    """Return `count` vertices of a line (2, n), its ends among them."""
    return line[:, np.arange(count) * (line.shape[1] - 1) // (count - 1)]


def _primary_branch(branches: _Branches, side: str) -> tuple[int, int]:
    """Return (saddle, sign) of the branch that meets y = 0 soonest after it leaves a saddle."""
    ball, energy, saddles, _ = branches
    points = chart(ball.k, *states_of(saddles))
    outwards = points - points.mean(axis=1)[:, None]
    weight = np.array([1.0, 1.0 / (ball.k * (1.0 + ball.k))])  # makes the section a circle
    candidates = []
    with ctx.workprec(128):
        for index, saddle in enumerate(saddles_of(ball, energy, saddles)):
            along = np.array([float(a) for a in saddle.direction])
            outward = np.sum(outwards[:, index] * weight * along) > 0.0
            sign = 1 if outward == (side == "outer") else -1
            crossing = first_crossing(saddle, sign, 0)
            if crossing is not None:
                parameter, impacts = crossing
                grown = [float(saddle.multiplier)] * (impacts // saddle.period)
                candidates.append((math.prod(grown, start=parameter), index, sign))
    if not candidates:
        raise ValueError("no such branch meets y = 0")
    return min(candidates)[1:]


class _TracedLobe(NamedTuple):
    """A branch that passes the ends of a lobe, and the mirror image of its second end.

    `line` are its points (2, n), `states` its states (3, n), `ends` those three points, and `at`
    the indices of the points of the line next to them.
    """

    line: np.ndarray
    states: np.ndarray
    ends: list[np.ndarray]
    at: list[int]

    def branch(self) -> np.ndarray:
        """Return the part of the branch between the outermost ends, (2, n)."""
        return self.line[:, min(self.at) : max(self.at) + 1]


def _lobe_ends(primary: PrimaryPair) -> list[np.ndarray]:
    """Return the lobe's two ends, and the mirror image of its second end, as points (x, y)."""
    first, second = primary
    steps = 2 * second.impacts - first.impacts
    ends = first.points[-1], second.points[min(first.impacts, steps)]
    start, stop = (np.array([float(a) for a in end]) for end in ends)
    if steps < first.impacts:
        stop[1] = -stop[1]
    return [start, stop, stop * np.array([1.0, -1.0])]


def _traced_lobe(branches: _Branches, saddle: int, side: Side, primary: PrimaryPair) -> _TracedLobe:
    """Trace the branch until it passes the ends of the lobe between the primary orbits."""
    ball, energy, saddles, distance = branches
    ends, length = _lobe_ends(primary), 0.25
    while True:
        traced = trace_manifold(
            ball, energy, saddles, saddle, side=side, length=length, distance=distance, bend=_BEND
        )
        states = states_of(traced)
        line = chart(ball.k, *states)
        (cuts,) = np.nonzero(np.isnan(line[0]))
        whole = line[:, : cuts[0]] if cuts.size else line
        at = [int(np.argmin(np.sum((whole - end[:, None]) ** 2, axis=0))) for end in ends]
        gaps = [np.max(np.abs(whole[:, i] - end)) for i, end in zip(at, ends, strict=True)]
        if max(at) < whole.shape[1] - 1 and max(gaps) < 2.0 * distance * ball.section(energy)[1]:
            return _TracedLobe(line, states, ends, at)
        if cuts.size:
            raise ValueError("a jump of the map cuts the branch before it closes a lobe")
        length *= 2.0
        if length > _MAX_BRANCH:
            raise ValueError(f"the branch closes no lobe within {_MAX_BRANCH:g} section radii")


def _region(branches: _Branches, lobe: _TracedLobe) -> np.ndarray:
    """Return the edge (2, n) of the region that a branch closes in, NaN if a jump cuts it."""
    ball, energy, points = branches.ball, branches.energy, branches.saddles.sizes["point"]
    x, y = lobe.ends[0]
    first = as_array(ball.state_xy(x, y, energy))
    arc = np.append(lobe.states[:, : lobe.at[0]], first, axis=1)
    arc = arc[:, ~np.isnan(arc[0])]
    mirrored = as_array(ball.reflect(*arc[:, ::-1]))
    states = np.concatenate([arc, mirrored[:, 1:]], axis=1)
    longest = _MAX_SIDE * ball.section(energy)[1]
    for _ in range(_HALVINGS):
        arcs, images = [], states
        for _ in range(points):
            arcs.append(chart(ball.k, *images))
            images = ball.after(images)[:3]
        long = np.max(np.abs(np.diff(arcs)), axis=(0, 1)) > longest
        if not long.any():
            return _closed(arcs)
        x, y = 0.5 * (arcs[0][:, :-1] + arcs[0][:, 1:])[:, long]
        inserted = as_array(ball.state_xy(x, y, energy))
        states = np.insert(states, np.flatnonzero(long) + 1, inserted, axis=1)
    return np.full((2, _CORNERS), math.nan)


def _closed(arcs: list[np.ndarray]) -> np.ndarray:
    """Join arcs (2, n) from saddle to saddle to a closed line, each to the nearest end."""
    first, *rest = arcs
    loop = [first]
    while rest:
        gaps = [np.max(np.abs(arc[:, 0] - loop[-1][:, -1])) for arc in rest]
        loop.append(rest.pop(int(np.argmin(gaps))))
    return np.concatenate(loop, axis=1)
