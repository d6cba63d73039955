"""Comparison of two variants, figure by figure: ./reproduce compare A B.

Nothing is computed here: both variants must have their results.
"""

from collections.abc import Iterator, Sequence
from contextlib import suppress
from pathlib import Path

import xarray as xr

from ...config import Config, paths
from ...config.build_specs import build_specs
from ...config.schema.scene import Picture
from ...records.artifacts import load
from ...records.differences import brief, differing_keys
from ...records.pictures import pixels
from ..freshness import CURRENT, Freshness
from . import cycles, picture, summaries


def compare(root: Path, checked: Config, names: Sequence[str], scenes: Sequence[str]) -> None:
    """Print what differs between two variants and save their figures side by side."""
    variants, left_out = checked.variants, checked.left_out
    files = paths.artifact_paths(variants)
    freshness = Freshness(root, build_specs(checked, names))
    print(" | ".join(names))
    print(f"(a periodic orbit further than {cycles.REACH:g} section radii away counts as another)")
    for scene in scenes:
        blocks = [variants[name][scene] for name in names if scene in variants[name]]
        both = len(blocks) == len(names)
        drawings = {name: paths.drawn(scene, "png", name) for name in names}
        states = {
            name: freshness.state(path) if scene in variants[name] else left_out[name][scene]
            for name, path in drawings.items()
        }
        lines = [*_config_differences(*blocks)] if both else []
        lines += [f"{name}: {state}" for name, state in states.items() if state != CURRENT]
        for stage in paths.stages(blocks[0]) if both else ():
            results = [files[name, scene, stage] for name in names]
            if all(freshness.state(result) == CURRENT for result in results):
                first, second = (load(root / result) for result in results)
                texts = _stage_differences(stage, first, second, names)
                lines += [f"{'' if i else stage:10}  {text}" for i, text in enumerate(texts)]
        image = root / f"results/compare/{'..'.join(names)}/{scene}.png"
        if CURRENT in states.values():
            present = {n: pixels(root / p) for n, p in drawings.items() if states[n] == CURRENT}
            axes = ""
            if len(present) == 2:
                stages = blocks[0].stages
                data = [[load(root / files[n, scene, stage]) for stage in stages] for n in names]
                images, axes = picture.on_same_axes(blocks, data)
                present = dict(zip(names, images, strict=True))
            picture.side_by_side({name: present.get(name) for name in names}, image)
            lines.append(f"side by side{axes}: {image.relative_to(root)}")
        else:
            with suppress(OSError):
                image.unlink()  # left by an earlier comparison
        print(f"\n{scene}", *(f"  {line}" for line in lines), sep="\n")


def _config_differences(first: Picture, second: Picture) -> Iterator[str]:
    """Yield a line for each key of the config that differs, except derived axes."""
    before, after = (paths.drawing(block) | {"axes": None} for block in (first, second))
    keys = differing_keys(before, after)
    yield from [f"{key}: {brief(a)} | {brief(b)}" for key, a, b in keys] or ["the same config"]


def _stage_differences(
    stage: str, first: xr.Dataset, second: xr.Dataset, names: Sequence[str]
) -> list[str]:
    """Describe how the two datasets of a stage differ."""
    if stage == "periodic":
        return cycles.table(first, second, names)
    lines = [summaries.norms(first, second)]
    lines += summaries.orbits(first, second) if stage == "orbits" else []
    return lines + (summaries.exponents(first, second, names) if stage == "lyapunov" else [])
