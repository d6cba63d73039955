"""Rotation number and exponent against the start on y = 0."""

import numpy as np
import xarray as xr

from pseudorigid.figures.axes.limits import around, inside, linear, ticks
from pseudorigid.figures.axes.panel import Axis, Entry, Panel, corner, key, letters, vacant
from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.sheet import Sheet

from . import Figure, Frame, Scene

_LEFT, _RIGHT = 135, 1005  # pixels
_STARTS = "Start on $y=0$, section radii from the centre"
_DASHES = "-", "--", "-.", ":"  # of energies in turn
_FAR = 4.0  # a curve longer than this times the median does not set the lowest axis


@style.pinned()
def draw(scene: Scene, rotation: xr.Dataset) -> Figure:
    """Draw rotation numbers and exponents, a detail with plateaus, and the departure by energy."""
    rows = -(-rotation.sizes["energy"] // 4)  # of the lowest key
    room = 75 * -(-42 * rows // 75)
    sheet = Sheet(style.COLUMN, 1950 + room)
    good = rotation["type"].values[0] == "regular"
    detail = _regular_detail(rotation)
    entries: list[Entry] = []
    if good.any() or detail[0].size:
        entries.append(("regular", style.BLUE, "o"))
    if not good.all():
        entries.append(("chaotic", style.SEA, "o"))
    entries.append(("fixed point", style.BLACK, "o"))
    if rotation.sizes["plateau"]:
        entries.append(("islands", style.BLACK, "", False, 1.6))
    key(sheet, entries, sheet.high - 34, 4, _LEFT + 10, _RIGHT - _LEFT)
    spans = (1470, 1800), (1190, 1390), (640, 990), (110, 440)
    frames: list[Frame] = [(_LEFT, low + room, _RIGHT, high + room) for low, high in spans]
    letters(sheet, *frames)
    _first_energy(sheet, frames[:2], scene, rotation)
    _detail(sheet, frames[2], rotation)
    _energies(sheet, frames[3], rotation)
    return sheet.figure


def _first_energy(sheet: Sheet, frames: list[Frame], scene: Scene, rotation: xr.Dataset) -> None:
    """Draw rotation numbers and, below them, exponents at the first energy."""
    start, turns, growth = (rotation[name].values[0] for name in ("place", "rotation", "exponent"))
    good = rotation["type"].values[0] == "regular"
    at, fixed = (float(rotation[f"fixed_{name}"].values[0]) for name in ("place", "rotation"))
    regular_turns = turns[good] if good.any() else turns
    detail, place = _regular_detail(rotation), rotation["detail_place"].values
    across = linear(max(min(at, place[0]) - 0.03, -1.0), 1.0, 10, _STARTS)
    up = around(np.hstack([regular_turns, fixed, detail[1]]), 0.1, 5, "Rotation number")
    panel = Panel(sheet, frames[0], across.blank(), up)
    middle = 0.5 * (place[0] + place[-1])
    panel.line([middle] * 2, up.limits, color=style.BACKDROP, lw=0.7, zorder=0.8)
    panel.note(middle, up.limits[1], "(c)", (3, -5), va="top")
    panel.dots(*detail, style.BLUE, size=1.6)
    shown = ~good & inside((across.limits, up.limits), (start, turns))
    panel.dots(start[shown], turns[shown], style.SEA, size=1.6)
    panel.dots(start[good], turns[good], style.BLUE, size=1.6)
    panel.dots([at], [fixed], style.BLACK, size=3.4)
    corner(sheet, frames[0], style.setting(scene))
    top = max(np.ceil(10.0 * growth.max()), 1.0) / 10.0
    up = linear(min(-top / 15.0, growth.min()), top, 5, "Exponent")
    panel = Panel(sheet, frames[1], across, up)
    panel.dots(start[~good], growth[~good], style.SEA, size=1.6)
    panel.dots(start[good], growth[good], style.BLUE, size=1.6)


def _regular_detail(rotation: xr.Dataset) -> tuple[np.ndarray, np.ndarray]:
    """Return the regular starts of the detail and their rotation numbers."""
    good = rotation["detail_type"].values == "regular"
    return rotation["detail_place"].values[good], rotation["detail_rotation"].values[good]


def _detail(sheet: Sheet, frame: Frame, rotation: xr.Dataset) -> None:
    """Draw the rotation numbers of regular starts at higher resolution, with their plateaus."""
    place = rotation["detail_place"].values
    start, turns = _regular_detail(rotation)
    across = linear(place[0], place[-1], 5, _STARTS)
    shown = turns if turns.size else rotation["detail_rotation"].values
    up = around(shown, 0.05, 4, "Rotation number, detail", above=0.2)
    panel = Panel(sheet, frame, across, up)
    if not turns.size:
        vacant(sheet, frame, "all these starts are chaotic")
    panel.dots(start, turns, style.BLUE, size=1.6)
    columns = (rotation[f"plateau_{name}"].values for name in ("turns", "islands", "first", "last"))
    for p, q, first, last in zip(*columns, strict=True):
        panel.line([first, last], [p / q] * 2, color=style.BLACK, lw=1.6, zorder=5)
        middle, name = 0.5 * (first + last), f"{p}/{q}"
        if first > place[0] + 0.8 * (place[-1] - place[0]):
            panel.note(middle, p / q, name, (-2, 3), "right", "bottom")
        else:
            panel.note(middle, p / q, name, (4, -2), "left", "top")


def departures(rotation: xr.Dataset) -> list[tuple[float, np.ndarray, np.ndarray]]:
    """Return energies, regular starts, and their departures from the fixed point's number."""
    curves = []
    for row in np.argsort(rotation["energy"].values, kind="stable").tolist():
        types = rotation["type"].values[row, : int(rotation["island"].values[row])]
        starts = np.flatnonzero(types == "regular")
        start = rotation["place"].values[row, starts] - float(rotation["fixed_place"].values[row])
        change = rotation["rotation"].values[row, starts] - rotation["fixed_rotation"].values[row]
        curves.append((float(rotation["energy"].values[row]), start, change))
    return curves


def _energies(sheet: Sheet, frame: Frame, rotation: xr.Dataset) -> None:
    """Draw the departure from the fixed point's rotation number against the start, by energy."""
    curves = departures(rotation)
    up = _departure_axis([change for _, _, change in curves])
    within = [inside([up.limits], [change]) for _, _, change in curves]
    far = max(
        float(start[shown].max(initial=0.0))
        for (_, start, _), shown in zip(curves, within, strict=True)
    )
    far = 0.1 * (int(far / 0.1) + 1) + 0.05
    across = linear(0.0, far, 6, "Start, section radii from the fixed point")
    panel = Panel(sheet, frame, across, up)
    entries = []
    hues = style.ordered(len(curves))
    for number, ((energy, start, change), shown) in enumerate(zip(curves, within, strict=True)):
        hue, dashes = hues[number], _DASHES[number % len(_DASHES)]
        last = np.logical_and.accumulate(shown).sum()
        panel.line(start[:last], change[:last], color=hue, lw=1.0, ls=dashes)
        if 0 < last < start.size:
            marker = "v" if change[last] < up.limits[0] else "^"
            panel.dots(start[last - 1], change[last - 1], hue, marker=marker)
        if last > 1:
            entries.append((f"$E$ = {style.number(energy)}", hue, "", dashes))
    if not np.concatenate(within).all():
        corner(sheet, frame, "triangles: beyond the axis")
    key(sheet, entries, frame[1] - 137, 4, _LEFT, _RIGHT - _LEFT, 7.0)


def _departure_axis(curves: list[np.ndarray]) -> Axis:
    """Return an axis for all curves but those far longer than the median."""
    sizes = [float(np.abs(curve).max()) for curve in curves if curve.size] or [0.0]
    most = max(sizes) if max(sizes) <= _FAR * np.median(sizes) else float(np.median(sizes))
    step = ticks(0.0, max(most, 1e-9), 2.5)[1]
    values = np.concatenate([[0.0], *curves])
    ends = (min(float(end), most) for end in (-values.min(), values.max()))
    low, high = (int(np.ceil(end / step - 0.5)) for end in ends)  # whole steps, with half a step
    tick_values = [float(f"{i * step:.10g}") for i in range(-low, high + 1)]
    limits = -(low + 0.5) * step, (high + 0.5) * step
    return Axis(limits, tick_values, "Rotation number minus the fixed point's")
