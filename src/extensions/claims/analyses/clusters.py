"""Clusters of impacts in the chaotic sea: flight times, and the memory from cluster to cluster.

A cluster begins with an impact after a flight that is longer than a cut. Its first state is the
point (x, y = xdot - k udot) of that impact. Two measures say how much of it the next cluster
remembers: correlation coefficients of the coordinates, and the correlation ratio, the share of a
coordinate's variance that is explained by the cell in which the cluster before began. The second
one sees any dependence, not only a linear one. Confidence intervals come from a bootstrap over
whole orbits.
"""

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import xarray as xr

from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.variables import ENERGY, TIME, chart, described, of_rows
from pseudorigid.kernel import impact as kernel
from pseudorigid.kernel.arithmetic import sincos
from pseudorigid.kernel.compiled import jit

from .sea import sea_states

# Bins of each coordinate, with equal counts: so few that each of the 64 cells of the correlation
# ratio holds many clusters.
_BINS = 8
_LINEAR = "correlation of what begins a cluster with what begins a later one"
_BY_CELL = "share of the variance explained by the cell in which the earlier one began"
_DRIFT = "largest difference of an impact's energy from the start's"
_KINETIC = "mean in time of the kinetic energy, of the centre's motion and of the strain's"
_INTERVAL = {"": "", "_low": ", 95 % interval from", "_high": ", 95 % interval to"}
_OF_CUTS = {
    "count": ("cut", "clusters"),
    "cluster_impacts": ("cut", "mean number of impacts in a cluster"),
    "cluster_time": ("cut", "mean time from a cluster's first impact to its last", TIME),
    "period": ("cut", "mean time from a cluster's first impact to the next one's", TIME),
    "period_error": ("cut", "standard error of that mean, between orbits", TIME),
    **{
        f"correlation{end}": (("cut", "lag", "first", "then"), _LINEAR + text)
        for end, text in _INTERVAL.items()
    },
    **{
        f"dependence{end}": (("cut", "lag", "then"), _BY_CELL + text)
        for end, text in _INTERVAL.items()
    },
}


def clusters(
    ball: Ball, energy: float, between: tuple[float, float], orbits: int, impacts: int,
    cuts: Sequence[float], lags: int, resamples: int, seed: int,
) -> xr.Dataset:  # fmt: skip
    """Compute flight times in the sea, clusters for each cut, and the memory between clusters.

    A cluster is compared with the next ones, up to `lags` later. Means of clusters are over all
    orbits. ValueError is raised for a cut that leaves an orbit with fewer clusters than lags + 2.

    >>> from pseudorigid import Ball
    >>> data = clusters(Ball(k=0.2, g=0.04), 0.01, (0.55, 0.68), 4, 200, [4, 6], 2, 10, 1)
    >>> data.sizes["cut"]
    2
    """
    states = sea_states(ball, energy, between, orbits)
    out = np.full((orbits, impacts + 1, 4), math.nan)
    out[:, 0, :3] = np.transpose(states)
    out[:, 1:] = ball.history(states, impacts)
    tau = out[:, 1:, 3]
    edges = 0.1 * np.arange(int(10.0 * float(tau.max())) + 2)
    time, depth, strain_energy, least, most = _strains(out, ball.k, ball.g)
    error = np.max(np.abs(ball.energy(*out.T[:3]) - energy), axis=0)
    kinetic_energy = (energy + ball.g * depth) - strain_energy
    data = {
        "bin_edge": ("edge", edges, "flight time", TIME),
        "flights": ("bin", np.histogram(tau, bins=edges)[0], "flights of such a time"),
        "time": ("orbit", time, "length of the orbit in time", TIME),
        "strain_energy": ("orbit", strain_energy, "mean in time of the strain energy", ENERGY),
        "kinetic_energy": ("orbit", kinetic_energy, _KINETIC, ENERGY),
        "least_strain": ("orbit", least, "largest compression, as a negative strain"),
        "largest_strain": ("orbit", most, "largest stretch"),
        "energy_error": ("orbit", error, _DRIFT, ENERGY),
        "cut": ("cut", np.asarray(cuts, dtype=float), "flight time that parts two clusters", TIME),
        "lag": ("lag", np.arange(1, lags + 1), "clusters later"),
    }
    resampled = np.random.default_rng(seed).integers(0, orbits, (resamples, orbits))
    rows = [_row(out, ball.k, cut, lags, resampled) for cut in cuts]
    return xr.Dataset(described(data) | of_rows(_OF_CUTS, rows))


@jit
def _strains(out: np.ndarray, k: float, g: float) -> np.ndarray:
    """Return time, mean x, mean strain energy, least and largest strain: (5, orbits)."""
    coefficients = kernel.impact_coefficients(k)
    result = np.empty((5, out.shape[0]))
    for i in range(out.shape[0]):
        time, depth, square, least, most = 0.0, 0.0, 0.0, 0.0, 0.0
        for j in range(out.shape[1] - 1):
            x, tau = out[i, j, 0], out[i, j + 1, 3]
            b, c, _ = kernel.rebound(out[i, j, 1], out[i, j, 2], k, coefficients)
            sine, cosine = sincos(tau)
            product = sine * cosine
            # u = c sin t - x cos t
            square += (
                0.5 * (x * x * (tau + product) + c * c * (tau - product)) - x * c * sine * sine
            )
            time += tau
            depth += tau * (x + tau * (0.5 * b + tau * g / 6.0))
            # in a part shorter than pi, u' changes sign at most once, at an extremum of u
            amplitude = math.sqrt(x * x + c * c)
            parts = int(tau / 3.0) + 1
            before = c
            least, most = min(least, -x), max(most, -x)
            for part in range(1, parts + 1):
                sine, cosine = sincos(tau * part / parts)
                after = c * cosine + x * sine
                if before > 0.0 > after:
                    most = max(most, amplitude)
                elif before < 0.0 < after:
                    least = min(least, -amplitude)
                before = after
        result[0, i], result[1, i], result[2, i] = time, depth / time, 0.5 * k * square / time
        result[3, i], result[4, i] = least, most
    return result


