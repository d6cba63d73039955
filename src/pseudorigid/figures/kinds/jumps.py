"""The section in the chart (x, y): where the map jumps, islands, symmetry lines, grazing rim."""

import math

import numpy as np

from ...kernel.arithmetic import sincos
from ...kernel.compiled import jit
from ..axes.panel import Axis, Panel, corner, key
from ..axes.raster import ticks
from ..canvas import style
from ..canvas.ragged import rows
from ..canvas.sheet import POINT, Sheet

_WIDE = 825  # pixels of the large panel
_AT = 150  # its left edge
_SMALL = 270  # pixels of a small panel
MAP, INVERSE = style.VERMILION, style.BLUE


@style.pinned()
def draw(scene, jumps, orbits):
    """Return the Figure of the section, with the curves where the map and its inverse jump.

    Parameters
    ----------
    scene : dict
        `sea`: which of the orbits are grey.
    jumps, orbits : Dataset
        The artifacts of these stages.

    Returns
    -------
    Figure
        Above: the section at the first energy. Below: sections at up to three energies next to that
        at which the curves are born.
    """
    g, k = float(jumps.attrs["g"]), float(jumps.attrs["k"])
    sheet = Sheet(style.COLUMN, 1500)
    radius = float(jumps["radius"].values[0])
    half = 1.06 * radius
    top = sheet.high - 75
    frame = (_AT, top - _WIDE, _AT + _WIDE, top)
    across = Axis((g / k - half, g / k + half), tuple(ticks(g / k - half, g / k + half, 5)), "$x$")
    up = Axis((-0.54 * half, 0.54 * half), tuple(ticks(-0.54 * half, 0.54 * half, 5)))
    panel = Panel(sheet, frame, across, up, grid=False)
    _orbits(panel, orbits, set(scene["sea"]), k)
    _rim(panel, k, g / k, radius)
    _lines(panel, jumps, g / k, radius)
    _curves(panel, jumps, 0)
    entries = [
        ("the map jumps", MAP, "", False),
        ("its inverse jumps", INVERSE, "", False),
        ("grazing rim", style.BLACK, "", False),
        ("symmetry lines", style.PURPLE, "", True),
    ]
    key(sheet, entries, frame[1] - 128, 2, _AT + 10, _WIDE)
    text = r"$y=\dot{x}^{-}-k\dot{u}^{-}$"
    sheet.text(frame[0], frame[3] + 4 * POINT, text, ha="left", va="bottom", size=8.0)
    corner(sheet, frame, style.setting(scene))
    _births(sheet, jumps, k, g)
    return sheet.figure


def _orbits(panel, orbits, sea, k):
    x = orbits["x"].values
    y = orbits["xdot"].values - k * orbits["udot"].values
    spans = rows(orbits["row_size"].values)
    for index in sorted(range(len(spans)), key=lambda i: (i not in sea, i)):
        hue, size = (style.GRID, 0.7) if index in sea else (style.BACKDROP, 0.9)
        panel.dots(x[spans[index]], y[spans[index]], hue, size=size)


def _rim(panel, k, centre, radius):
    sine, cosine = _circle(720)
    high = math.sqrt(k * (1.0 + k)) * radius
    panel.line(centre + radius * cosine, high * sine, color=style.BLACK, lw=0.8, zorder=4.5)


@jit
def _fill(sine, cosine):
    for i in range(sine.size):
        sine[i], cosine[i] = sincos(2.0 * math.pi * i / (sine.size - 1))


def _circle(sides):
    sine, cosine = np.empty(sides + 1), np.empty(sides + 1)
    _fill(sine, cosine)
    return sine, cosine


def _lines(panel, jumps, centre, radius):
    how = {"color": style.PURPLE, "lw": 0.7, "ls": "--", "zorder": 4.6}
    panel.line([centre - radius, centre + radius], [0.0, 0.0], **how)
    for branch in range(jumps.sizes["branch"]):
        panel.line(jumps["flight_x"].values[:, branch], jumps["flight_y"].values[:, branch], **how)


def _curves(panel, jumps, row):
    x, y = jumps["x"].values[row], jumps["y"].values[row]
    for sign, hue in ((1.0, INVERSE), (-1.0, MAP)):
        panel.line(x, sign * y, color=hue, lw=1.2, zorder=5)


def _births(sheet, jumps, k, g):
    """Whole sections at energies above that of the birth, each in its own proportions."""
    energies = jumps["energy"].values
    born = jumps["length"].values > 0.0
    rising = [row for row in np.argsort(energies, kind="stable").tolist() if row and born[row]]
    for number, row in enumerate(rising[:3]):
        left = 60 + number * (_SMALL + 60)
        frame = (left, 60, left + _SMALL, 60 + _SMALL)
        radius = float(jumps["radius"].values[row])
        half = 1.08 * radius
        across = Axis((g / k - half, g / k + half), ())
        panel = Panel(sheet, frame, across, Axis((-0.54 * half, 0.54 * half), ()))
        _rim(panel, k, g / k, radius)
        _curves(panel, jumps, row)
        text = f"$E$ = {style.number(float(energies[row]))}"
        sheet.text(frame[0], frame[3] + 4 * POINT, text, ha="left", va="bottom", size=7.0)
