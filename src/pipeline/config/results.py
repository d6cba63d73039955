"""What can be made from a config: the path, the build specification and the figure of each result.

All paths are relative to the project's root. A dataset is results/VARIANT/STAGE_SCENE.nc and a
drawing results/VARIANT/figures/SCENE.png, where VARIANT may be a set of scenes.
"""

import json
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache, cached_property
from pathlib import PurePath
from typing import Any, NamedTuple

from pseudorigid.dynamics.bounds import LARGEST_OF_SPHERES, NO_SPHERE

from ..declaration import imported
from ..records import sources
from ..records.provenance import BuildSpec
from .schema.fields import YamlMapping
from .schema.parts import MAIN, PUBLISHED, SETS, STAGES, upstream
from .schema.scene import Picture, Scene

SHOWN = ("png", "svg", "gif")  # formats that are published; pdf stays in results

Variants = dict[str, dict[str, Picture]]  # variant -> scene's name -> scene
Datasets = dict[tuple[str, str, str], str]  # variant, scene, stage -> path of the dataset
_source_files = cache(sources.source_files)


class Range(NamedTuple):
    """A range of variants: the path of the value that differs, and the value of each variant."""

    path: str
    members: dict[str, Any]


@dataclass(frozen=True)
class Config:
    """A checked config, whose scenes are complete.

    `variants` has the sets of scenes and then the variants of the main set. `left_out` maps each of
    these to the scenes that it cannot have, with the reasons. `document` has the blocks of parts
    that are no scenes. `faulty` has the mistakes in variants and ranges that cannot be made.
    """

    variants: Variants
    left_out: dict[str, dict[str, str]]
    document: Any
    ranges: dict[str, Range]
    faulty: dict[str, list[Any]]

    @property
    def scenes(self) -> dict[str, Picture]:
        """The scenes of the main set."""
        return self.variants[MAIN]

    @property
    def own_variants(self) -> list[str]:
        """The names of the variants of the main set that can be made."""
        return [name for name in self.variants if name not in SETS]

    def members(self, name: str) -> list[str]:
        """Return the variants of a range, or a variant itself."""
        return [*self.ranges[name].members] if name in self.ranges else [name]

    @cached_property
    def datasets(self) -> Datasets:
        """The path of each stage's dataset."""
        return dataset_paths(self.variants)

    def warning(self) -> str:
        """Return a line on balls that no sphere has, or an empty text."""
        scenes = (scene for scenes in self.variants.values() for scene in scenes.values())
        wide = {scene.ball.k for scene in scenes if isinstance(scene, Scene)}
        numbers = ", ".join(str(k) for k in sorted(wide) if k > LARGEST_OF_SPHERES)
        return f"config.yaml: k = {numbers}: {NO_SPHERE}" if numbers else ""

    def data_of(self, variant: str, scene: str) -> dict[str, str]:
        """Map each stage of a scene to the path of its dataset."""
        block = self.variants[variant][scene]
        return {stage: self.datasets[variant, scene, stage] for stage in stage_parameters(block)}

    def build_specs(self, names: Iterable[str] | None = None) -> dict[str, BuildSpec]:
        """Specify each result of all sets and variants, or of some; inputs come first.

        Variants share stages of equal parameters.
        """
        specs: dict[str, BuildSpec] = {}
        for variant in self.variants if names is None else names:
            for scene in self.variants[variant]:
                for spec in self._specs_of(variant, scene):
                    # Messages name the first variant that has a result, if it is no set.
                    folder = PurePath(spec.result).parts[1]
                    label = scene if folder in SETS else f"{folder}/{scene}"
                    specs.setdefault(spec.result, spec._replace(scene=label))
        return specs

    def _specs_of(self, variant: str, name: str) -> Iterator[BuildSpec]:
        """Yield the specifications of a scene's datasets and drawings."""
        scene, data = self.variants[variant][name], self.data_of(variant, name)
        for stage, parameters in stage_parameters(scene).items():
            path, declared = data[stage], STAGES[stage]
            function = _of_method(scene).get(stage, declared.function)
            files = files_of(function, declared.reads.format(**parameters))
            inputs = [data[used] for used in declared.inputs]
            spec = BuildSpec(path, name, stage, parameters, "stage", function, files, inputs)
            yield from imported(declared.more)(self, scene, spec) if declared.more else [spec]
        inputs = [data[stage] for stage in scene.stages]
        for suffix in scene.formats:
            path, block, function = drawn(name, suffix, variant), drawing(scene), scene.drawn_by
            step, files = f"drawing {suffix}", files_of(function, program="draw")
            yield BuildSpec(path, name, step, block, "draw", function, files, inputs)

    def figures(self, variant: str = MAIN) -> dict[str, tuple[str, str]]:
        """Map each figure, where users find it, to its scene and its drawing."""
        found = {}
        for name, block in self.variants[variant].items():
            for suffix in block.formats:
                path = drawing_path = drawn(name, suffix, variant)
                if variant in PUBLISHED and suffix in SHOWN:
                    path = f"{PUBLISHED[variant]}/{name}.{suffix}"
                found[path] = name, drawing_path
        return found


