"""Curves where the map jumps: states whose next flight just touches the floor.

A touch in flight, f = f' = 0 for the gap f, is a state on the section's rim, s = xdot + udot = 0,
with x < -g; for x > -g the ball cannot leave the floor. So the map jumps on the image of this arc
of the rim under the inverse map, and the inverse map jumps on its image under the map; the reversor
exchanges the two curves. The arc exists for E > g^2 (1 + k/2), where the rim reaches beyond -g.
Curves are polylines, whose sides join neighbouring points.
"""

import math
from collections.abc import Callable, Sequence

import numpy as np
import xarray as xr

from pseudorigid.dynamics.ball import Ball, Rows
from pseudorigid.dynamics.periodic import symmetric_flights
from pseudorigid.dynamics.variables import ENERGY, LENGTH, SPEED, chart, described

# Share of the arc left out at its ends: at x = -g rounding decides whether the ball leaves.
_MARGIN = 2.0**-46
_FINE = 4000  # the least sides of the symmetry line, and among which jumps are looked for
_HALVINGS = 40  # of a side, after which a continuous image is as good as one point
# The map jumps across a side if, after these halvings, the image is still longer than the first
# share of the whole side's image, and longer than the second share, rounding, of the curve's.
_MIN_SIDE_SHARE, _MIN_TOTAL_SHARE = 0.01, 1e-9
_PLANE = "R, with 1/omega as unit of time"  # of lengths in the plane (x, y)
_DISTANCES = tuple(10.0**-i for i in range(2, 9))  # from the curve to where derivatives are taken
_DERIVATIVE = "largest singular value of the Jacobian in (x, y) where the flight"
_LENGTH_ERROR = "by how much it differs from what half as many sides give"


def jumps(ball: Ball, energy: float, energies: Sequence[float], sides: int) -> xr.Dataset:
    """Compute the curves where the map jumps at several energies, and a symmetry line at the first.

    The levels are `energy` and then `energies`. rim_x, rim_y are the arc of the rim on (energy,
    point), and x, y its image under the map, on which the inverse map jumps; they are NaN at levels
    without an arc, and x, y also next to a jump of the map. The map jumps on the mirror image
    (x, -y): on one side of it the next impact is near (rim_x, -rim_y), on the other near the image
    of that, the point (x, y) with the same index counted from the end. The length is that of
    Richardson's rule, and length_error includes the ends left out. Derivatives are those beside the
    middle of the curve at the first level, along its normal. There are such curves above the
    attribute first_energy.

    >>> from pseudorigid import Ball
    >>> jumps(Ball(k=0.2, g=0.04), 0.01, [0.001], 40).sizes["energy"]
    2
    """
    if sides % 4:
        raise ValueError(f"sides = {sides} is not allowed: a multiple of four")
    levels = [float(energy), *map(float, energies)]
    arcs, each_gaps = zip(*(_arc(ball, level, sides + 1) for level in levels), strict=True)
    curves, gaps = np.stack(arcs, axis=1), np.array(each_gaps)
    fine, middle, coarse = (_lengths(curves[2:], gaps, step) for step in (1, 2, 4))
    length = fine + (fine - middle) / 3.0
    error = np.abs(length - (middle + (middle - coarse) / 3.0)) + _MARGIN * length
    radii = [ball.section(level)[1] for level in levels]
    points = max(sides, _FINE)
    theta = radii[0] * math.sqrt(ball.k) / ball.g * (np.arange(points) + 0.5) / points
    lines = [chart(ball.k, *symmetric_flights(ball, energy, sign, theta)) for sign in (1.0, -1.0)]
    flight_x, flight_y = np.transpose(lines, (1, 2, 0))
    touched, missed = _derivatives(ball, energy, curves[2:, 0])
    curves[2:, :, 1:][:, gaps] = np.nan
    curve, line = ("energy", "point"), ("half_time", "branch")
    data = {
        "rim_x": (curve, curves[0], "x of grazing states that leave the floor", LENGTH),
        "rim_y": (curve, curves[1], "y of these states", SPEED),
        "x": (curve, curves[2], "x of their next impact, where the inverse jumps", LENGTH),
        "y": (curve, curves[3], "y of their next impact", SPEED),
        "energy": ("energy", levels, "energy", ENERGY),
        "radius": ("energy", radii, "the section's radius along y = 0", LENGTH),
        "length": ("energy", length, "length of the curve in (x, y)", _PLANE),
        "length_error": ("energy", error, _LENGTH_ERROR, _PLANE),
        "flight_x": (line, flight_x, "x on the symmetry line Fix RP", LENGTH),
        "flight_y": (line, flight_y, "y on that line", SPEED),
        "distance": ("distance", _DISTANCES, "distance from the curve in (x, y)", _PLANE),
        "derivative_touched": ("distance", touched, f"{_DERIVATIVE} meets the floor"),
        "derivative_missed": ("distance", missed, f"{_DERIVATIVE} just misses the floor"),
    }
    onset = ball.g * ball.g * (1.0 + 0.5 * ball.k)
    return xr.Dataset(described(data), attrs={"first_energy": onset})


