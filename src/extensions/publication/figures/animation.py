"""A bouncing ball beside the section, on which each of its impacts becomes a point."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from pseudorigid.dynamics.variables import chart, rows, states_of
from pseudorigid.figures.axes.panel import corner
from pseudorigid.figures.axes.section import Section, circle
from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.sheet import Sheet

_HIGH, _CEILING, _FLOOR = 525, 450, 108  # pixels
_LEFT, _RIGHT, _LARGEST = 30, 330, 125.0  # pixels: ends of the floor, largest radius of the ball
_FRAME = 420, 108, 1020, 384  # pixels: the panel of the section
_SIZE = 7.5  # points
_TYPES = {"regular": ": regular, its dots form closed curves",
          "chaotic": ": chaotic, its dots fill a region"}  # fmt: skip
_CURVE, _SEA, _NEWEST = 1.0, 0.5, 4.5  # points: the sizes of dots


def draw(scene: dict[str, Any], orbits: xr.Dataset, frames: xr.Dataset) -> Figure:
    """Draw the last frame.

    A frame shows the ball in proportion, and the impacts up to then, of which the newest is large.
    Regular orbits have colours from dark to light, others are grey.
    """
    return _frame(scene, orbits, frames, frames.sizes["frame"] - 1)


def moving(scene: dict[str, Any], orbits: xr.Dataset, frames: xr.Dataset) -> Iterator[Figure]:
    """Draw all frames, and the last one again, which says that the picture begins again."""
    last = frames.sizes["frame"] - 1
    for index in range(last + 1):
        yield _frame(scene, orbits, frames, index)
    yield _frame(scene, orbits, frames, last, "It begins again.")


@style.pinned()
def _frame(
    scene: dict[str, Any], orbits: xr.Dataset, frames: xr.Dataset, index: int, words: str = ""
) -> Figure:
    """Draw one frame, with words above it, by default what orbit the ball follows."""
    sheet = Sheet(style.COLUMN, _HIGH)
    panel = Section(sheet, _FRAME, scene, names=("$x$", "$y$"))
    regular = orbits["type"].values == "regular"
    hues = np.where(regular, "", style.SEA).astype(object)
    hues[regular] = style.ordered(int(regular.sum()))
    followed, impacts = (int(frames[name][index]) for name in ("followed", "impacts"))
    x, y = chart(panel.k, *states_of(orbits))
    spans = rows(orbits)[: followed + 1]
    newest = spans[followed].start + impacts - 1
    spans[followed] = slice(spans[followed].start, newest + 1)
    for hue, curve, span in zip(hues, regular, spans, strict=False):
        panel.dots(x[span], y[span], hue, size=_CURVE if curve else _SEA)
    panel.dots(x[[newest]], y[[newest]], style.VERMILION, size=_NEWEST)
    panel.rim()
    tallest = float((2.0 + frames["strain"] - frames["position"]).max())  # top of the ball, in R
    position, strain = (float(frames[name][index]) for name in ("position", "strain"))
    size = min(_LARGEST, (_CEILING - _FLOOR - 15) / tallest)
    _ball(sheet, position, strain, size, hues[followed])
    sheet.text(0.5 * (_LEFT + _RIGHT), 66, f"impact {impacts:,}", _SIZE, ha="center")
    sheet.text(0.5 * (_LEFT + _RIGHT), 28, "one impact, one dot", _SIZE, ha="center")
    sheet.text(_LEFT, _HIGH - 36, words or _about(orbits, followed), _SIZE)
    corner(sheet, _FRAME, style.setting(scene))
    return sheet.figure


def _about(orbits: xr.Dataset, followed: int) -> str:
    """Say which orbit the ball follows, and what its impacts look like."""
    types = orbits["type"].values.tolist()
    ball = "New ball," if followed else "Ball"
    return f"{ball} {followed + 1} of {len(types)}{_TYPES.get(types[followed], '')}"


def _ball(sheet: Sheet, position: float, strain: float, radius: float, hue: str) -> None:
    """Draw the ball, whose undeformed radius has so many pixels, above the floor."""
    for left in range(_LEFT, _RIGHT - 20, 24):
        sheet.draw([left, left + 16], [_FLOOR - 16, _FLOOR], color=style.BACKDROP, lw=0.5)
    sheet.draw([_LEFT, _RIGHT], [_FLOOR, _FLOOR], color=style.FRAME, lw=1.0)
    cosine, sine = circle(180)
    middle, centre = 0.5 * (_LEFT + _RIGHT), _FLOOR + radius * (1.0 - position)
    up = centre + radius * (1.0 + strain) * sine
    sheet.draw(middle + radius * cosine, up, color=hue, lw=1.4)
    sheet.dots([middle], [centre], hue, 3.0)
