"""A plane picture: frame, ticks and names; limits and ticks as the scene gives them."""

from itertools import pairwise

import numpy as np

from ..canvas import style
from ..canvas.ragged import pieces
from ..canvas.sheet import POINT, Sheet

_LEFT, _BOTTOM, _TOP = 180, 135, 75  # pixels around the frame
_TICK, _GAP = 3.0, 2.5  # points: a tick's length, and from there to its label


class Plane:
    """A figure of a column's width for two axes of the scene, keys of scene["axes"].

    `names` are the axes' names, the second one written above its upper end; `high` is the height of
    the figure and `right` the margin beside the frame, in pixels.
    """

    def __init__(self, scene, axes, names, high=750, right=60):
        self.sheet = Sheet(style.COLUMN, high)
        self.figure = self.sheet.figure
        self.frame = (_LEFT, _BOTTOM, style.COLUMN - right, high - _TOP)
        self.spans = [scene["axes"][axis]["limits"] for axis in axes]
        self._ticks(*(scene["axes"][axis]["ticks"] for axis in axes))
        power = thousands(scene["axes"][axes[0]]["ticks"])
        left, bottom, right, top = self.frame
        factor = rf" $/\;10^{power}$" if power else ""
        self._text((left + right) / 2, 6 * POINT, names[0] + factor, "center", "bottom")
        self._text(left, top + 5 * POINT, names[1], "left", "bottom")
        outline = [left, right, right, left, left], [bottom, bottom, top, top, bottom]
        self._ink(*outline, solid_capstyle="projecting", zorder=3)

    def place(self, x, y):
        """Return the pixels of a point of the plane."""
        left, bottom, right, top = self.frame
        (x0, x1), (y0, y1) = self.spans
        across = left + (np.asarray(x) - x0) / (x1 - x0) * (right - left)
        return across, bottom + (np.asarray(y) - y0) / (y1 - y0) * (top - bottom)

    def line(self, x, y, **how):
        """Draw a line inside the frame, broken where a coordinate is NaN."""
        for piece in pieces(*self.place(x, y)):
            self.sheet.draw(*piece, clip=self.frame, **how)

    def dots(self, x, y, color, size, **how):
        """Draw dots of `size` points across, on the frame too."""
        self._dots(*self.place(x, y), color, size, **how)

    def beside(self, entries):
        """Write texts to the right of the frame: entries of (height y, text), from above.

        Where they would cover each other they are moved apart.
        """
        heights = [float(self.place(0, y)[1]) for y, _ in entries]
        middle, step = sum(heights) / len(heights), 1.3 * style.PLAIN * POINT
        if any(above - below < step for above, below in pairwise(heights)):
            heights = [middle + (0.5 * (len(heights) - 1) - i) * step for i in range(len(heights))]
        for height, (_, text) in zip(heights, entries, strict=True):
            self._text(self.frame[2] + 4 * POINT, height, text, "left", "center_baseline")

    def legend(self, *entries):
        """Name lines above the frame's right-hand end, where no data can be.

        An entry is (text, its width in points, style of the line); a style with `dots` is a dot
        of that size.
        """
        across, up = self.frame[2], self.frame[3] + 8.5 * POINT
        for text, width, how in reversed(entries):
            across -= width * POINT
            self._text(across, up, text, "left", "center")
            start, end = across - 18 * POINT, across - 4 * POINT
            if "dots" in how:
                self._dots([(start + end) / 2 + 3 * POINT], [up], how["color"], how["dots"])
            else:
                self.sheet.draw([start, end], [up, up], **how)
            across = start - 8 * POINT

    def _ticks(self, across, up):
        power = thousands(across)
        left, bottom, _, _ = self.frame
        for tick in across:
            x = float(self.place(tick, 0)[0])
            self._ink([x, x], [bottom, bottom - _TICK * POINT])
            y = bottom - (_TICK + _GAP) * POINT
            label = style.number(tick, power)
            half = 0.32 * len(label) * style.PLAIN * POINT  # at most: a long one stays on the sheet
            self._text(min(x, style.COLUMN - half - 6), y, label, "center", "top")
        for tick in up:
            y = float(self.place(0, tick)[1])
            self._ink([left, left - _TICK * POINT], [y, y])
            self._text(
                left - (_TICK + _GAP) * POINT, y, style.number(tick), "right", "center_baseline"
            )

    def _ink(self, across, up, **how):
        self.sheet.draw(across, up, color=style.FRAME, lw=0.6, **how)

    def _dots(self, across, up, color, size, **how):
        how = {"mew": 0} | how
        self.sheet.draw(across, up, ls="none", marker="o", ms=size, color=color, **how)

    def _text(self, across, up, text, ha, va):
        self.sheet.text(across, up, text, ha=ha, va=va, size=style.PLAIN)


def thousands(ticks):
    """Return the power of ten to take out of the labels: 0 below ticks of five digits."""
    largest = max(abs(tick) for tick in ticks)
    power = 0
    while largest >= 10 ** (power + 1):
        power += 1
    return power if power >= 4 else 0
