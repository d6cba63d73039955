"""Rows of a contiguous ragged array, and the unbroken pieces of a line."""

from itertools import pairwise

import numpy as np

_LONGEST = 5000  # vertices that matplotlib strokes at once without slowing down


def rows(dataset):
    """One slice for each row: `row_size` samples each, one row after the other (CF)."""
    ends = [0, *np.cumsum(dataset["row_size"].values, dtype=np.int64).tolist()]
    return [slice(start, end) for start, end in pairwise(ends)]


def pieces(*coordinates):
    """The runs without NaN of a line, long ones cut where they join on.

    The cut pieces share a vertex, so that they draw as one line.

    Parameters
    ----------
    *coordinates : ndarray, shape (n,)

    Yields
    ------
    tuple of ndarray
    """
    gap = np.isnan(coordinates).any(axis=0)
    ends = np.flatnonzero(np.diff(np.concatenate(([True], gap, [True])).astype(np.int8)))
    for start, stop in ends.reshape(-1, 2).tolist():
        for first in range(start, max(stop - 1, start + 1), _LONGEST):
            span = slice(first, min(first + _LONGEST + 1, stop))
            yield tuple(coordinate[span] for coordinate in coordinates)
