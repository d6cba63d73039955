"""A figure of one panel with the limits and ticks of a scene."""

from collections.abc import Sequence
from itertools import compress
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..canvas import style
from ..canvas.sheet import POINT, Sheet, width
from .limits import inside
from .panel import Axis, Panel

_LEFT, _BOTTOM, _TOP = 180, 135, 150  # pixels around the frame
STEP = 1.3 * style.PLAIN * POINT  # pixels: the least between texts beside the frame


class Plane(Panel):
    """A figure of a column's width that cuts off what lies beyond its axes.

    `axes` are two keys of scene["axes"], and `names` the names of these axes. The height `high` is
    a multiple of 75 pixels, `right` the margin in pixels. The ball, and with `energy` the scene's
    energy, are written above the frame; `room` pixels below them are left for a key.
    """

    tick, gap, size, small = 3.0, 3.0, style.PLAIN, style.PLAIN
    baseline = "center_baseline"
    corners = "projecting"
    clip_range = (-np.inf, np.inf)

    def __init__(
        self,
        scene: dict[str, Any],
        axes: tuple[str, str],
        names: tuple[str, str],
        high: int = 825,
        right: int = 60,
        energy: bool = True,
        room: int = 0,
    ) -> None:
        high += room
        sheet = Sheet(style.COLUMN, high)
        self.figure = sheet.figure
        frame = _LEFT, _BOTTOM, style.COLUMN - right, high - _TOP - room
        across, up = (scene["axes"][axis] for axis in axes)
        power = thousands(across["ticks"])
        labels = [style.number(tick, power) for tick in across["ticks"]]
        super().__init__(sheet, frame, Axis(**across, labels=labels), Axis(**up), grid=False)
        factor = rf" $/\;10^{power}$" if power else ""
        self._text((_LEFT + frame[2]) / 2, 6 * POINT, names[0] + factor, "center", "bottom")
        self._text(_LEFT, frame[3] + 5 * POINT, names[1], "left", "bottom")
        setting = style.setting(scene, energy)
        self._text(_LEFT, high - 4 * POINT, setting, "left", "top")

    def line(self, x: ArrayLike, y: ArrayLike, **line_style: Any) -> None:
        """Draw a line inside the frame, broken where a coordinate is NaN."""
        super().line(x, y, clip=self.frame, **line_style)

    def dots(
        self, x: ArrayLike, y: ArrayLike, color: Any, size: float = 3.2, **line_style: Any
    ) -> None:
        """Draw the dots of `size` points that lie within the limits, also across the frame."""
        x, y = np.array([x, y])[:, self.shows(x, y)]
        self.sheet.dots(*self.place(x, y), color, size, **line_style)

    def shows(self, x: ArrayLike, y: ArrayLike) -> np.ndarray:
        """Return whether each point lies within the limits."""
        return inside((self.across.limits, self.up.limits), np.array([x, y]))

    def beside(self, x: float, y: np.ndarray, texts: Sequence[str]) -> None:
        """Write texts right of points at x with falling y, those within the limits.

        They stand right of the frame if there is no room in it.
        """
        heights = self.place(0.0, y)[1]
        texts = [*compress(texts, inside([self.frame[1::2]], [heights]).tolist())]
        right, gap = self.frame[2], 4 * POINT
        left = float(self.place(x, 0.0)[0][0]) + gap
        wide = max((width(text, self.size) for text in texts), default=0.0)
        within = left + wide + gap < right
        for height, text in zip(self.spread(heights, 0.5 * STEP * within), texts, strict=True):
            if within:  # a line may pass there
                ground = {"color": "white", "lw": self.size}
                self.sheet.draw([left, left + wide], [height, height], **ground)
            self._text(left if within else right + gap, height, text, "left", "center")

    def spread(self, heights: np.ndarray, margin: float) -> list[float]:
        """Return heights of texts, in pixels, beside falling ones within the frame.

        They are at least `margin` from its ends. Those that would collide are moved apart, as
        little as possible (least squares).
        """
        groups: list[list[float]] = []  # heights of texts that touch in the end
        for height in heights[inside([self.frame[1::2]], [heights])].tolist():
            groups.append([height])
            while len(groups) > 1 and _spaced(groups[-2])[-1] - _spaced(groups[-1])[0] < STEP:
                groups[-2:] = [groups[-2] + groups[-1]]
        apart = [height for group in groups for height in _spaced(group)]
        steps = STEP * np.arange(len(apart))  # labels stand below the frame
        low, high = self.frame[1] + margin, self.frame[3] - margin
        return np.clip(apart, low + steps[::-1], high - steps).tolist()

    def legend(self, *entries: Any) -> None:
        """Name lines and dots, (text, width in points, style), above the right end of the frame.

        An entry that is not true is left out.
        """
        across, up = self.frame[2], self.frame[3] + 8.5 * POINT
        for text, wide, line_style in filter(None, reversed(entries)):
            across -= wide * POINT
            self._text(across, up, text, "left", "center")
            start, end = across - 18 * POINT, across - 4 * POINT
            if "dots" in line_style:
                middle = [(start + end) / 2 + 3 * POINT]
                self.sheet.dots(middle, [up], line_style["color"], line_style["dots"])
            else:
                self.sheet.draw([start, end], [up, up], **line_style)
            across = start - 8 * POINT

    def _label(self, x: float, text: str) -> float:
        """Move a label to the left if it would leave the sheet."""
        half_width = 0.32 * len(text) * style.PLAIN * POINT  # an upper bound
        return min(x, style.COLUMN - half_width - 6)


def _spaced(heights: Sequence[float]) -> list[float]:
    """Return heights that are a step apart, with the same mean."""
    middle = sum(heights) / len(heights)
    return [middle + (0.5 * (len(heights) - 1) - i) * STEP for i in range(len(heights))]


def thousands(ticks: Sequence[float]) -> int:
    """Return the power of ten to take out of tick labels: 0 if none has five digits."""
    power = len(str(int(max(abs(tick) for tick in ticks)))) - 1
    return power if power >= 4 else 0
