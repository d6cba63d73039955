"""Modules that jobs need, imported by the process that forks jobs.

An import that fails here fails again in a job, which reports it. Jobs also inherit the commit, for
which git is asked once a run.
"""

import sys
from contextlib import suppress
from importlib import import_module

for _name in (
    *("pipeline.jobs.job", "pipeline.records.artifacts", "pseudorigid.dynamics.ensemble"),
    *("pseudorigid.figures.axes.box", "pseudorigid.figures.canvas.render"),
):
    with suppress(Exception):
        import_module(_name)
with suppress(Exception):
    import_module("pipeline.records.provenance").commit()
# Without scipy.linalg numba loads no OpenBLAS, with which each fork takes 0.1 s longer.
sys.modules["scipy.linalg"] = None  # type: ignore[assignment]
with suppress(Exception):  # the first call of any compiled function initialises numba
    import_module("numba").njit(lambda: 0)()
del sys.modules["scipy.linalg"]  # a job may import it
