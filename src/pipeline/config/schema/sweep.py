"""The declaration of a sweep: a grid over k and E/g^2."""

from typing import Annotated, Literal

from annotated_types import Predicate
from pydantic import Tag

from .fields import ABSENT, TAGS, Block, Gravity, Number, allowed, distinct, first_if, whole


class Span(Block):
    """a mapping with from, to and count"""

    from_: float = allowed("a number", alias="from")
    """First value of the axis."""
    to: Number
    """Last value of the axis."""
    count: int = whole(2, 100_000)
    """Number of values, both ends included."""
    spacing: Literal["even", "log"] = "even"
    """`even` gives neighbours equal differences, `log` gives them equal ratios."""


Values = Annotated[
    Annotated[list[Number], allowed("a list of at least one number", min_length=1), Tag(TAGS[0])]
    | Annotated[Span, Tag(TAGS[1])],
    first_if(list),
    allowed("a list of numbers, or a mapping with from, to and count"),
]


Orders = Annotated[
    list[Annotated[int, whole(3, 12)]],
    allowed("a list of whole numbers from 3 to 12, at least one, none of them twice", min_length=1),
    Predicate(distinct),
]


class Sweep(Block):
    """a mapping with the keys k, energy, starts, impacts and block"""

    k: Values
    """Inertias of the grid, in increasing order. A single value makes a line, which is drawn as
    curves; several make a plane, which is drawn as maps."""
    energy: Values
    """Energies of the grid as multiples of g^2, in increasing order."""
    g: Gravity = ABSENT
    """Gravity, in R omega^2. With it the picture shows E instead of E/g^2, and energies at which
    the ball could flatten, eq. (31), are refused. The data do not depend on it."""
    starts: int = whole(1, 1_000_000)
    """Number of orbits in each cell of the grid. They start evenly, by area, over the half y >= 0
    of the section, of which the other half is the mirror image. More starts make the share of
    regular motion more precise."""
    impacts: int = whole(100, 10_000_000)
    """Largest number of impacts of an orbit. Longer orbits tell slow chaos from regular motion."""
    chains: Orders = ABSENT
    """Orders q, from 3 to 12, of the chains 1/q whose births and losses of stability are followed
    over the plane and drawn in a picture of their own. Needs several k."""
    block: int = whole(1, 100_000)
    """Number of cells that one job computes. Choose it so that a job takes about a minute: an
    interrupted sweep resumes with the blocks that are missing. The data do not depend on it."""
