"""Groups of fields that kinds of picture of one ball's motion are made of: orbits and manifolds.

Checks that need more than one field stand with the group.
"""

import math
from collections.abc import Iterator, Mapping
from fractions import Fraction
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from pipeline.config.schema.fields import (
    ABSENT,
    FIRST,
    LARGEST,
    NOT_EMPTY,
    SECOND,
    Axis,
    Block,
    Point,
    Range,
    allowed,
    first_if,
    rising,
    whole,
)
from pipeline.config.schema.scene import CrossFieldError, Scan, Scene, entries
from pseudorigid.dynamics.bounds import as_decimal
from pseudorigid.figures.axes.direction import disproportion
from pseudorigid.kernel.closed_forms import fixed_point, twice_energy_above_rest


class View(Block):
    """The direction from which a surface is seen."""

    elevation: float = allowed("a number of degrees from 0.1 to 89.9", ge=0.1, le=89.9)
    """Angle of the viewing direction above the plane of x and xdot."""
    azimuth: float = allowed("a number of degrees from -360 to 360", ge=-360, le=360)
    """Angle of the viewing direction around the axis of udot, from the axis of x towards the axis
    of xdot."""


class Branch(Block):
    """Branches of manifolds on one side of a periodic point."""

    length: float = allowed("a positive number, in radii of the section", gt=0)
    """Arc length along which each of these branches is traced from its periodic point."""


class BothBranches(Block):
    """The branches of manifolds that are traced."""

    outer: Branch = ABSENT
    """Branches on the far side of the fixed point, which fold in the chaotic sea."""
    inner: Branch = ABSENT
    """Branches on the fixed point's side, which enclose the main island."""


class Resolution(Block):
    """How finely a line is traced."""

    distance: float = allowed("a number from 1e-9 to 1, in radii of the section", ge=1e-9, le=1)
    """Largest distance between neighbouring points of a traced line. Use 0.01 for a picture of the
    whole section."""
    bend: float = allowed("a number from 0.1 to 90, in degrees", ge=0.1, le=90)
    """Largest angle between neighbouring pieces of a traced line. 10 looks smooth."""


class Window(Block):
    """A window of the section around a point."""

    x: Range
    """Ends of the window in x, measured from the point, in section radii."""
    xdot: Range
    """Ends of the window in xdot, measured from the point, in section radii times omega."""


_ON_LINE = "a fraction of the section's radius with -1 < start < 1 (others are off the section)"
_STARTS = (
    "a list of fractions of the section's radius, each with -1 < start < 1, "
    "or of points {x, xdot} or {x, y}"
)
Start = Annotated[
    Annotated[Point, FIRST] | Annotated[float, allowed(_ON_LINE, gt=-1, lt=1), SECOND],
    first_if(dict, Point),
    allowed("a fraction of the section's radius, or a point {x, xdot} or {x, y}"),
]
Starts = Annotated[list[Start], allowed(_STARTS, min_length=1)]
_Count = Annotated[int, whole(1, LARGEST)]
_Counts = Annotated[
    list[_Count], allowed("a list of whole numbers, one for each start", min_length=1)
]
Impacts = Annotated[
    Annotated[_Counts, FIRST] | Annotated[_Count, SECOND],
    first_if(list),
    allowed("a whole number, or a list of them, one for each start"),
]
OrbitType = Literal["elliptic", "hyperbolic", "inverse hyperbolic"]
Saddle = Annotated[
    Literal["hyperbolic", "inverse hyperbolic"],
    allowed("one of hyperbolic, inverse hyperbolic (others have no manifolds)"),
]
SectionAxes = dict[Literal["x", "xdot", "udot"], Axis]


