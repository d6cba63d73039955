"""A frame with linear or logarithmic axes. A sheet may have several."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from string import ascii_lowercase
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..canvas import style
from ..canvas.sheet import POINT, Sheet, pieces, width

Frame = tuple[float, float, float, float]  # left, bottom, right, top in pixels
Entry = tuple[Any, ...]  # of a key: text, colour[, marker, hollow, size]

_SIZE, _SMALL = 8.0, 7.0  # points: labels and names, notes
_LABEL_GAP = 6  # pixels, the least between labels below a frame
_KEY_LEFT, _KEY_WIDTH = 60, 960  # pixels


def log10(values: ArrayLike) -> np.ndarray:
    """Return decimal logarithms, NaN where there is none; the bits of numpy's logarithm vary."""
    from ...kernel.arithmetic import log  # compiled code, which a linear picture does not need

    values = np.atleast_1d(np.asarray(values, dtype=float))
    logs = np.reshape([log(value) for value in values.flat], values.shape)
    return np.where(values > 0.0, logs / log(10.0), np.nan)


@dataclass(frozen=True)
class Axis:
    """Limits and ticks of one axis; with `decades` both are exponents of ten."""

    limits: Sequence[float]
    ticks: Sequence[float]
    name: str = ""
    decades: bool = False
    labels: Sequence[str] | None = None  # in place of the numbers

    def fraction(self, values: ArrayLike) -> np.ndarray:
        """Return where values lie between the limits, 0 to 1."""
        return self.between(log10(values) if self.decades else values)

    def between(self, values: ArrayLike) -> np.ndarray:
        """Return where values in the units of the limits lie between these, 0 to 1."""
        low, high = self.limits
        return (np.atleast_1d(np.asarray(values, dtype=float)) - low) / (high - low)

    def minor_ticks(self) -> np.ndarray:
        """Return the middles between equally spaced ticks, or 2, 3, ... 9 times powers of ten."""
        low, high = self.limits
        if self.decades:
            values = np.add.outer(np.arange(np.floor(low), np.ceil(high)), log10(range(2, 10)))
        elif len(self.ticks) < 2:
            return np.empty(0)
        else:
            middles = np.arange(len(self.ticks) + 1) - 0.5
            values = self.ticks[0] + middles * (self.ticks[1] - self.ticks[0])
        return values[(low <= values) & (values <= high)]

    def blank(self) -> "Axis":
        """Return the axis without name and labels, for a panel above another."""
        return replace(self, name="", labels=[""] * len(self.ticks))

    def texts(self) -> Sequence[str]:
        """Return the labels of the ticks."""
        if self.labels is not None:
            return self.labels
        if self.decades:
            return [rf"$10^{{{tick}}}$" for tick in self.ticks]
        return [style.number(tick) for tick in self.ticks]


