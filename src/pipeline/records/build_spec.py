"""Build specifications: how each result is to be made."""

from typing import Any, NamedTuple


class BuildSpec(NamedTuple):
    """A result and how it is made; paths are relative to the project's root.

    Parameters
    ----------
    result : str
        The result's file.
    scene, step : str
        Its names in messages, such as "fig2" and "orbits".
    config : dict
        The block of the config that it depends on.
    program : str
        The module of `pipeline.jobs` that makes it.
    given : object
        A further argument of the program: for a stage, the module and the function that compute
        it; for a picture, the module that draws it.
    sources : list of str
        The project's files that decide its bytes.
    inputs : list of str
        The results that it is made from.
    """

    result: str
    scene: str
    step: str
    config: dict[str, Any]
    program: str
    given: Any
    sources: list[str]
    inputs: list[str]
