"""The section with proved invariant curves, and the areas inside that nothing can enter."""

import numpy as np

from ...dynamics.variables import chart, states_of
from ..axes.panel import corner, key
from ..axes.section import NAME, Section
from ..canvas import style
from ..canvas.ragged_rows import rows
from ..canvas.sheet import Sheet

_LEFT, _SIDE = 150, 825  # pixels: left and width of the panel
_HATCH = 400  # lines of the shading across the section
_SEA, _SHADE = "#d4d4d4", "#f0c3a6"


@style.pinned()
def draw(scene, curves, orbits):
    """Draw orbits on the section, the proved curves, and the area inside them, shaded."""
    sheet = Sheet(style.COLUMN, 1125)
    top = sheet.high - 75
    frame = (_LEFT, top - _SIDE, _LEFT + _SIDE, top)
    radius = float(curves["radius"])
    panel = Section(sheet, frame, curves.attrs, radius, 1.06, 5, ("$x$", NAME))
    polygons = _polygons(curves)
    height = panel.high * radius
    for y in np.linspace(-height, height, _HATCH):
        for polygon in polygons:
            for ends in _inside(polygon, y):
                panel.line(ends, [y, y], color=_SHADE, lw=0.8)
    _orbits(panel, orbits, set(scene["sea"]))
    panel.rim(zorder=4.5)
    for polygon in polygons:
        panel.line(*polygon, color=style.VERMILION, lw=1.0, zorder=5)
    entries = [
        ("proved curve", style.VERMILION, "", False),
        ("no orbit enters or leaves", _SHADE, "", False),
        ("regular orbits", style.BACKDROP, "o", False),
        ("chaotic orbit", _SEA, "o", False),
    ]
    key(sheet, entries, frame[1] - 110, 2, _LEFT, _SIDE)
    corner(sheet, frame, style.setting(scene))
    return sheet.figure


def _polygons(curves):
    """Return the closed polygons as pairs of arrays x, y."""
    x, y = curves["x"].values, curves["y"].values
    ends = np.flatnonzero(np.isnan(x))
    starts = [0, *(ends[:-1] + 1)]
    return [(x[a:b], y[a:b]) for a, b in zip(starts, ends, strict=True)]


def _inside(polygon, level):
    """Return the pairs of x between which a horizontal line runs inside a polygon."""
    x, y = polygon
    above = y > level
    at = np.flatnonzero(above[1:] != above[:-1])
    crossings = np.sort(x[at] + (x[at + 1] - x[at]) * (level - y[at]) / (y[at + 1] - y[at]))
    return crossings.reshape(-1, 2)


def _orbits(panel, orbits, sea):
    x, y = chart(panel.k, *states_of(orbits))
    spans = rows(orbits)
    for index in sorted(range(len(spans)), key=lambda i: (i not in sea, i)):
        hue, size = (_SEA, 0.7) if index in sea else (style.BACKDROP, 0.9)
        panel.dots(x[spans[index]], y[spans[index]], hue, size=size)
