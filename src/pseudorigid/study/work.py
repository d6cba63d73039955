"""Work and precision: how far each method's flight times are off, and what they cost.

`counted` compares the methods whose arithmetic is ours, by evaluations of the gap: the same bytes
on every machine. `measured` has all methods, and seconds, side by side in one run.
"""

import time

import numpy as np
import xarray as xr

from ..dynamics.variables import described
from ..proofs import reference_solver
from . import states
from .methods.counted_methods import METHODS

SETS = ("uniform", "near-grazing")
EACH = ("method", "set")  # dims
SPENT = 0.02  # seconds that one timing lasts at least, so that the clock's grain does not show


def counted(count=2000):
    """Median and worst error, share of wrong roots and evaluations of the compiled methods.

    Parameters
    ----------
    count : int
        States a set.

    Returns
    -------
    xarray.Dataset
        On (method, set).
    """
    return _errors(METHODS, _sets(count))


def measured(methods, count=200, repetitions=5):
    """The same of any methods, with the median and quartiles of seconds a flight.

    The repetitions are interleaved: all methods once, then all again. The first `solve` of each,
    which may compile something, is not timed.

    Parameters
    ----------
    methods : sequence
        As described in `methods`.
    count : int
        States a set.
    repetitions : int

    Returns
    -------
    xarray.Dataset
        On (method, set).
    """
    sets = _sets(count)
    data = _errors(methods, sets)
    seconds = [
        [[_seconds(method, columns) for columns, _ in sets] for method in methods]
        for _ in range(repetitions)
    ]
    low, middle, high = np.quantile(seconds, (0.25, 0.5, 0.75), axis=0)
    variables = {
        "seconds_low": (EACH, low, "lower quartile of seconds a flight", "s"),
        "seconds": (EACH, middle, "median of seconds a flight", "s"),
        "seconds_high": (EACH, high, "upper quartile of seconds a flight", "s"),
    }
    return data.assign(described(variables))


def proved_times(ball, columns):
    """The proved flight times (n,) of states (3, n)."""
    return np.array(reference_solver.flight_times(ball, *columns))


def is_wrong(tau, truth):
    """Whether tau is NaN or off by more than a tenth of the flight, or of a time unit.

    It then counts as another root, not as an inaccurate one. Arrays (n,) in and out.
    """
    return ~(np.abs(tau - truth) <= 0.1 * np.minimum(truth, 1.0))


def dataset(methods, variables, **attrs):
    """A Dataset of such variables, with the names and families of methods on `method`."""
    named = {
        "name": ("method", [m.name for m in methods], "method and its settings"),
        "family": ("method", [m.family for m in methods], "methods that differ in one setting"),
    }
    return xr.Dataset(described(named | variables), attrs=attrs)


def _sets(count):
    """(states, proved flight times) of each set."""
    return [
        (columns, proved_times(states.BALL, columns))
        for columns in (states.uniform(count), states.grazing(count))
    ]


def _seconds(method, columns):
    turns, spent, start = 0, 0.0, time.perf_counter()
    while spent <= SPENT:
        method.solve(states.BALL, *columns)
        turns += 1
        spent = time.perf_counter() - start
    return spent / (turns * columns[0].size)


def _errors(methods, sets):
    values = np.array([[_accuracy(method, *each) for each in sets] for method in methods])
    median, worst, wrong, evaluations = np.moveaxis(values, -1, 0)
    variables = {
        "state_set": ("set", SETS, "set of states"),
        "median": (EACH, median, "median relative error of tau"),
        "worst": (EACH, worst, "worst relative error of tau among the right roots"),
        "wrong": (EACH, wrong, "share of wrong roots"),
        "evaluations": (EACH, evaluations, "mean number of evaluations a flight"),
    }
    return dataset(methods, variables, states=sets[0][1].size)


def _accuracy(method, columns, truth):
    """Median and worst error, share of wrong roots, evaluations; no answer is infinitely wrong."""
    tau, count = method.solve(states.BALL, *columns)
    error, wrong = np.abs(tau - truth) / truth, is_wrong(tau, truth)
    median = np.median(np.where(np.isnan(error), np.inf, error))
    return median, error[~wrong].max(initial=0.0), wrong.mean(), count.mean()
