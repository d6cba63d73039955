"""Lyapunov exponents of two artifacts, with the spread between the orbits."""

import numpy as np

from pseudorigid.dynamics.variables import final_exponents

from .norms import columns


def table(one, other, names):
    """Lines: mean and standard deviation over the orbits of each exponent's last value."""
    rows = [("exponent", *names)]
    for index in range(one.sizes["index"]):
        texts = [spread(final_exponents(data)[:, index]) for data in (one, other)]
        rows.append((f"lambda {index + 1}", *texts))
    counts = [
        f"{data.sizes['orbit']} of {int(data['impact'].values[-1]):,}" for data in (one, other)
    ]
    return columns([*rows, ("impacts", *counts)])


def spread(values):
    """`mean ± standard deviation`, and the two ends."""
    if values.size == 1:
        return _fixed(values[0])
    ends = f"{_fixed(np.min(values))} to {_fixed(np.max(values))}"
    return f"{_fixed(np.mean(values))} ± {_fixed(np.std(values, ddof=1))} ({ends})"


def _fixed(value):
    text = f"{value:.4f}"
    return text.removeprefix("-") if float(text) == 0.0 else text
