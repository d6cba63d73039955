"""Where a jump of the map parts the image of a curve."""

import numpy as np

_HALVINGS = 40  # of a side: a continuous image is then as good as one point
_LEFT = 0.01  # of a side's image: more than this that is left is a jump
_LEAST = 1e-9  # of the whole image: less is rounding


def parted(image, at):
    """Which sides of a curve's image are no part of it, since the map jumps between their ends.

    Parameters
    ----------
    image : callable
        Takes parameters of the curve (n,) to points (2, n).
    at : ndarray, shape (n + 1,)
        The parameters of the vertices, in order.

    Returns
    -------
    ndarray of bool, shape (n,)
    """
    low, high = at[:-1], at[1:]
    start, end = image(low), image(high)
    sides = _apart(start, end)
    extent = np.max(np.ptp(start, axis=1))
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        point = image(middle)
        first = _apart(start, point) > _apart(point, end)
        low, high = np.where(first, low, middle), np.where(first, middle, high)
        start, end = np.where(first, start, point), np.where(first, point, end)
    return _apart(start, end) > np.maximum(_LEFT * sides, _LEAST * extent)


def _apart(one, other):
    return np.max(np.abs(one - other), axis=0)
