"""The box around a three-dimensional picture: back panes, grid, ticks and names in plain lines."""

import numpy as np

from . import style
from .projection import Projection
from .sheet import POINT, Sheet

_WIDE = 1500  # pixels: drawn at five inches, read at a column's width
_SIZE, _NAME = 10.5, 12.5  # points: labels, names
_TICK, _GAP = 4.0, 3.0  # points: a tick's length, and from there to its label


class Box:
    """A figure with a box of equal data scales for scene["axes"] seen by scene["view"].

    `points` and `line` draw data into it; `figure` is the result. Raises ValueError unless the
    elevation is between 0 and 90 degrees: the panes behind the data suit a view from above.
    """

    def __init__(self, scene):
        if not 0 < scene["view"]["elevation"] < 90:
            raise ValueError(f"elevation {scene['view']['elevation']} is not between 0 and 90")
        self.spans = [scene["axes"][name]["limits"] for name in style.NAMES]
        self.ticks = [scene["axes"][name]["ticks"] for name in style.NAMES]
        self.view = Projection(self.spans, scene["view"])
        self.sheet = self._fit()
        self.figure = self.sheet.figure
        self._panes()
        self._edges()

    def points(self, x, y, z, color, size):
        """Draw small opaque dots of `size` points across, in the order given."""
        self._draw(x, y, z, ls="none", marker="o", ms=size, mew=0, color=color)

    def line(self, x, y, z, color, width):
        """Draw a line of `width` points."""
        self._draw(x, y, z, lw=width, color=color)

    def near(self, dataset):
        """Return for each state of an artifact whether the energy surface faces the eye there.

        The surface's normal is (k x - g, xdot, k udot).
        """
        k, g = dataset.attrs["k"], dataset.attrs["g"]
        x, xdot, udot = (dataset[name].values for name in style.NAMES)
        east, north, up = self.view.eye
        return (k * x - g) * east + xdot * north + k * udot * up > 0

    def _fit(self):
        """Place the box on a sheet with room for the labels, and return the sheet."""
        beside = {along: _TICK + _GAP + _SIZE * _ems(self.ticks[along]) for along in (1, 2)}
        left, right, bottom, top = ((beside[2] + 4), (beside[1] + 18), 26, 8)
        inner = _WIDE - (left + right) * POINT
        across, up = self.view(*self.view.corners().T)
        inner_high = inner * float((up.max() - up.min()) / (across.max() - across.min()))
        high = 75 * int(np.ceil((inner_high + (bottom + top) * POINT) / 75))
        self.view.place(left * POINT, high - top * POINT - inner_high, inner, inner_high)
        return Sheet(_WIDE, high)

    def _draw(self, x, y, z, **how):
        self.sheet.draw(*self.view(x, y, z), **how)

    def _edge(self, start, along, color, width):
        """Draw the box's line through `start` in the direction of one axis."""
        ends = np.array([start, start], dtype=float)
        ends[:, along] = self.spans[along]
        self.line(*ends.T, color, width)

    def _panes(self):
        """Draw the three panes behind the data: their grid lines, then their outlines."""
        # The pane behind the data is the one whose outward normal points away from the eye.
        back = [span[eye <= 0] for span, eye in zip(self.spans, self.view.eye, strict=True)]
        pairs = [(one, other) for one in range(3) for other in range(3) if one != other]
        for values, color in ((self.ticks, style.GRID), (self.spans, style.PANE)):
            for fixed, along in pairs:
                for value in values[fixed]:
                    start = list(back)
                    start[fixed] = value
                    self._edge(start, along, color, 0.6)

    def _edges(self):
        """Draw each axis on an edge that nothing stands before."""
        (x0, x1), (y0, y1), (z0, z1) = self.spans
        east, north, _ = self.view.eye
        front = (x1 if east > 0 else x0), (y1 if north > 0 else y0)
        self._axis(0, [x0, front[1], z0], self._towards(1, north))
        self._axis(1, [front[0], y0, z0], self._towards(0, east))
        corners = [(x, y) for x in (x0, x1) for y in (y0, y1)]
        leftmost = min(corners, key=lambda corner: float(self.view(*corner, z0)[0]))
        self._axis(2, [*leftmost, z0], (-1.0, 0.0))
        # The vertical axis has its name above its end, the others beside their middle.
        across, up = self.view(*leftmost, z1)
        name = style.NAMES["udot"]
        self.sheet.text(across, up + 2 * _GAP * POINT, name, ha="center", va="bottom", size=_NAME)
        for along, name in enumerate(list(style.NAMES.values())[:2]):
            middle = [(x0 + x1) / 2, (y0 + y1) / 2, z0]
            middle[1 - along] = front[1 - along]
            step = self._towards(1 - along, (east, north)[1 - along])
            size = _ems(self.ticks[along]) * abs(step[0]) + 0.9 * abs(step[1]) + 0.5
            reach = _TICK + 2 * _GAP + _SIZE * size
            self._beside(middle, step, reach, name, _NAME)

    def _towards(self, along, sign):
        """Return the unit step on the sheet along an axis, forwards or backwards."""
        across, up = self.view.right[along], self.view.up[along]
        length = float(np.sqrt(across * across + up * up)) * (1 if sign > 0 else -1)
        return across / length, up / length

    def _axis(self, along, start, step):
        """Draw one axis with its ticks in the direction of `step`, and their labels."""
        self._edge(start, along, style.FRAME, 0.8)
        for tick in self.ticks[along]:
            at = list(start)
            at[along] = tick
            across, up = self.view(*at)
            ends = np.array(
                [(across + step[0] * far, up + step[1] * far) for far in (0, _TICK * POINT)]
            )
            self.sheet.draw(*ends.T, color=style.FRAME, lw=0.8)
            self._beside(at, step, _TICK + _GAP, style.number(tick), _SIZE)

    def _beside(self, at, step, reach, text, size):
        """Write `text` so many points from a place of the box in the direction of `step`."""
        across, up = self.view(*at)
        ha = "center" if abs(step[0]) < 0.25 else ("left" if step[0] > 0 else "right")
        va = "center_baseline" if abs(step[1]) < 0.5 else ("bottom" if step[1] > 0 else "top")
        pixels = reach * POINT
        across, up = across + step[0] * pixels, up + step[1] * pixels
        self.sheet.text(across, up, text, ha=ha, va=va, size=size)


def _ems(ticks):
    """Return the width of the widest label in units of its size, from above."""
    wide = {".": 0.32, "\N{MINUS SIGN}": 0.84}
    return max(sum(wide.get(char, 0.64) for char in style.number(tick)) for tick in ticks)
