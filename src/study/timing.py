"""Calls that are timed, and the machine and the versions of packages behind a measurement."""

import os
import platform
from collections.abc import Callable
from importlib.metadata import version
from pathlib import Path
from typing import NamedTuple

PACKAGES = ("numpy", "numba", "scipy", "heyoka", "pynamicalsys")


class Call(NamedTuple):
    """A call that is timed, and the call with which it is compared, if there is one."""

    function: Callable[[], object]
    units: int  # impacts or other units of work that it does
    base: str = ""  # name of the other call
    aim: str = ""  # of the ratio


def machine() -> dict[str, str]:
    """Return the processor, its load and the versions of packages."""
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
