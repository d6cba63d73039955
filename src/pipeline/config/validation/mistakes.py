"""Validation of a block by its declaration: pydantic's errors in this project's words."""

import math
import typing
from contextlib import suppress
from typing import Any

from pydantic import TypeAdapter, ValidationError
from pydantic.fields import FieldInfo
from pydantic_core import ErrorDetails

from ...records.names import suggestion
from ..schema.fields import TAGS, Block, YamlMapping, fields_of
from .words import Place, dotted, refusal

_UNKNOWN_KEY = ("extra_forbidden", "invalid_key")  # pydantic's names; the second for keys not text
_OF_VALUES = {"predicate_failed", "multiple_of"}  # errors of values that have the right type


def mistakes(model: Any, given: object, place: Place) -> list[str]:
    """Return a line for each mistake in `given`, which stands at `place`; the topmost first."""
    errors = _errors(model, given)
    # A misspelt key leaves the right one missing: report the former only, and first.
    rank = dict.fromkeys(_UNKNOWN_KEY, 0) | {"missing": 1}
    errors.sort(key=lambda e: (len(e["loc"]), rank.get(e["type"], 2)))
    misspelt = {e["loc"][:-1] for e in errors if e["type"] in _UNKNOWN_KEY}
    unknown = {e["loc"][:-1] for e in errors if _is_of_unknown_key(e)}
    return [
        _line(model, error, place)
        for error in errors
        if not (error["type"] == "missing" and error["loc"][:-1] in misspelt)
        and (_is_of_unknown_key(error) or not any(error["loc"][: len(k)] == k for k in unknown))
    ]


def has_types(model: type[Block], given: object) -> bool:
    """Return whether all values have their types, so that checks between fields are possible."""
    return {error["type"] for error in _errors(model, given)} <= _OF_VALUES


def complete(model: type[Block], given: YamlMapping) -> YamlMapping:
    """Add the defaults of the fields that a correct block leaves out."""
    fields = {key: field for key, field in fields_of(model).items() if not field.is_required()}
    defaults = {key: field.default for key, field in fields.items() if field.default is not None}
    return defaults | given


def allowed_at(annotation: Any, loc: tuple[int | str, ...]) -> tuple[Any, str]:
    """Return the type at pydantic's location `loc` in a type, and what it allows in words."""
    words, tagged = "something else", False
    while True:
        metadata = [annotation]
        if isinstance(annotation, FieldInfo):
            annotation = annotation.rebuild_annotation()
        bare = annotation
        if typing.get_origin(annotation) is typing.Annotated:
            bare, *more = typing.get_args(annotation)
            metadata += more
        if isinstance(bare, type) and issubclass(bare, Block):
            if not tagged:
                words = (bare.__doc__ or "").partition("\n")[0]
            if not loc:
                return bare, words
            annotation, loc, tagged = fields_of(bare)[str(loc[0])], loc[1:], False
            continue
        words = _words(bare, metadata) or words
        if loc in ((), ("[key]",)):
            return annotation, words
        tagged = loc[0] in TAGS
        is_value_of_dict = typing.get_origin(bare) is dict and loc[1:] != ("[key]",)
        argument = TAGS.index(str(loc[0])) if tagged else int(is_value_of_dict)
        annotation, loc = typing.get_args(bare)[argument], loc[1:]


def _words(annotation: Any, metadata: list[Any]) -> str | None:
    """Return the words that `schema.fields.allowed` gave to a field, or describe its type.

    Texts, and mappings whose keys are texts, are described by a list of the texts.
    """
    for item in metadata:
        if isinstance(item, FieldInfo) and isinstance(item.json_schema_extra, dict):
            return str(item.json_schema_extra["allowed"])
    if typing.get_origin(annotation) is typing.Literal:
        return f"one of {', '.join(typing.get_args(annotation))}"
    if typing.get_origin(annotation) is dict:
        key_type, _ = typing.get_args(annotation)
        if typing.get_origin(key_type) is typing.Literal:
            *keys, last = typing.get_args(key_type)
            return f"a mapping with the keys {', '.join(keys)} and {last}, or some of them"
    return None


def _is_of_unknown_key(error: ErrorDetails) -> bool:
    """Return whether a mapping whose keys are listed has another key."""
    return error["type"] == "literal_error" and error["loc"][-1:] == ("[key]",)


def _errors(model: Any, given: object) -> list[ErrorDetails]:
    """Return pydantic's errors about a value."""
    try:
        TypeAdapter(model).validate_python(given)
    except ValidationError as error:
        return error.errors(include_url=False, include_context=False)
    return []


def _line(model: Any, error: ErrorDetails, place: Place) -> str:
    """Return the line for one of pydantic's errors."""
    loc = error["loc"]
    where = (*place, *(part for part in loc if part not in TAGS))
    known: list[str] = []
    if error["type"] in _UNKNOWN_KEY:
        known = list(fields_of(allowed_at(model, loc[:-1])[0]))
    elif _is_of_unknown_key(error):
        known, where = list(typing.get_args(allowed_at(model, loc)[0])), where[:-1]
    if known:
        hint = suggestion(where[-1], known) or f"allowed here: {', '.join(known)}"
        return f"{dotted(where)}: unknown key: {hint}"
    if loc[-1:] == ("[key]",):
        where = where[:-2]
    annotation, words = allowed_at(model, loc)
    if error["type"] == "missing":
        return f"{dotted(where)}: missing: expected {words}"
    value = error["input"]
    if isinstance(value, str):
        number = _number_in(value)
        if number is not None and not mistakes(annotation, number, ()):
            plain = repr(number)
            if "." not in plain:
                plain = plain.replace("e", ".0e")  # YAML 1.1 reads 1e-3 as text
            words += f"; this is text to YAML, write {plain}"
    return refusal(where, value, words)


def _number_in(text: str) -> float | None:
    """Return the number that a text was meant to be, as an int if it is whole, or None."""
    with suppress(ValueError):
        number = float(text)
        if math.isfinite(number):
            return int(number) if number.is_integer() and abs(number) < 1e15 else number
    return None
