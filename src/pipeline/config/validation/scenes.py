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
    origins: Mapping[str, Place] | None = None,
) -> tuple[YamlMapping, list[str]]:
    """Return a scene's complete block and a line for each mistake; with mistakes the block is {}.

    `ball` is the ball of a scene without one, or None if it has mistakes itself. `origins` maps
    fields that were written elsewhere to the places where their mistakes should be reported.
    """
    if not isinstance(given, dict):
        return {}, [refusal(place, given, "a mapping that begins with picture")]
    words = f"one of {', '.join(KINDS)}"
    if "picture" not in given:
        return {}, [f"{dotted((*place, 'picture'))}: missing: expected {words}"]
    kind = KINDS.get(given["picture"]) if isinstance(given["picture"], str) else None
    if kind is None:
        return {}, [refusal((*place, "picture"), given["picture"], words)]
    lines = mistakes(kind, given, place)
    if ball is None or (lines and not has_types(kind, given)):
        return {}, lines
    block = complete(kind, {"ball": ball} | given)
    places: dict[int | str, Place] = {} if "ball" in given else {"ball": ("ball",)}
    places.update(origins or {})
    for (field, *inner), value, allowed in kind.cross_field_errors(block):
        lines.append(refusal((*places.get(field, (*place, field)), *inner), value, allowed))
    return ({}, lines) if lines else (block, [])
