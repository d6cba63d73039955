"""The regular share of maps that keep area, the reversor, both, or neither, side by side."""

from collections.abc import Sequence

import numpy as np
import xarray as xr

from pseudorigid.figures.axes.limits import linear
from pseudorigid.figures.axes.panel import Axis, Window, key, letters
from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.sheet import POINT, Sheet

from . import Figure, Frame, Scene
from .control import FORMS, KEPT, UNCHANGED

_LEFT, _RIGHT = 105, 1030  # pixels
_BOTTOMS, _HIGH = (655, 175), 335  # pixels: of the panels
_BESIDE = 0.28  # from a form of change to the next one, in places of an axis
_HUES = dict(zip(FORMS, (style.BLACK, style.GREEN, style.ORANGE), strict=True))


class _Groups(Window):
    """A panel with a group of places for each property that maps keep."""

    size = 7.0  # three values have room for their labels

    def separate(self, count: int) -> None:
        """Draw a line between groups of `count` places, and write above each what is kept."""
        _, bottom, _, top = self.frame
        for group, text in enumerate(KEPT.values()):
            first = _first(group, count)
            (middle, end), _ = self.place([first + 0.5 * (count - 1), first - 1.0], [0.0, 0.0])
            self.sheet.text(middle, top + 5 * POINT, text, ha="center", size=self.size)
            if group:
                self._frame_line([end, end], [bottom, top])


@style.pinned()
def draw(scene: Scene, control: xr.Dataset) -> Figure:
    """Draw the regular share by what maps keep, for strengths of the change and run lengths.

    Marks of the three forms of change are side by side, so that none hides another.
    """
    sheet = Sheet(style.COLUMN, 1125)
    regular = control.sel({"class": "regular"})
    shares = np.stack([regular[f"class_{name}"].values for name in ("share", "low", "high")])
    shown = control.attrs["shown"]
    at = int(np.argmin(np.abs(control["strength"].values - shown)))
    up = linear(-0.01, min(1.03, 1.1 * float(shares.max()) + 0.02), 4)
    panels = (
        (r"Regular share of maps that keep ..., by strength $\epsilon$",
         control["strength"].values[1:].tolist(), shares[:, :, 1:, -1]),
        (rf"..., by the number of impacts, at $\epsilon$ = {style.number(shown)}",
         control["length"].values.tolist(), shares[:, :, at]),
    )  # fmt: skip
    frames: list[Frame] = [(_LEFT, low, _RIGHT, low + _HIGH) for low in _BOTTOMS]
    maps = [name.partition(" ")[::2] for name in control["map"].values.tolist()]
    for frame, (text, values, estimates) in zip(frames, panels, strict=True):
        panel = _Groups(sheet, frame, _places(values), up)
        sheet.text(_LEFT, frame[3] + 15 * POINT, text, size=8.0)
        unchanged = [float(shares[0, 0, 0, -1])] * 2
        panel.line(panel.across.limits, unchanged, color=style.SEA, lw=0.8, ls="--")
        for (form, kept), (share, low, high) in zip(maps, estimates.swapaxes(0, 1), strict=True):
            aside = _BESIDE * ([*FORMS].index(form) - 1)
            places = _first([*KEPT].index(kept), len(values)) + np.arange(len(values)) + aside
            panel.bars(places, low, high, color=_HUES[form], lw=0.8)
            panel.dots(places, share, _HUES[form], 3.0, marker=FORMS[form])
        panel.separate(len(values))
    letters(sheet, *((left, low, right, high + 11 * POINT) for left, low, right, high in frames))
    sheet.text(_RIGHT, sheet.high - 32, style.setting(scene), ha="right", va="center", size=7.0)
    entries = [(form, _HUES[form], mark, False, 3.4) for form, mark in FORMS.items()]
    key(sheet, [*entries, (UNCHANGED, style.SEA, "", True, 0.8)], 50, 4, _LEFT + 10, 900, 7.0)
    return sheet.figure


def _first(group: int, count: int) -> int:
    """Return the first place of a group of `count` values, with one empty place between groups."""
    return group * (count + 1)


def _places(values: Sequence[float]) -> Axis:
    """Return an axis with a place for each value in each group."""
    count, groups = len(values), range(len(KEPT))
    places = [_first(group, count) + i for group in groups for i in range(count)]
    return Axis(
        (-1.0, float(_first(len(KEPT), count) - 1)), places,
        labels=[style.number(value) for value in values] * len(KEPT),
    )  # fmt: skip
