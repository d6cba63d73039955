"""Exponents over stretches of chaotic orbits, from a dataset of `spread`."""

import numpy as np
import xarray as xr


def in_sea(spread: xr.Dataset) -> np.ndarray:
    """Return which orbits are chaotic."""
    return np.asarray(spread["type"].values == "chaotic")


def stretches(spread: xr.Dataset, length: int) -> np.ndarray:
    """Return the largest exponent of each stretch of `length` impacts of the chaotic orbits.

    `length` is a multiple of the dataset's block_impacts; the exponents are in nats an impact.
    """
    block = spread["exponent"].values[:, in_sea(spread)]
    count = length // int(spread.attrs["block_impacts"])
    whole = block[: block.shape[0] // count * count]
    return np.asarray(whole.reshape(-1, count, *block.shape[1:]).mean(axis=1).max(axis=-1).ravel())
