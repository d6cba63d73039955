"""Families of periodic orbits against the energy or the inertia, below the regular share."""

from itertools import pairwise

import numpy as np

from ..axes import raster
from ..axes.panel import Window, key
from ..canvas import style
from ..canvas.sheet import POINT, Sheet

_LEFT, _RIGHT = 125, 1000  # pixels
_SIZE = 6.0  # points: names of resonances
_NAME = 50  # pixels: room for the name of a resonance
# Colours by period; a longer period has that of the period less a multiple of their number.
_HUES = (*style.HUES, style.SEA)
_WIDTHS = {"elliptic": 1.7, "hyperbolic": 0.5, "inverse hyperbolic": 0.6}
_MARKS = {"fold": "o", "doubling": "s", "pitchfork": "D", "resonance": "^"}
_RESIDUES = -0.6, 1.6


@style.pinned()
def draw(scene, families, shares):
    """Draw regular share, positions and residues of families over one axis of E or k.

    Lines of elliptic orbits are thick, of hyperbolic ones thin, of inverse hyperbolic ones dashed.
    Above are the fixed point's resonances. Families of a period above scene["drawn"] are left out.
    """
    sheet = Sheet(style.COLUMN, 2400)
    low, high = scene["span"]
    name = "Energy $E$" if scene["parameter"] == "energy" else "Euler inertia $k$"
    across = raster.linear(low, high, 7, name)
    share = _share_axis(shares)
    above = Window(sheet, (_LEFT, 1945, _RIGHT, 2250), across.blank(), share)
    x_low, x_high = _positions(families)
    middle = Window(
        sheet, (_LEFT, 775, _RIGHT, 1865), across.blank(), raster.linear(x_low, x_high, 8)
    )
    below = Window(sheet, (_LEFT, 340, _RIGHT, 695), across, raster.linear(*_RESIDUES, 5))
    for panel, text in (
        (above, "Regular share of the section"),
        (middle, "Position $x$ of the orbit's point on a symmetry line"),
        (below, "Residue $(2-$trace$)/4$"),
    ):
        raster.minor(panel)
        top = panel.frame[3] + (14 if panel is above else 4) * POINT
        sheet.text(_LEFT, top, text, ha="left", va="bottom", size=7.0)
    _resonances(sheet, (above, middle, below), scene, families)
    _shares(above, scene, shares)
    _rim(middle, scene)
    shown = [i for i, n in enumerate(families["period"].values) if n <= scene["drawn"]]
    # Near grazing the residue grows without bound.
    residue = np.clip(0.25 * (2.0 - families["trace"].values), -50.0, 50.0)
    for level in (0.0, 1.0):
        below.line([low, high], [level, level], color=style.FRAME, lw=0.5)
    for i in shown:
        _family(middle, scene, families, i, families["x"].values)
        _family(below, scene, families, i, residue)
    _events(middle, scene, families, set(shown))
    _keys(sheet, families, shown)
    sheet.text(_RIGHT, 2360, style.setting(scene, energy=scene["parameter"] == "k"),
               ha="right", va="center", size=7.0)  # fmt: skip
    return sheet.figure


def _parameter(scene):
    return "energy" if scene["parameter"] == "energy" else "k"


