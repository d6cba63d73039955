"""The stages: what computes each, from what, and which fields of a scene decide its data."""

from typing import NamedTuple


class Stage(NamedTuple):
    """A function of the science, called as f(ball, energy, *inputs, **fields) -> Dataset."""

    module: str
    function: str
    fields: tuple[str, ...]  # of those that the scene has
    inputs: tuple[str, ...] = ()  # stages whose datasets it takes
    follows: bool = True  # orbits, so that a scene's `method` decides its data too
    exact: tuple[str, str] | None = None  # module and function for `method: {exact: true}`

    def maker(self, block) -> tuple[str, str]:
        """Module and function for a block of the config."""
        exact = "exact" in block.get("method", {})
        return self.exact if exact else (self.module, self.function)

    def takes(self, method) -> bool:
        """Whether a scene's `method` decides the data of this stage."""
        return self.follows and (self.exact is not None or "exact" not in method)


_DYNAMICS, _PROOFS = "pseudorigid.dynamics", "pseudorigid.proofs"
STAGES = {
    "orbits": Stage(
        f"{_DYNAMICS}.orbits",
        "scene_orbits",
        ("starts", "impacts"),
        exact=(f"{_PROOFS}.true_orbits.scene", "true_scene_orbits"),
    ),
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
    **{
        name: Stage(f"pseudorigid.analyses.{name}", name, tuple(fields.split()), follows=False)
        for name, fields in {
            "spread": "orbits length blocks regular regular_impacts cells visits",
            "clusters": "between orbits impacts cuts lags resamples seed",
            "rotation": "energies starts impacts detail detail_impacts",
            "jumps": "energies sides",
            "flux": "period distance grid between orbits impacts",
            "last_curve": "nobles convergents between impacts drawn",
        }.items()
    },
    "horseshoe": Stage(
        f"{_PROOFS}.theorems.scenes",
        "scene_horseshoe",
        ("period", "type", "connection"),
        ("periodic",),
        follows=False,
    ),
    "twist": Stage(f"{_PROOFS}.theorems.scenes", "scene_twist", ("energies",), follows=False),
    "lyapunov": Stage(f"{_DYNAMICS}.lyapunov", "scene_exponents", ("starts", "impacts", "records")),
}


def upstream(stages) -> list[str]:
    """These stages and those that they take datasets of, each after its inputs."""
    found = []
    for stage in stages:
        found += [s for s in (*upstream(STAGES[stage].inputs), stage) if s not in found]
    return found
