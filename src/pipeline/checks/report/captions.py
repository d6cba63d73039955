"""Captions of all pictures, from captions.toml, for the report and docs/figures.md."""

import tomllib
from pathlib import Path
from typing import Any, NamedTuple

import jinja2

from ...config.schema.kinds import KINDS

CAPTIONS = tomllib.loads(Path(__file__).with_name("captions.toml").read_text(encoding="utf-8"))


class Caption(NamedTuple):
    """The texts of a picture."""

    name: str
    title: str
    shows: str
    see: str


def caption_of(name: str, block: dict[str, Any] | None = None) -> Caption:
    """Return the caption of a complete scene or sweep, or of a chart, which has no block."""
    block = block or {}
    if "picture" in block:
        kind = block["picture"]
        texts = {"title": KINDS[kind].__doc__} | CAPTIONS["kinds"][kind]
    elif "k" in block:
        kind = "chains" if "chains" in block else "line" if len(block["k"]) == 1 else "plane"
        texts = CAPTIONS["sweeps"][kind]
    else:
        texts = CAPTIONS["charts"][name]
    number = name.removeprefix("fig")
    shown_name = f"Figure {number}" if number.isdigit() and number != name else name
    return Caption(shown_name, *(_filled(texts[part], block) for part in ("title", "shows", "see")))


def _filled(template: str, block: dict[str, Any]) -> str:
    """Return a text with the values of a block, on one line."""
    text = _ENVIRONMENT.from_string(template).render(s=block)
    return " ".join(text.split())


def _with_commas(value: object) -> object:
    return f"{value:,}" if type(value) is int else value


_ENVIRONMENT = jinja2.Environment(finalize=_with_commas, undefined=jinja2.StrictUndefined)
