"""Coloured cells between axes, their scale of colours, and round ticks."""

import matplotlib
import numpy as np

from ..canvas import style
from ..canvas.sheet import POINT
from .panel import log10

_SIZE = 6.0  # points: text beside a scale
_STEPS = 64  # colours of a scale


def cells(panel, sweep, shades, table):
    """A rectangle a cell, shades (k, energy) from 0 to 1, grey where NaN."""
    palette = colors(table)
    left, bottom, right, top = panel.frame
    energy, k = np.array(sweep["energy"]), np.array(sweep["k"])
    along = log10(energy) if panel.across.decades else energy
    x = _pixels(edges(along), panel.across.limits, left, right)
    y = _pixels(edges(k), panel.up.limits, bottom, top)
    for row in range(k.size):
        for column in range(energy.size):
            shade = shades[row, column]
            color = style.GRID if np.isnan(shade) else palette[min(int(shade * _STEPS), _STEPS - 1)]
            _fill(panel.sheet, x[column], y[row], x[column + 1], y[row + 1], color)


def scale(sheet, frame, largest, table):
    """The colours beside the frame, from 0 to `largest`."""
    left, right = frame[2] + 25, frame[2] + 55
    bounds = _pixels(np.arange(_STEPS + 1) / _STEPS, (0.0, 1.0), frame[1], frame[3])
    for i, color in enumerate(colors(table)):
        _fill(sheet, left, bounds[i], right, bounds[i + 1], color)
    for tick in ticks(0.0, largest, 5):
        y = frame[1] + tick / largest * (frame[3] - frame[1])
        sheet.draw([right, right + 2.5 * POINT], [y, y], color=style.FRAME, lw=0.6)
        text = style.number(tick)
        sheet.text(right + 4 * POINT, y, text, ha="left", va="center", size=_SIZE)


def colors(name):
    """_STEPS colours of one of matplotlib's tables, as #rrggbb."""
    table = matplotlib.colormaps[name].colors
    rows = [table[(2 * i + 1) * len(table) // (2 * _STEPS)] for i in range(_STEPS)]
    return ["#" + "".join(f"{int(part * 255 + 0.5):02x}" for part in row) for row in rows]


def _fill(sheet, left, bottom, right, top, color):
    """A rectangle between whole pixels, as a line of its height."""
    middle = (bottom + top) / 2
    height = (top - bottom) / POINT
    sheet.draw([left, right], [middle, middle], lw=height, color=color, zorder=0.6, snap=False)


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


def ticks(low, high, count):
    """About `count` round numbers from low to high."""
    step, factors = 1e-12, (2.0, 2.5, 2.0)
    i = 0
    while (high - low) / step > count:
        step *= factors[i % 3]
        i += 1
    first = int(np.ceil(low / step - 1e-9))
    last = int(np.floor(high / step + 1e-9))
    return [float(f"{i * step:.10g}") for i in range(first, last + 1)]
