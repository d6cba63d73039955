"""One block of cells."""

from job import one_line_errors, recorded
from pipeline.records import artifacts
from pseudorigid.sweep import blocks

with one_line_errors(snakemake), recorded(snakemake):
    block = snakemake.params.block
    artifacts.save(blocks.compute(block), snakemake.output[0], block)
