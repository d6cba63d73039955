"""Compute what takes long, or differs between machines in the last digits, into recorded.json.

    export PYTHONPATH=src
    .venv/bin/python tests/study/record.py libraries   # the methods of libraries, five minutes
    .venv/bin/python tests/study/record.py flights     # misses among 1e9 flights, half an hour
    .venv/bin/python tests/study/record.py times       # seconds of flights, three minutes

Each was run once, on one core. recorded.json names the processor and the versions of packages, and
tests compute a part of it again.
"""

import json
import sys
import time

import xarray as xr

from study import measured, stages
from study.measured import machine
from study.methods import libraries
from study.methods.counted_methods import BEST_SCAN, CAREFUL_SCANS, INFLECTIONS, METHODS

USUAL = "RK45, 1e-06", "DOP853, 1e-09", "LSODA, 1e-09", "heyoka, 1e-15"
CAREFUL = tuple(name.replace(",", " with care,") for name in (*USUAL, "CyRK DOP853, 1e-09"))
COMPILED = "CyRK", "heyoka"
SEA = 10_000, 100_000  # flights of the sea for interpreted methods, and for compiled ones
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


def times() -> dict[str, xr.Dataset]:
    """Measure the seconds of a flight, of all methods in one run, which needs an idle machine."""
    data = measured.timed_work([*METHODS, *libraries.METHODS], 200, 9)
    data = data[["name", "seconds_low", "seconds", "seconds_high"]].rename(method="timed")
    data = data.rename({name: f"timed_{name}" for name in data})
    return {"times": data.drop_attrs(deep=False)}


if __name__ == "__main__":
    parts = {"libraries": libraries_recorded, "flights": flights, "times": times}
    start = time.process_time()
    made = parts[sys.argv[1]]()
    done = machine() | {"seconds": str(round(time.process_time() - start))}
    file = stages.RECORDED
    old = json.loads(file.read_text(encoding="utf-8")) if file.exists() else {}
    new = {name: data.assign_attrs(done).to_dict() for name, data in made.items()}
    text = json.dumps(old | new, indent=None, separators=(",", ":")).replace('},"', '},\n"')
    file.write_text(text + "\n", encoding="utf-8")
