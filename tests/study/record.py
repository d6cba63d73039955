"""Compute what takes long, or differs between machines in the last digits, into recorded.json.

    export PYTHONPATH=src
    .venv/bin/python tests/study/record.py libraries   # the methods of libraries, five minutes
    .venv/bin/python tests/study/record.py search      # states at which methods fail, five minutes
    .venv/bin/python tests/study/record.py flights     # misses among 1e9 flights, half an hour
    .venv/bin/python tests/study/record.py times       # seconds of flights, three minutes

Each was run once, on one core. recorded.json names the processor and the versions of packages, and
tests compute a part of it again.
"""

import json
import sys
import time
from collections.abc import Callable

import numpy as np
import xarray as xr

from pseudorigid.kernel.arithmetic import sincos_each
from pseudorigid.kernel.formulas import impact_coefficients, rebound
from study import measured, stages
from study.measured import machine
from study.methods import libraries
from study.methods.counted_methods import BEST_SCAN, CAREFUL_SCANS, INFLECTIONS, METHODS, OURS
from study.states import BALL

SEARCHED = OURS, INFLECTIONS, BEST_SCAN, *CAREFUL_SCANS[:3], CAREFUL_SCANS[4]
FINEST = [
    m
    for m in libraries.CAREFUL
    if m.name[-5:] in ("1e-12", "1e-15") or m.name == "RK45 with care, 1e-09"
]
USUAL = "RK45, 1e-06", "DOP853, 1e-09", "LSODA, 1e-09", "heyoka, 1e-15"
CAREFUL = tuple(name.replace(",", " with care,") for name in (*USUAL, "CyRK DOP853, 1e-09"))
TRIED = 1_000_000, 100_000, 1_000  # states of each family: methods here, compiled, interpreted
# Of these, at which the march is compared with the proved time; of the last family no more are
# tried, since methods that agree may all be wrong there.
PROVED = 20_000, 20_000, 100_000
COMPILED = "CyRK", "heyoka"
SEA = 10_000, 100_000  # flights of the sea for interpreted methods, and for compiled ones
KEPT = 5  # failing states of each method and family
LONG = 10**9  # flights


def libraries_recorded() -> dict[str, xr.Dataset]:
    """Compare the methods of libraries as `stages.work` and `stages.edges` do the others."""
    methods = libraries.METHODS
    compared = [m for m in methods if m.name in USUAL + CAREFUL]
    flights = [SEA[m.name.startswith(COMPILED)] * (m in compared) for m in methods]
    work = stages.accuracy(methods, 500).assign(stages.missed(methods, flights))
    return {
        "work": work,
        "edges": stages.failures([m for m in compared if m.name[:4] != "CyRK"], 50),
    }


def flights() -> dict[str, xr.Dataset]:
    """Count the misses among a hundred million flights of the sea, and among a thousand million."""
    data = stages.missed_flights((INFLECTIONS, BEST_SCAN, *CAREFUL_SCANS[:5]), LONG)
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


FAMILIES: tuple[Callable[[np.random.Generator, int], np.ndarray], ...] = (
    near_the_rim,
    touches,
    touches_within_rounding,
)


def search() -> dict[str, xr.Dataset]:
    """Draw hard states, and count those at which methods fail.

    The reference solver decides wherever a method differs from the march, and at PROVED states of
    each family in any case. A method passes the impact if its root is later, or missing.
    """
    methods = [*SEARCHED, *FINEST]
    tried, wrong, passed = np.zeros((3, len(methods), len(FAMILIES)), np.int64)
    found = np.full((len(methods), len(FAMILIES), KEPT, 3), np.nan)
    for j, draw in enumerate(FAMILIES):
        count = PROVED[j] if draw is touches_within_rounding else TRIED[0]
        columns = draw(np.random.default_rng([5, j]), count)
        truth = np.full(count, np.nan)  # where it is computed
        for i, method in enumerate(methods):
            slow = not method.name.startswith(COMPILED)
            own = columns[:, : TRIED[0 if i < len(SEARCHED) else 1 + slow]]
            tau = method.solve(BALL, *own)[0]
            if i == 0:
                march = tau
            suspect = stages.is_wrong(tau, march[: tau.size])
            suspect |= ~np.isnan(truth[: tau.size])
            suspect[: PROVED[j] if i == 0 else 0] = True
            new = suspect & np.isnan(truth[: tau.size])
            truth[: tau.size][new] = stages.proved_times(BALL, own[:, new])
            own, tau, true = own[:, suspect], tau[suspect], truth[: tau.size][suspect]
            bad = stages.is_wrong(tau, true)
            tried[i, j], wrong[i, j] = suspect.size, bad.sum()
            passed[i, j] = (bad & ~(tau < true)).sum()
            kept = own[:, bad][:, :KEPT].T
            found[i, j, : len(kept)] = kept
    variables = {
        "tried": (("searched", "drawn"), tried, "states drawn"),
        "failed": (("searched", "drawn"), wrong, "states at which the method fails"),
        "passed": (("searched", "drawn"), passed, "of these, the impact is passed"),
        "found": (("searched", "drawn", "kept", "variable"), found, "some of them: x, xdot, udot"),
        "families": ("drawn", [draw.__name__ for draw in FAMILIES], "how the states are drawn"),
        "searched_name": ("searched", [m.name for m in methods], "method and its settings"),
    }
    return {"search": xr.Dataset(stages.described(variables))}


def times() -> dict[str, xr.Dataset]:
    """Measure the seconds of a flight, of all methods in one run, which needs an idle machine."""
    data = measured.timed_work([*METHODS, *libraries.METHODS], 200, 9)
    data = data[["name", "seconds_low", "seconds", "seconds_high"]].rename(method="timed")
    data = data.rename({name: f"timed_{name}" for name in data})
    return {"times": data.drop_attrs(deep=False)}


def _before(x: np.ndarray, b: np.ndarray, c: np.ndarray) -> np.ndarray:
    """Return the states before impacts after which the velocities are b, c."""
    xdot, udot, _ = rebound(b, c, BALL.k, impact_coefficients(BALL.k))  # the law is an involution
    return np.array([x, xdot, np.maximum(udot, -xdot)])


if __name__ == "__main__":
    parts = {"libraries": libraries_recorded, "search": search, "flights": flights, "times": times}
    start = time.process_time()
    made = parts[sys.argv[1]]()
    done = machine() | {"seconds": str(round(time.process_time() - start))}
    file = stages.RECORDED
    old = json.loads(file.read_text(encoding="utf-8")) if file.exists() else {}
    new = {name: data.assign_attrs(done).to_dict() for name, data in made.items()}
    text = json.dumps(old | new, indent=None, separators=(",", ":")).replace('},"', '},\n"')
    file.write_text(text + "\n", encoding="utf-8")
