"""The sets of a proved graph on the section, and the connections between them."""

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from pseudorigid.figures.axes import section
from pseudorigid.figures.axes.panel import key
from pseudorigid.figures.canvas import style

_LINK = "#8fb8d8"


@style.pinned()
def draw(scene: dict[str, Any], graph: xr.Dataset, orbits: xr.Dataset) -> Figure:
    """Draw orbits, the sets, and a line for each connection between two of them."""
    panel, regular, chaotic = section.over_orbits(scene, orbits)
    corners = np.stack([graph["corner_x"].values, graph["corner_y"].values], axis=1)
    centres = corners.mean(axis=2)
    for link in zip(graph["source"].values, graph["target"].values, strict=True):
        panel.line(*centres[list(link)].T, color=_LINK, lw=0.5, zorder=5)
    chain = graph["connection"].values >= 0
    for sets, hue, wide in ((chain, style.VERMILION, 0.5), (~chain, style.BLACK, 0.9)):
        for outline in corners[sets]:
            panel.line(*np.hstack([outline, outline[:, :1]]), color=hue, lw=wide, zorder=6)
    entries = [
        ("sets at the saddles", style.BLACK, "D", True),
        ("connections", _LINK),
        ("sets on the way", style.VERMILION, "D", True, 2.2),
        *filter(None, (regular, chaotic)),
    ]
    key(panel.sheet, entries, panel.frame[1] - 128, 2, section.LEFT, section.SIDE)
    return panel.sheet.figure
