"""./reproduce benchmark: ratios of speed, medians of interleaved calls in one run on one core.

No figure depends on them. Seconds are those of the processor, so that other work on the machine
shows less. Calls take turns, so that what slows the machine down slows all of them.
"""

import os
import platform
import statistics
import time
from collections.abc import Callable
from importlib import import_module
from importlib.metadata import version
from pathlib import Path
from typing import NamedTuple

import numpy as np

from pipeline.cli.arguments import Arguments
from pipeline.cli.errors import print_error
from pipeline.declaration import files
from pseudorigid.dynamics.ball import State
from pseudorigid.dynamics.lyapunov import lyapunov_spectrum
from pseudorigid.kernel.arithmetic import sincos
from pseudorigid.kernel.compiled import jit

from .methods import Method, libraries
from .methods import counted_methods as counted
from .stages import certified_orbit
from .states import BALL, ENERGY, chaotic

PACKAGES = ("numpy", "numba", "scipy", "heyoka", "pynamicalsys", "cyrk")
REPETITIONS = 9  # of a call
IMPACTS = 200_000
LANES = 1024  # orbits of an ensemble
UNITS = (1.0, "s"), (1e-3, "ms"), (1e-6, "us"), (1e-9, "ns")
# Two units of speed from one loop: the time of a single sincos in it, and that of three.
ONE, THREE = "one dependent sincos", "three dependent sincos"
ORBIT, SPECTRUM = "one orbit, an impact", "spectrum here"
FLIGHTS = "flights by the march"
BY_MARCH = "one orbit, in this form"
Triple = tuple[float, float, float]


class Call(NamedTuple):
    """A call that is timed, and the call with which it is compared, if there is one."""

    function: Callable[[], object]
    units: int  # impacts or other units of work that it does
    base: str = ""  # name of the other call
    aim: str = ""  # of the ratio


def run(args: Arguments) -> int:
    """Print the table: label, seconds, ratio and aim; then machine and versions.

    The module `bench` of another part adds calls(), and lines(seconds) on them.
    """
    if hasattr(os, "sched_setaffinity"):  # macOS has none
        os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})  # one core: threads gain nothing
    more = [import_module(f"{each}.bench") for each in files("bench.py") if each != __package__]
    timed = calls()
    for module in more:
        timed |= module.calls()
    print_error(f"timing {len(timed)} calls on one core, each {REPETITIONS} times: some minutes")
    seconds = _interleaved(timed)
    lines = [f"{'':42}{'median (lowest-highest)':>30}  {'ratio':>7}  {'to':24}aim"]
    for name, call in timed.items():
        if call.base:
            ratio = f"{seconds[name][0] / seconds[call.base][0]:7.4g}  {call.base:24}{call.aim}"
            lines.append(f"{name:42}{_spread(seconds[name]):>30}  {ratio}")
    lines += [f"{name}: {_spread(seconds[name])}" for name in (THREE, SPECTRUM)]
    for module in more:
        lines += module.lines(seconds)
    print(*lines, ", ".join(f"{key} {value}" for key, value in machine().items()), sep="\n")
    return 0


