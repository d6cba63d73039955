"""Modules that jobs need, imported by the job server before it forks jobs.

The variable PSEUDORIGID_PRELOAD has the word `data` if a run computes datasets, and `sweep` if it
computes blocks of a sweep. An import that fails here fails again in a job, which reports it.
"""

import os
from contextlib import suppress
from importlib import import_module

_WANTED = os.environ.get("PSEUDORIGID_PRELOAD", "").split()
_MODULES = ["pipeline.jobs.dispatch", "pipeline.records.artifacts"]
_MODULES += ["pseudorigid.figures.axes.box", "pseudorigid.figures.canvas.render"]
_MODULES += ["pseudorigid.dynamics.ensemble"] if "data" in _WANTED else []

for _name in _MODULES:
    with suppress(Exception):
        import_module(_name)
with suppress(Exception):
    if "data" in _WANTED:  # the first call of any compiled function initialises numba
        import_module("numba").njit(lambda: 0)()
    if "sweep" in _WANTED:  # each of many blocks would spend 0.1 s on loading this function
        import_module("pseudorigid.sweep.cell").cells(0.2, [1.0], 20, 200)
