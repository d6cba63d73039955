"""Coloured cells between axes, and their colour scale."""

import math
from collections.abc import Sequence

import matplotlib
import numpy as np

from ..canvas import style
from ..canvas.sheet import POINT, Sheet
from .limits import ticks
from .panel import Panel

_SIZE = 6.0  # points: text beside a colour scale
_COLOURS = 64  # of a scale
_ROOTED = 0, 0.01, 0.03, 0.1, 0.2, 0.3, 0.5, 1  # ticks of a scale that is even in the root
GREYS = "greys"
_LIGHTEST, _DARKEST = 252, 190  # of GREYS


def cells(panel: Panel, x: np.ndarray, y: np.ndarray, shades: np.ndarray, table: str) -> None:
    """Draw a rectangle for each cell, coloured by shades (y, x) from 0 to 1, grey if NaN.

    `x` and `y` are the cells' edges, in the numbers of the axes. The cells are an image of whole
    pixels: a PNG has the exact colours, and vector files are small.
    """
    left, bottom, right, top = map(int, panel.frame)
    columns = _pixels(x, panel.across.limits, right - left)
    lines = _pixels(y, panel.up.limits, top - bottom)
    steps = np.clip((np.nan_to_num(shades) * _COLOURS).astype(np.int64), 0, _COLOURS - 1)
    colors = palette(table)[steps]
    colors[np.isnan(shades)] = list(bytes.fromhex(style.GRID[1:]))
    image = np.repeat(np.repeat(colors, np.diff(lines), axis=0), np.diff(columns), axis=1)
    paste(panel.sheet, left, bottom, image)


def scale(
    sheet: Sheet, frame: Sequence[int], largest: float, table: str, root: bool = False
) -> None:
    """Draw the colour scale beside a frame, from 0 to `largest`, even in the `root` if asked."""
    _, bottom, edge, top = map(int, frame)
    left, right = edge + 25, edge + 55
    bounds = _pixels(np.arange(_COLOURS + 1) / _COLOURS, (0.0, 1.0), top - bottom)
    column = np.repeat(palette(table), np.diff(bounds), axis=0)
    paste(sheet, left, bottom, np.repeat(column[:, None], right - left, axis=1))
    for tick in [at for at in _ROOTED if at <= largest] if root else ticks(0.0, largest, 5):
        share = tick / largest
        y = bottom + (math.sqrt(share) if root else share) * (top - bottom)
        sheet.draw([right, right + 2.5 * POINT], [y, y], color=style.FRAME, lw=0.6)
        text = style.number(tick)
        sheet.text(right + 4 * POINT, y, text, size=_SIZE)


def palette(name: str) -> np.ndarray:
    """Return colours, shape (64, 3): red, green and blue up to 255.

    `name` is that of a table of matplotlib, or GREYS, which leaves room for coloured lines.
    """
    if name == GREYS:
        levels = _LIGHTEST + (_DARKEST - _LIGHTEST) * np.arange(_COLOURS) // (_COLOURS - 1)
        return np.repeat(levels[:, None], 3, axis=1).astype(np.uint8)
    table = matplotlib.colormaps[name]
    rows = table((2 * np.arange(_COLOURS) + 1) * table.N // (2 * _COLOURS))
    return (rows[:, :3] * 255 + 0.5).astype(np.uint8)


def paste(sheet: Sheet, left: int, bottom: int, image: np.ndarray) -> None:
    """Draw an image (height, width, 3), lowest row first, pixel for pixel."""
    sheet.figure.figimage(image, xo=left, yo=bottom, origin="lower", zorder=0.6)


def _pixels(values: np.ndarray, limits: Sequence[float], size: int) -> list[int]:
    """Return whole pixels of values, 0 up to the lower limit and `size` from the upper one on."""
    low, high = limits
    return [int((value - low) / (high - low) * size + 0.5) for value in np.clip(values, low, high)]
