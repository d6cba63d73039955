"""Ratios of speed: medians of interleaved repetitions, in one run on one core.

`run` returns lines of text for `./reproduce benchmark`; no figure depends on them. Seconds are
those of the processor, so that other work on the machine shows less. Calls take turns, so that what
slows the machine down slows all of them.
"""

import os
import statistics
import sys
import time
from collections.abc import Callable
from functools import partial
from importlib import import_module
from types import ModuleType

import numpy as np

from pseudorigid.dynamics import branch as branch_rule
from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.lyapunov import lyapunov_spectrum
from pseudorigid.dynamics.manifolds import trace_manifold
from pseudorigid.dynamics.periodic import symmetric_orbits
from pseudorigid.dynamics.variables import of_type
from pseudorigid.kernel.arithmetic import sincos
from pseudorigid.kernel.compiled import jit
from pseudorigid.kernel.tangents import begin, propagate_with_tangent

from . import states
from .failures import certified_orbit
from .machine import machine
from .methods import pynamicalsys_lyapunov, scipy_events, taylor
from .methods.counted_methods import scan_method

REPETITIONS = 9
IMPACTS = 200_000
LANES = 1024  # orbits of an ensemble
WEAK_SADDLE_ENERGY = 0.001  # of a saddle of period 10 with a small multiplier
MANY = 1e5  # E/g^2 with many orbits of period 12
UNITS = (1.0, "s"), (1e-3, "ms"), (1e-6, "us"), (1e-9, "ns")
BASES = {
    "one sincos": "one dependent sincos",
    "three sincos": "three dependent sincos",
    "orbit": "one orbit",
    "spectrum": "spectrum here",
    "branch": "that branch here",
    "none": "a search finding none",
}
# row label, name of the call, name of the call it is compared with, aim
ROWS = (
    ("one orbit, an impact", "orbit", "three sincos", "at most 2.3"),
    ("scan 0.1 and bisection to 1e-12", "scan", "orbit", "at least 5"),
    ("heyoka, default tolerance", "heyoka", "orbit", "at least 25"),
    ("solve_ivp DOP853, rtol 1e-9", "DOP853", "orbit", "at least 2000"),
    ("spectrum by pynamicalsys, an impact", "pynamicalsys", "spectrum", "at least 3"),
    ("ensemble, the end only, an impact", "ensemble", "one sincos", "at most 1.2"),
    ("ensemble, every impact stored", "stored", "one sincos", "at most 1.6"),
    ("ensemble with a tangent vector each", "vectors", "one sincos", "at most 3; 5 with AVX2"),
    ("spectra of an ensemble, an impact", "spectra", "spectrum", "at most 0.5"),
    ("weak branch, each image from the segment", "from the segment", "branch", "at least 5"),
    ("period 12 at E/g^2 = 1e5: 2,006 orbits", "many", "none", "at most 50"),
)


@jit
def _three_sincos(t, count):
    """Compute a chain of 3 x `count` sincos, each of which depends on the one before."""
    total = 0.0
    for _ in range(3 * count):
        sine, cosine = sincos(t)
        t = 1.5 + 0.5 * (sine * cosine)
        total += t
    return total


