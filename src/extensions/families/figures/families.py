"""Families of periodic orbits against the energy or the inertia, below the regular share."""

from collections.abc import Sequence
from itertools import pairwise, product
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from extensions.atlas.figures.atlas import apart
from pseudorigid.dynamics.variables import rows
from pseudorigid.figures.axes.limits import around, inside, linear
from pseudorigid.figures.axes.panel import Window, key, letters, title, upright
from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.names import dense, name_curves
from pseudorigid.figures.canvas.sheet import POINT, Sheet
from pseudorigid.kernel.closed_forms import twice_energy_above_rest

_LEFT, _RIGHT = 125, 1000  # pixels
_WIDTHS = {"elliptic": 1.7, "hyperbolic": 0.45, "inverse hyperbolic": 0.6}
_MARKS = {"fold": "o", "doubling": "s", "pitchfork": "D", "resonance": "^", "grazing": "x"}
_NAMES = {"doubling": "period doubling", "grazing": "an impact grazes"}  # of marks in the key
_RESIDUES = -0.6, 1.6
_NAMED = 6.5  # points: periods beside lines
_MARK = np.array(list(product((-5, 0, 5), repeat=2)))[:, :, None]  # pixels: steps in a mark


@style.pinned()
def draw(scene: dict[str, Any], families: xr.Dataset, shares: xr.Dataset) -> Figure:
    """Draw regular share, positions and residues of families over one axis of E or k.

    Lines of elliptic orbits are thick, of hyperbolic ones thin, of inverse hyperbolic ones dashed.
    Above are the fixed point's resonances. Families of a period above scene["drawn"] are left out.
    """
    sheet = Sheet(style.COLUMN, 2400)
    (low, high), parameter = scene["span"], scene["parameter"]
    name = "Energy $E$" if parameter == "energy" else "Euler inertia $k$"
    across = linear(low, high, 7, name)
    up = linear(0.0, min(1.0, 1.1 * float(shares["regular_high"].values.max())), 5)
    above = Window(sheet, (_LEFT, 1800, _RIGHT, 2250), across.blank(), up)
    x, rim = families["x"].values, _rim(scene)
    up = around(x, 0.04, 8)
    if not inside([up.limits] * 2, rim[1:]).all():
        up = around(np.append(x, rim[1:]), 0.04, 8)
    middle = Window(sheet, (_LEFT, 775, _RIGHT, 1720), across.blank(), up)
    below = Window(sheet, (_LEFT, 340, _RIGHT, 695), across, linear(*_RESIDUES, 5))
    left, bottom, right, top = above.frame  # its title stands above the names of resonances
    letters(sheet, (left, bottom, right, top + 10 * POINT), middle.frame, below.frame)
    title(sheet, above.frame, "Regular share of the section", 14)
    title(sheet, middle.frame, "Position $x$ of the orbit's point on a symmetry line")
    for panel in (above, middle, below):
        panel.minor()
    _resonances((above, middle, below), parameter, families)
    at, share = (shares[name].values for name in (parameter, "regular"))
    least, most = (shares[f"regular_{end}"].values for end in ("low", "high"))
    above.estimates(at, share, least, most, style.BLUE)
    for end in rim[1:]:
        middle.line(rim[0], end, color=style.BACKDROP, lw=1.0)
    period, spans = families["period"].values.tolist(), rows(families)
    shown = {i: spans[i] for i, n in enumerate(period) if n <= scene["drawn"]}
    values, types = families[parameter].values, families["type"].values
    periods = sorted({period[i] for i in shown})
    hues = dict(zip(periods, style.ordered(len(periods)), strict=True))
    # Near grazing the residue grows without bound.
    residue = np.clip(0.25 * (2.0 - families["trace"].values), -50.0, 50.0)
    for level in (0.0, 1.0):
        below.line([low, high], [level, level], color=style.FRAME, lw=0.5)
    for i, span in shown.items():
        for panel, heights in ((middle, x), (below, residue)):
            _family(panel, values[span], heights[span], types[span], hues[period[i]])
    leaves = [_exits(below, values[s], residue[s], hues[period[i]]) for i, s in shown.items()]
    title(
        sheet, below.frame, "Residue $(2-$trace$)/4$" + "; triangles: beyond the axis" * any(leaves)
    )
    marks, at = _events(middle, parameter, families, shown)
    around_marks = np.hstack([np.array(middle.place(*at)) + shift for shift in _MARK])
    stability = {str(kind) for span in shown.values() for kind in types[span]}
    for panel, heights in ((middle, x), (below, residue)):
        curves = [
            dense(panel.place(values[span], heights[span]), panel.frame) for span in shown.values()
        ]
        curves.append(around_marks if panel is middle else around_marks[:, :0])
        texts = [f"{period[i]}" for i in shown]
        name_curves(sheet, curves, texts, [hues[period[i]] for i in shown], panel.frame, _NAMED)
    _keys(sheet, stability, marks, hues)
    fixed = {name: scene["ball"][name] for name in "kg" if name != parameter}
    setting = style.setting(scene | {"ball": fixed}, energy=parameter == "k")
    sheet.text(_RIGHT, 2360, setting, ha="right", va="center", size=7.0)
    return sheet.figure


