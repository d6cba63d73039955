"""Positions of periodic orbits against the energy or the inertia, below the regular share."""

from collections.abc import Sequence
from itertools import pairwise, product
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from extensions.atlas.figures.atlas import apart
from pseudorigid.dynamics.variables import rows
from pseudorigid.figures.axes.limits import around, inside, linear
from pseudorigid.figures.axes.panel import Axis, Entry, Window, key, letters, title, upright
from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.names import dense, name_curves
from pseudorigid.figures.canvas.sheet import POINT, Sheet
from pseudorigid.kernel.closed_forms import twice_energy_above_rest

LEFT, RIGHT = 125, 1000  # pixels
_WIDTHS = {"elliptic": 1.7, "hyperbolic": 0.45, "inverse hyperbolic": 0.6}
_MARKS = {"fold": "o", "doubling": "s", "pitchfork": "D", "resonance": "^", "grazing": "x"}
_NAMES = {"doubling": "period doubling", "grazing": "an impact grazes"}  # of marks in the key
_APART = 14  # pixels: the least between two marks
_NAMED = 6.5  # points: periods beside lines
Lines = dict[int, tuple[slice, int, str]]  # family -> its points, period and colour
_MARK = np.array(list(product((-5, 0, 5), repeat=2)))[:, :, None]  # pixels: steps in a mark


@style.pinned()
def draw(scene: dict[str, Any], families: xr.Dataset, shares: xr.Dataset) -> Figure:
    """Draw the regular share and positions of families over one axis of E or k.

    Lines of elliptic orbits are thick, of hyperbolic ones thin, of inverse hyperbolic ones dashed.
    Above are the fixed point's resonances. Families of a period above scene["drawn"] are left out.
    """
    sheet = Sheet(style.COLUMN, 2025)
    across, parameter = abscissa(scene), scene["parameter"]
    up = linear(0.0, min(1.0, 1.1 * float(shares["regular_high"].values.max())), 5)
    above = Window(sheet, (LEFT, 1425, RIGHT, 1875), across.blank(), up)
    x, rim = families["x"].values, _rim(scene)
    up = around(x, 0.04, 8)
    if not inside([up.limits] * 2, rim[1:]).all():
        up = around(np.append(x, rim[1:]), 0.04, 8)
    below = Window(sheet, (LEFT, 340, RIGHT, 1345), across, up)
    left, bottom, right, top = above.frame  # its title is above the names of resonances
    letters(sheet, (left, bottom, right, top + 10 * POINT), below.frame)
    title(sheet, above.frame, "Regular share of the section", 14)
    title(sheet, below.frame, "Position $x$ of the orbit's point on a symmetry line")
    resonances((above, below), parameter, families)
    at, share = (shares[name].values for name in (parameter, "regular"))
    least, most = (shares[f"regular_{end}"].values for end in ("low", "high"))
    above.estimates(at, share, least, most, style.BLUE)
    for end in rim[1:]:
        below.line(rim[0], end, color=style.BACKDROP, lw=1.0)
    shown = lines(scene, families)
    for span, _, hue in shown.values():
        stable_pieces(below, families, x, span, hue)
    marks, places = _events(below, parameter, families, shown)
    names(below, families[parameter].values, x, shown, np.hstack([places + by for by in _MARK]))
    rim_entry = ("rim of the section", style.BACKDROP, "", False, 1.0)
    entries = [(_NAMES.get(k, k), style.BLACK, mark, True) for k, mark in _MARKS.items()
               if k in marks]  # fmt: skip
    keys(sheet, scene, families, shown, [rim_entry, *entries])
    return sheet.figure


def abscissa(scene: dict[str, Any]) -> Axis:
    """Return the axis of the parameter."""
    name = "Energy $E$" if scene["parameter"] == "energy" else "Euler inertia $k$"
    low, high = scene["span"]
    return linear(low, high, 7, name)


def lines(scene: dict[str, Any], families: xr.Dataset) -> Lines:
    """Return the points, the period and the colour of each family that is drawn, by its number."""
    period = families["period"].values.tolist()
    spans = enumerate(zip(rows(families), period, strict=True))
    shown = {i: (span, n) for i, (span, n) in spans if n <= scene["drawn"]}
    periods = sorted({n for _, n in shown.values()})
    hues = dict(zip(periods, style.ordered(len(periods)), strict=True))
    return {i: (span, n, hues[n]) for i, (span, n) in shown.items()}


def names(
    panel: Window, across: np.ndarray, up: np.ndarray, shown: Lines, others: np.ndarray
) -> None:
    """Write the period of each family beside its line, apart from other points in pixels (2, n)."""
    curves = [
        dense(panel.place(across[span], up[span]), panel.frame) for span, *_ in shown.values()
    ]
    texts, hues = ([f"{n}" for _, n, _ in shown.values()], [hue for *_, hue in shown.values()])
    name_curves(panel.sheet, [*curves, others], texts, hues, panel.frame, _NAMED)


