"""Stages of each scene, and paths of data and figures relative to the project's root."""

import json
from dataclasses import dataclass

from .schema.fields import Block, YamlMapping
from .schema.scene import Picture
from .schema.sets import MAIN, PUBLISHED, SETS
from .schema.stages import STAGES, takes_method, upstream

__all__ = ["MAIN", "PUBLISHED", "ArtifactPaths", "Config", "Picture", "Variants"]

SHOWN = ("png", "svg")  # formats that are published; pdf stays in results

Variants = dict[str, dict[str, Picture]]  # variant -> scene's name -> scene
ArtifactPaths = dict[tuple[str, str, str], str]  # variant, scene, stage -> path of the dataset


@dataclass(frozen=True)
class Config:
    """A checked config, whose scenes are complete.

    `variants` has the sets of scenes (the paper, the study and those of extensions) and then the
    variants of the paper. `left_out` maps variants to the scenes that they cannot have, with the
    reasons. `blocks` are those of extensions that are no scenes, by their keys.
    """

    variants: Variants
    left_out: dict[str, dict[str, str]]
    blocks: dict[str, Block]

    @property
    def scenes(self) -> dict[str, Picture]:
        """The paper's scenes."""
        return self.variants[MAIN]

    @property
    def own_variants(self) -> list[str]:
        """The names of the variants of the paper."""
        return [name for name in self.variants if name not in SETS]


def stages(scene: Picture) -> dict[str, YamlMapping]:
    """Map each stage of a scene to the fields of the scene that decide its data."""
    parameters = {}
    for name in upstream(scene.stages):
        method = ("method",) if takes_method(name, scene) else ()
        parameters[name] = scene.as_mapping(("ball", "energy", *STAGES[name].names, *method))
    return parameters


def drawing(scene: Picture) -> YamlMapping:
    """Return the fields of a scene that decide its drawing."""
    return {key: value for key, value in scene.as_mapping().items() if key not in scene.undrawn}


def artifact_paths(variants: Variants) -> ArtifactPaths:
    """Map (variant, scene, stage) to the path of the stage's dataset.

    A variant shares a scene's dataset with the first variant that gives this scene the same
    parameters and inputs. Scenes of other names share only data that depend on no field of a scene,
    and those of the scene that they are drawn `over`. An added scene therefore changes no path.
    """
    first_paths: dict[tuple[str, str, str], str] = {}
    dataset_paths: ArtifactPaths = {}
    for variant, scenes in variants.items():
        for scene, block in scenes.items():
            over = getattr(block, "over", None)
            below = stages(scenes[over]) if over else {}
            for stage, parameters in stages(block).items():
                used = [dataset_paths[variant, scene, name] for name in STAGES[stage].inputs]
                owner = over if over and stage in below else scene
                name = f"{stage}_{owner}" if parameters else stage
                key = owner, stage, json.dumps([parameters, used], sort_keys=True)
                path = first_paths.setdefault(key, f"results/{variant}/{name}.nc")
                dataset_paths[variant, scene, stage] = path
    return dataset_paths


def block_path(dataset_path: str, number: int) -> str:
    """Return the path of a block of a dataset, counted from 0."""
    return f"{dataset_path.removesuffix('.nc')}.{number:04d}.nc"  # no scene has a dot in its name


def drawn(scene: str, extension: str, variant: str = MAIN) -> str:
    """Return the path where a figure is drawn, before it is published."""
    return f"results/{variant}/figures/{scene}.{extension}"


def is_measured(scene: Picture) -> bool:
    """Return whether a scene shows times of this machine."""
    return any(STAGES[stage].measured for stage in scene.stages)


def figures(variants: Variants, variant: str = MAIN) -> dict[str, tuple[str, list[str]]]:
    """Map each figure, where users find it, to its scene, and to its data and last its drawing.

    Pictures of measurements stay in results until `accept`.
    """
    dataset_paths = artifact_paths(variants)
    figure_paths = {}
    for name, block in variants[variant].items():
        data = [dataset_paths[variant, name, stage] for stage in stages(block)]
        for extension in block.formats:
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
        if not block.formats
    }
