"""Residues of periodic orbits against the energy or the inertia."""

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from pseudorigid.figures.axes.limits import linear
from pseudorigid.figures.axes.panel import Window, title
from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.sheet import Sheet

from .families import LEFT, RIGHT, abscissa, keys, lines, names, resonances, stable_pieces

_RESIDUES = -0.6, 1.6


@style.pinned()
def draw(scene: dict[str, Any], families: xr.Dataset) -> Figure:
    """Draw the residues of families over one axis of E or k, in the style of their positions."""
    sheet = Sheet(style.COLUMN, 1125)
    up = linear(*_RESIDUES, 5)
    panel = Window(sheet, (LEFT, 240, RIGHT, 965), abscissa(scene), up)
    resonances((panel,), scene["parameter"], families)
    for level in (0.0, 1.0):
        panel.line(scene["span"], [level, level], color=style.FRAME, lw=0.5)
    # Near grazing the residue grows without bound.
    residue = np.clip(0.25 * (2.0 - families["trace"].values), -50.0, 50.0)
    shown, across, leaves = lines(scene, families), families[scene["parameter"]].values, 0
    for span, _, hue in shown.values():
        stable_pieces(panel, families, residue, span, hue)
        leaves += _exits(panel, across[span], residue[span], hue)
    beyond = "; triangles: beyond the axis" if leaves else ""
    title(sheet, panel.frame, f"Residue $(2-$trace$)/4${beyond}", 14)
    names(panel, across, residue, shown, np.empty((2, 0)))
    keys(sheet, scene, families, shown, [])
    return sheet.figure


def _exits(panel: Window, across: np.ndarray, residue: np.ndarray, hue: str) -> int:
    """Mark where a family leaves the axis of residues, and return how often it does."""
    count = 0
    for end, inner, marker in ((_RESIDUES[1], 1.56, "^"), (_RESIDUES[0], -0.56, "v")):
        beyond = (residue > end) == (end > 0.0)
        i = np.flatnonzero(beyond[1:] != beyond[:-1])
        share = (end - residue[i]) / (residue[i + 1] - residue[i])
        x = across[i] + share * (across[i + 1] - across[i])
        panel.dots(x, 0.0 * x + inner, hue, 2.6, marker=marker)
        count += i.size
    return count
