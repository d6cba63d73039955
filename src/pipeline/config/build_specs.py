"""Build specifications: what each result has to be made from, by the config and the sources."""

from collections.abc import Iterable, Iterator, Mapping
from fnmatch import fnmatch
from functools import cache
from pathlib import PurePath

from ..declaration import extensions, imported
from ..records import sources
from ..records.build_spec import BuildSpec
from . import paths
from .paths import PAPER, Config, Variants
from .schema.fields import YamlMapping
from .schema.scene import Picture
from .schema.sets import SETS
from .schema.stages import STAGES, function_of

_source_files = cache(sources.source_files)


def build_specs(config: Config, names: Iterable[str] | None = None) -> dict[str, BuildSpec]:
    """Specify each result of all sets and variants, or of some; inputs come first.

    Variants share stages of equal parameters.
    """
    variants, specs = config.variants, dict[str, BuildSpec]()
    artifact_paths = paths.artifact_paths(variants)
    for variant in variants if names is None else names:
        for scene, block in variants[variant].items():
            for spec in _of_scene(variants, artifact_paths, variant, scene, block):
                specs.setdefault(spec.result, spec)
    return specs


def _of_scene(
    variants: Variants,
    artifact_paths: Mapping[tuple[str, str, str], str],
    variant: str,
    scene: str,
    block: Picture,
) -> Iterator[BuildSpec]:
    """Yield the specifications of a scene's datasets and drawings."""

    def named(path: str) -> str:
        folder = PurePath(path).parts[1]  # of the first variant with this result
        return scene if folder in SETS else f"{folder}/{scene}"

    for stage, parameters in paths.stages(block).items():
        path, declared = artifact_paths[variant, scene, stage], STAGES[stage]
        inputs = [artifact_paths[variant, scene, name] for name in declared.inputs]
        label = named(path)
        config, step = parameters, stage
        if declared.paper:
            own = {(s, st): p for (v, s, st), p in artifact_paths.items() if v == PAPER}
            more, others = imported(declared.paper)(variants[PAPER], own)
            config = parameters | more | {"inputs": [*others]}
            inputs += others.values()
        if declared.parts:
            blocks = imported(declared.parts)(block.as_mapping())
            inputs = [paths.part_path(path, i) for i in range(len(blocks))]
            for i, part in enumerate(blocks):
                files = _files("stage", declared.part)
                step = f"block {i}"
                yield BuildSpec(inputs[i], label, step, part, "stage", declared.part, files, [])
            step = "data"
        function = function_of(stage, block)
        files = _without_other_data(_files("stage", function), declared.reads, parameters)
        yield BuildSpec(path, label, step, config, "stage", function, files, inputs)
    inputs = [artifact_paths[variant, scene, stage] for stage in block.stages]
    for extension in block.formats:
        path, step = paths.drawn(scene, extension, variant), f"drawing {extension}"
        files, config = _files("draw", block.drawn_by), paths.drawing(block)
        yield BuildSpec(path, named(path), step, config, "draw", block.drawn_by, files, inputs)


def _files(program: str, function: str) -> list[str]:
    """Return the files that decide what a program makes with a function module.function."""
    return _source_files(f"pipeline.jobs.{program}", function.rpartition(".")[0])


def _without_other_data(files: list[str], read: str, parameters: YamlMapping) -> list[str]:
    """Return source files without the data files that a stage could read but does not.

    `read` is the stage's own data file as a template of its parameters, empty if it reads all.
    """
    patterns = [p for extension in extensions().values() for p in extension.reads.values()]
    if not read:
        return files
    own = read.format(**parameters)
    return [f for f in files if f == own or not any(fnmatch(f, pattern) for pattern in patterns)]


def with_dependencies(build_specs: Mapping[str, BuildSpec], wanted: Iterable[str]) -> list[str]:
    """Return the results `wanted` and all that they are made from, each after its inputs."""
    results: dict[str, None] = {}
    for path in wanted:
        inputs = [used for used in build_specs[path].inputs if used in build_specs]
        results |= dict.fromkeys([*with_dependencies(build_specs, inputs), path])
    return list(results)
