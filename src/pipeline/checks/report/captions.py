"""Captions of all pictures, from files captions.toml, for the report and docs/figures.md."""

import tomllib
from pathlib import Path
from typing import Any, NamedTuple

import jinja2

from ...config.schema.kinds import KINDS
from ...declaration import files

CAPTIONS: dict[str, dict[str, dict[str, str]]] = {"kinds": {}, "scenes": {}}
for _file in (Path(__file__).with_name("captions.toml"), *files("captions.toml")):
    for _part, _texts in tomllib.loads(_file.read_text(encoding="utf-8")).items():
        CAPTIONS[_part] |= _texts


class Caption(NamedTuple):
    """The texts of a picture. `shows` and `see` are a sentence each, `details` are the rest."""

    name: str
    title: str
    shows: str
    see: str
    details: str


def caption_of(name: str, block: dict[str, Any]) -> Caption:
    """Return the caption of a complete scene."""
    kind = block["picture"]
    own = CAPTIONS["scenes"].get(name) or CAPTIONS["kinds"].get(kind, {})
    templates = {"title": str(KINDS[kind].__doc__), "shows": "", "see": "", "details": ""} | own
    number = name.removeprefix("fig")
    shown_name = f"Figure {number}" if number.isdigit() and number != name else name
    texts = (_ENVIRONMENT.from_string(templates[part]) for part in Caption._fields[1:])
    return Caption(shown_name, *(" ".join(text.render(s=block).split()) for text in texts))


def _with_commas(value: object) -> object:
    """Return a whole number as text with commas, and any other value as it is."""
    return f"{value:,}" if type(value) is int else value


_ENVIRONMENT = jinja2.Environment(finalize=_with_commas, undefined=jinja2.StrictUndefined)
