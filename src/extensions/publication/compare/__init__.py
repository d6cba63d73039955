"""Comparison of variants, figure by figure: ./reproduce compare A B, or a range.

Nothing is computed here: the variants must have their results.
"""

from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from pathlib import Path

import pandas as pd
import xarray as xr

from pipeline.checks.quantities import measured
from pipeline.config import Config
from pipeline.config.results import drawing, drawn, stage_parameters
from pipeline.records.artifacts import load
from pipeline.records.differences import brief, differing_keys
from pipeline.records.files import write_whole
from pipeline.records.pictures import pixels
from pipeline.records.provenance import CURRENT, Freshness

from . import datasets, picture, quantities


def compare(root: Path, config: Config, names: Sequence[str], scenes: Sequence[str]) -> None:
    """Print what differs between two variants in some scenes, and save figures side by side."""
    comparison = _Comparison(root, config, names)
    reach = f"{datasets.REACH:g} section radii"
    print(" | ".join(names))
    print(f"(a periodic orbit further than {reach} away counts as another)")
    for scene in scenes:
        print(f"\n{scene}", *(f"  {line}" for line in comparison.lines(scene)), sep="\n")


def over_range(root: Path, config: Config, name: str, scenes: Sequence[str]) -> None:
    """Print what the variants of a range report, and save it as text, as CSV and in pictures."""
    of, folder, rows = config.ranges[name], root / "results/compare" / name, []
    made = [member for member in of.members if member in config.variants]
    freshness, lines = Freshness(root, config.build_specs(made)), [f"{name}: {of.path}"]
    lines += [f"{m}: not made, see the mistake above" for m in of.members if m not in made]
    for scene in scenes:
        states = _states(config, freshness, made, scene)
        current = {m: config.variants[m][scene] for m in made if states[m] == CURRENT}
        lines += ["", scene]
        image = folder / f"{scene}.png"
        image.unlink(missing_ok=True)  # left by an earlier comparison
        if current:
            reported = {member: measured(root, config, member, scene) for member in current}
            lines += [f"  {line}" for line in quantities.table(of, reported)]
            rows += quantities.rows(of, scene, reported)
            data = [
                [load(root / config.datasets[m, scene, stage]) for stage in block.stages]
                for m, block in current.items()
            ]
            drawings, axes = picture.on_same_axes([*current.values()], data)
            known = dict(zip(current, drawings, strict=True))
            last = of.path.rpartition(".")[2]
            named = {f"{last} = {value}": known.get(m) for m, value in of.members.items()}
            picture.side_by_side(named, image, quantities.curves(of, reported))
            lines.append(f"  side by side{axes}: {image.relative_to(root)}")
        lines += [f"  {member}: {states[member]}" for member in made if member not in current]
    table = pd.DataFrame(rows, columns=quantities.COLUMNS).to_csv(index=False, lineterminator="\n")
    files = {"txt": "\n".join([*lines, ""]), "csv": table}
    for suffix, text in files.items():
        write_whole(folder / f"quantities.{suffix}", text)
        lines.append(f"{(folder / 'quantities').relative_to(root)}.{suffix}")
    print(*lines, sep="\n")


def _states(
    config: Config, freshness: Freshness, names: Iterable[str], scene: str
) -> dict[str, str]:
    """Map each variant to the state of its figure, or why it leaves the scene out."""
    return {
        name: freshness.state(drawn(scene, "png", name))
        if scene in config.variants[name]
        else config.left_out[name][scene]
        for name in names
    }


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
        states = _states(self.config, self.freshness, self.names, scene)
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
