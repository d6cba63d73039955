"""What passes through the broken separatrices of a hyperbolic orbit: crossings, lobes, escape.

The unstable branch of each saddle up to its first crossing with y = 0, or that crossing's images,
and from there the stable branch into the neighbouring saddle close a region in. Each impact carries
one lobe out of it and one of the same area in (MacKay, Meiss and Percival, Physica D 13, 1984).
"""

import math

import numpy as np
import xarray as xr
from flint import ctx

from ..dynamics.manifolds import trace_manifold
from ..dynamics.orbits import orbit
from ..dynamics.periodic import symmetric_orbits
from ..dynamics.variables import AREA, LENGTH, SPEED, chart, of_rows, of_type, states_of
from .actions import Law, Saddle, first_crossing, lobe
from .polygon import Polygon
from .sea import sea_states

SIDES = ("inner", "outer")
_BITS, _NEARER = (900, 1200), (20, 30)  # two ways to the same digits
_CORNERS, _VERTICES = 1201, 801  # of the lines kept for pictures
_FINER = (1, 2, 4)  # times these bits, where flights are not enclosed
_LONGEST = 16.0  # section radii, of a branch
_LONGEST_SIDE, _HALVINGS = 0.02, 30  # section radii, of a region's edge; longer then is a jump
_BEND = 5.0  # degrees, of the lines that polygons are made of
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


def flux(ball, energy, period, distance, grid, between, orbits, impacts):
    """Crossings and lobes of both branches of the hyperbolic orbit, and the flux through them.

    Parameters
    ----------
    ball : Ball
    energy : float
        In m omega^2 R^2.
    period : int
        Of the orbit, even.
    distance : float
        Largest side of the polygons, in section radii.
    grid : int
        The flux is also counted over grid x grid points of the section's bounding rectangle.
    between : (float, float)
        And along orbits of the sea, which start evenly over this part of y = 0, in section radii.
    orbits, impacts : int
        How many of these, and how many impacts each has.

    Returns
    -------
    xarray.Dataset
        On side, inner and outer. From actions, in balls: area of the lobe, area_error, and digits,
        the area as text with the digits that two starts and two precisions have in common; saddle
        and target, the indices of the points of the orbit that the branch leaves and meets. On
        (side, crossing): crossing_x on y = 0, where the two primary orbits meet it, and sine, of
        the angle between the branches in the plane (x, y = xdot - k udot). From polygons of the
        traced lines: lobe_polygon, and region, the area closed in. From counting: carried_out and
        carried_in, areas that one impact moves; sea_inside, the share of the sea's impacts that are
        inside, and sea_out, the share of its impacts that leave. For pictures: outline_x, outline_y
        (side, corner), of the region; branch_x, branch_y (side, vertex), of the unstable branch
        from a lobe's one end to the mirror image of its other, whose own mirror image in y = 0 is
        the stable branch. Attributes: section, its area; multiplier, of the orbit. Areas are those
        of (x, y), which the map keeps, eq. (42), in omega R^2.

        A side without lobes has NaN, no digits, and an attribute missing_inner or missing_outer
        that says why: its branch is not seen to meet y = 0, or a jump of the map cuts it. Where a
        jump cuts the region's edge only, what belongs to the region is NaN.

    Raises
    ------
    ValueError
        No hyperbolic orbit of that period, an odd period, or no lobes on either side.

    References
    ----------
    MacKay, Meiss and Percival, Transport in Hamiltonian systems, Physica D 13 (1984).

    Examples
    --------
    >>> from pseudorigid import Ball
    >>> flux(Ball(k=0.2, g=0.04), 0.01, 5, 1e-2, 20, (0.55, 0.68), 2, 100)
    Traceback (most recent call last):
    ...
    ValueError: period = 5 is not allowed: an even number
    """
    if period % 2:
        raise ValueError(f"period = {period} is not allowed: an even number")
    saddles = of_type(symmetric_orbits(ball, energy, period), "hyperbolic")
    _, *states = sea_states(ball, energy, between, orbits)
    path = chart(ball.k, *states_of(orbit(ball, states, impacts)))
    found, missing = [], {}
    for side in SIDES:
        try:
            found.append(_side(ball, energy, saddles, side, distance, grid, path))
        except ValueError as error:
            missing[side] = str(error)
            found.append(_no_side(side))
    if len(missing) == len(SIDES):
        raise ValueError("; ".join(f"no {side} lobes: {why}" for side, why in missing.items()))
    attributes = {
        "section": math.pi * math.prod(_half_axes(ball, energy)),
        "multiplier": float(saddles["multiplier"].values),
    }
    attributes |= {f"missing_{side}": why for side, why in missing.items()}
    return xr.Dataset(of_rows(_VARIABLES, found), attrs=attributes)


