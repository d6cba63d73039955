"""The sets of published files that must keep their bytes, and what each is made from.

They are the figures of the paper, the pictures of claims, families and proofs, the study's charts
whose data are the same on every machine, and the atlas.
"""

from pathlib import Path
from typing import Any, NamedTuple

from pseudorigid.sweep import grid

from ..config import PAPER, build_specs, paths
from ..config.schema import study as parts
from ..records.build_spec import BuildSpec


class PublishedSet(NamedTuple):
    """A folder of published files and what makes them; all paths start at the project's root.

    A scene may be drawn into several files.
    """

    noun: str  # for its files: "figures", "charts" or "pictures"
    folder: str
    results: str  # folder with the drawings and their data
    command: str  # makes them
    drawn: dict[str, str]  # name of a published file -> its drawing in results
    scenes: dict[str, str]  # name of a published file -> its scene
    config: dict[str, dict[str, Any]]  # scene -> the config block that decides it
    data: dict[str, dict[str, str]]  # scene -> stage -> the dataset that it is drawn from
    build_specs: dict[str, BuildSpec]  # every result
    measured: tuple[str, ...] = ()  # published files without a checksum: they show times
    texts: tuple[str, ...] = ()  # other files that the command writes
    on_request: bool = False  # made by a command of its own, not by every run

    def sources(self, scene: str) -> list[str]:
        """Return the project's files that decide a scene's figures."""
        drawn = [self.drawn[name] for name in self.drawn if self.scenes[name] == scene]
        results = [*self.data[scene].values(), *drawn]
        return sorted({file for path in results for file in self.build_specs[path].sources})


_COMMANDS = {
    PAPER: "./reproduce",
    "claims": "./reproduce claims",
    "families": "./reproduce families",
    "proofs": "./reproduce prove --pictures",
}


def committed_sets(checked: dict[str, Any]) -> list[PublishedSet]:
    """Return all published sets of a checked config."""
    variants = [_figures(checked, name) for name in paths.PUBLISHED if checked["variants"][name]]
    return [*variants, _study(checked), _atlas(checked)]


def _figures(checked: dict[str, Any], variant: str) -> PublishedSet:
    """Return the figures of the paper, or the pictures of claims, families or proofs."""
    variants, folder = checked["variants"], paths.PUBLISHED[variant]
    scenes, artifact_paths = variants[variant], paths.artifact_paths(variants)
    figures = paths.figures(variants, variant).items()
    files = {Path(path).name: figure for path, figure in figures if path.startswith(f"{folder}/")}
    return PublishedSet(
        noun="figures",
        folder=folder,
        results=f"results/{variant}",
        command=_COMMANDS[variant],
        drawn={name: results[-1] for name, (_, results) in files.items()},
        scenes={name: scene for name, (scene, _) in files.items()},
        config={scene: paths.drawing(block) for scene, block in scenes.items()},
        data={
            scene: {stage: artifact_paths[variant, scene, stage] for stage in paths.stages(block)}
            for scene, block in scenes.items()
        },
        build_specs=build_specs.of_scenes(variants, variant),
        texts=(paths.LEDGER, paths.LEDGER_DATA) if variant == "claims" else (),
        on_request=variant != PAPER,
    )


def _study(checked: dict[str, Any]) -> PublishedSet:
    """Return the study's charts of what is computed; charts of times are listed as measured."""
    specs = build_specs.of_study(checked["variants"])
    charts = {name: part for name, (part, *_) in parts.CHARTS.items() if part in parts.FIXED}
    fixed = {parts.data(part) for part in parts.FIXED} | {parts.drawn(name) for name in charts}
    return PublishedSet(
        noun="charts",
        folder=parts.FOLDER,
        results="results/study",
        command="./reproduce study",
        drawn={f"{name}.png": parts.drawn(name) for name in charts},
        scenes={f"{name}.png": name for name in charts},
        config={n: parts.drawing(n) | specs[parts.data(p)].config for n, p in charts.items()},
        data={name: {part: parts.data(part)} for name, part in charts.items()},
        build_specs={path: spec for path, spec in specs.items() if path in fixed},
        measured=tuple(f"{name}.png" for name in parts.CHARTS if name not in charts),
        on_request=True,
    )


def _atlas(checked: dict[str, Any]) -> PublishedSet:
    """Return the pictures of the sweeps. A picture of chains is a scene of its own."""
    sweeps = checked["sweeps"]
    pictures = [(n, path) for n in sweeps for path in paths.sweep_pictures(n, sweeps[n])]
    config = {name: grid.whole(sweep) for name, sweep in sweeps.items()}
    data = {name: {"sweep": paths.sweep_dataset(name)} for name in sweeps}
    scenes = {Path(path).name: name for name, path in pictures}
    for name, sweep in sweeps.items():
        if "chains" in sweep:
            file = Path(paths.chains_picture(name))
            scenes[file.name] = file.stem
            config[file.stem] = grid.whole(sweep) | {"chains": sweep["chains"]}
            data[file.stem] = data[name] | {"chains": paths.chains_dataset(name)}
    return PublishedSet(
        noun="pictures",
        folder=paths.ATLAS,
        results="results/sweep",
        command="./reproduce atlas",
        drawn={Path(path).name: path for _, path in pictures},
        scenes=scenes,
        config=config,
        data=data,
        build_specs=build_specs.of_sweeps(sweeps),
        on_request=True,
    )
