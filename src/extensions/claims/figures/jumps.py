"""The section in the chart (x, y): jumps of the map, orbits, symmetry lines, grazing rim."""

import numpy as np
import xarray as xr

from pseudorigid.figures.axes import section
from pseudorigid.figures.axes.panel import key, letters, title, vacant
from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.sheet import Sheet

from . import Figure, Frame, Scene

_SMALL, _LEFTS = 215, (125, 465, 805)  # pixels: side and lefts of the small panels
MAP, INVERSE = style.VERMILION, style.BLUE


@style.pinned()
def draw(scene: Scene, jumps: xr.Dataset, orbits: xr.Dataset) -> Figure:
    """Draw the section with the jumps of the map and its inverse, and further energies below."""
    panel, regular, chaotic = section.over_orbits(scene, orbits, high=1500)
    dashes = {"color": style.BLACK, "lw": 0.6, "ls": "--", "zorder": 4.6}
    panel.line([panel.centre - panel.radius, panel.centre + panel.radius], [0.0, 0.0], **dashes)
    line_x, line_y = jumps["flight_x"].values, jumps["flight_y"].values
    for x, y in zip(line_x.T, line_y.T, strict=True):
        panel.line(x, y, **dashes)
    count = np.isfinite(line_x).sum(axis=1)
    both, none = count == 2, count == 0  # between them the two branches meet
    ends = [*np.flatnonzero(both[:-1] & none[1:]), *np.flatnonzero(none[:-1] & both[1:]) + 1]
    for x, y in zip(line_x[ends], line_y[ends], strict=True):
        panel.line(x, y, **dashes)
    _curves(panel, jumps, 0)
    jumping = (jumps["length"].values > 0.0).any()
    entries = [
        ("the map jumps", MAP) if jumping else None,
        ("its inverse jumps", INVERSE) if jumping else None,
        regular,
        ("grazing rim", style.BLACK),
        ("symmetry lines", style.BLACK, "", True),
        chaotic,
    ]
    entries = [*filter(None, entries)]
    key(panel.sheet, entries, panel.frame[1] - 128, 3, section.LEFT - 50, section.SIDE + 60)
    letters(panel.sheet, panel.frame, *_births(panel.sheet, jumps))
    return panel.sheet.figure


def _curves(panel: section.Section, jumps: xr.Dataset, row: int) -> None:
    """Draw the curves where the map and its inverse jump at one energy."""
    x, y = jumps["x"].values[row], jumps["y"].values[row]
    for sign, hue in ((1.0, INVERSE), (-1.0, MAP)):
        panel.line(x, sign * y, color=hue, lw=1.2, zorder=5)


def _births(sheet: Sheet, jumps: xr.Dataset) -> list[Frame]:
    """Draw sections at falling energies above the birth's, each on its own scale; return frames."""
    energies = jumps["energy"].values
    born = jumps["length"].values > 0.0
    rising = [row for row in np.argsort(energies, kind="stable").tolist() if row and born[row]]
    shown = rising[: len(_LEFTS)]
    if not rising:
        text = f"no further energy above $E$ = {jumps.attrs['first_energy']:.6g}, where jumps begin"
        vacant(sheet, (section.LEFT, 60, section.LEFT + section.SIDE, 60 + _SMALL), text)
    frames: list[Frame] = [(left, 75, left + _SMALL, 75 + _SMALL) for left in _LEFTS[: len(shown)]]
    for frame, row in zip(frames, reversed(shown), strict=True):
        radius = float(jumps["radius"].values[row])
        panel = section.Section(sheet, frame, jumps.attrs, radius, 1.08, 4, ("", ""))
        panel.rim()
        _curves(panel, jumps, row)
        title(sheet, frame, f"$E$ = {style.number(float(energies[row]))}")
    return frames
