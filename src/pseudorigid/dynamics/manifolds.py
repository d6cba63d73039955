"""Stable and unstable manifolds of a hyperbolic periodic orbit, as ordered polylines.

`branch` has the rule by which a branch is computed, `tracing` follows it as far as it is wanted.
"""

from itertools import product

import numpy as np
import xarray as xr

from .branch import Branch
from .inputs import coordinates, not_allowed, number, one_of
from .tracing import trace
from .variables import NAMES, of_rows, of_type, variables

MOST_IN_ALL = 10_000_000  # points of a scene
_STATES = {name: NAMES[name] for name in ("x", "xdot", "udot")}
_BRANCHES = {
    "row_size": ("branch", "number of vertices"),
    "stable": ("branch", "1 on the stable manifold, 0 on the unstable one"),
    "saddle": ("branch", "index of the orbit's point"),
    "side": ("branch", "side on which the branch leaves the point"),
}


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
        Largest bend from side to side, in degrees, where a side is longer than a
        thousandth of the distance (FINEST in `tracing`).
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
        of more points or images than `tracing.MOST_VERTICES` or `branch.MOST_IMAGES` allow.

    Examples
    --------
    >>> from pseudorigid import Ball, symmetric_orbits
    >>> ball = Ball(k=0.2, g=0.04)
    >>> six = of_type(symmetric_orbits(ball, 0.01, 6), "hyperbolic")
    >>> branch = trace_manifold(ball, 0.01, six, length=0.1, distance=0.05, bend=30)
    >>> sorted(branch.data_vars)
    ['udot', 'x', 'xdot']
    """
    points = _points(orbit)
    energy = number("energy", energy)
    _check_orbit(ball, energy, points)
    indices = range(points.shape[1])
    allowed = f"an index from 0 to {indices[-1]}"
    saddle = int(number("saddle", saddle, allowed, indices.__contains__))
    one_of("side", side, ("inner", "outer"))
    if not isinstance(stable, (bool, np.bool_)):
        raise not_allowed("stable", stable, "True or False")
    length, distance = (
        number(name, value, "above 0", lambda v: v > 0.0)
        for name, value in (("length", length), ("distance", distance))
    )
    bend = number("bend", bend, "between 0 and 180 degrees", lambda v: 0.0 < v < 180.0)
    window = None if window is None else _edges(window)
    branch = Branch(ball, energy, points, saddle, side, stable)
    vertices = trace(branch, length, distance, bend, window)
    attributes = {"start_error": branch.start_error()}
    if branch.ended is not None:
        attributes["ended"] = branch.ended
    return xr.Dataset(variables("vertex", vertices, _STATES), attrs=attributes)


def _points(orbit):
    """Read one orbit's states, (3, n)."""
    if not (hasattr(orbit, "data_vars") and all(name in orbit for name in _STATES)):
        raise not_allowed("orbit", orbit, "a Dataset with x, xdot and udot")
    if any(orbit[name].dims != ("point",) or not orbit[name].size for name in _STATES):
        raise ValueError("one orbit is needed: choose it with .isel(orbit=...)")
    return np.stack(coordinates(**{name: orbit[name].values for name in _STATES}))


def _check_orbit(ball, energy, points):
    """Refuse an orbit of another energy."""
    off = np.abs(ball.energy(*points) - energy)
    if not np.all(off <= 1e-9 * ball.k * ball.section(energy)[1] ** 2):
        own = f"the orbit's own, {float(ball.energy(*points[:, 0])):.6g}"
        raise not_allowed("energy", energy, own)


def _edges(window):
    """Read a window."""
    allowed = "(x_low, x_high, xdot_low, xdot_high)"
    try:
        x_low, x_high, xdot_low, xdot_high = (number("window", edge) for edge in window)
    except (TypeError, ValueError):
        raise not_allowed("window", window, allowed) from None
    if not (x_low < x_high and xdot_low < xdot_high):
        raise not_allowed("window", window, allowed)
    return x_low, x_high, xdot_low, xdot_high


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
    lines, rows, total = [], [], 0
    for side, stable, saddle in product(how, (False, True), range(period)):
        more = {"stable": stable, "side": side} | how[side] | resolution
        lines.append(trace_manifold(ball, energy, orbit, saddle, **more))
        rows.append((lines[-1].sizes["vertex"], np.int8(stable), saddle, side))
        total += rows[-1][0]
        if total > MOST_IN_ALL:
            raise ValueError(f"manifolds of more than {MOST_IN_ALL} points: make length shorter")
    about["start_error"] = max(line.attrs["start_error"] for line in lines)
    if ended := [line.attrs["ended"] for line in lines if "ended" in line.attrs]:
        about["ended"] = min(ended)
    whole = xr.concat(lines, "vertex", combine_attrs="override").assign(of_rows(_BRANCHES, rows))
    whole["row_size"].attrs["sample_dimension"] = "vertex"
    return whole.assign_attrs(about)
