"""Rotation number and exponent against the start on y = 0: plateaus, edges, where no twist is."""

import numpy as np

from ...evidence.rotation import island, plateaus, regular
from ..axes.panel import Axis, Panel, corner, key
from ..axes.raster import linear, wider
from ..canvas import style
from ..canvas.sheet import Sheet

_LEFT, _RIGHT = 135, 1005
_STARTS = "Start on $y=0$, section radii from the centre"
_HIGH = 0.0125  # half the height of the lowest panel
_HUES = (*style.HUES, style.SEA)


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
    sheet = Sheet(style.COLUMN, 2025)
    entries = [
        ("regular", style.BLUE, "o", False),
        ("chaotic", style.SEA, "o", False),
        ("fixed point", style.VERMILION, "o", False),
        ("islands", style.VERMILION, "", False, 1.6),
    ]
    key(sheet, entries, sheet.high - 34, 4, _LEFT + 10, _RIGHT - _LEFT)
    _first_energy(sheet, scene, rotation)
    _detail(sheet, (_LEFT, 715, _RIGHT, 1065), rotation)
    _energies(sheet, (_LEFT, 105, _RIGHT, 515), rotation)
    return sheet.figure


def _first_energy(sheet, scene, rotation):
    place, turns, grown = (rotation[name].values[0] for name in ("place", "rotation", "exponent"))
    good = regular(grown, rotation.attrs["impacts"])
    at, fixed = (float(rotation[f"fixed_{name}"].values[0]) for name in ("place", "rotation"))
    across = Axis((at - 0.03, 1.0), (-0.4, -0.2, 0, 0.2, 0.4, 0.6, 0.8, 1), _STARTS)
    regulars = turns[good] if good.any() else turns
    limits = wider(*_span(np.append(regulars, fixed)), 0.1, 0.1)
    above = _LEFT, 1565, _RIGHT, 1875
    panel = Panel(sheet, above, across.blank(), linear(*limits, 5, "Rotation number"))
    shown = ~good & (turns > limits[0]) & (turns < limits[1])
    panel.dots(place[shown], turns[shown], style.SEA, size=1.6)
    panel.dots(place[good], turns[good], style.BLUE, size=1.6)
    panel.dots([at], [fixed], style.VERMILION, size=3.4)
    corner(sheet, above, style.setting(scene))
    up = Axis((-0.02, 0.3), (0, 0.1, 0.2, 0.3), "Exponent")
    panel = Panel(sheet, (_LEFT, 1265, _RIGHT, 1465), across, up)
    panel.dots(place[~good], grown[~good], style.SEA, size=1.6)
    panel.dots(place[good], grown[good], style.BLUE, size=1.6)


def _span(values):
    """Least and largest of some numbers that may have NaN, apart even where they are one."""
    low, high = float(np.nanmin(values)), float(np.nanmax(values))
    return (low, high) if high > low else (low - 0.01, high + 0.01)


def _detail(sheet, frame, rotation):
    place, turns, grown = (
        rotation[f"detail_{name}"].values for name in ("place", "rotation", "exponent")
    )
    good = regular(grown, rotation.attrs["detail_impacts"])
    across = linear(place[0], place[-1], 4, _STARTS)
    limits = wider(*_span(turns[good] if good.any() else turns), 0.05, 0.2)
    panel = Panel(sheet, frame, across, linear(*limits, 4, "Rotation number, detail"))
    panel.dots(place[good], turns[good], style.BLUE, size=1.6)
    for p, q, first, last in plateaus(place[good], turns[good]):
        panel.line([first, last], [p / q] * 2, color=style.VERMILION, lw=1.6, zorder=5)
        how = {"ha": "left", "va": "top", "shift": (4, -2)}
        if first > place[0] + 0.8 * (place[-1] - place[0]):
            how = {"ha": "right", "va": "bottom", "shift": (-2, 3)}
        panel.note(0.5 * (first + last), p / q, f"{p}/{q}", **how)


def _energies(sheet, frame, rotation):
    curves = []
    for row in np.argsort(rotation["energy"].values, kind="stable").tolist():
        grown = rotation["exponent"].values[row, : island(rotation, row)]
        keep = np.flatnonzero(regular(grown, rotation.attrs["impacts"]))
        fixed = float(rotation["fixed_place"].values[row])
        place = rotation["place"].values[row, keep] - fixed
        change = rotation["rotation"].values[row, keep] - rotation["fixed_rotation"].values[row]
        curves.append((float(rotation["energy"].values[row]), place, change))
    near = [place[np.abs(change) < _HIGH] for _, place, change in curves]
    far = max((float(place.max()) for place in near if place.size), default=0.0)
    far = 0.1 * (int(far / 0.1) + 1) + 0.05
    across = linear(0.0, far, 6, "Start, section radii from the fixed point")
    name = "Rotation number, less the fixed point's"
    up = Axis((-_HIGH, _HIGH), (-0.01, -0.005, 0, 0.005, 0.01), name)
    panel = Panel(sheet, frame, across, up)
    entries = []
    for number, (energy, place, change) in enumerate(curves):
        shown = np.abs(change) < _HIGH
        cut = shown.size if shown.all() else int(np.argmin(shown))
        hue, dashed = _HUES[number % len(_HUES)], number >= len(_HUES)
        panel.line(place[:cut], change[:cut], color=hue, lw=1.0, ls="--" if dashed else "-")
        entries.append((f"$E$ = {style.number(energy)}", hue, "", dashed))
    deep = -(-len(entries) // 2)
    key(sheet, entries, frame[1] + 18 + 39 * (deep - 1), 2, _LEFT + 20, 370, 6.5)
