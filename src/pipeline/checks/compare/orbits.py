"""Comparison of two datasets of orbits with the same starts: from which impact on they differ."""

import numpy as np
import xarray as xr

from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.variables import states_of

VISIBLE = 1e-3  # section radii: a third of a dot of Figures 2 and 8


def table(first: xr.Dataset, second: xr.Dataset) -> list[str]:
    """Describe for each orbit from which impact on the two datasets differ visibly.

    The list is empty if starts or lengths differ.
    """
    lines = []
    for index, (size, impact, largest) in enumerate(_distances(first, second)):
        words = f"at most {largest:.2g} section radii apart over {size:,} impacts"
        if impact:
            words = f"apart by more than {VISIBLE:g} section radii from impact {impact:,} on"
        lines.append(f"orbit {index} (start {float(first['start'][index]):g}): {words}")
    return lines


def summary(first: xr.Dataset, second: xr.Dataset) -> list[str]:
    """Say in one line how many orbits differ visibly, or nothing if starts or lengths differ."""
    orbits = _distances(first, second)
    if not orbits:
        return []
    differing = [impact for _, impact, _ in orbits if impact]
    if not differing:
        largest = max(largest for *_, largest in orbits)
        return [f"all {len(orbits)} orbits stay within {largest:.2g} section radii"]
    count = f"{len(differing)} of {len(orbits)} orbits"
    apart = f"are apart by more than {VISIBLE:g} section radii"
    return [f"{count} {apart}, the first from impact {min(differing):,} on"]


def _distances(first: xr.Dataset, second: xr.Dataset) -> list[tuple[int, int, float]]:
    """Return each orbit's length, first visibly different impact (or 0), and largest distance."""
    if any(not np.array_equal(first[n], second[n], equal_nan=True) for n in ("start", "row_size")):
        return []
    radius = Ball(first.attrs["k"], first.attrs["g"]).section(first.attrs["energy"])[1]
    states = [states_of(data) for data in (first, second)]
    apart = np.max(np.abs(states[0] - states[1]), axis=0) / radius
    sizes = first["row_size"].values
    orbits = []
    for size, gaps in zip(sizes, np.split(apart, np.cumsum(sizes)[:-1]), strict=True):
        far = np.flatnonzero(gaps > VISIBLE)
        orbits.append((int(size), int(far[0]) + 1 if far.size else 0, float(gaps.max())))
    return orbits
