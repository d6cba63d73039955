"""One block of cells."""

from job import one_line_errors
from pipeline.records import blocks as store

with one_line_errors(snakemake):
    block = snakemake.params.block
    store.save_block(store.compute(block), snakemake.output[0], block)
