"""Comparison of two datasets of orbits with the same starts: from which impact on they differ."""

import numpy as np
import xarray as xr

from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.variables import states_of

VISIBLE = 1e-3  # section radii: a third of a dot of Figures 2 and 8
_APART = f"apart by more than {VISIBLE:g} section radii"


def table(first: xr.Dataset, second: xr.Dataset) -> list[str]:
    """Describe for each orbit from which impact on it differs; [] if starts or lengths differ."""
    lines = []
    for index, (size, impact, largest) in enumerate(_distances(first, second)):
        words = f"at most {largest:.2g} section radii apart over {size:,} impacts"
        if impact:
            words = f"{_APART} from impact {impact:,} on"
        lines.append(f"orbit {index} (start {float(first['start'][index]):g}): {words}")
    return lines


def summary(first: xr.Dataset, second: xr.Dataset) -> list[str]:
    """Say in one line how many orbits differ visibly; [] if starts or lengths differ."""
    orbits = _distances(first, second)
    differing = [impact for _, impact, _ in orbits if impact]
    if differing:
        count = f"{len(differing)} of {len(orbits)} orbits"
        return [f"{count} are {_APART}, the first from impact {min(differing):,} on"]
    largest = max((largest for *_, largest in orbits), default=0.0)
    return [f"all {len(orbits)} orbits stay within {largest:.2g} section radii"] * bool(orbits)


def _distances(first: xr.Dataset, second: xr.Dataset) -> list[tuple[int, int, float]]:
    """Return each orbit's length, first visibly different impact (or 0), and largest distance."""
    if any(not np.array_equal(first[n], second[n], equal_nan=True) for n in ("start", "row_size")):
        return []
    radius = Ball(first.attrs["k"], first.attrs["g"]).section(first.attrs["energy"])[1]
    apart = np.max(np.abs(states_of(first) - states_of(second)), axis=0) / radius
    orbits = []
    for gaps in np.split(apart, np.cumsum(first["row_size"].values)[:-1]):
        visible = gaps > VISIBLE
        impact = int(np.argmax(visible)) + 1 if visible.any() else 0
        orbits.append((gaps.size, impact, float(gaps.max())))
    return orbits
