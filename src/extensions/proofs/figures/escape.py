"""How far orbits get from the fixed point, against the number of impacts."""

from typing import Any

import xarray as xr
from matplotlib.figure import Figure

from pseudorigid.figures.axes.limits import decades, linear
from pseudorigid.figures.axes.panel import Panel, key, log10
from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.sheet import POINT, Sheet

_LEFT, _RIGHT = 135, 985  # pixels
_COLUMNS = 3  # of the key


@style.pinned()
def draw(scene: dict[str, Any], escape: xr.Dataset) -> Figure:
    """Draw the largest distance so far on a logarithmic axis, a line for each energy."""
    room = 75 * -(-2 * (len(scene["beside"]) // _COLUMNS + 1) // 3)  # for the key
    sheet = Sheet(style.COLUMN, 825 + room)
    sheet.text(_LEFT, sheet.high - 4 * POINT, style.setting(scene), ha="left", va="top", size=8.0)
    impact, distance = escape["impact"].values, escape["distance"].values
    start = scene.get("distance", distance.min())
    low, high = (float(log10(end)[0]) for end in (min(start, distance.min()), distance.max()))
    across = linear(0.0, impact[-1], 5, "Number of impacts")
    up = decades((low - 0.1, high + 0.25), "Largest distance in section radii")
    panel = Panel(sheet, (_LEFT, 105 + room, _RIGHT, 705 + room), across, up)
    panel.line(impact[[0, -1]], [start] * 2, color=style.FRAME, lw=0.9, ls="--")
    entries = [("at the start", style.FRAME, "", True, 0.9)]
    hues = style.ordered(len(distance))
    for i, (line, more, hue) in enumerate(zip(distance, scene["beside"], hues, strict=True)):
        gap = 4.0 * i  # line widths; colours take turns where lines coincide
        dash = 4.0 * len(distance) - gap
        panel.line(impact, line, color=hue, lw=0.5, zorder=1)
        panel.line(impact, line, color=hue, lw=1.6, ls=(dash, (dash, gap)) if gap else "-")
        text = "at $E$" + (f" + {more:.10f}".rstrip("0") if more else "")
        entries.append((text, hue, "", False, 1.6))
    key(sheet, entries, room - 20, _COLUMNS, _LEFT, _RIGHT - _LEFT)
    return sheet.figure