def _family(panel: Window, across: np.ndarray, up: np.ndarray, types: np.ndarray, hue: str) -> None:
    """Draw one family, in pieces of one type of stability."""
    changes = [0, *(np.flatnonzero(types[1:] != types[:-1]) + 1).tolist(), types.size]
    for first, last in pairwise(changes):
        kind, piece = str(types[first]), slice(first, last + 1)
        dashes = {"ls": (0, (4.0, 2.5))} if kind == "inverse hyperbolic" else {}
        panel.line(across[piece], up[piece], color=hue, lw=_WIDTHS[kind], **dashes)


def _exits(panel: Window, across: np.ndarray, residue: np.ndarray, hue: str) -> int:
    """Mark where a family leaves the axis of residues, and return how often it does."""
    count = 0
    for end, inner, marker in ((_RESIDUES[1], 1.56, "^"), (_RESIDUES[0], -0.56, "v")):
        beyond = (residue > end) == (end > 0.0)
        i = np.flatnonzero(beyond[1:] != beyond[:-1])
        share = (end - residue[i]) / (residue[i + 1] - residue[i])
        x = across[i] + share * (across[i + 1] - across[i])
        panel.dots(x, 0.0 * x + inner, hue, 2.6, marker=marker)
        count += i.size
    return count


def _events(
    panel: Window, parameter: str, families: xr.Dataset, shown: dict[int, slice]
) -> tuple[set[str], np.ndarray]:
    """Mark events and ends of families; return which kinds there are, and the points (2, n)."""
    marked, points = set(), [np.empty((2, 0))]
    number, order = (families[f"event_{name}"].values for name in ("family", "order"))
    across, up, kinds = (families[f"event_{name}"].values for name in (parameter, "x", "kind"))
    few = (order * families["period"].values[number] <= 12) & (order <= 6)
    for kind, marker in _MARKS.items():
        chosen = np.isin(number, [*shown]) & (kinds == kind)
        if kind == "resonance":  # of longer chains there are too many
            chosen &= few
        panel.dots(across[chosen], up[chosen], style.BLACK, 2.6, hollow=True, marker=marker)
        marked |= {kind} if chosen.any() else set()
        points.append(np.array([across[chosen], up[chosen]]))
    for index, span in shown.items():
        for side, last in ((0, span.start), (1, span.stop - 1)):
            end = families["end_kind"].values[index, side]
            kind = "grazing" if end in ("touch", "rim") else str(end)
            if kind in _MARKS:
                x, y = (families[name].values[last] for name in (parameter, "x"))
                panel.dots([x], [y], style.BLACK, 2.6, hollow=True, marker=_MARKS[kind])
                marked.add(kind)
                points.append(np.array([[x], [y]]))
    return marked, np.hstack(points)


def _rim(scene: dict[str, Any]) -> np.ndarray:
    """Return values of the parameter, and both ends of the symmetry line y = 0 there."""
    low, high = scene["span"]
    value = low + (high - low) * (np.arange(401) / 400.0)
    of_rim = {"energy": scene["energy"], **scene["ball"], scene["parameter"]: value}
    energy, k, g = (of_rim[name] for name in ("energy", "k", "g"))
    radius = np.sqrt(twice_energy_above_rest(k, g, energy) / k)
    return np.array([value, g / k - radius, g / k + radius])


def _resonances(panels: Sequence[Window], parameter: str, families: xr.Dataset) -> None:
    """Draw an upright line at each resonance of the fixed point up to order 8, with its name."""
    order = families["event_order"].values
    chosen = (families["event_family"].values == 0) & (order > 2) & (order <= 8)
    names = f"event_{parameter}", "event_turns", "event_order"
    resonances = zip(*(families[name].values[chosen].tolist() for name in names), strict=True)
    drawn = sorted(resonances)
    lines = [upright(panels, value, color=style.BACKDROP, lw=0.7, ls=":") for value, *_ in drawn]
    for (_, p, q), x in zip(drawn, apart(lines), strict=True):
        up = panels[0].frame[3] + 3 * POINT
        panels[0].sheet.text(x, up, f"{p}/{q}", ha="center", va="bottom", size=6.0)


def _keys(sheet: Sheet, types: set[str], marks: set[str], hues: dict[int, str]) -> None:
    """Explain the widths, marks and colours that are drawn."""
    widths = ((kind, width) for kind, width in _WIDTHS.items() if kind in types)
    entries = [
        *((kind, style.BLACK, "", "inverse" in kind, width) for kind, width in widths),
        ("rim of the section", style.BACKDROP, "", False, 1.0),
        *((_NAMES.get(k, k), style.BLACK, mark, True) for k, mark in _MARKS.items() if k in marks),
    ]
    key(sheet, entries, 215, 3, _LEFT - 10, 900, 7.0)
    entries = [(f"{period}", hue, "", False, 1.7) for period, hue in hues.items()]
    sheet.text(_LEFT - 30, 65, "period", size=7.0)
    key(sheet, entries, 65, 10, _LEFT + 80, 820, 7.0)
