"""Differences between two datasets of one stage: all variables, orbits and Lyapunov exponents."""

from collections.abc import Iterator, Sequence

import numpy as np
import xarray as xr

from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.variables import final_exponents, states_of

from ...records.artifacts import canonical_values
from ...records.differences import columns

VISIBLE = 1e-3  # section radii: a third of a dot of Figures 2 and 8


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
    radius = Ball(first.attrs["k"], first.attrs["g"]).section(first.attrs["energy"])[1]
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
    counts = [
        f"{data.sizes['orbit']} of {int(data['impact'].values[-1]):,}" for data in (first, second)
    ]
    return columns([*rows, ("impacts", *counts)])


def spread(values: np.ndarray) -> str:
    """Return `mean ± standard deviation (least to largest)`, or a single value alone."""
    if values.size == 1:
        return _fixed(values[0])
    ends = f"{_fixed(np.min(values))} to {_fixed(np.max(values))}"
    return f"{_fixed(np.mean(values))} ± {_fixed(np.std(values, ddof=1))} ({ends})"


def _fixed(value: float) -> str:
    text = f"{value:.4f}"
    return text.removeprefix("-") if float(text) == 0.0 else text
