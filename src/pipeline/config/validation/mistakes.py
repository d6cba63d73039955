"""Mistakes in a config, a line for each: place, value, and what is allowed.

What is allowed at a place is read from the JSON schema that pydantic makes from the declaration.
"""

from collections.abc import Iterable, Iterator
from contextlib import suppress
from functools import cache
from itertools import islice
from typing import Any, NamedTuple, TypeVar

from pydantic import ValidationError

from ...spelling import suggestion
from ..schema.fields import NAME, TAGS, TYPES_ALONE, Block, mapping_with

Place = tuple[int | str, ...]  # keys and indices that lead to a value
_LONGEST_VALUE = 60  # characters of a value in a message
# Kinds of mistakes, in the order in which those of a mapping are reported. A misspelt key leaves
# the right one missing: only the former is reported.
_UNKNOWN_KEY, _MISSING, _WRONG = range(3)
# pydantic's names; the second is that of keys that are not text
_KINDS = {"extra_forbidden": _UNKNOWN_KEY, "invalid_key": _UNKNOWN_KEY, "missing": _MISSING}
AnyBlock = TypeVar("AnyBlock", bound=Block)


class Mistake(NamedTuple):
    """A mistake in the config: its place, words about it, and the key if the mistake is a key."""

    place: Place
    words: str
    key: str | None = None

    def __str__(self) -> str:
        return f"{dotted(self.place)}: {self.words}" if self.place else self.words


class ConfigError(Exception):
    """Mistakes in the config, a line for each: place, value, and what is allowed."""

    def __init__(self, *mistakes: Mistake | str) -> None:
        self.mistakes = mistakes
        # A key may contain line breaks, but a mistake must stay on its line.
        self.lines = tuple(
            "".join(c if c.isprintable() else repr(c)[1:-1] for c in line)
            for line in map(str, mistakes)
        )
        super().__init__("\n".join(self.lines))


def validate(
    model: type[AnyBlock], given: object, place: Place
) -> tuple[AnyBlock | None, list[Mistake]]:
    """Return a block and the mistakes in it, the topmost first.

    The block is None if a value has the wrong type, so that no check between fields is possible.
    """
    try:
        return model.model_validate(given), []
    except ValidationError as error:
        mistakes = list(_mistakes(model, error, place))
    with suppress(ValidationError):
        return model.model_validate(given, context=TYPES_ALONE), mistakes
    return None, mistakes


def _mistakes(model: type[Block], error: ValidationError, place: Place) -> Iterator[Mistake]:
    """Yield each mistake in a block, which stands at `place`."""
    mistakes = []
    for each in error.errors(include_url=False, include_context=False):
        loc, kind = each["loc"], _KINDS.get(each["type"], _WRONG)
        if each["type"] == "literal_error" and loc[-1] == "[key]":  # not among those of a mapping
            loc, kind = loc[:-1], _UNKNOWN_KEY
        mistakes.append((loc, kind, each["input"]))
    mistakes.sort(key=lambda mistake: (len(mistake[0]), mistake[1]))
    unknown_keys = {loc for loc, kind, _ in mistakes if kind == _UNKNOWN_KEY}
    misspelt = {loc[:-1] for loc in unknown_keys}
    for loc, kind, value in mistakes:
        where = (*place, *(part for part in loc if part not in TAGS))
        if words := getattr(model, "removed", {}).get(loc[0]) if len(loc) == 1 else None:
            yield Mistake(where, words)
        elif kind == _UNKNOWN_KEY:
            node = _node(model, loc[:-1])
            known = list(node.get("properties") or node["propertyNames"]["enum"])
            hint = suggestion(where[-1], known) or f"allowed here: {', '.join(known)}"
            yield Mistake(where, f"unknown key: {hint}")
        elif any(loc[: len(key)] == key for key in unknown_keys):
            continue
        elif loc[-1:] == ("[key]",):
            yield refusal(where[:-2], value, NAME, key=value)
        elif kind == _WRONG:
            yield refusal(where, value, allowed_at(model, loc))
        elif loc[:-1] not in misspelt:
            yield Mistake(where, f"missing: expected {allowed_at(model, loc)}")


def allowed_at(model: type[Block], loc: Place) -> str:
    """Return in words what is allowed at pydantic's location `loc` in a block."""
    node = _node(model, loc)
    if "description" in node:
        return str(node["description"])
    if "enum" in node:
        return f"one of {', '.join(node['enum'])}"
    return mapping_with(node["propertyNames"]["enum"], optional=True)


_schema = cache(lambda model: model.model_json_schema())  # of a type of block


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


def refusal(place: Place, value: object, allowed: str, key: str | None = None) -> Mistake:
    """Return the mistake of a value, or of a `key` in the mapping there, that is not allowed."""
    return Mistake(place, f"{_shown(value)} is not allowed: expected {allowed}", key)


def unknown(kind: str, name: str, known: Iterable[str]) -> str:
    """Say that there is no such thing, what may be meant, and what there is."""
    names = list(known)
    hint = suggestion(name, names) or f"config.yaml has {', '.join(names) or 'none'}"
    return f"no {kind} {name}: {hint}"


def dotted(place: Place) -> str:
    """Return a place in the config in the form scenes.fig2.starts[1]."""
    texts = (f"[{part}]" if isinstance(part, int) else f".{part}" for part in place)
    return "".join(texts).removeprefix(".")


def _shown(value: object) -> str:
    """Return a value as in YAML, shortened. Aliases in YAML can make a value of any size."""
    text = "".join(islice(_pieces(value), _LONGEST_VALUE + 1))
    return text if len(text) <= _LONGEST_VALUE else text[: _LONGEST_VALUE - 3] + "..."


def _pieces(value: object) -> Iterator[str]:
    """Yield the text of a value piece by piece."""
    if isinstance(value, dict | list):
        yield "{" if isinstance(value, dict) else "["
        for i, item in enumerate(value):
            if i:
                yield ", "
            yield from _pieces(item)
            if isinstance(value, dict):
                yield ": "
                yield from _pieces(value[item])
        yield "}" if isinstance(value, dict) else "]"
    elif value is None:
        yield "nothing"
    elif isinstance(value, int) and value.bit_length() > 14_000:  # too long for decimals
        yield hex(value)
    else:
        yield str(value).lower() if isinstance(value, bool) else repr(value)
