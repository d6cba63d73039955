"""The stages of the core and of extensions: function, inputs, fields that decide the data."""

from collections.abc import Iterable, Mapping

from ...declaration import Stage, extensions
from .scene import Picture, Scene

_DYNAMICS, _STUDY = "pseudorigid.dynamics", "study.stages"
STAGES = {
    "orbits": Stage(f"{_DYNAMICS}.orbits.scene_orbits", "starts impacts", follows=True),
    "periodic": Stage(f"{_DYNAMICS}.periodic.symmetric_orbits", "period"),
    "motion": Stage(
        f"{_DYNAMICS}.motion.scene_motion", "period type duration", ("periodic",), follows=True
    ),
    "manifolds": Stage(
        f"{_DYNAMICS}.manifolds.scene_manifolds",
        "period type branches point window length resolution",
        ("periodic",),
        follows=True,
    ),
    "lyapunov": Stage(
        f"{_DYNAMICS}.lyapunov.scene_exponents", "starts impacts records", follows=True
    ),
    "work": Stage(f"{_STUDY}.work"),
    "edges": Stage(f"{_STUDY}.edges"),
    "drift": Stage(f"{_STUDY}.drift"),
    "needs": Stage(
        "study.figure_errors.figure_errors", paper="pipeline.config.build_specs.paper_scenes"
    ),
    "work_all": Stage("study.measured.work_all", measured=True),
    "edges_all": Stage("study.measured.edges_all", measured=True),
    "missed_all": Stage("study.measured.missed_all", measured=True),
}
for _extension in extensions().values():
    STAGES |= _extension.stages
# method of an extension -> stage -> the function that computes it
METHODS_OF_EXTENSIONS = {
    method: functions
    for extension in extensions().values()
    for method, functions in extension.exact.items()
}


def function_of(stage: str, scene: Picture) -> str:
    """Return the function that computes a stage of a scene."""
    of_method = (
        functions[stage] for functions in _functions_of_method(scene) if stage in functions
    )
    return next(of_method, STAGES[stage].function)


def takes_method(stage: str, scene: Picture) -> bool:
    """Return whether a scene's `method` decides the data of a stage.

    A scan decides all stages that use a method; a method of an extension only those that it has.
    """
    return STAGES[stage].follows and all(
        stage in functions for functions in _functions_of_method(scene)
    )


def _functions_of_method(scene: Picture) -> list[Mapping[str, str]]:
    """Return stage -> function of a scene's method if an extension has it, otherwise nothing."""
    keys = scene.method.model_fields_set if isinstance(scene, Scene) and scene.method else ()
    return [METHODS_OF_EXTENSIONS[key] for key in keys if key in METHODS_OF_EXTENSIONS]


def upstream(stages: Iterable[str]) -> list[str]:
    """Return these stages and those whose datasets they take, each after its inputs."""
    ordered: list[str] = []
    for stage in stages:
        ordered += [s for s in (*upstream(STAGES[stage].inputs), stage) if s not in ordered]
    return ordered
