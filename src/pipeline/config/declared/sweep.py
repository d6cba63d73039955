"""What a sweep is: a grid over k and E/g^2."""

from typing import Annotated, Literal

from pydantic import Field

from .fields import Block, Gravity, Number, listed, one_or, whole


class _Span(Block):
    """a mapping with from, to and count"""

    __annotations__ = {
        "from": Number,
        "to": Number,
        "count": whole(2, 100_000),
        "spacing": Annotated[Literal["even", "log"], Field(description="even or log")],
    }
    spacing = "even"


Values = one_or(
    listed(Number, "a list of at least one number"),
    _Span,
    list,
    "a list of numbers, or a mapping with from, to and count",
)


class Sweep(Block):
    """a mapping with the keys k, energy, starts, impacts and block"""

    k: Values
    energy: Values
    g: Gravity = None
    starts: whole(1, 1_000_000)
    impacts: whole(100, 10_000_000)
    block: whole(1, 100_000)
