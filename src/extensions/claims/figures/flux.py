"""The regions that the branches of a hyperbolic orbit enclose, and the lobes between branches."""

import textwrap
from typing import Any

import numpy as np
import xarray as xr

from pseudorigid.figures.axes import section
from pseudorigid.figures.axes.limits import around, linear
from pseudorigid.figures.axes.panel import Panel, corner, key, letters, title, vacant
from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.sheet import Sheet

from . import Figure, Frame, Scene

_SIDES = (1, style.SKY, 1.5), (0, style.VERMILION, 2.3)  # index of the side, colour, points
_LONGEST = 24  # characters of a line that fits into a small panel
_RESOLVED = 2.0  # a difference is drawn if it is larger than this times the error of the lines


@style.pinned()
def draw(scene: Scene, flux: xr.Dataset) -> Figure:
    """Draw regions and lobes of the inner and the outer branches, and both crossings."""
    sheet = Sheet(style.COLUMN, 1725)
    lobes = (section.LEFT, 112, 505, 405), (680, 112, 1005, 405)
    frame = _regions(sheet, scene, flux)
    corner(sheet, frame, style.setting(scene))
    entries: list[tuple[Any, ...] | None] = [
        (_edge_name(flux, side), hue if _has_edge(flux, side) else "white", "", False, wide)
        for side, hue, wide in reversed(_SIDES)  # white: the text alone
    ]
    entries.append(("grazing rim", style.BLACK))
    crossing = ("crossing, enlarged below", style.FRAME, "o")
    entries.append(crossing if np.isfinite(flux["area"].values).any() else None)
    entries += [("stable branch", style.STABLE), ("unstable branch", style.UNSTABLE)]
    key(sheet, entries, frame[1] - 130, 2, section.LEFT + 10, section.SIDE)
    letters(sheet, frame, *lobes)
    for side, frame in zip((1, 0), lobes, strict=True):
        area = float(flux["area"].values[side])
        title(sheet, frame, _lobe(sheet, frame, side, flux), rise=18 if np.isnan(area) else 28)
        if np.isfinite(area):
            digits, _, power = f"{area:.3e}".partition("e")
            title(sheet, frame, rf"Area of a lobe: ${digits}\times 10^{{{int(power)}}}$", rise=18)
    return sheet.figure


def _has_edge(flux: xr.Dataset, side: int) -> bool:
    """Return whether a region has an edge that can be drawn."""
    return bool(np.isfinite(flux["region"].values[side]))


def _edge_name(flux: xr.Dataset, side: int) -> str:
    """Return the name of a region's edge, or why there is none."""
    name = flux["side"].values[side]
    if np.isnan(flux["area"].values[side]):
        return f"{name} region: none"
    if not _has_edge(flux, side):
        return f"{name} edge: cut by a jump"
    return f"edge of the {name} region"


def _regions(sheet: Sheet, scene: Scene, flux: xr.Dataset) -> Frame:
    """Draw the regions, their crossings, and the areas of their lobes; return the frame."""
    panel = section.large(sheet, scene, sheet.high - 75)
    panel.rim(zorder=2)
    for side, hue, wide in _SIDES:
        if np.isnan(flux["area"].values[side]):
            continue
        x, y = flux["outline_x"].values[side], flux["outline_y"].values[side]
        panel.line(x, y, color=hue, lw=wide)
        crossing = float(flux["crossing_x"].values[side].max())
        panel.dots([crossing], [0.0], style.FRAME)
        name, ha, shift = ("(b)", "left", 4.0) if side else ("(c)", "right", -4.0)
        panel.note(crossing, 0.0, name, ha=ha, shift=(shift, 0.0))
    if not any(_has_edge(flux, side) for side, *_ in _SIDES):
        text = "neither region has an edge that can be drawn"
        panel.note(panel.centre, 0.5 * panel.high * panel.radius, text, ha="center")
    return panel.frame


def _lobe(sheet: Sheet, frame: Frame, side: int, flux: xr.Dataset) -> str:
    """Draw two branches at their crossing, or the distance between them, and return a title."""
    x, y = (flux[f"branch_{axis}"].values[side] for axis in "xy")
    name = flux["side"].values[side]
    if np.isnan(x[0]):
        reason = flux.attrs.get(f"missing_{name}", "none is closed")
        vacant(sheet, frame, textwrap.fill(f"no lobe: {reason}", _LONGEST))
    elif side == 0 and np.unique(y).size > 7 and np.ptp(np.sign(np.diff(y))) < 2.0:
        _difference(sheet, frame, x, y)
        return "Inner: unstable minus stable"
    else:
        up = around([y, -y], 0.06, 5, "$y$")
        panel = Panel(sheet, frame, around(x, 0.06, 3, "$x$"), up)
        panel.line(x, -y, color=style.STABLE, lw=1.0)
        panel.line(x, y, color=style.UNSTABLE, lw=1.0)
    return f"{name.title()} branches at the crossing"


def _difference(sheet: Sheet, frame: Frame, x: np.ndarray, y: np.ndarray) -> None:
    """Draw the distance in x of the unstable branch from the stable one, its mirror image."""
    y, order = np.unique(y, return_index=True)
    x = x[order]
    half = float(min(y.max(), -y.min()))
    at = half * (np.arange(-200, 201) / 200.0)
    apart = _cubic(at, y, x) - _cubic(-at, y, x)
    # Halving the steps between vertices divides the error of cubics by sixteen.
    error = np.abs(x[1:-1] - _cubic(y[1:-1], y[::2], x[::2])).max() / 16.0
    if float(np.abs(apart).max()) < _RESOLVED * error:
        vacant(sheet, frame, "too small for lines this coarse")
        return
    power = int(f"{float(np.abs(apart).max()):e}".partition("e")[2])
    apart = apart / float(f"1e{power}")
    most = 1.1 * float(np.abs(apart).max())
    up = linear(-most, most, 5, rf"Difference of $x$ / $10^{{{power}}}$")
    panel = Panel(sheet, frame, linear(-half, half, 3, "$y$"), up)
    panel.line([-half, half], [0.0, 0.0], color=style.STABLE, lw=1.0)
    panel.line(at, apart, color=style.UNSTABLE, lw=1.0)


def _cubic(at: np.ndarray, x: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Interpolate values at rising x by cubics through the four nearest vertices."""
    near = [np.clip(np.searchsorted(x, at), 2, x.size - 2) + i for i in range(-2, 2)]
    total = np.zeros_like(at)
    for one in near:
        others = [(at - x[m]) / (x[one] - x[m]) for m in near if m is not one]
        total += values[one] * others[0] * others[1] * others[2]
    return total
