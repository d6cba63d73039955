"""The section in the chart (x, y): jumps of the map, orbits, symmetry lines, grazing rim."""

from collections.abc import Sequence

import numpy as np
import xarray as xr

from pseudorigid.figures.axes import section
from pseudorigid.figures.axes.limits import around, linear
from pseudorigid.figures.axes.panel import Panel, Window, corner, key, letters, vacant
from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.sheet import Sheet

from . import Figure, Frame, Scene

_LEFTS, _BOTTOM, _SIDE = (125, 465, 805), 112, 215  # pixels: of the small panels
MAP, INVERSE = style.VERMILION, style.BLUE


@style.pinned()
def draw(scene: Scene, jumps: xr.Dataset, orbits: xr.Dataset) -> Figure:
    """Draw the section with the jumps of the map and its inverse, and further energies below."""
    panel, regular, chaotic = section.over_orbits(scene, orbits, high=1575)
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
    _curves(panel, jumps["x"].values[0], jumps["y"].values[0], (1.0, -1.0))
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


def _curves(panel: Panel, x: np.ndarray, y: np.ndarray, mirror: Sequence[float]) -> None:
    """Draw the curve where the inverse jumps, and mirrored by a factor (x, y) that of the map."""
    for signs, hue in (((1.0, 1.0), INVERSE), (mirror, MAP)):
        panel.line(signs[0] * x, signs[1] * y, color=hue, lw=1.2, zorder=5)


def _births(sheet: Sheet, jumps: xr.Dataset) -> list[Frame]:
    """Draw depths of the curves at falling energies above the birth's; return the frames.

    The depth is 0 on the rim and 1 at the centre of the section.
    """
    energies = jumps["energy"].values
    born = jumps["length"].values > 0.0
    rising = [row for row in np.argsort(energies, kind="stable").tolist() if row and born[row]]
    shown = rising[: len(_LEFTS)]
    if not rising:
        text = f"no further energy above $E$ = {jumps.attrs['first_energy']:.6g}, where jumps begin"
        vacant(sheet, (section.LEFT, _BOTTOM, section.LEFT + section.SIDE, _BOTTOM + _SIDE), text)
    frames: list[Frame] = [
        (left, _BOTTOM, left + _SIDE, _BOTTOM + _SIDE) for left in _LEFTS[: len(shown)]
    ]
    for frame, row in zip(frames, reversed(shown), strict=True):
        x, y, radius = (jumps[name].values[row] for name in ("x", "y", "radius"))
        k, g = jumps.attrs["k"], jumps.attrs["g"]
        across, up = (x - g / k) / radius, y / (np.sqrt(k * (1.0 + k)) * radius)
        depth = 1.0 - np.sqrt(across * across + up * up)
        end = 1.1 * float(np.nanmax(y))
        up = around(np.append(depth, 0.0), 0.1, 4, "Depth")
        panel = Window(sheet, frame, linear(-end, end, 4, "$y$"), up, grid=False)
        panel.minor()
        panel.line([-end, end], [0.0, 0.0], color=style.BLACK, lw=0.8)
        _curves(panel, y, depth, (-1.0, 1.0))
        corner(sheet, frame, f"$E$ = {style.number(float(energies[row]))}", 14, 8.0)
    return frames
