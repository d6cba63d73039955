"""The blocks of a sweep as one dataset."""

from job import one_line_errors, recorded
from pipeline.records import artifacts
from pseudorigid.sweep import blocks

with one_line_errors(snakemake), recorded(snakemake):
    sweep = snakemake.params.block
    parts = (artifacts.load(path) for path in snakemake.input.data)
    artifacts.save(blocks.join(sweep, parts), snakemake.output[0], sweep)
