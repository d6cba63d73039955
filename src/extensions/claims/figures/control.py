"""Orbits of the impact map, and of maps that keep area, the reversor, or neither.

docs/method.md defines the three forms of change (twist, stir and shift) and the strength.
"""

import xarray as xr

from pseudorigid.figures.axes.panel import key, letters, title
from pseudorigid.figures.axes.section import NAME, Section
from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.sheet import Sheet

from . import Figure, Frame, Scene

_LEFT, _RIGHT = 120, 1010  # pixels
_CLASSES = (("regular", style.BLUE), ("spiral", style.VERMILION), ("chaotic", style.BACKDROP))
UNCHANGED = "the impact map"
# What a changed map keeps, in the order of panels.
KEPT = {
    "both": "area and reversor", "area": "area alone", "reversor": "reversor alone",
    "neither": "neither",
}  # fmt: skip
FORMS = {"twist": "o", "stir": "s", "shift": "^"}
_SIDE, _APART = 282, 346  # pixels: the side of a panel, and from one to the next below


@style.pinned()
def draw(scene: Scene, control: xr.Dataset) -> Figure:
    """Draw the orbits of each map, chaotic ones first; maps that keep both are left out."""
    sheet = Sheet(style.COLUMN, 1275)
    drawn = set(control["kind"].values.ravel().tolist())
    entries = [(*_CLASSES[kind], "o", False, 3.0) for kind in range(3) if kind in drawn]
    key(sheet, entries, sheet.high - 32, 3, _LEFT, 450, 7.0)
    sheet.text(_RIGHT, sheet.high - 32, style.setting(scene), ha="right", va="center", size=7.0)
    columns, last, frames = [*KEPT][1:], len(FORMS) - 1, dict[tuple[int, int], Frame]()
    for i, name in enumerate(control["panel"].values.tolist()):
        form, _, kept = name.partition(" ")
        if kept == "both":  # like the unchanged map
            continue
        # The impact map takes the place of "shift area": no shift keeps area.
        row = last if name == "none" else [*FORMS].index(form)
        column = 0 if name == "none" else columns.index(kept)
        left, top = _LEFT + column * (_SIDE + 22), sheet.high - 105 - row * _APART
        frame = frames[row, column] = left, top - _SIDE, left + _SIDE, top
        names = "$x$" if row == last else None, None if column else ""
        panel = Section(sheet, frame, scene, 1.04, 4, names)
        panel.rim(zorder=2)
        for kind in (2, 1, 0):
            a, b = (control[axis].values[i][control["kind"].values[i] == kind] for axis in "ab")
            x, y = panel.centre + panel.radius * a.ravel(), panel.high * panel.radius * b.ravel()
            panel.dots(x, y, _CLASSES[kind][1], 0.5 if kind == 2 else 0.7)
        title(sheet, frame, UNCHANGED if name == "none" else f"{form}: {KEPT[kept]}")
    letters(sheet, *(frames[place] for place in sorted(frames)))
    text = rf"upwards: {NAME}; changed maps: strength $\epsilon$ = "
    sheet.text(_LEFT, 45, text + style.number(control.attrs["shown"]), size=7.0)
    return sheet.figure
