"""Write docs/figures.md, which has every committed picture and its caption.

Run `.venv/bin/python -m pipeline.checks.report.figures_page`. The captions are those of the
report, with the values from which the committed pictures were made.
"""

from textwrap import fill

from ...config import PAPER, PUBLISHED, paths
from ...config.schema import study
from ...records.files import write_whole
from ...records.sources import ROOT
from .. import manifest
from .captions import caption_of

HEAD = """\
# All figures

This page has every committed picture with its caption. It is written by
`.venv/bin/python -m pipeline.checks.report.figures_page`, which takes the texts from
`src/pipeline/checks/report/captions.toml` and the values from the `MANIFEST.json` beside the
pictures. `./reproduce report` makes a page with the same captions, and with the numbers measured in
each figure."""
# Heading, folder, and the command that makes the pictures.
SECTIONS = (
    ("The paper's figures", PUBLISHED[PAPER], "./reproduce"),
    ("Statements of the paper", PUBLISHED["claims"], "./reproduce claims"),
    ("Theorems", PUBLISHED["proofs"], "./reproduce prove --pictures"),
    ("Accuracy and speed of methods", study.FOLDER, "./reproduce study"),
    ("The atlas", paths.ATLAS, "./reproduce atlas"),
)


def page() -> str:
    """Return the text of docs/figures.md."""
    parts = [HEAD]
    for heading, folder, command in SECTIONS:
        parts += [f"## {heading}", f"`{command}` makes these pictures, in `{folder}/`."]
        scenes = manifest.read(ROOT, folder)["scenes"]
        names = study.CHARTS if folder == study.FOLDER else scenes
        for name in names:
            caption = caption_of(name, scenes.get(name, {}).get("config"))
            parts += [
                f"### {caption.name}: {caption.title}",
                f"![{caption.name}](../{folder}/{name}.png)",
                _wrapped(caption.shows),
                _wrapped(f"*What to see.* {caption.see}"),
            ]
    return "\n\n".join(parts) + "\n"


def _wrapped(text: str) -> str:
    return fill(text, 100, break_long_words=False, break_on_hyphens=False)


if __name__ == "__main__":
    write_whole(ROOT / "docs" / "figures.md", page())
