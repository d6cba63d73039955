"""The space on the disk that sweeps need."""

import shutil

from pseudorigid.sweep import grid

from ..session import UsageError

# Bytes of disk, rounded up from what was measured: a cell in its block and in the dataset, a block
# and snakemake's records of it, and what snakemake writes for any run.
CELL, BLOCK, RUN = 600, 60_000, 10_000_000


def require_space(specs):
    """Raise UsageError where the disk has not the space for the blocks of cells among results.

    Parameters
    ----------
    specs : iterable of BuildSpec
        The results that a run makes.
    """
    swept = [each for each in specs if each.program == "sweep"]
    blocks = [len(each.config["cells"]) for each in swept if "cells" in each.config]
    joined = [grid.cells(each.config) for each in swept if "cells" not in each.config]
    need = RUN + CELL * max(sum(blocks), sum(joined)) + BLOCK * len(blocks)
    free = shutil.disk_usage(".").free
    if blocks and free < need:
        sizes = f"about {need / 1e6:.0f} MB are needed here, {free / 1e6:.0f} are free"
        raise UsageError(f"the disk is full: {sizes}")
