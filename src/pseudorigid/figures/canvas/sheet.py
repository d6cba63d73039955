"""A figure addressed in pixels, so that its bits are decided here and not in matplotlib's matrices.

Matplotlib's axes send every coordinate through products of matrices, whose last bit depends on the
processor (fused multiply-add, BLAS kernels); where a coordinate falls halfway between two pixels,
that bit shows. Here a coordinate is rounded well away from such places and then only multiplied by
the resolution.
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
_GRID = 256  # of a pixel: the rasteriser's own resolution


class Sheet:
    """An empty white figure.

    Coordinates count pixels from the lower left corner; sizes of lines, marks and text are points.

    Parameters
    ----------
    wide, high : int
        In pixels, multiples of 75 (a quarter inch).

    Raises
    ------
    ValueError
        Other sizes.
    """

    def __init__(self, wide, high):
        if wide % 75 or high % 75:
            raise ValueError(f"{wide} x {high} pixels: not whole quarters of an inch")
        self.wide, self.high = wide, high
        size = (wide / style.DPI, high / style.DPI)
        self.figure = Figure(figsize=size, dpi=style.DPI, facecolor="white")

    def draw(self, across, up, clip=None, **how):
        """Draw a line or marks.

        Parameters
        ----------
        across, up : array_like, shape (n,)
        clip : tuple, optional
            (left, bottom, right, top) of the rectangle outside which nothing is drawn.
        **how
            Of matplotlib's Line2D.
        """
        inches = self.figure.dpi_scale_trans
        across, up = snap_to_pixels(across), snap_to_pixels(up)
        if how.get("ls") != "none" and len(across) > 2:
            keep = bends(np.floor(across * _GRID), np.floor(up * _GRID), _GRID // 64)
            across, up = across[keep], up[keep]
        artist = Line2D(across / style.DPI, up / style.DPI, transform=inches, **how)
        if clip is not None:
            left, bottom, right, top = (value / style.DPI for value in clip)
            artist.set_clip_box(TransformedBbox(Bbox([[left, bottom], [right, top]]), inches))
        self.figure.add_artist(artist)

    def text(self, across, up, text, *, ha, va, size):
        """Write `text`, never rotated; `ha` and `va` say which side of it the coordinates are."""
        across, up = (float(snap_to_pixels(value)) / style.DPI for value in (across, up))
        inches = self.figure.dpi_scale_trans
        self.figure.text(across, up, text, ha=ha, va=va, size=size, transform=inches)


def width(text, size):
    """Return the width in pixels of `text` at `size` points."""
    how = FontProperties(size=size), "$" in text
    return float(text_to_path.get_text_width_height_descent(text, *how)[0]) * POINT


def snap_to_pixels(pixels):
    """Round to the rasteriser's grid, a quarter step off every place where a last bit matters.

    Those are the grid's own halves and wholes, the whole pixels to which text and marks are moved,
    and the sixth decimals in which SVG and PDF write points.
    """
    return (np.floor(np.asarray(pixels) * _GRID) + 0.25) / _GRID