def _share_axis(shares):
    """Return an axis to above the largest share in the upper two thirds of the span."""
    values = shares["regular_high"].values
    return raster.linear(0.0, min(1.0, 1.1 * float(values[values.size // 3 :].max())), 4)


def _positions(families):
    """Return least and largest position with some room."""
    x = families["x"].values
    room = 0.04 * float(x.max() - x.min())
    return float(x.min()) - room, float(x.max()) + room


def _spans(families):
    """Return the slices of the families' points."""
    ends = np.cumsum(families["row_size"].values)
    return [slice(int(end - size), int(end)) for end, size in zip(ends, families["row_size"].values,
            strict=True)]  # fmt: skip


def _family(panel, scene, families, index, values):
    """Draw one family, in pieces of one type of stability."""
    span = _spans(families)[index]
    across = families[_parameter(scene)].values[span]
    up, types = values[span], families["type"].values[span]
    hue = _hue(int(families["period"].values[index]))
    changes = [0, *(np.flatnonzero(types[1:] != types[:-1]) + 1).tolist(), types.size]
    for first, last in pairwise(changes):
        kind = str(types[first])
        end = min(last + 1, types.size)
        dashes = {"ls": (0, (4.0, 2.5))} if kind == "inverse hyperbolic" else {}
        panel.line(across[first:end], up[first:end], color=hue, lw=_WIDTHS[kind], **dashes)


def _hue(period):
    return _HUES[(period - 1) % len(_HUES)]


def _events(panel, scene, families, shown):
    """Mark events, and ends where an impact grazes."""
    number = families["event_family"].values
    chosen = np.isin(number, sorted(shown))
    across = families[f"event_{_parameter(scene)}"].values
    up, kinds = families["event_x"].values, families["event_kind"].values
    for kind, marker in _MARKS.items():
        at = chosen & (kinds == kind)
        if kind == "resonance":  # of longer chains there are too many
            at &= families["event_order"].values * families["period"].values[number] <= 12
            at &= families["event_order"].values <= 6
        panel.dots(across[at], up[at], style.BLACK, 2.6, hollow=True, marker=marker)
    spans = _spans(families)
    for index in sorted(shown):
        for side, last in ((0, spans[index].start), (1, spans[index].stop - 1)):
            if families["end_kind"].values[index, side] in ("touch", "rim"):
                x, y = families[_parameter(scene)].values[last], families["x"].values[last]
                panel.dots([x], [y], style.BLACK, 2.6, hollow=True, marker="x")


def _shares(panel, scene, shares):
    """Draw the regular share with its interval."""
    across = shares[_parameter(scene)].values
    panel.line(across, shares["regular"].values, color=style.pale(style.BLUE), lw=0.6)
    ends = (shares[f"regular_{end}"].values for end in ("low", "high"))
    panel.bars(across, *ends, color=style.BLUE, lw=0.7)
    panel.dots(across, shares["regular"].values, style.BLUE, 1.7)


def _rim(panel, scene):
    """Draw the ends of the symmetry line y = 0."""
    low, high = scene["span"]
    g, steps = scene["ball"]["g"], np.arange(401) / 400.0
    value = low + (high - low) * steps
    if scene["parameter"] == "energy":
        k, energy = np.full(value.size, scene["ball"]["k"]), value
    else:
        k, energy = value, np.full(value.size, scene["energy"])
    radius = np.sqrt((2.0 * energy + g * g / k) / k)
    for sign in (-1.0, 1.0):
        panel.line(value, g / k + sign * radius, color=style.BACKDROP, lw=1.0)


def _resonances(sheet, panels, scene, families):
    """Draw an upright line at each resonance of the fixed point up to order 8, with its name."""
    order = families["event_order"].values
    chosen = (families["event_family"].values == 0) & (order > 2) & (order <= 8)
    at = families[f"event_{_parameter(scene)}"].values[chosen]
    turns = families["event_turns"].values[chosen]
    rows = sorted(zip(at.tolist(), turns.tolist(), order[chosen].tolist(), strict=True))
    reach = -np.inf
    for value, p, q in rows:
        x = float(panels[0].place(value, 0.0)[0][0])
        for panel in panels:
            _, bottom, _, top = panel.frame
            sheet.draw([x, x], [bottom, top], color=style.BACKDROP, lw=0.5, zorder=0.8)
        if x - reach >= _NAME:
            up = panels[0].frame[3] + 3 * POINT
            sheet.text(x, up, f"{p}/{q}", ha="center", va="bottom", size=_SIZE)
            reach = x


def _keys(sheet, families, shown):
    """Explain widths, marks and colours."""
    entries = [
        ("elliptic", style.BLACK, "", False, 1.7),
        ("hyperbolic", style.BLACK, "", False, 0.5),
        ("inverse hyperbolic", style.BLACK, "", True, 0.6),
        ("rim of the section", style.BACKDROP, "", False, 1.0),
        ("fold", style.BLACK, "o", True),
        ("period doubling", style.BLACK, "s", True),
        ("pitchfork", style.BLACK, "D", True),
        ("resonance", style.BLACK, "^", True),
        ("an impact grazes", style.BLACK, "x", True),
    ]
    key(sheet, entries, 215, 3, _LEFT - 10, 900, 7.0)
    periods = sorted({int(families["period"].values[i]) for i in shown})
    entries = [(f"{n}", _hue(n), "", False, 1.7) for n in periods]
    sheet.text(_LEFT - 30, 65, "period", ha="left", va="center", size=7.0)
    key(sheet, entries, 65, 10, _LEFT + 80, 820, 7.0)
