"""Rows of a contiguous ragged array, and the unbroken pieces of a line."""

from itertools import pairwise

import numpy as np

_LONGEST = 5000  # vertices that matplotlib strokes at once without slowing down


def rows(dataset):
    """Return a slice for each row of a CF contiguous ragged array, from its `row_size`."""
    ends = [0, *np.cumsum(dataset["row_size"].values, dtype=np.int64).tolist()]
    return [slice(start, end) for start, end in pairwise(ends)]


def runs(gap):
    """Return a slice for each run of places where `gap` is false."""
    return np.ma.clump_unmasked(np.ma.array(gap, mask=gap)) if gap.size else []


def pieces(*coordinates):
    """Yield the runs of a line without NaN, long ones in pieces that share a vertex, as tuples."""
    for run in runs(np.isnan(coordinates).any(axis=0)):
        for first in range(run.start, max(run.stop - 1, run.start + 1), _LONGEST):
            span = slice(first, min(first + _LONGEST + 1, run.stop))
            yield tuple(coordinate[span] for coordinate in coordinates)
