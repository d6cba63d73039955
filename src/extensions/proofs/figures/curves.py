"""The section with proved invariant curves, and the areas inside that nothing can enter."""

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from pseudorigid.figures.axes import section
from pseudorigid.figures.axes.panel import key
from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.sheet import unbroken_runs

_HATCH = 120  # lines of the hatching across the section
_THIN = 0.35  # points: their width


@style.pinned()
def draw(scene: dict[str, Any], curves: xr.Dataset, orbits: xr.Dataset) -> Figure:
    """Draw orbits, proved curves, their hatched insides, and points inside no invariant circle."""
    panel, regular, chaotic = section.over_orbits(scene, orbits)
    x, y = curves["x"].values, curves["y"].values
    polygons = [(x[run], y[run]) for run in unbroken_runs(np.isnan(x))]
    height = panel.high * panel.radius
    for y in np.linspace(-height, height, _HATCH):
        for polygon in polygons:
            for ends in _inside(polygon, y):
                panel.line(ends, [y, y], color=style.VERMILION, lw=_THIN, zorder=1)
    for polygon in polygons:
        panel.line(*polygon, color=style.VERMILION, lw=1.0, zorder=5)
    saddles = curves["saddle_x"].values, curves["saddle_y"].values
    panel.dots(*saddles, style.BLACK, size=2.8)
    entries = [
        ("proved curve", style.VERMILION),
        ("no orbit enters or leaves", style.VERMILION, "", False, _THIN),
        ("inside no invariant circle", style.BLACK, "o") if saddles[0].size else None,
        regular,
        chaotic,
    ]
    entries = [entry for entry in entries if entry]
    key(panel.sheet, entries, panel.frame[1] - 128, 2, section.LEFT, section.SIDE)
    return panel.sheet.figure


def _inside(polygon: tuple[np.ndarray, np.ndarray], level: float) -> np.ndarray:
    """Return the pairs of x between which a horizontal line runs inside a polygon."""
    x, y = polygon
    above = y > level
    at = np.flatnonzero(above[1:] != above[:-1])
    crossings = np.sort(x[at] + (x[at + 1] - x[at]) * (level - y[at]) / (y[at + 1] - y[at]))
    return crossings.reshape(-1, 2)
