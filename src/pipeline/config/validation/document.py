"""A whole config, checked: every scene made complete, or all its mistakes told at once."""

import re
from typing import Annotated, Any

from pydantic import Field

from ..schema.fields import BallBlock, Block, Name
from ..schema.variant import Prove
from . import sweeps, variants
from .mistakes import complete, mistakes
from .scenes import checked
from .words import ConfigError, refusal

# Scenes beside the paper's own: made on request, and not varied.
MORE = ("claims", "proofs")
# The words of ./reproduce, which are told from names of figures by being words.
WORDS = ("list", "variant", "compare", "sweep", "atlas", "study", "claims", "prove", "report")
WORDS += ("archive", "verify", "accept", "clean", "benchmark", "test", "help", "all")


def _named(what, **bounds):
    return Annotated[
        dict[Name, Any], Field(description=f"a mapping from names to {what}", **bounds)
    ]


class Document(Block):
    """a mapping with the keys ball and scenes"""

    ball: BallBlock
    scenes: _named("scenes, at least one", min_length=1)
    variants: _named("variants") = {}
    sweeps: _named("sweeps") = {}
    claims: _named("scenes") = {}
    proofs: _named("scenes") = {}
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
    given = complete(Document, document if isinstance(document, dict) else {})
    given = {key: part if isinstance(part, dict) else {} for key, part in given.items()}
    ball = None if mistakes(BallBlock, given.get("ball"), ()) else given["ball"]
    sets, found = {}, []
    for key in ("scenes", *MORE):
        sets[key] = {}
        for name, block in given.get(key, {}).items():
            sets[key][name], wrong = checked(block, ball, (key, name))
            found += wrong
            if name in WORDS:
                found.append(refusal((key,), name, "a name that is no word of ./reproduce"))
            if key in MORE and name in given.get("scenes", {}):
                found.append(refusal((key,), name, "a name that no scene of the paper has"))
    derived = {variants.PAPER: sets.pop("scenes")} | sets
    for name, block in given["variants"].items() if not (lines or found) else ():
        derived[name], wrong = variants.derive(given, name, block)
        found += wrong
    grids = {}
    for name, block in given["sweeps"].items():
        grids[name], wrong = sweeps.checked(block, ("sweeps", name))
        found += wrong
        if re.fullmatch(r".+_\d{4}", name) and name[:-5] in given["sweeps"]:
            what = f"a name that no block of the sweep {name[:-5]} has"
            found.append(refusal(("sweeps",), name, what))
    if lines or found:
        raise ConfigError(*dict.fromkeys(lines + found))
    return {
        "ball": ball,
        "scenes": derived[variants.PAPER],
        "variants": derived,
        "sweeps": grids,
        "prove": given["prove"],
    }
