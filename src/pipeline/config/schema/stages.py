"""The stages that parts declare: function, inputs, fields that decide the data."""

from collections.abc import Iterable

from ...declaration import Stage, parts
from .scene import Picture

STAGES: dict[str, Stage] = {}
for _part in parts().values():
    STAGES |= _part.stages


def function_of(stage: str, scene: Picture) -> str:
    """Return the function that computes a stage of a scene."""
    computes = getattr(getattr(scene, "method", None), "computes", {})
    return str(computes.get(stage, STAGES[stage].function))


def takes_method(stage: str, scene: Picture) -> bool:
    """Return whether a scene's `method` decides the data of a stage.

    A scan decides all stages that use a method; a method of a part only those that it has.
    """
    method = getattr(scene, "method", None)
    return STAGES[stage].follows and stage in getattr(method, "computes", STAGES)


def upstream(stages: Iterable[str]) -> list[str]:
    """Return these stages and those whose datasets they take, each after its inputs."""
    ordered: list[str] = []
    for stage in stages:
        ordered += [s for s in (*upstream(STAGES[stage].inputs), stage) if s not in ordered]
    return ordered
