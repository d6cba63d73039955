"""The atlas as a small map for the page: the share of regular motion over k and E/g^2.

The map is committed, because the sweep behind it takes minutes. Renew it after ./reproduce atlas:

    .venv/bin/python -m extensions.explorer.atlas
"""

import base64
import json
from pathlib import Path
from typing import Any

import numpy as np

from pipeline.records.artifacts import load
from pipeline.records.files import write_whole
from pipeline.records.sources import ROOT

SWEEP, VARIABLE = "plane", "regular"
STEPS = 250  # in which a share from 0 to 1 is rounded; 255 stands for no value
MISSING = 255
_FILE = Path(__file__).with_name("atlas.json")


def stored() -> dict[str, Any]:
    """Return the committed map.

    `k` and `energy`, in g^2, are the values of the grid, and `regular` the shares in STEPS as bytes
    in base64, row by row of k.
    """
    atlas: dict[str, Any] = json.loads(_FILE.read_text(encoding="utf-8"))
    return atlas


def rounded(root: Path = ROOT) -> dict[str, Any]:
    """Return the map of the sweep that the tree at `root` has."""
    sweep = load(root / f"results/atlas/sweep_{SWEEP}.nc")
    share = sweep[VARIABLE].transpose("k", "energy").values
    steps = np.where(np.isnan(share), MISSING, np.rint(STEPS * np.nan_to_num(share)))
    return {
        "k": sweep["k"].values.tolist(),
        "energy": sweep["energy"].values.tolist(),
        "regular": base64.b64encode(steps.astype(np.uint8).tobytes()).decode(),
    }


if __name__ == "__main__":
    write_whole(_FILE, json.dumps(rounded(), separators=(",", ":")) + "\n")
