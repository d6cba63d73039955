"""Coloured cells between axes, their colour scale, and round ticks."""

from fractions import Fraction
from itertools import cycle, pairwise

import matplotlib
import numpy as np

from ..canvas import style
from ..canvas.sheet import POINT
from .panel import Axis, log10

_SIZE = 6.0  # points: text beside a colour scale
_COLOURS = 64  # of a scale
GREYS = "greys"
_LIGHTEST, _DARKEST = 250, 130  # of GREYS
_MINOR = 1.5  # points: the length of a minor tick
_LONGEST = 7  # characters of a tick label that fit at the left of a chart


def cells(panel, sweep, shades, table):
    """Draw a rectangle for each cell, coloured by shades (k, energy) from 0 to 1, grey if NaN.

    The cells are an image of whole pixels: a PNG has the exact colours, and vector files are small.
    """
    left, bottom, right, top = panel.frame
    energy, k = np.array(sweep["energy"]), np.array(sweep["k"])
    along = log10(energy) if panel.across.decades else energy
    x = _pixels(edges(along), panel.across.limits, right - left)
    y = _pixels(edges(k), panel.up.limits, top - bottom)
    steps = np.clip((np.nan_to_num(shades) * _COLOURS).astype(np.int64), 0, _COLOURS - 1)
    colors = palette(table)[steps]
    colors[np.isnan(shades)] = list(bytes.fromhex(style.GRID[1:]))
    image = np.repeat(np.repeat(colors, np.diff(y), axis=0), np.diff(x), axis=1)
    _paste(panel.sheet, left, bottom, image)


def scale(sheet, frame, largest, table):
    """Draw the colour scale beside a frame, from 0 to `largest`."""
    left, right = frame[2] + 25, frame[2] + 55
    bounds = _pixels(np.arange(_COLOURS + 1) / _COLOURS, (0.0, 1.0), frame[3] - frame[1])
    column = np.repeat(palette(table), np.diff(bounds), axis=0)
    _paste(sheet, left, frame[1], np.repeat(column[:, None], right - left, axis=1))
    for tick in ticks(0.0, largest, 5):
        y = frame[1] + tick / largest * (frame[3] - frame[1])
        sheet.draw([right, right + 2.5 * POINT], [y, y], color=style.FRAME, lw=0.6)
        text = style.number(tick)
        sheet.text(right + 4 * POINT, y, text, ha="left", va="center", size=_SIZE)


def minor(panel, across=True):
    """Draw minor ticks, without labels, at the left and, if `across`, below a panel."""
    left, bottom, right, top = panel.frame
    line_style, size = {"color": style.FRAME, "lw": 0.5}, _MINOR * POINT
    if across:
        for x in left + panel.across.between(minor_ticks(panel.across)) * (right - left):
            panel.sheet.draw([x, x], [bottom, bottom - size], **line_style)
    for y in bottom + panel.up.between(minor_ticks(panel.up)) * (top - bottom):
        panel.sheet.draw([left, left - size], [y, y], **line_style)


def minor_ticks(axis):
    """Return the middles between equally spaced ticks, or 2, 3, ... 9 times powers of ten."""
    low, high = axis.limits
    if axis.decades:
        logs = log10(np.arange(2, 10))
        values = [n + part for n in range(int(np.floor(low)), int(np.ceil(high))) for part in logs]
    else:
        steps, halves = [b - a for a, b in pairwise(axis.ticks)], range(len(axis.ticks) + 1)
        values = [axis.ticks[0] + (i - 0.5) * step for step in steps[:1] for i in halves]
    return [float(value) for value in values if low <= value <= high]


def palette(name):
    """Return colours, shape (64, 3): red, green and blue up to 255.

    `name` is that of a table of matplotlib, or GREYS, which leaves room for coloured lines.
    """
    if name == GREYS:
        levels = _LIGHTEST + (_DARKEST - _LIGHTEST) * np.arange(_COLOURS) // (_COLOURS - 1)
        return np.repeat(levels[:, None], 3, axis=1).astype(np.uint8)
    table = np.array(matplotlib.colormaps[name].colors)
    rows = table[(2 * np.arange(_COLOURS) + 1) * len(table) // (2 * _COLOURS)]
    return (rows * 255 + 0.5).astype(np.uint8)


def _paste(sheet, left, bottom, image):
    """Draw an image (height, width, 3), lowest row first, pixel for pixel."""
    sheet.figure.figimage(image, xo=left, yo=bottom, origin="lower", zorder=0.6)


def _pixels(values, limits, size):
    """Return whole pixels of values, 0 at the lower limit and `size` at the upper one."""
    low, high = limits
    return [int((value - low) / (high - low) * size + 0.5) for value in values]


def edges(values):
    """Return the borders of cells, halfway between their values; a single cell is a unit wide."""
    if values.size == 1:
        return np.array([values[0] - 0.5, values[0] + 0.5])
    middle = 0.5 * (values[1:] + values[:-1])
    return np.concatenate([[2 * values[0] - middle[0]], middle, [2 * values[-1] - middle[-1]]])


def wider(low, high, below, above):
    """Return limits that are wider by parts of their span."""
    span = high - low
    return low - below * span, high + above * span


def linear(low, high, count, name=""):
    """Return an axis with round ticks; what long labels have in common is in the name."""
    low, high = float(low), float(high)
    values = ticks(low, high, count) if count else ()
    if all(len(style.number(value)) <= _LONGEST for value in values):
        return Axis((low, high), values, name)
    power = int(f"{(high - low) / count:e}".partition("e")[2])
    unit = Fraction(10) ** power
    base = 1000 * unit * (Fraction(repr(values[0])) // (1000 * unit))
    labels = [style.number(float((Fraction(repr(value)) - base) / unit)) for value in values]
    if base:
        name = f"{name}, less {style.number(float(base))}"
    return Axis((low, high), values, rf"{name}, / $10^{{{power}}}$", labels=labels)


def ticks(low, high, count):
    """Return about `count` round numbers from low to high."""
    step, factors = 1e-12, cycle((2.0, 2.5, 2.0))
    while (high - low) / step > count:
        step *= next(factors)
    first = int(np.ceil(low / step - 1e-9))
    last = int(np.floor(high / step + 1e-9))
    return [float(f"{i * step:.10g}") for i in range(first, last + 1)]
