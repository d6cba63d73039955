"""The atlas: the regular share of the section and the exponent of the rest, over k and E/g^2."""

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from pseudorigid.figures.axes import raster
from pseudorigid.figures.axes.limits import decades, linear
from pseudorigid.figures.axes.panel import (
    Axis,
    Panel,
    Window,
    corner,
    letters,
    log10,
    title,
    upright,
)
from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.sheet import POINT, Sheet, pieces

from ..grid import edges, inertias

PAPER_K = 0.2
PAPER_ENERGIES = {"Figure 8": 0.625, "Figure 2": 6.25}  # E/g^2
QUOTATION = (
    "the paper: the regular trajectories",
    "“appear to be progressively destroyed",
    "as the total energy increases”",
)
# Pixels: the left of a plane's frame, and its largest size where cells have more than one.
LEFT, WIDE, HIGH = 115, 800, 640
_SIZE, _KEY = 6.0, 7.0  # points: text beside lines, and in a key, where it has indices
_NAME_WIDTH = 46  # pixels: the room that the name of a resonance needs
_DASHES = 5.0, 4.0  # of the onset of jumps, in widths of the line
Sweep = dict[str, Any]  # a block of the checked config


def draw(sweep: Sweep, data: xr.Dataset) -> Figure:
    """Draw a sweep: a plane over k and E/g^2, or a line over the energy if it has one k."""
    figure: Figure = (line if len(sweep["k"]) == 1 else plane)(sweep, data)
    return figure


@style.pinned()
def plane(sweep: Sweep, data: xr.Dataset) -> Figure:
    """Draw the regular share and the sea's exponent as coloured cells over E/g^2 and k."""
    lower = 320
    upper = lower + pixels(sweep)[1] + 225
    sheet = sheet_above(upper, sweep)
    share, exponent = data["regular"].values, data["exponent"].values
    largest = float(np.nanmax(exponent, initial=0.05))
    panels = (
        (upper, "Regular share of the section", share, 1.0, "viridis"),
        (lower, "Lyapunov exponent of the sea, per impact", exponent, largest, "magma"),
    )
    frames = []
    for bottom, text, values, most, table in panels:
        panel = cells(sheet, bottom, sweep, values, most, table, text, root=values is exponent)
        frames.append(panel.frame)
        names, jumps = _curves(panel, data, named=bottom == upper)
        for energy in PAPER_ENERGIES.values():
            panel.dots([energy], [PAPER_K], "white", size=5.0, hollow=True)
            panel.dots([energy], [PAPER_K], style.BLACK, size=2.5)
    letters(sheet, *frames)
    circles = [name for name, at in PAPER_ENERGIES.items() if panel.within(at, PAPER_K).all()]
    _plane_key(sheet, 170, names, jumps, circles, bool(np.isnan(exponent).any()))
    return sheet.figure


