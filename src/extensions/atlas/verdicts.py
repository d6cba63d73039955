"""Errors and costs of methods that classify orbits as regular or chaotic.

Cells are drawn over the whole plane of the atlas. The true verdict on an orbit follows from the
growth of a tangent vector over LONG impacts; an orbit whose growth exceeds SURELY_CHAOTIC after
EARLY impacts is chaotic and is followed no further. The methods are:

    growth below 3            after a fixed number of impacts: an earlier rule of the sweeps
    growth, best threshold    after a fixed number of impacts
    SALI                      the smaller alignment index of two tangent vectors (Skokos, J. Phys. A
                              34, 2001); in two dimensions GALI_2 equals it up to a factor
    weighted Birkhoff average of the turns around the fixed point: the difference between the
                              winding numbers of the two halves (Das et al., Nonlinearity 30, 2017)
    as soon as safe           `pseudorigid.dynamics.verdict`, with at most that many impacts

A best threshold gives the fewest wrong verdicts on the first set of cells; the second is unseen.
"""

import math
from concurrent.futures import ThreadPoolExecutor
from itertools import repeat
from typing import Any

import numpy as np
import xarray as xr

from pseudorigid.dynamics import fixed_point
from pseudorigid.dynamics.ensemble import threads
from pseudorigid.dynamics.variables import described, of_rows
from pseudorigid.dynamics.verdict import classify_orbits, means, windows
from pseudorigid.kernel.tangents import CENTRE, SIZE, VECTOR, begin, propagate_with_tangent
from pseudorigid.kernel.verdict import GROWTH_THRESHOLD

from .cell import AXES
from .starts import sunflower_points

LONG, EARLY = 400_000, 20_000  # impacts
SURELY_CHAOTIC = 10 * GROWTH_THRESHOLD  # a regular orbit's growth is about 0.85 at any length
LENGTHS = (250, 500, 1000, 2000, 4000, 8000)  # impacts after which the methods decide
# Name -> quantity of an orbit, and the threshold below which it is regular; None for the best one.
METHODS = {
    "growth below 3": ("growth", 3.0),
    "growth, best threshold": ("growth", None),
    "SALI (two vectors)": ("alignment", None),
    "weighted Birkhoff average": ("unsettled", None),
    "as soon as safe": ("safe", math.nan),
}
SETS = ("cells on which thresholds were chosen", "unseen cells")
K, ENERGY = (0.012, 0.332), (0.1, 40.0)  # ranges of k and E/g^2

Arrays = dict[str, np.ndarray]  # quantity -> its values on orbits, the last dim
_EACH = ("set", "method", "length")
_CELL = {
    "k": (("set", "cell"), *AXES["k"]),
    "energy": (("set", "cell"), *AXES["energy"]),
    "regular": (("set", "cell"), "true share of regular orbits"),
    "exponent": (("set", "cell"), "exponent of the sea from the impacts that all orbits share"),
    "exponent_error": (("set", "cell"), "its standard error"),
    "exponent_long": (("set", "cell"), "exponent of the sea from all impacts that were followed"),
}


def verdicts(cells: int = 36, orbits: int = 128) -> xr.Dataset:
    """Compute errors and costs of the methods on `cells` random cells in each set.

    The orbits of a cell start evenly over its section, as in a sweep. The dataset is on (set,
    method, length) and (set, cell).
    """
    drawn = [cell for number in range(len(SETS)) for cell in random_cells(cells, number)]
    with ThreadPoolExecutor(threads()) as pool:
        results = pool.map(_cell, *zip(*drawn, strict=True), repeat(orbits))
        quantities, rows = zip(*results, strict=True)
    of_sets: Arrays = {}  # ([length,] set, orbit)
    for name in quantities[0]:
        values = np.concatenate([cell[name] for cell in quantities], axis=-1)
        of_sets[name] = values.reshape(*values.shape[:-1], len(SETS), cells * orbits)
    truth, thresholds, errors = of_sets["truth"], [], []
    for quantity, fixed in METHODS.values():
        values, threshold = of_sets[quantity], np.full(len(LENGTHS), fixed, float)
        if fixed is None:
            threshold[:] = [_best_threshold(first, truth[0]) for first, *_ in values]
        regular = values < threshold[:, None, None]
        cost = np.repeat(np.array(LENGTHS, float)[:, None], len(SETS), axis=1)
        if quantity == "safe":
            regular, cost = values, of_sets["followed"].mean(axis=-1)
        shares = [(regular & ~truth).mean(axis=-1), (~regular & truth).mean(axis=-1)]
        errors.append([*shares, cost])
        thresholds.append(threshold)
    missed, alarms, cost = np.transpose(errors, (1, 3, 0, 2))
    variables = {
        "wrong": (_EACH, missed + alarms, "share of wrong verdicts"),
        "missed": (_EACH, missed, "chaotic orbits called regular, share of all"),
        "alarms": (_EACH, alarms, "regular orbits called chaotic, share of all"),
        "cost": (_EACH, cost, "mean number of impacts of an orbit"),
        "threshold": (_EACH[1:], thresholds, "regular is what lies below"),
        "name": ("method", list(METHODS), "how an orbit is judged"),
        "cells": ("set", SETS, "set of cells"),
        "length": ("length", LENGTHS, "largest number of impacts"),
    }
    numbers = np.reshape(rows, (len(SETS), cells, len(_CELL)))
    data = described(variables) | of_rows(_CELL, np.moveaxis(numbers, -1, 1))
    return xr.Dataset(data, attrs={"orbits": orbits, "impacts_of_the_truth": LONG})


