"""Build specifications: what each result has to be made from, by the config and the sources."""

from collections.abc import Iterable, Mapping
from functools import cache
from pathlib import PurePath
from typing import Any

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

_source_files = cache(sources.source_files)


def _spec(
    result: str,
    name: str,
    step: str,
    config: YamlMapping,
    program: str,
    inputs: Iterable[str] = (),
    given: Any = None,
    modules: Iterable[str] = (),
) -> BuildSpec:
    """Specify a result of the scene, sweep or part of the study that is called `name`."""
    folder = PurePath(result).parts[1]
    scene = name if folder in FOLDERS else f"{folder}/{name}"  # variants are named, others are not
    files = _source_files(f"pipeline.jobs.{program}", *modules)
    return BuildSpec(result, scene, step, config, program, given, files, list(inputs))


def _drawing(
    result: str, name: str, config: YamlMapping, module: str, inputs: Iterable[str]
) -> BuildSpec:
    """Specify a picture that a module of pseudorigid.figures draws."""
    step, modules = f"drawing {PurePath(result).suffix[1:]}", [f"pseudorigid.figures.{module}"]
    return _spec(result, name, step, config, "draw", inputs, module, modules)


def of_variants(variants: Variants, names: Iterable[str] | None = None) -> dict[str, BuildSpec]:
    """Specify each result of all variants, or of some. They share stages of equal parameters."""
    artifact_paths, specs = paths.artifact_paths(variants), {}
    chosen = variants if names is None else names
    for variant, (scene, block) in ((v, item) for v in chosen for item in variants[v].items()):
        for stage, parameters in paths.stages(block).items():
            path, function = artifact_paths[variant, scene, stage], STAGES[stage].maker(parameters)
            inputs = [artifact_paths[variant, scene, name] for name in STAGES[stage].inputs]
            specs[path] = _spec(
                path, scene, stage, parameters, "stage", inputs, function, function[:1]
            )
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
    if "fig2" in checked["scenes"]:
        block = {"ball": checked["ball"], "energy": checked["scenes"]["fig2"]["energy"]}
        path, module = paths.DERIVATIONS, "pseudorigid.proofs.derivations"
        given = module, "derivations"
        specs[path] = _spec(path, "claims", "derivations", block, "stage", (), given, [module])
    return specs | of_theorems()


def of_theorems() -> dict[str, BuildSpec]:
    """Specify the verdict on each theorem, which depends on its own certificate alone."""
    specs = {}
    for name in paths.THEOREMS:
        path, others = paths.theorem(name), {*paths.THEOREMS} - {name}
        spec = _spec(path, name, "theorem", {"theorem": name}, "theorem")
        left_out = {f"{paths.CERTIFICATES}/{other}.toml" for other in others}
        sources = [file for file in spec.sources if file not in left_out]
        specs[path] = spec._replace(sources=sources)
    return specs


def of_study(variants: Variants) -> dict[str, BuildSpec]:
    """Specify each dataset and chart of the study; inputs come first."""
    scenes, artifact_paths = variants[paths.PAPER], paths.artifact_paths(variants)
    external = ["pseudorigid.study.methods.scipy_events", "pseudorigid.study.methods.taylor"]
    modules = dict.fromkeys(parts.MEASURED, external) | {"verdicts": ["pseudorigid.study.verdicts"]}
    specs = {}
    for part in (*parts.FIXED, *parts.MEASURED):
        path, block = parts.data(part), parts.block(part, scenes)
        given = [  # the figures' own datasets that the part compares with
            (stage, scene, file)
            for (variant, scene, stage), file in artifact_paths.items()
            if variant == paths.PAPER and scene in block.get("scenes", ())
            if stage in ("periodic", "manifolds")
        ]
        inputs = sorted({file for *_, file in given})
        specs[path] = _spec(
            path, part, "data", block, "study", inputs, given, modules.get(part, ())
        )
    for chart, (part, *_) in parts.CHARTS.items():
        for path in (parts.drawn(chart, extension) for extension in parts.FORMATS):
            inputs = [parts.data(part)]
            specs[path] = _drawing(path, chart, parts.drawing(chart), "study", inputs)
    return specs


def of_sweeps(sweeps: YamlMapping) -> dict[str, BuildSpec]:
    """Specify each block, dataset and picture of the sweeps; inputs come first."""
    specs = {}
    for name, sweep in sweeps.items():
        blocks, data = paths.block_files(name, sweep), paths.sweep_dataset(name)
        for i, path in enumerate(blocks):
            specs[path] = _spec(path, name, f"block {i}", grid.block(sweep, i), "sweep")
        specs[data] = _spec(data, name, "data", grid.whole(sweep), "sweep", blocks)
        drawing = {key: sweep[key] for key in sweep if key not in ("block", "chains")}
        for path in paths.sweep_pictures(name, sweep):
            specs[path] = _drawing(path, name, drawing, "atlas", [data])
        if "chains" in sweep:
            config = {key: sweep[key] for key in ("k", "energy", "chains")}
            curves, path = paths.chains_dataset(name), paths.chains_picture(name)
            specs[curves] = _spec(curves, name, "chains", config, "chains")
            specs[path] = _drawing(path, name, config, "chains", [data, curves])
    return specs
