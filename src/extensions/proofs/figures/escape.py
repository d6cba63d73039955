"""How far orbits get from the fixed point, against the number of impacts."""

from typing import Any

import xarray as xr
from matplotlib.figure import Figure

from pseudorigid.figures.axes.limits import decades
from pseudorigid.figures.axes.panel import Panel, key, log10
from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.sheet import POINT, Sheet

_FRAME = 135, 105, 1005, 705  # pixels


@style.pinned()
def draw(scene: dict[str, Any], escape: xr.Dataset) -> Figure:
    """Draw the largest distance so far, a line for each energy, both axes logarithmic."""
    sheet = Sheet(style.COLUMN, 825)
    sheet.text(_FRAME[0], 825 - 4 * POINT, style.setting(scene), ha="left", va="top", size=8.0)
    impact, distance = escape["impact"].values, escape["distance"].values
    low, high = (float(log10(end)[0]) for end in (distance.min(), distance.max()))
    across = decades((0.0, float(log10(impact[-1])[0])), "Number of impacts")
    up = decades((low - 0.1, high + 0.25), "Largest distance in section radii")
    panel = Panel(sheet, _FRAME, across, up)
    entries = []
    for i, (line, more) in enumerate(zip(distance, scene["beside"], strict=True)):
        hue = style.HUES[i % len(style.HUES)]
        wide = 1.1 + 0.5 * (len(distance) - 1 - i)  # all can be seen where they coincide
        panel.line(impact, line, color=hue, lw=wide)
        text = "at $E$" + (f" + {more:.10f}".rstrip("0") if more else "")
        entries.append((text, hue, "", False, wide))
    key(sheet, entries, _FRAME[3] - 30, 1, _FRAME[0] + 30, 400)
    return sheet.figure
