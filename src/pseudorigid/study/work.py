"""Work and precision: how far each method's flight times are off, and what they cost.

`counted` compares the methods whose arithmetic is ours, by evaluations of the gap: the same bytes
on every machine. `measured` has all methods, and seconds, side by side in one run.
"""

import time

import numpy as np
import xarray as xr

from ..proofs import judge
from . import states
from .methods import counted as own

SETS = ("uniform", "near-grazing")
SPENT = 0.02  # seconds that one timing lasts at least, so that the clock's grain does not show


def counted(count=2000):
    """Dataset (method, set) of the compiled methods over `count` states a set; see `_errors`."""
    return _errors(own.METHODS, _sets(count))


def measured(methods, count=200, repetitions=5):
    """The same of any methods, with the median and quartiles of seconds a flight.

    The repetitions are interleaved: all methods once, then all again. The first `solve` of each,
    which may compile something, is not timed.
    """
    sets = _sets(count)
    data = _errors(methods, sets)
    seconds = np.empty((repetitions, len(methods), len(sets)))
    for repetition in range(repetitions):
        for j, (columns, _) in enumerate(sets):
            for i, method in enumerate(methods):
                seconds[repetition, i, j] = _seconds(method, columns)
    quartiles = np.quantile(seconds, (0.25, 0.5, 0.75), axis=0)
    for name, values in zip(("seconds_low", "seconds", "seconds_high"), quartiles, strict=True):
        attributes = {"long_name": f"{name.replace('_', ', ')} quartile", "units": "1"}
        if name == "seconds":
            attributes["long_name"] = "median of seconds a flight"
        data[name] = (("method", "set"), values, attributes)
    return data


def _sets(count):
    found = []
    for columns in (states.uniform(count), states.grazing(count)):
        truth = np.array(judge.flight_times(states.BALL, *columns))
        found.append((columns, truth))
    return found


def _seconds(method, columns):
    turns = 0
    start = time.perf_counter()
    while True:
        method.solve(states.BALL, *columns)
        turns += 1
        spent = time.perf_counter() - start
        if spent > SPENT:
            return spent / (turns * columns[0].size)


def is_wrong(tau, truth):
    """Whether tau is off by more than a tenth of the flight or of a time unit, or NaN."""
    return ~(np.abs(tau - truth) <= 0.1 * np.minimum(truth, 1.0))


def _errors(methods, sets):
    shape = len(methods), len(sets)
    median, worst, wrong, evaluations = (np.full(shape, np.nan) for _ in range(4))
    for j, (columns, truth) in enumerate(sets):
        for i, method in enumerate(methods):
            tau, count = method.solve(states.BALL, *columns)
            error = np.abs(tau - truth) / truth
            bad = is_wrong(tau, truth)
            wrong[i, j] = bad.mean()
            evaluations[i, j] = count.mean()
            median[i, j] = np.median(np.where(np.isnan(error), np.inf, error))
            worst[i, j] = error[~bad].max(initial=0.0)
    names = {
        "median": (median, "median relative error of tau"),
        "worst": (worst, "worst relative error of tau among the right roots"),
        "wrong": (wrong, "share of wrong roots"),
        "evaluations": (evaluations, "mean number of evaluations a flight"),
    }
    data = {
        name: (("method", "set"), values, {"long_name": text, "units": "1"})
        for name, (values, text) in names.items()
    }
    data |= named(methods)
    data["state_set"] = ("set", np.array(SETS, dtype=object), {"long_name": "set of states"})
    return xr.Dataset(data, attrs={"states": sets[0][1].size})


def named(methods):
    """The names and families of methods as variables on `method`."""
    return {
        "name": (
            "method",
            np.array([method.name for method in methods], dtype=object),
            {"long_name": "method and its settings"},
        ),
        "family": (
            "method",
            np.array([method.family for method in methods], dtype=object),
            {"long_name": "methods that differ in one setting"},
        ),
    }
