"""The blocks of a sweep as one dataset."""

from job import one_line_errors
from pipeline.records import blocks as store
from pseudorigid.sweep import grid

with one_line_errors(snakemake):
    sweep = snakemake.params.sweep
    blocks = ((path, grid.block(sweep, i)) for i, path in enumerate(snakemake.input.blocks))
    store.join(grid.whole(sweep), blocks, snakemake.output[0], snakemake.output.record)
