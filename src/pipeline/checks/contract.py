"""Which published files must keep their bytes, and what each is made from.

There are two contracts: the figures of the paper, and the charts of the study whose data are the
same on every machine. Each is written down in its folder; see manifest.
"""

from pathlib import Path
from typing import NamedTuple

from .. import config
from ..records import sources
from . import audit, manifest


class Contract(NamedTuple):
    """A folder of published files; a scene is one block of config, drawn into one or more files."""

    what: str  # its files are called
    folder: str
    results: str  # where the files and their data are made
    command: str  # that makes one of them, {} being its path
    figures: dict  # published file -> scene, paths from the root
    drawn: dict  # name of a published file -> its drawing in results
    config: dict  # scene -> the block that decides it
    sources: dict  # scene -> the project's files behind it
    data: dict  # scene -> stage -> the artifact it is drawn from
    makers: dict  # every result -> audit.Maker
    measured: tuple = ()  # names of published files that the contract leaves out

    @property
    def names(self):
        """The names of the published files."""
        return {Path(path).name for path in self.figures}


def paper(scenes):
    """The figures of the config's scenes."""
    files = manifest.published(scenes)
    return Contract(
        what="figures",
        folder="paper_figures",
        results="results/paper",
        command="./reproduce {}",
        figures=files,
        drawn={
            Path(path).name: config.drawn(scene, Path(path).suffix[1:])
            for path, scene in files.items()
        },
        config={scene: config.drawing(block) for scene, block in scenes.items()},
        sources={scene: manifest.scene_sources(block) for scene, block in scenes.items()},
        data=manifest.scene_data(scenes),
        makers=audit.makers(scenes),
    )


def study(scenes):
    """The study's charts of what is computed, not measured, by our own arithmetic."""
    from ..config.declared import study as parts

    charts = {name: data for name, (data, *_) in parts.CHARTS.items() if data in parts.FIXED}
    computing, drawing = sources.code("study.py"), sources.code("chart.py")
    blocks = {part: parts.block(part, scenes) for part in parts.FIXED}
    drawings = {name: parts.drawing(name) for name in charts}
    return Contract(
        what="charts",
        folder=parts.FOLDER,
        results="results/study",
        command="./reproduce study",
        figures={parts.published(name): name for name in charts},
        drawn={Path(parts.published(name)).name: parts.drawn(name) for name in charts},
        config={name: drawings[name] | blocks[data] for name, data in charts.items()},
        sources={name: sorted({*computing, *drawing}) for name in charts},
        data={name: {data: parts.data(data)} for name, data in charts.items()},
        makers={
            **{parts.data(part): audit.Maker(blocks[part], computing) for part in parts.FIXED},
            **{parts.drawn(name): audit.Maker(drawings[name], drawing) for name in charts},
        },
        measured=tuple(
            Path(parts.published(name)).name for name in parts.CHARTS if name not in charts
        ),
    )