def _no_side(side):
    """A side without lobes, as a row of _VARIABLES."""
    sizes = {"crossing": 2, "corner": _CORNERS, "vertex": _VERTICES}
    row = {}
    for name, (dims, *_) in _VARIABLES.items():
        row[name] = math.nan if dims == "side" else np.full(sizes[dims[1]], math.nan)
    return (*(row | {"side": side, "digits": "", "saddle": -1, "target": -1}).values(),)


def _side(ball, energy, saddles, side, distance, grid, path):
    """Of one side what _VARIABLES says, in that order."""
    place, sign = _primary(ball, energy, saddles, side)
    states = states_of(saddles)
    lobes = []
    for bits, nearer in zip(_BITS, _NEARER, strict=True):
        lobes.append(_lobe(ball, energy, saddles, place, sign, nearer, bits))
    (rough, _), (area, primary) = lobes
    error = abs(area - rough).upper() + area.rad()
    digits = max(1, min(25, math.floor(float(-(error / area).log() / 2.302585092994046))))
    traced, region, branch = _polygons(ball, energy, saddles, place, side, distance, primary)
    counted = (math.nan,) * 5
    if not np.isnan(region[0, 0]):
        polygon = Polygon(region)
        inside = polygon.holds(*path)
        left = np.mean(inside[:-1] & ~inside[1:])
        counted = polygon.area(), *_carried(ball, energy, polygon, grid), inside.mean(), left
    x, y = chart(ball.k, *states)
    target = int(np.argmin((x - x[place]) ** 2 + (y + y[place]) ** 2))
    areas = float(area), float(error), area.str(digits, radius=False), traced
    crossings = [(float(one.points[-1][0]), float(one.sine())) for one in primary]
    lines = *_thinned(region, _CORNERS), *_thinned(branch, _VERTICES)
    return side, *areas, *counted, place, target, *np.transpose(crossings), *lines


def _lobe(ball, energy, saddles, place, sign, nearer, bits):
    """`lobe` of the branch that leaves one of the saddles, with as many bits as it needs."""
    state, period = states_of(saddles)[:, place].tolist(), saddles.sizes["point"]
    for finer in _FINER:
        with ctx.workprec(finer * bits):
            try:
                return lobe(Saddle(Law(ball, energy), state, period), sign, nearer)
            except ArithmeticError as error:
                reason = error
    raise ValueError(f"{reason}")


