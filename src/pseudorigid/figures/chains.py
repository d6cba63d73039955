"""Births of chains and their losses of stability, drawn over the regular share of a plane."""

from itertools import cycle

import numpy as np

from .atlas import HIGH, LEFT, PAPER_ENERGIES, PAPER_K, WIDE, energy_axis
from .axes import raster
from .axes.panel import Window
from .canvas import style
from .canvas.ragged_rows import rows
from .canvas.sheet import POINT, Sheet

_SIZE = 6.0  # points: text beside lines
BOTTOM = 395  # pixels below the frame
_DASHES, _DOTS = (4.0, 1.6), (1.2, 1.6)  # in widths of a line
_STYLES = {
    "resonance": {"lw": 1.3},
    "fold": {"lw": 0.6},
    "doubling": {"lw": 1.0, "ls": (0, _DASHES)},
    "rim": {"lw": 1.0, "ls": (0, _DOTS)},
    "jumps": {"lw": 0.9, "ls": (0, _DASHES + _DOTS)},
}
_MEANINGS = {
    "resonance": "the fixed point's rotation number is 1/q: a chain branches off",
    "fold": "fold: an elliptic orbit of the chain is born or ends",
    "doubling": "its first period doubling",
    "rim": "it loses an impact, at rest on the floor",
    "jumps": "$E/g^2 = 1 + k/2$: above it the map jumps",
}
_HUES = (style.VERMILION, style.BLUE, style.GREEN, style.ORANGE, style.PURPLE, style.SKY)


@style.pinned()
def draw(sweep, data, curves):
    """Draw the curves of chains over a plane of k and E/g^2 in shades of grey."""
    wide, high = (
        count * max(1, most // count)  # whole pixels for each cell
        for count, most in ((len(sweep["energy"]), WIDE), (len(sweep["k"]), HIGH))
    )
    sheet = Sheet(style.COLUMN, 75 * -(-(BOTTOM + high + 105) // 75))
    frame = (LEFT, BOTTOM, LEFT + wide, BOTTOM + high)
    up = raster.linear(*raster.edges(np.array(sweep["k"]))[[0, -1]], 7, "$k$")
    panel = Window(sheet, frame, energy_axis(sweep["energy"], r"$E/g^2$"), up, grid=False)
    panel.size = panel.small = _SIZE
    raster.minor(panel)
    raster.cells(panel, sweep, data["regular"].values, raster.GREYS)
    raster.scale(sheet, frame, 1.0, raster.GREYS)
    title = "Births of the chains 1/q, and their ends, over the regular share"
    sheet.text(frame[2], frame[3] + 13 * POINT, title, ha="right", va="bottom", size=7.0)
    hues = dict(zip(sweep["chains"], cycle(_HUES), strict=False))
    for order, kind, part in zip(
        curves["order"].values.tolist(), curves["kind"].values.tolist(), rows(curves), strict=True
    ):
        energy, k = (curves[name].values[part] for name in ("energy", "k"))
        color = hues.get(order, style.BLACK)
        panel.line(energy, k, color=color, zorder=2.0, **_STYLES[kind])
        if kind == "resonance":
            _name(panel, energy, k, f"1/{order}")
    for energy in PAPER_ENERGIES.values():
        panel.dots([energy], [PAPER_K], "white", size=5.0)
        panel.dots([energy], [PAPER_K], style.BLACK, size=2.5)
    _key(sheet, hues)
    return sheet.figure


def _name(panel, energy, k, text):
    """Name a curve where it leaves the frame at the top or at the left."""
    inside = panel.within(energy, k)
    if inside.any():
        last = int(np.flatnonzero(inside)[-1])
        x, y = (float(pixel[0]) for pixel in panel.place(energy[last], k[last]))
        x = max(x, panel.frame[0] + 12 * POINT)
        panel.sheet.text(x, y + 3 * POINT, text, ha="center", va="bottom", size=_SIZE)


def _key(sheet, hues):
    """Explain colours, lines and circles below the frame."""
    y = BOTTOM - 150
    for i, (order, color) in enumerate(hues.items()):
        x = LEFT + i * 135
        sheet.draw([x, x + 40], [y, y], color=color, lw=1.3)
        sheet.text(x + 52, y, f"q = {order}", ha="left", va="center", size=_SIZE)
    for kind, text in _MEANINGS.items():
        y -= 38
        sheet.draw([LEFT, LEFT + 90], [y, y], color=style.BLACK, **_STYLES[kind])
        sheet.text(LEFT + 108, y, text, ha="left", va="center", size=_SIZE)
    x = LEFT + 660
    sheet.draw([x], [y], ls="none", marker="o", ms=5.0, mfc="white", mec=style.BLACK, mew=0.4)
    sheet.draw([x], [y], ls="none", marker="o", ms=2.5, color=style.BLACK, mew=0)
    sheet.text(x + 25, y, "Figures 8 and 2", ha="left", va="center", size=_SIZE)
