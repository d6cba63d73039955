"""The scenes of the paper whose errors the study measures, and what it compares with."""

from collections.abc import Iterator

from pipeline.config import MAIN, Config
from pipeline.config.schema.scene import Picture
from pipeline.records.provenance import BuildSpec

# Kinds of picture with a measure of error in figure_errors, with the axes that it needs, and
# the stages whose datasets the study compares with.
STUDIED = {
    "portrait": {"x", "xdot", "udot"},
    "motion": {"t", "displacement"},
    "tangle": {"x", "xdot", "udot"},
    "closeup": {"x", "xdot"},
    "exponents": {"impact", "exponent"},
}
_COMPARED = ("periodic", "manifolds")


def with_paper(config: Config, _: Picture, spec: BuildSpec) -> Iterator[BuildSpec]:
    """Yield the specification of the stage `needs` with the paper's scenes and their datasets.

    The study measures the errors of scenes with a measure of error and all axes, which fix the
    picture's size.
    """
    chosen = {
        name: block
        for name, scene in config.scenes.items()
        if scene.picture in STUDIED
        and STUDIED[scene.picture] <= (block := scene.as_mapping()).get("axes", {}).keys()
    }
    inputs = {
        f"{stage}/{scene}": path
        for (variant, scene, stage), path in config.datasets.items()
        if variant == MAIN and scene in chosen and stage in _COMPARED
    }
    measures = {name: config.scenes[name].picture for name in chosen}
    more = {"scenes": chosen, "measures": measures, "inputs": [*inputs]}
    yield spec._replace(config=spec.config | more, inputs=[*spec.inputs, *inputs.values()])
