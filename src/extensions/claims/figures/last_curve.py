"""Greene's residues on either side of the last curve of the main island, and orbits there."""

from collections.abc import Sequence

import numpy as np
import xarray as xr

from pseudorigid.figures.axes.limits import around, decades
from pseudorigid.figures.axes.panel import Panel, corner, key, letters, log10
from pseudorigid.figures.axes.section import NAME
from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.sheet import Sheet

from . import Figure, Frame, Scene

_LEFT, _RIGHT = 150, 1005  # pixels
CRITICAL = 0.25  # residue of a periodic orbit near a curve that is about to break


@style.pinned()
def draw(scene: Scene, last_curve: xr.Dataset) -> Figure:
    """Draw residues of convergents against their period, and, below, orbits in the plane (x, y)."""
    rows = -(-last_curve.sizes["noble"] // 2)  # of a key
    extra = 75 * -(-48 * (rows - 1) // 75)
    sheet = Sheet(style.COLUMN, 1575 + 2 * extra)
    above, below = (_LEFT, 1030 + extra, _RIGHT, 1425 + extra), (_LEFT, 112, _RIGHT, 760)
    letters(sheet, above, below)
    # An orbit above the critical residue fills much of the plane.
    wide = np.abs(last_curve["residue"].values[:, -1]) > CRITICAL
    full = style.ordered(wide.size)
    hues = [style.pale(hue) if fills else hue for hue, fills in zip(full, wide, strict=True)]
    _residues(sheet, above, last_curve, full)
    _orbits(sheet, below, last_curve, hues)
    corner(sheet, below, style.setting(scene))
    names = [f"convergents of {number:.6f}" for number in last_curve["rotation"].values]
    _key(sheet, names, sheet.high - 29, full)
    periods = last_curve["period"].values[:, -1]
    names = [f"orbit from period {period:.0f}" for period in periods]
    _key(sheet, names, 850 + 48 * (rows - 1), hues)
    return sheet.figure


def _key(sheet: Sheet, names: list[str], top: float, hues: Sequence[str]) -> None:
    """Draw a key of dots in two columns from `top` down."""
    entries = [(name, hue, "o") for name, hue in zip(names, hues, strict=True)]
    key(sheet, entries, top, 2, _LEFT, _RIGHT - _LEFT)


def _residues(sheet: Sheet, frame: Frame, last_curve: xr.Dataset, hues: list[str]) -> None:
    """Draw the modulus of the residues of each number's convergents against their period."""
    periods, residues = last_curve["period"].values, last_curve["residue"].values
    size = np.abs(residues)
    ends = log10([periods.min(), periods.max()]) + np.array([-0.1, 0.1])
    ends_up = min(size.min(), CRITICAL), 10.0 * max(size.max(), CRITICAL)
    limits = np.floor(log10(ends_up)).tolist()
    up = decades(limits, "Residue, its modulus")
    panel = Panel(sheet, frame, decades(ends.tolist(), "Period"), up)
    panel.minor()
    panel.line([1.0, 1e6], [CRITICAL] * 2, color=style.BLACK, lw=0.7, ls="--")
    for i, hue in enumerate(hues):
        panel.line(periods[i], size[i], color=hue, lw=0.9)
        above = residues[i] > 0.0
        panel.dots(periods[i][above], size[i][above], hue)
        panel.dots(periods[i][~above], size[i][~above], hue, hollow=True)
    panel.note(periods.max(), CRITICAL, "critical: 1/4", shift=(0, 5), ha="right")
    if (residues <= 0.0).any():
        corner(sheet, frame, "hollow: negative")


def _orbits(sheet: Sheet, frame: Frame, last_curve: xr.Dataset, hues: list[str]) -> None:
    """Draw the orbits in the plane (x, y), the first ones on top."""
    x, y = last_curve["x"].values, last_curve["y"].values
    panel = Panel(sheet, frame, around(x, 0.04, 6, "$x$"), around(y, 0.04, 6, NAME), grid=False)
    for i in reversed(range(x.shape[0])):
        panel.dots(x[i], y[i], hues[i], size=0.9)
