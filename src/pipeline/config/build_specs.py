"""Build specifications: what each result has to be made from, by the config and the sources."""

from collections.abc import Iterable, Mapping
from functools import cache
from pathlib import PurePath

from pseudorigid.sweep import grid

from ..records import sources
from ..records.build_spec import BuildSpec
from . import paths
from .paths import Variants
from .schema import study as parts
from .schema.fields import YamlMapping
from .schema.kinds import KINDS
from .schema.published import FOLDERS
from .schema.stages import STAGES


@cache
def _source_files(*modules: str) -> list[str]:
    return sources.source_files(*modules)


def _spec(
    result: str,
    name: str,
    step: str,
    config: YamlMapping,
    program: str,
    *,
    given: object = None,
    modules: Iterable[str] = (),
    inputs: Iterable[str] = (),
) -> BuildSpec:
    """Specify a result of the scene, sweep or part of the study that is called `name`."""
    folder = PurePath(result).parts[1]
    scene = name if folder in FOLDERS else f"{folder}/{name}"  # variants are named, others are not
    files = _source_files(f"pipeline.jobs.{program}", *modules)
    return BuildSpec(result, scene, step, config, program, given, files, list(inputs))


def _drawing(
    result: str, name: str, config: YamlMapping, module: str, inputs: Iterable[str]
) -> BuildSpec:
    step = f"drawing {PurePath(result).suffix[1:]}"
    modules = [f"pseudorigid.figures.{module}"]
    return _spec(result, name, step, config, "draw", given=module, modules=modules, inputs=inputs)


def _computed(
    result: str,
    name: str,
    step: str,
    config: YamlMapping,
    function: tuple[str, str],
    inputs: Iterable[str] = (),
) -> BuildSpec:
    """Specify the dataset that a function, named with its module, computes."""
    modules = function[:1]
    return _spec(
        result, name, step, config, "stage", given=function, modules=modules, inputs=inputs
    )


def of_scenes(variants: Variants, variant: str = paths.PAPER) -> dict[str, BuildSpec]:
    """Specify each result of a variant's scenes, from its path; inputs come first."""
    return _of_scenes(variants, [variant])


def of_variants(variants: Variants) -> dict[str, BuildSpec]:
    """Specify each result of all variants. Variants share stages that have the same parameters."""
    return _of_scenes(variants, variants)


def _of_scenes(variants: Variants, names: Iterable[str]) -> dict[str, BuildSpec]:
    artifact_paths, specs = paths.artifact_paths(variants), {}
    for variant, (scene, block) in ((v, item) for v in names for item in variants[v].items()):
        for stage, parameters in paths.stages(block).items():
            path, function = artifact_paths[variant, scene, stage], STAGES[stage].maker(parameters)
            inputs = [artifact_paths[variant, scene, name] for name in STAGES[stage].inputs]
            specs[path] = _computed(path, scene, stage, parameters, function, inputs)
        kind = block["picture"]
        inputs = [artifact_paths[variant, scene, stage] for stage in KINDS[kind].stages]
        for extension in block["formats"]:
            path = paths.drawn(scene, extension, variant)
            specs[path] = _drawing(path, scene, paths.drawing(block), f"kinds.{kind}", inputs)
    return specs


def with_dependencies(build_specs: Mapping[str, BuildSpec], wanted: Iterable[str]) -> list[str]:
    """Return the results `wanted` and all that they are made from, each after its inputs."""
    results: dict[str, None] = {}
    for path in wanted:
        inputs = [used for used in build_specs[path].inputs if used in build_specs]
        results |= dict.fromkeys([*with_dependencies(build_specs, inputs), path])
    return list(results)


def of_all(checked: YamlMapping) -> dict[str, BuildSpec]:
    """Specify each result that a checked config can make; inputs come first."""
    variants = checked["variants"]
    specs = of_variants(variants) | of_study(variants) | of_sweeps(checked["sweeps"])
    return specs | of_derivations(checked)


def of_derivations(checked: YamlMapping) -> dict[str, BuildSpec]:
    """Specify the computer algebra on the paper's formulas, at the ball and energy of fig2."""
    if "fig2" not in checked["scenes"]:
        return {}
    block = {"ball": checked["ball"], "energy": checked["scenes"]["fig2"]["energy"]}
    function = "pseudorigid.proofs.derivations", "derivations"
    path = paths.DERIVATIONS
    return {path: _computed(path, "claims", "derivations", block, function)}


def of_study(variants: Variants) -> dict[str, BuildSpec]:
    """Specify each dataset and chart of the study; inputs come first."""
    scenes, artifact_paths = variants[paths.PAPER], paths.artifact_paths(variants)
    specs = {}
    for part in (*parts.FIXED, *parts.MEASURED):
        path, artifacts = parts.data(part), parts.artifacts(part, scenes, artifact_paths)
        inputs = sorted({file for *_, file in artifacts})
        specs[path] = _spec(
            path,
            part,
            "data",
            parts.block(part, scenes),
            "study",
            given=artifacts,
            modules=parts.modules(part),
            inputs=inputs,
        )
    for chart, (part, *_) in parts.CHARTS.items():
        path = parts.drawn(chart)
        specs[path] = _drawing(path, chart, parts.drawing(chart), "study", [parts.data(part)])
    return specs


def of_sweeps(sweeps: YamlMapping) -> dict[str, BuildSpec]:
    """Specify each block, dataset and picture of the sweeps; inputs come first."""
    specs = {}
    for name, sweep in sweeps.items():
        blocks, data = paths.block_files(name, sweep), paths.sweep_dataset(name)
        for i, path in enumerate(blocks):
            specs[path] = _spec(path, name, f"block {i}", grid.block(sweep, i), "sweep")
        specs[data] = _spec(data, name, "data", grid.whole(sweep), "sweep", inputs=blocks)
        for path in paths.sweep_pictures(name, sweep):
            specs[path] = _drawing(path, name, sweep, "atlas", [data])
    return specs