def random_cells(count: int, number: int) -> list[tuple[float, float]]:
    """Return (k, E/g^2) of the cells of a set, to six digits; the logarithm of E/g^2 is uniform."""
    random = np.random.default_rng([7, number])
    cells = []
    for _ in range(count):
        k = random.uniform(*K)
        # evenly in the logarithm, by halving: a power would depend on the machine
        low, high = ENERGY
        for half in random.random(40) < 0.5:
            middle = math.sqrt(low * high)
            low, high = (low, middle) if half else (middle, high)
        cells.append((float(f"{k:.6g}"), float(f"{low:.6g}")))
    return cells


def _cell(k: float, e: float, count: int) -> tuple[Arrays, list[Any]]:
    """Return quantities of a cell's orbits, and the values of _CELL.

    The quantities are those by which the methods decide, and the truth.
    """
    x, _, rotation = fixed_point.numbers(k, e)
    states = np.stack(sunflower_points(k, e, count))
    orbits = k, states, np.full(count, x), np.full(count, rotation)
    safe = [classify_orbits(*orbits, length) for length in LENGTHS]
    quantities, exponent_long = _growth_and_truth(*orbits)
    quantities |= {
        "alignment": _alignment(*orbits),
        "safe": np.array([verdicts.regular for verdicts in safe]),
        "followed": np.array([verdicts.followed for verdicts in safe]),
    }
    truth, exponent = quantities["truth"], safe[-1].exponent
    sea = ~truth & ~np.isnan(exponent)
    row = [k, e, np.mean(truth), math.nan, math.nan, math.nan]
    if np.count_nonzero(sea) > 1:
        error = np.std(exponent[sea], ddof=1) / math.sqrt(np.count_nonzero(sea))
        row[3:] = np.mean(exponent[sea]), error, np.mean(exponent_long[sea])
    return quantities, row


def _growth_and_truth(
    k: float, states: np.ndarray, centre: np.ndarray, expected: np.ndarray
) -> tuple[Arrays, np.ndarray]:
    """Return growth and difference of winding numbers after each of LENGTHS, with the truth.

    The exponents of the orbits come second.
    """
    turning, growing = windows((*LENGTHS, EARLY, LONG))
    turning = turning[: 3 * len(LENGTHS)]
    orbits = begin(k, states, centre, expected)
    turned = np.zeros((len(turning), centre.size))
    sums = np.zeros((len(growing), centre.size))
    propagate_with_tangent(orbits, k, 0, EARLY, turning, growing, turned, sums)
    winding, growth = means(turning, growing, turned, sums)
    exponent = orbits[SIZE] / EARLY
    rest = ~(growth[-2] > SURELY_CHAOTIC)  # includes NaN, of orbits with a grazing impact
    truth = np.zeros(centre.size, bool)
    if rest.any():
        orbits, turned, sums = (np.compress(rest, a, 1) for a in (orbits, turned, sums))
        propagate_with_tangent(orbits, k, EARLY, LONG, turning, growing, turned, sums)
        exponent[rest] = orbits[SIZE] / LONG
        truth[rest] = means(turning, growing, turned, sums)[1][-1] < GROWTH_THRESHOLD
    unsettled = np.array([np.abs(a - b) for _, a, b in winding])
    return {"growth": growth[: len(LENGTHS)], "unsettled": unsettled, "truth": truth}, exponent


def _alignment(
    k: float, states: np.ndarray, centre: np.ndarray, expected: np.ndarray
) -> np.ndarray:
    """Return minus SALI of two tangent vectors of the energy surface after each of LENGTHS."""
    first, second = (begin(k, states, centre, expected) for _ in range(2))
    x, v, w = states
    length = np.sqrt(v * v + (k * w) * (k * w))
    # the second vector points up the slope of the kinetic energy, and along x
    second[VECTOR], second[VECTOR + 1] = 1.0, (1.0 - k * x) * v / (length * length)
    second[VECTOR + 2] = (1.0 - k * x) * w * k / (length * length)
    no_windows, no_sums = np.zeros((0, 2), np.int64), np.zeros((0, centre.size))
    alignment, start = [], 0
    for stop in LENGTHS:
        for orbits in (first, second):
            propagate_with_tangent(orbits, k, start, stop, no_windows, no_windows, no_sums, no_sums)
        a, b = (orbits[VECTOR:CENTRE][:3] for orbits in (first, second))
        a, b = (c / np.sqrt((c[0] * c[0] + c[1] * c[1]) + c[2] * c[2]) for c in (a, b))
        gaps = [np.sqrt(np.sum((a + sign * b) ** 2, axis=0)) for sign in (1.0, -1.0)]
        alignment.append(-np.minimum(*gaps))  # low for vectors that point apart: regular
        start = stop
    return np.array(alignment)


def _best_threshold(values: np.ndarray, truth: np.ndarray) -> float:
    """Return the threshold, below which orbits are called regular, with fewest wrong verdicts."""
    order = np.argsort(values, kind="stable")
    values, truth = values[order], truth[order]
    below = np.concatenate([[0], np.cumsum(~truth)])  # chaotic ones called regular
    above = np.sum(truth) - np.concatenate([[0], np.cumsum(truth)])
    at = int(np.argmin(below + above))
    return float(values[min(at, values.size - 1)])
