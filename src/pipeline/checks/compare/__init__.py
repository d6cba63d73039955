"""Comparison of two variants, figure by figure: ./reproduce compare A B.

Nothing is computed here: both variants must have their results.
"""

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import xarray as xr

from ...config import paths
from ...config.paths import Variants
from ...config.schema.fields import YamlMapping
from ...records.artifacts import load
from ...records.differences import brief, differing_keys
from . import cycles, picture, summaries


def compare(
    root: Path,
    variants: Variants,
    names: Sequence[str],
    absent: Sequence[Mapping[str, str]],
    scenes: Sequence[str],
) -> None:
    """Print what differs between two variants and save their figures side by side.

    `absent` has, for each of the two, scene -> why its figure cannot exist.
    """
    artifact_paths = paths.artifact_paths(variants)
    print(f"{names[0]} | {names[1]}")
    print(f"(a periodic orbit further than {cycles.REACH:g} section radii away counts as another)")
    for scene in scenes:
        blocks = [variants[name][scene] for name in names]
        reasons = {n: why[scene] for n, why in zip(names, absent, strict=True) if scene in why}
        lines = [*_config_differences(*blocks)]
        lines += [f"cannot exist in {name}: {reason}" for name, reason in reasons.items()]
        for stage in paths.stages(blocks[0]):
            if stage == "periodic" or not reasons:
                first, second = (load(root / artifact_paths[name, scene, stage]) for name in names)
                texts = _stage_differences(stage, first, second, names)
                lines += [f"{'' if i else stage:10}  {text}" for i, text in enumerate(texts)]
        image = root / f"results/compare/{names[0]}..{names[1]}/{scene}.png"
        if len(reasons) == 2:
            image.unlink(missing_ok=True)
        else:
            drawn = {name: root / paths.drawn(scene, "png", name) for name in names}
            picture.side_by_side(drawn | dict.fromkeys(reasons), image)
            lines.append(f"side by side: {image.relative_to(root)}")
        print(f"\n{scene}", *(f"  {line}" for line in lines), sep="\n")


def _config_differences(first: YamlMapping, second: YamlMapping) -> Iterator[str]:
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
