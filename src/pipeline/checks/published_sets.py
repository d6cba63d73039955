"""The sets of published files that must keep their bytes, and what each is made from.

They are the figures of the paper, the pictures of claims, families and proofs, the study's charts
whose data are the same on every machine, and the atlas.
"""

from pathlib import Path
from typing import Any, NamedTuple

from pseudorigid.sweep import grid

from ..config import PAPER, build_specs, paths
from ..config.schema import study as parts
from ..config.schema.published import FOLDERS
from ..records.build_spec import BuildSpec

# Set -> what its files are called, and the command that makes them.
_SETS = {
    PAPER: ("figures", "./reproduce"),
    "claims": ("figures", "./reproduce claims"),
    "families": ("figures", "./reproduce families"),
    "proofs": ("figures", "./reproduce prove --pictures"),
    "study": ("charts", "./reproduce study"),
    "sweep": ("pictures", "./reproduce atlas"),
}
_Blocks = dict[str, dict[str, Any]]  # scene -> the config block that decides it
_Data = dict[str, dict[str, str]]  # scene -> stage -> the dataset that it is drawn from


class PublishedSet(NamedTuple):
    """A folder of published files and what makes them; all paths start at the project's root.

    The name of a published file is that of its scene and a suffix.
    """

    noun: str  # for its files
    folder: str
    results: str  # folder with the drawings and their data
    command: str  # makes them
    drawn: dict[str, str]  # name of a published file -> its drawing in results
    config: _Blocks
    data: _Data
    build_specs: dict[str, BuildSpec]  # every result
    measured: tuple[str, ...]  # published files without a checksum: they show times
    texts: tuple[str, ...]  # other files that the command writes
    on_request: bool  # made by a command of its own, not by every run

    def sources(self, scene: str) -> list[str]:
        """Return the project's files that decide a scene's figures."""
        drawn = [path for name, path in self.drawn.items() if Path(name).stem == scene]
        results = [*self.data[scene].values(), *drawn]
        return sorted({file for path in results for file in self.build_specs[path].sources})


def committed_sets(checked: dict[str, Any]) -> list[PublishedSet]:
    """Return all published sets of a checked config."""
    variants = checked["variants"]
    sets = [_figures(checked, name) for name in paths.PUBLISHED if variants[name]]
    return [*sets, _study(variants), _atlas(checked["sweeps"])]


def _set(
    group: str, config: _Blocks, data: _Data, specs: dict[str, BuildSpec], *measured: str
) -> PublishedSet:
    """Return the set with the drawings among these results."""
    noun, command = _SETS[group]
    drawn = {Path(path).name: path for path, spec in specs.items() if spec.program == "draw"}
    return PublishedSet(
        noun,
        FOLDERS[group],
        f"results/{group}",
        command,
        {name: path for name, path in drawn.items() if Path(name).suffix[1:] in paths.SHOWN},
        config,
        data,
        specs,
        measured,
        (paths.LEDGER, paths.LEDGER_DATA) if group == "claims" else (),
        group != PAPER,
    )


def _figures(checked: dict[str, Any], variant: str) -> PublishedSet:
    """Return the figures of the paper, or the pictures of claims, families or proofs."""
    variants, scenes = checked["variants"], checked["variants"][variant]
    config = {scene: paths.drawing(block) for scene, block in scenes.items()}
    data: _Data = {scene: {} for scene in scenes}
    for (name, scene, stage), path in paths.artifact_paths(variants).items():
        if name == variant:
            data[scene][stage] = path
    return _set(variant, config, data, build_specs.of_variants(variants, [variant]))


def _study(variants: paths.Variants) -> PublishedSet:
    """Return the study's charts of what is computed; charts of times are listed as measured."""
    specs = build_specs.of_study(variants)
    charts = {name: part for name, (part, *_) in parts.CHARTS.items() if part in parts.FIXED}
    fixed = {parts.data(part) for part in parts.FIXED} | {parts.drawn(name) for name in charts}
    config = {n: parts.drawing(n) | specs[parts.data(p)].config for n, p in charts.items()}
    data = {name: {part: parts.data(part)} for name, part in charts.items()}
    measured = [f"{name}.png" for name in parts.CHARTS if name not in charts]
    specs = {path: spec for path, spec in specs.items() if path in fixed}
    return _set("study", config, data, specs, *measured)


def _atlas(sweeps: dict[str, Any]) -> PublishedSet:
    """Return the pictures of the sweeps. A picture of chains is a scene of its own."""
    config = {name: grid.whole(sweep) for name, sweep in sweeps.items()}
    data = {name: {"sweep": paths.sweep_dataset(name)} for name in sweeps}
    for name, sweep in sweeps.items():
        if "chains" in sweep:
            scene = Path(paths.chains_picture(name)).stem
            config[scene] = grid.whole(sweep) | {"chains": sweep["chains"]}
            data[scene] = data[name] | {"chains": paths.chains_dataset(name)}
    return _set("sweep", config, data, build_specs.of_sweeps(sweeps))
