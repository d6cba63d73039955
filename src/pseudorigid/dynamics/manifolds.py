"""Stable and unstable manifolds of a hyperbolic periodic orbit, as ordered polylines."""

from collections.abc import Sequence
from itertools import product
from typing import Any, Literal, SupportsFloat, SupportsIndex

import numpy as np
import xarray as xr

from .ball import Ball, require_ball
from .branch import Branch, Window
from .inputs import coordinates, not_allowed, number, one_of
from .periods import orbit_of_type, require_own
from .variables import NAMES, of_rows, variables

MOST_VERTICES_OF_SCENE = 10_000_000
_STATES = {name: NAMES[name] for name in ("x", "xdot", "udot")}
_BRANCHES = {
    "row_size": ("branch", "number of vertices"),
    "stable": ("branch", "1 on the stable manifold, 0 on the unstable one"),
    "saddle": ("branch", "index of the orbit's point"),
    "side": ("branch", "side on which the branch leaves the point"),
}


def trace_manifold(
    ball: Ball,
    energy: SupportsFloat,
    orbit: xr.Dataset,
    saddle: SupportsIndex = 0,
    *,
    stable: bool = False,
    side: Literal["inner", "outer"] = "outer",
    length: SupportsFloat = 1.0,
    distance: SupportsFloat = 0.01,
    bend: SupportsFloat = 10.0,
    window: Sequence[SupportsFloat] | None = None,
) -> xr.Dataset:
    """Trace one branch of the manifolds of a hyperbolic orbit's point, from the point outwards.

    Parameters
    ----------
    ball : Ball
    energy : float
        Energy of the orbit (m omega^2 R^2).
    orbit : xarray.Dataset
        One orbit of `symmetric_orbits` or `periodic_orbits`, x, xdot, udot on `point`. An inverse
        hyperbolic one is traced under P^2n.
    saddle : int
        Index of the point.
    stable : bool
        Whether to trace the stable branch instead of the unstable one.
    side : {"outer", "inner"}
        "outer" leaves the point away from the middle of the orbit.
    length : float
        Arc length in (x, xdot, udot), in section radii.
    distance : float
        Largest side of the polyline, in section radii, or with a window in units of its size.
    bend : float
        Largest angle between sides, in degrees, where a side is longer than `branch.FINEST`, a
        thousandth, times the distance.
    window : (x_low, x_high, xdot_low, xdot_high), optional
        In R and R omega; only what passes through the window is kept.

    Returns
    -------
    xarray.Dataset
        x, xdot, udot on `vertex`, in order from the point on. A row of NaN interrupts the line at
        the window's edge and where the map jumps. Attributes: start_error, the distance in section
        radii between the image of the first segment and the branch; and ended, the length in
        section radii where rounding errors end the branch, if that is before `length`.

    Raises
    ------
    ValueError
        The orbit is not hyperbolic, or not of this ball and energy, an argument is out of range, or
        the branch has more points or images than `branch.MOST_VERTICES` or `branch.MOST_IMAGES`.

    Examples
    --------
    >>> from pseudorigid import Ball, symmetric_orbits, trace_manifold
    >>> ball = Ball(k=0.2, g=0.04)
    >>> hyperbolic = symmetric_orbits(ball, 0.01, 6).isel(orbit=1)
    >>> branch = trace_manifold(ball, 0.01, hyperbolic, length=0.1, distance=0.05, bend=30)
    >>> sorted(branch.data_vars)
    ['udot', 'x', 'xdot']
    """
    require_ball(ball)
    points = _points(orbit)
    require_own(ball, orbit)
    energy = number("energy", energy)
    errors = np.abs(ball.energy(*points) - energy)
    if not np.all(errors <= 1e-9 * ball.k * ball.section(energy)[1] ** 2):
        allowed = f"the orbit's own, {float(ball.energy(*points[:, 0])):.6g}"
        raise not_allowed("energy", energy, allowed)
    indices = range(points.shape[1])
    allowed = f"an index from 0 to {indices[-1]}"
    saddle = int(number("saddle", saddle, allowed, indices.__contains__))
    one_of("side", side, ("inner", "outer"))
    if not isinstance(stable, (bool, np.bool_)):
        raise not_allowed("stable", stable, "True or False")
    length = number("length", length, "above 0", lambda v: v > 0.0)
    distance = number("distance", distance, "above 0", lambda v: v > 0.0)
    bend = number("bend", bend, "between 0 and 180 degrees", lambda v: 0.0 < v < 180.0)
    edges = None if window is None else _edges(window)
    branch = Branch(ball, energy, points, saddle, side, stable)
    vertices = branch.trace(length, distance, bend, edges)
    ended = {} if branch.ended is None else {"ended": branch.ended}
    attributes = {"k": ball.k, "g": ball.g, "energy": energy}
    attributes |= {"start_error": branch.start_error()} | ended
    return xr.Dataset(variables("vertex", vertices, _STATES), attrs=attributes)


