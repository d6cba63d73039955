"""The scenes of the paper whose errors the study measures, and their datasets."""

from collections.abc import Mapping

from .schema.fields import YamlMapping
from .schema.scene import Picture

# Kinds of picture with a measure of error in study.figure_errors.
STUDIED = ("portrait", "motion", "tangle", "closeup", "exponents")
STAGES = ("periodic", "manifolds")  # whose datasets the study compares with


def paper_scenes(
    scenes: Mapping[str, Picture], artifact_paths: Mapping[tuple[str, str], str]
) -> tuple[YamlMapping, dict[str, str]]:
    """Return what decides the data of the stage `needs`, and its inputs by stage and scene.

    These are the scenes with a measure of error and axes, which fix the picture's size.
    """
    chosen = {
        name: block
        for name, scene in scenes.items()
        if scene.picture in STUDIED and "axes" in (block := scene.as_mapping())
    }
    measures = {name: scenes[name].picture for name in chosen}
    inputs = {
        f"{stage}/{scene}": path
        for (scene, stage), path in artifact_paths.items()
        if scene in chosen and stage in STAGES
    }
    return {"scenes": chosen, "measures": measures}, inputs
