"""The types of the fields of config.yaml.

Each field has three parts: pydantic's constraints; the words for what is allowed, which error
messages and docs/config.md quote; and, as its docstring, what it means, for the documents.

A checked config has these models. `Block.as_mapping` makes what is recorded of one.
"""

import importlib
import re
from collections.abc import Callable, Iterable, Sequence
from typing import Annotated, Any, ClassVar, Literal

import pydantic
from annotated_types import Predicate
from pydantic import BaseModel, ConfigDict, Discriminator, Field, Tag

from pseudorigid.dynamics.bounds import G_ALLOWED, K_ALLOWED

YamlMapping = dict[str, Any]  # a mapping of config.yaml as YAML made it, or can write it
ABSENT: Any = None  # the default of a field that may be left out and then has no value

# Largest number of impacts, or of points of a manifold, that a scene may ask for. It stops typing
# errors before they cost hours.
LARGEST = 10_000_000

TYPES_ALONE = "types alone"  # the context in which values only need to have the right type
_OF_VALUES = {"predicate_failed", "multiple_of"}  # errors of values that have the right type


def mapping_with(keys: Sequence[str], optional: bool = False) -> str:
    """Return in words that a mapping with these keys is allowed."""
    *others, last = keys
    names = f"keys {', '.join(others)} and {last}" if others else f"key {last}"
    more = f", or {'one' if len(keys) == 2 else 'some'} of them"
    return f"a mapping with the {names}{more * optional}"


def _describe(schema: YamlMapping, model: type["Block"]) -> None:
    """Write into a JSON schema which keys a mapping needs or, if it needs none, may have."""
    required = schema.get("required", [])
    schema["description"] = model.words or mapping_with(
        required or [*schema["properties"]], optional=not required
    )


class Block(BaseModel):
    """A mapping of the config. Unknown keys are mistakes, and so are numbers in quotes."""

    model_config = ConfigDict(
        extra="forbid", strict=True, allow_inf_nan=False, json_schema_extra=_describe
    )
    words: ClassVar[str] = ""  # what is allowed, if that is not a mapping with the required keys

    @pydantic.field_validator("*", mode="wrap")
    @classmethod
    def _field(cls, given: Any, check: Callable[[Any], Any], info: pydantic.ValidationInfo) -> Any:
        """Return a field's value with numbers as written: records distinguish 1 from 1.0.

        In the context TYPES_ALONE, a value of the right type that is not allowed stays as it is.
        """
        try:
            return _as_written(check(given), given)
        except pydantic.ValidationError as error:
            kinds = {each["type"] for each in error.errors(include_url=False)}
            if info.context == TYPES_ALONE and kinds <= _OF_VALUES:
                return given
            raise

    def as_mapping(self, keys: Iterable[str] | None = None) -> YamlMapping:
        """Return the fields that have a value, or those of some keys, as YAML or JSON has them."""
        mapping = self.model_dump(by_alias=True, exclude_none=True)
        return mapping if keys is None else {key: mapping[key] for key in keys if key in mapping}


def _as_written(checked: Any, given: Any) -> Any:
    """Return what a value was validated to, with all numbers as they were given."""
    if checked is given:  # of type Any: YAML's aliases can make a value of any size
        return given
    if isinstance(checked, list):
        return [_as_written(*pair) for pair in zip(checked, given, strict=True)]
    if isinstance(checked, dict):
        return {key: _as_written(value, given[key]) for key, value in checked.items()}
    return checked if isinstance(checked, Block) else given


def declared_in(module: str) -> dict[str, Any]:
    """Return the blocks of a part's module by their names, from CamelCase to snake_case."""
    found = {}
    for name, value in vars(importlib.import_module(module)).items():
        if isinstance(value, type) and issubclass(value, Block) and value.__module__ == module:
            found[re.sub("(?<=[a-z])(?=[A-Z])", "_", name).lower()] = value
    return found


