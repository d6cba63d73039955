"""Validation of a whole config: every scene is completed, or all mistakes are reported at once."""

import re
from typing import Annotated, Any

from ..schema.fields import NOT_EMPTY, BallBlock, Block, Name, YamlMapping, allowed
from ..schema.published import PAPER, PUBLISHED
from ..schema.sweep import Sweep
from ..schema.variant import Prove, Variant
from . import scenes, sweeps
from .mistakes import complete, mistakes
from .words import ConfigError, refusal

# Commands of ./reproduce. A scene of the same name could not be asked for.
COMMANDS = (
    *("list", "variant", "compare", "sweep", "atlas", "study", "claims", "families", "prove"),
    *("report", "explore", "article", "site", "archive", "verify", "accept", "clean", "benchmark"),
    *("test", "help", "all"),
)
_Scenes = Annotated[dict[Name, Any], allowed("a mapping from names to scenes")]


class Document(Block):
    """a mapping with the keys ball and scenes"""

    ball: BallBlock
    scenes: dict[Name, Any] = allowed("a mapping from names to scenes, at least one", min_length=1)
    variants: Annotated[
        dict[Name, Annotated[Variant, NOT_EMPTY]], allowed("a mapping from names to variants")
    ] = {}
    sweeps: Annotated[dict[Name, Sweep], allowed("a mapping from names to sweeps")] = {}
    claims: _Scenes = {}
    families: _Scenes = {}
    proofs: _Scenes = {}
    prove: Prove = {"impacts": 20_000}  # type: ignore[assignment]


def check(document: object) -> YamlMapping:
    """Return the complete config of a parsed YAML document: ball, scenes, variants, sweeps, prove.

    The variants are mappings name -> scene -> block; the first of them are the paper itself and the
    scenes that are drawn on request. `left_out` maps other variants to the scenes that they cannot
    have, with the reasons. Raises ConfigError with a line for each mistake.
    """
    lines = mistakes(Document, document, ())
    given = complete(Document, document if isinstance(document, dict) else {})
    given = {key: part if isinstance(part, dict) else {} for key, part in given.items()}
    ball = None if mistakes(BallBlock, given.get("ball"), ()) else given["ball"]
    if ball and not ball["g"] < ball["k"]:
        lines.append(refusal(("ball", "g"), ball["g"], f"0 < g < k = {ball['k']}"))
        ball = None
    left_out: dict[str, dict[str, str]] = {}
    derived: dict[str, YamlMapping] = {variant: {} for variant in PUBLISHED}
    for variant, blocks in derived.items():
        key = "scenes" if variant == PAPER else variant
        for name, block in given.get(key, {}).items():
            blocks[name], scene_lines = scenes.checked(block, ball, (key, name))
            lines += scene_lines
            if name in COMMANDS:
                lines.append(refusal((key,), name, "a name that is no command of ./reproduce"))
            if variant != PAPER and name in given.get("scenes", {}):
                lines.append(refusal((key,), name, "a name that no scene of the paper has"))
    for name, block in given["variants"].items() if not lines else ():
        derived[name], left_out[name], variant_lines = scenes.derive(given, name, block)
        lines += variant_lines
    grids = {}
    for name, block in given["sweeps"].items():
        grids[name], sweep_lines = sweeps.checked(block, ("sweeps", name))
        lines += sweep_lines
        if re.fullmatch(r".+_\d{4}", str(name)) and name[:-5] in given["sweeps"]:
            words = f"a name that no block of the sweep {name[:-5]} has"
            lines.append(refusal(("sweeps",), name, words))
    for name in [name for name, sweep in grids.items() if "chains" in sweep]:
        if f"{name}_chains" in grids:
            words = f"a name that no picture of the sweep {name} has"
            lines.append(refusal(("sweeps",), f"{name}_chains", words))
    if lines:
        raise ConfigError(*dict.fromkeys(lines))
    parts = {"scenes": derived[PAPER], "variants": derived, "sweeps": grids}
    return {"ball": ball, **parts, "left_out": left_out, "prove": given["prove"]}
