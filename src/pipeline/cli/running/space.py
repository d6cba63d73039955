"""Check that the disk has space for sweeps."""

import shutil
from collections.abc import Iterable

from pseudorigid.sweep import grid

from ...records.build_spec import BuildSpec
from ..session import UsageError

# Bytes on disk, rounded up from measurements: a cell in its block and in the dataset; a block with
# snakemake's records of it; and snakemake's own files in any run.
CELL_BYTES, BLOCK_BYTES, RUN_BYTES = 600, 60_000, 10_000_000


def require_space(specs: Iterable[BuildSpec]) -> None:
    """Raise UsageError if the disk has too little space for the blocks among these results."""
    swept = [spec for spec in specs if spec.program == "sweep"]
    blocks = [len(spec.config["cells"]) for spec in swept if "cells" in spec.config]
    joined = [grid.cells(spec.config) for spec in swept if "cells" not in spec.config]
    need = RUN_BYTES + CELL_BYTES * max(sum(blocks), sum(joined)) + BLOCK_BYTES * len(blocks)
    free = shutil.disk_usage(".").free
    if blocks and free < need:
        sizes = f"about {need / 1e6:.0f} MB are needed here, {free / 1e6:.0f} are free"
        raise UsageError(f"the disk is full: {sizes}")
