"""Comparison of variants, figure by figure: ./reproduce compare A B, or a range.

Nothing is computed here: the variants must have their results.
"""

import csv
import io
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from matplotlib.figure import Figure

from pipeline.checks.quantities import measured
from pipeline.config import Config
from pipeline.config.results import drawing, drawn, stage_parameters
from pipeline.records.artifacts import load
from pipeline.records.differences import brief, differing_keys
from pipeline.records.files import write_whole
from pipeline.records.provenance import CURRENT, Freshness

from . import datasets, picture, quantities


def compare(root: Path, config: Config, names: Sequence[str], scenes: Sequence[str]) -> None:
    """Print what differs between two variants in some scenes, and save figures side by side."""
    comparison, labels = _Comparison(root, config, names), {name: name for name in names}
    print(" | ".join(names))
    print(f"(a periodic orbit over {datasets.REACH:g} section radii away counts as another)")
    for scene in scenes:
        image = root / f"results/compare/{'..'.join(names)}/{scene}.png"
        image.unlink(missing_ok=True)  # of an earlier comparison
        lines = [*comparison.lines(scene), *comparison.save(scene, image, labels)]
        print(f"\n{scene}", *(f"  {line}" for line in lines), sep="\n")


def over_range(root: Path, config: Config, name: str, scenes: Sequence[str]) -> None:
    """Print what the variants of a range report, and save it as text, as CSV and in pictures."""
    of, folder = config.ranges[name], root / "results/compare" / name
    rows: list[Sequence[object]] = [quantities.COLUMNS]
    comparison = _Comparison(root, config, [m for m in of.members if m in config.variants])
    faulty, lines = [m for m in of.members if m in config.faulty], [f"{name}: {of.path}"]
    lines += [f"{member}: not made, see the mistake above" for member in faulty]
    labels = {m: f"{of.path.rpartition('.')[2]} = {value}" for m, value in of.members.items()}
    for image in folder.glob("*.png"):
        image.unlink()  # of an earlier comparison
    for scene in scenes:
        states = comparison.states(scene)
        current = [member for member, state in states.items() if state == CURRENT]
        reported = {member: measured(root, config, member, scene) for member in current}
        rows += quantities.rows(of, scene, reported)
        found = [*quantities.table(of, reported)] if reported else []
        curves = quantities.curves(of, reported)
        found += comparison.save(scene, folder / f"{scene}.png", labels, curves)
        found += [f"{m}: {state}" for m, state in states.items() if m not in current]
        lines += ["", scene, *(f"  {line}" for line in found)]
    csv.writer(table := io.StringIO(), lineterminator="\n").writerows(rows)
    for suffix, text in {"txt": "\n".join([*lines, ""]), "csv": table.getvalue()}.items():
        write_whole(folder / f"quantities.{suffix}", text)
        lines.append(f"results/compare/{name}/quantities.{suffix}")
    print(*lines, sep="\n")


class _Comparison:
    """Comparison of variants, given by their names, one scene at a time."""

    def __init__(self, root: Path, config: Config, names: Sequence[str]) -> None:
        self.root, self.config, self.names = root, config, names
        self.freshness = Freshness(root, config.build_specs(names))

    def states(self, scene: str) -> dict[str, str]:
        """Map each variant to the state of its figure, or why it leaves the scene out."""
        left_out = {name: self.config.left_out.get(name, {}).get(scene) for name in self.names}
        state = self.freshness.state
        return {n: why or state(drawn(scene, "png", n)) for n, why in left_out.items()}

    def lines(self, scene: str) -> Iterator[str]:
        """Yield lines on what differs in a scene between two variants."""
        variants = [self.config.variants[name] for name in self.names]
        blocks = [scenes[scene] for scenes in variants if scene in scenes]
        in_both = len(blocks) == 2
        if in_both:  # axes may differ
            before, after = (drawing(block) | {"axes": None} for block in blocks)
            keys = [f"{k}: {brief(a)} | {brief(b)}" for k, a, b in differing_keys(before, after)]
            yield from keys or ["the same config"]
        yield from (f"{n}: {state}" for n, state in self.states(scene).items() if state != CURRENT)
        for stage in stage_parameters(blocks[0]) if in_both else ():
            results = [self.config.datasets[name, scene, stage] for name in self.names]
            if all(self.freshness.state(result) == CURRENT for result in results):
                first, second = (load(self.root / result) for result in results)
                for i, text in enumerate(datasets.differences(stage, first, second, self.names)):
                    yield f"{'' if i else stage:10}  {text}"

    def save(
        self, scene: str, image: Path, labels: Mapping[str, str], curves: Figure | None = None
    ) -> Iterator[str]:
        """Save the figures of a scene side by side below their labels, and yield where."""
        if current := [name for name, state in self.states(scene).items() if state == CURRENT]:
            blocks, data = [self.config.variants[name][scene] for name in current], []
            for name in current:
                files = [self.config.datasets[name, scene, stage] for stage in blocks[0].stages]
                data.append([load(self.root / file) for file in files])
            drawings, axes = picture.on_same_axes(blocks, data)
            known = dict(zip(current, drawings, strict=True))
            named = {label: known.get(name) for name, label in labels.items()}
            picture.side_by_side(named, image, curves)
            where = image.relative_to(self.root)
            yield f"side by side{axes if len(current) > 1 else ''}: {where}"
