"""A frame with linear or decade axes, several of which may share a sheet."""

from dataclasses import dataclass

import numpy as np

from ...kernel.arithmetic import log
from ...kernel.compiled import jit
from ..canvas import style
from ..canvas.ragged import pieces
from ..canvas.sheet import POINT

_TICK, _GAP = 2.5, 2.0  # points: a tick's length, and from there to its label
_SIZE = 7.0  # points: text in a chart
_EDGE = 6.0  # pixels that marks may lie beyond the frame


@jit
def _log10(values, out):
    for i in range(values.size):
        out[i] = log(values[i]) / log(10.0)


def log10(values):
    """The decimal logarithm with the same bits everywhere; NaN where it does not exist."""
    values = np.atleast_1d(np.asarray(values, dtype=float))
    out = np.empty(values.shape)
    _log10(values.ravel(), out.reshape(-1))
    return np.where(values > 0.0, out, np.nan)


@dataclass(frozen=True)
class Axis:
    """Limits and ticks of one axis; with `decades` both are exponents of ten."""

    limits: tuple
    ticks: tuple
    name: str = ""
    decades: bool = False
    labels: tuple | None = None  # in place of the numbers

    def fraction(self, values):
        """Where values lie between the limits, 0 to 1."""
        values = log10(values) if self.decades else np.atleast_1d(np.asarray(values, dtype=float))
        low, high = self.limits
        return (values - low) / (high - low)

    def texts(self):
        """The ticks' labels."""
        if self.labels is not None:
            return self.labels
        if self.decades:
            return tuple(rf"$10^{{{tick}}}$" for tick in self.ticks)
        return tuple(style.number(tick) for tick in self.ticks)


class Panel:
    """A frame (left, bottom, right, top), in pixels of the sheet, for two Axis."""

    def __init__(self, sheet, frame, across, up, grid=True):
        self.sheet, self.frame, self.across, self.up = sheet, frame, across, up
        left, bottom, right, top = frame
        for tick, text in zip(across.ticks, across.texts(), strict=True):
            x = self._between(left, right, across, tick)
            if grid:
                self._ink([x, x], [bottom, top], color=style.GRID, zorder=0.5)
            self._ink([x, x], [bottom, bottom - _TICK * POINT])
            self.sheet.text(
                x, bottom - (_TICK + _GAP) * POINT, text, ha="center", va="top", size=_SIZE
            )
        for tick, text in zip(up.ticks, up.texts(), strict=True):
            y = self._between(bottom, top, up, tick)
            if grid:
                self._ink([left, right], [y, y], color=style.GRID, zorder=0.5)
            self._ink([left, left - _TICK * POINT], [y, y])
            x = left - (_TICK + _GAP) * POINT
            self.sheet.text(x, y, text, ha="right", va="center", size=_SIZE)
        if across.name:
            y = bottom - (_TICK + _GAP + 1.5 * _SIZE) * POINT
            self.sheet.text((left + right) / 2, y, across.name, ha="center", va="top", size=_SIZE)
        if up.name:
            self.sheet.text(left, top + 4 * POINT, up.name, ha="left", va="bottom", size=_SIZE)
        self._ink([left, right, right, left, left], [bottom, bottom, top, top, bottom], zorder=3)

    def place(self, x, y):
        """The pixels of points of the panel; what lies beyond an axis is moved onto its end."""
        left, bottom, right, top = self.frame
        x = np.clip(self.across.fraction(x), 0.0, 1.0)
        y = np.clip(self.up.fraction(y), 0.0, 1.0)
        return left + x * (right - left), bottom + y * (top - bottom)

    def line(self, x, y, **how):
        """Draw a line, broken where a coordinate is NaN."""
        for piece in pieces(*self.place(x, y)):
            self.sheet.draw(*piece, **how)

    def dots(self, x, y, color, size=3.2, hollow=False, marker="o"):
        """Draw marks of `size` points, filled or hollow."""
        how = {"mfc": "white", "mec": color, "mew": 0.7} if hollow else {"mew": 0}
        across, up = self.place(x, y)
        self.sheet.draw(across, up, ls="none", marker=marker, ms=size, color=color, zorder=4, **how)

    def note(self, x, y, text, ha="left", va="center", shift=(0.0, 0.0)):
        """Write `text` beside a point, `shift` points away."""
        across, up = self.place(x, y)
        across, up = float(across[0]) + shift[0] * POINT, float(up[0]) + shift[1] * POINT
        self.sheet.text(across, up, text, ha=ha, va=va, size=6.0)

    def _between(self, start, end, axis, tick):
        low, high = axis.limits
        return start + (tick - low) / (high - low) * (end - start)

    def _ink(self, across, up, **how):
        self.sheet.draw(across, up, **({"color": style.FRAME, "lw": 0.6} | how))


def key(sheet, entries, left, top, width, columns):
    """Name the marks: entries of (text, colour, marker, hollow), in rows from the top left."""
    for i, (text, color, marker, hollow) in enumerate(entries):
        x = left + (i % columns) * width / columns
        y = top - (i // columns) * 1.45 * _SIZE * POINT
        if marker:
            how = {"mfc": "white", "mec": color, "mew": 0.7} if hollow else {"mew": 0}
            sheet.draw([x + 6], [y], ls="none", marker=marker, ms=3.2, color=color, **how)
        else:
            sheet.draw([x - 8, x + 20], [y, y], lw=0.9, color=color, ls="--" if hollow else "-")
        sheet.text(x + 7 * POINT, y, text, ha="left", va="center", size=_SIZE)
