"""Flux through the broken separatrices of a hyperbolic orbit: crossings, lobes and escape.

A region is closed in by the unstable branch of each saddle up to its first crossing with y = 0, or
that crossing's images, and from there by the stable branch into the neighbouring saddle. Each
impact carries one lobe out of the region and one of equal area into it (MacKay, Meiss and Percival,
Transport in Hamiltonian systems, Physica D 13, 1984).
"""

import math

import numpy as np
import xarray as xr
from flint import ctx

from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.manifolds import trace_manifold
from pseudorigid.dynamics.orbits import orbit
from pseudorigid.dynamics.periodic import symmetric_orbits
from pseudorigid.dynamics.variables import AREA, LENGTH, SPEED, chart, of_rows, of_type, states_of

from .actions import Heteroclinic, first_crossing, lobe, saddles_of
from .polygon import Polygon
from .sea import half_axes, sea_states

SIDES = ("inner", "outer")
# The area of a lobe is computed twice, with these bits and so many images nearer to the saddle, to
# see which digits agree. At 900 bits the flights of Figure 5's orbit are not enclosed.
_BITS, _NEARER = (1800, 1200), (20, 30)
_PRECISION_FACTORS = (1, 2, 4)  # of the bits, tried in turn until flights are enclosed
_CORNERS, _VERTICES = 1201, 801  # of the lines kept for pictures
_MAX_BRANCH = 16.0  # length of a traced branch, section radii
_MAX_SIDE = 0.02  # side of a region's polygon, section radii
_HALVINGS = 30  # of a side; a side that is longer after them crosses a jump of the map
_BEND = 5.0  # degrees between the sides of traced lines
_DECIMAL = 2.302585092994046  # ln 10
_VARIABLES = {
    "side": ("side", "which branch"),
    "area": ("side", "area of a lobe, by differences of action", AREA),
    "area_error": ("side", "its error", AREA),
    "digits": ("side", "area of a lobe in omega R^2, in decimals"),
    "lobe_polygon": ("side", "area of that lobe between the traced lines", AREA),
    "region": ("side", "area closed in", AREA),
    "carried_out": ("side", "area that an impact carries out, counted", AREA),
    "carried_in": ("side", "area that an impact carries in, counted", AREA),
    "sea_inside": ("side", "share of the sea's impacts that are inside"),
    "sea_out": ("side", "share of the sea's impacts that leave"),
    "saddle": ("side", "index of the point that the branch leaves"),
    "target": ("side", "index of the point whose stable branch it meets"),
    "crossing_x": (("side", "crossing"), "x where a primary orbit meets y = 0", LENGTH),
    "sine": (("side", "crossing"), "sine of the angle from the unstable branch to the stable one"),
    "outline_x": (("side", "corner"), "x on the region's edge", LENGTH),
    "outline_y": (("side", "corner"), "y on the region's edge", SPEED),
    "branch_x": (("side", "vertex"), "x on the unstable branch", LENGTH),
    "branch_y": (("side", "vertex"), "y on that branch", SPEED),
}


def flux(ball, energy, period, distance, grid, between, orbits, impacts, sides=SIDES) -> xr.Dataset:
    """Compute crossings and lobes of both branches of the hyperbolic orbit, and their flux.

    Areas are those of (x, y = xdot - k udot), which the map keeps, eq. (42). `digits` are those
    that two starts and two precisions have in common. `branch_x`, `branch_y` run from one end of a
    lobe to the mirror image of its other end; their mirror image in y = 0 is the stable branch. A
    side without lobes has NaN, no digits, and an attribute missing_inner or missing_outer with the
    reason; ValueError is raised if no side has any. If a jump of the map cuts only the region's
    edge, the region's numbers are NaN.

    >>> from pseudorigid import Ball
    >>> flux(Ball(k=0.2, g=0.04), 0.01, 5, 1e-2, 20, (0.55, 0.68), 2, 100)
    Traceback (most recent call last):
    ...
    ValueError: period = 5 is not allowed: an even number
    """
    if period % 2:
        raise ValueError(f"period = {period} is not allowed: an even number")
    saddles = of_type(symmetric_orbits(ball, energy, period), "hyperbolic")
    states = sea_states(ball, energy, between, orbits)
    path = chart(ball.k, *states_of(orbit(ball, states, impacts)))
    rows, missing = [], {}
    for side in sides:
        try:
            rows.append(_row(ball, energy, saddles, side, distance, grid, path))
        except ValueError as error:
            missing[side] = str(error)
            rows.append(_missing_row(side))
    if len(missing) == len(sides):
        raise ValueError("; ".join(f"no {side} lobes: {why}" for side, why in missing.items()))
    attributes = {
        "section": math.pi * math.prod(half_axes(ball, energy)),
        "multiplier": float(saddles["multiplier"].values),
    }
    attributes |= {f"missing_{side}": why for side, why in missing.items()}
    return xr.Dataset(of_rows(_VARIABLES, rows), attrs=attributes)


