"""Make the published figures in one process and print a JSON line of their hashes.

    python tests/paper_probe.py [scene ...]

The jobs of snakemake are processes of their own, which an emulator would not follow. So this calls
the function of each stage and drawing itself, with data in files of a temporary folder.
"""

import hashlib
import json
import sys
import tempfile
from importlib import import_module
from pathlib import Path

from pipeline import config
from pipeline.config import build_specs, paths
from pipeline.config.schema.stages import STAGES
from pipeline.records import artifacts
from pseudorigid import Ball
from pseudorigid.figures.canvas.render import render

SHIPPED = Path(__file__).with_name("scenes.yaml")


def computed(name, block, inputs):
    stage = STAGES[name]
    ball = Ball(**block["ball"])
    fields = {key: block[key] for key in block.keys() - {"ball", "energy"}}
    function = getattr(import_module(stage.module), stage.function)
    return function(ball, block["energy"], *inputs, **fields)


class Results:
    """Datasets of variants in a folder, each computed when it is needed."""

    def __init__(self, folder, variants):
        self.folder, self.specs = Path(folder), build_specs.of_variants(variants)

    def data(self, path):
        """A dataset as read from its file."""
        file = self.folder / path
        if not file.exists():
            file.parent.mkdir(parents=True, exist_ok=True)
            block = self.specs[path].config
            stage = file.stem.rpartition("_")[0]
            about = block["ball"] | {"energy": float(block["energy"]), "stage": stage}
            artifacts.save(computed(stage, block, self.inputs(path)), file, block, **about)
        return artifacts.load(file)

    def inputs(self, path):
        return [self.data(used) for used in self.specs[path].inputs]


def figures(folder, variants, names=()):
    """Yield (file name, hash) of the figures of these scenes of the paper, or of all."""
    variants = {paths.PAPER: variants[paths.PAPER]}
    results = Results(folder, variants)
    for scene, upstream in paths.figures(variants).values():
        if names and scene not in names:
            continue
        path = upstream[-1]
        block = results.specs[path].config
        kind = import_module(f"pseudorigid.figures.kinds.{block['picture']}")
        picture = render(kind.draw(block, *results.inputs(path)), Path(path).suffix[1:])
        yield Path(path).name, hashlib.sha256(picture).hexdigest()


def paper(folder, names=()):
    """Yield (file name, hash) of the published figures of these scenes, or of all."""
    yield from figures(folder, config.load(SHIPPED)["variants"], names)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as scratch:
        print(json.dumps(dict(paper(scratch, sys.argv[1:])), sort_keys=True))
