"""The atlas: how much of the section is regular and how chaotic the rest, over k and E/g^2."""

import math
from itertools import pairwise

import numpy as np

from ..dynamics import fixed_point
from .axes import raster
from .axes.panel import Axis, Panel, log10
from .canvas import style
from .canvas.ragged_rows import pieces
from .canvas.sheet import POINT, Sheet

RESONANCES = tuple((1, q) for q in range(2, 11))
PAPER = (0.2, {"Figure 8": 0.625, "Figure 2": 6.25})  # k, and E/g^2 of the paper's two cases
QUOTATION = (
    "the paper: the regular trajectories",
    "“appear to be progressively destroyed",
    "as the total energy increases”",
)
LEFT, WIDE, HIGH = 115, 800, 640  # pixels: a panel of the plane, made of whole pixels a cell
_SIZE = 6.0  # points: text beside lines
_NAME = 46  # pixels: the room that the name of a resonance needs
_NORMAL = 1.959964  # standard errors either way that hold 95 %
_DASHES = 5.0, 4.0  # widths of a line: the onset of jumps


def draw(sweep, data):
    """The picture of a sweep: a plane, or a line where k does not vary.

    Parameters
    ----------
    sweep : dict
        Of the config: k and energy are lists of numbers.
    data : xarray.Dataset
        Of that sweep, as from `sweep.blocks.join`.

    Returns
    -------
    matplotlib.figure.Figure
    """
    return (line if len(sweep["k"]) == 1 else plane)(sweep, data)


