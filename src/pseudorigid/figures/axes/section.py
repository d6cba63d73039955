"""The section at an energy in the chart (x, y): an elliptic disk bounded by the grazing rim."""

import math
from typing import Any

import numpy as np
import xarray as xr

from ...dynamics.variables import chart, rows, states_of
from ...kernel.arithmetic import sincos_each
from ...kernel.closed_forms import twice_energy_above_rest
from ..canvas import style
from ..canvas.sheet import Sheet
from .limits import linear
from .panel import Entry, Frame, Panel, corner

NAME = r"$y=\dot{x}^{-}-k\dot{u}^{-}$"
LEFT, SIDE = 150, 825  # pixels: left and width of a large panel
_STEP = 0.06  # the frame's height is a multiple of this part of half its width


class Section(Panel):
    """A panel around the section of a scene, 2 `room` radii wide, with about `ticks` ticks an axis.

    An axis whose name is None has no labels.
    """

    def __init__(
        self, sheet: Sheet, frame: Frame, scene: dict[str, Any], room: float = 1.06, ticks: int = 5,
        names: tuple[str | None, str | None] = ("$x$", NAME),
    ) -> None:  # fmt: skip
        self.scene, self.k = scene, scene["ball"]["k"]
        self.centre, self.radius = extent(scene)
        self.high = math.sqrt(self.k * (1.0 + self.k))  # of the section, in radii
        half = room * self.radius
        high = _STEP * math.ceil(self.high / _STEP) * half
        spans = (self.centre - half, self.centre + half), (-high, high)
        axes = [linear(*span, ticks, name or "") for span, name in zip(spans, names, strict=True)]
        across, up = (a if n is not None else a.blank() for a, n in zip(axes, names, strict=True))
        super().__init__(sheet, frame, across, up, grid=False)
        self.minor()

    def orbits(self, orbits: xr.Dataset) -> None:
        """Draw orbits as dots, first and paler those that are not regular."""
        x, y = chart(self.k, *states_of(orbits))
        regular = orbits["type"].values == "regular"
        spans = rows(orbits)
        for index in np.argsort(regular, kind="stable").tolist():
            hue, size = (style.BACKDROP, 0.9) if regular[index] else (style.PALE_SEA, 0.7)
            place = self.place(x[spans[index]], y[spans[index]])
            self.sheet.dots(*place, hue, size, zorder=1.5)  # below names of curves

    def rim(self, zorder: float = 4.5) -> None:
        """Draw the rim."""
        self.line(*rim(self.scene), color=style.BLACK, lw=0.8, zorder=zorder)


def extent(scene: dict[str, Any]) -> tuple[float, float]:
    """Return x of the middle of a scene's section, and its radius along x."""
    k, g = scene["ball"]["k"], scene["ball"]["g"]
    return g / k, math.sqrt(twice_energy_above_rest(k, g, scene["energy"]) / k)


def rim(scene: dict[str, Any]) -> tuple[np.ndarray, np.ndarray]:
    """Return x and y of the rim of a scene's section, all around."""
    k, (centre, radius), (cosine, sine) = scene["ball"]["k"], extent(scene), circle()
    return centre + radius * cosine, math.sqrt(k * (1.0 + k)) * radius * sine


def circle(sides: int = 720) -> tuple[np.ndarray, np.ndarray]:
    """Return cosines and sines of angles all around, from 0 to 2 pi."""
    sine, cosine = sincos_each(2.0 * math.pi * np.arange(sides + 1) / sides)
    return cosine, sine


def large(sheet: Sheet, scene: dict[str, Any], top: float) -> Section:
    """Return a large panel of the section of a scene's ball and energy below a height."""
    return Section(sheet, (LEFT, top - SIDE, LEFT + SIDE, top), scene)


def over_orbits(
    scene: dict[str, Any], orbits: xr.Dataset, high: int = 1200
) -> tuple[Section, Entry | None, Entry | None]:
    """Draw the section with its rim and orbits at the top of a new sheet.

    Return the panel, and the entries of a key for regular orbits and for others, None for one that
    is not drawn.
    """
    sheet = Sheet(style.COLUMN, high)
    panel = large(sheet, scene, high - 75)
    panel.orbits(orbits)
    panel.rim()
    corner(sheet, panel.frame, style.setting(scene))
    types = orbits["type"].values.tolist()
    rest = types.count("regular")
    regular = (style.plural("regular orbit", rest), style.BACKDROP, "o") if rest else None
    sea = style.irregular(types)
    chaotic = (sea, style.PALE_SEA, "o") if sea else None
    return panel, regular, chaotic