class OfOrbits(Scene):
    """A scene of orbits from given starts."""

    removed: ClassVar[Mapping[str, str]] = {
        "sea": "no key any more: which orbits are chaotic is computed. Delete it."
    }

    starts: Starts
    """Start of each orbit. A number is a fraction of the section's radius along the symmetry line
    y = 0, from the section's centre: -1 and 1 are the rim, where impacts graze. A mapping is a
    point of the section. Fractions carry over to another ball or energy, points do not. (The
    numbers in a picture are places in this list, counted from 1.) Chaotic orbits, whose tangent
    vectors grow exponentially, are drawn first, in grey."""
    impacts: Impacts
    """Number of impacts of each orbit. A few thousand dots fill a closed curve, some ten thousand
    the chaotic sea. Exponents converge slowly: the paper takes 200000."""

    def cross_field_errors(self) -> Iterator[CrossFieldError]:
        """Check that starts lie on the section, and that impacts fit them and are not too many."""
        yield from super().cross_field_errors()
        for i, start in enumerate(self.starts):
            if isinstance(start, Point):
                yield from _start_errors(self, start, ("starts", i))
        if len(self.impacts_of_each()) != len(self.starts):
            words = f"one number for each of the {len(self.starts)} starts"
            yield ("impacts",), self.impacts, words
        elif sum(self.impacts_of_each()) > LARGEST:
            words = f"at most {LARGEST} impacts in a scene, counted over all its starts"
            yield ("impacts",), self.impacts, words

    def impacts_of_each(self) -> list[int]:
        """Return the number of impacts of each orbit."""
        return self.impacts if isinstance(self.impacts, list) else [self.impacts] * len(self.starts)


class OfRecords(OfOrbits):
    """A scene of exponents along orbits."""

    records: int = whole(2, 10_000)
    """Number of points of each exponent's line: exponents are kept after this many equal stretches
    of impacts. 400 make a smooth line."""

    def cross_field_errors(self) -> Iterator[CrossFieldError]:
        """Check that there are no more records than impacts."""
        yield from super().cross_field_errors()
        least = min(self.impacts_of_each())
        if self.records > least:
            yield ("records",), self.records, f"at most impacts = {least}"


class OfPeriodicOrbit(Scene):
    """A scene of one periodic orbit."""

    period: int = whole(1, 12)
    """Number of impacts after which the periodic orbit closes; 1 is the fixed point. Only orbits
    that are symmetric under the reversor are found."""
    type: OrbitType
    """Stability of the periodic orbit, among those of the period: an elliptic orbit is surrounded
    by islands, others are saddles with manifolds."""


class OfManifolds(OfPeriodicOrbit):
    """A scene of the manifolds of a hyperbolic orbit."""

    type: Saddle
    """Stability of the periodic orbit, a saddle, among those of the period."""
    resolution: Resolution
    """How finely the manifolds are traced."""

    def cross_field_errors(self) -> Iterator[CrossFieldError]:
        """Check the tolerance of a scan, and that no branch needs too many points."""
        yield from super().cross_field_errors()
        # A branch begins as a segment of 1e-6: a coarser bisection leaves noise, not a line.
        if isinstance(self.method, Scan) and self.method.tolerance > 1e-12:
            words = "a number from 1e-15 to 1e-12, for manifolds"
            yield ("method", "tolerance"), self.method.tolerance, words
        branches = 4 * self.period  # stable and unstable, on both sides of each point
        longest = LARGEST * self.resolution.distance / branches
        for place, length in self.lengths():
            if length > longest:
                words = f"at most {LARGEST} times resolution.distance"
                yield place, length, f"{words}, shared by {branches} branches = {longest}"

    def lengths(self) -> Iterator[tuple[tuple[str, ...], float]]:
        """Yield the place and the value of each length of branches."""
        yield from ()


class OfBranches(OfManifolds):
    """A scene of branches of both sides, each with its own length."""

    branches: Annotated[BothBranches, NOT_EMPTY]
    """Which branches of the manifolds are traced, and how far."""

    def lengths(self) -> Iterator[tuple[tuple[str, ...], float]]:
        """Yield the length of the branches of each side."""
        for side, branch in self.branches:
            if branch:
                yield ("branches", side, "length"), branch.length


