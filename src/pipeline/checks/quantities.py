"""The reported quantities of scenes, as measured in their datasets and as printed in the paper."""

import tomllib
from pathlib import Path
from typing import Any

from pseudorigid.dynamics.paper import FIGURES, WINDOW

from ..config import paths
from ..config.schema.kinds import KINDS
from ..declaration import imported
from ..records.artifacts import load

# scene -> quantity -> the paper's value
PAPER_NUMBERS: dict[str, dict[str, str]] = {
    scene: {name: text.format(window=WINDOW, **FIGURES[scene]) for name, text in texts.items()}
    for scene, texts in tomllib.loads(
        Path(__file__).with_name("paper_numbers.toml").read_text(encoding="utf-8")
    ).items()
}


def measured(root: Path, variants: paths.Variants, variant: str, scene: str) -> dict[str, str]:
    """Measure the quantities of a scene in its datasets; ValueError names wrong files."""
    block, files = variants[variant][scene], paths.artifact_paths(variants)
    own = {stage: files[variant, scene, stage] for stage in paths.stages(block)}
    data = {stage: load(root / file) for stage, file in own.items()}
    try:
        return reported(block.as_mapping(), data)
    except (LookupError, TypeError, AttributeError, ArithmeticError):
        wrong = ", ".join(own.values())
        raise ValueError(f"not datasets of {scene}: delete {wrong} and run again") from None


def reported(block: dict[str, Any], data: dict[str, Any]) -> dict[str, str]:
    """Measure the quantities that a picture reports; `data` maps stages to datasets."""
    kind = KINDS[block["picture"]]
    quantities: dict[str, str] = imported(kind.reported_by)(block, **data) if kind.headline else {}
    return quantities


def printed(scene: str, quantity: str) -> str:
    """Return the value that the paper prints for a quantity of a scene."""
    return PAPER_NUMBERS.get(scene, {}).get(quantity, "not printed")