def stage_parameters(scene: Picture) -> dict[str, YamlMapping]:
    """Map each stage of a scene to the fields of the scene that decide its data."""
    parameters, of_method = {}, _of_method(scene)
    for name in upstream(scene.stages):
        # A scan decides all stages that follow orbits, a method of a part those that it computes.
        decides = STAGES[name].follows and (not of_method or name in of_method)
        fields = ["ball", "energy", *STAGES[name].fields.split(), *["method"] * decides]
        parameters[name] = scene.as_mapping(fields)
    return parameters


def _of_method(scene: Picture) -> Mapping[str, str]:
    """Return stage -> function that computes it by a scene's method, if that is one of a part."""
    return getattr(getattr(scene, "method", None), "computes", {})


def drawing(scene: Picture) -> YamlMapping:
    """Return the fields of a scene that decide its drawing."""
    return {key: value for key, value in scene.as_mapping().items() if key not in scene.undrawn}


def drawn(scene: str, suffix: str, variant: str = MAIN) -> str:
    """Return the path where a figure is drawn, before it is published."""
    return f"results/{variant}/figures/{scene}.{suffix}"


def dataset_paths(variants: Variants) -> Datasets:
    """Map (variant, scene, stage) to the path of the stage's dataset.

    A variant shares a scene's dataset with the first variant that gives this scene the same
    parameters and inputs. Scenes of other names share only data that depend on no field of a scene,
    and those of the scene that they are drawn `over`. An added scene therefore changes no path.
    """
    first_paths: dict[tuple[str, str, str], str] = {}
    paths: Datasets = {}
    for variant, scenes in variants.items():
        for scene, block in scenes.items():
            over = getattr(block, "over", None)
            below = stage_parameters(scenes[over]) if over else {}
            for stage, parameters in stage_parameters(block).items():
                used = [paths[variant, scene, name] for name in STAGES[stage].inputs]
                owner = over if over and stage in below else scene
                name = f"{stage}_{owner}" if parameters else stage
                key = owner, stage, json.dumps([parameters, used], sort_keys=True)
                path = first_paths.setdefault(key, f"results/{variant}/{name}.nc")
                paths[variant, scene, stage] = path
    return paths


def files_of(function: str, data: str = "", program: str = "stage") -> dict[str, str | None]:
    """Return the files, without their hashes, that decide what a program makes with a function.

    `data` is a pattern of the data files among them.
    """
    files = _source_files(f"pipeline.jobs.{program}", function.rpartition(".")[0])
    found = sources.ROOT.glob(data) if data else ()
    return dict.fromkeys(files + sorted(str(file.relative_to(sources.ROOT)) for file in found))
