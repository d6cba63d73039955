"""Texts about committed pictures: docs/figures.md, README's figures, the manifest of codecheck.yml.

The captions have the values from which the committed pictures were made.
"""

import re
from collections.abc import Iterator
from pathlib import Path
from textwrap import fill
from typing import Any

import jinja2
import yaml

from pipeline.checks import manifest, published_sets
from pipeline.checks.captions import Caption, caption_of
from pipeline.checks.published_sets import MANIFEST, PublishedSet
from pipeline.config import MAIN, load
from pipeline.config.schema.parts import SETS
from pipeline.declaration import RENEW
from pipeline.records.files import read_text
from pipeline.records.sources import ROOT
from pipeline.renew import END, with_section

_SMALL = 190  # pixels: the width of a picture that leads to its caption
FIGURES = f"<!-- The figures, written by {RENEW}. -->\n"


def committed() -> dict[str, str]:
    """Map the committed files about pictures, by their paths from the root, to their texts."""
    texts = {"docs/figures.md": page()}
    for name, begin, section, end in (
        ("README.md", FIGURES, main_figures(), END),
        ("codecheck.yml", "\nmanifest:\n", codecheck_manifest(), "summary:"),
    ):
        if (ROOT / name).exists():
            texts[name] = with_section(read_text(ROOT / name), begin, section, end)
    return texts


def page() -> str:
    """Return the text of docs/figures.md."""
    template = Path(__file__).with_name("figures.md.jinja").read_text(encoding="utf-8")
    environment = jinja2.Environment(trim_blocks=True, keep_trailing_newline=True)

    def wrapped(text: str) -> str:
        """Return a paragraph in lines, none of which begins with = as an underline does."""
        glued = text.replace(" = ", "\0=\0")
        return fill(glued, 100, break_long_words=False, break_on_hyphens=False).replace("\0", " ")

    sections = [(SETS[each.group].heading, each, of) for each, of in _captions()]
    return environment.from_string(template).render(sections=sections, fill=wrapped)


def main_figures() -> str:
    """Return the main set's pictures, small and each leading to its caption, for README.md."""
    (main, captions), *_ = _captions()
    pictures, titles = [], []
    for scene, c in captions.items():
        title = f"{c.name}: {c.title}"
        place = f"docs/figures.md#{anchor(title)}"
        file = f"{main.folder}/{scene}.png"
        pictures += [f'[<img src="{file}" width="{_SMALL}" alt="{title}">]({place})']
        titles += [f"[{c.name}]({place}): {c.title}"]
    return "\n".join([*pictures, "", " · ".join(titles), ""])


def anchor(title: str) -> str:
    """Return the anchor that GitHub and Sphinx give a heading."""
    return re.sub(r"[^\w -]", "", title).strip().lower().replace(" ", "-")


def codecheck_manifest() -> str:
    """Return the entries of `manifest` in codecheck.yml: each picture that keeps its bytes."""
    entries = [
        {
            "file": f"{each.folder}/{file}",
            "comment": f"{texts[scene].name}: {texts[scene].title}; made by {each.command}",
        }
        for each, texts in _captions()
        for file in manifest.published(manifest.read(ROOT, each.folder))
        for scene in [Path(file).stem]
    ]
    return yaml.safe_dump(entries, sort_keys=False, allow_unicode=True, width=100)


def _captions() -> Iterator[tuple[PublishedSet, dict[str, Caption]]]:
    """Yield each set that has been accepted, and the captions of its scenes."""
    config = load(ROOT / "config.yaml")
    for published_set in published_sets.committed_sets(config):
        if not (ROOT / published_set.folder / MANIFEST).exists():
            continue
        committed = manifest.read(ROOT, published_set.folder)
        known: dict[str, tuple[dict[str, Any], dict[str, Any]]] = {}
        for file, drawing in manifest.published(committed).items():
            record = committed["results"][drawing]
            known[Path(file).stem] = record["config"], record["output"]
        group = published_set.group
        prefix = "" if group == MAIN else f"{group}/"
        yield published_set, {name: caption_of(prefix + name, *of) for name, of in known.items()}
