"""Differences between two datasets of one stage, in words."""

from collections.abc import Iterator, Sequence

import numpy as np
import xarray as xr
from scipy.spatial.distance import directed_hausdorff

from pipeline.records.artifacts import canonical_values
from pipeline.records.differences import columns
from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.variables import chart, final_exponents, states_of

REACH = 0.25  # section radii; two periodic orbits farther apart count as one lost and one gained
VISIBLE = 1e-3  # section radii: a third of a dot of Figures 2 and 8


def differences(
    stage: str, first: xr.Dataset, second: xr.Dataset, names: Sequence[str]
) -> list[str]:
    """Return lines on how the datasets of a stage differ between two variants."""
    if stage == "periodic":
        return periodic_orbits(first, second, names)
    lines = [norms(first, second)]
    lines += orbits(first, second) if stage == "orbits" else []
    return lines + (exponents(first, second, names) if stage == "lyapunov" else [])


def norms(first: xr.Dataset, second: xr.Dataset) -> str:
    """Say in one line how many variables differ, and which differs most."""
    differing = dict(_differing(first, second))
    if not differing:
        return "the same data"
    line = f"{len(differing)} of {len({*first.variables, *second.variables})} variables differ"
    sizes = {name: size for name, size in differing.items() if size is not None}
    if real := {n: size for n, size in sizes.items() if first.variables[n].dtype.kind == "f"}:
        most = max(real, key=real.__getitem__)
        line += f", {most} the most: by {real[most]:.3g} of its norm"
    others = len(differing) - len(sizes)
    return line + (f"; {others} of other lengths or in one only" if others else "")


def _differing(first: xr.Dataset, second: xr.Dataset) -> Iterator[tuple[str, float | None]]:
    """Yield each variable that differs, with the L2 norm of the difference over that of the first.

    The second is None if the variables have other lengths, or the first one's norm is 0.
    """
    for name in sorted(map(str, {*first.variables, *second.variables})):
        variables = [data.variables[name] for data in (first, second) if name in data.variables]
        if len(variables) == 1 or variables[0].shape != variables[1].shape:
            yield name, None
        elif all(variable.dtype.kind in "iuf" for variable in variables) and not _equal(*variables):
            a, b = (np.asarray(variable.values, dtype=float) for variable in variables)
            finite = np.isfinite(a) & np.isfinite(b)
            norm = np.linalg.norm(a[finite])
            yield name, float(np.linalg.norm((b - a)[finite]) / norm) if norm else None


def _equal(a: xr.Variable, b: xr.Variable) -> bool:
    (a_type, a_values), (b_type, b_values) = canonical_values(a), canonical_values(b)
    return a_type == b_type and np.asarray(a_values).tobytes() == np.asarray(b_values).tobytes()


def orbits(first: xr.Dataset, second: xr.Dataset) -> list[str]:
    """Say in one line how many orbits differ visibly; [] if starts or lengths differ."""
    if any(not np.array_equal(first[n], second[n], equal_nan=True) for n in ("start", "row_size")):
        return []
    radius = Ball.unbounded(first.attrs["k"], first.attrs["g"]).section(first.attrs["energy"])[1]
    apart = np.max(np.abs(states_of(first) - states_of(second)), axis=0) / radius
    gaps = np.split(apart, np.cumsum(first["row_size"].values)[:-1])
    impacts = [int(np.argmax(each > VISIBLE)) + 1 for each in gaps if each.max() > VISIBLE]
    if not impacts:
        return [f"all {len(gaps)} orbits stay within {apart.max():.2g} section radii"]
    words = f"{len(impacts)} of {len(gaps)} orbits are apart by more than {VISIBLE:g} section radii"
    return [f"{words}, the first from impact {min(impacts):,} on"]


def exponents(first: xr.Dataset, second: xr.Dataset, names: Sequence[str]) -> list[str]:
    """Tabulate mean ± standard deviation over the orbits of each final Lyapunov exponent."""
    rows = [("mean ± deviation", *names)]
    for index in range(first.sizes["index"]):
        texts = [spread(final_exponents(data)[:, index]) for data in (first, second)]
        rows.append((f"lambda {index + 1}", *texts))
    counts = [f"{d.sizes['orbit']} of {int(d['impact'][-1]):,}" for d in (first, second)]
    return columns([*rows, ("impacts", *counts)])


def spread(values: np.ndarray) -> str:
    """Return `mean ± standard deviation (least to largest)`, or a single value alone."""
    if values.size == 1:
        return f"{values[0]:z.4f}"
    ends = f"{np.min(values):z.4f} to {np.max(values):z.4f}"
    return f"{np.mean(values):z.4f} ± {np.std(values, ddof=1):z.4f} ({ends})"


def periodic_orbits(first: xr.Dataset, second: xr.Dataset, names: Sequence[str]) -> list[str]:
    """Say which orbits of the stage `periodic` are kept, changed in type, lost or gained."""
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
    distances = sorted(
        (max(directed_hausdorff(p, q)[0], directed_hausdorff(q, p)[0]), i, j)
        for i, p in enumerate(a)
        for j, q in enumerate(b)
    )
    pairs, lost, gained = [], set(range(len(a))), set(range(len(b)))
    for distance, i, j in distances:
        if distance <= REACH and i in lost and j in gained:
            pairs.append((i, j, distance))
            lost.remove(i)
            gained.remove(j)
    return sorted(pairs), sorted(lost), sorted(gained)


def _in_disk(data: xr.Dataset) -> np.ndarray:
    """Return the points of all orbits in the unit disk, an array of shape (orbits, points, 2)."""
    ball = Ball.unbounded(data.attrs["k"], data.attrs["g"])
    centre, radius = ball.section(data.attrs["energy"])
    x, y = chart(ball.k, *states_of(data))
    return np.stack([(x - centre) / radius, y / (radius * np.sqrt(ball.k * (1.0 + ball.k)))], -1)


def _described(data: xr.Dataset) -> list[str]:
    """Return the type of each orbit, with its rotation number or multiplier."""
    rotation, multiplier = data["rotation_number"].values, data["multiplier"].values
    return [
        f"elliptic (rotation {rotation[i]:.4g})"
        if kind == "elliptic"
        else f"{kind} (multiplier {multiplier[i]:.4g})"
        for i, kind in enumerate(data["type"].values)
    ]