def _thinned(line, count):
    """`count` vertices of a line (2, n), its ends among them."""
    return line[:, np.arange(count) * (line.shape[1] - 1) // (count - 1)]


def _primary(ball, energy, saddles, side):
    """(saddle, sign) of the branch that meets y = 0 soonest after it leaves a saddle."""
    points = states_of(saddles)
    places = chart(ball.k, *points)
    outwards = places - places.mean(axis=1)[:, None]
    weight = np.array([1.0, 1.0 / (ball.k * (1.0 + ball.k))])  # in the disk's own proportions
    found = []
    with ctx.workprec(128):
        for place in range(points.shape[1]):
            saddle = Saddle(Law(ball, energy), points[:, place].tolist(), points.shape[1])
            along = np.array([float(saddle.ex), float(saddle.ey)])
            outward = np.sum(outwards[:, place] * weight * along) > 0.0
            sign = 1 if outward == (side == "outer") else -1
            crossing = first_crossing(saddle, sign, 0)
            if crossing is not None:
                parameter, impacts = crossing
                grown = [float(saddle.multiplier)] * (impacts // saddle.period)
                found.append((math.prod(grown, start=parameter), place, sign))
    if not found:
        raise ValueError("no such branch meets y = 0")
    return min(found)[1:]


def _polygons(ball, energy, saddles, place, side, distance, primary):
    """The lobe's area between the traced lines, and (2, n) the region and the lobe's branch.

    The region is NaN where a jump of the map cuts its edge.
    """
    first, second = primary
    steps = 2 * second.impacts - first.impacts
    ends = first.points[-1], second.points[min(first.impacts, steps)]
    one, other = (np.array([float(a) for a in end]) for end in ends)
    if steps < first.impacts:
        other[1] = -other[1]
    ends = [one, other, other * np.array([1.0, -1.0])]
    length = 0.25
    while True:
        traced = trace_manifold(
            ball, energy, saddles, place, side=side, length=length, distance=distance, bend=_BEND
        )
        states = states_of(traced)
        line = chart(ball.k, *states)
        (cuts,) = np.nonzero(np.isnan(line[0]))
        whole = line[:, : cuts[0]] if cuts.size else line
        at = [int(np.argmin(np.sum((whole - end[:, None]) ** 2, axis=0))) for end in ends]
        gaps = [np.max(np.abs(whole[:, i] - end)) for i, end in zip(at, ends, strict=True)]
        if max(at) < whole.shape[1] - 1 and max(gaps) < 2.0 * distance * ball.section(energy)[1]:
            break
        if cuts.size:
            raise ValueError("a jump of the map cuts the branch before it closes a lobe")
        length *= 2.0
        if length > _LONGEST:
            raise ValueError(f"the branch closes no lobe within {_LONGEST:g} section radii")
    # the stable arc is the mirror image of the unstable one from w1 to the mirror image of w2
    area = _between(line, at[0], at[1], one, other)
    area += _between(line, at[0], at[2], one, ends[2])
    arc = np.append(states[:, : at[0]], np.array(ball.state_xy(*one, energy))[:, None], axis=1)
    arc = arc[:, ~np.isnan(arc[0])]
    back = np.stack(ball.reflect(*arc[:, ::-1]))
    states, points = np.concatenate([arc, back[:, 1:]], axis=1), saddles.sizes["point"]
    loop = _images(ball, states, points)
    region = np.full((2, _CORNERS), math.nan)
    longest = _LONGEST_SIDE * ball.section(energy)[1]
    for _ in range(_HALVINGS):
        long = np.max(np.abs(np.diff(loop)), axis=(0, 1)) > longest
        if not long.any():
            region = _closed(loop)
            break
        middle = 0.5 * (loop[0][:, :-1] + loop[0][:, 1:])[:, long]
        fresh = np.stack(ball.state_xy(*middle, energy))
        states = np.insert(states, np.flatnonzero(long) + 1, fresh, axis=1)
        loop = _images(ball, states, points)
    return abs(area), region, line[:, min(at) : max(at) + 1]


def _images(ball, states, count):
    """The chart's places of states (3, n) and of their images, `count` in all: a list of (2, n)."""
    states, found = [np.array(values) for values in states], []
    for _ in range(count):
        found.append(np.stack(chart(ball.k, *states)))
        ball.map.steps(*states, ball.k, ball.g, 1, np.empty(states[0].size))
    return found


def _between(line, start, end, first, last):
    """The integral of y dx along a line (2, n) between points next to two of its vertices."""
    if end < start:
        return -_between(line, end, start, last, first)
    x, y = np.column_stack([first, line[:, start + 1 : end], last])
    return float(np.sum(0.5 * (y[1:] + y[:-1]) * (x[1:] - x[:-1])))


def _closed(arcs):
    """Arcs (2, n) from saddle to saddle, put one after the other to a closed line."""
    first, *rest = arcs
    loop = [first]
    while rest:
        gaps = [np.max(np.abs(arc[:, 0] - loop[-1][:, -1])) for arc in rest]
        loop.append(rest.pop(int(np.argmin(gaps))))
    return np.concatenate(loop, axis=1)


def _half_axes(ball, energy):
    radius = ball.section(energy)[1]
    return radius, math.sqrt(ball.k * (1.0 + ball.k)) * radius


def _carried(ball, energy, polygon, grid):
    """Areas that one impact carries out of a region and into it, counted on a grid."""
    width, height = _half_axes(ball, energy)
    middle = (2.0 * np.arange(grid) + 1.0) / grid - 1.0
    x, y = (a.ravel() for a in np.meshgrid(middle, middle))
    keep = x * x + y * y < 1.0
    x, y = ball.section(energy)[0] + width * x[keep], height * y[keep]
    before = polygon.holds(x, y)
    after = polygon.holds(*chart(ball.k, *ball.impact(*ball.state_xy(x, y, energy))[:3]))
    cell = 4.0 * width * height / (grid * grid)
    return cell * int(np.sum(before & ~after)), cell * int(np.sum(after & ~before))
