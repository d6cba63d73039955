"""An axis of decades with zero at its lower end."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from pseudorigid.figures.axes.panel import Axis, Frame, Panel
from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.sheet import Sheet

_BREAK_STROKES = (-5, 9, style.FRAME, 0.6), (5, 9, style.FRAME, 0.6)  # of a break of an axis


class AxisWithZero(Axis):
    """An axis of decades whose lower end means zero and all that is below that end."""

    def fraction(self, values: ArrayLike) -> np.ndarray:
        """Return where values lie between the limits, 0 to 1."""
        return super().fraction(np.maximum(values, float(f"1e{self.limits[0]}")))

    def texts(self) -> Sequence[str]:
        """Return the labels of the ticks, the first of which is zero."""
        return self.labels or ["0", *super().texts()[1:]]


class PanelWithZeros(Panel):
    """A panel that marks the gap between zero and the powers of ten on an axis that has both."""

    def __init__(self, sheet: Sheet, frame: Frame, across: Axis, up: Axis) -> None:
        super().__init__(sheet, frame, across, up)
        left, bottom, *_ = frame
        for axis, start, level in ((across, left, bottom), (up, bottom, left)):
            if not isinstance(axis, AxisWithZero):
                continue
            for shift, rise, color, points in ((0, 0, "white", 1.6), *_BREAK_STROKES):
                along = [start + 30 + shift + end for end in (-5, 5)]
                off = [level - rise, level + rise]
                ends = (along, off) if axis is across else (off, along)
                sheet.draw(*ends, color=color, lw=points, zorder=3.5)


def axis_with_zero(low: int, high: float, name: str, every: int = 4) -> AxisWithZero:
    """Return an axis of decades with ticks at its lower end, which means zero, and above."""
    ticks = [low, *range(-(-(low + 1) // every) * every, int(high) + 1, every)]
    return AxisWithZero((low, high), ticks, name, True)
