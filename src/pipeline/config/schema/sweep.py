"""What a sweep is: a grid over k and E/g^2."""

from typing import Any

from pydantic import create_model

from .fields import Block, Gravity, Number, listed, one_of, one_or, whole

# `from` is a keyword, so that this block cannot be written as a class.
SPAN_MEANINGS = {
    "from": "first value of the axis",
    "to": "last value of the axis",
    "count": "number of values, both ends included",
    "spacing": "`even`: equal differences between neighbours; `log`: equal ratios",
}
Span: Any = create_model(
    "Span",
    __base__=Block,
    __doc__="a mapping with from, to and count",
    **{
        "from": (Number, ...),
        "to": (Number, ...),
        "count": (whole(2, 100_000), ...),
        "spacing": (one_of("even", "log"), "even"),
    },
)
Values = one_or(
    listed(Number, "a list of at least one number"),
    Span,
    lambda value: isinstance(value, list),
    "a list of numbers, or a mapping with from, to and count",
)


class Sweep(Block):
    """a mapping with the keys k, energy, starts, impacts and block"""

    k: Values
    """inertias of the grid"""
    energy: Values
    """energies of the grid, as E/g^2"""
    g: Gravity = None
    """gravity, where the axis is to show E itself"""
    starts: whole(1, 1_000_000)
    """orbits of a cell, even in area over the section"""
    impacts: whole(100, 10_000_000)
    """impacts of each orbit"""
    block: whole(1, 100_000)
    """cells computed by one job"""
