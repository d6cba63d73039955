"""Validation of one scene."""

from collections.abc import Mapping

from ..schema.fields import YamlMapping
from ..schema.kinds import KINDS
from .mistakes import complete, has_types, mistakes
from .words import Place, dotted, refusal


def checked(
    given: object,
    ball: YamlMapping | None,
    place: Place,
    origins: Mapping[int | str, Place] | None = None,
) -> tuple[YamlMapping, list[str]]:
    """Return a scene's complete block and a line for each mistake; with mistakes the block is {}.

    `ball` is the ball of a scene without one, or None if it has mistakes itself. `origins` maps
    fields that were written elsewhere to the places where their mistakes should be reported.
    """
    if not isinstance(given, dict):
        return {}, [refusal(place, given, "a mapping that begins with picture")]
    words, picture = f"one of {', '.join(KINDS)}", (*place, "picture")
    if "picture" not in given:
        return {}, [f"{dotted(picture)}: missing: expected {words}"]
    if not isinstance(given["picture"], str) or given["picture"] not in KINDS:
        return {}, [refusal(picture, given["picture"], words)]
    kind = KINDS[given["picture"]]
    lines = mistakes(kind, given, place)
    if ball is None or (lines and not has_types(kind, given)):
        return {}, lines
    block = complete(kind, {"ball": ball} | given)
    places = ({} if "ball" in given else {"ball": ("ball",)}) | dict(origins or {})
    for (field, *inner), value, allowed in kind.cross_field_errors(block):
        lines.append(refusal((*places.get(field, (*place, field)), *inner), value, allowed))
    return ({}, lines) if lines else (block, [])
