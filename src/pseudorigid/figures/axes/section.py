"""The whole section at an energy in the chart (x, y): a disk, whose rim is where impacts graze."""

import math

import numpy as np

from ...kernel.arithmetic import sincos_each
from ..canvas import style
from .panel import Panel
from .raster import linear

NAME = r"$y=\dot{x}^{-}-k\dot{u}^{-}$"
_SIDES = 720
_STEP = 0.06  # of the frame's height, in halves of its width


class Section(Panel):
    """A panel around a section, with the room above and below it that rounding to a step leaves.

    Parameters
    ----------
    sheet : Sheet
    frame : tuple
        As of a Panel.
    ball : mapping
        k and g.
    radius : float
        Of the section along y = 0.
    room : float
        Half the frame's width in radii.
    ticks : int
        About so many on each axis.
    names : (str, str)
        Of the axes.
    """

    def __init__(self, sheet, frame, ball, radius, room, ticks=0, names=("", "")):
        self.k, self.centre, self.radius = ball["k"], ball["g"] / ball["k"], radius
        self.high = math.sqrt(self.k * (1.0 + self.k))  # of the section, in radii
        half = room * radius
        up = _STEP * math.ceil(self.high / _STEP) * half
        spans = (self.centre - half, self.centre + half), (-up, up)
        axes = (linear(*span, ticks, name) for span, name in zip(spans, names, strict=True))
        super().__init__(sheet, frame, *axes, grid=False)

    def rim(self, **how):
        """Draw the rim."""
        sine, cosine = sincos_each(2.0 * math.pi * np.arange(_SIDES + 1) / _SIDES)
        x = self.centre + self.radius * cosine
        self.line(x, self.high * self.radius * sine, color=style.BLACK, lw=0.8, **how)
