"""A figure whose coordinates are pixels.

Matplotlib's axes transform coordinates by products of matrices, whose last bit depends on the
processor (fused multiply-add, BLAS kernels). That bit shows where a coordinate falls halfway
between two pixels. A Sheet rounds coordinates to values away from such places, and matplotlib then
only multiplies them by the resolution.
"""

import numpy as np
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.lines import Line2D
from matplotlib.textpath import text_to_path
from matplotlib.transforms import Bbox, TransformedBbox

from . import style
from .line_simplification import bends

POINT = style.DPI / 72  # pixels
_GRID = 256  # steps of the rasteriser in a pixel


class Sheet:
    """An empty white figure of `wide` times `high` pixels, both multiples of 75 (a quarter inch).

    Coordinates count pixels from the lower left corner; sizes of lines, marks and text are points.
    """

    def __init__(self, wide, high):
        if wide % 75 or high % 75:
            raise ValueError(f"{wide} x {high} pixels: not whole quarters of an inch")
        self.wide, self.high = wide, high
        size = (wide / style.DPI, high / style.DPI)
        self.figure = Figure(figsize=size, dpi=style.DPI, facecolor="white")

    def draw(self, across, up, clip=None, **line_style):
        """Draw a line or marks (Line2D) inside the rectangle `clip` (left, bottom, right, top)."""
        inches = self.figure.dpi_scale_trans
        across, up = snap_to_pixels(across), snap_to_pixels(up)
        if line_style.get("ls") != "none" and len(across) > 2:
            keep = bends(np.floor(across * _GRID), np.floor(up * _GRID), _GRID // 64)
            across, up = across[keep], up[keep]
        artist = Line2D(across / style.DPI, up / style.DPI, transform=inches, **line_style)
        if clip is not None:
            left, bottom, right, top = (value / style.DPI for value in clip)
            artist.set_clip_box(TransformedBbox(Bbox([[left, bottom], [right, top]]), inches))
        self.figure.add_artist(artist)

    def text(self, across, up, text, *, size, ha="left", va="center"):
        """Write horizontal text; `ha` and `va` say which side of it the coordinates are."""
        across, up = (float(snap_to_pixels(value)) / style.DPI for value in (across, up))
        inches = self.figure.dpi_scale_trans
        self.figure.text(across, up, text, ha=ha, va=va, size=size, transform=inches)


def width(text, size):
    """Return the width in pixels of `text` at `size` points."""
    font = FontProperties(size=size)
    extent = text_to_path.get_text_width_height_descent(text, font, "$" in text)
    return float(extent[0]) * POINT


def snap_to_pixels(pixels):
    """Round to a quarter step beside the rasteriser's grid, where no last bit matters.

    A last bit matters at the wholes and halves of the grid, at whole pixels, to which text and
    marks are moved, and at the sixth decimals in which SVG and PDF write points.
    """
    return (np.floor(np.asarray(pixels) * _GRID) + 0.25) / _GRID
