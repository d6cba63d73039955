"""The section at an energy in the chart (x, y): an elliptic disk bounded by the grazing rim."""

import math

import numpy as np

from ...dynamics.ball import Ball
from ...dynamics.variables import chart, rows, states_of
from ...kernel.arithmetic import sincos_each
from ..canvas import style
from ..canvas.sheet import Sheet
from .limits import linear
from .panel import Panel, corner

NAME = r"$y=\dot{x}^{-}-k\dot{u}^{-}$"
SEA = "#d4d4d4"  # of chaotic orbits beside regular ones
LEFT, SIDE = 150, 825  # pixels: left and width of a large panel
_SIDES = 720  # of the rim
_STEP = 0.06  # the frame's height is a multiple of this part of half its width


class Section(Panel):
    """A panel around the whole section, 2 `room` radii wide, with about `ticks` ticks an axis."""

    def __init__(self, sheet, frame, ball, radius, room=1.06, ticks=5, names=("$x$", NAME)):
        self.k, self.centre, self.radius = ball["k"], ball["g"] / ball["k"], radius
        self.high = math.sqrt(self.k * (1.0 + self.k))  # of the section, in radii
        half = room * radius
        up = _STEP * math.ceil(self.high / _STEP) * half
        spans = (self.centre - half, self.centre + half), (-up, up)
        axes = (linear(*span, ticks, name) for span, name in zip(spans, names, strict=True))
        super().__init__(sheet, frame, *axes, grid=False)
        self.minor()

    def orbits(self, orbits, chaotic):
        """Draw orbits as dots, first and paler those whose indices are in `chaotic`."""
        x, y = chart(self.k, *states_of(orbits))
        spans = rows(orbits)
        for index in sorted(range(len(spans)), key=lambda i: (i not in chaotic, i)):
            hue, size = (SEA, 0.7) if index in chaotic else (style.BACKDROP, 0.9)
            self.dots(x[spans[index]], y[spans[index]], hue, size=size)

    def rim(self, zorder=4.5):
        """Draw the rim."""
        sine, cosine = sincos_each(2.0 * math.pi * np.arange(_SIDES + 1) / _SIDES)
        x = self.centre + self.radius * cosine
        self.line(x, self.high * self.radius * sine, color=style.BLACK, lw=0.8, zorder=zorder)


def at_top(sheet, scene):
    """Return a large panel of the section of a scene's ball and energy at the top of a sheet."""
    top = sheet.high - 75
    frame = LEFT, top - SIDE, LEFT + SIDE, top
    return Section(sheet, frame, scene["ball"], Ball(**scene["ball"]).section(scene["energy"])[1])


def over_orbits(scene, orbits, high=1200):
    """Draw the section with its rim and orbits at the top of a new sheet.

    Return the panel, and the entries of a key for regular and for chaotic orbits, None for one that
    is not drawn.
    """
    sheet = Sheet(style.COLUMN, high)
    panel = at_top(sheet, scene)
    from ...dynamics.regularity import (
        chaotic_orbits,  # compiled code, which other kinds do not need
    )

    chaotic = chaotic_orbits(scene["ball"], orbits)
    panel.orbits(orbits, chaotic)
    panel.rim()
    corner(sheet, panel.frame, style.setting(scene))
    rest = orbits.sizes["orbit"] - len(chaotic)
    regular = (style.plural("regular orbit", rest), style.BACKDROP, "o") if rest else None
    sea = (style.plural("chaotic orbit", len(chaotic)), SEA, "o") if chaotic else None
    return panel, regular, sea
