"""What a result is made from and by: the one description that runs, jobs and checks share."""

from typing import NamedTuple


class BuildSpec(NamedTuple):
    """A result and what makes it.

    Parameters
    ----------
    result : str
        Its file, from the root.
    scene, step : str
        How it is called in messages, as in "fig2" and "orbits".
    config : dict
        Its block of the config.
    program : str
        The module of `pipeline.jobs` that makes it.
    given : object
        What the program needs besides: of a stage the module and function that compute it, of a
        picture the module that draws it.
    sources : list of str
        The project's files that decide its bytes, from the root.
    inputs : list of str
        The results that it is made from.
    """

    result: str
    scene: str
    step: str
    config: dict
    program: str
    given: object
    sources: list[str]
    inputs: list[str]
