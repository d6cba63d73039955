"""The section with the points that are on no invariant circle, and their share against impacts."""

import numpy as np
import xarray as xr

from pseudorigid.dynamics.variables import chart, rows, states_of
from pseudorigid.figures.axes import raster, section
from pseudorigid.figures.axes.limits import decades, linear
from pseudorigid.figures.axes.panel import Panel, corner, key, letters, log10
from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.sheet import POINT, Sheet

from . import Figure, Scene

_TABLE = "YlGnBu"
_HIGH, _LOWER = 1800, (section.LEFT, 112, section.LEFT + section.SIDE, 480)  # pixels
_SCALE = 640  # pixels: bottom of the colour scale


@style.pinned()
def draw(scene: Scene, exclusion: xr.Dataset, curves: xr.Dataset, orbits: xr.Dataset) -> Figure:
    """Draw the impacts that exclude each point, with proved curves and islands, and the share."""
    sheet = Sheet(style.COLUMN, _HIGH)
    panel = section.large(sheet, scene, _HIGH - 75)
    _colours(panel, exclusion, scene["followed"])
    x, y = chart(panel.k, *states_of(orbits))
    regular = orbits["type"].values == "regular"
    for one, span in zip(regular, rows(orbits), strict=True):
        if one:
            panel.dots(x[span], y[span], style.BLACK, size=0.6)
    panel.line(curves["x"].values, curves["y"].values, color=style.VERMILION, lw=1.0, zorder=5)
    panel.rim()
    corner(sheet, panel.frame, style.setting(scene))
    entries = [
        ("not excluded", style.FRAME, "s", True, 5.0),
        ("proved curve", style.VERMILION),
        ("regular orbit", style.BLACK, "o") if regular.any() else None,
    ]
    key(sheet, [*filter(None, entries)], panel.frame[1] - 128, 3, section.LEFT, section.SIDE)
    _scale(sheet, scene["followed"])
    _shares(sheet, exclusion, curves)
    letters(sheet, panel.frame, _LOWER)
    return sheet.figure


def _colours(panel: section.Section, exclusion: xr.Dataset, followed: int) -> None:
    """Colour each pixel of the panel by the grid's nearest point, white where none is excluded."""
    left, bottom, right, top = map(int, panel.frame)
    nearest = []
    for name, axis, size in (("x", panel.across, right - left), ("y", panel.up, top - bottom)):
        values, (low, high) = exclusion[name].values, axis.limits
        place = low + (np.arange(size) + 0.5) * ((high - low) / size)
        nearest.append(np.floor((place - values[0]) / (values[1] - values[0]) + 0.5).astype(int))
    columns, lines = nearest
    known = (lines >= 0) & (lines < exclusion.sizes["row"])
    inside = (columns >= 0) & (columns < exclusion.sizes["column"])
    impacts = np.zeros((lines.size, columns.size))
    grid = np.maximum(exclusion["excluded"].values, 0)
    impacts[np.ix_(known, inside)] = grid[np.ix_(lines[known], columns[inside])]
    table = np.concatenate([[[255, 255, 255]], raster.palette(_TABLE)]).astype(np.uint8)
    raster.paste(panel.sheet, left, bottom, table[_shades(followed)[impacts.astype(int)]])


def _shades(followed: int) -> np.ndarray:
    """Return the row of the table of colours for each number of impacts; 0 for 0."""
    share = log10(np.arange(1, followed + 1)) / log10(followed + 1)
    return np.concatenate([[0], 1 + (share * 64.0).astype(int)])


def _scale(sheet: Sheet, followed: int) -> None:
    """Draw the colour scale below the panel of the section."""
    left, right = section.LEFT + 300, section.LEFT + section.SIDE
    column = np.arange(right - left) * 64 // (right - left)
    image = np.repeat(raster.palette(_TABLE)[column][None], 28, axis=0)
    raster.paste(sheet, left, _SCALE, image)
    sheet.text(section.LEFT, _SCALE + 14, "excluded after impacts:", size=7.0)
    for tick in (1, 3, 10, 30, 100, 300, 1000, 3000, 10_000):
        if tick <= followed:
            x = left + float((log10(tick) / log10(followed + 1))[0]) * (right - left)
            sheet.draw([x, x], [_SCALE, _SCALE - 2.5 * POINT], color=style.FRAME, lw=0.6)
            text = style.number(tick)
            sheet.text(x, _SCALE - 4 * POINT, text, ha="center", va="top", size=7.0)


def _shares(sheet: Sheet, exclusion: xr.Dataset, curves: xr.Dataset) -> None:
    """Draw the share that is not excluded against the impacts, and the share in a proved curve."""
    impacts, left = exclusion["impacts"].values, 1.0 - exclusion["share"].values
    ends = [0.0, float(log10(impacts[-1])[0])]
    across = decades(ends, "Impacts in either direction")
    panel = Panel(sheet, _LOWER, across, linear(0.0, 1.0, 5, "Share of the section not excluded"))
    panel.minor()
    proved = float(curves["share"].values[curves["period"].values == 1].max(initial=0.0))
    if proved:
        panel.line([1, impacts[-1]], [proved] * 2, color=style.VERMILION, lw=0.9, ls="--")
        panel.note(1, proved, "proved to be inside an invariant curve", shift=(4, -7))
    panel.line(impacts, left, color=style.BLUE, lw=1.1)
