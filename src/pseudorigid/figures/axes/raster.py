"""Coloured cells between axes, their scale of colours, and round ticks."""

from fractions import Fraction
from itertools import cycle

import matplotlib
import numpy as np

from ..canvas import style
from ..canvas.sheet import POINT
from .panel import Axis, log10

_SIZE = 6.0  # points: text beside a scale
_STEPS = 64  # colours of a scale
_MINOR = 1.5  # points: the length of a minor tick
_LONGEST = 7  # characters of a tick's label that have room at the left of a chart


def cells(panel, sweep, shades, table):
    """A rectangle a cell, shades (k, energy) from 0 to 1, grey where NaN.

    What is beyond has the colour of the end. They are an image of whole pixels, so that a PNG has
    each cell's colour; in a file of vectors they would weigh megabytes.
    """
    left, bottom, right, top = panel.frame
    energy, k = np.array(sweep["energy"]), np.array(sweep["k"])
    along = log10(energy) if panel.across.decades else energy
    x = _pixels(edges(along), panel.across.limits, 0, right - left)
    y = _pixels(edges(k), panel.up.limits, 0, top - bottom)
    steps = np.clip((np.nan_to_num(shades) * _STEPS).astype(np.int64), 0, _STEPS - 1)
    colors = palette(table)[steps]
    colors[np.isnan(shades)] = list(bytes.fromhex(style.GRID[1:]))
    image = np.repeat(np.repeat(colors, np.diff(y), axis=0), np.diff(x), axis=1)
    _paste(panel.sheet, left, bottom, image)


def scale(sheet, frame, largest, table):
    """The colours beside the frame, from 0 to `largest`."""
    left, right = frame[2] + 25, frame[2] + 55
    bounds = _pixels(np.arange(_STEPS + 1) / _STEPS, (0.0, 1.0), 0, frame[3] - frame[1])
    column = np.repeat(palette(table), np.diff(bounds), axis=0)
    _paste(sheet, left, frame[1], np.repeat(column[:, None], right - left, axis=1))
    for tick in ticks(0.0, largest, 5):
        y = frame[1] + tick / largest * (frame[3] - frame[1])
        sheet.draw([right, right + 2.5 * POINT], [y, y], color=style.FRAME, lw=0.6)
        text = style.number(tick)
        sheet.text(right + 4 * POINT, y, text, ha="left", va="center", size=_SIZE)


def minor(panel, across=True):
    """Short ticks without labels, of the axis up, and of the other one too."""
    left, bottom, right, top = panel.frame
    how, size = {"color": style.FRAME, "lw": 0.5}, _MINOR * POINT
    if across:
        for x in left + panel.across.between(_minor(panel.across)) * (right - left):
            panel.sheet.draw([x, x], [bottom, bottom - size], **how)
    for y in bottom + panel.up.between(_minor(panel.up)) * (top - bottom):
        panel.sheet.draw([left, left - size], [y, y], **how)


def _minor(axis):
    return decades(*axis.limits) if axis.decades else between(axis.ticks, *axis.limits)


def palette(name):
    """Colours of one of matplotlib's tables, (_STEPS, 3): red, green and blue, up to 255."""
    table = np.array(matplotlib.colormaps[name].colors)
    rows = table[(2 * np.arange(_STEPS) + 1) * len(table) // (2 * _STEPS)]
    return (rows * 255 + 0.5).astype(np.uint8)


def _paste(sheet, left, bottom, image):
    """An image (height, width, 3), lowest row first, pixel for pixel."""
    sheet.figure.figimage(image, xo=left, yo=bottom, origin="lower", zorder=0.6)


def _pixels(values, limits, start, end):
    """Whole pixels of values between limits that lie at `start` and `end`."""
    low, high = limits
    return [int(start + (value - low) / (high - low) * (end - start) + 0.5) for value in values]


def edges(values):
    """The borders between cells: halfway, and as far again outside; a single one is a unit wide."""
    if values.size == 1:
        return np.array([values[0] - 0.5, values[0] + 0.5])
    middle = 0.5 * (values[1:] + values[:-1])
    return np.concatenate([[2 * values[0] - middle[0]], middle, [2 * values[-1] - middle[-1]]])


def wider(low, high, below, above):
    """Limits around others, wider by parts of their span."""
    span = high - low
    return low - below * span, high + above * span


def linear(low, high, count, name=""):
    """An axis with about `count` round ticks; what long labels have in common goes to its name."""
    low, high = float(low), float(high)
    places = ticks(low, high, count) if count else ()
    if all(len(style.number(place)) <= _LONGEST for place in places):
        return Axis((low, high), places, name)
    power = int(f"{(high - low) / count:e}".partition("e")[2])
    unit = Fraction(10) ** power
    base = 1000 * unit * (Fraction(repr(places[0])) // (1000 * unit))
    labels = [style.number(float((Fraction(repr(place)) - base) / unit)) for place in places]
    if base:
        name = f"{name}, less {style.number(float(base))}"
    return Axis((low, high), places, rf"{name}, / $10^{{{power}}}$", labels=labels)


def ticks(low, high, count):
    """About `count` round numbers from low to high."""
    step, factors = 1e-12, cycle((2.0, 2.5, 2.0))
    while (high - low) / step > count:
        step *= next(factors)
    first = int(np.ceil(low / step - 1e-9))
    last = int(np.floor(high / step + 1e-9))
    return [float(f"{i * step:.10g}") for i in range(first, last + 1)]


def between(places, low, high):
    """Minor ticks from low to high: halfway between round numbers in equal steps."""
    if len(places) < 2:
        return []
    step = places[1] - places[0]
    halves = [places[0] + (i - 0.5) * step for i in range(len(places) + 1)]
    return [half for half in halves if low <= half <= high]


def decades(low, high):
    """Minor ticks of an axis of decades, from low to high: 2, 3, ... 9 times powers of ten."""
    logs = log10(np.arange(2, 10))
    found = [n + part for n in range(int(np.floor(low)), int(np.ceil(high))) for part in logs]
    return [float(place) for place in found if low <= place <= high]
