"""One block of cells of a sweep, or its blocks as one dataset."""

from pipeline.records import artifacts
from pipeline.records.job import one_line_errors, recorded
from pseudorigid.sweep import blocks

with one_line_errors(snakemake), recorded(snakemake):
    block = snakemake.params.block
    parts = [artifacts.load(path) for path in snakemake.input.data]
    dataset = blocks.join(block, parts) if parts else blocks.compute(block)
    title = "Cells of a sweep" if parts else "Block of cells of a sweep"
    artifacts.save(dataset, snakemake.output[0], block, title=title)
