"""What each result should be made from and by, by this config and this tree."""

from functools import cache
from pathlib import PurePath

from pseudorigid.sweep import grid

from ..records import sources
from ..records.build_spec import BuildSpec
from . import paths
from .schema import study as parts
from .schema.kinds import KINDS
from .schema.stages import STAGES

_OWN = (*paths.PUBLISHED, "study", "sweep")  # folders whose names go without saying


@cache
def _code(*modules):
    return sources.source_files(*modules)


def _spec(result, name, step, config, program, *, given=None, modules=(), inputs=()):
    """The BuildSpec of a result that the scene, sweep or part of the study `name` has."""
    folder = PurePath(result).parts[1]
    scene = name if folder in _OWN else f"{folder}/{name}"
    code = _code(f"pipeline.jobs.{program}", *modules)
    return BuildSpec(result, scene, step, config, program, given, code, list(inputs))


def _drawing(result, name, config, module, inputs):
    step = f"drawing {PurePath(result).suffix[1:]}"
    modules = [f"pseudorigid.figures.{module}"]
    return _spec(result, name, step, config, "draw", given=module, modules=modules, inputs=inputs)


def of_scenes(variants, variant=paths.PAPER) -> dict[str, BuildSpec]:
    """Each result of a variant's scenes, from the root, after those that it is made from."""
    return _of_scenes(variants, [variant])


def _of_scenes(variants, names) -> dict[str, BuildSpec]:
    """Each result of the scenes of some variants, after those that it is made from."""
    artifact_paths, found = paths.artifact_paths(variants), {}
    for variant, (scene, block) in ((v, item) for v in names for item in variants[v].items()):
        for stage, parameters in paths.stages(block).items():
            path, maker = artifact_paths[variant, scene, stage], STAGES[stage].maker(parameters)
            more = {"given": maker, "modules": maker[:1]}
            more["inputs"] = [artifact_paths[variant, scene, name] for name in STAGES[stage].inputs]
            found[path] = _spec(path, scene, stage, parameters, "stage", **more)
        kind = block["picture"]
        inputs = [artifact_paths[variant, scene, stage] for stage in KINDS[kind].stages]
        for extension in block["formats"]:
            path = paths.drawn(scene, extension, variant)
            found[path] = _drawing(path, scene, paths.drawing(block), f"kinds.{kind}", inputs)
    return found


def with_dependencies(build_specs, wanted) -> list[str]:
    """The results `wanted` and all that they are made from, each after its inputs."""
    found = {}
    for path in wanted:
        inputs = [used for used in build_specs[path].inputs if used in build_specs]
        found |= dict.fromkeys([*with_dependencies(build_specs, inputs), path])
    return list(found)


def of_variants(variants) -> dict[str, BuildSpec]:
    """Each result of all variants, which share some."""
    return _of_scenes(variants, variants)


def of_all(checked) -> dict[str, BuildSpec]:
    """Each result that a checked config can make, likewise."""
    variants = checked["variants"]
    found = of_variants(variants) | of_study(variants) | of_sweeps(checked["sweeps"])
    return found | of_derivations(checked)


def of_derivations(checked) -> dict[str, BuildSpec]:
    """The result of computer algebra on the paper's formulas, at the ball and energy of fig2."""
    if "fig2" not in checked["scenes"]:
        return {}
    block = {"ball": checked["ball"], "energy": checked["scenes"]["fig2"]["energy"]}
    maker = "pseudorigid.proofs.derivations", "derivations"
    more = {"given": maker, "modules": maker[:1]}
    path = paths.DERIVATIONS
    return {path: _spec(path, "claims", "derivations", block, "stage", **more)}


def of_study(variants) -> dict[str, BuildSpec]:
    """Each result of the study, likewise."""
    scenes, artifact_paths = variants[paths.PAPER], paths.artifact_paths(variants)
    found = {}
    for part in (*parts.FIXED, *parts.MEASURED):
        path, taken = parts.data(part), parts.artifacts(part, scenes, artifact_paths)
        more = {"given": taken, "modules": parts.modules(part)}
        more["inputs"] = sorted({file for *_, file in taken})
        found[path] = _spec(path, part, "data", parts.block(part, scenes), "study", **more)
    for chart in parts.CHARTS:
        path, data = parts.drawn(chart), parts.data(parts.CHARTS[chart][0])
        found[path] = _drawing(path, chart, parts.drawing(chart), "study", [data])
    return found


def of_sweeps(sweeps) -> dict[str, BuildSpec]:
    """Each block, dataset and picture of the sweeps, likewise."""
    found = {}
    for name, sweep in sweeps.items():
        blocks, data = paths.block_files(name, sweep), paths.sweep_dataset(name)
        for i, path in enumerate(blocks):
            found[path] = _spec(path, name, f"block {i}", grid.block(sweep, i), "sweep")
        found[data] = _spec(data, name, "data", grid.whole(sweep), "sweep", inputs=blocks)
        for path in paths.sweep_pictures(name, sweep):
            found[path] = _drawing(path, name, sweep, "atlas", [data])
    return found
