"""The paper's numbers beside those measured in our datasets."""

import tomllib
from pathlib import Path

from pseudorigid.dynamics.paper import FIGURES, WINDOW

from ...config.paths import stages
from ...config.schema.kinds import KINDS

TEXT = tomllib.loads(Path(__file__).with_name("words.toml").read_text(encoding="utf-8"))
# scene -> quantity -> the paper's value
PAPER_NUMBERS = {
    scene: {name: text.format(window=WINDOW, **FIGURES[scene]) for name, text in texts.items()}
    for scene, texts in TEXT["printed"].items()
}
CHARTS = TEXT["charts"]  # chart of the study, or sweep -> what its picture shows


def measured(block, load):
    """Quantity -> value in words, of a scene's block; `load(stage)` reads one of its datasets."""
    return KINDS[block["picture"]].numbers(block, **{stage: load(stage) for stage in stages(block)})


def beside(scene, ours):
    """Rows (quantity, the paper's value or "not printed", ours) of a scene of the paper."""
    printed = PAPER_NUMBERS.get(scene, {})
    return [(name, printed.get(name, "not printed"), value) for name, value in ours.items()]
