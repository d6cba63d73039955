"""The section at an energy in the chart (x, y): an elliptic disk bounded by the grazing rim."""

import math

import numpy as np

from ...kernel.arithmetic import sincos_each
from ..canvas import style
from .panel import Panel
from .raster import linear

NAME = r"$y=\dot{x}^{-}-k\dot{u}^{-}$"
_SIDES = 720  # of the rim
_STEP = 0.06  # the frame's height is a multiple of this part of half its width


class Section(Panel):
    """A panel around the whole section, 2 `room` radii wide, with about `ticks` ticks an axis."""

    def __init__(self, sheet, frame, ball, radius, room, ticks=0, names=("", "")):
        self.k, self.centre, self.radius = ball["k"], ball["g"] / ball["k"], radius
        self.high = math.sqrt(self.k * (1.0 + self.k))  # of the section, in radii
        half = room * radius
        up = _STEP * math.ceil(self.high / _STEP) * half
        spans = (self.centre - half, self.centre + half), (-up, up)
        axes = (linear(*span, ticks, name) for span, name in zip(spans, names, strict=True))
        super().__init__(sheet, frame, *axes, grid=False)

    def rim(self, **line_style):
        """Draw the rim."""
        sine, cosine = sincos_each(2.0 * math.pi * np.arange(_SIDES + 1) / _SIDES)
        x = self.centre + self.radius * cosine
        self.line(x, self.high * self.radius * sine, color=style.BLACK, lw=0.8, **line_style)
