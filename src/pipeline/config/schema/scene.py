"""Pictures and scenes of config.yaml, and the groups of fields that kinds are made of.

A kind of picture is one class in `kinds`, derived from these. Checks that need more than one field
stand with the group. They compare numbers as the decimals that were written.
"""

import math
from collections.abc import Iterator, Mapping
from fractions import Fraction
from typing import Annotated, Any, ClassVar, Literal, Self

from annotated_types import Predicate
from pydantic import Field

from pseudorigid.figures.axes.direction import disproportion
from pseudorigid.kernel.closed_forms import energy_bounds, fixed_point, twice_energy_above_rest

from . import fields
from .fields import ABSENT, allowed
from .method import Method, Scan

CrossFieldError = tuple[tuple[str | int, ...], Any, str]  # place in the scene, value, what to give
# 1/omega. The kernel computes flights up to 2^20, and a histogram has ten bins a unit of time.
LONGEST_FLIGHT = 1_000_000


class CompletionError(Exception):
    """A shorthand that cannot be written out; the arguments are those of a CrossFieldError."""


SectionAxes = dict[Literal["x", "xdot", "udot"], fields.Axis]


class Picture(fields.Block):
    """a mapping that begins with picture"""

    # Stages that compute the data, in the order in which the kind's `draw` takes their datasets.
    stages: ClassVar[tuple[str, ...]]
    # Function draw(block, *datasets), by default `draw` in the module of the kind's name.
    drawn_by: ClassVar[str] = ""
    # Function (block, **datasets) -> quantity -> value as text, in the module `reports` beside it.
    reported_by: ClassVar[str] = ""
    # Fields that decide nothing that is drawn.
    undrawn: ClassVar[tuple[str, ...]] = ("formats",)
    # A variant that changes one of these, the ball or the energy inherits no `axes`.
    axes_depend_on: ClassVar[tuple[str, ...]] = ()
    # The quantity among those that the picture reports that stands for it in a list.
    headline: ClassVar[str] = ""
    # The kind of the scene that a field `over` names; its fields and its data are this scene's too.
    drawn_over: ClassVar[str] = ""
    # Whether it shows orbits on one section of the paper's map, as the section at an energy.
    on_section: ClassVar[bool] = False

    picture: str = allowed("the kind of picture: one of those below")
    """What the figure shows."""
    formats: fields.Formats = ["png"]
    """File formats of the figure. png and svg are published; pdf stays in `results/`."""

    def completed(self) -> Self:
        """Return the scene with shorthands written out; raises CompletionError."""
        return self

    def given_axes(self) -> Mapping[str, fields.Axis]:
        """Return the axes of the scene that the config has."""
        return getattr(self, "axes", None) or {}

    def cross_field_errors(self) -> Iterator[CrossFieldError]:
        """Yield what is wrong between fields, each of which has its type."""
        for name, axis in self.given_axes().items():
            low, high = axis.limits
            for tick in axis.ticks:
                if low < high and not axis.holds(tick):
                    words = f"numbers within the limits {axis.limits}"
                    yield ("axes", name, "ticks"), tick, words


class Scene(Picture):
    """a mapping that begins with picture"""

    on_section = True

    ball: fields.BallBlock = ABSENT
    """The ball of this scene. Without it the scene has the ball at the top of the file."""
    energy: fields.Energy
    """Total energy of the ball, in m omega^2 R^2; every impact keeps it. Below the lower bound
    there is no motion, above the upper one the ball could flatten to nothing, eq. (31). Islands of
    regular motion mostly shrink as the energy rises."""
    method: Method = ABSENT
    """How the next impact is found. Without it, the first impact is found with a certificate that
    none was missed; leave it out unless you want to compare methods."""

    def along_energy(self) -> bool:
        """Return whether the scene follows something over energies, from end to end of `span`."""
        return getattr(self, "parameter", None) == "energy"

    def cross_field_errors(self) -> Iterator[CrossFieldError]:
        """Check the ball, its energies, and ticks."""
        if not self.ball.g < self.ball.k:
            yield ("ball", "g"), self.ball.g, f"0 < g < k = {self.ball.k}"
            return
        yield from _energy_errors(self)
        yield from super().cross_field_errors()


