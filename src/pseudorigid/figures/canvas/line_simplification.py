"""Leave out the vertices of a line that nobody sees, so that the rest has bends worth the name.

Where a line is all but straight, matplotlib's rasteriser joins its edges where two almost parallel
lines meet: the last bit of a product then decides over a pixel's shade, and that bit depends on the
processor (on aarch64 the rasteriser is compiled with fused multiply-add).
"""

import numpy as np


def bends(across, up, tolerance):
    """The vertices to keep, the ends among them.

    A line through those passes the others, which lie between its ends, at no more than `tolerance`.

    Parameters
    ----------
    across, up : array_like, shape (n,)
        Whole numbers: the comparisons are exact.
    tolerance : int

    Returns
    -------
    list of int
        Indices.
    """
    x, y = np.asarray(across, dtype=np.int64), np.asarray(up, dtype=np.int64)
    keep = [0]
    for i in range(1, len(x) - 1):
        last = keep[-1]
        inner = slice(last + 1, i + 1)
        wide, high = x[i + 1] - x[last], y[i + 1] - y[last]
        dx, dy = x[inner] - x[last], y[inner] - y[last]
        square = wide * wide + high * high
        along = dx * wide + dy * high
        off = np.abs(dx * high - dy * wide)
        unseen = (off <= tolerance * np.sqrt(float(square))) & (along >= 0) & (along <= square)
        if square == 0 or not unseen.all():
            keep.append(i)
    return [*keep, len(x) - 1] if len(x) > 1 else keep
