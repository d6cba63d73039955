"""The types of the fields of config.yaml: pydantic's checks, and the words for what is allowed.

A field's description is what a refusal says is allowed; the text below a field says what it means.
docs/config.md has both. Models only check:
blocks stay the plain mappings that were written, so that 1 and 1.0 stay what they are.
"""

from collections.abc import Callable
from itertools import pairwise
from typing import Annotated, Any, Literal

from annotated_types import Predicate
from pydantic import BaseModel, ConfigDict, Discriminator, Field, Tag, create_model
from pydantic.types import Strict

LARGEST = 10_000_000  # impacts of a scene, and points of a manifold: above it a number is a slip


class Block(BaseModel):
    """A mapping of the config: unknown keys are mistakes, and so are numbers in quotes."""

    model_config = ConfigDict(extra="forbid", strict=True, allow_inf_nan=False)


def real(allowed: str, **bounds):
    """The type of a number, with pydantic's bounds (gt, ge, lt, le) and the words for them."""
    return Annotated[float, Strict(), Field(description=allowed, **bounds)]


def whole(low: int, high: int, multiple: int = 1):
    """The type of a whole number from `low` to `high`, a multiple of another."""
    more = f", a multiple of {multiple}" if multiple > 1 else ""
    allowed = f"a whole number from {low} to {high}{more}"
    bounds = Field(description=allowed, ge=low, le=high, multiple_of=multiple)
    return Annotated[int, Strict(), bounds]


def listed(item, allowed: str, low: int = 1, high: int | None = None, *fits: Callable):
    """The type of a list of `low` to `high` items of which all `fits` are true."""
    bounds = Field(description=allowed, min_length=low, max_length=high)
    return Annotated[list[item], bounds, *map(Predicate, fits)]


def distinct(items) -> bool:
    """Whether no item is there twice."""
    return len(set(items)) == len(items)


def rising(numbers) -> bool:
    """Whether each number is above the one before."""
    return all(a < b for a, b in pairwise(numbers))


def one_of(*texts: str, more: str = ""):
    """The type of one of some texts; there may be `more` to say."""
    return Annotated[Literal[texts], Field(description=f"one of {', '.join(texts)}{more}")]


def one_or(other, one, is_other: Callable, allowed: str):
    """The type of what is either `other`, where `is_other` says so of what is given, or `one`."""
    return Annotated[
        Annotated[one, Tag("(one)")] | Annotated[other, Tag("(other)")],
        Discriminator(lambda value: "(other)" if is_other(value) else "(one)"),
        Field(description=allowed),
    ]


TAGS = ("(one)", "(other)")  # of one_or, which pydantic puts into the place of a mistake

Number = real("a number")
Inertia = real("a number with 0 < k <= 1", gt=0, le=1)
Gravity = real("a number with 0 < g < k", gt=0)
Energy = real("a number with -g^2/(2k) < energy < k/2 - g")
Range = listed(Number, "a list of two increasing numbers", 2, 2, rising)
Name = Annotated[
    str,
    Field(pattern=r"^[A-Za-z0-9_][A-Za-z0-9_-]*$",
          description="a name of letters, digits, - and _ that does not begin with -"),
]  # fmt: skip


class BallBlock(Block):
    """a mapping with the keys k and g"""

    k: Inertia
    """dimensionless Euler inertia: 1/5 for a solid sphere, 1/3 for a thin shell"""
    g: Gravity
    """gravity, in units of R omega^2"""


class PartOfBall(Block):
    """a mapping with the keys k and g, or one of them"""

    k: Inertia = None
    """inertia"""
    g: Gravity = None
    """gravity"""


class Scan(Block):
    """a mapping with the keys scan and tolerance"""

    scan: real("the scan's step, a number from 0.001 to 1", ge=0.001, le=1)
    """the step with which the sign of the gap is looked at"""
    tolerance: real("a number from 1e-15 to 0.001", ge=1e-15, le=0.001)
    """the width at which bisection ends"""


