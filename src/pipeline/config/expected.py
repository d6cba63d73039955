"""What each result should have been made from, by this config and this tree."""

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
    serves = places.served(variants)
    found = {}
    for scene, block in variants[variant].items():
        for stage, parameters in places.stages(block).items():
            inputs = [serves[variant, scene, name] for name in STAGES[stage].inputs]
            path = serves[variant, scene, stage]
            found[path] = Expected(parameters, places.stage_code(stage), inputs)
        kind = block["picture"]
        inputs = [serves[variant, scene, stage] for stage in KINDS[kind].stages]
        for extension in block["formats"]:
            path = places.drawn(scene, extension, variant)
            found[path] = Expected(places.drawing(block), places.drawing_code(kind), inputs)
    return found


def of_variants(variants) -> dict[str, Expected]:
    """The same of every variant: they share some."""
    return {path: made for name in variants for path, made in of_scenes(variants, name).items()}


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
        code = sources.code("chart.py")
        found[parts.drawn(chart)] = Expected(parts.drawing(chart), code, [data])
    return found


def of_sweeps(sweeps) -> dict[str, Expected]:
    """Each block, dataset and picture of the sweeps, likewise."""
    found = {}
    for name, sweep in sweeps.items():
        blocks, data = places.block_files(name, sweep), places.sweep_dataset(name)
        code = sources.code("sweep_block.py")
        for i, path in enumerate(blocks):
            found[path] = Expected(grid.block(sweep, i), code)
        found[data] = Expected(grid.whole(sweep), sources.code("sweep_join.py"), blocks)
        for path in places.sweep_pictures(name):
            found[path] = Expected(sweep, sources.code("atlas.py"), [data])
    return found