class OfOrbits(Scene):
    """A scene of orbits from given starts."""

    starts: fields.Starts
    """Start of each orbit. A number is a fraction of the section's radius along the symmetry line
    y = 0, from the section's centre: -1 and 1 are the rim, where impacts graze. A mapping is a
    point of the section. Fractions carry over to another ball or energy, points do not."""
    impacts: fields.Impacts
    """Number of impacts of each orbit. Where each impact is drawn as a dot, a few thousand fill a
    closed curve and some ten thousand the chaotic sea. Exponents converge slowly: the paper takes
    200000."""

    def cross_field_errors(self) -> Iterator[CrossFieldError]:
        """Check that starts lie on the section, and that impacts fit them and are not too many."""
        yield from super().cross_field_errors()
        for i, start in enumerate(self.starts):
            if isinstance(start, fields.Point):
                yield from _start_errors(self, start, ("starts", i))
        if len(self.impacts_of_each()) != len(self.starts):
            words = f"one number for each of the {len(self.starts)} starts"
            yield ("impacts",), self.impacts, words
        elif sum(self.impacts_of_each()) > fields.LARGEST:
            words = f"at most {fields.LARGEST} impacts in a scene, counted over all its starts"
            yield ("impacts",), self.impacts, words

    def impacts_of_each(self) -> list[int]:
        """Return the number of impacts of each orbit."""
        return self.impacts if isinstance(self.impacts, list) else [self.impacts] * len(self.starts)


class OfChaoticOrbits(OfOrbits):
    """A scene of orbits, of which the chaotic ones are drawn in grey."""

    sea: Annotated[
        list[Annotated[int, fields.whole(0, fields.LARGEST)]],
        allowed("a list of places in starts, counted from 0, none of them twice"),
        Predicate(fields.distinct),
    ] = []
    """Places in `starts`, counted from 0, of orbits that you expect to be chaotic. It changes no
    picture: those whose tangent vectors grow exponentially are called chaotic, whatever stands
    here. They are drawn first and in a grey of their own, so that regular orbits stand out."""

    def cross_field_errors(self) -> Iterator[CrossFieldError]:
        """Check that places in `sea` are places in `starts`."""
        yield from super().cross_field_errors()
        last = len(self.starts) - 1
        for place in self.sea:
            if place > last:
                yield ("sea",), place, f"a place in starts, from 0 to {last}"


class OfRecords(OfOrbits):
    """A scene of exponents along orbits."""

    records: int = fields.whole(2, 10_000)
    """Number of points of each exponent's line: the exponents so far are kept after this many
    equal stretches of impacts. 400 points make a smooth line."""

    def cross_field_errors(self) -> Iterator[CrossFieldError]:
        """Check that there are no more records than impacts."""
        yield from super().cross_field_errors()
        least = min(self.impacts_of_each())
        if self.records > least:
            yield ("records",), self.records, f"at most impacts = {least}"


class OfPeriodicOrbit(Scene):
    """A scene of one periodic orbit."""

    period: int = fields.whole(1, 12)
    """Number of impacts after which the periodic orbit closes; 1 is the fixed point. Only orbits
    that are symmetric under the reversor are found. A run says if there is none."""
    type: fields.OrbitType
    """Stability of the periodic orbit: an elliptic orbit is surrounded by islands, a hyperbolic or
    inverse hyperbolic one is a saddle with manifolds. It selects among the orbits of the period."""


class OfManifolds(OfPeriodicOrbit):
    """A scene of the manifolds of a hyperbolic orbit."""

    type: fields.Saddle
    """Stability of the periodic orbit, which must be a saddle to have manifolds. It selects among
    the orbits of the period."""
    resolution: fields.Resolution
    """How finely the manifolds are traced. A finer resolution takes more time and more memory. A
    run says if the branches would have too many points."""

    def cross_field_errors(self) -> Iterator[CrossFieldError]:
        """Check the tolerance of a scan, and that no branch needs too many points."""
        yield from super().cross_field_errors()
        # A branch begins as a segment of 1e-6: a coarser bisection leaves noise, not a line.
        if isinstance(self.method, Scan) and self.method.tolerance > 1e-12:
            words = "a number from 1e-15 to 1e-12, for manifolds"
            yield ("method", "tolerance"), self.method.tolerance, words
        branches = 4 * self.period  # stable and unstable, on both sides of each point
        longest = fields.LARGEST * self.resolution.distance / branches
        for place, length in self.lengths():
            if length > longest:
                words = f"at most {fields.LARGEST} times resolution.distance"
                yield place, length, f"{words}, shared by {branches} branches = {longest}"

    def lengths(self) -> Iterator[tuple[tuple[str, ...], float]]:
        """Yield the place and the value of each length of branches."""
        yield from ()


class OfBranches(OfManifolds):
    """A scene of branches of both sides, each with its own length."""

    branches: Annotated[fields.BothBranches, fields.NOT_EMPTY]
    """Which branches of the manifolds are traced, and how far."""

    def lengths(self) -> Iterator[tuple[tuple[str, ...], float]]:
        """Yield the length of the branches of each side."""
        for side, branch in self.branches:
            if branch:
                yield ("branches", side, "length"), branch.length


