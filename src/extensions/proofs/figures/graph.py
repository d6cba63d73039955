"""The sets of a proved graph on the section, and the matrix of the connections between them."""

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from pseudorigid.figures.axes import section
from pseudorigid.figures.axes.panel import Axis, Panel, key, letters
from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.names import dense, name_curves
from pseudorigid.figures.canvas.sheet import Sheet

_HIGH = 2025  # pixels
_MATRIX = 240, 140, 885, 785  # pixels: left, bottom, right, top of the lower panel
_NAMED = 6.0  # points: numbers of sets


@style.pinned()
def draw(scene: dict[str, Any], graph: xr.Dataset, orbits: xr.Dataset) -> Figure:
    """Draw orbits and the sets, and below a mark for each connection between two saddles.

    The sets at saddles are numbered from left to right, from below where two have the same x.
    """
    panel, regular, chaotic = section.over_orbits(scene, orbits, _HIGH)
    corners = np.stack([graph["corner_x"].values, graph["corner_y"].values], axis=1)
    on_the_way = graph["connection"].values >= 0
    saddles = np.flatnonzero(~on_the_way)
    x, y = corners[saddles].mean(axis=2).T
    saddles = saddles[np.lexsort([y, x.round(6)])]
    drawn = []
    for sets, hue, wide in (
        (np.flatnonzero(on_the_way), style.VERMILION, 0.5), (saddles, style.BLACK, 0.9)
    ):  # fmt: skip
        for outline in corners[sets]:
            line = np.hstack([outline, outline[:, :1]])
            panel.line(*line, color=hue, lw=wide, zorder=6)
            drawn.append(dense(panel.place(*line), panel.frame))
    curves = [*drawn[-len(saddles) :], *drawn[: -len(saddles)]]
    numbers = [f"{i + 1}" for i in range(len(saddles))]
    hues = [style.BLACK] * len(saddles)
    name_curves(panel.sheet, curves, numbers, hues, panel.frame, _NAMED)
    entries = [
        ("sets at the saddles", style.BLACK, "D", True),
        ("sets on the way", style.VERMILION, "D", True, 2.2),
        *filter(None, (regular, chaotic)),
    ]
    key(panel.sheet, entries, panel.frame[1] - 128, 2, section.LEFT, section.SIDE)
    place = {int(index): i + 1 for i, index in enumerate(saddles)}
    source, target = ([place[int(i)] for i in graph[end].values] for end in ("source", "target"))
    letters(panel.sheet, panel.frame, _matrix(panel.sheet, len(saddles), source, target).frame)
    return panel.sheet.figure


def _matrix(sheet: Sheet, count: int, source: list[int], target: list[int]) -> Panel:
    """Draw a mark for each connection, in the column where it begins and the row where it ends."""
    ticks = [i for i in range(1, count + 1) if i == 1 or i % 5 == 0]
    ends = 0.0, count + 1.0
    across, up = Axis(ends, ticks, "from the set"), Axis(ends, ticks, "to the set")
    panel = Panel(sheet, _MATRIX, across, up)
    panel.dots(source, target, style.BLUE, 3.4, marker="s")
    return panel
