"""The stages that parts declare: function, inputs, fields that decide the data."""

from collections.abc import Iterable, Mapping

from ...declaration import Stage, parts
from .scene import Picture, Scene

STAGES: dict[str, Stage] = {}
for _part in parts().values():
    STAGES |= _part.stages
# method of a part -> stage -> the function that computes it
METHODS = {
    key: functions for part in parts().values() for key, (_, functions) in part.methods.items()
}


def function_of(stage: str, scene: Picture) -> str:
    """Return the function that computes a stage of a scene."""
    of_method = (
        functions[stage] for functions in _functions_of_method(scene) if stage in functions
    )
    return next(of_method, STAGES[stage].function)


def takes_method(stage: str, scene: Picture) -> bool:
    """Return whether a scene's `method` decides the data of a stage.

    A scan decides all stages that use a method; a method of a part only those that it has.
    """
    return STAGES[stage].follows and all(
        stage in functions for functions in _functions_of_method(scene)
    )


def _functions_of_method(scene: Picture) -> list[Mapping[str, str]]:
    """Return stage -> function of a scene's method if a part has it, otherwise nothing."""
    keys = scene.method.model_fields_set if isinstance(scene, Scene) and scene.method else ()
    return [METHODS[key] for key in keys if key in METHODS]


def upstream(stages: Iterable[str]) -> list[str]:
    """Return these stages and those whose datasets they take, each after its inputs."""
    ordered: list[str] = []
    for stage in stages:
        ordered += [s for s in (*upstream(STAGES[stage].inputs), stage) if s not in ordered]
    return ordered
