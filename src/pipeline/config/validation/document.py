"""Validation of a whole config: every scene is completed, or all mistakes are reported at once."""

from typing import Annotated, Any

from pydantic import create_model

from ...commands import all_commands
from ...declaration import extensions, imported
from ..paths import Config, Variants
from ..schema.fields import ABSENT, NOT_EMPTY, BallBlock, Block, Name, YamlMapping, allowed
from ..schema.scene import Picture
from ..schema.sets import PAPER, SETS
from ..schema.variant import Variant
from . import scenes
from .mistakes import validate
from .words import ConfigError, refusal

_SCENES = Annotated[dict[Name, Any], allowed("a mapping from names to scenes")]
_AT_LEAST_ONE = allowed("a mapping from names to scenes, at least one", min_length=1)
_VARIANTS = Annotated[
    dict[Name, Annotated[Variant, NOT_EMPTY]], allowed("a mapping from names to variants")
]
# Key -> the class of a block of an extension that is no scenes.
BLOCKS: dict[str, type[Block]] = {
    key: imported(place) for each in extensions().values() for key, place in each.blocks.items()
}


class _Document(Block):
    """a mapping with the keys ball and scenes"""

    ball: BallBlock
    scenes: dict[Name, Any] = _AT_LEAST_ONE
    variants: _VARIANTS = {}


_OF_EXTENSIONS: dict[str, Any] = {
    **{each.key: (_SCENES, {}) for name, each in SETS.items() if each.key and name != PAPER},
    **{key: (block, ABSENT) for key, block in BLOCKS.items()},
}
Document = create_model("Document", __base__=_Document, __doc__=_Document.__doc__, **_OF_EXTENSIONS)


def check(given: object) -> Config:
    """Return the complete config of a parsed YAML document.

    Raises ConfigError with a line for each mistake.
    """
    document, lines = validate(Document, given, ())
    blocks = given.items() if isinstance(given, dict) else ()
    parts = {key: block for key, block in blocks if isinstance(block, dict)}
    ball, _ = validate(BallBlock, parts.get("ball"), ())
    if ball and not ball.g < ball.k:
        lines.append(refusal(("ball", "g"), ball.g, f"0 < g < k = {ball.k}"))
        ball = None
    own_ball = ball.as_mapping() if ball else None
    variants, left_out = Variants(), dict[str, dict[str, str]]()
    for name in SETS:
        variants[name], more = _scenes_of_set(name, parts, own_ball)
        lines += more
    if document and own_ball and not lines:
        for name, variant in document.variants.items():
            derived = scenes.derive_variant(parts["scenes"], own_ball, name, variant)
            variants[name], left_out[name], more = derived
            lines += more
    if lines or document is None:
        raise ConfigError(*dict.fromkeys(lines))
    return Config(variants, left_out, {k: v for k, v in document if k in BLOCKS and v})


def _scenes_of_set(
    name: str, parts: YamlMapping, ball: YamlMapping | None
) -> tuple[dict[str, Picture], list[str]]:
    """Return the scenes of a set that can be checked, and a line for each mistake."""
    declared, found, lines = SETS[name], dict[str, Picture](), list[str]()
    key = declared.key or name
    given = imported(declared.scenes)() if declared.scenes else parts.get(key, {})
    if declared.kind:
        kind = {"picture": declared.kind}
        given = {
            s: kind | block if isinstance(block, dict) else block for s, block in given.items()
        }
    for scene, block in given.items():
        checked, mistakes = scenes.check_scene(block, ball, (key, scene), given)
        lines += mistakes
        if scene in all_commands() or scene == "all":
            lines.append(refusal((key,), scene, "a name that is no command of ./reproduce"))
        if name != PAPER and scene in parts.get("scenes", {}):
            lines.append(refusal((key,), scene, "a name that no scene of the paper has"))
        if checked:
            found[scene] = checked
    return found, lines
