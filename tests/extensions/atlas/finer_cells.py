"""A hundred cells of the finer atlas and their numbers; as a program, write them anew.

.venv/bin/python tests/extensions/atlas/finer_cells.py
"""

import json
from pathlib import Path

import numpy as np

from extensions.atlas import cell, finer

FILE = Path(__file__).with_suffix(".json")
SCENE = finer.scenes()[finer.NAME]
ORBITS = {name: SCENE[name] for name in ("starts", "impacts")}


def drawn():
    """The cells [k, E/g^2], by a fixed seed."""
    from pipeline.config.schema.kinds import KINDS  # a machine with a card need not have it

    scene = KINDS["atlas"](picture="atlas", **SCENE).completed()
    axes = [scene.k, scene.energy]
    places = np.random.default_rng(53).integers(0, [len(axis) for axis in axes], (100, 2))
    return [[axis[i] for axis, i in zip(axes, place, strict=True)] for place in places]


def numbers(cells, judged=None):
    """What the atlas says of cells, as it is stored: by the processor, or as another judged."""
    rows = cell.numbers_of_cells(cells, **ORBITS, judged=judged)
    return [{name: np.asarray(row[name]).tolist() for name in cell.VARIABLES} for row in rows]


if __name__ == "__main__":
    rows = [json.dumps(row) for row in zip(drawn(), numbers(drawn()), strict=True)]
    FILE.write_text("[\n" + ",\n".join(rows) + "\n]\n")
