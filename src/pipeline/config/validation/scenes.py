"""One scene: complete, or what is wrong with it."""

from ..schema.kinds import KINDS
from .mistakes import complete, mistakes, readable
from .words import dotted, refusal


def checked(given, ball, place, said=None):
    """(complete block, []) of a scene as given, or (None, a line for each mistake).

    `ball` is that of a scene without one. `said` has, for a field that was given elsewhere, the
    place where: a mistake in it is told there.
    """
    if not isinstance(given, dict):
        return None, [refusal(place, given, "a mapping that begins with picture")]
    what = f"one of {', '.join(KINDS)}"
    if "picture" not in given:
        return None, [f"{dotted((*place, 'picture'))}: missing: expected {what}"]
    kind = KINDS.get(given["picture"]) if isinstance(given["picture"], str) else None
    if kind is None:
        return None, [refusal((*place, "picture"), given["picture"], what)]
    said = ({} if "ball" in given else {"ball": ("ball",)}) | (said or {})
    lines = mistakes(kind, given, place)
    if ball is None or (lines and not readable(kind, given)):
        return None, lines
    block = complete(kind, {"ball": ball} | given)
    lines += [
        refusal((*said.get(where[0], (*place, where[0])), *where[1:]), value, allowed)
        for where, value, allowed in kind.cross_field_errors(block)
    ]
    return (None, lines) if lines else (block, [])
