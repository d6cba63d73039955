"""Compute a block of cells of a sweep, or join its blocks into one dataset."""

from pseudorigid.sweep import blocks

from ..records import artifacts


def make(spec):
    """Compute the result of a BuildSpec."""
    block = spec.config
    parts = [artifacts.load(path) for path in spec.inputs]
    dataset = blocks.join(block, parts) if parts else blocks.compute(block)
    title = "Cells of a sweep" if parts else "Block of cells of a sweep"
    artifacts.save(dataset, spec.result, block, title=title)
