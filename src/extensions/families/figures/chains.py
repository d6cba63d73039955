"""Births of chains and their losses of stability over the plane of a sweep, a panel for each."""

from typing import Any

import xarray as xr
from matplotlib.figure import Figure

from extensions.atlas.figures import atlas
from extensions.atlas.grid import inertias
from pseudorigid.dynamics.variables import rows
from pseudorigid.figures.axes import raster
from pseudorigid.figures.axes.limits import linear
from pseudorigid.figures.axes.panel import Window, letters
from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.sheet import POINT, Sheet

COLUMNS, WIDE, HIGH = (105, 590), 445, 400  # pixels: lefts and size of panels
BOTTOM, APART = 395, 475  # pixels: below the lowest panels, and from one row to the next
_SIZE = 7.0  # points: text of the key
_DASHES, _DOTS = (4.0, 1.6), (1.2, 1.6)  # in widths of a line
# The kinds of curve: their style and meaning.
_KINDS: dict[str, tuple[dict[str, Any], str]] = {
    "resonance": (
        {"color": style.VERMILION, "lw": 1.3},
        "the fixed point's rotation number is 1/q: a chain branches off",
    ),
    "fold": (
        {"color": style.BLACK, "lw": 0.6},
        "fold: an elliptic orbit of the chain is born or ends",
    ),
    "doubling": ({"color": style.BLUE, "lw": 1.1, "ls": (0, _DASHES)}, "its first period doubling"),
    "rim": (
        {"color": style.GREEN, "lw": 1.1, "ls": (0, _DOTS)},
        "it loses an impact, at rest on the floor",
    ),
    "jumps": (
        {"color": style.BLACK, "lw": 0.7, "ls": (0, _DASHES + _DOTS)},
        "$E/g^2 = 1 + k/2$: above it the map jumps",
    ),
}


@style.pinned()
def draw(sweep: dict[str, Any], data: xr.Dataset, curves: xr.Dataset) -> Figure:
    """Draw the curves of each chain over a plane of k and E/g^2 in shades of grey."""
    chains = sorted(sweep["chains"])
    last = -(-len(chains) // len(COLUMNS)) - 1  # row
    top = BOTTOM + last * APART
    sheet = Sheet(style.COLUMN, 75 * -(-(top + HIGH + 90) // 75))
    spans = rows(curves)
    kinds, orders = curves["kind"].values.tolist(), curves["order"].values.tolist()
    frames = []
    for i, order in enumerate(chains):
        row, column = divmod(i, len(COLUMNS))
        left, bottom = COLUMNS[column], top - row * APART
        frames.append((left, bottom, left + WIDE, bottom + HIGH))
        across, up = atlas.energy_axis(sweep), linear(*inertias(sweep["k"]), 4, "$k$")
        below = i + len(COLUMNS) >= len(chains)
        axes = across if below else across.blank(), up.blank() if column else up
        panel = Window(sheet, frames[-1], *axes, grid=False)
        panel.minor()
        atlas.colour(panel, sweep, data["regular"].values, raster.GREYS)
        above = left + WIDE / 2, bottom + HIGH + 4 * POINT  # apart from the letters
        sheet.text(*above, f"chain 1/{order}", size=7.0, ha="center", va="bottom")
        for kind, of, part in zip(kinds, orders, spans, strict=True):
            if of in (order, 0):
                energy, k = (curves[name].values[part] for name in ("energy", "k"))
                panel.line(energy, k, zorder=2.0, **_KINDS[kind][0])
        for at in atlas.PAPER_ENERGIES.values():
            panel.dots([at], [atlas.PAPER_K], "white", size=4.0)
            panel.dots([at], [atlas.PAPER_K], style.BLACK, size=2.0)
    letters(sheet, *frames)
    _key(sheet)
    return sheet.figure


def _key(sheet: Sheet) -> None:
    """Explain lines, shades and circles below the panels."""
    y, left = BOTTOM - 125, COLUMNS[0]
    for line_style, text in _KINDS.values():
        sheet.draw([left, left + 90], [y, y], **line_style)
        sheet.text(left + 108, y, text, size=_SIZE)
        y -= 38
    sheet.text(left, y, "grey: regular share, darker where larger", size=_SIZE)
    x = left + 640
    sheet.dots([x], [y], "white", 4.0, mec=style.BLACK, mew=0.4)
    sheet.dots([x], [y], style.BLACK, 2.0)
    sheet.text(x + 25, y, "Figures 8 and 2", size=_SIZE)