def allowed(words: str, **constraints: Any) -> Any:
    """Return a pydantic field with these constraints, and the words that describe them."""
    return Field(description=words, **constraints)


def whole(low: int, high: int, multiple: int = 1) -> Any:
    """Return the field of a whole number from `low` to `high`, a multiple of `multiple`."""
    more = f", a multiple of {multiple}" if multiple > 1 else ""
    words = f"a whole number from {low} to {high}{more}"
    return allowed(words, ge=low, le=high, multiple_of=multiple)


def distinct(items: Sequence[Any]) -> bool:
    """Return whether no item occurs twice."""
    return len(set(items)) == len(items)


def rising(numbers: Sequence[float]) -> bool:
    """Return whether each number is above the one before."""
    return [*numbers] == sorted(set(numbers))


NOT_EMPTY = Predicate(lambda block: bool(block.model_fields_set))  # of a block with optional fields

# A union of two types names them by tags, of which pydantic makes a part of an error's location.
TAGS = ("(first)", "(second)")
FIRST, SECOND = map(Tag, TAGS)


def first_if(*types: type) -> Discriminator:
    """Return the rule that a value of these types is validated by the first type of a union."""
    return Discriminator(lambda value: TAGS[not isinstance(value, types)])


Inertia = Annotated[float, allowed(K_ALLOWED, gt=0, le=1)]
Gravity = Annotated[float, allowed(G_ALLOWED, gt=0)]
Energy = Annotated[float, allowed("a number with -g^2/(2k) < energy < k/2 - g")]
Number = Annotated[float, allowed("a number")]
Range = Annotated[
    list[Number],
    allowed("a list of two increasing numbers", min_length=2, max_length=2),
    Predicate(rising),
]
# A JSON schema describes no keys, so that these words stand apart from the pattern.
NAME = "a name of letters, digits, - and _ that does not begin with -"
Name = Annotated[str, Field(pattern=r"^[A-Za-z0-9_][A-Za-z0-9_-]*$")]


class BallBlock(Block):
    """The ball of a scene."""

    k: Inertia
    """Dimensionless Euler inertia of the ball: 1/5 = 0.2 for a solid sphere, 1/3 for a thin shell.
    Values above 1/3 belong to no sphere."""
    g: Gravity
    """Gravity in R omega^2. Apart from scale, the dynamics depends only on k and E/g^2."""


class PartOfBall(Block):
    """The parameters of the ball that a variant changes."""

    k: Inertia = ABSENT
    """Dimensionless Euler inertia."""
    g: Gravity = ABSENT
    """Gravity in R omega^2."""


class Axis(Block):
    """An axis of a picture."""

    limits: Range
    """Both ends of the axis, in the unit of its quantity. What lies outside is not drawn. An axis
    that is left out holds its data, and in a box the whole energy surface."""
    ticks: list[Number] = allowed("a list of 1 to 50 numbers", min_length=1, max_length=50)
    """Positions of the tick marks and their labels, within the limits."""


class Point(Block):
    """A point of the section."""

    words = "a mapping with the keys x and xdot, or x and y = xdot - k udot"

    x: Number
    """Position of the mass centre at impact, downwards, in R."""
    xdot: Number = ABSENT
    """Velocity of the mass centre just before impact, in omega R. Give either this or `y`; udot
    follows from the energy."""
    y: Number = ABSENT
    """The coordinate y = xdot - k udot of the section, in omega R."""


Fraction = Annotated[float, allowed("a fraction with -1 < start < 1", gt=-1, lt=1)]
_Format = Literal["png", "svg", "pdf"]
Formats = Annotated[
    list[_Format],
    allowed("a list of png, svg, pdf that has png in it, none of them twice", min_length=1),
    Predicate(distinct),
    Predicate(lambda given: "png" in given),
]
NoFormats = Annotated[list[_Format], allowed("an empty list: there is no picture", max_length=0)]