class Panel:
    """A frame with two axes and marks; data beyond an axis are drawn at its end.

    `frame` is (left, bottom, right, top) in pixels. Subclasses override the class attributes.
    """

    tick, gap = 2.5, 2.0  # points: a tick's length, and from there to its label
    size, small = _SIZE, _SMALL  # points: labels, notes
    baseline = "center"  # vertical alignment of labels at the left
    corners = "butt"  # cap style of the frame
    clip_range = (0.0, 1.0)  # fractions of an axis; data beyond are moved to its ends

    def __init__(
        self, sheet: Sheet, frame: Frame, across: Axis, up: Axis, grid: bool = True
    ) -> None:
        self.sheet, self.frame, self.across, self.up = sheet, frame, across, up
        left, bottom, right, top = frame
        tick, reach = self.tick * POINT, (self.tick + self.gap) * POINT
        marks = left + across.between(across.ticks) * (right - left)
        texts = across.texts()
        widest = max((width(text, self.size) for text in texts if text), default=0.0)
        texts = _apart(marks, widest + _LABEL_GAP, texts)
        for x, text in zip(marks.tolist(), texts, strict=True):
            if grid:
                self._frame_line([x, x], [bottom, top], color=style.GRID, zorder=0.5)
            self._frame_line([x, x], [bottom, bottom - tick])
            self._text(self._label(x, text), bottom - reach, text, "center", "top")
        marks = bottom + up.between(up.ticks) * (top - bottom)
        texts = _apart(marks, self.size * POINT, up.texts())
        for y, text in zip(marks.tolist(), texts, strict=True):
            if grid:
                self._frame_line([left, right], [y, y], color=style.GRID, zorder=0.5)
            self._frame_line([left, left - tick], [y, y])
            self._text(left - reach, y, text, "right", self.baseline)
        if across.name:
            y = bottom - (self.tick + self.gap + 1.25 * self.size) * POINT
            self._text((left + right) / 2, y, across.name, "center", "top")
        if up.name:
            self._text(left, top + 4 * POINT, up.name, "left", "bottom")
        outline = [left, right, right, left, left], [bottom, bottom, top, top, bottom]
        self._frame_line(*outline, solid_capstyle=self.corners, zorder=3)

    def place(self, x: ArrayLike, y: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
        """Return the pixels of points as arrays."""
        left, bottom, right, top = self.frame
        across = np.clip(self.across.fraction(x), *self.clip_range)
        up = np.clip(self.up.fraction(y), *self.clip_range)
        return left + across * (right - left), bottom + up * (top - bottom)

    def line(self, x: ArrayLike, y: ArrayLike, **line_style: Any) -> None:
        """Draw a line, broken where a coordinate is NaN."""
        for piece in pieces(*self.place(x, y)):
            self.sheet.draw(*piece, **line_style)

    def minor(self, across: bool = True) -> None:
        """Draw minor ticks, without labels, at the left and, if `across`, below."""
        left, bottom, right, top = self.frame
        line_style, size = {"color": style.FRAME, "lw": 0.5}, 1.5 * POINT
        if across:
            for x in left + self.across.between(self.across.minor_ticks()) * (right - left):
                self.sheet.draw([x, x], [bottom, bottom - size], **line_style)
        for y in bottom + self.up.between(self.up.minor_ticks()) * (top - bottom):
            self.sheet.draw([left, left - size], [y, y], **line_style)

    def bars(self, x: Any, low: Any, high: Any, **line_style: Any) -> None:
        """Draw an upright line at each x, none where an end is NaN."""
        for at, *span in zip(x, low, high, strict=True):
            self.line([at, at], span, **line_style)

    def estimates(self, x: Any, values: Any, low: Any, high: Any, color: str) -> None:
        """Draw a dot for each value, joined by a line, with its bar from low to high."""
        self.line(x, values, color=style.pale(color), lw=0.6, zorder=1)
        self.bars(x, low, high, color=color, lw=0.7, zorder=2)
        known = ~np.isnan(values)
        self.dots(x[known], values[known], color, size=1.7)

    def dots(self, x: Any, y: Any, color: Any, size: float = 3.2, **options: Any) -> None:
        """Draw marks of `size` points above lines and frames; `options` are those of Sheet.dots."""
        self.sheet.dots(*self.place(x, y), color, size, zorder=4, **options)

    def note(
        self,
        x: float,
        y: float,
        text: str,
        shift: tuple[float, float] = (0, 0),
        ha: str = "left",
        va: str = "center",
    ) -> None:
        """Write `text` beside a point, `shift` points away, on the other side if only that fits."""
        left, bottom, right, top = self.frame
        (across,), (up,) = (part.tolist() for part in self.place(x, y))
        across, ha = _beside(across, shift[0] * POINT, ha, width(text, self.small), left, right)
        up, va = _beside(up, shift[1] * POINT, va, self.small * POINT, bottom, top)
        self.sheet.text(across, up, text, ha=ha, va=va, size=self.small)

    def _label(self, x: float, text: str) -> float:
        """Return the middle of a label below the frame, whose tick is at x."""
        return x

    def _frame_line(self, across: list[float], up: list[float], **line_style: Any) -> None:
        self.sheet.draw(across, up, **({"color": style.FRAME, "lw": 0.6} | line_style))

    def _text(self, across: float, up: float, text: str, ha: str, va: str) -> None:
        self.sheet.text(across, up, text, ha=ha, va=va, size=self.size)


class Window(Panel):
    """A panel that does not show data beyond its axes."""

    small = _SIZE
    clip_range = (-np.inf, np.inf)

    def line(self, x: ArrayLike, y: ArrayLike, **line_style: Any) -> None:
        """Draw the part of a line inside the frame, broken where a coordinate is NaN."""
        beyond = not self.within(x, y).all()
        super().line(x, y, clip=self.frame if beyond else None, **line_style)

    def dots(self, x: Any, y: Any, color: Any, size: float = 3.2, **options: Any) -> None:
        """Draw the marks that lie inside the frame."""
        within = self.within(x, y)
        super().dots(np.asarray(x)[within], np.asarray(y)[within], color, size, **options)

    def within(self, x: ArrayLike, y: ArrayLike) -> np.ndarray:
        """Return whether each point is within the limits; NaN counts as within."""
        fractions = self.across.fraction(x), self.up.fraction(y)
        across, up = ((part < 0.0) | (part > 1.0) for part in fractions)
        return ~(across | up)


def _apart(marks: np.ndarray, size: float, texts: Sequence[str]) -> list[str]:
    """Return the labels of ticks, without those between every n-th if labels of `size` touch."""
    room = float(np.abs(np.diff(marks)).min(initial=np.inf))
    every = max(int(np.ceil(size / room)), 1)
    return ["" if i % every else text for i, text in enumerate(texts)]


def _beside(
    at: float, shift: float, side: str, size: float, low: float, high: float
) -> tuple[float, str]:
    """Return coordinate and side of a text beside `at`, mirrored if only so it fits the frame."""
    other = {"left": "right", "right": "left", "bottom": "top", "top": "bottom"}
    for by, end in ((shift, side), (-shift, other.get(side, side))):
        start = at + by - {"left": 0.0, "bottom": 0.0, "center": 0.5}.get(end, 1.0) * size
        if low + POINT <= start and start + size <= high - POINT:
            return at + by, end
    return at + shift, side


def upright(panels: Sequence[Panel], at: float, **line_style: Any) -> float:
    """Draw a line through panels at a value of the abscissa and return its x in pixels."""
    x = float(panels[0].place(at, 0.0)[0][0])
    for panel in panels:
        _, low, _, high = panel.frame
        panel.sheet.draw([x, x], [low, high], zorder=0.8, **line_style)
    return x


def vacant(sheet: Sheet, frame: Frame, text: str) -> None:
    """Write in the middle of a frame why nothing is drawn there."""
    middle = 0.5 * (frame[0] + frame[2]), 0.5 * (frame[1] + frame[3])
    sheet.text(*middle, text, ha="center", va="center", size=_SMALL)


def title(sheet: Sheet, frame: Frame, text: str, rise: float = 4, size: float = _SMALL) -> None:
    """Write `text` above a frame's left end, `rise` points away."""
    sheet.text(frame[0], frame[3] + rise * POINT, text, ha="left", va="bottom", size=size)


def corner(sheet: Sheet, frame: Frame, text: str, rise: float = 4, size: float = _SMALL) -> None:
    """Write `text` above a frame's right end, `rise` points away."""
    sheet.text(frame[2], frame[3] + rise * POINT, text, ha="right", va="bottom", size=size)


def letters(sheet: Sheet, *frames: Frame) -> None:
    """Write (a), (b), ... at the left above frames, beside titles and above labels of ticks."""
    for name, (left, _, _, top) in zip(ascii_lowercase, frames, strict=False):
        text = rf"$\mathbf{{({name})}}$"
        sheet.text(left - 2 * POINT, top + 4.7 * POINT, text, ha="right", va="bottom", size=_SIZE)


def key(
    sheet: Sheet,
    entries: Iterable[Entry | None],
    top: float,
    columns: int,
    left: float = _KEY_LEFT,
    width: float = _KEY_WIDTH,
    size: float = _SIZE,
) -> None:
    """Draw a key of entries (text, colour[, marker, hollow, size]) in rows from the top left.

    An entry without a marker is a line: `hollow` is whether it is dashed, or its style. Its size is
    that of the mark or the width of the line in points. None leaves a cell empty.
    """
    for i, entry in enumerate(entries):
        if entry is None:
            continue
        text, color, marker, hollow, points = entry + ("", False, None)[len(entry) - 2 :]
        x = left + (i % columns) * width / columns
        y = top - (i // columns) * 1.45 * size * POINT
        if marker:
            sheet.dots([x + 6], [y], color, points or 3.2, hollow, marker=marker, zorder=4)
        else:
            dashes = hollow if isinstance(hollow, str) else "--" if hollow else "-"
            sheet.draw([x - 8, x + 20], [y, y], lw=points or 0.9, color=color, ls=dashes)
        sheet.text(x + 7 * POINT, y, text, size=size)