def stable_pieces(
    panel: Window, families: xr.Dataset, heights: np.ndarray, span: slice, hue: str
) -> None:
    """Draw one family, in pieces of one type of stability."""
    across = families[families.attrs["parameter"]].values[span]
    up, types = heights[span], families["type"].values[span]
    changes = [0, *(np.flatnonzero(types[1:] != types[:-1]) + 1).tolist(), types.size]
    for first, last in pairwise(changes):
        kind, piece = str(types[first]), slice(first, last + 1)
        dashes = {"ls": (0, (4.0, 2.5))} if kind == "inverse hyperbolic" else {}
        panel.line(across[piece], up[piece], color=hue, lw=_WIDTHS[kind], **dashes)


def _events(
    panel: Window, parameter: str, families: xr.Dataset, shown: Lines
) -> tuple[set[str], np.ndarray]:
    """Mark events and ends of families, one where marks would cover one another.

    Return which kinds there are, and the places of the marks in pixels (2, n).
    """
    number, order = (families[f"event_{name}"].values for name in ("family", "order"))
    across, up, kinds = (families[f"event_{name}"].values for name in (parameter, "x", "kind"))
    few = (order * families["period"].values[number] <= 12) & (order <= 6)
    found: list[tuple[Any, ...]] = [
        (kind, x, y, family)
        for kind, x, y, family, one in zip(kinds, across, up, number, few, strict=True)
        if one or kind != "resonance"  # of longer chains there are too many
    ]
    for index, (span, *_) in shown.items():
        for side, last in ((0, span.start), (1, span.stop - 1)):
            end = families["end_kind"].values[index, side]
            kind = "grazing" if end in ("touch", "rim") else str(end)
            found.append((kind, *(families[name].values[last] for name in (parameter, "x")), index))
    found = [each for each in found if each[0] in _MARKS and each[3] in shown]
    marked, places = set(), np.empty((2, 0))
    for kind, x, y, family in sorted(found, key=lambda each: [*_MARKS].index(each[0])):
        place = np.array(panel.place(x, y))
        if np.abs(places - place).max(axis=0).min(initial=np.inf) > _APART:
            hue = shown[family][2]
            panel.dots([x], [y], hue, 2.6, hollow=True, marker=_MARKS[kind])
            marked.add(kind)
            places = np.hstack([places, place])
    return marked, places


def _rim(scene: dict[str, Any]) -> np.ndarray:
    """Return values of the parameter, and both ends of the symmetry line y = 0 there."""
    low, high = scene["span"]
    value = low + (high - low) * (np.arange(401) / 400.0)
    of_rim = {"energy": scene["energy"], **scene["ball"], scene["parameter"]: value}
    energy, k, g = (of_rim[name] for name in ("energy", "k", "g"))
    radius = np.sqrt(twice_energy_above_rest(k, g, energy) / k)
    return np.array([value, g / k - radius, g / k + radius])


def resonances(panels: Sequence[Window], parameter: str, families: xr.Dataset) -> None:
    """Draw an upright line at each resonance of the fixed point up to order 8, with its name."""
    for panel in panels:
        panel.minor()
    order = families["event_order"].values
    chosen = (families["event_family"].values == 0) & (order > 2) & (order <= 8)
    names = f"event_{parameter}", "event_turns", "event_order"
    resonances = zip(*(families[name].values[chosen].tolist() for name in names), strict=True)
    drawn = sorted(resonances)
    lines = [upright(panels, value, color=style.BACKDROP, lw=0.7, ls=":") for value, *_ in drawn]
    for (_, p, q), x in zip(drawn, apart(lines), strict=True):
        up = panels[0].frame[3] + 3 * POINT
        panels[0].sheet.text(x, up, f"{p}/{q}", ha="center", va="bottom", size=6.0)


def keys(
    sheet: Sheet, scene: dict[str, Any], families: xr.Dataset, shown: Lines, more: Sequence[Entry]
) -> None:
    """Explain the widths, marks and colours that are drawn; write the ball above."""
    types = {str(kind) for span, *_ in shown.values() for kind in families["type"].values[span]}
    widths = ((kind, width) for kind, width in _WIDTHS.items() if kind in types)
    entries: list[Entry] = [
        (kind, style.BLACK, "", "inverse" in kind, width) for kind, width in widths
    ]
    entries += more
    key(sheet, entries, 65 + 50 * -(-len(entries) // 3), 3, LEFT - 10, 900, 7.0)
    hues = {f"{n}": hue for _, n, hue in sorted(shown.values(), key=lambda line: line[1])}
    sheet.text(LEFT - 30, 65, "period", size=7.0)
    entries = [(period, hue, "", False, 1.7) for period, hue in hues.items()]
    key(sheet, entries, 65, 10, LEFT + 80, 820, 7.0)
    fixed = {name: scene["ball"][name] for name in "kg" if name != scene["parameter"]}
    setting = style.setting(scene | {"ball": fixed}, energy=scene["parameter"] == "k")
    sheet.text(RIGHT, sheet.high - 40, setting, ha="right", va="center", size=7.0)
