"""A whole config, checked: every scene made complete, or all its mistakes told at once."""

from typing import Annotated, Any

from pydantic import Field

from ..declared.fields import BallBlock, Block, Name
from . import sweeps, variants
from .mistakes import mistakes
from .scenes import checked
from .words import ConfigError, refusal

Scenes = Annotated[dict[Name, Any], Field(description="a mapping from names to scenes")]
# Scenes beside the paper's own: made on request, and not varied.
MORE = ("claims", "proofs")


class Document(Block):
    """a mapping with the keys ball and scenes"""

    ball: BallBlock
    scenes: Annotated[
        dict[Name, Any],
        Field(min_length=1, description="a mapping from names to scenes, at least one"),
    ]
    variants: Annotated[dict[Name, Any], Field(description="a mapping from names to variants")] = {}
    sweeps: Annotated[dict[Name, Any], Field(description="a mapping from names to sweeps")] = {}
    claims: Scenes = {}
    proofs: Scenes = {}


def check(document) -> dict:
    """The complete config of a parsed YAML `document`; raises ConfigError where there is none.

    Its `variants` begin with the paper itself and the scenes of MORE: name -> scene -> block.
    """
    lines = mistakes(Document, document, ())
    given = {key: _mapping(document, key) for key in Document.model_fields}
    ball = None if mistakes(BallBlock, given["ball"], ()) else given["ball"]
    sets, found = {}, []
    for key in ("scenes", *MORE):
        sets[key] = {}
        for name, block in given[key].items():
            sets[key][name], wrong = checked(block, ball, (key, name))
            found += wrong
            if key in MORE and name in given["scenes"]:
                found.append(refusal((key,), name, "a name that no scene of the paper has"))
    derived = {variants.PAPER: sets.pop("scenes")} | sets
    for name, block in given["variants"].items() if not (lines or found) else ():
        derived[name], wrong = variants.derive(given, name, block)
        found += wrong
    grids = {}
    for name, block in given["sweeps"].items():
        grids[name], wrong = sweeps.checked(block, ("sweeps", name))
        found += wrong
    if lines or found:
        raise ConfigError(*dict.fromkeys(lines + found))
    return {
        "ball": ball,
        "scenes": derived[variants.PAPER],
        "variants": derived,
        "sweeps": grids,
    }


def _mapping(document, key):
    """A part of a document whose structure may be wrong."""
    value = document.get(key) if isinstance(document, dict) else None
    return value if isinstance(value, dict) else {}
