"""Stable and unstable manifolds of a hyperbolic periodic orbit, as ordered polylines.

`branch` has the rule by which a branch is computed, `tracing` follows it as far as it is wanted.
"""

from itertools import product

import numpy as np
import xarray as xr

from .branch import Branch
from .tracing import traced
from .variables import NAMES, of_rows, of_type, states_of, variables

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
    points = states_of(orbit).astype(float)
    _check(ball, energy, points, saddle, side, length, distance, bend, window)
    branch = Branch(ball, energy, points, saddle, side, stable)
    vertices = traced(branch, length, distance, bend, window)
    attributes = {"start_error": branch.start_error()}
    if branch.ended is not None:
        attributes["ended"] = branch.ended
    return xr.Dataset(variables("vertex", vertices, _STATES), attrs=attributes)


def _check(ball, energy, points, saddle, side, length, distance, bend, window):
    if points.ndim != 2:
        raise ValueError("one orbit is needed: choose it with .isel(orbit=...)")
    off = np.abs(ball.energy(*points) - energy) > 1e-9 * ball.k * ball.section(energy)[1] ** 2
    own = f"the orbit's own, {float(ball.energy(*points[:, 0])):.6g}"
    most = points.shape[1] - 1
    for name, value, good, allowed in (
        ("energy", energy, not np.any(off), own),
        ("saddle", saddle, saddle in range(most + 1), f"an index from 0 to {most}"),
        ("side", side, side in ("inner", "outer"), "'inner' or 'outer'"),
        ("length", length, 0.0 < length < np.inf, "above 0"),
        ("distance", distance, 0.0 < distance < np.inf, "above 0"),
        ("bend", bend, 0.0 < bend < 180.0, "between 0 and 180 degrees"),
        ("window", window, _is_window(window), "(x_low, x_high, xdot_low, xdot_high)"),
    ):
        if not good:
            raise ValueError(f"{name} = {value!r} is not allowed: {allowed}")


def _is_window(window):
    return window is None or (len(window) == 4 and window[0] < window[1] and window[2] < window[3])


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
