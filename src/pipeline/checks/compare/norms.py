"""How much the data of two artifacts of one stage differ, variable by variable."""

import numpy as np

from ...records.artifacts import canonical_values
from ...records.differences import columns


def table(one, other, names):
    """Describe each variable that differs: a table with a line a variable.

    The columns are the number of values (both shapes where these differ), the root mean squares,
    the relative difference in the L2 norm, |B - A|/|A|, and the largest difference of two values.
    """
    rows = _rows(one, other, names)
    if not rows:
        return ["the same data"]
    head = ("variable", "values", *(f"rms {name}" for name in names), "relative", "largest")
    return columns([head, *(row for row, _ in rows)])


def summary(one, other, names):
    """Describe in one line how many variables differ, and which differs most."""
    rows = _rows(one, other, names)
    if not rows:
        return "the same data"
    line = f"{len(rows)} of {len({*one.variables, *other.variables})} variables differ"
    sizes = {row[0]: relative for row, relative in rows if relative is not None}
    if real := [name for name in sizes if one.variables[name].dtype.kind == "f"]:
        most = max(real, key=sizes.get)
        line += f", {most} the most: by {sizes[most]:.3g} of its norm"
    others = len(rows) - len(sizes)
    return line + (f"; {others} of other lengths or in one only" if others else "")


def _rows(one, other, names):
    """A pair for each variable that differs: its row of texts, its relative difference or None."""
    rows = []
    for name in sorted({*one.variables, *other.variables}, key=str):
        if name not in one.variables or name not in other.variables:
            owner = names[0] if name in one.variables else names[1]
            rows.append(((name, f"in {owner} only", "", "", "", ""), None))
            continue
        a, b = one.variables[name], other.variables[name]
        if a.dtype.kind not in "iuf" or b.dtype.kind not in "iuf" or _equal(a, b):
            continue
        a, b = (np.asarray(part.values, dtype=float) for part in (a, b))
        shapes = [" x ".join(map(str, part.shape)) for part in (a, b)]
        sizes = f"{_rms(a):.6g}", f"{_rms(b):.6g}"
        if a.shape != b.shape:
            rows.append(((name, f"{shapes[0]} | {shapes[1]}", *sizes, "", ""), None))
            continue
        there = np.isfinite(a) & np.isfinite(b)
        gap = (b - a)[there]
        norm = np.sqrt(np.sum(a[there] ** 2))
        relative = float(np.sqrt(np.sum(gap**2)) / norm) if norm else None
        told = "-" if relative is None else f"{relative:.3g}"
        largest = f"{np.max(np.abs(gap), initial=0.0):.3g}"
        rows.append(((name, shapes[0], *sizes, told, largest), relative))
    return rows


def _equal(a, b):
    (kind, a_values), (other, b_values) = canonical_values(a), canonical_values(b)
    return a.shape == b.shape and kind == other and a_values.tobytes() == b_values.tobytes()


def _rms(values):
    values = values[np.isfinite(values)]
    return float(np.sqrt(np.mean(values**2))) if values.size else 0.0
