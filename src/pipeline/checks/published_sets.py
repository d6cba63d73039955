"""Which published files must keep their bytes, and what each is made from.

A contract is a folder of published files: the figures of the paper, the charts of the study whose
data are the same on every machine, the atlas. Each is written down in its folder; see manifest.
"""

from pathlib import Path
from typing import NamedTuple

from pseudorigid.sweep import grid

from ..config import build_specs, paths
from ..config.schema import study as parts


class PublishedSet(NamedTuple):
    """A folder of published files; a scene is what is drawn into one or more of them."""

    what: str  # its files are called
    folder: str
    results: str  # where the files and their data are made
    command: str  # that makes them
    drawn: dict  # name of a published file -> its drawing in results
    scenes: dict  # name of a published file -> its scene
    config: dict  # scene -> the block that decides it
    data: dict  # scene -> stage -> the dataset it is drawn from
    build_specs: dict  # every result -> records.build_spec.BuildSpec
    measured: tuple = ()  # names of published files that the contract leaves out
    texts: tuple = ()  # files made from it, from the root
    on_request: bool = False  # made by a word of its own, not by every run

    def sources(self, scene):
        """The project's files behind a scene, from the root."""
        drawn = [self.drawn[name] for name in self.drawn if self.scenes[name] == scene]
        results = [*self.data[scene].values(), *drawn]
        return sorted({file for path in results for file in self.build_specs[path].sources})


# What makes the figures of each set of scenes.
COMMANDS = {
    paths.PAPER: "./reproduce",
    "claims": "./reproduce claims",
    "proofs": "./reproduce prove --pictures",
}


def committed_sets(checked):
    """The contracts of a checked config."""
    found = [of_scenes(checked, name) for name in paths.PUBLISHED if checked["variants"][name]]
    return [*found, study(checked), atlas(checked)]


def of_scenes(checked, variant):
    """The figures of the paper's scenes, or of another published set."""
    scenes, artifact_paths = checked["variants"][variant], paths.artifact_paths(checked["variants"])
    folder = paths.PUBLISHED[variant]
    files = {
        Path(path).name: (scene, behind[-1])
        for path, (scene, behind) in paths.figures(checked["variants"], variant).items()
        if path.startswith(f"{folder}/")
    }
    paper = variant == paths.PAPER
    return PublishedSet(
        what="figures",
        folder=folder,
        results=f"results/{variant}",
        command=COMMANDS[variant],
        drawn={name: drawing for name, (_, drawing) in files.items()},
        scenes={name: scene for name, (scene, _) in files.items()},
        config={scene: paths.drawing(block) for scene, block in scenes.items()},
        data={
            scene: {stage: artifact_paths[variant, scene, stage] for stage in paths.stages(block)}
            for scene, block in scenes.items()
        },
        build_specs=build_specs.of_scenes(checked["variants"], variant),
        texts=(paths.LEDGER,) if variant == "claims" else (),
        on_request=not paper,
    )


def study(checked):
    """The study's charts of what is computed, not measured, by our own arithmetic."""
    made = build_specs.of_study(checked["variants"])
    charts = {name: data for name, (data, *_) in parts.CHARTS.items() if data in parts.FIXED}
    fixed = {parts.data(data) for data in parts.FIXED} | {parts.drawn(name) for name in charts}
    return PublishedSet(
        what="charts",
        folder=parts.FOLDER,
        results="results/study",
        command="./reproduce study",
        drawn={f"{name}.png": parts.drawn(name) for name in charts},
        scenes={f"{name}.png": name for name in charts},
        config={
            name: parts.drawing(name) | made[parts.data(data)].config
            for name, data in charts.items()
        },
        data={name: {data: parts.data(data)} for name, data in charts.items()},
        build_specs={path: made[path] for path in made if path in fixed},
        measured=tuple(f"{name}.png" for name in parts.CHARTS if name not in charts),
        on_request=True,
    )


def atlas(checked):
    """The pictures of the sweeps, and so their datasets."""
    sweeps = checked["sweeps"]
    drawn = {
        Path(path).name: (name, path)
        for name in sweeps
        for path in paths.sweep_pictures(name, sweeps[name])
    }
    return PublishedSet(
        what="pictures",
        folder=paths.ATLAS,
        results="results/sweep",
        command="./reproduce atlas",
        drawn={file: path for file, (_, path) in drawn.items()},
        scenes={file: name for file, (name, _) in drawn.items()},
        config={name: grid.whole(sweep) for name, sweep in sweeps.items()},
        data={name: {"sweep": paths.sweep_dataset(name)} for name in sweeps},
        build_specs=build_specs.of_sweeps(sweeps),
        on_request=True,
    )
