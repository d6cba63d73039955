"""The quantities that the paper prints, and those measured in the datasets of a scene."""

import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import xarray as xr

from pseudorigid.dynamics.paper import FIGURES, WINDOW

from ...config.paths import stages
from ...config.schema.kinds import KINDS

_TEXT = Path(__file__).with_name("paper_numbers.toml").read_text(encoding="utf-8")
# scene -> quantity -> the paper's value
PAPER_NUMBERS: dict[str, dict[str, str]] = {
    scene: {name: text.format(window=WINDOW, **FIGURES[scene]) for name, text in texts.items()}
    for scene, texts in tomllib.loads(_TEXT).items()
}


def measured(block: dict[str, Any], load: Callable[[str], xr.Dataset]) -> dict[str, str]:
    """Return the quantities of a scene in words; `load(stage)` reads one of its datasets."""
    return KINDS[block["picture"]].numbers(block, **{stage: load(stage) for stage in stages(block)})
