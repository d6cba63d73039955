"""Which points lie inside a polygon of many sides."""

import numpy as np

from ..kernel.compiled import jit

_SLABS = 2048  # a point is held against the sides of its slab alone


class Polygon:
    """A closed polygon, its sides sorted into slabs by height.

    Parameters
    ----------
    vertices : ndarray, shape (2, n)
        x and y, in order; the last is joined to the first.
    """

    def __init__(self, vertices):
        self.x, self.y = vertices
        self.after_x, self.after_y = np.roll(self.x, -1), np.roll(self.y, -1)
        low, high = np.minimum(self.y, self.after_y), np.maximum(self.y, self.after_y)
        self.bottom, self.top = float(low.min()), float(high.max())
        first, last = self._slab(low), self._slab(high)
        sides = np.repeat(np.arange(low.size), last - first + 1)
        shift = np.arange(sides.size) - np.repeat(np.cumsum(last - first + 1), last - first + 1)
        slabs = last[sides] + shift + 1
        order = np.argsort(slabs, kind="stable")
        self.sides = sides[order]
        self.begin = np.searchsorted(slabs[order], np.arange(_SLABS + 1))

    def _slab(self, y):
        place = (y - self.bottom) / (self.top - self.bottom) * _SLABS
        return np.clip(place.astype(np.int64), 0, _SLABS - 1)

    def area(self):
        """The area inside."""
        return abs(0.5 * float(np.sum(self.x * self.after_y - self.after_x * self.y)))

    def holds(self, x, y):
        """Which points are inside.

        Parameters
        ----------
        x, y : ndarray
            Of one shape.

        Returns
        -------
        ndarray of bool
            Of that shape.
        """
        inside = np.zeros(np.shape(x), dtype=np.bool_)
        slabs = self._slab(y).ravel()
        shape = self.x, self.y, self.after_x, self.after_y, self.sides, self.begin
        _crossings(np.ravel(x), np.ravel(y), slabs, *shape, inside.reshape(-1))
        return inside


@jit
def _crossings(x, y, slabs, x0, y0, x1, y1, sides, begin, inside):
    for i in range(x.size):
        for j in range(begin[slabs[i]], begin[slabs[i] + 1]):
            side = sides[j]
            if (y0[side] > y[i]) != (y1[side] > y[i]):
                across = x0[side] + (y[i] - y0[side]) / (y1[side] - y0[side]) * (
                    x1[side] - x0[side]
                )
                if x[i] < across:
                    inside[i] = not inside[i]
