"""A figure whose coordinates are pixels.

Matplotlib's axes transform coordinates by products of matrices, whose last bit depends on the
processor (fused multiply-add, BLAS kernels). That bit shows where a coordinate falls halfway
between two pixels. A Sheet rounds coordinates to values away from such places, and matplotlib then
only multiplies them by the resolution.

Where two edges of a line are almost parallel, matplotlib's rasteriser joins them at the
intersection of two almost parallel lines. The last bit of a product then decides the shade of a
pixel, and that bit depends on the processor: on aarch64 the rasteriser is compiled with fused
multiply-add. A Sheet therefore leaves out the vertices on straight pieces of a line.
"""

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
from matplotlib.cbook import is_math_text
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.lines import Line2D
from matplotlib.textpath import text_to_path
from matplotlib.transforms import Bbox, TransformedBbox
from numpy.typing import ArrayLike

from . import style

POINT = style.DPI / 72  # pixels
LONGEST = 4  # largest ratio of a figure's sides
_GRID = 256  # steps of the rasteriser in a pixel
_MOST_SIDES = 5000  # of a line that matplotlib strokes at once without slowing down
_AHEAD = 64  # vertices from a kept one to the one that defines the direction u in _end_of_piece
_SAFETY = 1.0 - 1e-6  # factor on the tolerance; rounding errors of slopes are far smaller


