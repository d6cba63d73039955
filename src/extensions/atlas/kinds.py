"""The kinds of picture of sweeps: a grid over k and E/g^2, and how reliable its verdicts are."""

from collections.abc import Iterator
from decimal import Context, Decimal
from itertools import product
from typing import Annotated, Any, Literal, Self

from pydantic import Tag

from pipeline.config.results import files_of
from pipeline.config.schema.fields import (
    ABSENT,
    TAGS,
    Block,
    Gravity,
    Number,
    allowed,
    first_if,
    rising,
    whole,
)
from pipeline.config.schema.parts import STAGES
from pipeline.config.schema.scene import CompletionError, CrossFieldError, Picture
from pipeline.records.provenance import BuildSpec
from pseudorigid.dynamics.bounds import as_decimal
from pseudorigid.kernel.closed_forms import energy_bounds

# Bounds of a sweep.
LARGEST_IMPACTS = 10_000_000_000_000  # more would take years: a typing error
MOST_CELLS = 1_000_000  # each start of ./reproduce looks at all of them
MOST_COLUMNS, MOST_ROWS = 1000, 1600  # of a plane, for which a picture has room
MOST_JOBS = 5000  # with more, snakemake is busier with its list than with the jobs
HIGHEST_ENERGY = 1e9  # E/g^2
_FORTY_DIGITS = Context(prec=40)


class Span(Block):
    """Evenly spaced values."""

    from_: float = allowed("a number", alias="from")
    """First value of the axis."""
    to: Number
    """Last value of the axis."""
    count: int = whole(2, 100_000)
    """Number of values, both ends included."""
    spacing: Literal["even", "log"] = "even"
    """`even` gives neighbours equal differences, `log` gives them equal ratios."""

    def numbers(self) -> list[float]:
        """Return the values of the axis.

        Evenly spaced ones are exact to twelve digits where the ends are decimals. Those in equal
        ratios have six digits; they are computed in decimals, which have the same bits everywhere.
        """
        steps = self.count - 1
        if self.spacing == "even":
            first, last = as_decimal(self.from_), as_decimal(self.to)
            values = [first + (last - first) * i / steps for i in range(self.count)]
            twelve = Context(prec=12)
            return [
                float(twelve.divide(Decimal(v.numerator), Decimal(v.denominator))) for v in values
            ]
        start, end = (_FORTY_DIGITS.ln(Decimal(str(value))) for value in (self.from_, self.to))
        step = _FORTY_DIGITS.divide(_FORTY_DIGITS.subtract(end, start), Decimal(steps))
        powers = (_FORTY_DIGITS.fma(step, Decimal(i), start) for i in range(self.count))
        return [float(Context(prec=6).plus(_FORTY_DIGITS.exp(power))) for power in powers]


Values = Annotated[
    Annotated[list[Number], allowed("a list of at least one number", min_length=1), Tag(TAGS[0])]
    | Annotated[Span, Tag(TAGS[1])],
    first_if(list),
    allowed("a list of numbers, or a mapping with from, to and count"),
]


class Atlas(Picture):
    """regular and chaotic motion over a grid of k and E/g^2, a sweep"""

    stages = ("sweep",)
    undrawn = ("formats", "block")

    k: Values
    """Inertias of the grid, in increasing order. A single value makes a line, several make a
    plane, drawn as maps."""
    energy: Values
    """Energies of the grid as multiples of g^2, in increasing order."""
    g: Gravity = ABSENT
    """Gravity, in R omega^2. With it the picture shows E instead of E/g^2, and energies at which
    the ball could flatten, eq. (31), are refused. The data do not depend on it."""
    starts: int = whole(1, 1_000_000)
    """Number of orbits in each cell of the grid. They start evenly, by area, over the half y >= 0
    of the section."""
    impacts: int = whole(100, 10_000_000)
    """Largest number of impacts of an orbit. Longer orbits tell slow chaos from regular motion."""
    block: int = whole(1, 100_000)
    """Number of cells that one job computes, in about a minute. The data do not depend on it."""

    def completed(self) -> Self:
        """Write out the axes."""
        axes = {"k": _axis(self.k, "k"), "energy": _axis(self.energy, "energy")}
        return self.model_copy(update=axes)

    def cross_field_errors(self) -> Iterator[CrossFieldError]:
        """Check the grid, of which each value is correct by itself."""
        assert isinstance(self.k, list) and isinstance(self.energy, list)  # they are written out
        k, energy = self.k, self.energy
        for i, each in enumerate(k):
            if not 0 < each <= 1:
                yield ("k",), each, f"numbers with 0 < k <= 1 (number {i + 1})"
                return
        yield from _energy_errors(energy[0], energy[-1], k, self.g)
        cells = len(k) * len(energy)
        if cells > MOST_CELLS:
            sizes = f"{len(k)} times {len(energy)}"
            yield ("energy",), energy, f"axes with at most {MOST_CELLS} cells, here {sizes}"
            return
        if cells * self.starts * self.impacts > LARGEST_IMPACTS:
            most = f"at most {LARGEST_IMPACTS} impacts in a sweep"
            yield ("impacts",), self.impacts, f"{most}, counted over all cells and starts"
        if cells > MOST_JOBS * self.block:
            words = f"at least {-(-cells // MOST_JOBS)} cells a block, for at most {MOST_JOBS} jobs"
            yield ("block",), self.block, words
        elif len(k) > 1 and (len(energy) > MOST_COLUMNS or len(k) > MOST_ROWS):
            words = f"a plane of at most {MOST_COLUMNS} energies and {MOST_ROWS} values of k"
            yield ("energy",), energy, f"{words}, a pixel each, here {len(energy)} and {len(k)}"


