"""What the server of jobs imports beforehand; what fails here is for a job to say."""

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
