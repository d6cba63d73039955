"""A frame with linear or decade axes, several of which may share a sheet."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..canvas import style
from ..canvas.ragged_rows import pieces
from ..canvas.sheet import POINT, width

_SIZE, _BESIDE = 8.0, 7.0  # points: text in a chart, and beside its lines
_KEY = 60, 960  # pixels: where a key begins, and how wide it is


def log10(values):
    """The decimal logarithm with the same bits everywhere; NaN where it does not exist.

    Our own logarithm, since numpy's last bit differs between processors, and marks move by it.
    """
    from ...kernel.arithmetic import log  # compiled: a plane picture does without

    values = np.atleast_1d(np.asarray(values, dtype=float))
    logs = np.reshape([log(value) for value in values.flat], values.shape)
    return np.where(values > 0.0, logs / log(10.0), np.nan)


@dataclass(frozen=True)
class Axis:
    """Limits and ticks of one axis; with `decades` both are exponents of ten."""

    limits: Sequence
    ticks: Sequence
    name: str = ""
    decades: bool = False
    labels: Sequence | None = None  # in place of the numbers

    def fraction(self, values):
        """Where values lie between the limits, 0 to 1."""
        return self.between(log10(values) if self.decades else values)

    def between(self, values):
        """The same of values in the units of the limits."""
        low, high = self.limits
        return (np.atleast_1d(np.asarray(values, dtype=float)) - low) / (high - low)

    def blank(self):
        """The axis without name and labels, for a panel that stands above another."""
        return replace(self, name="", labels=[""] * len(self.ticks))

    def texts(self):
        """The ticks' labels."""
        if self.labels is not None:
            return self.labels
        if self.decades:
            return [rf"$10^{{{tick}}}$" for tick in self.ticks]
        return [style.number(tick) for tick in self.ticks]


