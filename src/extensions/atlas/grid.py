"""Borders of the cells of a sweep, which its curves and its picture share."""

from collections.abc import Sequence

import numpy as np


def edges(values: Sequence[float] | np.ndarray) -> np.ndarray:
    """Return the borders of cells, halfway between their values; a single cell is a unit wide."""
    values = np.asarray(values)
    if values.size == 1:
        return np.array([values[0] - 0.5, values[0] + 0.5])
    middle = 0.5 * (values[1:] + values[:-1])
    return np.concatenate([[2 * values[0] - middle[0]], middle, [2 * values[-1] - middle[-1]]])


def inertias(k: Sequence[float]) -> tuple[float, float]:
    """Return the least and the largest k of a plane, from edge to edge of the cells.

    They are not below 0, nor above a shell's k or, if a ball has more, what is allowed.
    """
    first, *_, last = edges(k).tolist()
    return max(first, 0.0), min(last, 1.0 / 3.0 if k[-1] <= 1.0 / 3.0 else 1.0)
