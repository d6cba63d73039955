"""Compute a block of cells of a sweep, or join its blocks into one dataset."""

from pseudorigid.sweep import blocks

from ..records import artifacts
from ..records.build_spec import BuildSpec


def make(spec: BuildSpec) -> None:
    """Join the blocks if the result has inputs, else compute a block."""
    if spec.inputs:
        title = "Cells of a sweep"
        dataset = blocks.join(spec.config, [artifacts.load(path) for path in spec.inputs])
    else:
        title = "Block of cells of a sweep"
        dataset = blocks.compute(spec.config)
    artifacts.save(dataset, spec.result, spec.config, title=title)
