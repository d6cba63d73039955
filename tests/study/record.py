"""Compute what takes long, or differs between machines in the last digits, into recorded.json.

    export PYTHONPATH=src
    .venv/bin/python tests/study/record.py libraries   # the methods of libraries, five minutes
    .venv/bin/python tests/study/record.py flights     # misses among 1e9 flights, half an hour
    .venv/bin/python tests/study/record.py search      # states at which methods fail, five minutes
    .venv/bin/python tests/study/record.py times       # seconds of flights, three minutes

Names of methods after `flights` or `search` record these methods alone, beside the others. Each was
run once, on one core. recorded.json names the processor and the versions of packages, and tests
compute a part of it again.
"""

import json
import math
import sys
import time
from collections.abc import Callable, Sequence

import numpy as np
import xarray as xr

from pseudorigid.dynamics.variables import described
from pseudorigid.kernel.arithmetic import sincos_each
from pseudorigid.kernel.formulas import impact_coefficients, rebound
from study import stages, states
from study.bench import machine
from study.methods import Method, libraries
from study.methods.counted_methods import (
    BEST_SCAN,
    CAREFUL_SCANS,
    INFLECTIONS,
    METHODS,
    OURS,
    ROTATED_MARCH,
    ROTATED_SCAN,
    CountedMethod,
)
from study.states import BALL

USUAL = "RK45, 1e-06", "DOP853, 1e-09", "LSODA, 1e-09", "heyoka, 1e-15"
TUNED = tuple(f"tuned {name}" for name in (*USUAL, "CyRK DOP853, 1e-09"))
COMPILED = "tuned CyRK", "heyoka", "tuned heyoka"
SEA = 10_000, 100_000  # flights of the sea for interpreted methods, and for compiled ones
LONG = 10**9  # flights
HERE = INFLECTIONS, ROTATED_SCAN, ROTATED_MARCH, BEST_SCAN
LONG_METHODS = *HERE, *CAREFUL_SCANS[:5]
FINEST = [
    m for m in libraries.TUNED if m.name[-5:] in ("1e-12", "1e-15") or m.name == "tuned RK45, 1e-09"
]
SEARCHED = OURS, *HERE, *CAREFUL_SCANS[:3], CAREFUL_SCANS[4], *FINEST
TRIED = 1_000_000, 100_000, 1_000  # states of each family: methods here, compiled, interpreted
# Of these, at which the proved time is computed in any case; of the last family no more are tried,
# since methods that agree may all be wrong there.
PROVED = 20_000, 20_000, 100_000
KEPT = 5  # failing states of each method and family


def libraries_recorded() -> dict[str, xr.Dataset]:
    """Compare the methods of libraries as `stages.work` and `stages.edges` do the others."""
    methods = libraries.METHODS
    compared = [m for m in methods if m.name in USUAL + TUNED]
    flights = [SEA[m.name.startswith(COMPILED)] * (m in compared) for m in methods]
    work = stages.accuracy(methods, 500).assign(stages.missed(methods, flights))
    return {
        "work": work,
        "edges": stages.failures([m for m in compared if "CyRK" not in m.name], 50),
    }


def flights(methods: Sequence[Method]) -> dict[str, xr.Dataset]:
    """Count the misses among a hundred million flights of the sea, and among a thousand million."""
    data = stages.missed_flights(methods or LONG_METHODS, LONG)
    data = data.isel(flights=data["flights"].values > 10 * stages.MILLION)
    return {"flights": data.rename({name: f"long_{name}" for name in {*data, *data.dims}})}


def near_the_rim(random: np.random.Generator, count: int) -> np.ndarray:
    """Return states with s, |g + x| and |c| drawn evenly by decade, of any energy."""
    s, off, c = (10.0 ** random.uniform(*ends, count) for ends in ((-7, 0), (-6, -0.3), (-5, -0.3)))
    side, turn = random.choice((-1.0, 1.0), (2, count))
    return _before(-BALL.g + side * off, -s - turn * c, turn * c)


