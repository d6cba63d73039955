"""From which impact on two artifacts of orbits with the same starts are apart."""

import numpy as np

from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.variables import states_of

# Of the section's radius: a third of a dot of Figures 2 and 8.
VISIBLE = 1e-3


def table(one, other):
    """From where on two artifacts' orbits are apart by more than VISIBLE.

    A line an orbit, with the largest difference where there is no such impact; none at all where
    starts or lengths differ.
    """
    if any(not np.array_equal(one[n], other[n], equal_nan=True) for n in ("start", "row_size")):
        return []
    radius = Ball(one.attrs["k"], one.attrs["g"]).section(one.attrs["energy"])[1]
    states = [states_of(data) for data in (one, other)]
    apart = np.max(np.abs(states[0] - states[1]), axis=0) / radius
    lines, end = [], 0
    for index, size in enumerate(one["row_size"].values):
        gaps = apart[end : end + size]
        end += size
        far = np.flatnonzero(gaps > VISIBLE)
        words = f"orbit {index} (start {float(one['start'][index]):g}): "
        if far.size:
            words += f"apart by more than {VISIBLE:g} section radii from impact {far[0] + 1:,} on"
        else:
            words += f"at most {gaps.max():.2g} section radii apart over {size:,} impacts"
        lines.append(words)
    return lines