class Verdicts(Picture):
    """the share of wrong verdicts on orbits against impacts and time"""

    stages = ("verdicts",)


def specifications(_: object, sweep: Picture, spec: BuildSpec) -> Iterator[BuildSpec]:
    """Yield the specifications of a sweep's blocks and of its dataset, which joins them."""
    function, path = STAGES["sweep"].of_block, spec.result.removesuffix(".nc")
    of_block = spec._replace(function=function, sources=files_of(function), inputs=[])
    inputs = []
    for i, block in enumerate(blocks(sweep.as_mapping())):
        inputs.append(f"{path}.{i:04d}.nc")  # no scene has a dot in its name
        yield of_block._replace(result=inputs[-1], step=f"block {i}", config=block)
    yield spec._replace(step="data", inputs=inputs)


def blocks(sweep: dict[str, Any]) -> list[dict[str, Any]]:
    """Return what decides the data of each block of a sweep: cells [k, E/g^2] and orbits.

    Cells are counted along the energies of one k, then along those of the next k. A block has as
    many of them as the sweep's field `block` says.
    """
    cells, size = list(map(list, product(sweep["k"], sweep["energy"]))), sweep["block"]
    orbits = {name: sweep[name] for name in ("starts", "impacts")}
    return [{"cells": cells[i : i + size]} | orbits for i in range(0, len(cells), size)]


def _axis(given: Span | list[float], axis: str) -> list[float]:
    """Return the numbers of an axis; CompletionError if they do not increase."""
    if isinstance(given, Span):
        if not given.from_ < given.to:
            raise CompletionError((axis, "to"), given.to, f"a number above from = {given.from_}")
        if given.spacing == "log" and not given.from_ > 0:
            raise CompletionError((axis, "from"), given.from_, "a number > 0 where spacing is log")
        values = given.numbers()
    else:
        values = list(map(float, given))
    if not rising(values):
        shown = given.as_mapping() if isinstance(given, Span) else given
        raise CompletionError((axis,), shown, "increasing numbers that differ in six digits")
    return values


def _energy_errors(
    first: float, last: float, k: list[float], g: float | None
) -> Iterator[CrossFieldError]:
    """Yield an error for the first or last energy, or for g, if a ball could rest or flatten."""
    lowest, _ = energy_bounds(as_decimal(k[-1]), 1)
    if not as_decimal(first) > lowest:
        words = f"E/g^2 above -1/(2k) = {float(lowest)}, where a ball with k = {k[-1]} is at rest"
        yield ("energy",), first, words
    if not last <= HIGHEST_ENERGY:
        yield ("energy",), last, f"E/g^2 of at most {HIGHEST_ENERGY:g}"
    elif g is not None and not g < k[0]:
        yield ("g",), g, f"0 < g < k = {k[0]}"
    elif g is not None:
        highest = energy_bounds(as_decimal(k[0]), as_decimal(g))[1] / as_decimal(g) ** 2
        if not as_decimal(last) < highest:
            words = f"E/g^2 below (k/2 - g)/g^2 = {float(highest)}, where the ball could flatten"
            yield ("energy",), last, words