def pixels(sweep: Sweep) -> tuple[int, int]:
    """Return width and height of a plane, with whole pixels for each cell."""
    across, up = len(sweep["energy"]), len(sweep["k"])
    return across * max(1, WIDE // across), up * max(1, HIGH // up)


def sheet_above(bottom: int, sweep: Sweep) -> Sheet:
    """Return a sheet whose upper panel is a plane that begins at the height `bottom`."""
    wide, high = pixels(sweep)
    wider = 75 * -(-max(0, wide - WIDE) // 75)  # whole quarters of an inch, as of the height
    return Sheet(style.COLUMN + wider, 75 * -(-(bottom + high + 105) // 75))


def cells(
    sheet: Sheet, bottom: int, sweep: Sweep, values: np.ndarray, most: float, table: str, text: str,
    root: bool = False,
) -> Window:  # fmt: skip
    """Draw a plane of values (k, energy) from 0 to `most` as coloured cells; return its panel.

    Colours are even in the values or, to show small ones too, in their square `root`.
    """
    wide, high = pixels(sweep)
    frame = (LEFT, bottom, LEFT + wide, bottom + high)
    up = linear(*inertias(sweep["k"]), 7, "$k$")
    panel = Window(sheet, frame, energy_axis(sweep), up, grid=False)
    panel.minor()
    shades = values / most
    colour(panel, sweep, np.sqrt(np.maximum(shades, 0.0)) if root else shades, table)
    raster.scale(sheet, frame, most, table, root)
    corner(sheet, frame, text, rise=13)
    return panel


def _plane_key(
    sheet: Sheet, top: int, names: list[str], jumps: bool, circles: list[str], grey: bool
) -> None:
    """Explain the curves, circles and grey cells that are drawn, in rows from `top` down."""
    across, ends = [LEFT, LEFT + 50], " to ".join(dict.fromkeys([*names[:1], *names[-1:]]))
    sides = (" (left)", " (right)") if len(circles) > 1 else ("", "")
    paper = " and ".join(map("".join, zip(circles, sides, strict=False)))
    dot = {"ls": "none", "marker": "o"}
    y = top
    if names:
        sheet.text(LEFT + 70, y, f"rotation number of the fixed point, {ends}", size=_KEY)
        _stroke(sheet, (across, [y] * 2))
        y -= 40
    if jumps:
        sheet.text(LEFT + 70, y, "$E/g^2 = 1 + k/2$: above it the map jumps", size=_KEY)
        _stroke(sheet, (across, [y] * 2), dashed=True)
        y -= 40
    if circles:
        sheet.text(LEFT + 70, y, f"the paper's {paper}", size=_KEY)
        sheet.draw([LEFT + 25], [y], ms=5.0, mec=style.BACKDROP, mfc="white", mew=0.7, **dot)
        sheet.draw([LEFT + 25], [y], ms=2.5, color=style.BLACK, mew=0, **dot)
        y -= 40
    if grey:
        sheet.text(LEFT + 70, y, "no chaotic orbit among those of the cell", size=_KEY)
        sheet.draw(across, [y] * 2, lw=6.0, color=style.GRID)


@style.pinned()
def line(sweep: Sweep, data: xr.Dataset) -> Figure:
    """Draw regular share with its 95 % interval, and the sea's exponent with quartiles."""
    sheet = Sheet(style.COLUMN, 1275)
    k = sweep["k"][0]
    unit = sweep["g"] * sweep["g"] if "g" in sweep else 1.0
    energy = np.array(sweep["energy"]) * unit
    name = "Energy $E$" if "g" in sweep else r"$E/g^2$"
    first, last = min(0.0, energy[0]), max(0.0, energy[-1])
    across = linear(first, last + (0.02 * (last - first) or 1.0), 8, name)
    share = linear(0.0, 1.0, 5)
    exponents = np.concatenate([data[f"exponent{end}"].values[0] for end in ("", "_high")])
    exponent = linear(0.0, np.nanmax(exponents, initial=0.05) * 1.02, 4)
    above = Panel(sheet, (110, 635, 1010, 1145), across.blank(), share)
    below = Panel(sheet, (110, 135, 1010, 545), across, exponent)
    left, bottom, right, top = above.frame  # its title is above the names of resonances
    letters(sheet, (left, bottom, right, top + 10 * POINT), below.frame)
    for panel, text, bars, rise in (
        (above, "Regular share of the section", "bars: 95 %", 14),
        (below, "Lyapunov exponent of the sea", "dark: 95 %; pale: quartiles", 4),
    ):
        panel.minor()
        title(sheet, panel.frame, text, rise)
        corner(sheet, panel.frame, bars, rise, _SIZE)
    _upright_lines((above, below), data, energy[0], unit)
    error = data["exponent_95"].values[0]
    mean, low, high = (data[f"exponent{end}"].values[0] for end in ("", "_low", "_high"))
    regular, least, most = (data[f"regular{end}"].values[0] for end in ("", "_low", "_high"))
    above.estimates(energy, regular, least, most, style.BLUE)
    below.estimates(energy, np.full(energy.size, np.nan), low, high, style.pale(style.BLUE))
    below.estimates(energy, mean, mean - error, mean + error, style.BLUE)
    for i, text in enumerate(QUOTATION if "g" in sweep else ()):
        sheet.text(1000, above.frame[3] - 25 - i * 34, text, ha="right", va="top", size=_SIZE)
    for name, scaled in PAPER_ENERGIES.items():
        if k == PAPER_K and scaled in sweep["energy"]:
            at, value = scaled * unit, float(data["regular"].sel(energy=scaled).values[0])
            above.dots(at, value, style.BLACK, size=4.5, hollow=True)
            above.dots(at, value, style.BLUE, size=2.0)
            above.note(at, value, name, shift=(4, 11))
    return sheet.figure


def _upright_lines(panels: Sequence[Panel], data: xr.Dataset, first: float, unit: float) -> None:
    """Draw the energies of resonances and of the onset of jumps, as far as they are swept."""
    sheet, last = panels[0].sheet, panels[0].across.limits[1]
    at = zip(data["order"].values, data["resonance_energy"].values[:, 0].tolist(), strict=True)
    energies = [(f"1/{order}", energy * unit) for order, energy in at]
    energies = [(name, energy) for name, energy in energies if first < energy < last]
    dots = {"color": style.BACKDROP, "lw": 0.7, "ls": ":"}
    lines = [upright(panels, energy, **dots) for _, energy in energies]
    for (name, _), x in zip(energies, apart(lines), strict=True):
        up = panels[0].frame[3] + 3 * POINT
        sheet.text(x, up, name, ha="center", va="bottom", size=_SIZE)
    onset = (1.0 + 0.5 * float(data["k"].values[0])) * unit
    if first < onset < last:
        x = upright(panels, onset, color=style.BLACK, lw=0.9, ls=(0, _DASHES))
        up = panels[1].frame[3] - 8
        sheet.text(x + 6, up, "jumps begin", ha="left", va="top", size=_SIZE)


def apart(centres: list[float]) -> list[float]:
    """Return the centres of names, moved apart where neighbours would touch."""
    order = sorted(range(len(centres)), key=lambda i: centres[i])
    moved = list(centres)
    for left, right in [*pairwise(order)] * len(order):
        push = 0.5 * max(0.0, _NAME_WIDTH - (moved[right] - moved[left]))
        moved[left], moved[right] = moved[left] - push, moved[right] + push
    return moved


def _curves(panel: Panel, data: xr.Dataset, named: bool) -> tuple[list[str], bool]:
    """Draw the curves of the fixed point's resonances, `named` if asked, and the onset of jumps.

    Return the rotation numbers of the curves that are seen, and whether the onset is.
    """
    seen, k = [], data["resonance_k"].values
    for order, energy in zip(data["order"].values, data["resonance_energy"].values, strict=True):
        visible = _is_between(panel.across, energy)
        for piece in pieces(*panel.place(np.where(visible, energy, np.nan), k)):
            _stroke(panel.sheet, piece)
        seen += [f"1/{order}"] if visible.any() else []
        if named and visible.any():  # where the curve leaves the frame at the top or at the left
            last = int(np.flatnonzero(visible)[-1])
            x, y = (float(pixel[0]) for pixel in panel.place(energy[last], k[last]))
            x = max(x, panel.frame[0] + 12 * POINT)
            panel.sheet.text(x, y + 3 * POINT, seen[-1], ha="center", va="bottom", size=_SIZE)
    ends = k[[0, -1]]
    jumps = bool(_is_between(panel.across, 1.0 + 0.5 * ends).all())
    if jumps:
        _stroke(panel.sheet, panel.place(1.0 + 0.5 * ends, ends), dashed=True)
    return seen, jumps


def _stroke(sheet: Sheet, points: Sequence[Any], dashed: bool = False) -> None:
    """Draw a white line edged in black, or white dashes on a black line."""
    dashes = {"ls": (0, _DASHES)} if dashed else {}
    sheet.draw(*points, color=style.BLACK, lw=1.5, zorder=2.0)
    sheet.draw(*points, color="white", lw=0.7, zorder=2.1, **dashes)


def colour(panel: Panel, sweep: Sweep, shades: np.ndarray, table: str) -> None:
    """Draw a rectangle for each cell of a sweep, coloured by shades (k, energy) from 0 to 1."""
    energy = log10(sweep["energy"]) if panel.across.decades else sweep["energy"]
    raster.cells(panel, edges(energy), edges(sweep["k"]), shades, table)


def energy_axis(sweep: Sweep) -> Axis:
    """Return an axis from edge to edge of the cells, logarithmic if these span a factor of 20.

    It ends where a ball could flatten, eq. (31), if g is known, and where one would be at rest.
    """
    name, values, k = r"$E/g^2$", sweep["energy"], sweep["k"]
    highest = (0.5 * k[0] / sweep["g"] - 1.0) / sweep["g"] if "g" in sweep else np.inf
    if values[0] <= 0.0 or values[-1] / values[0] < 20.0:
        first, *_, last = edges(values)
        return linear(max(first, -0.5 / k[-1]), min(last, highest), 5, name)
    first, *_, last = edges(log10(values)).tolist()
    axis = decades((first, min(last, float(log10(highest)[0]))), name)
    return replace(axis, labels=[f"{10.0**tick:g}" for tick in axis.ticks])


def _is_between(axis: Axis, values: np.ndarray) -> np.ndarray:
    """Return whether each value lies within the limits of an axis."""
    fractions = axis.fraction(values)
    return (fractions >= 0.0) & (fractions <= 1.0)
