"""Modules that every job needs, imported by the server before it forks jobs.

An import that fails here fails again in a job, which reports it.
"""

from contextlib import suppress
from importlib import import_module

for _name in (
    "pipeline.jobs.dispatch",
    "pipeline.records.artifacts",
    "pipeline.records.drawings",
    "pseudorigid.figures.axes.box",
):
    with suppress(Exception):
        import_module(_name)
