"""Polygons with many sides: their area, and which points they contain."""

import numpy as np

from pseudorigid.kernel.compiled import jit

_SLABS = 2048  # bands of equal height; a point is compared with the sides in its band only


class Polygon:
    """A closed polygon with vertices (2, n) in order, its sides sorted into horizontal slabs."""

    def __init__(self, vertices: np.ndarray):
        self.x, self.y = vertices
        self.next_x, self.next_y = np.roll(self.x, -1), np.roll(self.y, -1)
        low, high = np.minimum(self.y, self.next_y), np.maximum(self.y, self.next_y)
        self.bottom, self.top = float(low.min()), float(high.max())
        first, last = self._slab(low), self._slab(high)
        sides = np.repeat(np.arange(low.size), last - first + 1)
        shift = np.arange(sides.size) - np.repeat(np.cumsum(last - first + 1), last - first + 1)
        slabs = last[sides] + shift + 1
        order = np.argsort(slabs, kind="stable")
        self.sides = sides[order]
        self.begin = np.searchsorted(slabs[order], np.arange(_SLABS + 1))

    def _slab(self, y: np.ndarray) -> np.ndarray:
        """Return the number of the slab that holds each y, or of the nearest one."""
        slab = (y - self.bottom) / (self.top - self.bottom) * _SLABS
        return np.clip(slab.astype(np.int64), 0, _SLABS - 1)

    def area(self) -> float:
        """Return the area inside the polygon."""
        return abs(0.5 * float(np.sum(self.x * self.next_y - self.next_x * self.y)))

    def contains(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Return which points are inside; x, y and the result have one shape."""
        inside = np.zeros(np.shape(x), dtype=np.bool_)
        points = np.ravel(x), np.ravel(y), self._slab(y).ravel()
        sides = self.x, self.y, self.next_x, self.next_y
        _count_crossings(points, sides, self.sides, self.begin, inside.reshape(-1))
        return inside


@jit
def _count_crossings(
    points: tuple[np.ndarray, ...],
    ends: tuple[np.ndarray, ...],
    sides: np.ndarray,
    begin: np.ndarray,
    inside: np.ndarray,
) -> None:
    """Set which points (x, y, slab) are inside, from the sides in each slab and their ends."""
    (x, y, slabs), (x0, y0, x1, y1) = points, ends
    for i in range(x.size):
        for j in range(begin[slabs[i]], begin[slabs[i] + 1]):
            side = sides[j]
            if (y0[side] > y[i]) != (y1[side] > y[i]):
                share = (y[i] - y0[side]) / (y1[side] - y0[side])
                if x[i] < x0[side] + share * (x1[side] - x0[side]):
                    inside[i] = not inside[i]
