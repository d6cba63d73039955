"""Build specifications: how each result is to be made."""

from typing import Any, NamedTuple


class BuildSpec(NamedTuple):
    """A result and how it is made; paths are relative to the project's root."""

    result: str  # its file
    scene: str  # its names in messages, such as those of a figure and a stage
    step: str
    config: dict[str, Any]  # the block of the config that it depends on
    program: str  # the module of `pipeline.jobs` that makes it
    function: str  # module.function that computes the dataset or draws the picture
    sources: list[str]  # the project's files that decide its bytes
    inputs: list[str]  # the results that it is made from