def run(repetitions: int = REPETITIONS, more: tuple[ModuleType, ...] = ()) -> list[str]:
    """Return the table's lines: label, seconds, ratio and aim; then machine and versions.

    Each module of `more` adds ROWS and BASES like those here, calls, and lines on their seconds.
    """
    ball = states.BALL
    chaotic = states.chaotic()
    states_20, states_500 = (certified_orbit(ball, chaotic, count)[0] for count in (20, 500))
    ensemble = ball.start(0.52 + 0.1 * (np.arange(LANES) / LANES), states.ENERGY)
    nothing = np.empty((LANES, 0, 4))
    out = np.empty((LANES, 200, 4))  # kept between calls: fresh pages are not the method's cost
    scan = scan_method(0.1, 1e-12)
    dop853 = scipy_events.ivp_method("DOP853", 1e-9)
    heyoka = taylor.taylor_method(1e-15, "positive")
    calls = {  # name: (call, number of impacts or other units that it does)
        "three sincos": (partial(_three_sincos, 1.0, IMPACTS), IMPACTS),
        "orbit": (partial(_advance, chaotic, IMPACTS, nothing), IMPACTS),
        "scan": (partial(scan.solve, ball, *states_500), 500),
        "heyoka": (partial(heyoka.solve, ball, *states_500), 500),
        "DOP853": (partial(dop853.solve, ball, *states_20), 20),
        "spectrum": (partial(lyapunov_spectrum, ball, chaotic, IMPACTS, records=1), IMPACTS),
        "pynamicalsys": (partial(pynamicalsys_lyapunov.spectrum, ball, chaotic, IMPACTS), IMPACTS),
        "ensemble": (partial(_advance, ensemble, 200, nothing), 200 * LANES),
        "stored": (partial(_advance, ensemble, 200, out), 200 * LANES),
        "vectors": (partial(_with_tangent, ensemble, 192), 192 * LANES),
        "spectra": (partial(lyapunov_spectrum, ball, ensemble, 192, records=1), 192 * LANES),
    } | _branches_and_searches()
    rows, bases = list(ROWS), dict(BASES)
    for module in more:
        calls |= module.calls()
        rows += module.ROWS
        bases |= module.BASES
    each = _interleaved(calls, repetitions)
    each["one sincos"] = tuple(s / 3.0 for s in each["three sincos"])
    lines = [f"{'':42}{'median (lowest-highest)':>30}  {'ratio':>7}  {'to':24}aim"]
    for text, name, base, aim in rows:
        ratio = each[name][0] / each[base][0]
        lines.append(f"{text:42}{_spread(each[name]):>30}  {ratio:7.4g}  {bases[base]:24}{aim}")
    for name in ("three sincos", "spectrum"):
        lines.append(f"{BASES[name]}: {_spread(each[name])}")
    for module in more:
        lines += module.lines(each)
    lines.append(", ".join(f"{key} {value}" for key, value in machine().items()))
    return lines


def _interleaved(calls: dict, repetitions: int) -> dict[str, tuple[float, float, float]]:
    """Return median, lowest and highest seconds a unit of each call, after one that compiles it."""
    for call, _ in calls.values():
        call()
    seconds = {name: [] for name in calls}
    for _ in range(repetitions):
        for name, (call, units) in calls.items():
            begin = time.process_time()
            call()
            seconds[name].append((time.process_time() - begin) / units)
    return {name: (statistics.median(s), min(s), max(s)) for name, s in seconds.items()}


def _branches_and_searches() -> dict[str, tuple[Callable, int]]:
    """Return calls that compute branches and periodic orbits, with numbers of units."""
    saddle = of_type(symmetric_orbits(states.BALL, WEAK_SADDLE_ENERGY, 10), "hyperbolic")
    branch = partial(trace_manifold, states.BALL, WEAK_SADDLE_ENERGY, saddle, length=0.5)
    ball = Ball(k=states.BALL.k, g=1.0)

    def from_the_segment():
        usual, branch_rule.WEAK = branch_rule.WEAK, 0.0
        try:
            branch()
        finally:
            branch_rule.WEAK = usual

    return {
        "branch": (branch, 1),
        "from the segment": (from_the_segment, 1),
        "many": (partial(symmetric_orbits, ball, MANY, 12), 1),
        "none": (partial(symmetric_orbits, ball, 6.25, 12), 1),
    }


def _spread(seconds: tuple[float, float, float]) -> str:
    """Return median, lowest and highest in a suitable unit."""
    size, unit = next((u for u in UNITS if seconds[0] >= u[0]), UNITS[-1])
    middle, low, high = (s / size for s in seconds)
    return f"{middle:.4g} ({low:.4g}-{high:.4g}) {unit}"


def _advance(start, impacts: int, out: np.ndarray) -> None:
    """Advance states; `out` receives every impact, unless it is empty."""
    ball, columns = states.BALL, [np.array(a, ndmin=1) for a in start]
    ball.map.steps([*columns, np.empty(columns[0].size)], ball.k, ball.g, impacts, out)


def _with_tangent(start, impacts: int) -> None:
    """Follow an ensemble with a tangent vector for each orbit."""
    ball, lanes = states.BALL, start[0].size
    orbits = begin(ball.k, [a / ball.g for a in start], 0.0, 0.0)
    windows, sums = np.zeros((0, 2), np.int64), np.zeros((0, lanes))
    propagate_with_tangent(orbits, ball.k, 0, impacts, windows, windows, sums, sums)


if __name__ == "__main__":
    os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})  # one core: threads gain nothing
    print("\n".join(run(more=tuple(map(import_module, sys.argv[1:])))))