class FineScan(Scan):
    """a mapping with the keys scan and tolerance"""

    # A branch begins as a segment of 1e-6: a coarser bisection leaves noise, not a line.
    tolerance: real("a number from 1e-15 to 1e-12, for manifolds", ge=1e-15, le=1e-12)


class Exact(Block):
    """a mapping with the key exact"""

    exact: Annotated[Literal[True], Field(description="true, or no method at all")]
    """orbits of the starts as written, each number a rounded true value"""


def _is_exact(value):
    return isinstance(value, dict) and "exact" in value


METHODS = "a mapping with the keys scan and tolerance, or {exact: true}"
Method = one_or(Exact, Scan, _is_exact, METHODS)
FineMethod = one_or(Exact, FineScan, _is_exact, METHODS)


class Axis(Block):
    """a mapping with the keys limits and ticks"""

    limits: Range
    """the ends of the axis"""
    ticks: listed(Number, "a list of 1 to 50 numbers", 1, 50)
    """where its numbers stand"""


class View(Block):
    """a mapping with the keys elevation and azimuth"""

    elevation: real("a number of degrees from 0.1 to 89.9", ge=0.1, le=89.9)
    """the eye's angle above the plane of x and xdot"""
    azimuth: real("a number of degrees from -360 to 360", ge=-360, le=360)
    """its angle around the axis of udot"""


class Point(Block):
    """a mapping with the keys x and xdot, or x and y = xdot - k udot"""

    x: Number
    xdot: Number = None
    y: Number = None


class Branch(Block):
    """a mapping with the key length"""

    length: real("a positive number, in radii of the section", gt=0)
    """how far the branch is followed from the orbit"""


class _Branches(Block):
    """a mapping with the keys outer and inner, or one of them"""

    outer: Branch = None
    """the branches that leave away from the fixed point"""
    inner: Branch = None
    """the branches on the fixed point's side"""


Branches = Annotated[_Branches, Predicate(lambda given: given.model_fields_set)]


class Resolution(Block):
    """a mapping with the keys distance and bend"""

    distance: real("a number from 1e-9 to 1, in radii of the section", ge=1e-9, le=1)
    """the longest piece of a line"""
    bend: real("a number from 0.1 to 90, in degrees", ge=0.1, le=90)
    """the largest angle between neighbouring pieces"""


class Window(Block):
    """a mapping with the keys x and xdot"""

    x: Range
    """ends of the window, from the point, in section radii"""
    xdot: Range
    """the same in xdot"""


Fraction = real("a fraction with -1 < start < 1", gt=-1, lt=1)
Between = listed(Fraction, "two fractions of the section's radius", 2, 2)
Start = one_or(
    Point,
    real("a fraction of the section's radius with -1 < start < 1 (others are off the section)",
         gt=-1, lt=1),
    lambda value: isinstance(value, dict),
    "a fraction of the section's radius, or a point {x, xdot} or {x, y}",
)  # fmt: skip
_STARTS = "a list of fractions of the section's radius, each with -1 < start < 1, or of points "
Starts = listed(Start, _STARTS + "{x, xdot} or {x, y}")
Impacts = one_or(
    listed(whole(1, LARGEST), "a list of whole numbers, one for each start"),
    whole(1, LARGEST),
    lambda value: isinstance(value, list),
    "a whole number, or a list of them, one for each start",
)
Period = whole(1, 12)
OrbitType = one_of("elliptic", "hyperbolic", "inverse hyperbolic")
Saddle = one_of("hyperbolic", "inverse hyperbolic", more=" (others have no manifolds)")
Format = one_of("png", "svg", "pdf")
_FORMATS = "a list of png, svg, pdf that has png in it, none of them twice"
Formats = listed(Format, _FORMATS, 1, None, distinct, lambda given: "png" in given)


def axes_of(*names: str) -> Any:
    """The type of `axes:` with these names, each of which may be left out."""
    keys = f"the keys {', '.join(names[:-1])} and {names[-1]}"
    allowed = f"a mapping with {keys}, or some of them"
    return create_model("Axes", __base__=Block, __doc__=allowed, **{n: (Axis, None) for n in names})
