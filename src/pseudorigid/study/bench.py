"""Ratios of speed: medians of repetitions taken in turn, in one run.

`run` returns rows of text; nothing here enters a figure. One core throughout.
"""

import os
import platform
import statistics
import time
from functools import cache
from importlib.metadata import version

import numpy as np

from ..dynamics.lyapunov import lyapunov_spectrum
from ..kernel.arithmetic import sincos
from ..kernel.compiled import jit
from . import states
from .methods import counted as own
from .methods import scipy_events, taylor, toolkit

REPETITIONS = 9
IMPACTS = 200_000
LANES = 1024
PACKAGES = ("numpy", "numba", "scipy", "heyoka", "pynamicalsys")


@jit
def _three_sincos(t, count):
    """A chain of 3 x `count` sincos, each waiting for the one before."""
    total = 0.0
    for _ in range(3 * count):
        sine, cosine = sincos(t)
        t = 1.5 + 0.5 * (sine * cosine)
        total += t
    return total


def timed(call):
    """Seconds that a call takes."""
    start = time.perf_counter()
    call()
    return time.perf_counter() - start


def interleaved(calls, repetitions=REPETITIONS):
    """(median, lowest, highest) of seconds for each named call, all once before any again."""
    for call in calls.values():
        call()  # compiles, and warms the caches
    seconds = {name: [] for name in calls}
    for _ in range(repetitions):
        for name, call in calls.items():
            seconds[name].append(timed(call))
    return {name: (statistics.median(s), min(s), max(s)) for name, s in seconds.items()}


def run(repetitions=REPETITIONS):
    """The table as lines: what, nanoseconds, ratio; then the machine and the versions."""
    ball = states.BALL
    chaotic = states.chaotic()
    few = _along(chaotic, 20)
    some = _along(chaotic, 500)
    scan = own.scan_method(0.1, 1e-12)
    dop = scipy_events.ivp_method("DOP853", 1e-9)
    hey = taylor.taylor_method(1e-15, "positive")
    calls = {
        "three sincos": (lambda: _three_sincos(1.0, IMPACTS), IMPACTS),
        "orbit": (lambda: _orbit(chaotic, IMPACTS), IMPACTS),
        "scan": (lambda: scan.solve(ball, *some), 500),
        "heyoka": (lambda: hey.solve(ball, *some), 500),
        "DOP853": (lambda: dop.solve(ball, *few), 20),
        "spectrum": (lambda: lyapunov_spectrum(ball, chaotic, IMPACTS, records=1), IMPACTS),
        "pynamicalsys": (lambda: toolkit.spectrum(ball, chaotic, IMPACTS), IMPACTS),
        "ensemble": (lambda: _ensemble(LANES, 200), 200 * LANES),
        "stored": (lambda: _stored(LANES, 200), 200 * LANES),
    }
    found = interleaved({name: call for name, (call, _) in calls.items()}, repetitions)
    each = {name: tuple(1e9 * s / calls[name][1] for s in found[name]) for name in calls}
    rows = [
        ("one orbit, an impact", "orbit", "three sincos", "three dependent sincos", "at most 2.3"),
        ("scan 0.1 and bisection to 1e-12", "scan", "orbit", "one orbit", "at least 5"),
        ("heyoka, default tolerance", "heyoka", "orbit", "one orbit", "at least 25"),
        ("solve_ivp DOP853, rtol 1e-9", "DOP853", "orbit", "one orbit", "at least 2000"),
        ("spectrum by pynamicalsys", "pynamicalsys", "spectrum", "spectrum here", "at least 3"),
        (
            "ensemble, the end only",
            "ensemble",
            "three sincos",
            "one dependent sincos",
            "at most 1.2",
        ),
        (
            "ensemble, every impact stored",
            "stored",
            "three sincos",
            "one dependent sincos",
            "at most 1.6",
        ),
    ]
    lines = [f"{'':34}{'ns an impact':>24}  {'ratio':>9}  {'to':24}aim"]
    for text, name, base, base_text, aim in rows:
        per = 3.0 if base_text.startswith("one dependent") else 1.0
        ratio = each[name][0] / (each[base][0] / per)
        middle, low, high = each[name]
        spread = f"{middle:.4g} ({low:.4g}-{high:.4g})"
        lines.append(f"{text:34}{spread:>24}  {ratio:9.4g}  {base_text:24}{aim}")
    chain, spectrum = each["three sincos"][0], each["spectrum"][0]
    lines.append(f"three dependent sincos: {chain:.1f} ns; spectrum here: {spectrum:.0f} ns")
    lines.append(", ".join(f"{key} {value}" for key, value in machine().items()))
    return lines


def machine():
    """The machine and the versions behind a measurement."""
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


def _orbit(state, impacts):
    x, v, w = (np.array([a]) for a in state)
    states.BALL.map.steps(x, v, w, states.BALL.k, states.BALL.g, impacts, np.empty(1))


def _ensemble(lanes, impacts):
    x, v, w = _many(lanes)
    states.BALL.map.steps(x, v, w, states.BALL.k, states.BALL.g, impacts, np.empty(lanes))


def _stored(lanes, impacts):
    x, v, w = _many(lanes)
    states.BALL.map.history(x, v, w, states.BALL.k, states.BALL.g, _room(lanes, impacts))


@cache
def _room(lanes, impacts):
    """Memory for a history, kept between calls: fresh pages are not the method's cost."""
    return np.empty((lanes, impacts, 4))


def _many(lanes):
    """Chaotic states, in arrays that may be written into."""
    return tuple(np.array(a) for a in _start(lanes))


@cache
def _start(lanes):
    return states.BALL.start(0.52 + 0.1 * (np.arange(lanes) / lanes), states.ENERGY)


def _along(state, count):
    """The first `count` states of an orbit, as columns."""
    out = np.empty((1, count, 4))
    columns = (np.array([float(a)]) for a in state)
    states.BALL.map.history(*columns, states.BALL.k, states.BALL.g, out)
    return tuple(a.copy() for a in out[0].T[:3])


def on_one_core():
    """Keep this process on one core: whatever starts threads gains nothing by them."""
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})


if __name__ == "__main__":
    on_one_core()
    print("\n".join(run()))
