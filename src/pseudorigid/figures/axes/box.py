"""A three-dimensional box with panes, axes and the opaque energy surface."""

import math
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.transforms import Bbox

from ..canvas import style
from ..canvas.names import name_curves
from ..canvas.sheet import LONGEST, POINT, Sheet, pieces, width
from .direction import disproportion
from .limits import inside
from .panel import Entry, key
from .view import OccludingEllipsoid, Projection

Step = tuple[float, float]  # on the sheet, across and up


class _Label(NamedTuple):
    along: int  # its axis
    at: list[float]  # its tick, or the middle of its axis, in the box
    step: Step  # unit vector from there to the label
    reach: float  # points from there to the label
    text: str
    size: float


_WIDE = 1500  # pixels: five inches, shown at the width of a column
_SIZE, _NAME = 11.0, 13.0  # points: labels, names
_NAMED = 10.0  # points: names of curves
_TICK, _GAP = 4.0, 3.0  # points: a tick's length, and from there to its label
_APART = 0.25  # of a label's size: space on its left and its right
_MARGIN = 1.2  # points: from there to the ends of the sheet
_STEEP = 0.8  # sine of the least angle between an axis and its ticks
# Share of a text's width or height to the left of its place or below it.
_BEFORE = {"left": 0.0, "center": 0.5, "right": 1.0}
_BEFORE |= {"bottom": 0.0, "center_baseline": 0.625, "top": 1.0}
_ROW, _LEFT, _BETWEEN = 1.45 * _SIZE, 45, 28  # of the key above the box; points, pixels, pixels
_RIM = 0.7  # points: width of the rim
_SIDES = 2000  # pieces of a line of the box, which the surface hides one by one


