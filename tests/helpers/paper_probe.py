"""Hashes of the published figures, as one JSON line.

    PYTHONPATH=src:tests python tests/helpers/paper_probe.py [scene ...]

The jobs of snakemake are processes of their own, which an emulator would not follow. So this makes
the results itself, in a temporary folder.
"""

import hashlib
import json
import sys
import tempfile
from pathlib import Path

from helpers.project import SHIPPED, make_here
from pipeline import config


def figures(folder, checked, names=()):
    """Yield (file name, hash) of the figures of these scenes of the paper, or of all."""
    specs = checked.build_specs([config.MAIN])
    for scene, path in checked.figures().values():
        if not names or scene in names:
            make_here(folder, specs, [path])
            drawing = Path(folder, path)
            yield drawing.name, hashlib.sha256(drawing.read_bytes()).hexdigest()


def paper(folder, names=()):
    """Yield (file name, hash) of the published figures of these scenes, or of all."""
    yield from figures(folder, config.load(SHIPPED), names)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as scratch:
        print(json.dumps(dict(paper(scratch, sys.argv[1:])), sort_keys=True))
