"""How far orbits get from the fixed point: at a resonance where it is unstable, and beside it."""

import math

import numpy as np
import xarray as xr

from pseudorigid.dynamics import fixed_point
from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.variables import ENERGY, LENGTH, RADIUS, SPEED, chart, described
from pseudorigid.kernel.arithmetic import sincos


def escape(
    ball: Ball, energy: float, beside: list[float], distance: float, orbits: int, impacts: int
) -> xr.Dataset:
    """Follow orbits that start on a circle around the fixed point, at energies beside a given one.

    Distances are those in (x, y = xdot - k udot), in section radii. The variable distance is the
    largest one of all orbits up to a number of impacts; start_x and start_y are the start of the
    orbit that gets farthest. ValueError is raised for a circle that leaves the section.

    >>> data = escape(Ball(k=0.2, g=0.04), 0.01, [0.0], 0.1, 8, 100)
    >>> bool(0.1 <= data["distance"].values.max() < 0.3)
    True
    """
    eighths = {m << e >> 3 for e in range(25) for m in range(8, 16)}  # of octaves
    counts = np.array(sorted({n for n in eighths if n < impacts} | {impacts}))
    angles = [2.0 * math.pi * i / orbits for i in range(orbits)]
    sine, cosine = np.array([sincos(angle) for angle in angles]).T
    furthest, starts = [], []
    for level in energy + np.array(beside):
        x0 = ball.g * fixed_point.numbers(ball.k, level / ball.g**2)[0]
        radius = ball.section(level)[1]
        x = x0 + distance * radius * cosine
        y = distance * radius * sine
        out = ball.history(ball.state_xy(x, y, level), impacts)
        after = chart(ball.k, *np.moveaxis(out[..., :3], -1, 0))
        across, up = (after[0] - x0) / radius, after[1] / radius
        away = np.sqrt(across * across + up * up)
        first = int(np.argmax(away.max(axis=1)))
        furthest.append(np.maximum.accumulate(away.max(axis=0))[counts - 1])
        starts.append((x[first], y[first]))
    x, y = np.array(starts).T
    table = {
        "energy": ("energy", energy + np.array(beside), "total energy", ENERGY),
        "impact": ("impact", counts, "number of impacts"),
        "distance": (("energy", "impact"), np.array(furthest), "largest distance so far", RADIUS),
        "start_x": ("energy", x, "x of the start of the orbit that gets farthest", LENGTH),
        "start_y": ("energy", y, "y = xdot - k udot of that start", SPEED),
    }
    return xr.Dataset(described(table))
