"""How much the data of two artifacts of one stage differ, variable by variable."""

import numpy as np

from ...records.artifacts import canonical_values
from ...records.differences import columns


def table(one, other, names):
    """Lines: for each variable that differs its root mean squares, and the difference of the two.

    The relative difference is that of the L2 norms, |B - A|/|A|.
    """
    rows = []
    for name in sorted({*one.variables, *other.variables}, key=str):
        if name not in one.variables or name not in other.variables:
            owner = names[0] if name in one.variables else names[1]
            rows.append((name, f"in {owner} only", "", "", ""))
            continue
        a, b = one.variables[name], other.variables[name]
        if a.dtype.kind not in "iuf" or b.dtype.kind not in "iuf" or _equal(a, b):
            continue
        a, b = (np.asarray(part.values, dtype=float) for part in (a, b))
        sizes = f"{_rms(a):.6g}", f"{_rms(b):.6g}"
        if a.shape != b.shape:
            shapes = " x ".join(map(str, a.shape)), " x ".join(map(str, b.shape))
            rows.append((name, *sizes, f"{shapes[0]} | {shapes[1]} values", ""))
            continue
        there = np.isfinite(a) & np.isfinite(b)
        gap = (b - a)[there]
        norm = np.sqrt(np.sum(a[there] ** 2))
        relative = f"{np.sqrt(np.sum(gap**2)) / norm:.3g}" if norm else "-"
        rows.append((name, *sizes, relative, f"{np.max(np.abs(gap), initial=0.0):.3g}"))
    if not rows:
        return ["the same data"]
    head = ("variable", f"rms {names[0]}", f"rms {names[1]}", "relative", "largest difference")
    return columns([head, *rows])


def _equal(a, b):
    (kind, a_values), (other, b_values) = canonical_values(a), canonical_values(b)
    return a.shape == b.shape and kind == other and a_values.tobytes() == b_values.tobytes()


def _rms(values):
    values = values[np.isfinite(values)]
    return float(np.sqrt(np.mean(values**2))) if values.size else 0.0