@style.pinned()
def plane(sweep, data):
    """Regular share and the sea's exponent, a coloured cell each, over E/g^2 and k.

    `data` is the dataset of the sweep. Curves: where the fixed point's rotation number is a
    simple fraction, and where impacts begin to jump; circles: the paper's two cases. Grey: no sea.
    """
    wide, high = (
        count * max(1, most // count)
        for count, most in ((len(sweep["energy"]), WIDE), (len(sweep["k"]), HIGH))
    )
    lower = 320
    upper = lower + high + 195
    sheet = Sheet(style.COLUMN, 75 * -(-(upper + high + 105) // 75))
    largest = float(np.nanmax(data["exponent"].values, initial=0.05))
    values = (
        ("Regular share of the section", data["regular"].values, 1.0, "viridis"),
        ("Lyapunov exponent of the sea, an impact", data["exponent"].values, largest, "magma"),
    )
    for bottom, (title, shade, most, table) in zip((upper, lower), values, strict=True):
        frame = (LEFT, bottom, LEFT + wide, bottom + high)
        across = _energy_axis(sweep["energy"], r"$E/g^2$")
        up = raster.linear(*raster.edges(np.array(sweep["k"]))[[0, -1]], 7, "$k$")
        panel = Panel(sheet, frame, across, up, grid=False)
        raster.minor(panel)
        raster.cells(panel, sweep, shade / most, table)
        raster.scale(sheet, frame, most, table)
        sheet.text(frame[2], frame[3] + 13 * POINT, title, ha="right", va="bottom", size=7.0)
        _resonances(panel, named=bottom == upper)
        _jumps(panel)
        for e in PAPER[1].values():
            if _inside(across, e) and _inside(up, PAPER[0]):
                panel.dots(e, PAPER[0], "white", size=5.0, hollow=True)
                panel.dots(e, PAPER[0], style.BLACK, size=2.5)
    _plane_key(sheet, 170)
    return sheet.figure


def _plane_key(sheet, top):
    """What curves, circles and grey mean, a row each from the height `top` down."""
    across, rows = [LEFT, LEFT + 50], [top - 40 * i for i in range(4)]
    texts = (
        "rotation number of the fixed point, 1/2 to 1/10",
        "$E/g^2 = 1 + k/2$: above it the map jumps",
        "the paper's Figure 8 (left) and Figure 2 (right)",
        "no chaotic orbit among those of the cell",
    )
    for y, text in zip(rows, texts, strict=True):
        sheet.text(LEFT + 70, y, text, ha="left", va="center", size=_SIZE)
    _stroke(sheet, across, [rows[0]] * 2)
    _stroke(sheet, across, [rows[1]] * 2, dashed=True)
    dot = {"ls": "none", "marker": "o"}
    sheet.draw([LEFT + 25], [rows[2]], ms=5.0, mec=style.BACKDROP, mfc="white", mew=0.7, **dot)
    sheet.draw([LEFT + 25], [rows[2]], ms=2.5, color=style.BLACK, mew=0, **dot)
    sheet.draw(across, [rows[3]] * 2, lw=6.0, color=style.GRID)


@style.pinned()
def line(sweep, data):
    """Regular share with its 95 % interval, and the sea's exponent with quartiles, against energy.

    `data` is the dataset of a sweep with one k; with a g the energy is the paper's E, else E/g^2.
    """
    sheet = Sheet(style.COLUMN, 1275)
    k = sweep["k"][0]
    unit = sweep["g"] * sweep["g"] if "g" in sweep else 1.0
    energy = np.array(sweep["energy"]) * unit
    name = "Energy $E$" if "g" in sweep else r"$E/g^2$"
    first, last = min(0.0, energy[0]), max(0.0, energy[-1])
    across = raster.linear(first, last + (0.02 * (last - first) or 1.0), 8, name)
    share = raster.linear(0.0, 1.0, 5)
    exponents = np.concatenate([data[f"exponent{end}"].values[0] for end in ("", "_high")])
    exponent = raster.linear(0.0, np.nanmax(exponents, initial=0.05) * 1.02, 4)
    frames = (110, 635, 1010, 1145), (110, 135, 1010, 545)
    axes = (across.blank(), across), (share, exponent)
    panels = [Panel(sheet, *each) for each in zip(frames, *axes, strict=True)]
    for panel in panels:
        raster.minor(panel)
    titles = (
        ("Regular share of the section", "bars: 95 %"),
        ("Lyapunov exponent of the sea", "dark: 95 %; pale: quartiles"),
    )
    for (_, _, right, top), (title, bars), rise in zip(frames, titles, (14, 4), strict=True):
        sheet.text(110, top + rise * POINT, title, ha="left", va="bottom", size=7.0)
        sheet.text(right, top + rise * POINT, bars, ha="right", va="bottom", size=_SIZE)
    shown = [(r, fixed_point.resonance(k, *r) * unit) for r in RESONANCES]
    shown = [(r, at) for r, at in shown if energy[0] < at < across.limits[1]]
    places = [_upright(panels, at, color=style.BACKDROP, lw=0.7) for _, at in shown]
    for ((turns, impacts), _), x in zip(shown, _apart(places), strict=True):
        text = f"{turns}/{impacts}"
        sheet.text(x, frames[0][3] + 3 * POINT, text, ha="center", va="bottom", size=_SIZE)
    onset = (1.0 + 0.5 * k) * unit
    if energy[0] < onset < across.limits[1]:
        x = _upright(panels, onset, color=style.PURPLE, lw=0.9, ls=(0, _DASHES))
        sheet.text(x + 6, frames[1][3] - 8, "jumps begin", ha="left", va="top", size=_SIZE)
    error = _NORMAL * data["exponent_error"].values[0]
    quartiles = data["exponent_low"].values[0], data["exponent_high"].values[0]
    middle = data["exponent"].values[0]
    regular = (data[f"regular{end}"].values[0] for end in ("", "_low", "_high"))
    _bars(panels[0], energy, style.BLUE, *regular)
    _bars(panels[1], energy, style.pale(style.VERMILION), np.full(energy.size, np.nan), *quartiles)
    _bars(panels[1], energy, style.VERMILION, middle, middle - error, middle + error)
    for i, text in enumerate(QUOTATION if "g" in sweep else ()):
        sheet.text(1000, frames[0][3] - 25 - i * 34, text, ha="right", va="top", size=_SIZE)
    for name, e in PAPER[1].items():
        if k == PAPER[0] and e in sweep["energy"]:
            at, value = e * unit, float(data["regular"].sel(energy=e).values[0])
            panels[0].dots(at, value, style.BLACK, size=4.5, hollow=True)
            panels[0].dots(at, value, style.BLUE, size=2.0)
            panels[0].note(at, value, name, shift=(4, 11))
    return sheet.figure


def _apart(places):
    """The places, those of neighbours moved apart where their names would touch."""
    order = sorted(range(len(places)), key=lambda i: places[i])
    moved = list(places)
    for left, right in pairwise(order):
        push = 0.5 * max(0.0, _NAME - (moved[right] - moved[left]))
        moved[left], moved[right] = moved[left] - push, moved[right] + push
    return moved


def _upright(panels, at, **how):
    """A line through the panels at a place on the axis; its x."""
    x = float(panels[0].place(at, 0)[0][0])
    for panel in panels:
        _, low, _, high = panel.frame
        panel.sheet.draw([x, x], [low, high], zorder=0.8, **how)
    return x


def _bars(panel, x, color, values, low, high):
    """A dot a cell, joined, with its bar from low to high."""
    panel.line(x, values, color=style.pale(color), lw=0.6, zorder=1)
    panel.bars(x, low, high, color=color, lw=0.7, zorder=2)
    seen = ~np.isnan(values)
    panel.dots(x[seen], values[seen], color, size=1.7)


def _resonances(panel, named):
    """The curves of the fixed point's resonances, named where they leave the frame."""
    k = _heights(panel)
    for turns, impacts in RESONANCES:
        e = np.array([fixed_point.resonance(float(one), turns, impacts) for one in k])
        inside = np.array([_inside(panel.across, one) for one in e])
        _curve(panel, np.where(inside, e, np.nan), k)
        if named and inside.any():
            last = int(np.flatnonzero(inside)[-1])
            x, y = (float(place[0]) for place in panel.place(e[last], k[last]))
            x = max(x, panel.frame[0] + 12 * POINT)
            text = f"{turns}/{impacts}"
            panel.sheet.text(x, y + 3 * POINT, text, ha="center", va="bottom", size=_SIZE)


def _jumps(panel):
    """Where impacts that graze begin to leave the floor, and the map to jump: E/g^2 = 1 + k/2."""
    k = _heights(panel)[[0, -1]]
    e = 1.0 + 0.5 * k
    if all(_inside(panel.across, one) for one in e):
        _curve(panel, e, k, dashed=True)


def _heights(panel):
    """1,000 values of k up the panel, above 0."""
    bottom, top = panel.up.limits
    k = bottom + (top - bottom) * np.arange(1001) / 1000
    return k[k > 0.0]


def _curve(panel, x, y, dashed=False):
    for piece in pieces(*panel.place(x, y)):
        _stroke(panel.sheet, *piece, dashed)


def _stroke(sheet, x, y, dashed=False):
    """A white line edged in black, or white dashes on a black one."""
    how = {"ls": (0, _DASHES)} if dashed else {}
    sheet.draw(x, y, color=style.BLACK, lw=1.5, zorder=2.0)
    sheet.draw(x, y, color="white", lw=0.7, zorder=2.1, **how)


def _energy_axis(values, name):
    """A logarithmic axis where the cells are spaced so, from edge to edge of the cells."""
    values = np.array(values)
    if values[0] <= 0.0 or values[-1] / values[0] < 20.0:
        return raster.linear(*raster.edges(values)[[0, -1]], 5, name)
    low, high = raster.edges(log10(values))[[0, -1]].tolist()
    ticks = range(math.ceil(low), math.floor(high) + 1)
    return Axis((low, high), ticks, name, True, [f"{10.0**tick:g}" for tick in ticks])


def _inside(axis, value):
    """Whether a value lies within the limits of an axis."""
    return 0.0 <= float(axis.fraction(value)[0]) <= 1.0
