"""Kinds of picture of what is proved."""

from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, ClassVar, Literal

from annotated_types import Predicate

from paper import values
from paper.groups import OfBranches, OfOrbits, bounded, not_elliptic
from pipeline.config.schema.fields import (
    ABSENT,
    Axis,
    Energy,
    Name,
    NoFormats,
    Number,
    YamlMapping,
    allowed,
    rising,
    whole,
)
from pipeline.config.schema.scene import CrossFieldError, Picture, Scene
from pseudorigid.dynamics.bounds import as_decimal

from .search.rotation_numbers import quotients_near

# k and E/g^2 of the theorems about graphs.
GRAPHS = (as_decimal(0.2), as_decimal(3.125)), (as_decimal(0.2), as_decimal(6.25))


class Horseshoe(OfBranches):
    """the sets of a proved horseshoe along a connection of the orbit"""

    stages = ("manifolds", "horseshoe")
    axes_depend_on = ("period", "type", "branches", "connection")
    headline = "sets"

    connection: Annotated[Literal["outer", "inner"], allowed("outer or inner")]
    """Side, at the orbit's first point, of the branches along which the sets of the horseshoe lie.
    At other points it may be the other side, so give `branches` both."""
    type: Annotated[Literal["hyperbolic"], allowed("hyperbolic")]
    """Horseshoes are proved on hyperbolic orbits only."""
    axes: dict[Literal["x", "y", "p", "q"], Axis] = ABSENT
    """Limits and ticks of the axes `x` (position, R) and `y` = xdot - k udot (omega R) above, and
    of `p` and `q`, the coordinates of the middle set, below."""


class Twist(Scene):
    """the fixed point's twist coefficient against the energy"""

    stages = ("twist",)
    axes_depend_on = ("energies",)
    headline = "zero of the twist"

    energies: Annotated[
        list[Energy],
        allowed("a list of energies in rising order", min_length=2, max_length=1000),
        Predicate(rising),
    ]
    """Energies at which the twist coefficient is computed. A run names one at which no twist is
    proved, such as one at which the third or fourth power of the fixed point's multiplier is 1."""
    marks: list[Energy] = allowed("a list of energies among those", default=[], max_length=10)
    """Energies, among `energies`, whose values are marked with a dot."""
    axes: dict[Literal["energy", "twist"], Axis] = ABSENT
    """Limits and ticks of the axes `energy` (m omega^2 R^2) and `twist` (the coefficient)."""

    def cross_field_errors(self) -> Iterator[CrossFieldError]:
        """Check that marks are among the energies, at which the fixed point must be elliptic."""
        yield from super().cross_field_errors()
        for mark in self.marks:
            if mark not in self.energies:
                yield ("marks",), mark, "one of energies"
        yield from not_elliptic(self, "energies")


class Escape(Scene):
    """how far orbits get from the fixed point"""

    stages = ("escape",)
    on_section = False
    headline = "largest distance"

    beside: list[Annotated[Number, allowed("a number from 0 to 0.01", ge=0, le=0.01)]] = allowed(
        "a list of 1 to 6 numbers", min_length=1, max_length=6
    )
    """What is added to the scene's energy: there is a line for each sum."""
    distance: Annotated[Number, allowed("above 0, at most 0.1", gt=0, le=0.1)]
    """Distance from the fixed point at which orbits start, in section radii."""
    orbits: int = whole(1, 1000)
    """Number of orbits at each energy. They start evenly around the fixed point."""
    impacts: int = whole(100, 100_000)
    """Number of impacts of each orbit."""

    def cross_field_errors(self) -> Iterator[CrossFieldError]:
        """Check that all impacts fit into memory."""
        yield from super().cross_field_errors()
        yield from bounded(self, "orbits", "impacts", "impacts in all")


class Curves(OfOrbits):
    """proved invariant curves on the section"""

    stages: ClassVar[tuple[str, ...]] = ("curves", "orbits")
    headline = "proved share"

    rotation_numbers: Annotated[
        list[Annotated[Number, allowed("above 0, below 1", gt=0, lt=1)]],
        allowed("a list of numbers between 0 and 1", min_length=1, max_length=10),
    ]
    """Rotation numbers of the curves around the fixed point, in clockwise turns per impact. A
    curve's number is close to the given one, which must not be too close to a fraction of small
    integers. If no such curve is found or proved, a run names the nearest found. Proved curves
    around longer orbits at the scene's energy are added."""

    def cross_field_errors(self) -> Iterator[CrossFieldError]:
        """Check that the fixed point is elliptic, and that its curves can be sought."""
        yield from super().cross_field_errors()
        yield from not_elliptic(self, "energy")
        for i, number in enumerate(self.rotation_numbers):
            try:
                quotients_near(number)
            except ValueError as error:
                yield ("rotation_numbers", i), number, f"another number, since {error}"


class Graph(OfOrbits):
    """the sets of a proved graph of coverings, and the connections between them"""

    stages = ("graph", "orbits")
    headline = "entropy"

    def cross_field_errors(self) -> Iterator[CrossFieldError]:
        """Check that there is a theorem about a graph."""
        yield from super().cross_field_errors()
        (k, g), energy = (as_decimal(self.ball.k), as_decimal(self.ball.g)), as_decimal(self.energy)
        if (k, energy / g**2) not in GRAPHS:
            here = ", ".join(str(float(ratio * g**2)) for _, ratio in GRAPHS)
            words = f"a theorem's energy: with k = 0.2 and this g, one of {here}"
            yield ("energy",), self.energy, words


class Theorem(Picture):
    """the verdict on a theorem from its certificate, without a picture"""

    stages = ("theorem",)

    theorem: Name = allowed("the name of a theorem")
    """Name of the theorem."""
    formats: NoFormats = []


class Derivations(Scene):
    """the paper's formulas, derived by computer algebra, without a picture"""

    stages = ("derivations",)
    on_section = False

    formats: NoFormats = []


def theorems() -> dict[str, YamlMapping]:
    """Return the scenes of all theorems that have a certificate, and of the derivations."""
    files = sorted((Path(__file__).parent / "certificates").iterdir())
    scenes: dict[str, YamlMapping]
    scenes = {file.stem: {"picture": "theorem", "theorem": file.stem} for file in files}
    of_paper = {"ball": values.BALL, "energy": values.FIGURES["fig2"]["energy"]}
    return scenes | {"derivations": {"picture": "derivations"} | of_paper}