def touches(random: np.random.Generator, count: int) -> np.ndarray:
    """Return states whose gap has a maximum, within 1e-14 to 1e-2 of 0, evenly by decade."""
    return _touching(random, count, -14, -2)


def touches_within_rounding(random: np.random.Generator, count: int) -> np.ndarray:
    """Return states whose gap has a maximum within roundings of 0."""
    return _touching(random, count, -17, -14)


def _touching(random: np.random.Generator, count: int, low: int, high: int) -> np.ndarray:
    """Return states whose gap has a maximum, of a height evenly by decade."""
    x, t = random.uniform(-0.3, 0.3, 9 * count), random.uniform(0.2, 6.0, 9 * count)
    height = random.choice((-1.0, 1.0), t.size) * 10.0 ** random.uniform(low, high, t.size)
    sine, cosine = sincos_each(t)
    slope = -BALL.g * t - x * sine  # as in states.near_miss
    c = (height - 0.5 * BALL.g * t * t - x * (1.0 - cosine) - t * slope) / (sine - t * cosine)
    b = slope - c * cosine
    good = (np.abs(c) < 1.0) & (b + c < 0.0) & (BALL.g + x * cosine - c * sine < 0.0)
    return _before(*(a[good][:count] for a in (x, b, c)))


def _before(x: np.ndarray, b: np.ndarray, c: np.ndarray) -> np.ndarray:
    """Return the states before impacts after which the velocities are b, c."""
    xdot, udot, _ = rebound(b, c, BALL.k, impact_coefficients(BALL.k))  # the law is an involution
    return np.array([x, xdot, np.maximum(udot, -xdot)])


FAMILIES = near_the_rim, touches, touches_within_rounding


def search(methods: Sequence[Method]) -> dict[str, xr.Dataset]:
    """Draw hard states, and count those at which methods fail.

    The reference solver decides wherever a method differs from the march, and at PROVED states of
    each family in any case. A method passes the impact if its root is later, or missing.
    """
    methods = methods or SEARCHED
    tried, wrong, passed = np.zeros((3, len(methods), len(FAMILIES)), np.int64)
    found = np.full((len(methods), len(FAMILIES), KEPT, 3), np.nan)
    for j, draw in enumerate(FAMILIES):
        all_columns = draw(np.random.default_rng([5, j]), PROVED[j] if j == 2 else TRIED[0])
        march, truth = OURS.solve(BALL, *all_columns)[0], np.full(all_columns.shape[1], np.nan)
        truth[: PROVED[j]] = stages.proved_times(BALL, all_columns[:, : PROVED[j]])
        for i, method in enumerate(methods):
            of_library = (1 if method.name.startswith(COMPILED) else 2) * (method in FINEST)
            columns = all_columns[:, : TRIED[of_library]]
            tau, true = method.solve(BALL, *columns)[0], truth[: columns.shape[1]]
            suspect = stages.is_wrong(tau, march[: tau.size]) | ~np.isnan(true)
            new = suspect & np.isnan(true)
            true[new] = stages.proved_times(BALL, columns[:, new])
            bad = suspect & stages.is_wrong(tau, true)
            tried[i, j], wrong[i, j] = suspect.size, bad.sum()
            passed[i, j] = (bad & ~(tau < true)).sum()
            kept = columns[:, bad][:, :KEPT].T
            found[i, j, : len(kept)] = kept
    variables = {
        "tried": (("searched", "drawn"), tried, "states drawn"),
        "failed": (("searched", "drawn"), wrong, "states at which the method fails"),
        "passed": (("searched", "drawn"), passed, "of these, the impact is passed"),
        "found": (("searched", "drawn", "kept", "variable"), found, "some of them: x, xdot, udot"),
        "families": ("drawn", [draw.__name__ for draw in FAMILIES], "how the states are drawn"),
        "searched_name": ("searched", [m.name for m in methods], "method and its settings"),
    }
    return {"search": xr.Dataset(described(variables))}


