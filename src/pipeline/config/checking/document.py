"""A whole config, checked: every scene made complete, or all its mistakes told at once."""

from typing import Annotated, Any

from pydantic import Field

from ..declared.fields import BallBlock, Block, Name
from ..declared.variant import Prove
from . import sweeps, variants
from .mistakes import mistakes
from .scenes import checked
from .words import ConfigError, refusal

Scenes = Annotated[dict[Name, Any], Field(description="a mapping from names to scenes")]
# Scenes beside the paper's own: made on request, and not varied.
MORE = ("claims", "proofs")
# The words of ./reproduce, which are told from names of figures by being words.
WORDS = ("list", "variant", "compare", "sweep", "atlas", "study", "claims", "prove", "report")
WORDS += ("archive", "verify", "accept", "clean", "benchmark", "test", "help", "all")


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
    prove: Prove = {"impacts": 20_000}


def check(document) -> dict:
    """The complete config of a parsed YAML document.

    Parameters
    ----------
    document : object
        What YAML made of the file.

    Returns
    -------
    dict
        ball, scenes, variants, sweeps and prove. Its variants begin with the paper itself and the
        scenes of MORE: name -> scene -> block.

    Raises
    ------
    ConfigError
        Where there is none, with a line for each mistake.
    """
    lines = mistakes(Document, document, ())
    parts = document if isinstance(document, dict) else {}
    given = {key: parts.get(key) for key in Document.model_fields}
    given = {key: part if isinstance(part, dict) else {} for key, part in given.items()}
    ball = None if mistakes(BallBlock, given["ball"], ()) else given["ball"]
    sets, found = {}, []
    for key in ("scenes", *MORE):
        sets[key] = {}
        for name, block in given[key].items():
            sets[key][name], wrong = checked(block, ball, (key, name))
            found += wrong
            if name in WORDS:
                found.append(refusal((key,), name, "a name that is no word of ./reproduce"))
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
        "prove": given["prove"] or Document.model_fields["prove"].default,
    }
