"""Write docs/figures.md, which has every committed picture and its caption.

Run `.venv/bin/python -m pipeline.checks.figures_page`. The captions are those of the
report, with the values from which the committed pictures were made.
"""

from functools import partial
from pathlib import Path
from textwrap import fill
from typing import Any

import jinja2

from ..config import MAIN, load
from ..config.schema.sets import SETS
from ..records.files import write_whole
from ..records.sources import ROOT
from . import manifest, published_sets
from .captions import caption_of


def page() -> str:
    """Return the text of docs/figures.md."""
    sections, config = [], load(ROOT / "config.yaml")
    for published_set in published_sets.committed_sets(config):
        committed = manifest.read(ROOT, published_set.folder)
        group = published_set.group
        known: dict[str, tuple[dict[str, Any], dict[str, Any] | None]] = {}
        for file, drawing in manifest.published(committed).items():
            record = committed["results"][drawing]
            known[Path(file).stem] = record["config"], record["output"]
        for scene in (Path(file).stem for file in published_set.measured):
            known[scene] = config.variants[group][scene].as_mapping(), None
        prefix = "" if group == MAIN else f"{group}/"
        captions = [(name, caption_of(prefix + name, *of)) for name, of in known.items()]
        sections.append((SETS[group].heading, published_set, captions))
    template = Path(__file__).with_name("figures.md.jinja").read_text(encoding="utf-8")
    environment = jinja2.Environment(trim_blocks=True, keep_trailing_newline=True)
    wrapped = partial(fill, width=100, break_long_words=False, break_on_hyphens=False)
    return environment.from_string(template).render(sections=sections, fill=wrapped)


if __name__ == "__main__":
    write_whole(ROOT / "docs" / "figures.md", page())
