"""The scenes of the paper whose errors the study measures, and what it compares with."""

from collections.abc import Mapping
from typing import Any

from pipeline.config.schema.scene import Picture

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


def paper_scenes(
    scenes: Mapping[str, Picture], datasets: Mapping[tuple[str, str], str]
) -> tuple[dict[str, Any], dict[str, str]]:
    """Return what decides the data of the stage `needs`, and its inputs by stage and scene.

    The study measures the errors of scenes with a measure of error and all axes, which fix the
    picture's size.
    """
    chosen = {
        name: block
        for name, scene in scenes.items()
        if scene.picture in STUDIED
        and STUDIED[scene.picture] <= (block := scene.as_mapping()).get("axes", {}).keys()
    }
    measures = {name: scenes[name].picture for name in chosen}
    inputs = {
        f"{stage}/{scene}": path
        for (scene, stage), path in datasets.items()
        if scene in chosen and stage in _COMPARED
    }
    return {"scenes": chosen, "measures": measures}, inputs
