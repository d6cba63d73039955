"""Exponents over stretches of chaotic orbits: by length, and in the long run."""

from typing import Any

import numpy as np
import xarray as xr

_ERRORS = 2.0  # standard errors on either side of a mean: 95 %
_OF_RUNS = {
    "run": "number of impacts of a run",
    "deviation": "standard deviation of the largest exponent of a run",
    "deviation_error": "standard error of the deviation, between orbits; NaN for one orbit",
    "skewness": "skewness of the largest exponent of a run; NaN if all runs are equal",
    "skewness_error": "standard error of the skewness, between orbits; NaN for one orbit",
}


def in_sea(spread: xr.Dataset) -> np.ndarray:
    """Return which orbits are chaotic."""
    return np.asarray(spread["type"].values == "chaotic")


def stretches(spread: xr.Dataset, length: int) -> np.ndarray:
    """Return the largest exponent of each stretch of `length` impacts of the chaotic orbits.

    `length` is a multiple of the dataset's block_impacts; the exponents are in nats an impact.
    """
    block = spread["exponent"].values[:, in_sea(spread)]
    return _runs(block, length // int(spread.attrs["block_impacts"])).ravel()


def _runs(block: np.ndarray, count: int) -> np.ndarray:
    """Return the largest exponents (runs, orbits) of runs of `count` blocks."""
    whole = block[: block.shape[0] // count * count]
    means = whole.reshape(-1, count, *block.shape[1:]).mean(axis=1)
    return np.asarray(means.max(axis=-1))


def long_run(spread: xr.Dataset) -> tuple[float, float]:
    """Return the mean of the largest exponents of whole orbits, and half its 95 % interval.

    The error comes from the spread between orbits, which assumes nothing of an orbit's parts.
    """
    largest = spread["exponent"].values[:, in_sea(spread)].mean(axis=0).max(axis=-1)
    return float(largest.mean()), float(_ERRORS * largest.std(ddof=1) / np.sqrt(largest.size))


def spread_of_runs(block: np.ndarray, impacts: int) -> dict[str, tuple[Any, ...]]:
    """Return how the largest exponents of runs spread, by length, from blocks (blocks, orbits, 3).

    `impacts` is the length of a block. Runs have 1, 2, 5, 10, ... blocks, and all. Errors come from
    leaving out one orbit at a time (jackknife), because an orbit's parts are not independent.
    """
    blocks = block.shape[0]
    round_numbers = (n * 10**i for i in range(len(str(blocks))) for n in (1, 2, 5))
    counts = sorted({blocks, *(n for n in round_numbers if n < blocks)})
    moments = np.transpose([_moments(_runs(block, count)) for count in counts])
    columns = [impacts * np.array(counts), *moments]
    return {
        name: ("run", column, meaning)
        for (name, meaning), column in zip(_OF_RUNS.items(), columns, strict=True)
    }


@np.errstate(invalid="ignore", divide="ignore")
def _moments(runs: np.ndarray) -> tuple[float, float, float, float]:
    """Return deviation and skewness of runs (runs, orbits), each followed by its error."""
    away, orbits = runs - runs.mean(), runs.shape[1]
    powers = np.ones_like(away), away, away * away, away * away * away
    sums = np.stack([power.sum(axis=0) for power in powers])
    left_out = np.stack(_standardized(*(sums.sum(axis=1, keepdims=True) - sums)))
    errors = np.sqrt((orbits - 1) * np.var(left_out, axis=1))
    deviation, skewness = _standardized(*sums.sum(axis=1))
    return float(deviation), float(errors[0]), float(skewness), float(errors[1])


def _standardized(n: Any, first: Any, second: Any, third: Any) -> tuple[Any, Any]:
    """Return standard deviation and skewness from a number and the sums of three powers."""
    mean, square = first / n, second / n
    deviation = np.sqrt(np.maximum(square - mean * mean, 0.0))
    moment = third / n - 3.0 * mean * square + 2.0 * mean * mean * mean
    return deviation, moment / (deviation * deviation * deviation)
