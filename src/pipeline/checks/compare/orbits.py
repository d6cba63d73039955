"""From which impact on two artifacts of orbits with the same starts are apart."""

import numpy as np

from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.variables import states_of

# Of the section's radius: a third of a dot of Figures 2 and 8.
VISIBLE = 1e-3


def table(one, other):
    """Describe for each orbit from which impact on the two artifacts are visibly apart.

    Empty where starts or lengths differ.
    """
    lines = []
    for index, (size, first, largest) in enumerate(_orbits(one, other)):
        words = f"orbit {index} (start {float(one['start'][index]):g}): "
        if first:
            words += f"apart by more than {VISIBLE:g} section radii from impact {first:,} on"
        else:
            words += f"at most {largest:.2g} section radii apart over {size:,} impacts"
        lines.append(words)
    return lines


def summary(one, other):
    """Describe in one line how many orbits are visibly apart; empty where starts differ."""
    orbits = _orbits(one, other)
    if not orbits:
        return []
    apart = [first for _, first, _ in orbits if first]
    if not apart:
        largest = max(largest for *_, largest in orbits)
        return [f"all {len(orbits)} orbits stay within {largest:.2g} section radii"]
    line = f"{len(apart)} of {len(orbits)} orbits are apart by more than {VISIBLE:g} section radii"
    return [f"{line}, the first from impact {min(apart):,} on"]


def _orbits(one, other):
    """Of each orbit: its length, the first impact that is visibly apart or 0, the largest gap."""
    if any(not np.array_equal(one[n], other[n], equal_nan=True) for n in ("start", "row_size")):
        return []
    radius = Ball(one.attrs["k"], one.attrs["g"]).section(one.attrs["energy"])[1]
    states = [states_of(data) for data in (one, other)]
    apart = np.max(np.abs(states[0] - states[1]), axis=0) / radius
    orbits, end = [], 0
    for size in one["row_size"].values:
        gaps = apart[end : end + size]
        end += size
        far = np.flatnonzero(gaps > VISIBLE)
        orbits.append((int(size), int(far[0]) + 1 if far.size else 0, float(gaps.max())))
    return orbits
