"""What the server of jobs imports beforehand; what fails here is for a job to say."""

from contextlib import suppress
from importlib import import_module

for _name in (
    "snakemake.script",
    "snakemake.logging",
    "pipeline.records.artifacts",
    "pipeline.records.drawings",
    "pipeline.records.record",
    "pseudorigid.dynamics.ensemble",
    "pseudorigid.figures.axes.box",
):
    with suppress(Exception):
        import_module(_name)
with suppress(Exception):
    # What numba loads at the first call of anything.
    import_module("numba").njit(lambda: 0)()
