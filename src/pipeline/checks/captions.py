"""Captions of all pictures, from files captions.toml: for README, docs/figures.md and the site."""

import re
import tomllib
from collections import defaultdict
from typing import Any, NamedTuple

import jinja2

from ..config.schema.kinds import KINDS
from ..declaration import SourceError, files
from ..records.files import read_text

CAPTIONS: dict[str, dict[str, str]] = {}  # kind of picture -> its templates
for _file in files("captions.toml").values():
    try:
        CAPTIONS |= tomllib.loads(read_text(_file))["kinds"]
    except (ValueError, KeyError, TypeError) as error:
        raise SourceError(_file, error) from error


class Caption(NamedTuple):
    """The texts of a picture. `shows` and `see` are a few sentences, `details` are the rest.

    `explorer` says what to see there, and `explorer_title` what it shows, if that is something
    else.
    """

    name: str
    title: str
    shows: str
    see: str
    details: str
    explorer: str
    explorer_title: str


def caption_of(name: str, block: dict[str, Any], facts: dict[str, Any] | None = None) -> Caption:
    """Return the caption of a complete scene, after whose set `name` is called: "families/energy".

    Scenes of config.yaml and its variants have bare names. A scene fig9 of any set is Figure 9.
    `facts` are those of `quantities.facts`; without them, sentences that need one are left out.
    """
    kind = block["picture"]
    templates = dict.fromkeys(Caption._fields, "") | {"title": str(KINDS[kind].__doc__)}
    templates |= CAPTIONS.get(kind, {})
    numbered = re.fullmatch(r"(?:.*/)?fig(\d+)", name)
    shown_name = f"Figure {numbered[1]}" if numbered else name
    known = defaultdict[str, Any](int, drawn=[]) if facts is None else facts
    texts = (_ENVIRONMENT.from_string(templates[part]) for part in Caption._fields[1:])
    try:
        title, shows, *rest = (" ".join(text.render(s=block, d=known).split()) for text in texts)
    except jinja2.UndefinedError as error:
        words = f"{name}: the committed manifest lacks a fact of the caption ({error})"
        raise ValueError(f"{words}: run ./reproduce accept") from None
    hidden = [f"Note: {line}." for line in known["hidden"] or ()]
    return Caption(shown_name, title, " ".join([shows, *hidden]), *rest)


# Whole numbers have commas, and the filter `counted` adds a noun in the number that it needs.
_ENVIRONMENT = jinja2.Environment(
    finalize=lambda value: f"{value:,}" if type(value) is int else value,
    undefined=jinja2.StrictUndefined,
)
_ENVIRONMENT.filters["counted"] = lambda n, noun: f"{n:,} {noun}{'s' * (n != 1)}"
