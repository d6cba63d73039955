"""A whole config, checked: every scene made complete, or all its mistakes told at once."""

from typing import Annotated, Any

from pydantic import Field

from ..declared.fields import BallBlock, Block, Name
from . import sweeps, variants
from .mistakes import mistakes
from .scenes import checked
from .words import ConfigError


class Document(Block):
    """a mapping with the keys ball and scenes"""

    ball: BallBlock
    scenes: Annotated[
        dict[Name, Any],
        Field(min_length=1, description="a mapping from names to scenes, at least one"),
    ]
    variants: Annotated[dict[Name, Any], Field(description="a mapping from names to variants")] = {}
    sweeps: Annotated[dict[Name, Any], Field(description="a mapping from names to sweeps")] = {}


def check(document) -> dict:
    """The complete config of a parsed YAML `document`; raises ConfigError where there is none.

    Its `variants` begin with the paper itself: name -> scene -> block.
    """
    lines = mistakes(Document, document, ())
    given = {key: _mapping(document, key) for key in ("ball", "scenes", "variants", "sweeps")}
    ball = None if mistakes(BallBlock, given["ball"], ()) else given["ball"]
    scenes, found = {}, []
    for name, block in given["scenes"].items():
        scenes[name], wrong = checked(block, ball, ("scenes", name))
        found += wrong
    derived = {variants.PAPER: scenes}
    for name, block in given["variants"].items() if not (lines or found) else ():
        derived[name], wrong = variants.derive(given, name, block)
        found += wrong
    grids = {}
    for name, block in given["sweeps"].items():
        grids[name], wrong = sweeps.checked(block, ("sweeps", name))
        found += wrong
    if lines or found:
        raise ConfigError(*dict.fromkeys(lines + found))
    return {"ball": ball, "scenes": scenes, "variants": derived, "sweeps": grids}


def _mapping(document, key):
    """A part of a document whose structure may be wrong."""
    value = document.get(key) if isinstance(document, dict) else None
    return value if isinstance(value, dict) else {}