class OnSurface(Scene):
    """A scene drawn on the energy surface, in (x, xdot, udot)."""

    view: View = Field({"elevation": 40, "azimuth": 115}, validate_default=True)
    """Direction from which the surface is seen. It is opaque."""
    axes: SectionAxes = ABSENT
    """Limits and ticks of the axes `x` (position, R), `xdot` (velocity, omega R) and `udot` (strain
    rate, omega). Limits that cut the energy surface are
    widened to hold it, and a run says so."""

    def cross_field_errors(self) -> Iterator[CrossFieldError]:
        """Check that the box, if all axes are given, is neither too high nor too flat."""
        yield from super().cross_field_errors()
        axes = self.given_axes()
        limits = [axes[name].limits for name in ("x", "xdot", "udot") if name in axes]
        sound = len(limits) == 3 and all(map(rising, limits))
        if refused := disproportion(limits, **dict(self.view)) if sound else None:
            yield ("axes", refused[0], "limits"), *refused[1:]


def is_sound(scene: Scene) -> bool:
    """Return whether a scene's ball has a section at its energies, so that more can be checked."""
    return not any(Scene.cross_field_errors(scene))


def bounded(
    scene: Scene, first: str, second: str, what: str, most: int = LARGEST
) -> Iterator[CrossFieldError]:
    """Yield an error if the product of two fields, a count held in memory, is too large."""
    factor, other = getattr(scene, first), getattr(scene, second)
    if factor * other > most:
        words = f"at most {most} {what}, {first} times {second}"
        yield (second,), other, f"{words}: here {most // factor}"


def not_elliptic(scene: Scene, name: str) -> Iterator[CrossFieldError]:
    """Yield an error for each energy of a field at which the fixed point is hyperbolic."""
    if not is_sound(scene):
        return
    k, g = scene.ball.k, scene.ball.g

    def of(theta: float) -> tuple[float, float]:
        return fixed_point(k, theta, lambda angle: (math.sin(angle), math.cos(angle)))

    low, high = 0.0, math.pi  # of theta: the trace falls through -2 between them
    while (theta := (low + high) / 2) not in (low, high):
        low, high = (theta, high) if of(theta)[1] > -2 else (low, theta)
    highest = of(theta)[0] * g * g
    for place, energy in entries(scene, name):
        if not energy < highest:
            yield place, energy, f"an energy below {highest:.6g}, where the fixed point is elliptic"


def _start_errors(scene: Scene, start: Point, place: tuple[str, int]) -> Iterator[CrossFieldError]:
    """Check that a point lies inside the section at the scene's energy."""
    if (start.xdot is None) == (start.y is None):
        yield place, start.as_mapping(), "a point {x, xdot} or {x, y}"
        return
    k, g, energy = as_decimal(scene.ball.k), as_decimal(scene.ball.g), as_decimal(scene.energy)
    x = as_decimal(start.x)
    twice_kinetic_energy = 2 * energy + 2 * g * x - k * x * x
    # Nearer to the rim than this, rounding decides whether the ball leaves the floor.
    margin = Fraction(1, 10**12) * twice_energy_above_rest(k, g, energy)
    if start.y is not None:
        y = as_decimal(start.y)
        inside = (1 + k) * twice_kinetic_energy - y * y > margin
        condition = "y^2/(1+k) + k (x - g/k)^2 < 2E + g^2/k"
    else:
        v = as_decimal(start.xdot)
        square = twice_kinetic_energy - v * v  # k udot^2
        inside = square > margin and (v >= 0 or square - k * v * v > margin)
        condition = "xdot^2 < 2E + 2gx - kx^2 and xdot + udot > 0"
    if not inside:
        words = f"a point on the section at energy {scene.energy}, {condition}"
        yield place, start.as_mapping(), words
