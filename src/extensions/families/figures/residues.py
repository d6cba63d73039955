"""Residues of periodic orbits against the energy or the inertia."""

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from pseudorigid.figures.axes.limits import linear
from pseudorigid.figures.axes.panel import Window, title
from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.names import dense
from pseudorigid.figures.canvas.sheet import Sheet

from .families import LEFT, MARK, RIGHT, abscissa, keys, lines, names, resonances, stable_pieces

_RESIDUES = -0.6, 1.6


@style.pinned()
def draw(scene: dict[str, Any], families: xr.Dataset) -> Figure:
    """Draw the residues of families over one axis of E or k, in the style of their positions."""
    sheet = Sheet(style.COLUMN, 1125)
    up = linear(*_RESIDUES, 5)
    panel = Window(sheet, (LEFT, 240, RIGHT, 965), abscissa(scene), up)
    resonances((panel,), scene["parameter"], families)
    others = []
    for level in (0.0, 1.0):
        panel.line(scene["span"], [level, level], color=style.FRAME, lw=0.5)
        others.append(dense(panel.place(scene["span"], [level, level]), panel.frame))
    # Near grazing the residue grows without bound.
    residue = np.clip(0.25 * (2.0 - families["trace"].values), -50.0, 50.0)
    shown, across = lines(scene, families), families[scene["parameter"]].values
    drawn = stable_pieces(panel, families, residue, shown)
    exits = [_exits(panel, across[span], residue[span]) for span, _ in shown.values()]
    others += [places + by for places in exits for by in MARK]
    beyond = "; triangles: beyond the axis" if np.hstack(exits).size else ""
    title(sheet, panel.frame, f"Residue $(2-$trace$)/4${beyond}", 14)
    names(panel, drawn, shown, np.hstack(others))
    keys(sheet, scene, families, shown, [])
    return sheet.figure


def _exits(panel: Window, across: np.ndarray, residue: np.ndarray) -> np.ndarray:
    """Mark where a family leaves the axis of residues, and return the marks in pixels (2, n)."""
    places = []
    for end, inner, marker in ((_RESIDUES[1], 1.56, "^"), (_RESIDUES[0], -0.56, "v")):
        beyond = (residue > end) == (end > 0.0)
        i = np.flatnonzero(beyond[1:] != beyond[:-1])
        share = (end - residue[i]) / (residue[i + 1] - residue[i])
        x = across[i] + share * (across[i + 1] - across[i])
        panel.dots(x, 0.0 * x + inner, style.BLACK, 2.6, marker=marker)
        places.append(panel.place(x, 0.0 * x + inner))
    return np.hstack(places)
