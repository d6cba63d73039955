"""Differences between two datasets of one stage, variable by variable."""

from collections.abc import Sequence

import numpy as np
import xarray as xr

from ...records.artifacts import canonical_values
from ...records.differences import columns

_SAME = "the same data"
_Row = tuple[str, str, str, str, str, str]


def table(first: xr.Dataset, second: xr.Dataset, names: Sequence[str]) -> list[str]:
    """Tabulate the variables that differ.

    The columns are the number of values (both shapes if these differ), the root mean squares, the
    relative difference in the L2 norm, |B - A|/|A|, and the largest difference of two values.
    """
    rows = _rows(first, second, names)
    head = ("variable", "values", *(f"rms {name}" for name in names), "relative", "largest")
    return columns([head, *(row for row, _ in rows)]) if rows else [_SAME]


def summary(first: xr.Dataset, second: xr.Dataset, names: Sequence[str]) -> str:
    """Say in one line how many variables differ, and which differs most."""
    rows = _rows(first, second, names)
    if not rows:
        return _SAME
    line = f"{len(rows)} of {len({*first.variables, *second.variables})} variables differ"
    relative = {row[0]: size for row, size in rows if size is not None}
    if real := {n: size for n, size in relative.items() if first.variables[n].dtype.kind == "f"}:
        most = max(real, key=real.__getitem__)
        line += f", {most} the most: by {real[most]:.3g} of its norm"
    others = len(rows) - len(relative)
    return line + (f"; {others} of other lengths or in one only" if others else "")


def _rows(
    first: xr.Dataset, second: xr.Dataset, names: Sequence[str]
) -> list[tuple[_Row, float | None]]:
    """Return, for each variable that differs, its row of texts and its relative difference."""
    rows: list[tuple[_Row, float | None]] = []
    for name in sorted(map(str, {*first.variables, *second.variables})):
        if name not in first.variables or name not in second.variables:
            owner = names[0] if name in first.variables else names[1]
            rows.append(((name, f"in {owner} only", "", "", "", ""), None))
            continue
        variables = first.variables[name], second.variables[name]
        if any(v.dtype.kind not in "iuf" for v in variables) or _equal(*variables):
            continue
        a, b = (np.asarray(variable.values, dtype=float) for variable in variables)
        shapes = [" x ".join(map(str, part.shape)) for part in (a, b)]
        sizes = f"{_rms(a):.6g}", f"{_rms(b):.6g}"
        if a.shape != b.shape:
            rows.append(((name, f"{shapes[0]} | {shapes[1]}", *sizes, "", ""), None))
            continue
        finite = np.isfinite(a) & np.isfinite(b)
        gap = (b - a)[finite]
        norm = np.sqrt(np.sum(a[finite] ** 2))
        relative = float(np.sqrt(np.sum(gap**2)) / norm) if norm else None
        relative_text = "-" if relative is None else f"{relative:.3g}"
        largest = f"{np.max(np.abs(gap), initial=0.0):.3g}"
        rows.append(((name, shapes[0], *sizes, relative_text, largest), relative))
    return rows


def _equal(a: xr.Variable, b: xr.Variable) -> bool:
    (a_type, a_values), (b_type, b_values) = canonical_values(a), canonical_values(b)
    same_bytes = np.asarray(a_values).tobytes() == np.asarray(b_values).tobytes()
    return a.shape == b.shape and a_type == b_type and same_bytes


def _rms(values: np.ndarray) -> float:
    values = values[np.isfinite(values)]
    return float(np.sqrt(np.mean(values**2))) if values.size else 0.0