class Box:
    """A figure of a box with equal data scales around the opaque energy surface.

    What lies behind the surface is not drawn. The scene has `axes` with limits and ticks of x, xdot
    and udot; `view` with elevation (between 0 and 90) and azimuth; `energy` and `ball`, which are
    written above the box. `entries` are those of `panel.key`. Points are arrays (3, n). Raises
    ValueError, one line, if there are points `shown` that the surface all hides, or if the box is
    too high or too wide for a picture.
    """

    def __init__(
        self, scene: dict[str, Any], entries: Sequence[Entry] = (), shown: np.ndarray | None = None
    ) -> None:
        self.spans = [scene["axes"][name]["limits"] for name in style.NAMES]
        self.ticks = [scene["axes"][name]["ticks"] for name in style.NAMES]
        self.view = Projection(self.spans, scene["view"])
        self.surface = OccludingEllipsoid(**scene["ball"], energy=scene["energy"])
        if shown is not None and not self.seen(shown).any():
            hides = "the energy surface hides all that is drawn"
            raise ValueError(f"view {scene['view']}: {hides}")
        if refused := disproportion(self.spans, **scene["view"]):
            raise ValueError("axes.{}.limits {}: expected {}".format(*refused))
        if self.seen(self.surface.rim()).any():
            entries = [*entries, ("grazing rim", style.RIM, "", False, _RIM)]
        self._lay_out(style.setting(scene), entries)
        self._panes()
        self._edges()
        self.line(self.surface.outline(self.view), style.PANE, 0.6)
        self.line(self.surface.rim(), style.RIM, _RIM)

    def points(self, points: np.ndarray, color: str, size: float, **line_style: Any) -> None:
        """Draw opaque dots of `size` points across, in the order given."""
        self.sheet.dots(*self.view(points[:, self.seen(points)]), color, size, **line_style)

    def line(self, points: np.ndarray, color: str, width: float) -> None:
        """Draw a line of `width` points, broken where a coordinate is NaN."""
        across, up = self.view(points)
        for piece in pieces(np.where(self.seen(points), across, np.nan), up):
            self.sheet.draw(*piece, lw=width, color=color)

    def names(
        self, curves: Sequence[np.ndarray], names: Sequence[str], colors: Sequence[str],
        ground: np.ndarray,
    ) -> None:  # fmt: skip
        """Write the name of each curve beside it, as far as there is room, best off the ground."""
        curves = [*curves, self.surface.outline(self.view), self.surface.rim()]
        pixels = [np.array(self.view(points[:, self.seen(points)])) for points in curves]
        behind = np.array(self.view(ground[:, self.seen(ground)]))
        frame = 0, 0, _WIDE, self.sheet.high
        name_curves(self.sheet, pixels, names, colors, frame, _NAMED, behind)

    def seen(self, points: np.ndarray) -> np.ndarray:
        """Return whether each point lies in the box and the surface in the box does not hide it."""
        visible = inside(self.spans, points)
        for front in self.surface.before(self.view.eye, points):
            visible &= ~(inside(self.spans, front) & self.surface.has(front))
        return visible

    def _lay_out(self, setting: str, entries: Sequence[Entry]) -> None:
        """Make a sheet that fits the box, and write the setting and the key above it."""
        places, left, row = [], _LEFT + width(setting, _SIZE) + _BETWEEN, 0
        for name, *_ in entries:
            wide = 7 * POINT + width(name, _SIZE) + _BETWEEN
            if left + wide > _WIDE:
                left, row = _LEFT, row + 1
            places.append((left, row))
            left += wide
        self.sheet = self._fit(1 + row)
        self.figure = self.sheet.figure
        self._thin_out()
        top = self.sheet.high - (4 + _ROW / 2) * POINT
        self.sheet.text(_LEFT - 8, top, setting, size=_SIZE)
        for entry, (left, row) in zip(entries, places, strict=True):
            key(self.sheet, [entry], top - row * _ROW * POINT, 1, left, size=_SIZE)

    def _fit(self, rows: int) -> Sheet:
        """Place the box on a sheet with room for labels and `rows` of the key; return the sheet."""
        left = _TICK + _GAP + _SIZE * _ems(self.ticks[2]) + 4
        right = _TICK + _GAP + _SIZE * _ems(self.ticks[1]) + 18
        for _ in range(4):  # labels move with the box, less and less
            inner = _WIDE - (left + right) * POINT
            inner_high = self.view.place(left * POINT, 0, inner)
            frames = [self._frame(label) for label in self._labels()]
            left += max(_MARGIN - min(frame.x0 for frame in frames) / POINT, 0.0)
            right += max(_MARGIN + (max(frame.x1 for frame in frames) - _WIDE) / POINT, 0.0)
        # A hanging label reaches down by its height, another one by half of that.
        edges = [0.0, inner_high]
        for label in self._labels():
            _, middle, *_ = self._place(label)
            hangs, size = label.step[1] > 0.5, 1.5 * label.size * POINT
            edges += [middle - size, middle + size * hangs]
        bottom, top = 4 * POINT - min(edges), (10 + rows * _ROW) * POINT
        needed = bottom + max(edges) + top
        high = max(75 * int(np.ceil(needed / 75)), _WIDE // LONGEST)
        bottom += (high - needed) / 2
        self.view.place(left * POINT, bottom, inner)
        return Sheet(_WIDE, high)

    def _thin_out(self) -> None:
        """Leave out ticks whose labels would cover others, first those of axes with many ticks."""
        self.ticks = [self._apart(along) for along in range(3)]
        taken: list[Bbox] = []
        labels = sorted(self._labels(), key=lambda label: len(self.ticks[label.along]))
        for label in sorted(labels, key=lambda label: label.size == _SIZE):  # names first
            frame = self._frame(label)
            if label.size == _SIZE and any(map(frame.overlaps, taken)):
                self.ticks[label.along].remove(label.at[label.along])
            else:
                taken.append(frame)

    def _apart(self, along: int) -> list[float]:
        """Return every n-th tick of an axis, so that no label covers the next one."""
        ticks = self.ticks[along]
        right = abs(self.view.right[along]) * self.view.scale / POINT
        up = abs(self.view.up[along]) * self.view.scale / POINT
        for every in range(1, len(ticks)):
            step = ticks[every] - ticks[0]
            if step * up > _SIZE or step * right > _SIZE * (_ems(ticks) + 0.3):
                return ticks[::every]
        return ticks[-1:] if self.view.eye[along] < 0 else ticks[:1]  # the one at the far end

    def _edge(self, start: list[float], along: int, color: str, width: float) -> None:
        """Draw the line of the box through `start` in the direction of one axis."""
        low, high = self.spans[along]
        vertices = np.array([start] * (_SIDES + 1), dtype=float).T
        vertices[along] = low + (high - low) * np.arange(_SIDES + 1) / _SIDES
        vertices[along, -1] = high
        self.line(vertices, color, width)

    def _panes(self) -> None:
        """Draw the three panes behind the data: their grid lines, then their outlines."""
        # The pane behind the data is the one whose outward normal points away from the eye.
        back = [span[eye <= 0] for span, eye in zip(self.spans, self.view.eye, strict=True)]
        for values, color in ((self.ticks, style.GRID), (self.spans, style.PANE)):
            for fixed in range(3):
                for along in (axis for axis in range(3) if axis != fixed):
                    for value in values[fixed]:
                        start = list(back)
                        start[fixed] = value
                        self._edge(start, along, color, 0.6)

    def _axes(self) -> list[tuple[list[float], Step]]:
        """Return the start of the three edges that are axes, and the direction of their ticks."""
        (x0, x1), (y0, y1), (z0, _) = self.spans
        east, north, _ = self.view.eye
        front = (x1 if east > 0 else x0), (y1 if north > 0 else y0)
        wide, left = self._widths(), int((east > 0) == (north > 0))
        at_left = 2 * wide[left] > wide[1 - left]
        corner = [*front, z0]  # the far end of the axis below it
        along = left if at_left else 1 - left
        corner[along] = self.spans[along][self.view.eye[along] <= 0]
        return [
            ([x0, front[1], z0], self._ticks_of(0)),
            ([front[0], y0, z0], self._ticks_of(1)),
            (corner, (-1.0 if at_left else 1.0, 0.0)),
        ]

    def _widths(self) -> list[float]:
        """Return the widths of the axes of x and xdot on the sheet, in points."""
        pairs = zip(self.view.right, self.spans, strict=True)
        return [abs(part) * (high - low) * self.view.scale / POINT for part, (low, high) in pairs]

    def _ticks_of(self, along: int) -> Step:
        """Return the direction of the ticks of x or xdot: along the other one, or at right angles.

        They are at right angles where they would lie flat on their axis, unless it is too narrow
        for a label below it.
        """
        (right, up), (across, rise) = self._towards(1 - along), self._towards(along)
        if self._widths()[along] < _SIZE or abs(across * up - rise * right) > _STEEP:
            return right, up
        return (rise, -across) if across > 0 else (-rise, across)

    def _towards(self, along: int) -> Step:
        """Return the unit step on the sheet along an axis, towards the eye."""
        across, up = self.view.right[along], self.view.up[along]
        length = math.sqrt(across * across + up * up) * (1 if self.view.eye[along] > 0 else -1)
        return across / length, up / length

    def _labels(self) -> Iterator[_Label]:
        """Yield the labels of ticks and the names of the axes."""
        for along, (start, step) in enumerate(self._axes()):
            for tick in self.ticks[along]:
                at = [*start[:along], tick, *start[along + 1 :]]
                yield _Label(along, at, step, _TICK + _GAP, style.number(tick), _SIZE)
            low, high = self.spans[along]
            name = list(style.NAMES.values())[along]
            if along == 2:  # this name is above its axis, the others beside the middle
                above = 0.3 * step[0], 1.0
                yield _Label(along, [*start[:2], high], above, 2 * _GAP, name, _NAME)
                continue
            size = _ems(self.ticks[along]) * abs(step[0]) + 0.9 * abs(step[1]) + 0.5
            at = [*start[:along], (low + high) / 2, *start[along + 1 :]]
            yield _Label(along, at, step, _TICK + 2 * _GAP + _SIZE * size, name, _NAME)

    def _edges(self) -> None:
        """Draw the axes with their ticks and labels."""
        for along, (start, step) in enumerate(self._axes()):
            self._edge(start, along, style.FRAME, 0.8)
            for tick in self.ticks[along]:
                across, up = map(float, self.view([*start[:along], tick, *start[along + 1 :]]))
                far = _TICK * POINT
                ends = [across, across + step[0] * far], [up, up + step[1] * far]
                self.sheet.draw(*ends, color=style.FRAME, lw=0.8)
        for label in self._labels():
            across, up, ha, va = self._place(label)
            self.sheet.text(across, up, label.text, ha=ha, va=va, size=label.size)

    def _place(self, label: _Label) -> tuple[float, float, str, str]:
        """Return where a label is on the sheet, and its alignments `ha` and `va`."""
        right, high = label.step
        ha = "center" if abs(right) < 0.25 else ("left" if right > 0 else "right")
        va = "center_baseline" if abs(high) < 0.5 else ("bottom" if high > 0 else "top")
        across, up = map(float, self.view(label.at))
        return across + right * label.reach * POINT, up + high * label.reach * POINT, ha, va

    def _frame(self, label: _Label) -> Bbox:
        """Return the frame of a label on the sheet, with some room beside it."""
        across, up, ha, va = self._place(label)
        wide, high = width(label.text, label.size), label.size * POINT
        left, bottom = across - _BEFORE[ha] * wide, up - _BEFORE[va] * high
        return Bbox.from_bounds(left, bottom, wide, high).padded(_APART * high, 0)


def _ems(ticks: Sequence[float]) -> float:
    """Return an upper bound of the width of the widest label, in units of its size."""
    wide = {".": 0.26, "\N{MINUS SIGN}": 0.7}
    return max([0.0, *(sum(wide.get(c, 0.51) for c in style.number(tick)) for tick in ticks)])
