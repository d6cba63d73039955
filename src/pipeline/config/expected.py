"""What each result should have been made from, by this config and this tree."""

from functools import cache
from typing import NamedTuple

from pseudorigid.sweep import grid

from ..records import sources
from . import places
from .declared import study as parts
from .declared.kinds import KINDS
from .declared.stages import STAGES


class Expected(NamedTuple):
    """What makes a result: its block of config, the project's files, and earlier results."""

    config: dict
    sources: list[str]
    inputs: list[str] = []


def of_scenes(variants, variant=places.PAPER) -> dict[str, Expected]:
    """Each result of a variant's scenes, from the root, after those that it is made from."""
    return _of_scenes(variants, [variant])


def _of_scenes(variants, names) -> dict[str, Expected]:
    """Each result of the scenes of some variants, after those that it is made from."""
    serves, code, found = places.served(variants), cache(sources.code), {}
    for variant, (scene, block) in ((v, item) for v in names for item in variants[v].items()):
        for stage, parameters in places.stages(block).items():
            inputs = [serves[variant, scene, name] for name in STAGES[stage].inputs]
            files = code("stage.py", STAGES[stage].maker(parameters)[0])
            found[serves[variant, scene, stage]] = Expected(parameters, files, inputs)
        kind = block["picture"]
        files = code("draw.py", f"pseudorigid.figures.kinds.{kind}")
        inputs = [serves[variant, scene, stage] for stage in KINDS[kind].stages]
        for extension in block["formats"]:
            path = places.drawn(scene, extension, variant)
            found[path] = Expected(places.drawing(block), files, inputs)
    return found


def needed(expected, wanted) -> list[str]:
    """The results `wanted` and all that they are made from, each after its inputs."""
    found = {}
    for path in wanted:
        inputs = [used for used in expected[path].inputs if used in expected]
        found |= dict.fromkeys([*needed(expected, inputs), path])
    return list(found)


def of_variants(variants) -> dict[str, Expected]:
    """Each result of all variants, which share some."""
    return _of_scenes(variants, variants)


def of_all(checked) -> dict[str, Expected]:
    """Each result that a checked config can make, likewise."""
    variants = checked["variants"]
    return of_variants(variants) | of_study(variants) | of_sweeps(checked["sweeps"])


def of_study(variants) -> dict[str, Expected]:
    """Each result of the study, likewise."""
    scenes, serves = variants[places.PAPER], places.served(variants)
    found = {}
    for part in (*parts.FIXED, *parts.MEASURED):
        inputs = [path for *_, path in parts.artifacts(part, scenes, serves)]
        block = parts.block(part, scenes)
        found[parts.data(part)] = Expected(block, parts.code(part), sorted(set(inputs)))
    for chart in parts.CHARTS:
        data = parts.data(parts.CHARTS[chart][0])
        code = sources.code("draw.py", "pseudorigid.figures.study")
        found[parts.drawn(chart)] = Expected(parts.drawing(chart), code, [data])
    return found


def of_sweeps(sweeps) -> dict[str, Expected]:
    """Each block, dataset and picture of the sweeps, likewise."""
    found = {}
    for name, sweep in sweeps.items():
        blocks, data = places.block_files(name, sweep), places.sweep_dataset(name)
        code, drawn = sources.code("sweep.py"), sources.code("draw.py", "pseudorigid.figures.atlas")
        for i, path in enumerate(blocks):
            found[path] = Expected(grid.block(sweep, i), code)
        found[data] = Expected(grid.whole(sweep), code, blocks)
        for path in places.sweep_pictures(name, sweep):
            found[path] = Expected(sweep, drawn, [data])
    return found
