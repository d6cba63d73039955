"""Whether a block fits its declaration: pydantic's findings in our words, all of them."""

import math
import typing
from contextlib import suppress

from pydantic import TypeAdapter, ValidationError
from pydantic.fields import FieldInfo

from ..schema.fields import TAGS, Block
from .words import dotted, meant, refusal

_UNKNOWN = ("extra_forbidden", "invalid_key")  # keys that there are not, the second no text
_OF_VALUES = {"predicate_failed", "multiple_of"}  # findings about values of the right type


def mistakes(model, given, place) -> list[str]:
    """A line for each mistake in `given`, which stands at `place`; the topmost first.

    `model` is a Block, or any other type with descriptions.
    """
    found = _errors(model, given)
    # A misspelt key leaves the right one missing: say the former first.
    rank = dict.fromkeys(_UNKNOWN, 0) | {"missing": 1}
    found.sort(key=lambda e: (len(e["loc"]), rank.get(e["type"], 2)))
    misspelt = {e["loc"][:-1] for e in found if e["type"] in _UNKNOWN}
    return [
        _line(model, error, place)
        for error in found
        if not (error["type"] == "missing" and error["loc"][:-1] in misspelt)
    ]


def readable(model, given) -> bool:
    """Whether all has its type, so that what is wrong between fields can be told too."""
    return {error["type"] for error in _errors(model, given)} <= _OF_VALUES


def _errors(model, given):
    """What pydantic finds."""
    try:
        TypeAdapter(model).validate_python(given)
    except ValidationError as error:
        return error.errors(include_url=False, include_context=False)
    return []


def complete(model: type[Block], given: dict) -> dict:
    """A correct block with the defaults of what it leaves out."""
    defaults = {
        name: field.default
        for name, field in model.model_fields.items()
        if not field.is_required() and field.default is not None
    }
    return defaults | given


def _line(model, error, place) -> str:
    loc = error["loc"]
    where = (*place, *(part for part in loc if part not in TAGS))
    if error["type"] in _UNKNOWN:
        known = list(allowed_at(model, loc[:-1])[0].model_fields)
        (hint,) = meant(loc[-1], known) or [f"allowed here: {', '.join(known)}"]
        return f"{dotted(where)}: unknown key: {hint}"
    if loc[-1:] == ("[key]",):
        where = where[:-2]
    annotation, allowed = allowed_at(model, loc)
    if error["type"] == "missing":
        return f"{dotted(where)}: missing: expected {allowed}"
    value = error["input"]
    if isinstance(value, str):
        number = _number_in(value)
        if number is not None and not mistakes(annotation, number, ()):
            plain = repr(number)
            if "." not in plain:
                plain = plain.replace("e", ".0e")  # YAML 1.1 takes 1e-3 for text
            allowed += f"; this is text to YAML, write {plain}"
    return refusal(where, value, allowed)


def allowed_at(annotation, loc):
    """(type, what is allowed in words) at a place of pydantic's below a type."""
    allowed, tagged = "something else", False
    while True:
        if isinstance(annotation, FieldInfo):
            allowed = annotation.description or allowed
            annotation = annotation.rebuild_annotation()
        whole = annotation
        if typing.get_origin(annotation) is typing.Annotated:
            annotation, *metadata = typing.get_args(annotation)
            for item in metadata:
                allowed = getattr(item, "description", None) or allowed
        if isinstance(annotation, type) and issubclass(annotation, Block):
            if not tagged:
                allowed = annotation.__doc__.partition("\n")[0]
            if not loc:
                return annotation, allowed
            annotation, loc, tagged = annotation.model_fields[loc[0]], loc[1:], False
            continue
        if loc in ((), ("[key]",)):
            return whole, allowed
        mapped = typing.get_origin(annotation) is dict and loc[1:] != ("[key]",)
        tagged = loc[0] in TAGS
        place = TAGS.index(loc[0]) if tagged else int(mapped)
        annotation, loc = typing.get_args(annotation)[place], loc[1:]


def _number_in(text):
    """The number that a text was meant to be, whole where it can be, or None."""
    with suppress(ValueError):
        number = float(text)
        if math.isfinite(number):
            return int(number) if number.is_integer() and abs(number) < 1e15 else number
    return None
