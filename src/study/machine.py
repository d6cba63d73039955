"""The machine and the versions of packages behind a measurement."""

import os
import platform
from importlib.metadata import version
from pathlib import Path

PACKAGES = ("numpy", "numba", "scipy", "heyoka", "pynamicalsys")


def machine() -> dict[str, str]:
    """Return the processor, its load and the versions of packages."""
    facts = {"processor": _processor(), "cores": str(os.cpu_count())}
    facts |= {"load": f"{os.getloadavg()[0]:.1f}", "python": platform.python_version()}
    return facts | {name: version(name) for name in PACKAGES}


def _processor() -> str:
    lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    flags = next((line for line in lines if line.startswith(("flags", "Features"))), "")
    simd = "AVX-512" if "avx512f" in flags else "AVX2" if "avx2" in flags else "narrower SIMD"
    return f"{names[0] if names else platform.machine()} ({simd})"
