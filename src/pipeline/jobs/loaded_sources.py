"""Modules that every job needs, imported by the server before it forks jobs.

An import that fails here fails again in a job, which reports it.
"""

from contextlib import suppress
from importlib import import_module

for _name in (
    "pipeline.jobs.dispatch",
    "pipeline.records.artifacts",
    "pseudorigid.figures.axes.box",
    "pseudorigid.figures.canvas.render",
):
    with suppress(Exception):
        import_module(_name)
