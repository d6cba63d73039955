"""Comparison of the periodic orbits of two datasets: kept, changed in type, lost or gained."""

from collections.abc import Sequence

import numpy as np
import xarray as xr

from pseudorigid.dynamics.ball import Ball

REACH = 0.25  # section radii; two orbits farther apart count as one lost and one gained


def table(first: xr.Dataset, second: xr.Dataset, names: Sequence[str]) -> list[str]:
    """Describe what became of each orbit of two datasets of the stage `periodic`."""
    periods = [data.attrs["period"] for data in (first, second)]
    if periods[0] != periods[1]:
        both = zip(names, periods, (first, second), strict=True)
        return [f"{name}: period {period}: {_listed(data)}" for name, period, data in both]
    head = f"period {periods[0]}"
    lines = []
    pairs, lost, gained = match(first, second)
    for i, j, distance in pairs:
        before, after = _described(first, i), _described(second, j)
        types = [str(data["type"].values[at]) for data, at in ((first, i), (second, j))]
        change = "kept" if types[0] == types[1] else "changed in type"
        lines.append(f"{head}: {change}: {before} | {after}, moved {distance:.3g}")
    lines += [f"{head}: lost: {_described(first, i)}" for i in lost]
    lines += [f"{head}: gained: {_described(second, j)}" for j in gained]
    return lines or [f"{head}: none in either"]


def match(
    first: xr.Dataset, second: xr.Dataset
) -> tuple[list[tuple[int, int, float]], list[int], list[int]]:
    """Match orbits of one period, the nearest first, in the section scaled to the unit disk.

    Returns
    -------
    pairs : list of (i, j, distance)
        Indices of matched orbits, and their distance in section radii.
    lost, gained : list of int
        Indices of the unmatched orbits of `first` and of `second`.
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
    x = (data["x"].values - centre) / radius
    y = data["xdot"].values - ball.k * data["udot"].values
    return list(np.stack([x, y / (radius * np.sqrt(ball.k * (1.0 + ball.k)))], axis=1))


def _hausdorff(a: np.ndarray, b: np.ndarray) -> float:
    """Return the Hausdorff distance of two sets of points, arrays of shape (2, points)."""
    gaps = np.sqrt(np.sum((a[:, :, None] - b[:, None, :]) ** 2, axis=0))
    return float(max(np.max(np.min(gaps, axis=0)), np.max(np.min(gaps, axis=1))))


def _described(data: xr.Dataset, i: int) -> str:
    type_ = str(data["type"].values[i])
    if type_ == "elliptic":
        return f"elliptic (rotation {float(data['rotation_number'].values[i]):.4g})"
    return f"{type_} (multiplier {float(data['multiplier'].values[i]):.4g})"


def _listed(data: xr.Dataset) -> str:
    return ", ".join(_described(data, i) for i in range(data.sizes["orbit"])) or "none"