def calls() -> dict[str, Call]:
    """Return the calls of the table by name."""
    sea, many = chaotic(), BALL.start(0.52 + 0.1 * (np.arange(LANES) / LANES), ENERGY)
    out = np.empty((LANES, 200, 4))  # kept between calls: fresh pages are not the method's cost

    def flights(method: Method, aim: str, count: int = 500, base: str = ORBIT) -> Call:
        """Return the call that solves independent flights of the sea."""
        columns, _ = certified_orbit(BALL, sea, count)
        return Call(lambda: method.solve(BALL, *columns), count, base, aim)

    def of_one_orbit(method: counted.CountedMethod, aim: str, base: str = BY_MARCH) -> Call:
        return Call(lambda: method.orbit(BALL, sea, n), n, base, aim)

    def spectrum(states: State, impacts: int) -> object:
        return lyapunov_spectrum(BALL, states, impacts, records=1)

    cyrk, dop853 = libraries.cyrk_method("DOP853", 1e-9), libraries.ivp_method("DOP853", 1e-9)
    n, of_stored = IMPACTS, LANES * 200
    return {
        THREE: Call(lambda: _three_sincos(1.0, n), n),
        ONE: Call(lambda: _three_sincos(1.0, n), 3 * n),
        ORBIT: Call(lambda: BALL.after(sea, n), n, THREE, "at most 2.3"),
        BY_MARCH: of_one_orbit(counted.OURS, "at most 1.15", ORBIT),
        "one orbit by inflections": of_one_orbit(counted.INFLECTIONS, "0.85 to 1.05"),
        "by inflections, simple": of_one_orbit(counted.SIMPLE_INFLECTIONS, "0.95 to 1.2"),
        "by the scan by rotation": of_one_orbit(counted.ROTATED_SCAN, "0.85 to 1"),
        "by the march by table": of_one_orbit(counted.ROTATED_MARCH, "0.9 to 1.1"),
        "by the best scan, steps of 1": of_one_orbit(counted.BEST_SCAN, "0.9 to 1.1"),
        "by a careful scan, steps of 1": of_one_orbit(counted.careful_method(1.0), "at least 1.3"),
        "usual scan 0.1, bisection to 1e-12": of_one_orbit(counted.SCANS[7], "at least 5"),
        FLIGHTS: flights(counted.OURS, "", 20_000, ""),
        "flights by inflections": flights(counted.INFLECTIONS, "0.85 to 1.05", 20_000, FLIGHTS),
        "heyoka, an orbit in one call (callback)":
            Call(lambda: libraries.taylor_orbit(BALL, sea, n), n, ORBIT, "at least 10"),
        "heyoka, a call a flight (interpreted)":
            flights(libraries.taylor_method(1e-15), "at least 25"),
        "tuned CyRK DOP853, rtol 1e-9": flights(cyrk, "at least 100"),
        "tuned solve_ivp DOP853 (interpreted)": flights(dop853, "at least 2000", 20),
        SPECTRUM: Call(lambda: spectrum(sea, n), n),
        "spectrum by pynamicalsys, an impact":
            Call(lambda: libraries.lyapunov_exponents(BALL, sea, n), n, SPECTRUM, "at least 3"),
        "ensemble, the end only, an impact":
            Call(lambda: BALL.after(many, 200), of_stored, ONE, "at most 1.9"),
        "ensemble, every impact stored":
            Call(lambda: _store(many, out), of_stored, ONE, "at most 1.9"),
        "spectra of an ensemble, an impact":
            Call(lambda: spectrum(many, 192), LANES * 192, SPECTRUM, "at most 0.5"),
    }  # fmt: skip


def _interleaved(timed: dict[str, Call]) -> dict[str, Triple]:
    """Return median, lowest and highest seconds a unit of each call.

    Before this each call is made once, so that it compiles.
    """
    print_error("compiling: each call once")
    for call in timed.values():
        call.function()
    seconds: dict[str, list[float]] = {name: [] for name in timed}
    for i in range(REPETITIONS):
        print_error(f"timing: round {i + 1} of {REPETITIONS}")
        for name, call in timed.items():
            start = time.process_time()
            call.function()
            seconds[name].append((time.process_time() - start) / call.units)
    return {name: (statistics.median(s), min(s), max(s)) for name, s in seconds.items()}


def _spread(seconds: Triple) -> str:
    """Return median, lowest and highest in a suitable unit."""
    size, unit = next((u for u in UNITS if seconds[0] >= u[0]), UNITS[-1])
    middle, low, high = (s / size for s in seconds)
    return f"{middle:.4g} ({low:.4g}-{high:.4g}) {unit}"


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


@jit
def _three_sincos(t: float, count: int) -> float:
    """Compute a chain of 3 x `count` sincos, each of which depends on the one before."""
    total = 0.0
    for _ in range(3 * count):
        sine, cosine = sincos(t)
        t = 1.5 + 0.5 * (sine * cosine)
        total += t
    return total


def _store(start: State, out: np.ndarray) -> None:
    """Advance an ensemble by as many impacts as `out` has room for, and store each of them."""
    x, v, w = (np.array(column) for column in start)
    BALL.map.iterate([x, v, w, np.empty(x.size)], BALL.k, BALL.g, out.shape[1], out)
