"""Validation of a block by its declaration: pydantic's errors in this project's words.

What is allowed at a place is read from the JSON schema that pydantic makes from the declaration.
"""

from contextlib import suppress
from functools import cache
from typing import Any, TypeVar

from pydantic import ValidationError

from ...records.names import suggestion
from ..schema.fields import NAME, TAGS, TYPES_ALONE, Block
from .words import Place, dotted, refusal

_UNKNOWN_KEY = ("extra_forbidden", "invalid_key")  # pydantic's names; the second for keys not text
AnyBlock = TypeVar("AnyBlock", bound=Block)


def validate(
    model: type[AnyBlock], given: object, place: Place
) -> tuple[AnyBlock | None, list[str]]:
    """Return a block and a line for each mistake in it, the topmost first.

    The block is None if a value has the wrong type, so that no check between fields is possible.
    """
    try:
        return model.model_validate(given), []
    except ValidationError as error:
        lines = _lines(model, error, place)
    with suppress(ValidationError):
        return model.model_validate(given, context=TYPES_ALONE), lines
    return None, lines


def _lines(model: type[Block], error: ValidationError, place: Place) -> list[str]:
    """Return a line for each mistake in a block, which stands at `place`."""
    errors = _errors(error)
    # A misspelt key leaves the right one missing: report the former only, and first.
    rank = dict.fromkeys(_UNKNOWN_KEY, 0) | {"missing": 1}
    errors.sort(key=lambda error: (len(error[0]), rank.get(error[1], 2)))
    unknown = {loc for loc, kind, _ in errors if kind in _UNKNOWN_KEY}
    misspelt = {loc[:-1] for loc in unknown}
    return [
        _line(model, loc, kind, value, place)
        for loc, kind, value in errors
        if not (kind == "missing" and loc[:-1] in misspelt)
        and (kind in _UNKNOWN_KEY or not any(loc[: len(key)] == key for key in unknown))
    ]


def allowed_at(model: type[Block], loc: Place) -> str:
    """Return in words what is allowed at pydantic's location `loc` in a block."""
    node = _node(model, loc)
    if "description" in node:
        return str(node["description"])
    if "enum" in node:
        return f"one of {', '.join(node['enum'])}"
    *keys, last = node["propertyNames"]["enum"]
    return f"a mapping with the keys {', '.join(keys)} and {last}, or some of them"


@cache
def _schema(model: type[Block]) -> dict[str, Any]:
    return model.model_json_schema()


def _node(model: type[Block], loc: Place) -> dict[str, Any]:
    """Return the part of a model's JSON schema for the values at a location."""
    node = whole = _schema(model)
    for part in loc:
        if part in TAGS:
            node = {"description": node["description"]} | node["oneOf"][TAGS.index(str(part))]
        elif "items" in node:
            node = node["items"]
        elif part in node.get("properties", {}):
            node = node["properties"][part]
        else:
            (node,) = node.get("patternProperties", {}).values() or [node["additionalProperties"]]
        if "$ref" in node:
            node = whole["$defs"][node["$ref"].rpartition("/")[2]] | node
    return node


def _errors(error: ValidationError) -> list[tuple[Place, str, Any]]:
    """Return the location, pydantic's name and the value of each mistake."""
    found = error.errors(include_url=False, include_context=False)
    errors = [(e["loc"], e["type"], e["input"]) for e in found]
    # A key that is not among those of a mapping is unknown, as in a block.
    return [
        (loc[:-1], _UNKNOWN_KEY[0], value)
        if kind == "literal_error" and loc[-1] == "[key]"
        else (loc, kind, value)
        for loc, kind, value in errors
    ]


def _line(model: type[Block], loc: Place, kind: str, value: object, place: Place) -> str:
    """Return the line for one error."""
    where = (*place, *(part for part in loc if part not in TAGS))
    if kind in _UNKNOWN_KEY:
        node = _node(model, loc[:-1])
        known = list(node.get("properties") or node["propertyNames"]["enum"])
        hint = suggestion(where[-1], known) or f"allowed here: {', '.join(known)}"
        return f"{dotted(where)}: unknown key: {hint}"
    if loc[-1:] == ("[key]",):
        return refusal(where[:-2], value, NAME)
    words = allowed_at(model, loc)
    if kind == "missing":
        return f"{dotted(where)}: missing: expected {words}"
    return refusal(where, value, words)
