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

from .sea import ratio, sea_states
from .strains import flight_strains

# Bins of each coordinate, with equal counts: so few that each of the 64 cells of the correlation
# ratio holds many clusters.
_BINS = 8
_IMPACTS_TOGETHER = 2_000_000  # of orbits that are in memory at once: 64 MB
STRAIN = 0.1  # a strain that is not infinitesimal
_LINEAR = "correlation of what begins a cluster with what begins a later one"
_BY_CELL = "share of the variance explained by the cell in which the earlier one began"
_DRIFT = "largest difference of an impact's energy from the start's"
_KINETIC = "mean in time of the kinetic energy, of the centre's motion and of the strain's"
_INTERVAL = {"": "", "_low": ", 95 % interval from", "_high": ", 95 % interval to"}
_OF_CUTS = {
    "count": ("cut", "clusters"),
    "cluster_impacts": ("cut", "mean number of impacts in a cluster"),
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
    ball: Ball, energy: float, orbits: int, impacts: int, cuts: Sequence[float], lags: int,
    resamples: int, seed: int,
) -> xr.Dataset:  # fmt: skip
    """Compute flight times in the sea, clusters for each cut, and the memory between clusters.

    The orbits are the chaotic ones of `orbits` that start evenly over the section (`sea_states`).
    A cluster is compared with the next ones, up to `lags` later. Means of clusters are those of all
    impacts and times over the number of clusters begun (Kac's lemma): means over whole clusters
    alone would be too small, since an orbit's ends cut long ones. ValueError is raised for a cut
    that leaves no orbit lags + 2 clusters.

    >>> from pseudorigid import Ball
    >>> data = clusters(Ball(k=0.2, g=0.04), 0.01, 4, 200, [4, 6], 2, 10, 1)
    >>> data.sizes["cut"]
    2
    """
    states = sea_states(ball, energy, orbits)
    count = states.shape[1]
    # no flight is longer than this
    longest = 2.0 * math.sqrt(2.0 * energy + ball.g * ball.g / ball.k) / ball.g
    edges = 0.1 * np.arange(int(10.0 * longest) + 2)
    flights = np.zeros(edges.size - 1, dtype=np.int64)
    strains, errors, highest = [], [], 0.0
    begun: list[list[tuple[np.ndarray, np.ndarray]]] = [[] for _ in cuts]
    for group in np.array_split(states, -(-count * impacts // _IMPACTS_TOGETHER), axis=1):
        out = np.full((group.shape[1], impacts + 1, 4), math.nan)
        out[:, 0, :3] = np.transpose(group)
        out[:, 1:] = ball.history(group, impacts)
        flights += np.histogram(out[:, 1:, 3], bins=edges)[0]
        strains.append(_strains(out, ball.k, ball.g))
        errors.append(np.max(np.abs(ball.energy(*out.T[:3]) - energy), axis=0))
        for clusters_of_cut, cut in zip(begun, cuts, strict=True):
            clusters_of_cut += [_clusters(row, ball.k, cut) for row in out]
        place = -(lags + 2)
        highest = max(highest, float(np.partition(out[:, 1:, 3], place)[:, place].max()))
    for cut in cuts:
        if not cut < highest:
            raise ValueError(
                f"cuts = {cut!r} is not allowed: no orbit is left lags + 2 = {lags + 2} clusters: "
                f"give a cut below {math.floor(1000.0 * highest) / 1000.0:g}, fewer lags or more "
                "impacts"
            )
    last = int(np.flatnonzero(flights)[-1]) + 1
    time, depth, strain_energy, least, compression, strained = np.concatenate(strains, 1)
    kinetic_energy = (energy + ball.g * depth) - strain_energy
    data = {
        "bin_edge": ("edge", edges[: last + 1], "flight time", TIME),
        "flights": ("bin", flights[:last], "flights of such a time"),
        "time": ("orbit", time, "length of the orbit in time", TIME),
        "strain_energy": ("orbit", strain_energy, "mean in time of the strain energy", ENERGY),
        "kinetic_energy": ("orbit", kinetic_energy, _KINETIC, ENERGY),
        "least_strain": ("orbit", least, "largest compression, as a negative strain"),
        "compression": ("orbit", compression, "mean over flights of the largest compression"),
        "strained": ("orbit", strained, f"share of flights in which |u| exceeds {STRAIN}"),
        "energy_error": ("orbit", np.concatenate(errors), _DRIFT, ENERGY),
        "cut": ("cut", np.asarray(cuts, dtype=float), "flight time that parts two clusters", TIME),
        "lag": ("lag", np.arange(1, lags + 1), "clusters later"),
    }
    resampled = np.random.default_rng(seed).integers(0, count, (resamples, count))
    rows = [_row(clusters_of_cut, lags, resampled) for clusters_of_cut in begun]
    return xr.Dataset(described(data) | of_rows(_OF_CUTS, rows))


@jit
def _strains(out: np.ndarray, k: float, g: float) -> np.ndarray:
    """Return rows of numbers of each orbit: (6, orbits).

    They are the time, the means in time of x and of the strain energy, the least strain, the mean
    over flights of the compression, and the share of flights beyond STRAIN.
    """
    coefficients = kernel.impact_coefficients(k)
    flights = out.shape[1] - 1
    result = np.empty((6, out.shape[0]))
    for i in range(out.shape[0]):
        time, depth, square = 0.0, 0.0, 0.0
        least, compression, strained = 0.0, 0.0, 0.0
        for j in range(flights):
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
            low, high = flight_strains(x, c, tau)
            least = min(least, low)
            compression -= low
            strained += 1.0 if max(-low, high) > STRAIN else 0.0
        result[0, i], result[1, i], result[2, i] = time, depth / time, 0.5 * k * square / time
        result[3, i] = least
        result[4, i], result[5, i] = compression / flights, strained / flights
    return result


def _clusters(out: np.ndarray, k: float, cut: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the first states (2, n) of an orbit's clusters, and sums over the orbit.

    The sums are those of clusters, impacts and times.
    """
    tau = out[1:, 3]
    between = tau > cut
    first = np.array(chart(k, *out[1:][between, :3].T))
    return first, np.array([between.sum(), tau.size, tau.sum()])


def _row(
    begun: Sequence[tuple[np.ndarray, np.ndarray]], lags: int, resampled: np.ndarray
) -> tuple[Any, ...]:
    """Return the values of _OF_CUTS for one cut, from `_clusters` of each orbit."""
    first, sums = zip(*begun, strict=True)
    count, *others = np.transpose(sums)
    size, period = (ratio(values, count) for values in others)
    correlation, dependence = _memory(first, lags, resampled)
    return count.sum(), size[0], *period, *correlation, *dependence


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