class OnSurface(Scene):
    """A scene drawn on the energy surface, in (x, xdot, udot)."""

    view: fields.View = Field({"elevation": 40, "azimuth": 115}, validate_default=True)
    """Direction from which the surface is seen. The surface is opaque and hides its far side."""
    axes: SectionAxes = ABSENT
    """Limits and ticks of the axes `x` (position, R), `xdot` (velocity, omega R) and `udot` (strain
    rate, omega). An axis that is left out has limits that hold its data. Limits that cut the energy
    surface are widened to hold it, and a run says so."""

    def cross_field_errors(self) -> Iterator[CrossFieldError]:
        """Check that the box, if all axes are given, is neither too high nor too flat."""
        yield from super().cross_field_errors()
        axes = self.given_axes()
        limits = [axes[name].limits for name in ("x", "xdot", "udot") if name in axes]
        sound = len(limits) == 3 and all(map(fields.rising, limits))
        if refused := disproportion(limits, **dict(self.view)) if sound else None:
            yield ("axes", refused[0], "limits"), *refused[1:]


def is_sound(scene: Scene) -> bool:
    """Return whether a scene's ball has a section at its energies, so that more can be checked."""
    return not any(Scene.cross_field_errors(scene))


def bounded(
    scene: Scene, first: str, second: str, what: str, most: int = fields.LARGEST
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
    low, high = 0.0, math.pi  # of theta: the trace falls through -2 between them
    while (theta := (low + high) / 2) not in (low, high):
        low, high = (theta, high) if fixed_point(k, theta)[1] > -2 else (low, theta)
    highest = fixed_point(k, theta)[0] * g * g
    for place, energy in _entries(scene, name):
        if not energy < highest:
            yield place, energy, f"an energy below {highest:.6g}, where the fixed point is elliptic"


def exact(value: float) -> Fraction:
    """Return a number as the decimal that was written. As floats, 0.2 / 2 - 0.04 exceeds 0.06."""
    return Fraction(str(value))


def _entries(scene: Picture, *names: str) -> Iterator[tuple[tuple[str | int, ...], Any]]:
    """Yield place and value of those fields that the scene has, and of each entry of a list."""
    for name in names:
        value = getattr(scene, name, [])
        if isinstance(value, list):
            yield from (((name, i), entry) for i, entry in enumerate(value))
        else:
            yield (name,), value


def _energy_errors(scene: Scene) -> Iterator[CrossFieldError]:
    """Yield energies without motion, with flights too long, or at which the ball could flatten."""
    k, g = exact(scene.ball.k), exact(scene.ball.g)
    lowest, highest = energy_bounds(k, g)
    long = lowest + (LONGEST_FLIGHT * g) ** 2 / 8  # there sqrt(2E + g^2/k) = LONGEST_FLIGHT g/2
    names = ["energy", "energies"] + ["span"] * scene.along_energy()
    for place, energy in _entries(scene, *names):
        if not exact(energy) > lowest:
            bound = f"-g^2/(2k) = {float(lowest)}, where the ball rests on the floor"
            yield place, energy, f"a number above {bound}"
        elif not exact(energy) < highest:
            bound = f"k/2 - g = {float(highest)}, where the ball could flatten to nothing"
            yield place, energy, f"a number below {bound}"
        elif not exact(energy) <= long:
            yield place, energy, f"at most {float(long)}, with flights up to {LONGEST_FLIGHT}/omega"


def _start_errors(
    scene: Scene, start: fields.Point, place: tuple[str, int]
) -> Iterator[CrossFieldError]:
    """Check that a point lies inside the section at the scene's energy."""
    if (start.xdot is None) == (start.y is None):
        yield place, start.as_mapping(), "a point {x, xdot} or {x, y}"
        return
    k, g, energy = exact(scene.ball.k), exact(scene.ball.g), exact(scene.energy)
    x = exact(start.x)
    twice_kinetic_energy = 2 * energy + 2 * g * x - k * x * x
    # Nearer to the rim than this, rounding decides whether the ball leaves the floor.
    margin = Fraction(1, 10**12) * twice_energy_above_rest(k, g, energy)
    if start.y is not None:
        y = exact(start.y)
        inside = (1 + k) * twice_kinetic_energy - y * y > margin
        condition = "y^2/(1+k) + k (x - g/k)^2 < 2E + g^2/k"
    else:
        v = exact(start.xdot)
        square = twice_kinetic_energy - v * v  # k udot^2
        inside = square > margin and (v >= 0 or square - k * v * v > margin)
        condition = "xdot^2 < 2E + 2gx - kx^2 and xdot + udot > 0"
    if not inside:
        words = f"a point on the section at energy {scene.energy}, {condition}"
        yield place, start.as_mapping(), words
