"""Stages of each scene, and paths of data and figures relative to the project's root."""

import json
from dataclasses import dataclass
from typing import Any

from .schema.fields import YamlMapping
from .schema.kinds import KINDS
from .schema.sets import PAPER, PUBLISHED, SETS
from .schema.stages import STAGES, takes_method, upstream

__all__ = ["PAPER", "PUBLISHED", "Config", "Variants"]

SHOWN = ("png", "svg")  # formats that are published; pdf stays in results

Variants = dict[str, dict[str, YamlMapping]]  # variant -> scene -> complete block


@dataclass(frozen=True)
class Config:
    """A checked config: blocks are complete, with the values that YAML gave.

    `variants` has the sets of scenes (the paper, the study and those of extensions) and then the
    variants of the paper. `left_out` maps variants to the scenes that they cannot have, with the
    reasons. `blocks` are those of extensions that are no scenes.
    """

    ball: YamlMapping
    variants: Variants
    left_out: dict[str, dict[str, str]]
    blocks: dict[str, Any]

    @property
    def scenes(self) -> dict[str, YamlMapping]:
        """The paper's scenes."""
        return self.variants[PAPER]

    @property
    def own_variants(self) -> list[str]:
        """The names of the variants of the paper."""
        return [name for name in self.variants if name not in SETS]


def stages(block: YamlMapping) -> dict[str, YamlMapping]:
    """Map each stage of a scene to the part of the scene's complete block that decides its data."""
    parameters = {}
    for name in upstream(KINDS[block["picture"]].stages):
        method = ("method",) if takes_method(name, block.get("method", {})) else ()
        fields = ("ball", "energy", *STAGES[name].names, *method)
        parameters[name] = {field: block[field] for field in fields if field in block}
    return parameters


def drawing(block: YamlMapping) -> YamlMapping:
    """Return the part of a scene's block that decides its drawing."""
    undrawn = KINDS[block["picture"]].undrawn
    return {key: value for key, value in block.items() if key not in undrawn}


def artifact_paths(variants: Variants) -> dict[tuple[str, str, str], str]:
    """Map (variant, scene, stage) to the path of the stage's dataset.

    A variant shares a scene's dataset with the first variant that gives this scene the same
    parameters and inputs. Scenes of other names share only data that depend on no field of a scene,
    and those of the scene that they are drawn `over`. An added scene therefore changes no path.
    """
    first_paths: dict[tuple[str, str, str], str] = {}
    dataset_paths: dict[tuple[str, str, str], str] = {}
    for variant, scenes in variants.items():
        for scene, block in scenes.items():
            below = stages(scenes[block["over"]]) if "over" in block else {}
            for stage, parameters in stages(block).items():
                used = [dataset_paths[variant, scene, name] for name in STAGES[stage].inputs]
                owner = block["over"] if stage in below else scene
                name = f"{stage}_{owner}" if parameters else stage
                key = owner, stage, json.dumps([parameters, used], sort_keys=True)
                path = first_paths.setdefault(key, f"results/{variant}/{name}.nc")
                dataset_paths[variant, scene, stage] = path
    return dataset_paths


def part_path(dataset_path: str, number: int) -> str:
    """Return the path of a part of a dataset, counted from 0."""
    return f"{dataset_path.removesuffix('.nc')}.{number:04d}.nc"  # no scene has a dot in its name


def drawn(scene: str, extension: str, variant: str = PAPER) -> str:
    """Return the path where a figure is drawn, before it is published."""
    return f"results/{variant}/figures/{scene}.{extension}"


def is_measured(block: YamlMapping) -> bool:
    """Return whether a scene shows times of this machine."""
    return any(STAGES[stage].measured for stage in KINDS[block["picture"]].stages)


def figures(variants: Variants, variant: str = PAPER) -> dict[str, tuple[str, list[str]]]:
    """Map each figure, where users find it, to its scene, and to its data and last its drawing.

    Pictures of measurements stay in results until `accept`.
    """
    dataset_paths = artifact_paths(variants)
    figure_paths = {}
    for name, block in variants[variant].items():
        data = [dataset_paths[variant, name, stage] for stage in stages(block)]
        for extension in block["formats"]:
            drawing_path = drawn(name, extension, variant)
            published = variant in PUBLISHED and extension in SHOWN and not is_measured(block)
            path = f"{PUBLISHED[variant]}/{name}.{extension}" if published else drawing_path
            figure_paths[path] = name, [*data, drawing_path]
    return figure_paths


def data_only(variants: Variants, variant: str) -> dict[str, list[str]]:
    """Map each scene of a set that has no picture to its datasets."""
    dataset_paths = artifact_paths(variants)
    return {
        name: [dataset_paths[variant, name, stage] for stage in stages(block)]
        for name, block in variants[variant].items()
        if not block["formats"]
    }
