"""Work and precision: the errors of each method's flight times, and their cost.

`counted` compares the methods in this package's arithmetic by evaluations of the gap, with the same
bytes on every machine. `measured` compares any methods, also by seconds, in one run.
"""

import time
from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr

from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.variables import described

from . import reference_solver, states
from .methods import Method
from .methods.counted_methods import METHODS

SETS = {"uniform": states.uniform, "near-grazing": states.grazing}
DIMS = ("method", "set")
MIN_SECONDS = 0.02  # of one timing, so that the clock's resolution does not show


def counted(count: int = 2000) -> xr.Dataset:
    """Compute (method, set): errors and evaluations of this package's methods."""
    return _errors(METHODS, [states_of(count) for states_of in SETS.values()])


def measured(methods: Sequence[Method], count: int = 200, repetitions: int = 5) -> xr.Dataset:
    """Compute (method, set): errors and evaluations of any methods, and seconds a flight.

    The repetitions are interleaved. The first `solve` of each method, which may compile something,
    is not timed.
    """
    sets = [states_of(count) for states_of in SETS.values()]
    data = _errors(methods, sets)
    seconds = [
        [[_seconds(method, columns) for columns in sets] for method in methods]
        for _ in range(repetitions)
    ]
    low, middle, high = np.quantile(seconds, (0.25, 0.5, 0.75), axis=0)
    variables = {
        "seconds_low": (DIMS, low, "lower quartile of seconds a flight", "s"),
        "seconds": (DIMS, middle, "median of seconds a flight", "s"),
        "seconds_high": (DIMS, high, "upper quartile of seconds a flight", "s"),
    }
    return data.assign(described(variables))


def proved_times(ball: Ball, columns: np.ndarray) -> np.ndarray:
    """Return the proved flight times (n,) of states (3, n), rounded to doubles."""
    times = (reference_solver.first_root(ball.k, ball.g, *state) for state in columns.T.tolist())
    return np.array([float(tau) for tau in times])


def is_wrong(tau: np.ndarray, truth: np.ndarray) -> np.ndarray:
    """Return which tau are NaN or off by more than a tenth of the flight, or of a time unit.

    Such a tau counts as another root, not as an inaccurate one.
    """
    return ~(np.abs(tau - truth) <= 0.1 * np.minimum(truth, 1.0))


def dataset(
    methods: Sequence[Method], variables: dict[str, tuple[Any, ...]], **attrs: float
) -> xr.Dataset:
    """Return a dataset of `variables`, with the names and families of methods on `method`."""
    names = {
        "name": ("method", [m.name for m in methods], "method and its settings"),
        "family": ("method", [m.family for m in methods], "methods that differ in one setting"),
    }
    return xr.Dataset(described(names | variables), attrs=attrs)


def _seconds(method: Method, columns: np.ndarray) -> float:
    """Return the seconds of a flight, from repetitions that last for MIN_SECONDS."""
    repetitions, spent, start = 0, 0.0, time.perf_counter()
    while spent <= MIN_SECONDS:
        method.solve(states.BALL, *columns)
        repetitions += 1
        spent = time.perf_counter() - start
    return spent / (repetitions * columns[0].size)


def _errors(methods: Sequence[Method], sets: Sequence[np.ndarray]) -> xr.Dataset:
    """Return the dataset (method, set) of errors and evaluations on sets of states (3, n)."""
    pairs = [(columns, proved_times(states.BALL, columns)) for columns in sets]
    values = np.array([[_accuracy(method, *pair) for pair in pairs] for method in methods])
    median, worst, wrong, evaluations = np.moveaxis(values, -1, 0)
    variables = {
        "state_set": ("set", list(SETS), "set of states"),
        "median": (DIMS, median, "median relative error of tau"),
        "worst": (DIMS, worst, "worst relative error of tau among the right roots"),
        "wrong": (DIMS, wrong, "share of wrong roots"),
        "evaluations": (DIMS, evaluations, "mean number of evaluations a flight"),
    }
    return dataset(methods, variables, states=sets[0].shape[1])


def _accuracy(method: Method, columns: np.ndarray, truth: np.ndarray) -> tuple[float, ...]:
    """Return median and worst error, share of wrong roots and evaluations; NaN errs infinitely."""
    tau, count = method.solve(states.BALL, *columns)
    error, wrong = np.abs(tau - truth) / truth, is_wrong(tau, truth)
    median = np.median(np.where(np.isnan(error), np.inf, error))
    return median, error[~wrong].max(initial=0.0), wrong.mean(), count.mean()
