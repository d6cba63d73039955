"""The stages: the function of each, its inputs, and the fields that decide its data."""

from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple


class Stage(NamedTuple):
    """A function of pseudorigid, called as f(ball, energy, *inputs, **fields) -> Dataset."""

    module: str
    function: str
    fields: tuple[str, ...]  # the scene's fields that it takes, as far as the scene has them
    inputs: tuple[str, ...] = ()  # stages whose datasets it takes
    follows: bool = False  # it follows orbits, so that a scene's `method` decides its data too
    exact: tuple[str, str] | None = None  # module and function for `method: {exact: true}`

    def maker(self, block: Mapping[str, Any]) -> tuple[str, str]:
        """Return module and function for a block of the config."""
        if self.exact is not None and "exact" in block.get("method", {}):
            return self.exact
        return self.module, self.function

    def takes(self, method: Mapping[str, Any]) -> bool:
        """Return whether a scene's `method` decides the data of this stage."""
        return self.follows and (self.exact is not None or "exact" not in method)


_DYNAMICS, _PROOFS = "pseudorigid.dynamics", "pseudorigid.proofs"
STAGES = {
    "orbits": Stage(
        f"{_DYNAMICS}.orbits",
        "scene_orbits",
        ("starts", "impacts"),
        follows=True,
        exact=(f"{_PROOFS}.true_orbits.orbit", "true_scene_orbits"),
    ),
    "periodic": Stage(f"{_DYNAMICS}.periodic", "symmetric_orbits", ("period",)),
    "motion": Stage(
        f"{_DYNAMICS}.motion", "scene_motion", ("period", "type", "duration"), ("periodic",), True
    ),
    "manifolds": Stage(
        f"{_DYNAMICS}.manifolds",
        "scene_manifolds",
        ("period", "type", "branches", "point", "window", "length", "resolution"),
        ("periodic",),
        follows=True,
    ),
    **{
        name: Stage(f"pseudorigid.analyses.{name}", name, tuple(fields.split()))
        for name, fields in {
            "spread": "orbits length blocks regular regular_impacts cells visits",
            "clusters": "between orbits impacts cuts lags resamples seed",
            "rotation": "energies starts impacts detail detail_impacts",
            "jumps": "energies sides",
            "flux": "period distance grid between orbits impacts",
            "last_curve": "nobles convergents between impacts drawn",
            "families": "parameter span period levels",
            "escape": "beside distance orbits impacts",
            "control": "strengths orbits impacts period starts shown drawn resamples seed",
        }.items()
    },
    "shares": Stage(
        "pseudorigid.sweep.shares",
        "shares",
        ("parameter", "span", "step", "starts", "impacts"),
        ("families",),
    ),
    "horseshoe": Stage(
        f"{_PROOFS}.theorems.scenes",
        "scene_horseshoe",
        ("period", "type", "connection"),
        ("periodic",),
    ),
    "twist": Stage(f"{_PROOFS}.theorems.scenes", "scene_twist", ("energies",)),
    "curves": Stage(f"{_PROOFS}.theorems.scenes", "scene_curves", ("rotation_numbers",)),
    "graph": Stage(f"{_PROOFS}.theorems.scenes", "scene_graph", ()),
    "lyapunov": Stage(
        f"{_DYNAMICS}.lyapunov", "scene_exponents", ("starts", "impacts", "records"), follows=True
    ),
}


def upstream(stages: Iterable[str]) -> list[str]:
    """Return these stages and those whose datasets they take, each after its inputs."""
    ordered: list[str] = []
    for stage in stages:
        ordered += [s for s in (*upstream(STAGES[stage].inputs), stage) if s not in ordered]
    return ordered