def _lengths(curves: np.ndarray, gaps: np.ndarray, every: int) -> np.ndarray:
    """Return lengths of n polylines through each `every`-th point of (2, n, points), less gaps."""
    steps = np.diff(curves[:, :, ::every], axis=2)
    gap = gaps.reshape(gaps.shape[0], -1, every).max(axis=2)
    return np.nansum(np.where(gap, 0.0, np.sqrt(np.sum(steps * steps, axis=0))), axis=1)


def _arc(ball: Ball, energy: float, points: int) -> tuple[np.ndarray, np.ndarray]:
    """Return x, y of the rim's arc x < -g, then of its image (4, points), and the image's gaps."""
    centre, radius = ball.section(energy)
    k, g = ball.k, ball.g
    if not centre - radius < -g:
        return np.full((4, points), math.nan), np.zeros(points - 1, bool)
    # x = centre - radius (1 - t^2)/(1 + t^2), y = high 2 t/(1 + t^2), |t| < the t of x = -g
    high = math.sqrt(k * (1.0 + k)) * radius
    depth = (centre + g) / radius
    end = math.sqrt((1.0 - depth) / (1.0 + depth))
    each = -(-_FINE // (points - 1))  # parts of a side, of which one may jump while others are long
    last = each * (points - 1.0)
    parts = end * (1.0 - _MARGIN) * (1.0 - 2.0 * np.arange(last + 1.0) / last)
    t = parts[::each]

    def rim(t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        x = centre - radius * ((1.0 - t) * (1.0 + t) / (1.0 + t * t))
        return x, high * (2.0 * t / (1.0 + t * t))

    def image(t: np.ndarray) -> np.ndarray:
        x, y = rim(t)
        return chart(k, *ball.after((x, y / (1.0 + k), -y / (1.0 + k)))[:3])

    return np.stack([*rim(t), *image(t)]), _gaps(image, parts).reshape(-1, each).max(axis=1)


def _gaps(image: Callable[[np.ndarray], np.ndarray], parameters: np.ndarray) -> np.ndarray:
    """Return (n - 1,) whether the curve `image` jumps between neighbours of the parameters (n,)."""
    low, high = parameters[:-1], parameters[1:]
    start, end = image(low), image(high)
    sides = _distance(start, end)
    extent = np.max(np.ptp(start, axis=1))
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        point = image(middle)
        # go on with the half whose image is longer
        lower = _distance(start, point) > _distance(point, end)
        low, high = np.where(lower, low, middle), np.where(lower, middle, high)
        start, end = np.where(lower, start, point), np.where(lower, point, end)
    smallest_jump = np.maximum(_MIN_SIDE_SHARE * sides, _MIN_TOTAL_SHARE * extent)
    return _distance(start, end) > smallest_jump


def _distance(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Return the distances of points (2, n) in the maximum norm."""
    return np.max(np.abs(a - b), axis=0)


def _derivatives(ball: Ball, energy: float, curve: np.ndarray) -> np.ndarray:
    """Return the Jacobian's largest singular values at _DISTANCES from the curve's middle.

    The first row is of the side on which the flight meets the floor, the second of the other, on
    which it just misses.
    """
    middle = curve.shape[1] // 2
    if math.isnan(curve[0, middle]):
        return np.full((2, len(_DISTANCES)), math.nan)
    # the inverse map jumps on the curve, the map on its mirror image
    point, (dx, dy) = curve[:, middle], curve[:, middle + 1] - curve[:, middle - 1]
    x, y = float(point[0]), -float(point[1])
    length = math.sqrt(dx * dx + dy * dy)
    normal = dy / length, dx / length
    rows = []
    for sign in (1.0, -1.0):
        derivatives, tau = [], math.inf
        for h in _DISTANCES:
            try:
                state = ball.state_xy(x + sign * h * normal[0], y + sign * h * normal[1], energy)
            except ValueError:  # outside the section
                derivatives.append(math.nan)
                continue
            derivatives.append(_largest_singular_value(ball.chart_jacobian(*state)))
            tau = float(ball.time_to_impact(*state))
        rows.append((tau, derivatives))
    return np.array([derivatives for _, derivatives in sorted(rows)])


def _largest_singular_value(matrix: Rows) -> float:
    """Return the largest singular value of a matrix (2, 2), without LAPACK."""
    (a, b), (c, d) = matrix
    square, determinant = 0.5 * (a * a + b * b + c * c + d * d), a * d - b * c
    root = math.sqrt(max(square * square - determinant * determinant, 0.0))
    return math.sqrt(square + root)
