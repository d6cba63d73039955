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

from pseudorigid.dynamics.variables import variables

from . import stages
from .methods import Method, libraries
from .methods.counted_methods import METHODS
from .states import BALL

PACKAGES = ("numpy", "numba", "scipy", "heyoka", "pynamicalsys", "cyrk")
MIN_SECONDS = 0.02  # of one timing, so that the clock's resolution does not show


def work_all() -> xr.Dataset:
    """Compare error and seconds of all methods, with external solvers."""
    return timed_work([*METHODS, *libraries.METHODS]).assign_attrs(machine())


def timed_work(methods: Sequence[Method], count: int = 200, repetitions: int = 5) -> xr.Dataset:
    """Compute (method, set): errors and evaluations of any methods, and seconds a flight.

    `count` is the number of states of a set. The seconds are quartiles of interleaved repetitions.
    `stages.accuracy` solves for the errors first, so that a method that compiles does so untimed.
    """
    data = stages.accuracy(methods, count, "work_all")
    sets = [states_of(count) for states_of in stages.SETS.values()]
    seconds = [
        [[_seconds(method, columns) for columns in sets] for method in methods]
        for _ in range(repetitions)
    ]
    quartiles = np.quantile(seconds, (0.25, 0.5, 0.75), axis=0)
    names = {"seconds_low": "lower quartile", "seconds": "median", "seconds_high": "upper quartile"}
    texts = {name: (f"{text} of seconds a flight", "s") for name, text in names.items()}
    return data.assign(variables(data["median"].dims, quartiles, texts))


def _seconds(method: Method, columns: np.ndarray) -> float:
    """Return the seconds of a flight, from repetitions that last for MIN_SECONDS."""
    repetitions, spent, start = 0, 0.0, time.process_time()
    while spent <= MIN_SECONDS:
        method.solve(BALL, *columns)
        repetitions += 1
        spent = time.process_time() - start
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
    known = Path("/proc/cpuinfo")  # Linux has it
    lines = known.read_text(encoding="utf-8").splitlines() if known.exists() else []
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    flags = next((line for line in lines if line.startswith(("flags", "Features"))), "")
    simd = "AVX-512" if "avx512f" in flags else "AVX2" if "avx2" in flags else "narrower SIMD"
    return f"{names[0] if names else platform.machine()} ({simd})"