def _missing_row(side: str) -> tuple:
    """Return the values of _VARIABLES for a side without lobes."""
    sizes = {"crossing": 2, "corner": _CORNERS, "vertex": _VERTICES}
    row = {
        name: math.nan if dims == "side" else np.full(sizes[dims[1]], math.nan)
        for name, (dims, *_) in _VARIABLES.items()
    }
    return (*(row | {"side": side, "digits": "", "saddle": -1, "target": -1}).values(),)


def _row(ball, energy, saddles, side, distance, grid, path) -> tuple:
    """Return the values of _VARIABLES for one side."""
    saddle, sign = _primary_branch(ball, energy, saddles, side)
    (rough, _), (area, primary) = (
        _lobe(ball, energy, saddles, saddle, sign, nearer, bits)
        for bits, nearer in zip(_BITS, _NEARER, strict=True)
    )
    error = abs(area - rough).upper() + area.rad()
    digits = max(1, min(25, math.floor(float(-(error / area).log() / _DECIMAL))))
    lobe_polygon, region, branch = _polygons(ball, energy, saddles, saddle, side, distance, primary)
    counted = (math.nan,) * 5
    if not np.isnan(region[0, 0]):
        polygon = Polygon(region)
        inside = polygon.contains(*path)
        left = np.mean(inside[:-1] & ~inside[1:])
        counted = polygon.area(), *_carried(ball, energy, polygon, grid), inside.mean(), left
    x, y = chart(ball.k, *states_of(saddles))
    target = int(np.argmin((x - x[saddle]) ** 2 + (y + y[saddle]) ** 2))
    areas = float(area), float(error), area.str(digits, radius=False), lobe_polygon
    crossings = [(float(each.points[-1][0]), float(each.sine())) for each in primary]
    lines = *_thinned(region, _CORNERS), *_thinned(branch, _VERTICES)
    return side, *areas, *counted, saddle, target, *np.transpose(crossings), *lines


def _lobe(ball, energy, saddles, saddle, sign, nearer, bits):
    """Return `lobe` of the branch that leaves one of the saddles, with more bits if needed."""
    for factor in _PRECISION_FACTORS:
        with ctx.workprec(factor * bits):
            try:
                return lobe(saddles_of(ball, energy, saddles)[saddle], sign, nearer)
            except ArithmeticError as error:
                reason = error
    raise ValueError(f"{reason}")


