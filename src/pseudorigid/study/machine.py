"""The machine and the versions behind a measurement."""

import os
import platform
from importlib.metadata import version

PACKAGES = ("numpy", "numba", "scipy", "heyoka", "pynamicalsys")


def machine():
    """The processor, its load and the versions, as a dict of texts."""
    return {
        "processor": _processor(),
        "cores": str(os.cpu_count()),
        "load": f"{os.getloadavg()[0]:.1f}",
        "python": platform.python_version(),
    } | {name: version(name) for name in PACKAGES}


def _processor():
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            lines = file.read().splitlines()
    except OSError:
        return platform.processor() or platform.machine()
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    flags = next((line for line in lines if line.startswith(("flags", "Features"))), "")
    wide = "AVX-512" if "avx512f" in flags else "AVX2" if "avx2" in flags else "narrower SIMD"
    return f"{names[0] if names else platform.machine()} ({wide})"
