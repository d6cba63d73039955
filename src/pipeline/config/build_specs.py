"""Build specifications: what each result has to be made from, by the config and the sources."""

from collections.abc import Iterable, Iterator, Mapping
from functools import cache
from pathlib import PurePath

from ..declaration import Stage, imported, parts
from ..records import sources
from ..records.build_spec import BuildSpec
from . import paths
from .paths import MAIN, ArtifactPaths, Config
from .schema.scene import Picture
from .schema.sets import SETS
from .schema.stages import STAGES, function_of

_source_files = cache(sources.source_files)


def build_specs(config: Config, names: Iterable[str] | None = None) -> dict[str, BuildSpec]:
    """Specify each result of all sets and variants, or of some; inputs come first.

    Variants share stages of equal parameters.
    """
    specs: dict[str, BuildSpec] = {}
    artifact_paths = paths.artifact_paths(config.variants)
    for variant in config.variants if names is None else names:
        for scene in config.variants[variant]:
            for spec in _of_scene(config, artifact_paths, variant, scene):
                specs.setdefault(spec.result, spec)
    return specs


def _of_scene(
    config: Config, artifact_paths: ArtifactPaths, variant: str, name: str
) -> Iterator[BuildSpec]:
    """Yield the specifications of a scene's datasets and drawings."""
    scene = config.variants[variant][name]
    for stage, parameters in paths.stages(scene).items():
        path, declared = artifact_paths[variant, name, stage], STAGES[stage]
        label, step, block = _label(path, name), stage, parameters
        inputs = [artifact_paths[variant, name, used] for used in declared.inputs]
        if declared.main:
            of_main = {(s, st): p for (v, s, st), p in artifact_paths.items() if v == MAIN}
            more, others = imported(declared.main)(config.scenes, of_main)
            block = parameters | more | {"inputs": [*others]}
            inputs += others.values()
        if declared.blocks:
            blocks = [*_of_blocks(scene, declared, path, label)]
            yield from blocks
            inputs, step = [each.result for each in blocks], "data"
        function = function_of(stage, scene)
        files = _files("stage", function, declared.reads.format(**parameters))
        yield BuildSpec(path, label, step, block, "stage", function, files, inputs)
    inputs = [artifact_paths[variant, name, stage] for stage in scene.stages]
    for extension in scene.formats:
        path, step = paths.drawn(name, extension, variant), f"drawing {extension}"
        label, block = _label(path, name), paths.drawing(scene)
        files = _files("draw", scene.drawn_by)
        yield BuildSpec(path, label, step, block, "draw", scene.drawn_by, files, inputs)


def _of_blocks(scene: Picture, stage: Stage, path: str, label: str) -> Iterator[BuildSpec]:
    """Yield the specifications of the blocks of a stage's dataset."""
    files = _files("stage", stage.of_block)
    for i, block in enumerate(imported(stage.blocks)(scene.as_mapping())):
        result = paths.block_path(path, i)
        yield BuildSpec(result, label, f"block {i}", block, "stage", stage.of_block, files, [])


def _label(path: str, scene: str) -> str:
    """Return a scene's name in messages, with the first variant that has a result of it."""
    folder = PurePath(path).parts[1]
    return scene if folder in SETS else f"{folder}/{scene}"


def _files(program: str, function: str, data_file: str = "") -> list[str]:
    """Return the files that decide what a program makes with a function module.function.

    They include the data files that the function's modules can read, or of these `data_file` alone.
    """
    files = _source_files(f"pipeline.jobs.{program}", function.rpartition(".")[0])
    read = [each.reads.items() for each in parts().values()]
    patterns = [pattern for items in read for module, pattern in items if module in files]
    patterns = [data_file] if data_file else patterns
    data = [file for pattern in patterns for file in sources.ROOT.glob(pattern)]
    return files + sorted(str(file.relative_to(sources.ROOT)) for file in data)


def with_dependencies(build_specs: Mapping[str, BuildSpec], wanted: Iterable[str]) -> list[str]:
    """Return the results `wanted` and all that they are made from, each after its inputs."""
    results: dict[str, None] = {}
    for path in wanted:
        inputs = [used for used in build_specs[path].inputs if used in build_specs]
        results |= dict.fromkeys([*with_dependencies(build_specs, inputs), path])
    return list(results)