def _thinned(line: np.ndarray, count: int) -> np.ndarray:
    """Return `count` vertices of a line (2, n), its ends among them."""
    return line[:, np.arange(count) * (line.shape[1] - 1) // (count - 1)]


def _primary_branch(ball: Ball, energy: float, saddles: xr.Dataset, side: str) -> tuple[int, int]:
    """Return (saddle, sign) of the branch that meets y = 0 soonest after it leaves a saddle."""
    points = chart(ball.k, *states_of(saddles))
    outwards = points - points.mean(axis=1)[:, None]
    weight = np.array([1.0, 1.0 / (ball.k * (1.0 + ball.k))])  # makes the section a circle
    branches = []
    with ctx.workprec(128):
        for index, saddle in enumerate(saddles_of(ball, energy, saddles)):
            along = np.array([float(a) for a in saddle.direction])
            outward = np.sum(outwards[:, index] * weight * along) > 0.0
            sign = 1 if outward == (side == "outer") else -1
            crossing = first_crossing(saddle, sign, 0)
            if crossing is not None:
                parameter, impacts = crossing
                grown = [float(saddle.multiplier)] * (impacts // saddle.period)
                branches.append((math.prod(grown, start=parameter), index, sign))
    if not branches:
        raise ValueError("no such branch meets y = 0")
    return min(branches)[1:]


def _polygons(ball, energy, saddles, saddle, side, distance, primary):
    """Return the lobe's area between the traced lines, the region and the lobe's branch (2, n)."""
    ends = _lobe_ends(*primary)
    line, at, states = _traced_lobe(ball, energy, saddles, saddle, side, distance, ends)
    # the stable arc is the mirror image of the unstable one from ends[0] to ends[2]
    area = _integral(line, at[0], at[1], ends[0], ends[1])
    area += _integral(line, at[0], at[2], ends[0], ends[2])
    arc = np.append(states[:, : at[0]], np.array(ball.state_xy(*ends[0], energy))[:, None], axis=1)
    region = _region(ball, energy, arc[:, ~np.isnan(arc[0])], saddles.sizes["point"])
    return abs(area), region, line[:, min(at) : max(at) + 1]


def _lobe_ends(first: Heteroclinic, second: Heteroclinic) -> list[np.ndarray]:
    """Return the lobe's two ends, and the mirror image of its second end, as points (x, y)."""
    steps = 2 * second.impacts - first.impacts
    ends = first.points[-1], second.points[min(first.impacts, steps)]
    start, stop = (np.array([float(a) for a in end]) for end in ends)
    if steps < first.impacts:
        stop[1] = -stop[1]
    return [start, stop, stop * np.array([1.0, -1.0])]


def _traced_lobe(ball, energy, saddles, saddle, side, distance, ends):
    """Trace the branch until it passes the lobe's ends: points, indices of the ends, states."""
    length = 0.25
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
            return line, at, states
        if cuts.size:
            raise ValueError("a jump of the map cuts the branch before it closes a lobe")
        length *= 2.0
        if length > _MAX_BRANCH:
            raise ValueError(f"the branch closes no lobe within {_MAX_BRANCH:g} section radii")


def _region(ball: Ball, energy: float, arc: np.ndarray, points: int) -> np.ndarray:
    """Return the region's edge (2, n) from an unstable arc (3, m), NaN if a jump cuts it."""
    mirrored = np.stack(ball.reflect(*arc[:, ::-1]))
    states = np.concatenate([arc, mirrored[:, 1:]], axis=1)
    longest = _MAX_SIDE * ball.section(energy)[1]
    arcs = _images(ball, states, points)
    for _ in range(_HALVINGS):
        long = np.max(np.abs(np.diff(arcs)), axis=(0, 1)) > longest
        if not long.any():
            return _closed(arcs)
        middle = 0.5 * (arcs[0][:, :-1] + arcs[0][:, 1:])[:, long]
        inserted = np.stack(ball.state_xy(*middle, energy))
        states = np.insert(states, np.flatnonzero(long) + 1, inserted, axis=1)
        arcs = _images(ball, states, points)
    return np.full((2, _CORNERS), math.nan)


def _images(ball: Ball, states: np.ndarray, count: int) -> list[np.ndarray]:
    """Return the points (2, n) of states (3, n) and of their images, `count` arrays in all."""
    points = []
    for _ in range(count):
        points.append(chart(ball.k, *states))
        states = ball.after(states)[:3]
    return points


def _integral(line: np.ndarray, start: int, end: int, first, last) -> float:
    """Return the integral of y dx along a line (2, n) between points next to two vertices."""
    if end < start:
        return -_integral(line, end, start, last, first)
    x, y = np.column_stack([first, line[:, start + 1 : end], last])
    return float(np.sum(0.5 * (y[1:] + y[:-1]) * (x[1:] - x[:-1])))


def _closed(arcs: list[np.ndarray]) -> np.ndarray:
    """Join arcs (2, n) from saddle to saddle, each next to the nearest end, to a closed line."""
    first, *rest = arcs
    loop = [first]
    while rest:
        gaps = [np.max(np.abs(arc[:, 0] - loop[-1][:, -1])) for arc in rest]
        loop.append(rest.pop(int(np.argmin(gaps))))
    return np.concatenate(loop, axis=1)


def _carried(ball: Ball, energy: float, polygon: Polygon, grid: int) -> tuple[float, float]:
    """Return the areas that one impact carries out of a region and into it, counted on a grid."""
    width, height = half_axes(ball, energy)
    middle = (2.0 * np.arange(grid) + 1.0) / grid - 1.0
    x, y = (a.ravel() for a in np.meshgrid(middle, middle))
    inside = x * x + y * y < 1.0
    x, y = ball.section(energy)[0] + width * x[inside], height * y[inside]
    before = polygon.contains(x, y)
    after = polygon.contains(*chart(ball.k, *ball.impact(*ball.state_xy(x, y, energy))[:3]))
    cell = 4.0 * width * height / (grid * grid)
    return cell * int(np.sum(before & ~after)), cell * int(np.sum(after & ~before))
