"""Greene's residues on either side of the last curve of the main island, and orbits there."""

from collections.abc import Sequence

import numpy as np
import xarray as xr

from pseudorigid.figures.axes.limits import decades
from pseudorigid.figures.axes.panel import Panel, corner, key, letters, log10
from pseudorigid.figures.axes.section import LEFT, SIDE, Section, large
from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.names import name_curves
from pseudorigid.figures.canvas.sheet import Sheet

from . import Figure, Frame, Scene

_NAMED = 7.0  # points: rotation numbers beside curves
CRITICAL = 0.25  # residue of a periodic orbit near a curve that is about to break


@style.pinned()
def draw(scene: Scene, last_curve: xr.Dataset) -> Figure:
    """Draw residues of convergents against their period, and, below, orbits on the section."""
    rows = -(-last_curve.sizes["noble"] // 2)  # of a key
    extra = 75 * -(-48 * (rows - 1) // 75)
    sheet = Sheet(style.COLUMN, 1725 + 2 * extra)
    above = LEFT, 1180 + extra, LEFT + SIDE, 1575 + extra
    panel = large(sheet, scene, 112 + SIDE)
    panel.rim()
    letters(sheet, above, panel.frame)
    numbers = [f"{number:.6f}" for number in last_curve["rotation"].values]
    full = style.ordered(len(numbers))
    # An orbit above the critical residue fills much of the section.
    wide = np.abs(last_curve["residue"].values[:, -1]) > CRITICAL
    hues = [style.PALE_SEA if fills else hue for hue, fills in zip(full, wide, strict=True)]
    _residues(sheet, above, last_curve, full)
    _orbits(panel, last_curve, hues, numbers)
    corner(sheet, panel.frame, style.setting(scene))
    _key(sheet, [f"convergents of {number}" for number in numbers], sheet.high - 29, full, "")
    _key(sheet, [f"orbit at {number}" for number in numbers], 1025 + 48 * (rows - 1), hues, "o")
    return sheet.figure


def _key(sheet: Sheet, names: list[str], top: float, hues: Sequence[str], mark: str) -> None:
    """Draw a key of lines, or of marks, in two columns from `top` down."""
    entries = [(name, hue, mark) for name, hue in zip(names, hues, strict=True)]
    key(sheet, entries, top, 2, LEFT, SIDE)


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


def _orbits(
    panel: Section, last_curve: xr.Dataset, hues: Sequence[str], numbers: Sequence[str]
) -> None:
    """Draw the orbits, the sea first, and name those that do not fill it."""
    curves = [*zip(last_curve["x"].values, last_curve["y"].values, hues, numbers, strict=True)]
    curves.sort(key=lambda curve: curve[2] == style.PALE_SEA)
    for x, y, hue, _ in reversed(curves):
        panel.dots(x, y, hue, size=0.7 if hue == style.PALE_SEA else 0.9)
    pixels = [np.array(panel.place(x, y)) for x, y, *_ in curves]
    named = [curve for curve in curves if curve[2] != style.PALE_SEA]
    colors, texts = ([curve[i] for curve in named] for i in (2, 3))
    name_curves(panel.sheet, pixels, texts, colors, panel.frame, _NAMED)
