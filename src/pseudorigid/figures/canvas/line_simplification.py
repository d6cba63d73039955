"""Leave out the vertices of a line that lie on a straight piece of it.

Where two edges of a line are almost parallel, matplotlib's rasteriser joins them at the
intersection of two almost parallel lines. The last bit of a product then decides the shade of a
pixel, and that bit depends on the processor: on aarch64 the rasteriser is compiled with fused
multiply-add.
"""

import numpy as np


def bends(across, up, tolerance):
    """Return the indices of the vertices to keep, which include both ends.

    A line through them passes the others within `tolerance`. Coordinates are whole numbers.
    """
    x, y = np.asarray(across, dtype=np.int64), np.asarray(up, dtype=np.int64)
    keep = [0]
    for i in range(1, len(x) - 1):
        last = keep[-1]
        inner = slice(last + 1, i + 1)
        wide, high = x[i + 1] - x[last], y[i + 1] - y[last]
        dx, dy = x[inner] - x[last], y[inner] - y[last]
        length_squared = wide * wide + high * high
        along = dx * wide + dy * high
        off = np.abs(dx * high - dy * wide)
        near = off <= tolerance * np.sqrt(float(length_squared))
        between = (along >= 0) & (along <= length_squared)
        if length_squared == 0 or not (near & between).all():
            keep.append(i)
    return [*keep, len(x) - 1] if len(x) > 1 else keep
