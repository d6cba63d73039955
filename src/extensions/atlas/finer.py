"""The finer atlas: a set of scenes that no other command loads, for it has a million cells."""

from pathlib import Path
from typing import Any

import yaml

NAME = "finer"


def scenes() -> dict[str, Any]:
    """Return the scenes of `finer.yaml`."""
    file = Path(__file__).with_suffix(".yaml")
    return dict(yaml.safe_load(file.read_text(encoding="utf-8")))
