"""Rotation number and exponent against the start on y = 0: plateaus, edges, where no twist is."""

import numpy as np

from ...evidence.rotation import island, plateaus, regular
from ..axes.panel import Axis, Panel, corner, key
from ..axes.raster import ticks
from ..canvas import style
from ..canvas.sheet import Sheet

_LEFT, _RIGHT = 135, 1005


@style.pinned()
def draw(scene, rotation):
    """Return the Figure of rotation numbers and exponents.

    Parameters
    ----------
    scene : dict
    rotation : Dataset
        The artifact of that stage.

    Returns
    -------
    Figure
        From above: rotation number and exponent at the first energy, chaotic starts in grey; a
        detail of the rotation number, with the chains of islands that make gaps between curves;
        by how much the rotation number differs from the fixed point's at all energies, as far as
        the main island reaches.
    """
    sheet = Sheet(style.COLUMN, 1950)
    _turns(sheet, (_LEFT, 1565, _RIGHT, 1875), rotation)
    corner(sheet, (_LEFT, 1565, _RIGHT, 1875), style.setting(scene))
    _growth(sheet, (_LEFT, 1265, _RIGHT, 1465), rotation)
    _detail(sheet, (_LEFT, 715, _RIGHT, 1065), rotation)
    _energies(sheet, (_LEFT, 105, _RIGHT, 515), rotation)
    return sheet.figure


def _turns(sheet, frame, rotation):
    place, values = rotation["place"].values[0], rotation["rotation"].values[0]
    good = regular(rotation["exponent"].values[0], rotation.attrs["impacts"])
    fixed = float(rotation["fixed_rotation"].values[0])
    low, high = float(values[good].min()), max(fixed, float(values[good].max()))
    span = high - low
    limits = (low - 0.1 * span, high + 0.1 * span)
    across = Axis(_across(rotation), (-0.4, -0.2, 0, 0.2, 0.4, 0.6, 0.8, 1), labels=("",) * 8)
    panel = Panel(sheet, frame, across, Axis(limits, tuple(ticks(*limits, 5)), "Rotation number"))
    inside = (values > limits[0]) & (values < limits[1])
    panel.dots(place[~good & inside], values[~good & inside], style.BACKDROP, size=1.6)
    panel.dots(place[good], values[good], style.BLUE, size=1.6)
    panel.dots(rotation["fixed_place"].values[:1], [fixed], style.VERMILION, size=3.4)


def _growth(sheet, frame, rotation):
    place, values = rotation["place"].values[0], rotation["exponent"].values[0]
    good = regular(rotation["exponent"].values[0], rotation.attrs["impacts"])
    labels = (-0.4, -0.2, 0, 0.2, 0.4, 0.6, 0.8, 1)
    name = "Start on $y=0$, section radii from the centre"
    across = Axis(_across(rotation), labels, name)
    panel = Panel(sheet, frame, across, Axis((-0.02, 0.3), (0, 0.1, 0.2, 0.3), "Exponent"))
    panel.dots(place[~good], values[~good], style.SEA, size=1.6)
    panel.dots(place[good], values[good], style.BLUE, size=1.6)


def _detail(sheet, frame, rotation):
    place, turns, grown = (
        rotation[f"detail_{name}"].values for name in ("place", "rotation", "exponent")
    )
    good = regular(grown, rotation.attrs["detail_impacts"])
    low, high = float(place[0]), float(place[-1])
    name = "Start on $y=0$, section radii from the centre"
    across = Axis((low, high), tuple(ticks(low, high, 4)), name)
    least, most = float(turns[good].min()), float(turns[good].max())
    limits = (least - 0.05 * (most - least), most + 0.1 * (most - least))
    up = Axis(limits, tuple(ticks(*limits, 4)), "Rotation number, detail")
    panel = Panel(sheet, frame, across, up)
    panel.dots(place[good], turns[good], style.BLUE, size=1.6)
    for p, q, first, last in plateaus(place[good], turns[good]):
        panel.line([first, last], [p / q] * 2, color=style.VERMILION, lw=1.6, zorder=5)
        right = first > low + 0.8 * (high - low)
        ha, shift = ("right", (-2, 3)) if right else ("left", (4, -2))
        va = "bottom" if right else "top"
        panel.note(0.5 * (first + last), p / q, f"{p}/{q}", ha=ha, va=va, shift=shift)


def _across(rotation):
    return float(rotation["fixed_place"].values[0]) - 0.03, 1.0


def _energies(sheet, frame, rotation):
    rows = np.argsort(rotation["energy"].values, kind="stable")
    curves = []
    for row in rows.tolist():
        size = island(rotation, row)
        grown = rotation["exponent"].values[row, :size]
        keep = np.flatnonzero(regular(grown, rotation.attrs["impacts"]))
        fixed = float(rotation["fixed_place"].values[row])
        place = rotation["place"].values[row, keep] - fixed
        change = rotation["rotation"].values[row, keep] - rotation["fixed_rotation"].values[row]
        curves.append((float(rotation["energy"].values[row]), place, change))
    low, high = -0.0125, 0.0125
    far = max(float(place[np.abs(change) < high].max()) for _, place, change in curves)
    far = 0.1 * (int(far / 0.1) + 1) + 0.05
    name = "Start, section radii from the fixed point"
    up = Axis(
        (low, high), (-0.01, -0.005, 0, 0.005, 0.01), "Rotation number, less the fixed point's"
    )
    panel = Panel(sheet, frame, Axis((0.0, far), tuple(ticks(0.0, far, 6)), name), up)
    entries = []
    for number, (energy, place, change) in enumerate(curves):
        shown = np.abs(change) < high
        cut = shown.size if shown.all() else int(np.argmin(shown))
        hue = style.HUES[number % len(style.HUES)]
        dashed = number >= len(style.HUES)
        how = {"ls": "--"} if dashed else {}
        panel.line(place[:cut], change[:cut], color=hue, lw=1.0, **how)
        entries.append((f"$E$ = {style.number(energy)}", hue, "", dashed))
    deep = -(-len(entries) // 2)
    key(sheet, entries, frame[1] + 18 + 39 * (deep - 1), 2, _LEFT + 20, 370, 6.5)
