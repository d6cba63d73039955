"""Comparison of two variants, figure by figure: ./reproduce compare A B.

Nothing is computed here: both variants must have their results.
"""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

import xarray as xr

from ...config import paths
from ...config.paths import Variants
from ...config.schema.fields import YamlMapping
from ...records.artifacts import canonical_json, load
from ...records.differences import brief, differing_keys
from . import cycles, exponents, norms, orbits, picture

Pair = tuple[xr.Dataset, xr.Dataset]  # the datasets of a stage of both variants


def compare(
    root: Path,
    variants: Variants,
    names: Sequence[str],
    absent: Sequence[Mapping[str, str]],
    scenes: Sequence[str],
    everything: bool,
) -> None:
    """Print what differs between two variants and save their figures side by side.

    Parameters
    ----------
    root : Path
        The project's folder.
    variants : dict
        The checked variants of the config.
    names : sequence of str
        Names of the two variants.
    absent : sequence of mappings
        For each of the two: scene -> why its figure cannot exist.
    scenes : sequence of str
        The scenes to compare.
    everything : bool
        Print a line for each variable and each orbit that differs, not one for each stage.
    """
    artifact_paths = paths.artifact_paths(variants)
    blocks = {scene: [variants[name][scene] for name in names] for scene in scenes}
    stages = {scene: paths.stages(pair[0]) for scene, pair in blocks.items()}

    def data(scene: str, stage: str) -> Pair:
        first, second = (load(root / artifact_paths[name, scene, stage]) for name in names)
        return first, second

    print(f"{names[0]} | {names[1]}")
    for scene in scenes:
        print(f"\n{scene}")
        for line in _config_differences(*blocks[scene]):
            print(f"  {line}")
        reasons = [reasons_of_one.get(scene) for reasons_of_one in absent]
        for name, reason in zip(names, reasons, strict=True):
            if reason:
                print(f"  cannot exist in {name}: {reason}")
        for stage in stages[scene] if not any(reasons) else ():
            if stage != "periodic":
                lines = _stage_differences(stage, data(scene, stage), names, everything)
                for i, line in enumerate(lines):
                    print(f"  {'' if i else stage:10}  {line}")
        image = root / f"results/compare/{names[0]}..{names[1]}/{scene}.png"
        if all(reasons):
            image.unlink(missing_ok=True)
            continue
        drawings = [
            None if reason else root / paths.drawn(scene, "png", name)
            for name, reason in zip(names, reasons, strict=True)
        ]
        picture.side_by_side(drawings, names, image)
        print(f"  side by side: {image.relative_to(root)}")
    _print_periodic_orbits(blocks, names, data)
    for scene in scenes:
        if "lyapunov" in stages[scene]:
            quantity = "mean over its orbits ± their standard deviation"
            print(f"\nLyapunov exponents of {scene}: {quantity}")
            for line in exponents.table(*data(scene, "lyapunov"), names):
                print(f"  {line}")


def _stage_differences(stage: str, pair: Pair, names: Sequence[str], everything: bool) -> list[str]:
    """Describe how the two datasets of a stage differ."""
    lines = norms.table(*pair, names) if everything else [norms.summary(*pair, names)]
    if stage == "orbits":
        lines += orbits.table(*pair) if everything else orbits.summary(*pair)
    return lines


def _config_differences(first: YamlMapping, second: YamlMapping) -> list[str]:
    """Return a line for each key of the config that differs, except derived axes."""
    lines = [
        f"{key}: {brief(before)} | {brief(after)}"
        for key, before, after in differing_keys(paths.drawing(first), paths.drawing(second))
        if key != "axes"
    ]
    return lines or ["the same config"]


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
        print(f"  {', '.join(scenes)}")
        for line in cycles.table(*data(scenes[0], "periodic"), names):
            print(f"    {line}")
