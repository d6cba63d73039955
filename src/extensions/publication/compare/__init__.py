"""Comparison of two variants, figure by figure: ./reproduce compare A B.

Nothing is computed here: both variants must have their results.
"""

from collections.abc import Iterator, Sequence
from contextlib import suppress
from pathlib import Path

import xarray as xr

from pipeline.config import Config
from pipeline.config.results import drawing, drawn, stage_parameters
from pipeline.records.artifacts import load
from pipeline.records.differences import brief, differing_keys
from pipeline.records.pictures import pixels
from pipeline.records.provenance import CURRENT, Freshness

from . import datasets, picture


def compare(root: Path, config: Config, names: Sequence[str], scenes: Sequence[str]) -> None:
    """Print what differs between two variants in some scenes, and save figures side by side."""
    comparison = _Comparison(root, config, names)
    reach = f"{datasets.REACH:g} section radii"
    print(" | ".join(names))
    print(f"(a periodic orbit further than {reach} away counts as another)")
    for scene in scenes:
        print(f"\n{scene}", *(f"  {line}" for line in comparison.lines(scene)), sep="\n")


class _Comparison:
    """Comparison of two variants, given by their names, one scene at a time."""

    def __init__(self, root: Path, config: Config, names: Sequence[str]) -> None:
        self.root, self.config, self.names = root, config, names
        self.freshness = Freshness(root, config.build_specs(names))

    def lines(self, scene: str) -> Iterator[str]:
        """Yield lines on what differs in a scene, and save its figures side by side."""
        given = {name: self.config.variants[name].get(scene) for name in self.names}
        blocks = [block for block in given.values() if block]
        in_both = len(blocks) == 2
        # state of each figure, or why the variant leaves the scene out
        states = {
            name: self.freshness.state(drawn(scene, "png", name))
            if block
            else self.config.left_out[name][scene]
            for name, block in given.items()
        }
        if in_both:  # axes may differ
            before, after = (drawing(block) | {"axes": None} for block in blocks)
            keys = [f"{k}: {brief(a)} | {brief(b)}" for k, a, b in differing_keys(before, after)]
            yield from keys or ["the same config"]
        yield from (f"{name}: {state}" for name, state in states.items() if state != CURRENT)
        for stage in stage_parameters(blocks[0]) if in_both else ():
            results = [self.config.datasets[name, scene, stage] for name in self.names]
            if all(self.freshness.state(result) == CURRENT for result in results):
                first, second = self._datasets(scene, stage)
                for i, text in enumerate(datasets.differences(stage, first, second, self.names)):
                    yield f"{'' if i else stage:10}  {text}"
        image = self.root / f"results/compare/{'..'.join(self.names)}/{scene}.png"
        drawings: dict[str, picture.Pixels | None] = dict.fromkeys(self.names)
        current, axes = [name for name in self.names if states[name] == CURRENT], ""
        if not current:
            with suppress(OSError):
                image.unlink()  # left by an earlier comparison
            return
        if len(current) == 2:
            data = zip(*(self._datasets(scene, stage) for stage in blocks[0].stages), strict=True)
            both, axes = picture.on_same_axes(blocks, [*data])
            drawings.update(zip(self.names, both, strict=True))
        else:
            drawings[current[0]] = pixels(self.root / drawn(scene, "png", current[0]))
        picture.side_by_side(drawings, image)
        yield f"side by side{axes}: {image.relative_to(self.root)}"

    def _datasets(self, scene: str, stage: str) -> list[xr.Dataset]:
        """Return the dataset of a stage in each variant."""
        return [load(self.root / self.config.datasets[name, scene, stage]) for name in self.names]
