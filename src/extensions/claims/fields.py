"""Fields that several kinds of picture of the claims share."""

from typing import Annotated

from pipeline.config.schema.fields import Energy, Fraction, allowed, whole
from pipeline.config.schema.scene import Scene

Energies = Annotated[list[Energy], allowed("a list of energies", min_length=1, max_length=20)]
Between = Annotated[
    list[Fraction], allowed("two fractions of the section's radius", min_length=2, max_length=2)
]


class OfSea(Scene):
    """A scene of many orbits of the chaotic sea."""

    orbits: int = whole(2, 100_000)
    """Number of orbits. They start evenly over the whole section; those that are chaotic, at least
    two, are followed."""
    impacts: int = whole(100, 10_000_000)
    """Number of impacts of each chaotic orbit, after the first 16,000, by which it is recognized.
    Orbits stay long at the edges of islands: averages need long orbits as well as many."""
