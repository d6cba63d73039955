"""Comparison of the Lyapunov exponents of two datasets, with the spread between their orbits."""

from collections.abc import Sequence

import numpy as np
import xarray as xr

from pseudorigid.dynamics.variables import final_exponents

from ...records.differences import columns


def table(first: xr.Dataset, second: xr.Dataset, names: Sequence[str]) -> list[str]:
    """Tabulate mean and spread over the orbits of each exponent's final value."""
    rows = [("exponent", *names)]
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
