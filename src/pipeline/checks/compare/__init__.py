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


def compare(root: Path, config: Config, names: Sequence[str], scenes: Sequence[str]) -> None:
    """Print what differs between two variants in some scenes, and save figures side by side."""
    comparison = _Comparison(root, config, names)
    print(" | ".join(names))
    print(f"(a periodic orbit further than {cycles.REACH:g} section radii away counts as another)")
    for scene in scenes:
        print(f"\n{scene}", *(f"  {line}" for line in comparison.lines(scene)), sep="\n")


class _Comparison:
    """Comparison of two variants, given by their names, one scene at a time."""

    def __init__(self, root: Path, config: Config, names: Sequence[str]) -> None:
        self.root, self.config, self.names = root, config, names
        self.files = paths.artifact_paths(config.variants)
        self.freshness = Freshness(root, build_specs(config, names))

    def lines(self, scene: str) -> list[str]:
        """Return lines on what differs in a scene, and save its figures side by side."""
        variants = self.config.variants
        blocks = [variants[name][scene] for name in self.names if scene in variants[name]]
        # state of each figure, or why the variant leaves the scene out
        states = {
            name: self.freshness.state(paths.drawn(scene, "png", name))
            if scene in variants[name]
            else self.config.left_out[name][scene]
            for name in self.names
        }
        in_both = len(blocks) == len(self.names)
        current = [name for name in self.names if states[name] == CURRENT]
        lines = [*_config_differences(*blocks)] if in_both else []
        lines += [f"{name}: {state}" for name, state in states.items() if state != CURRENT]
        lines += self._data_differences(scene, blocks) if in_both else ()
        return [*lines, *self._side_by_side(scene, blocks, current)]

    def _data_differences(self, scene: str, blocks: Sequence[Picture]) -> Iterator[str]:
        """Yield lines on how the datasets of each stage differ, if both variants' are current."""
        for stage in paths.stages(blocks[0]):
            results = [self.files[name, scene, stage] for name in self.names]
            if all(self.freshness.state(result) == CURRENT for result in results):
                first, second = (load(self.root / result) for result in results)
                for i, text in enumerate(_stage_differences(stage, first, second, self.names)):
                    yield f"{'' if i else stage:10}  {text}"

    def _side_by_side(
        self, scene: str, blocks: Sequence[Picture], current: Sequence[str]
    ) -> Iterator[str]:
        """Save the figures of the `current` variants side by side, and yield a line on the file."""
        image = self.root / f"results/compare/{'..'.join(self.names)}/{scene}.png"
        if not current:
            with suppress(OSError):
                image.unlink()  # left by an earlier comparison
            return
        if len(current) == 2:
            stages = blocks[0].stages
            data = [
                [load(self.root / self.files[name, scene, stage]) for stage in stages]
                for name in self.names
            ]
            drawings, axes = picture.on_same_axes(blocks, data)
        else:
            (name,), axes = current, ""
            drawings = [pixels(self.root / paths.drawn(scene, "png", name))]
        present = dict(zip(current, drawings, strict=True))
        picture.side_by_side({name: present.get(name) for name in self.names}, image)
        yield f"side by side{axes}: {image.relative_to(self.root)}"


def _config_differences(first: Picture, second: Picture) -> Iterator[str]:
    """Yield a line for each key in which the blocks of a scene differ, except their axes."""
    before, after = (paths.drawing(block) | {"axes": None} for block in (first, second))
    keys = differing_keys(before, after)
    yield from [f"{key}: {brief(a)} | {brief(b)}" for key, a, b in keys] or ["the same config"]


def _stage_differences(
    stage: str, first: xr.Dataset, second: xr.Dataset, names: Sequence[str]
) -> list[str]:
    """Return lines on how the two datasets of a stage differ."""
    if stage == "periodic":
        return cycles.table(first, second, names)
    lines = [summaries.norms(first, second)]
    lines += summaries.orbits(first, second) if stage == "orbits" else []
    return lines + (summaries.exponents(first, second, names) if stage == "lyapunov" else [])
