"""The atlas: how much of the section is regular and how chaotic the rest, over k and E/g^2."""

import numpy as np

from ..dynamics import fixed_point
from .axes import raster
from .axes.panel import Axis, Panel, log10
from .canvas import style
from .canvas.sheet import POINT, Sheet

RESONANCES = tuple((1, q) for q in (2, 3, 4, 5, 6, 8, 10))
PAPER = (0.2, {"Figure 8": 0.625, "Figure 2": 6.25})  # k, and E/g^2 of the paper's two cases
NOTE = (
    "the paper: “regular trajectories",
    "are progressively destroyed",
    "as the energy increases”",
)
LEFT, RIGHT = 120, 885
_SIZE = 6.0  # points: text beside lines


def draw(sweep, data):
    """Return the Figure of a sweep: a plane, or a line where k does not vary."""
    return (line if len(sweep["k"]) == 1 else plane)(sweep, data)


@style.pinned()
def plane(sweep, data):
    """Regular share and the sea's exponent, a coloured cell each, over E/g^2 and k.

    `data` is the dataset of the sweep. Curves: where the fixed point's rotation number is a
    simple fraction; circles: the paper's two cases. Grey: no sea.
    """
    sheet = Sheet(style.COLUMN, 1425)
    high = float(np.nanmax(data["exponent"].values, initial=0.05))
    values = (
        ("Regular share of the section", data["regular"].values, 1.0, "viridis"),
        ("Lyapunov exponent of the sea", data["exponent"].values, high, "magma"),
    )
    for i, (title, shade, largest, colors) in enumerate(values):
        bottom = 825 - i * 705
        frame = (LEFT, bottom, RIGHT, bottom + 500)
        across = _energy_axis(sweep["energy"], r"$E/g^2$")
        up = _linear(raster.edges(np.array(sweep["k"])), "$k$")
        panel = Panel(sheet, frame, across, up, grid=False)
        raster.cells(panel, sweep, shade / largest, colors)
        raster.scale(sheet, frame, largest, colors)
        sheet.text(RIGHT, frame[3] + 13 * POINT, title, ha="right", va="bottom", size=7.0)
        _resonances(panel, named=i == 0)
        for e in PAPER[1].values():
            if _inside(across, e) and _inside(up, PAPER[0]):
                panel.dots(e, PAPER[0], "white", size=5.0, hollow=True)
                panel.dots(e, PAPER[0], style.BLACK, size=2.5)
    return sheet.figure


@style.pinned()
def line(sweep, data):
    """Regular share with its 95 % interval, and the sea's exponent with quartiles, against energy.

    `data` is the dataset of a sweep with one k; with a g the energy is the paper's E, else E/g^2.
    """
    sheet = Sheet(style.COLUMN, 1125)
    unit = sweep["g"] * sweep["g"] if "g" in sweep else 1.0
    energy = np.array(sweep["energy"]) * unit
    name = "Energy $E$" if "g" in sweep else r"$E/g^2$"
    first, last = min(0.0, energy[0]), max(0.0, energy[-1])
    across = _linear((first, last + (0.02 * (last - first) or 1.0)), name, 8)
    blank = Axis(across.limits, across.ticks, labels=("",) * len(across.ticks))
    share = _linear((0.0, 1.0), "Regular share of the section", 5)
    exponents = data["exponent_high"].values[0]
    exponent = _linear((0.0, float(np.nanmax(exponents, initial=0.05)) * 1.02), "", 4)
    frames = (LEFT, 560, 1010, 1050), (LEFT, 135, 1010, 490)
    panels = Panel(sheet, frames[0], blank, share), Panel(sheet, frames[1], across, exponent)
    sheet.text(
        LEFT,
        frames[1][3] + 4 * POINT,
        "Lyapunov exponent of the sea",
        ha="left",
        va="bottom",
        size=7,
    )
    for turns, impacts in RESONANCES:
        at = fixed_point.resonance(sweep["k"][0], turns, impacts) * unit
        if across.limits[0] < at < across.limits[1]:
            for panel in panels:
                _, low, _, high = panel.frame
                x = float(panel.place(at, 0)[0][0])
                sheet.draw([x, x], [low, high], color=style.BACKDROP, lw=0.7, zorder=0.8)
            text = f"{turns}/{impacts}"
            sheet.text(x + 2 * POINT, frames[0][3] - 4, text, ha="left", va="top", size=_SIZE)
    _bars(panels[0], energy, data, "regular", style.BLUE)
    _bars(panels[1], energy, data, "exponent", style.VERMILION)
    for i, text in enumerate(NOTE):
        y = frames[0][3] - 60 - i * 34
        sheet.text(RIGHT + 105, y, text, ha="right", va="top", size=_SIZE)
    for name, e in PAPER[1].items():
        if sweep["k"][0] == PAPER[0] and e in sweep["energy"]:
            at, value = e * unit, float(data["regular"].sel(energy=e).values[0])
            panels[0].dots(at, value, style.BLACK, size=4.5, hollow=True)
            panels[0].dots(at, value, style.BLUE, size=2.2)
            panels[0].note(at, value, name, shift=(3, 12))
    return sheet.figure


def _bars(panel, x, data, name, color):
    """A dot a cell, joined, with its bar from name_low to name_high."""
    values = (data[key].values[0] for key in (name, f"{name}_low", f"{name}_high"))
    values, low, high = values
    panel.line(x, values, color=style.pale(color), lw=0.6, zorder=1)
    for at, *span in zip(x, low, high, strict=True):
        if not np.isnan(span[0]):
            panel.line([at, at], span, color=color, lw=0.7, zorder=2)
    seen = ~np.isnan(values)
    panel.dots(x[seen], values[seen], color, size=2.2)


def _resonances(panel, named):
    """The curves of the fixed point's resonances, named where they leave the frame."""
    bottom, top = panel.up.limits
    k = bottom + (top - bottom) * np.arange(1, 1001) / 1000
    k = k[k > 0.0]
    for turns, impacts in RESONANCES:
        e = np.array([fixed_point.resonance(float(one), turns, impacts) for one in k])
        inside = np.array([_inside(panel.across, one) for one in e])
        e = np.where(inside, e, np.nan)
        panel.line(e, k, color=style.BLACK, lw=1.3, zorder=2)
        panel.line(e, k, color="white", lw=0.6, zorder=2.1)
        if named and inside.any():
            last = int(np.flatnonzero(inside)[-1])
            x, y = (float(place[0]) for place in panel.place(e[last], k[last]))
            x = max(x, panel.frame[0] + 12 * POINT)
            text = f"{turns}/{impacts}"
            panel.sheet.text(x, y + 3 * POINT, text, ha="center", va="bottom", size=_SIZE)


def _energy_axis(values, name):
    """A logarithmic axis where the cells are spaced so, from edge to edge of the cells."""
    values = np.array(values)
    if values[0] <= 0.0 or values[-1] / values[0] < 20.0:
        return _linear(raster.edges(values), name)
    edges = raster.edges(log10(values))
    ticks = range(int(np.ceil(edges[0])), int(np.floor(edges[-1])) + 1)
    labels = tuple(f"{10.0**tick:g}" for tick in ticks)
    return Axis((float(edges[0]), float(edges[-1])), tuple(ticks), name, True, labels)


def _linear(edges, name, count=5):
    low, high = float(edges[0]), float(edges[-1])
    return Axis((low, high), tuple(raster.ticks(low, high, count)), name)


def _inside(axis, value):
    """Whether a value lies within the limits of an axis."""
    return 0.0 <= float(axis.fraction(value)[0]) <= 1.0
