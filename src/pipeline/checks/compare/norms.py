"""Differences between two datasets of one stage, variable by variable."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
import xarray as xr

from ...records.artifacts import canonical_values
from ...records.differences import columns

_SAME = "the same data"


class _Row(NamedTuple):
    variable: str
    values: str  # their number, or both shapes if these differ
    rms: tuple[str, str] = ("", "")
    largest: str = ""  # difference of two values
    relative: float | None = None  # difference in the L2 norm, |B - A|/|A|, if A is not 0


def table(first: xr.Dataset, second: xr.Dataset, names: Sequence[str]) -> list[str]:
    """Tabulate the variables that differ, with root mean squares and two measures of difference."""
    rows = [*_rows(first, second, names)]
    lines = [("variable", "values", *(f"rms {name}" for name in names), "relative", "largest")]
    for row in rows:
        relative = f"{row.relative:.3g}" if row.relative is not None else "-" * bool(row.largest)
        lines.append((row.variable, row.values, *row.rms, relative, row.largest))
    return columns(lines) if rows else [_SAME]


def summary(first: xr.Dataset, second: xr.Dataset, names: Sequence[str]) -> str:
    """Say in one line how many variables differ, and which differs most."""
    rows = [*_rows(first, second, names)]
    if not rows:
        return _SAME
    line = f"{len(rows)} of {len({*first.variables, *second.variables})} variables differ"
    relative = {row.variable: row.relative for row in rows if row.relative is not None}
    if real := {n: size for n, size in relative.items() if first.variables[n].dtype.kind == "f"}:
        most = max(real, key=real.__getitem__)
        line += f", {most} the most: by {real[most]:.3g} of its norm"
    others = len(rows) - len(relative)
    return line + (f"; {others} of other lengths or in one only" if others else "")


def _rows(first: xr.Dataset, second: xr.Dataset, names: Sequence[str]) -> Iterator[_Row]:
    """Yield a row for each variable that differs."""
    for name in sorted(map(str, {*first.variables, *second.variables})):
        if name not in first.variables or name not in second.variables:
            yield _Row(name, f"in {names[name not in first.variables]} only")
            continue
        variables = first.variables[name], second.variables[name]
        if any(v.dtype.kind not in "iuf" for v in variables) or _equal(*variables):
            continue
        a, b = (np.asarray(variable.values, dtype=float) for variable in variables)
        rms = f"{_rms(a):.6g}", f"{_rms(b):.6g}"
        shapes = [" x ".join(map(str, part.shape)) for part in (a, b)]
        if a.shape != b.shape:
            yield _Row(name, " | ".join(shapes), rms)
            continue
        finite = np.isfinite(a) & np.isfinite(b)
        gap, norm = (b - a)[finite], np.linalg.norm(a[finite])
        relative = float(np.linalg.norm(gap) / norm) if norm else None
        yield _Row(name, shapes[0], rms, f"{np.max(np.abs(gap), initial=0.0):.3g}", relative)


def _equal(a: xr.Variable, b: xr.Variable) -> bool:
    (a_type, a_values), (b_type, b_values) = canonical_values(a), canonical_values(b)
    same_bytes = np.asarray(a_values).tobytes() == np.asarray(b_values).tobytes()
    return a.shape == b.shape and a_type == b_type and same_bytes


def _rms(values: np.ndarray) -> float:
    values = values[np.isfinite(values)]
    return float(np.sqrt(np.mean(values**2))) if values.size else 0.0
