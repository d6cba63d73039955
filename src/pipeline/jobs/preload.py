"""Modules that jobs need, imported by the process that forks jobs.

The variable PSEUDORIGID_PRELOAD is `data` if a run computes datasets. An import that fails here
fails again in a job, which reports it.
"""

import os
import sys
from contextlib import suppress
from importlib import import_module

_DATA = os.environ.get("PSEUDORIGID_PRELOAD") == "data"
_MODULES = ["pipeline.jobs.job", "pipeline.records.artifacts"]
_MODULES += ["pseudorigid.figures.axes.box", "pseudorigid.figures.canvas.render"]
_MODULES += ["pseudorigid.dynamics.ensemble"] if _DATA else []

for _name in _MODULES:
    with suppress(Exception):
        import_module(_name)
with suppress(Exception):
    if _DATA:  # the first call of any compiled function initialises numba
        # Without scipy.linalg numba loads no OpenBLAS, with which each fork takes 0.1 s longer.
        sys.modules["scipy.linalg"] = None  # type: ignore[assignment]
        try:
            import_module("numba").njit(lambda: 0)()
        finally:
            del sys.modules["scipy.linalg"]  # a job may import it
