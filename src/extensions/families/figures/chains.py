"""Births of chains and their losses of stability, drawn over the regular share of a plane."""

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from extensions.atlas.figures import atlas, raster
from extensions.atlas.figures.atlas import LEFT
from pseudorigid.dynamics.variables import rows
from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.names import dense, name_curves
from pseudorigid.figures.canvas.sheet import Sheet

_SIZE = 6.0  # points: text beside lines
_SMALL = 5.5  # points: q beside curves other than the full ones
BOTTOM = 395  # pixels below the frame
_DASHES, _DOTS = (4.0, 1.6), (1.2, 1.6)  # in widths of a line
# The kinds of curve: their style and meaning.
_KINDS: dict[str, tuple[dict[str, Any], str]] = {
    "resonance": ({"lw": 1.3}, "the fixed point's rotation number is 1/q: a chain branches off"),
    "fold": ({"lw": 0.6}, "fold: an elliptic orbit of the chain is born or ends"),
    "doubling": ({"lw": 1.0, "ls": (0, _DASHES)}, "its first period doubling"),
    "rim": ({"lw": 1.0, "ls": (0, _DOTS)}, "it loses an impact, at rest on the floor"),
    "jumps": (
        {"lw": 0.9, "ls": (0, _DASHES + _DOTS)},
        "$E/g^2 = 1 + k/2$: above it the map jumps",
    ),
}


@style.pinned()
def draw(sweep: dict[str, Any], data: xr.Dataset, curves: xr.Dataset) -> Figure:
    """Draw the curves of chains over a plane of k and E/g^2 in shades of grey."""
    sheet = atlas.sheet_above(BOTTOM, sweep)
    text = "Births of the chains 1/q, and their ends, over the regular share"
    panel = atlas.cells(sheet, BOTTOM, sweep, data["regular"].values, 1.0, raster.GREYS, text)
    chains = sorted(sweep["chains"])
    hues = dict(zip(chains, style.ordered(len(chains)), strict=True))
    lines: list[tuple[Any, ...]] = []
    named: list[int] = []
    for order, kind, part in zip(
        curves["order"].values.tolist(), curves["kind"].values.tolist(), rows(curves), strict=True
    ):
        energy, k = (curves[name].values[part] for name in ("energy", "k"))
        color = hues.get(order, style.BLACK)
        panel.line(energy, k, color=color, zorder=2.0, **_KINDS[kind][0])
        if kind == "resonance":
            atlas.name_curve(panel, panel.within(energy, k), energy, k, f"1/{order}")
        named += [len(lines)] if kind not in ("resonance", "jumps") else []
        lines.append((dense(panel.place(energy, k), panel.frame), f"{order}", color))
    others = [line for i, (line, *_) in enumerate(lines) if i not in named]
    places = [np.array(panel.place(at, atlas.PAPER_K)) for at in atlas.PAPER_ENERGIES.values()]
    name_curves(
        sheet,
        [*(lines[i][0] for i in named), *others, *places],
        [lines[i][1] for i in named],
        [lines[i][2] for i in named],
        panel.frame,
        _SMALL,
    )
    for drawn in atlas.PAPER_ENERGIES.values():
        panel.dots([drawn], [atlas.PAPER_K], "white", size=5.0)
        panel.dots([drawn], [atlas.PAPER_K], style.BLACK, size=2.5)
    _key(sheet, hues)
    return sheet.figure


def _key(sheet: Sheet, hues: dict[int, str]) -> None:
    """Explain colours, lines and circles below the frame."""
    y = BOTTOM - 150
    for i, (order, color) in enumerate(hues.items()):
        x = LEFT + i * 135
        sheet.draw([x, x + 40], [y, y], color=color, lw=1.3)
        sheet.text(x + 52, y, f"q = {order}", size=_SIZE)
    for line_style, text in _KINDS.values():
        y -= 38
        sheet.draw([LEFT, LEFT + 90], [y, y], color=style.BLACK, **line_style)
        sheet.text(LEFT + 108, y, text, size=_SIZE)
    x = LEFT + 660
    sheet.draw([x], [y], ls="none", marker="o", ms=5.0, mfc="white", mec=style.BLACK, mew=0.4)
    sheet.draw([x], [y], ls="none", marker="o", ms=2.5, color=style.BLACK, mew=0)
    sheet.text(x + 25, y, "Figures 8 and 2", size=_SIZE)
