"""Comparisons that measure times or need external solvers. Their data differ between machines.

`bench` also uses `machine`, which describes the machine, and `Call`, the form of its timed calls.
"""

import os
import platform
import time
from collections.abc import Callable, Sequence
from importlib.metadata import version
from pathlib import Path
from typing import NamedTuple

import numpy as np
import xarray as xr

from pseudorigid.dynamics.variables import described

from . import stages, states
from .methods import Method, libraries
from .methods.counted_methods import METHODS, OURS, scan_method
from .states import BALL

PACKAGES = ("numpy", "numba", "scipy", "heyoka", "pynamicalsys")
MIN_SECONDS = 0.02  # of one timing, so that the clock's resolution does not show
# Names of the external solvers that are compared near grazing.
_GRAZING_SOLVERS = (
    "brentq 0.1, 1e-12",
    "RK45, 1e-06",
    "DOP853, 1e-09",
    "DOP853, steps <= 0.1, 1e-12",
    "LSODA, 1e-09",
    "heyoka any, 1e-15",
    "heyoka positive, 1e-15",
)
_GRAZING_METHODS = [OURS, *(m for m in libraries.METHODS if m.name in _GRAZING_SOLVERS)]


def work_all() -> xr.Dataset:
    """Compare error and seconds of all methods, with external solvers."""
    return timed_work([*METHODS, *libraries.METHODS]).assign_attrs(machine())


def edges_all() -> xr.Dataset:
    """Compare external solvers near grazing and near a touch of the floor."""
    return stages.edges(_GRAZING_METHODS, 40, "edges_all").assign_attrs(machine())


def missed_all() -> xr.Dataset:
    """Count the impacts that external solvers miss."""
    return missed(_GRAZING_METHODS).assign_attrs(machine())


def timed_work(methods: Sequence[Method], count: int = 200, repetitions: int = 5) -> xr.Dataset:
    """Compute (method, set): errors and evaluations of any methods, and seconds a flight.

    `count` is the number of states of a set. The seconds are quartiles of interleaved repetitions.
    `stages.work` solves for the errors first, so that a method that compiles does so untimed.
    """
    data = stages.work(methods, count, "work_all")
    sets = [states_of(count) for states_of in stages.SETS.values()]
    seconds = [
        [[_seconds(method, columns) for columns in sets] for method in methods]
        for _ in range(repetitions)
    ]
    low, middle, high = np.quantile(seconds, (0.25, 0.5, 0.75), axis=0)
    dims = data["median"].dims
    variables = {
        "seconds_low": (dims, low, "lower quartile of seconds a flight", "s"),
        "seconds": (dims, middle, "median of seconds a flight", "s"),
        "seconds_high": (dims, high, "upper quartile of seconds a flight", "s"),
    }
    return data.assign(described(variables))


def missed(methods: Sequence[Method], impacts: int = stages.MILLION) -> xr.Dataset:
    """Count the impacts of the certified chaotic orbit that the coarsest scan and each method miss.

    The methods solve only the flights for which a scan with step 0.5 gives a wrong root. The result
    missed (method) is therefore a lower bound of the impacts that a method misses on the orbit.
    """
    columns, certified = stages.certified_orbit(BALL, states.chaotic(), impacts)
    hard = stages.is_wrong(scan_method(0.5, 1e-12).solve(BALL, *columns)[0], certified)
    count = stages.wrong_roots(methods, columns[:, hard]).sum(axis=1)
    variables = {"missed": ("method", count, "impacts missed, of those that scan 0.5 misses")}
    return stages.dataset("missed_all", methods, variables, impacts=impacts, hard=int(hard.sum()))


def _seconds(method: Method, columns: np.ndarray) -> float:
    """Return the seconds of a flight, from repetitions that last for MIN_SECONDS."""
    repetitions, spent, start = 0, 0.0, time.perf_counter()
    while spent <= MIN_SECONDS:
        method.solve(BALL, *columns)
        repetitions += 1
        spent = time.perf_counter() - start
    return spent / (repetitions * columns[0].size)


class Call(NamedTuple):
    """A call that is timed, and the call with which it is compared, if there is one."""

    function: Callable[[], object]
    units: int  # impacts or other units of work that it does
    base: str = ""  # name of the other call
    aim: str = ""  # of the ratio


def machine() -> dict[str, str]:
    """Return the processor, its cores and load, and the versions of packages."""
    return {
        "processor": _processor(),
        "cores": str(os.cpu_count()),
        "load": f"{os.getloadavg()[0]:.1f}",
        "python": platform.python_version(),
        **{name: version(name) for name in PACKAGES},
    }


def _processor() -> str:
    """Return the name of the processor and its widest SIMD instructions."""
    lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    flags = next((line for line in lines if line.startswith(("flags", "Features"))), "")
    simd = "AVX-512" if "avx512f" in flags else "AVX2" if "avx2" in flags else "narrower SIMD"
    return f"{names[0] if names else platform.machine()} ({simd})"