def times(repetitions: int = 9) -> dict[str, xr.Dataset]:
    """Measure the time of a flight of all methods in one run, which needs an idle machine.

    Times are divided by the march's in the same repetition. `timed_orbit` is that of an impact of
    one orbit in the sea, by methods in this package's arithmetic. Medians have their quartiles.
    """
    methods = [*METHODS, *libraries.METHODS]
    calls = [
        [_flights(method, states_of) for states_of in stages.SETS.values()] for method in methods
    ]
    orbits = [_orbit(method) for method in methods]
    flights = np.empty((repetitions, len(methods), len(stages.SETS)))
    orbit = np.empty((repetitions, len(methods)))
    for i in range(-1, repetitions):  # the first repetition compiles
        # The march once more at first: after a library's calls it takes an eighth longer.
        for j in (0, *range(len(methods))):
            flights[i, j] = [_seconds(*call) for call in calls[j]]
            orbit[i, j] = _seconds(*orbits[j])
    variables = {"timed_name": ("timed", [m.name for m in methods], "method and its settings")}
    for part, dims, seconds in (("", ("timed", "set"), flights), ("_orbit", ("timed",), orbit)):
        low, middle, high = np.quantile(seconds / seconds[:, :1], (0.25, 0.5, 0.75), axis=0)
        for end, values in (("_low", low), ("", middle), ("_high", high)):
            text = {"": "median", "_low": "lower quartile", "_high": "upper quartile"}[end]
            of = "an impact of one orbit" if part else "a flight"
            name = f"timed{part or '_flight'}{end}"
            variables[name] = dims, values, f"{text} of the time of {of}, the march's being 1"
    return {"times": xr.Dataset(described(variables))}


Timed = tuple[Callable[[], object], int]  # a call, and the flights in it


def _flights(method: Method, states_of: Callable[[int], np.ndarray]) -> Timed:
    """Return the call that solves independent flights, so many that no branch is learnt."""
    is_here = isinstance(method, CountedMethod)
    columns = states_of(20_000 if is_here else 200)
    return lambda: method.solve(BALL, *columns), columns.shape[1]


def _orbit(method: Method) -> Timed:
    """Return the call that follows one orbit, none for a method of another package."""
    if not isinstance(method, CountedMethod):
        return (lambda: None), 0
    return lambda: method.orbit(BALL, states.chaotic(), 100_000), 100_000


def _seconds(function: Callable[[], object], flights: int) -> float:
    """Return the seconds of a flight."""
    start = time.process_time()
    function()
    return (time.process_time() - start) / flights if flights else math.nan


def beside(old: xr.Dataset, new: xr.Dataset, dim: str, names: str) -> xr.Dataset:
    """Return recorded methods on `dim`, named by `names`; new ones replace old ones."""
    kept = old.isel({dim: ~old[names].isin(new[names])})
    return xr.concat([kept, new], dim, data_vars="minimal", combine_attrs="override")


if __name__ == "__main__":
    part, *names = sys.argv[1:]
    chosen = [method for method in SEARCHED + LONG_METHODS if method.name in names]
    start = time.process_time()
    of_methods = {"flights": ("long_method", "long_name"), "search": ("searched", "searched_name")}
    if part in of_methods:
        made = {"flights": flights, "search": search}[part](
            list({m.name: m for m in chosen}.values())
        )
    else:
        made = {"libraries": libraries_recorded, "times": times}[part]()
    done = machine() | {"seconds": str(round(time.process_time() - start))}
    file = stages.RECORDED
    old = json.loads(file.read_text(encoding="utf-8")) if file.exists() else {}
    if names:
        made = {part: beside(xr.Dataset.from_dict(old[part]), made[part], *of_methods[part])}
    new = {name: data.assign_attrs(done).to_dict() for name, data in made.items()}
    text = json.dumps(old | new, indent=None, separators=(",", ":")).replace('},"', '},\n"')
    file.write_text(text + "\n", encoding="utf-8")
