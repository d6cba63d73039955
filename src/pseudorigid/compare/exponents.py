"""Lyapunov exponents of two artifacts, with the spread between the orbits."""

import numpy as np

from .norms import columns


def table(one, other, names):
    """Lines: mean and standard deviation over the orbits of each exponent's last value."""
    rows = [("exponent", *names)]
    for index in range(one.sizes["index"]):
        texts = [spread(data["exponent"].values[-1, :, index]) for data in (one, other)]
        rows.append((f"lambda {index + 1}", *texts))
    counts = [
        f"{data.sizes['orbit']} of {int(data['impact'].values[-1]):,}" for data in (one, other)
    ]
    return columns([*rows, ("impacts", *counts)])


def spread(values):
    """`mean ± standard deviation`, and the two ends."""
    mean = float(np.mean(values))
    if values.size == 1:
        return f"{mean:.4f}"
    ends = f"{np.min(values):.4f} to {np.max(values):.4f}"
    return f"{mean:.4f} ± {np.std(values, ddof=1):.4f} ({ends})"