def _row(
    out: np.ndarray, k: float, cut: float, lags: int, resampled: np.ndarray
) -> tuple[Any, ...]:
    """Return the values of _OF_CUTS for one cut."""
    begun = [np.flatnonzero(tau > cut) + 1 for tau in out[:, 1:, 3]]
    fewest = min(impacts.size for impacts in begun)
    if fewest < lags + 2:
        most = np.sort(out[:, 1:, 3])[:, -(lags + 2) :].min()
        raise ValueError(
            f"cuts = {cut!r} is not allowed: it leaves an orbit {fewest} clusters, fewer than "
            f"lags + 2 = {lags + 2}: give a cut below {math.floor(1000.0 * most) / 1000.0:g}, "
            "fewer lags or more impacts"
        )
    first = [chart(k, *row[at, :3].T) for row, at in zip(out, begun, strict=True)]
    periods, lengths = [], []
    for at, tau in zip(begun, out[:, 1:, 3], strict=True):
        periods.append(np.diff(np.cumsum(tau)[at - 1]))
        lengths.append(periods[-1] - tau[at[1:] - 1])
    means = np.array([row.mean() for row in periods])
    error = math.sqrt(float(np.sum((means - means.mean()) ** 2)) / (means.size - 1) / means.size)
    count = float(sum(impacts.size for impacts in begun))
    sizes = [np.diff(at) for at in begun]
    pooled = [np.concatenate(rows).mean() for rows in (sizes, lengths, periods)]
    correlation, dependence = _memory(first, lags, resampled)
    return count, *pooled, error, *correlation, *dependence


def _memory(
    first: Sequence[np.ndarray], lags: int, resampled: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return both measures, each with values and the ends of their intervals, for all lags."""
    cells, correlations, dependences = _cells(first), [], []
    for lag in range(1, lags + 1):
        linear = [_linear_sums(states[:, :-lag], states[:, lag:]) for states in first]
        by_cell = [_cell_sums(c[:-lag], s[:, lag:]) for c, s in zip(cells, first, strict=True)]
        correlations.append(_interval(_correlation, np.array(linear), resampled))
        dependences.append(_interval(_dependence, np.array(by_cell), resampled))
    return np.stack(correlations, axis=1), np.stack(dependences, axis=1)


def _interval(
    measure: Callable[[np.ndarray], np.ndarray], sums: np.ndarray, resampled: np.ndarray
) -> np.ndarray:
    """Return the value, and the ends of the 95 % interval, of a measure of the orbits' sums."""
    drawn = np.sort([measure(sums[orbits].sum(axis=0)) for orbits in resampled], axis=0)
    cut = len(drawn) // 40
    return np.stack([measure(sums.sum(axis=0)), drawn[cut], drawn[len(drawn) - 1 - cut]])


def _linear_sums(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Return the sums of one orbit that the correlation of a (2, n) with b (2, n) needs."""
    count = np.array([a.shape[1]], dtype=float)
    products = [np.sum(a[i] * b[j]) for i in range(2) for j in range(2)]
    squares = [np.sum(row * row, axis=1) for row in (a, b)]
    return np.concatenate([count, a.sum(axis=1), b.sum(axis=1), *squares, products])


def _correlation(sums: np.ndarray) -> np.ndarray:
    """Return Pearson's coefficients (first, then) from the sums of `_linear_sums`."""
    n, mean_a, mean_b = sums[0], sums[1:3] / sums[0], sums[3:5] / sums[0]
    var_a, var_b = sums[5:7] / n - mean_a * mean_a, sums[7:9] / n - mean_b * mean_b
    covariance = sums[9:].reshape(2, 2) / n - mean_a[:, None] * mean_b
    return covariance / np.sqrt(var_a[:, None] * var_b)


def _cells(first: Sequence[np.ndarray]) -> list[np.ndarray]:
    """Return the cell of each state; the bins of a coordinate hold equally many of all states."""
    borders = []
    for coordinate in range(2):
        values = np.sort(np.concatenate([states[coordinate] for states in first]))
        borders.append(values[[i * values.size // _BINS for i in range(1, _BINS)]])
    return [
        np.searchsorted(borders[0], states[0]) * _BINS + np.searchsorted(borders[1], states[1])
        for states in first
    ]


def _cell_sums(cell: np.ndarray, after: np.ndarray) -> np.ndarray:
    """Return count, sums and sums of squares of `after` (2, n) by cell: (cells, 5)."""
    rows = [np.ones(cell.size), *after, *(after * after)]
    sums = [np.bincount(cell, weights=row, minlength=_BINS * _BINS) for row in rows]
    return np.stack(sums, axis=1)


def _dependence(sums: np.ndarray) -> np.ndarray:
    """Return the squared correlation ratio of each coordinate, less what chance would give."""
    sums = sums[sums[:, 0] > 0.0]
    count, total = sums[:, :1], sums.sum(axis=0)
    n = total[0]
    whole = total[3:5] - total[1:3] * total[1:3] / n
    within = np.sum(sums[:, 3:5] - sums[:, 1:3] * sums[:, 1:3] / count, axis=0)
    return 1.0 - (within / (n - sums.shape[0])) / (whole / (n - 1.0))
