"""One block of cells of a sweep, or its blocks as one dataset."""

from pipeline.records import artifacts
from pipeline.records.job import one_line_errors, recorded
from pseudorigid.sweep import blocks

with one_line_errors(snakemake), recorded(snakemake):
    block = snakemake.params.block
    parts = [artifacts.load(path) for path in snakemake.input.data]
    dataset = blocks.join(block, parts) if parts else blocks.compute(block)
    title = artifacts.title_of(blocks.join if parts else blocks.compute)
    artifacts.save(dataset, snakemake.output[0], block, title=title)
