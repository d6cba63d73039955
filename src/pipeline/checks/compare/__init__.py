"""Comparison of two variants, figure by figure: ./reproduce compare A B.

Nothing is computed here: both variants must have their results.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path

import xarray as xr

from ...config import paths
from ...config.paths import Variants
from ...config.schema.fields import YamlMapping
from ...records.artifacts import canonical_json, load
from ...records.differences import brief, differing_keys
from . import cycles, picture, summaries

Pair = tuple[xr.Dataset, xr.Dataset]  # the datasets of a stage of both variants


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
    blocks = {scene: [variants[name][scene] for name in names] for scene in scenes}

    def data(scene: str, stage: str) -> Pair:
        first, second = (load(root / artifact_paths[name, scene, stage]) for name in names)
        return first, second

    print(f"{names[0]} | {names[1]}")
    for scene, pair in blocks.items():
        reasons = {
            name: why[scene] for name, why in zip(names, absent, strict=True) if scene in why
        }
        lines = [*_config_differences(*pair)]
        lines += [f"cannot exist in {name}: {reason}" for name, reason in reasons.items()]
        for stage in paths.stages(pair[0]) if not reasons else ():
            if stage != "periodic":
                both = data(scene, stage)
                texts = [summaries.norms(*both)]
                texts += summaries.orbits(*both) if stage == "orbits" else []
                lines += [f"{'' if i else stage:10}  {text}" for i, text in enumerate(texts)]
        image = root / f"results/compare/{names[0]}..{names[1]}/{scene}.png"
        if len(reasons) == 2:
            image.unlink(missing_ok=True)
        else:
            drawn = {name: root / paths.drawn(scene, "png", name) for name in names}
            picture.side_by_side(drawn | dict.fromkeys(reasons), image)
            lines.append(f"side by side: {image.relative_to(root)}")
        print(f"\n{scene}", *(f"  {line}" for line in lines), sep="\n")
    _print_periodic_orbits(blocks, names, data)
    for scene, (block, _) in blocks.items():
        if "lyapunov" in paths.stages(block):
            print(
                f"\nLyapunov exponents of {scene}: mean over its orbits ± their standard deviation"
            )
            lines = summaries.exponents(*data(scene, "lyapunov"), names)
            print(*(f"  {line}" for line in lines), sep="\n")


def _config_differences(first: YamlMapping, second: YamlMapping) -> Iterator[str]:
    """Yield a line for each key of the config that differs, except derived axes."""
    before, after = (paths.drawing(block) | {"axes": None} for block in (first, second))
    keys = differing_keys(before, after)
    yield from [f"{key}: {brief(a)} | {brief(b)}" for key, a, b in keys] or ["the same config"]


def _print_periodic_orbits(
    blocks: Mapping[str, list[YamlMapping]],
    names: Sequence[str],
    data: Callable[[str, str], Pair],
) -> None:
    """Print what became of the periodic orbits, once for all scenes with the same ones."""
    groups: dict[str, list[str]] = {}
    for scene, pair in blocks.items():
        if "periodic" in paths.stages(pair[0]):
            key = canonical_json([paths.stages(block)["periodic"] for block in pair])
            groups.setdefault(key, []).append(scene)
    if groups:
        far = f"an orbit further than {cycles.REACH:g} away counts as another"
        print(f"\nPeriodic orbits, and how far in section radii ({far})")
    for scenes in groups.values():
        lines = cycles.table(*data(scenes[0], "periodic"), names)
        print(f"  {', '.join(scenes)}", *(f"    {line}" for line in lines), sep="\n")
