"""The chart of how often orbits are classified wrongly, and how many stay undecided."""

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from pseudorigid.figures.axes.panel import Axis, Panel, corner, key, letters, title
from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.sheet import Sheet

# Colour and mark of each way to tell regular orbits from chaotic ones.
_METHODS = {
    "growth, one threshold": (style.BLACK, "s"),
    "SALI (two vectors)": (style.GREEN, "D"),
    "MEGNO": (style.BLUE, "v"),
    "weighted Birkhoff average": ("#a66f00", "^"),
    "short form": ("#6a6a6a", "p"),
    "rule": (style.VERMILION, "o"),
}
_UNDECIDED = "rule: undecided"
_LOWEST = -3.3  # decade that a share of 0 is drawn at
_FRAMES, _HEIGHT, _STEP = ((135, 560), (600, 1025)), 310, 400  # pixels


@style.pinned()
def draw(scene: dict[str, Any], data: xr.Dataset) -> Figure:
    """Draw shares of wrong and undecided verdicts against impacts and time an orbit."""
    rows = data.sizes["set"]
    sheet = Sheet(style.COLUMN, _STEP * rows + 275)
    top, frames = _STEP * rows + 220, []
    ticks, limits = (3, 4, 5), (2.55, 5.15)
    up = Axis((_LOWEST, 0.1), (_LOWEST, -2, -1, 0), "", True, ("0", "1 %", "10 %", "100 %"))
    names = {"cost": "Impacts per orbit, mean", "time": "Time per orbit (impacts alone)"}
    for row, place in enumerate(data["place"].values):
        for (left, right), (cost, name) in zip(_FRAMES, names.items(), strict=True):
            across = Axis(limits, ticks, name, True)
            across = across if row == rows - 1 else across.blank()
            frame = (left, top - _HEIGHT - row * _STEP, right, top - row * _STEP)
            panel = Panel(sheet, frame, across, up if cost == "cost" else up.blank())
            frames.append(frame)
            _curves(panel, data.isel(set=row), cost)
        title(sheet, frames[-2], f"Wrong verdicts, {place}")
        corner(sheet, frames[-1], f"{data['orbits'].values[row]:,} orbits")
    letters(sheet, *frames[::2])
    entries: list[Any] = [(name, *_METHODS[name]) for name in data["name"].values]
    entries.append((_UNDECIDED, style.VERMILION, "o", True))
    key(sheet, entries, 152, columns=2, size=7.0)
    return sheet.figure


def _curves(panel: Panel, of_set: xr.Dataset, cost: str) -> None:
    """Draw the wrong verdicts of all methods, and the undecided ones of the last."""
    wrong = (of_set["missed"] + of_set["alarms"]).values
    undecided = of_set["undecided"].values
    for i, name in enumerate(of_set["name"].values):
        color, marker = _METHODS[name]
        x = of_set[cost].values[i]
        shown = undecided[i] < 0.9  # below that it has decided next to nothing
        y = np.maximum(wrong[i], 10.0**_LOWEST)
        panel.line(x[shown], y[shown], color=color, lw=0.9)
        panel.dots(x[shown], y[shown], color, marker=marker)
        if name == "rule":
            y = np.maximum(undecided[i], 10.0**_LOWEST)
            panel.line(x, y, color=color, lw=0.9, ls="--")
            panel.dots(x, y, color, marker=marker, hollow=True)
