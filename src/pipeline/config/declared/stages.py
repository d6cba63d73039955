"""The stages: what computes each, from what, and which fields of a scene decide its data."""

from typing import NamedTuple


class Stage(NamedTuple):
    """A function of the science, called as f(ball, energy, *inputs, **fields) -> Dataset."""

    module: str
    function: str
    fields: tuple[str, ...]  # of those that the scene has
    inputs: tuple[str, ...] = ()  # stages whose datasets it takes
    follows: bool = True  # orbits, so that a scene's `method` decides its data too


_DYNAMICS = "pseudorigid.dynamics"
STAGES = {
    "orbits": Stage(f"{_DYNAMICS}.orbits", "scene_orbits", ("starts", "impacts")),
    "periodic": Stage(f"{_DYNAMICS}.periodic", "symmetric_orbits", ("period",), follows=False),
    "motion": Stage(
        f"{_DYNAMICS}.motion", "scene_motion", ("period", "type", "duration"), ("periodic",)
    ),
    "manifolds": Stage(
        f"{_DYNAMICS}.manifolds",
        "scene_manifolds",
        ("period", "type", "branches", "point", "window", "length", "resolution"),
        ("periodic",),
    ),
    "lyapunov": Stage(f"{_DYNAMICS}.lyapunov", "scene_exponents", ("starts", "impacts", "records")),
}


def behind(stages) -> list[str]:
    """These stages and those that they take datasets of, each after its inputs."""
    found = []
    for stage in stages:
        found += [s for s in (*behind(STAGES[stage].inputs), stage) if s not in found]
    return found
