"""Positions of periodic orbits against the energy or the inertia, below the regular share."""

from collections.abc import Sequence
from itertools import chain, pairwise, product
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
_STYLES: dict[str, dict[str, Any]] = {
    "elliptic": {"color": style.BLUE, "lw": 1.7},
    "hyperbolic": {"color": style.BLACK, "lw": 0.5},
    "inverse hyperbolic": {"color": style.VERMILION, "lw": 0.8, "ls": (0, (4.0, 2.5))},
}
_MARKS = {"fold": "o", "doubling": "s", "pitchfork": "D", "resonance": "^", "grazing": "x"}
_NAMES = {"doubling": "period doubling", "grazing": "an impact grazes"}  # of marks in the key
_APART = 14  # pixels: the least between two marks
_NAMED = 6.5  # points: periods beside lines
Lines = dict[int, tuple[slice, int]]  # family -> its points and period
Piece = tuple[np.ndarray, str]  # points in pixels (2, n), and their colour
MARK = np.array(list(product((-5, 0, 5), repeat=2)))[:, :, None]  # pixels: steps in a mark


@style.pinned()
def draw(scene: dict[str, Any], families: xr.Dataset, shares: xr.Dataset) -> Figure:
    """Draw the regular share and positions of families over one axis of E or k.

    Lines of elliptic orbits are thick, of hyperbolic ones thin, of inverse hyperbolic ones dashed,
    each in a colour; a number beside a line is the family's period. Above are the fixed point's
    resonances. Families of a period above scene["drawn"] are left out.
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
    others = []
    for end in rim[1:]:
        below.line(rim[0], end, color=style.SEA, lw=1.0)
        others.append(dense(below.place(rim[0], end), below.frame))
    shown = lines(scene, families)
    drawn = stable_pieces(below, families, x, shown)
    marks, places = _events(below, parameter, families, shown)
    names(below, drawn, shown, np.hstack([*others, *(places + by for by in MARK)]))
    rim_entry = ("rim of the section", style.SEA, "", False, 1.0)
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
    """Return the points and the period of each family that is drawn, by its number."""
    spans = enumerate(zip(rows(families), families["period"].values.tolist(), strict=True))
    return {i: (span, n) for i, (span, n) in spans if n <= scene["drawn"]}


def stable_pieces(
    panel: Window, families: xr.Dataset, heights: np.ndarray, shown: Lines
) -> list[list[Piece]]:
    """Draw families in pieces of one type of stability, and return the pieces of each."""
    across, types = families[families.attrs["parameter"]].values, families["type"].values
    drawn = []
    for span, _ in shown.values():
        kinds = types[span]
        turns = np.flatnonzero(kinds[1:] != kinds[:-1]) + 1
        ends = (span.start + np.array([0, *turns, kinds.size])).tolist()
        drawn.append(list[Piece]())
        for first, last in pairwise(ends):
            piece, look = slice(first, min(last + 1, span.stop)), _STYLES[str(types[first])]
            panel.line(across[piece], heights[piece], **look)
            place = panel.place(across[piece], heights[piece])
            drawn[-1].append((dense(place, panel.frame), look["color"]))
    return drawn


def names(panel: Window, drawn: list[list[Piece]], shown: Lines, others: np.ndarray) -> None:
    """Write the period of each family beside the longest of its pieces that are seen.

    Periods are apart from other points in pixels, (2, n).
    """
    ordered = [sorted(pieces, key=lambda piece: -piece[0].shape[1]) for pieces in drawn]
    longest, rest = [pieces[0] for pieces in ordered], [pieces[1:] for pieces in ordered]
    curves = [points for points, _ in [*longest, *chain(*rest)]]
    texts, hues = [f"{n}" for _, n in shown.values()], [hue for _, hue in longest]
    name_curves(panel.sheet, [*curves, others], texts, hues, panel.frame, _NAMED)


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
    for index, (span, _) in shown.items():
        for side, last in ((0, span.start), (1, span.stop - 1)):
            end = families["end_kind"].values[index, side]
            kind = "grazing" if end in ("touch", "rim") else str(end)
            found.append((kind, *(families[name].values[last] for name in (parameter, "x")), index))
    found = [each for each in found if each[0] in _MARKS and each[3] in shown]
    marked, places = set(), np.empty((2, 0))
    for kind, x, y, _ in sorted(found, key=lambda each: [*_MARKS].index(each[0])):
        place = np.array(panel.place(x, y))
        if np.abs(places - place).max(axis=0).min(initial=np.inf) > _APART:
            panel.dots([x], [y], style.BLACK, 2.8, hollow=True, marker=_MARKS[kind])
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
    """Explain the lines and marks that are drawn; write the ball above."""
    types = {str(kind) for span, _ in shown.values() for kind in families["type"].values[span]}
    entries: list[Entry] = [
        (kind, look["color"], "", "ls" in look, look["lw"])
        for kind, look in _STYLES.items()
        if kind in types
    ]
    entries += more
    key(sheet, entries, 65 + 50 * -(-len(entries) // 3), 3, LEFT - 10, 900, 7.0)
    sheet.text(LEFT - 20, 65, "A number beside a line is the period of its orbits.", size=7.0)
    fixed = {name: scene["ball"][name] for name in "kg" if name != scene["parameter"]}
    setting = style.setting(scene | {"ball": fixed}, energy=scene["parameter"] == "k")
    sheet.text(RIGHT, sheet.high - 40, setting, ha="right", va="center", size=7.0)
