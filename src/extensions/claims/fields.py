"""Fields that several kinds of picture of the claims share."""

from collections.abc import Iterator
from typing import Annotated

from pipeline.config.schema.fields import Energy, Fraction, allowed, rising, whole
from pipeline.config.schema.scene import CrossFieldError, Scene, bounded

Energies = Annotated[list[Energy], allowed("a list of energies", min_length=1, max_length=20)]
Between = Annotated[
    list[Fraction], allowed("two fractions of the section's radius", min_length=2, max_length=2)
]


class OfSea(Scene):
    """A scene of many orbits of the chaotic sea."""

    between: Between
    """Part of the symmetry line y = 0 over which the orbits start evenly, in section radii from the
    section's centre. Choose it inside the chaotic sea."""
    orbits: int = whole(2, 100_000)
    """Number of orbits. More of them make the statistics more precise."""
    impacts: int = whole(100, 10_000_000)
    """Number of impacts of each orbit."""

    def cross_field_errors(self) -> Iterator[CrossFieldError]:
        """Check that the starts are in order, and that all impacts fit into memory."""
        yield from super().cross_field_errors()
        if not rising(self.between):
            yield ("between",), self.between, "two increasing fractions"
        yield from bounded(self, "orbits", "impacts", "impacts in all")
