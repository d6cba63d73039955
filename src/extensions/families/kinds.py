"""Kinds of picture of families of periodic orbits."""

from collections.abc import Iterator
from typing import Annotated, Literal

from annotated_types import Predicate

from extensions.atlas.kinds import Atlas
from pipeline.config.schema.fields import Name, Range, allowed, distinct, whole
from pipeline.config.schema.scene import CrossFieldError, Picture, Scene
from pseudorigid.dynamics.bounds import as_decimal, energy_mistake, g_mistake

MOST_CELLS = 2_000  # of the regular share


class Families(Scene):
    """families of periodic orbits, below the regular share of the section"""

    stages = ("families", "shares")
    on_section = False
    headline = "families"

    parameter: Literal["energy", "k"] = allowed("energy or k", default="energy")
    """What orbits are followed against: the energy of the ball, or its inertia k at the scene's
    E/g^2."""
    span: Range
    """Least and largest value of the parameter. Families are followed between them."""
    period: int = whole(1, 24)
    """Largest period of the orbits."""
    levels: int = whole(1, 10_000)
    """Number of values of the parameter, evenly in the radius of the section, at which brute force
    seeks orbits that no family holds yet."""
    drawn: int = whole(1, 24)
    """Largest period that is drawn."""
    step: float = allowed("a positive number", gt=0)
    """Distance in the parameter between two values of the regular share; these are multiples of
    it."""
    starts: int = whole(1, 1_000_000)
    """Number of orbits behind each value of the regular share."""
    impacts: int = whole(100, 10_000_000)
    """Largest number of impacts of these orbits."""

    def cross_field_errors(self) -> Iterator[CrossFieldError]:
        """Check that a ball has this energy over the whole span of k, and the number of values."""
        yield from super().cross_field_errors()
        low, high = (as_decimal(value) for value in self.span)
        if self.parameter == "k" and not (low > 0 and high <= 1 and self._suits_each_k()):
            words = "numbers with g < k <= 1 and -g^2/(2k) < energy < k/2 - g"
            yield ("span",), self.span, words
        step = as_decimal(self.step)
        if high // step <= -(-low // step):
            yield ("step",), self.step, "one with two multiples or more in the span"
        if (high - low) / step > MOST_CELLS:
            least = float((high - low) / MOST_CELLS)
            yield ("step",), self.step, f"at least {least:g}, {MOST_CELLS} values in the span"
        if self.drawn > self.period:
            yield ("drawn",), self.drawn, f"at most period = {self.period}"

    def _suits_each_k(self) -> bool:
        """Return whether balls with both ends of the span as k have the scene's g and energy."""
        g = self.ball.g
        return not any(g_mistake(k, g) or energy_mistake(k, g, self.energy) for k in self.span)


class Residues(Picture):
    """residues of families of periodic orbits"""

    stages = ("families",)
    drawn_over = "families"
    on_section = False

    over: Name = allowed("the name of a scene of families")
    """Name of the scene whose families are drawn."""


_Orders = Annotated[
    list[Annotated[int, whole(3, 12)]],
    allowed("a list of whole numbers from 3 to 12, at least one, none of them twice", min_length=1),
    Predicate(distinct),
]


class Chains(Picture):
    """births of chains of islands and their ends, over the plane of a sweep"""

    stages = ("sweep", "chains")
    drawn_over = "atlas"
    undrawn = ("formats", "block")

    over: Name = allowed("the name of a sweep of several k")
    """Name of the sweep over whose plane the curves are drawn. It must have several k."""
    chains: _Orders
    """Orders q, from 3 to 12, of the chains 1/q whose births and losses of stability are
    followed."""

    def cross_field_errors(self) -> Iterator[CrossFieldError]:
        """Check that the sweep is a plane with energies at which chains exist."""
        assert isinstance(self, Atlas)  # it is drawn over a sweep, whose fields it has
        if len(self.k) == 1:
            yield ("over",), self.over, "a sweep of several k"
        elif not self.energy[0] > 0:
            yield ("over",), self.over, "a sweep whose energies are above 0"
