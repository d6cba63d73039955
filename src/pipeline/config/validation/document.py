"""Validation of a whole config: every scene is completed, or all mistakes are reported at once."""

from typing import Annotated, Any

from pydantic import create_model

from ...commands import all_commands
from ...declaration import extensions, imported
from ..paths import Config
from ..schema.fields import ABSENT, NOT_EMPTY, BallBlock, Block, Name, YamlMapping, allowed
from ..schema.sets import PAPER, SETS
from ..schema.variant import Variant
from . import scenes
from .mistakes import complete, mistakes
from .words import ConfigError, refusal

_SCENES = Annotated[dict[Name, Any], allowed("a mapping from names to scenes")]
_AT_LEAST_ONE = allowed("a mapping from names to scenes, at least one", min_length=1)
_VARIANTS = Annotated[
    dict[Name, Annotated[Variant, NOT_EMPTY]], allowed("a mapping from names to variants")
]
KEYS = {name: each.key for name, each in SETS.items() if each.key}  # set -> key of config.yaml


# Key -> the class of a block of an extension that is no scenes.
BLOCKS: dict[str, type[Block]] = {
    key: imported(place) for each in extensions().values() for key, place in each.blocks.items()
}
_FIELDS: dict[str, Any] = {
    "ball": (BallBlock, ...),
    "scenes": (dict[Name, Any], _AT_LEAST_ONE),
    "variants": (_VARIANTS, {}),
    **{key: (_SCENES, {}) for name, key in KEYS.items() if name != PAPER},
    **{key: (block, ABSENT) for key, block in BLOCKS.items()},
}
Document = create_model(
    "Document", __base__=Block, __doc__="a mapping with the keys ball and scenes", **_FIELDS
)


def check(document: object) -> Config:
    """Return the complete config of a parsed YAML document.

    Raises ConfigError with a line for each mistake.
    """
    lines = mistakes(Document, document, ())
    given = complete(Document, document if isinstance(document, dict) else {})
    given = {key: part if isinstance(part, dict) else {} for key, part in given.items()}
    ball = None if mistakes(BallBlock, given.get("ball"), ()) else given["ball"]
    if ball and not ball["g"] < ball["k"]:
        lines.append(refusal(("ball", "g"), ball["g"], f"0 < g < k = {ball['k']}"))
        ball = None
    commands = all_commands()
    left_out: dict[str, dict[str, str]] = {}
    derived: dict[str, YamlMapping] = {name: {} for name in SETS}
    for name, blocks in derived.items():
        key = KEYS.get(name, name)
        found = given.get(key, {}) if name in KEYS else imported(SETS[name].scenes)()
        if kind := SETS[name].kind:
            found = {
                s: {"picture": kind} | b if isinstance(b, dict) else b for s, b in found.items()
            }
        for scene, block in found.items():
            blocks[scene], scene_lines = scenes.checked(block, ball, (key, scene), found)
            lines += scene_lines
            if scene in commands or scene == "all":
                lines.append(refusal((key,), scene, "a name that is no command of ./reproduce"))
            if name != PAPER and scene in given.get("scenes", {}):
                lines.append(refusal((key,), scene, "a name that no scene of the paper has"))
    for name, block in given["variants"].items() if not lines else ():
        derived[name], left_out[name], variant_lines = scenes.derive(given, name, block)
        lines += variant_lines
    if lines:
        raise ConfigError(*dict.fromkeys(lines))
    return Config(
        ball or {}, derived, left_out, {key: given[key] for key in BLOCKS if key in given}
    )