class Sheet:
    """An empty white figure of `wide` times `high` pixels, both multiples of 75 (a quarter inch).

    Coordinates count pixels from the lower left corner; sizes of lines, marks and text are points.
    Raises ValueError if one side is more than four times as long as the other.
    """

    def __init__(self, wide: int, high: int) -> None:
        if wide % 75 or high % 75:
            raise ValueError(f"{wide} x {high} pixels: not whole quarters of an inch")
        if max(wide, high) > LONGEST * min(wide, high):
            raise ValueError(f"{wide} x {high} pixels: one side is over {LONGEST} times the other")
        self.wide, self.high = wide, high
        size = (wide / style.DPI, high / style.DPI)
        self.figure = Figure(figsize=size, dpi=style.DPI, facecolor="white")

    def draw(self, across: Any, up: Any, clip: Any = None, **line_style: Any) -> None:
        """Draw a line or marks (Line2D) inside the rectangle `clip` (left, bottom, right, top)."""
        inches = self.figure.dpi_scale_trans
        across, up = snap_to_pixels(across), snap_to_pixels(up)
        if line_style.get("ls") != "none" and len(across) > 2:
            # vertices within 1/64 pixel of a straight piece are left out
            keep = bends(np.floor(across * _GRID), np.floor(up * _GRID), _GRID // 64)
            across, up = across[keep], up[keep]
        artist = Line2D(across / style.DPI, up / style.DPI, transform=inches, **line_style)
        if clip is not None:
            left, bottom, right, top = (value / style.DPI for value in clip)
            artist.set_clip_box(TransformedBbox(Bbox([[left, bottom], [right, top]]), inches))
        self.figure.add_artist(artist)

    def dots(
        self, across: Any, up: Any, color: Any, size: float, hollow: bool = False, **line_style: Any
    ) -> None:
        """Draw marks of `size` points, filled or hollow dots unless the style says otherwise."""
        edge = {"mfc": "white", "mec": color, "mew": 0.7} if hollow else {"mew": 0}
        line_style = {"marker": "o"} | edge | line_style
        self.draw(across, up, ls="none", ms=size, color=color, **line_style)

    def text(
        self, x: float, y: float, text: str, size: float, ha: str = "left", va: str = "center",
        color: str = style.BLACK,
    ) -> None:  # fmt: skip
        """Write horizontal text at (x, y), in `color` if that is dark enough, else in its ink.

        `ha` and `va` are its alignment, as in matplotlib.
        """
        x, y = (float(snap_to_pixels(value)) / style.DPI for value in (x, y))
        inches = self.figure.dpi_scale_trans
        ink = style.ink(color)
        self.figure.text(x, y, text, ha=ha, va=va, size=size, color=ink, transform=inches)


def width(text: str, size: float) -> float:
    """Return the width in pixels of `text` at `size` points."""
    font = FontProperties(size=size)
    extent = text_to_path.get_text_width_height_descent(text, font, is_math_text(text))
    return float(extent[0]) * POINT


def snap_to_pixels(pixels: Any) -> np.ndarray:
    """Round down to the rasteriser's grid, plus a quarter of its step, where no last bit matters.

    A last bit matters at the wholes and halves of the grid, at whole pixels, to which text and
    marks are moved, and at the sixth decimals in which SVG and PDF write points.
    """
    return (np.floor(np.asarray(pixels) * _GRID) + 0.25) / _GRID


def unbroken_runs(gap: np.ndarray) -> list[slice]:
    """Return a slice for each run of consecutive indices at which `gap` is false."""
    return np.ma.clump_unmasked(np.ma.array(gap, mask=gap)) if gap.size else []


def pieces(*coordinates: np.ndarray) -> Iterator[list[np.ndarray]]:
    """Yield the coordinates of each part of a line without NaN.

    Parts of more than _MOST_SIDES sides are cut into pieces, which share a vertex.
    """
    for run in unbroken_runs(np.any(np.isnan(coordinates), axis=0)):
        for first in range(run.start, max(run.stop - 1, run.start + 1), _MOST_SIDES):
            span = slice(first, min(first + _MOST_SIDES + 1, run.stop))
            yield [coordinate[span] for coordinate in coordinates]


def bends(across: ArrayLike, up: ArrayLike, tolerance: float) -> list[int]:
    """Return the indices of the vertices of a line that are kept; both ends are.

    The line through these passes the other vertices within `tolerance`, which is at least 1.
    Coordinates are whole numbers.
    """
    x, y = np.asarray(across, dtype=np.int64), np.asarray(up, dtype=np.int64)
    keep, xs, ys = [0], x.tolist(), y.tolist()
    while keep[-1] < len(x) - 1:
        keep.append(_end_of_piece(x, y, xs, ys, keep[-1], tolerance))
    return keep


def _end_of_piece(
    x: np.ndarray, y: np.ndarray, xs: list[int], ys: list[int], first: int, tolerance: float
) -> int:
    """Return the last index such that `_passes` holds for the chords from `first` up to there.

    Most chords are accepted without a look at each vertex between. Let (u, v) be the coordinates of
    a vertex along and across the chord from `first` to the vertex _AHEAD of it, times this chord's
    length. A chord of slope m = v/u passes a vertex within the tolerance if |v - m u| is at most
    the tolerance times that length, so that each vertex bounds m, by `least` and `most`. The vertex
    lies beside the chord, too, if |v| < u/2, |m| < 1/2 and u + |v m| is at most the chord's own u.
    """
    x0, y0, ahead = xs[first], ys[first], min(first + _AHEAD, len(xs) - 1)
    du, dv = xs[ahead] - x0, ys[ahead] - y0
    near = _SAFETY * tolerance * math.sqrt(du * du + dv * dv)
    least, most, farthest, widest = -0.5, 0.5, 0, 0
    for i in range(first + 1, len(xs)):
        wide, high = xs[i] - x0, ys[i] - y0
        u, v = wide * du + high * dv, high * du - wide * dv
        if i > first + 1:
            slope = v / u if u > 0 else math.nan
            accepted = least <= slope <= most and farthest + widest * abs(slope) < u - 1
            if not (accepted or _passes(x, y, first, i, tolerance)):
                return i - 1
        if 2 * abs(v) < u:
            least, most = max(least, (v - near) / u), min(most, (v + near) / u)
            farthest, widest = max(farthest, u), max(widest, abs(v))
        else:
            least = math.inf
    return len(xs) - 1


def _passes(x: np.ndarray, y: np.ndarray, first: int, last: int, tolerance: float) -> bool:
    """Return whether the vertices between two lie beside their chord, within the tolerance."""
    inner = slice(first + 1, last)
    wide, high = x[last] - x[first], y[last] - y[first]
    dx, dy = x[inner] - x[first], y[inner] - y[first]
    length_squared = wide * wide + high * high
    along = dx * wide + dy * high
    off = np.abs(dx * high - dy * wide)
    near = off <= tolerance * np.sqrt(float(length_squared))
    between = (along >= 0) & (along <= length_squared)
    return bool(length_squared > 0 and (near & between).all())
