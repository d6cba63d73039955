"""Comparison of the periodic orbits of two datasets: kept, changed in type, lost or gained."""

from collections.abc import Sequence

import numpy as np
import xarray as xr

from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.variables import chart, states_of

REACH = 0.25  # section radii; two orbits farther apart count as one lost and one gained


def table(first: xr.Dataset, second: xr.Dataset, names: Sequence[str]) -> list[str]:
    """Describe what became of each orbit of two datasets of the stage `periodic`."""
    before, after = _described(first), _described(second)
    periods = [data.attrs["period"] for data in (first, second)]
    if periods[0] != periods[1]:
        both = zip(names, periods, (before, after), strict=True)
        return [f"{name}: period {period}: {', '.join(o) or 'none'}" for name, period, o in both]
    lines = []
    pairs, lost, gained = match(first, second)
    for i, j, distance in pairs:
        kept = first["type"].values[i] == second["type"].values[j]
        change = "kept" if kept else "changed in type"
        lines.append(f"{change}: {before[i]} | {after[j]}, moved {distance:.3g} section radii")
    lines += [f"lost: {before[i]}" for i in lost]
    lines += [f"gained: {after[j]}" for j in gained]
    return [f"period {periods[0]}: {line}" for line in lines or ["none in either"]]


def match(
    first: xr.Dataset, second: xr.Dataset
) -> tuple[list[tuple[int, int, float]], list[int], list[int]]:
    """Match orbits of one period, the nearest first, in the section scaled to the unit disk.

    Returns (i, j, distance in section radii) of each pair, and the indices of the unmatched orbits
    of `first` and of `second`.
    """
    a, b = _in_disk(first), _in_disk(second)
    distances = sorted((_hausdorff(a[i], b[j]), i, j) for i in range(len(a)) for j in range(len(b)))
    pairs, lost, gained = [], set(range(len(a))), set(range(len(b)))
    for distance, i, j in distances:
        if distance <= REACH and i in lost and j in gained:
            pairs.append((i, j, distance))
            lost.remove(i)
            gained.remove(j)
    return sorted(pairs), sorted(lost), sorted(gained)


def _in_disk(data: xr.Dataset) -> list[np.ndarray]:
    """Return each orbit's points in the unit disk, an array of shape (2, points)."""
    ball = Ball(data.attrs["k"], data.attrs["g"])
    centre, radius = ball.section(data.attrs["energy"])
    x, y = chart(ball.k, *states_of(data))
    scaled = (x - centre) / radius, y / (radius * np.sqrt(ball.k * (1.0 + ball.k)))
    return list(np.stack(scaled, axis=1))


def _hausdorff(a: np.ndarray, b: np.ndarray) -> float:
    """Return the Hausdorff distance of two sets of points, arrays of shape (2, points)."""
    gaps = np.sqrt(np.sum((a[:, :, None] - b[:, None, :]) ** 2, axis=0))
    return float(max(np.max(np.min(gaps, axis=0)), np.max(np.min(gaps, axis=1))))


def _described(data: xr.Dataset) -> list[str]:
    """Return the type of each orbit, with its rotation number or multiplier."""
    rotation, multiplier = data["rotation_number"].values, data["multiplier"].values
    return [
        f"elliptic (rotation {rotation[i]:.4g})"
        if kind == "elliptic"
        else f"{kind} (multiplier {multiplier[i]:.4g})"
        for i, kind in enumerate(data["type"].values)
    ]