def _points(orbit: Any) -> np.ndarray:
    """Return one orbit's states as an array (3, n)."""
    if not (hasattr(orbit, "data_vars") and all(name in orbit for name in _STATES)):
        raise not_allowed("orbit", orbit, "a Dataset with x, xdot and udot")
    if any(orbit[name].dims != ("point",) or not orbit[name].size for name in _STATES):
        raise ValueError("one orbit is needed: choose it with .isel(orbit=...)")
    return np.stack(coordinates(**{name: orbit[name].values for name in _STATES}))


def _edges(window: Any) -> Window:
    """Return the edges of a window as floats."""
    try:
        x_low, x_high, xdot_low, xdot_high = (number("window", edge) for edge in window)
        valid = x_low < x_high and xdot_low < xdot_high
    except (TypeError, ValueError):
        valid = False
    if not valid:
        raise not_allowed("window", window, "(x_low, x_high, xdot_low, xdot_high)")
    return x_low, x_high, xdot_low, xdot_high


def scene_manifolds(
    ball: Ball,
    energy: float,
    periodic: xr.Dataset,
    period: int,
    type: str,
    resolution: dict[str, float],
    branches: dict[str, dict[str, Any]] | None = None,
    point: int | None = None,
    window: Any = None,
    length: float | None = None,
) -> xr.Dataset:
    """Trace both manifolds of an orbit's points (Figure 5), or what a window shows (Figure 6).

    `branches`, {side: {"length": L}}, selects whole branches. Otherwise `window` has edges {"x":
    [a, b], "xdot": [a, b]} relative to the orbit's point `point`, and branches are followed over
    `length`. All of these are in section radii. `resolution` has `distance` and `bend` of
    `trace_manifold`. start_error and ended are the worst of all branches.

    >>> from pseudorigid import Ball, symmetric_orbits
    >>> ball = Ball(k=0.2, g=0.04)
    >>> six = symmetric_orbits(ball, 0.01, 6)
    >>> outer = {"outer": {"length": 0.1}}
    >>> coarse = {"distance": 0.05, "bend": 30}
    >>> scene_manifolds(ball, 0.01, six, 6, "hyperbolic", coarse, outer).sizes["branch"]
    12
    """
    orbit = orbit_of_type(ball, energy, periodic, type, period)
    attributes: dict[str, Any] = {}
    if branches is not None:
        extents = {side: dict(branches[side]) for side in sorted(branches)}
    else:
        radius = ball.section(energy)[1]
        centre = {name: float(orbit[name][point]) for name in ("x", "xdot")}
        edges = {name: [at + radius * edge for edge in window[name]] for name, at in centre.items()}
        attributes = {f"window_{name}": edges[name] for name in centre}
        attributes |= {f"point_{name}": at for name, at in centre.items()}
        shown = {"length": length, "window": edges["x"] + edges["xdot"]}
        extents = {"inner": shown, "outer": shown}
    lines, rows, total = [], [], 0
    for side, stable, saddle in product(extents, (False, True), range(period)):
        options = {"stable": stable, "side": side} | extents[side] | resolution
        lines.append(trace_manifold(ball, energy, orbit, saddle, **options))
        rows.append((lines[-1].sizes["vertex"], np.int8(stable), saddle, side))
        total += lines[-1].sizes["vertex"]
        if total > MOST_VERTICES_OF_SCENE:
            raise ValueError(
                f"manifolds of more than {MOST_VERTICES_OF_SCENE} points: make length shorter"
            )
    attributes["start_error"] = max(line.attrs["start_error"] for line in lines)
    if ended := [line.attrs["ended"] for line in lines if "ended" in line.attrs]:
        attributes["ended"] = min(ended)
    vertices = xr.concat(lines, "vertex", combine_attrs="override")
    dataset = vertices.assign(of_rows(_BRANCHES, rows)).assign_attrs(attributes)
    dataset["row_size"].attrs["sample_dimension"] = "vertex"
    return dataset