def decades(limits, name="", every=1):
    """An axis of decades with ticks at the multiples of `every`."""
    low, high = limits
    return Axis(limits, range(-(-low // every) * every, high + 1, every), name, True)


class Panel:
    """A frame with two axes; what lies beyond an axis is drawn at its end.

    Parameters
    ----------
    sheet : Sheet
    frame : tuple
        (left, bottom, right, top) in pixels of the sheet.
    across, up : Axis
    grid : bool
        Whether a line runs across the frame at each tick.
    """

    tick, gap, size = 2.5, 2.0, _SIZE  # points: a tick's length, from there to its label, and that
    small = _BESIDE  # points: a note
    baseline = "center"  # of labels at the left
    corners = "butt"
    kept = (0.0, 1.0)  # fractions of an axis that points are moved into

    def __init__(self, sheet, frame, across, up, grid=True):
        self.sheet, self.frame, self.across, self.up = sheet, frame, across, up
        left, bottom, right, top = frame
        tick, reach = self.tick * POINT, (self.tick + self.gap) * POINT
        marks = left + across.between(across.ticks) * (right - left)
        for x, text in zip(marks.tolist(), across.texts(), strict=True):
            if grid:
                self._ink([x, x], [bottom, top], color=style.GRID, zorder=0.5)
            self._ink([x, x], [bottom, bottom - tick])
            self._text(self._label(x, text), bottom - reach, text, "center", "top")
        marks = bottom + up.between(up.ticks) * (top - bottom)
        for y, text in zip(marks.tolist(), up.texts(), strict=True):
            if grid:
                self._ink([left, right], [y, y], color=style.GRID, zorder=0.5)
            self._ink([left, left - tick], [y, y])
            self._text(left - reach, y, text, "right", self.baseline)
        if across.name:
            y = bottom - (self.tick + self.gap + 1.5 * self.size) * POINT
            self._text((left + right) / 2, y, across.name, "center", "top")
        if up.name:
            self._text(left, top + 4 * POINT, up.name, "left", "bottom")
        outline = [left, right, right, left, left], [bottom, bottom, top, top, bottom]
        self._ink(*outline, solid_capstyle=self.corners, zorder=3)

    def place(self, x, y):
        """The pixels of points of the panel, arrays."""
        left, bottom, right, top = self.frame
        x = np.clip(self.across.fraction(x), *self.kept)
        y = np.clip(self.up.fraction(y), *self.kept)
        return left + x * (right - left), bottom + y * (top - bottom)

    def line(self, x, y, **how):
        """Draw a line, broken where a coordinate is NaN."""
        for piece in pieces(*self.place(x, y)):
            self.sheet.draw(*piece, **how)

    def bars(self, x, low, high, **how):
        """Draw an upright line at each x, none where an end is NaN."""
        for at, *span in zip(x, low, high, strict=True):
            self.line([at, at], span, **how)

    def dots(self, x, y, color, size=3.2, hollow=False, marker="o"):
        """Draw marks of `size` points, filled or hollow."""
        _mark(self.sheet, *self.place(x, y), color, size, hollow, marker)

    def note(self, x, y, text, shift=(0.0, 0.0), ha="left", va="center"):
        """Write `text` beside a point, `shift` points away.

        Where it would leave the frame it stands opposite, or above, below or beside that.
        """
        left, bottom, right, top = self.frame
        (x,), (y,) = self.place(x, y)
        across = float(x), shift[0] * POINT, ha
        up = float(y), shift[1] * POINT, va
        wide, high = width(text, self.small), self.small * POINT
        for pair in ((across, up), (_turned(*across), _turned(*up)),
                     (across, _turned(*up)), (_turned(*across), up)):  # fmt: skip
            if _fits(*pair[0], wide, left, right) and _fits(*pair[1], high, bottom, top):
                across, up = pair
                break
        places = sum(across[:2]), sum(up[:2])
        self.sheet.text(*places, text, ha=across[2], va=up[2], size=self.small)

    def _label(self, x, text):
        """Where the middle of a label below the frame is."""
        return x

    def _ink(self, across, up, **how):
        self.sheet.draw(across, up, **({"color": style.FRAME, "lw": 0.6} | how))

    def _text(self, across, up, text, ha, va):
        self.sheet.text(across, up, text, ha=ha, va=va, size=self.size)


class Window(Panel):
    """A panel that shows nothing of what lies beyond its axes."""

    small = _SIZE
    kept = (-np.inf, np.inf)

    def line(self, x, y, **how):
        """Draw a line as far as it lies inside, broken where a coordinate is NaN."""
        beyond = not self._shown(x, y).all()
        super().line(x, y, clip=self.frame if beyond else None, **how)

    def dots(self, x, y, *what, **how):
        """Draw those marks that lie inside."""
        there = self._shown(x, y)
        super().dots(np.asarray(x)[there], np.asarray(y)[there], *what, **how)

    def _shown(self, x, y):
        """Whether each point is within the limits; NaN counts as such."""
        fractions = self.across.fraction(x), self.up.fraction(y)
        return ~np.logical_or.reduce([(part < 0.0) | (part > 1.0) for part in fractions])


def _turned(at, shift, side):
    """Turn a text over to the other side of the place `at`."""
    other = {"left": "right", "right": "left", "bottom": "top", "top": "bottom"}
    return at, -shift, other.get(side, side)


def _fits(at, shift, side, size, low, high):
    """Whether a text so many pixels long, `shift` beside `at`, lies between low and high."""
    start = at + shift - {"left": 0.0, "bottom": 0.0, "center": 0.5}.get(side, 1.0) * size
    return low + POINT <= start and start + size <= high - POINT


def vacant(sheet, frame, text):
    """Say in the middle of a frame why nothing is drawn there."""
    middle = 0.5 * (frame[0] + frame[2]), 0.5 * (frame[1] + frame[3])
    sheet.text(*middle, text, ha="center", va="center", size=_BESIDE)


def corner(sheet, frame, text):
    """Write `text` above a frame's right end."""
    sheet.text(frame[2], frame[3] + 4 * POINT, text, ha="right", va="bottom", size=_BESIDE)


def key(sheet, entries, top, columns, left=_KEY[0], width=_KEY[1], size=_SIZE):
    """Name the marks: entries of (text, colour, marker, hollow), in rows from the top left.

    Without a marker it is a line, full or (hollow) dashed. A fifth item is the size of the mark, or
    the width of the line, in points. None leaves a place empty.
    """
    for i, entry in enumerate(entries):
        if entry is None:
            continue
        text, color, marker, hollow, *points = entry
        x = left + (i % columns) * width / columns
        y = top - (i // columns) * 1.45 * size * POINT
        if marker:
            _mark(sheet, [x + 6], [y], color, *(points or [3.2]), hollow, marker)
        else:
            (thick,) = points or [0.9]
            sheet.draw([x - 8, x + 20], [y, y], lw=thick, color=color, ls="--" if hollow else "-")
        sheet.text(x + 7 * POINT, y, text, ha="left", va="center", size=size)


def _mark(sheet, across, up, color, size, hollow, marker):
    how = {"mfc": "white", "mec": color, "mew": 0.7} if hollow else {"mew": 0}
    sheet.draw(across, up, ls="none", marker=marker, ms=size, color=color, zorder=4, **how)
