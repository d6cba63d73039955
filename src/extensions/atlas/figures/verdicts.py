"""The chart of how often orbits are classified wrongly."""

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from pseudorigid.figures.axes.panel import Axis, Panel, corner, key, letters, log10, title
from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.sheet import Sheet

# Colour and mark of each way to tell regular orbits from chaotic ones.
_METHODS = {
    "growth below 3": (style.BLACK, "s"),
    "growth, best threshold": (style.BLUE, "o"),
    "SALI (two vectors)": (style.GREEN, "D"),
    "weighted Birkhoff average": (style.ORANGE, "^"),
    "as soon as safe": (style.VERMILION, "o"),
}


@style.pinned()
def draw(scene: dict[str, Any], data: xr.Dataset) -> Figure:
    """Draw the share of wrong verdicts, with a standard error, against impacts an orbit."""
    sheet, top = Sheet(style.COLUMN, 1275), 1205
    ticks = log10(data["length"].values).tolist()
    names = [f"{length:,}" for length in data["length"].values.tolist()]
    across = Axis((2.3, 4.0), ticks, "Impacts per orbit, mean", True, names)
    up = Axis((-2.75, -0.75), (-2, -1), "", True, ("1 %", "10 %"))
    orbits, frames = data.attrs["orbits"] * data.sizes["cell"], []
    for row, axis in enumerate((across.blank(), across)):
        frame = (150, top - 420 - row * 500, 1010, top - row * 500)
        panel = Panel(sheet, frame, axis, up)
        frames.append(frame)
        panel.minor(across=False)
        title(sheet, frame, f"Wrong verdicts, {data['cells'].values[row]}")
        if row == 1:
            corner(sheet, frame, "bars: \N{PLUS-MINUS SIGN} one standard error")
        for i, name in enumerate(data["name"].values):
            color, marker = _METHODS[name]
            cost, wrong = data["cost"].values[row, i], data["wrong"].values[row, i]
            error = np.sqrt(wrong * (1.0 - wrong) / orbits)
            shown = np.maximum((wrong, wrong - error, wrong + error), 10.0 ** up.limits[0])
            panel.line(cost, shown[0], color=color, lw=0.9)
            panel.bars(cost, *shown[1:], color=color, lw=0.6)
            panel.dots(cost, shown[0], color, marker=marker)
    letters(sheet, *frames)
    entries = [(name, *_METHODS[name]) for name in data["name"].values]
    key(sheet, entries, top - 1065, columns=2, size=7.0)
    return sheet.figure
