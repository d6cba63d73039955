"""The numbers that the paper prints for the quantities of its figures."""

import tomllib
from pathlib import Path

from paper.values import FIGURES, WINDOW

# scene -> quantity -> the paper's value
PAPER_NUMBERS: dict[str, dict[str, str]] = {
    scene: {name: text.format(window=WINDOW, **FIGURES[scene]) for name, text in texts.items()}
    for scene, texts in tomllib.loads(
        Path(__file__).with_suffix(".toml").read_text(encoding="utf-8")
    ).items()
}


def printed(scene: str, quantity: str) -> str:
    """Return the value that the paper prints for a quantity of a scene."""
    return PAPER_NUMBERS.get(scene, {}).get(quantity, "not printed")
