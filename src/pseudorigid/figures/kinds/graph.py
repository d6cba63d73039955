"""The sets of a proved graph on the section, and the connections between them."""

import numpy as np

from ...dynamics.variables import chart, states_of
from ..axes.panel import corner, key
from ..axes.section import NAME, Section
from ..canvas import style
from ..canvas.sheet import Sheet

_LEFT, _SIDE = 150, 825  # pixels: left and width of the panel
_SEA, _LINK = "#d4d4d4", "#8fb8d8"


@style.pinned()
def draw(scene, graph, orbits):
    """Draw an orbit of the sea, the sets, and a line for each connection between two of them."""
    sheet = Sheet(style.COLUMN, 1125)
    top = sheet.high - 75
    frame = (_LEFT, top - _SIDE, _LEFT + _SIDE, top)
    panel = Section(sheet, frame, graph.attrs, float(graph["radius"]), 1.06, 5, ("$x$", NAME))
    x, y = chart(panel.k, *states_of(orbits))
    panel.dots(x, y, _SEA, size=0.7)
    panel.rim(zorder=4.5)
    corners = np.stack([graph["corner_x"].values, graph["corner_y"].values], axis=1)
    centres = corners.mean(axis=2)
    for link in zip(graph["source"].values, graph["target"].values, strict=True):
        panel.line(*centres[list(link)].T, color=_LINK, lw=0.5, zorder=5)
    chain = graph["connection"].values >= 0
    for sets, hue, wide in ((chain, style.BLUE, 0.4), (~chain, style.VERMILION, 1.0)):
        for outline in corners[sets]:
            panel.line(*np.hstack([outline, outline[:, :1]]), color=hue, lw=wide, zorder=6)
    entries = [
        ("sets at the saddles", style.VERMILION, "", False),
        ("connections", _LINK, "", False),
        ("sets on the way", style.BLUE, "", False),
        ("chaotic orbit", _SEA, "o", False),
    ]
    key(sheet, entries, frame[1] - 110, 2, _LEFT, _SIDE)
    corner(sheet, frame, style.setting(scene))
    return sheet.figure
