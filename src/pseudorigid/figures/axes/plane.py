"""A plane picture: a figure of one panel; limits and ticks as the scene gives them."""

from itertools import pairwise

import numpy as np

from ..canvas import style
from ..canvas.sheet import POINT, Sheet
from .panel import Axis, Panel

_LEFT, _BOTTOM, _TOP = 180, 135, 150  # pixels around the frame


class Plane(Panel):
    """A figure of a column's width; what lies beyond an axis is cut off.

    Parameters
    ----------
    scene : dict
        Its energy and ball are written above the frame.
    axes : pair of str
        Keys of scene["axes"], which have limits and ticks.
    names : pair of str
        The axes' names, the second one written above its upper end.
    high : int
        The height of the figure in pixels, a multiple of 75.
    right : int
        The margin beside the frame in pixels.
    energy : bool
        Whether the picture is of the scene's one energy.
    """

    tick, gap, size, small = 3.0, 3.0, style.PLAIN, style.PLAIN
    baseline = "center_baseline"
    corners = "projecting"
    kept = (-np.inf, np.inf)

    def __init__(self, scene, axes, names, high=825, right=60, energy=True):
        sheet = Sheet(style.COLUMN, high)
        self.figure = sheet.figure
        frame = _LEFT, _BOTTOM, style.COLUMN - right, high - _TOP
        across, up = (scene["axes"][axis] for axis in axes)
        power = thousands(across["ticks"])
        labels = [style.number(tick, power) for tick in across["ticks"]]
        super().__init__(sheet, frame, Axis(**across, labels=labels), Axis(**up), grid=False)
        factor = rf" $/\;10^{power}$" if power else ""
        self._text((_LEFT + frame[2]) / 2, 6 * POINT, names[0] + factor, "center", "bottom")
        self._text(_LEFT, frame[3] + 5 * POINT, names[1], "left", "bottom")
        setting = style.setting(scene, energy)
        self._text(_LEFT, high - 4 * POINT, setting, "left", "top")

    def line(self, x, y, **how):
        """Draw a line inside the frame, broken where a coordinate is NaN."""
        super().line(x, y, clip=self.frame, **how)

    def dots(self, x, y, color, size, **how):
        """Draw dots of `size` points across, on the frame too."""
        self._dots(*self.place(x, y), color, size, **how)

    def beside(self, entries):
        """Write texts to the right of the frame: entries of (height y, text), from above.

        Where they would cover each other they are moved apart.
        """
        heights = self.place(0, [y for y, _ in entries])[1].tolist()
        middle, step = sum(heights) / len(heights), 1.3 * style.PLAIN * POINT
        if any(above - below < step for above, below in pairwise(heights)):
            heights = [middle + (0.5 * (len(heights) - 1) - i) * step for i in range(len(heights))]
        for height, (_, text) in zip(heights, entries, strict=True):
            self._text(self.frame[2] + 4 * POINT, height, text, "left", "center")

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

    def _label(self, x, text):
        """As far to the right as it stays on the sheet: half its width is at most this."""
        return min(x, style.COLUMN - 0.32 * len(text) * style.PLAIN * POINT - 6)

    def _dots(self, across, up, color, size, **how):
        self.sheet.draw(across, up, ls="none", marker="o", ms=size, color=color, **{"mew": 0} | how)


def thousands(ticks):
    """The power of ten to take out of the labels: 0 below ticks of five digits."""
    power = len(str(int(max(abs(tick) for tick in ticks)))) - 1
    return power if power >= 4 else 0
