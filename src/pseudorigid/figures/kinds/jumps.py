"""The section in the chart (x, y): jumps of the map, orbits, symmetry lines, grazing rim."""

import numpy as np

from ...dynamics.variables import chart, states_of
from ..axes.panel import corner, key, vacant
from ..axes.section import NAME, Section
from ..canvas import style
from ..canvas.ragged_rows import rows
from ..canvas.sheet import POINT, Sheet

_LEFT, _LARGE, _SMALL = 150, 825, 270  # pixels: left of the large panel, sides of the panels
MAP, INVERSE = style.VERMILION, style.BLUE
_SEA = "#d4d4d4"


@style.pinned()
def draw(scene, jumps, orbits):
    """Draw the section with the jumps of the map and its inverse, and further energies below."""
    sheet = Sheet(style.COLUMN, 1500)
    top = sheet.high - 75
    frame = (_LEFT, top - _LARGE, _LEFT + _LARGE, top)
    radius = float(jumps["radius"].values[0])
    panel = Section(sheet, frame, jumps.attrs, radius, 1.06, 5, ("$x$", NAME))
    _orbits(panel, orbits, set(scene["sea"]))
    panel.rim(zorder=4.5)
    _symmetry_lines(panel, jumps)
    _curves(panel, jumps, 0)
    entries = [
        ("the map jumps", MAP, "", False),
        ("its inverse jumps", INVERSE, "", False),
        ("regular orbits", style.BACKDROP, "o", False),
        ("grazing rim", style.BLACK, "", False),
        ("symmetry lines", style.PURPLE, "", True),
        ("chaotic orbit", _SEA, "o", False),
    ]
    key(sheet, entries, frame[1] - 128, 3, _LEFT - 50, _LARGE + 60)
    corner(sheet, frame, style.setting(scene))
    _births(sheet, jumps)
    return sheet.figure


def _orbits(panel, orbits, sea):
    x, y = chart(panel.k, *states_of(orbits))
    spans = rows(orbits)
    for index in sorted(range(len(spans)), key=lambda i: (i not in sea, i)):
        hue, size = (_SEA, 0.7) if index in sea else (style.BACKDROP, 0.9)
        panel.dots(x[spans[index]], y[spans[index]], hue, size=size)


def _symmetry_lines(panel, jumps):
    dashes = {"color": style.PURPLE, "lw": 0.7, "ls": "--", "zorder": 4.6}
    ends = [panel.centre - panel.radius, panel.centre + panel.radius]
    panel.line(ends, [0.0, 0.0], **dashes)
    for x, y in zip(jumps["flight_x"].values.T, jumps["flight_y"].values.T, strict=True):
        panel.line(x, y, **dashes)


def _curves(panel, jumps, row):
    x, y = jumps["x"].values[row], jumps["y"].values[row]
    for sign, hue in ((1.0, INVERSE), (-1.0, MAP)):
        panel.line(x, sign * y, color=hue, lw=1.2, zorder=5)


def _births(sheet, jumps):
    """Draw whole sections at energies above that of the birth, each in its own proportions."""
    energies = jumps["energy"].values
    born = jumps["length"].values > 0.0
    rising = [row for row in np.argsort(energies, kind="stable").tolist() if row and born[row]]
    if not rising:
        text = f"no further energy above $E$ = {jumps.attrs['first_energy']:.6g}, where jumps begin"
        vacant(sheet, (_LEFT, 60, _LEFT + _LARGE, 60 + _SMALL), text)
    for number, row in enumerate(rising[:3]):
        left = 60 + number * (_SMALL + 60)
        frame = (left, 60, left + _SMALL, 60 + _SMALL)
        radius = float(jumps["radius"].values[row])
        panel = Section(sheet, frame, jumps.attrs, radius, 1.08)
        panel.rim(zorder=4.5)
        _curves(panel, jumps, row)
        text = f"$E$ = {style.number(float(energies[row]))}"
        sheet.text(frame[0], frame[3] + 4 * POINT, text, ha="left", va="bottom", size=7.0)
