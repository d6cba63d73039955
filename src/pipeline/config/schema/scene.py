"""What a scene is, and the groups of fields that kinds of picture are made of.

A kind of picture is one class in `kinds`, derived from these; the checks of a group that need more
than one field stand with it. Numbers are compared as the decimals that were written.
"""

import inspect
import math
from collections.abc import Iterator
from fractions import Fraction
from typing import Annotated, Any, ClassVar

from pydantic import Field

from . import fields

CrossFieldError = tuple[tuple, Any, str]  # place in the scene, value, what is allowed
SECTION = fields.axes_of("x", "xdot", "udot")


class Scene(fields.Block):
    """a mapping that begins with picture

    The docstring of a kind has, below its first line, the caption of the kind's figures: Jinja,
    with the scene's block as `s`; what the picture shows, and what to see in it.
    """

    # In the order in which the kind's `draw` takes them.
    stages: ClassVar[tuple[str, ...]]
    # A variant that changes one of these, the ball or the energy has axes of its own.
    axes_depend_on: ClassVar[tuple[str, ...]] = ()
    # Axis -> the field whose values lie along it.
    along: ClassVar[dict[str, str]] = {}
    # The quantity of `numbers` that stands for the figure in a list.
    headline: ClassVar[str]
    # Another scene of the kind than the committed one, small: YAML, its fields without `picture`.
    example: ClassVar[str]
    # Which measure of error the study applies to it (pseudorigid.study.figure_errors), or None.
    studied: ClassVar[str | None] = None

    picture: Annotated[str, Field(description="the kind of picture: one of those below")]
    """what is drawn"""
    ball: fields.BallBlock = None
    """the ball of this scene, where it is another"""
    energy: fields.Energy
    """the energy, which each impact keeps"""
    method: fields.Method = None
    """how impacts are found, where not by the certified first root"""
    formats: fields.Formats = ["png"]
    """the files drawn"""

    @classmethod
    def caption(cls) -> str:
        """The caption of its figures, a template."""
        return inspect.getdoc(cls).partition("\n\n")[2]

    @classmethod
    def hidden(cls, block: dict) -> Iterator[str]:
        """A line for each field of a checked block that asks for more than its axes show."""
        for axis, field in cls.along.items():
            limits = block.get("axes", {}).get(axis, {}).get("limits")
            values = block[field] if isinstance(block[field], list) else [block[field]]
            outside = [v for v in values if limits and not limits[0] <= v <= limits[1]]
            if outside:
                yield f"{field} {max(outside)} lies outside {beyond(axis, limits)}"

    @staticmethod
    def numbers(block: dict, **data) -> dict[str, str]:
        """Quantity -> value in words, measured in the datasets of its stages (for the report)."""
        raise NotImplementedError

    @classmethod
    def cross_field_errors(cls, block: dict) -> Iterator[CrossFieldError]:
        """What is wrong with a complete block whose fields have their types."""
        ball = block["ball"]
        if not ball["g"] < ball["k"]:
            yield ("ball", "g"), ball["g"], f"0 < g < k = {ball['k']}"
            return
        yield from _energy_errors(block)
        for axis, drawn in block.get("axes", {}).items():
            low, high = drawn["limits"]
            what = f"numbers within the limits {drawn['limits']}"
            for tick in drawn["ticks"]:
                if low < high and not low <= tick <= high:
                    yield ("axes", axis, "ticks"), tick, what


class OfOrbits(Scene):
    """A scene of orbits from given starts."""

    starts: fields.Starts
    """where the orbits start, on y = 0 or at a point of the section"""
    impacts: fields.Impacts
    """how many impacts of each orbit"""

    @classmethod
    def cross_field_errors(cls, block):
        """Each start on the section, impacts for each of them, not too many in all."""
        yield from super().cross_field_errors(block)
        starts, impacts = block["starts"], block["impacts"]
        for i, start in enumerate(starts):
            if isinstance(start, dict):
                yield from _start_errors(block, start, ("starts", i))
        if isinstance(impacts, list) and len(impacts) != len(starts):
            yield ("impacts",), impacts, f"one number for each of the {len(starts)} starts"
        elif sum(each(impacts, starts)) > fields.LARGEST:
            what = f"at most {fields.LARGEST} impacts in a scene, counted over all its starts"
            yield ("impacts",), impacts, what


class OfRecords(OfOrbits):
    """A scene of exponents along orbits."""

    records: fields.whole(2, 10_000)
    """how many numbers of impacts have their exponents kept"""

    @classmethod
    def cross_field_errors(cls, block):
        """No more records than impacts."""
        yield from super().cross_field_errors(block)
        least = min(each(block["impacts"], block["starts"]))
        if block["records"] > least:
            yield ("records",), block["records"], f"at most impacts = {least}"


class OfPeriodicOrbit(Scene):
    """A scene of one periodic orbit."""

    period: fields.Period
    """impacts after which the orbit closes"""
    type: fields.OrbitType
    """its stability"""

    @staticmethod
    def about_orbit(periodic, block) -> dict[str, str]:
        """The orbit in words, its energy, and what tells its kind of stability."""
        from pseudorigid.dynamics.variables import of_type

        orbit = of_type(periodic, block["type"])
        words = {"orbit": f"{orbit['type'].item()}, period {orbit.sizes['point']}"}
        words |= measured_energy(block, orbit)
        if block["type"] == "elliptic":
            return words | {"rotation number": f"{float(orbit['rotation_number']):.6f}"}
        return words | {"multiplier": f"{float(orbit['multiplier']):.6f}"}


class OfManifolds(OfPeriodicOrbit):
    """A scene of the manifolds of a hyperbolic orbit."""

    method: fields.FineMethod = None
    type: fields.Saddle
    resolution: fields.Resolution
    """how finely the manifolds are traced"""

    sides: ClassVar[int] = 2  # of a point on which branches leave it

    @classmethod
    def lengths(cls, block) -> dict[tuple, float]:
        """Place in the block -> the length of a branch."""
        raise NotImplementedError

    @classmethod
    def cross_field_errors(cls, block):
        """No branches longer than their points allow."""
        yield from super().cross_field_errors(block)
        # each of them leaves every point twice, stable and unstable
        branches = 2 * block["period"] * cls.sides
        longest = fields.LARGEST * block["resolution"]["distance"] / branches
        for place, length in cls.lengths(block).items():
            if length > longest:
                what = f"at most {fields.LARGEST} times resolution.distance"
                yield place, length, f"{what}, shared by {branches} branches = {longest}"


class OfBranches(OfManifolds):
    """A scene of branches of both sides, each as long as it says."""

    branches: fields.Branches
    """which branches, and how far"""

    @classmethod
    def lengths(cls, block):
        """Those of the branches."""
        branches = block["branches"]
        return {("branches", side, "length"): branches[side]["length"] for side in branches}


class OnSurface(Scene):
    """A scene drawn on the energy surface, in (x, xdot, udot)."""

    view: fields.View = {"elevation": 40, "azimuth": 115}
    """from where the surface is seen"""
    axes: SECTION = None


def bounded(block, first, second, what) -> Iterator[CrossFieldError]:
    """The fault of two whole numbers whose product counts numbers that are held at once."""
    if block[first] * block[second] > fields.LARGEST:
        allowed = f"at most {fields.LARGEST} {what}, {first} times {second}"
        yield (second,), block[second], f"{allowed}: here {fields.LARGEST // block[first]}"


def beyond(axis, limits) -> str:
    """Limits of an axis that hide something, and what to do about them."""
    return f"axes.{axis}.limits {limits}: widen them, or leave axes.{axis} out"


def listing(data, words, *names) -> str:
    """The values of some variables of a dataset side by side, each time in these words."""
    rows = zip(*(data[name].values for name in names), strict=True)
    return ", ".join(words.format(*row) for row in rows)


def each(impacts, starts) -> list[int]:
    """Impacts of each start, given as one number or as a list."""
    return impacts if isinstance(impacts, list) else [impacts] * len(starts)


def measured_energy(block, states) -> dict[str, str]:
    """The energy of a dataset's states, eq. (29), to twelve digits."""
    from pseudorigid.dynamics.ball import Ball
    from pseudorigid.dynamics.variables import states_of

    ball = Ball(**block["ball"])
    energy = ball.energy(*states_of(states))
    ends = dict.fromkeys(f"{value:.12g}" for value in (energy.min(), energy.max()))
    return {"energy": " to ".join(ends)}


def not_elliptic(block, name) -> Iterator[CrossFieldError]:
    """Faults of energies, of a field that is one or a list, where the fixed point is hyperbolic."""
    energies = block[name] if isinstance(block[name], list) else [block[name]]
    for i, energy in enumerate(energies):
        if not fixed_point_trace(block["ball"], energy) > -2:
            low, high = -(block["ball"]["g"] ** 2) / (2 * block["ball"]["k"]), energy
            for _ in range(40):
                middle = (low + high) / 2
                elliptic = fixed_point_trace(block["ball"], middle) > -2
                low, high = (middle, high) if elliptic else (low, middle)
            place = (name, i) if isinstance(block[name], list) else (name,)
            yield place, energy, f"an energy below {low:.6g}, where the fixed point is elliptic"


def fixed_point_trace(ball, energy) -> float:
    """The trace at the fixed point, as in `pseudorigid.dynamics.fixed_point`, to some digits.

    That module compiles code when it is imported, which takes too long for a check.
    """
    k, energy = ball["k"], energy / ball["g"] ** 2

    def one_minus_theta_cot(theta):
        return 1 - theta / math.tan(theta)

    low, high = 0.0, math.pi
    while (theta := (low + high) / 2) not in (low, high):
        below = ((1 + k) * theta * theta + one_minus_theta_cot(theta) ** 2 - 1) / (2 * k) < energy
        low, high = (theta, high) if below else (low, theta)
    shear = one_minus_theta_cot(theta) * (2 * theta - math.sin(2 * theta)) / (theta * (1 + k))
    return 2 * (1 + k * (math.cos(2 * theta) - shear)) / (1 + k)


def exact(value) -> Fraction:
    """The decimal as written: as floats 0.2 / 2 - 0.04 is a little more than 0.06."""
    return Fraction(str(value))


def _energy_errors(block):
    k, g = (exact(block["ball"][name]) for name in "kg")
    lowest, highest = -g * g / (2 * k), k / 2 - g
    more = {("energies", i): energy for i, energy in enumerate(block.get("energies", ()))}
    for place, energy in ({("energy",): block["energy"]} | more).items():
        if not exact(energy) > lowest:
            where = f"-g^2/(2k) = {float(lowest)}, where the ball rests on the floor"
            yield place, energy, f"a number above {where}"
        elif not exact(energy) < highest:
            where = f"k/2 - g = {float(highest)}, where the ball could flatten to nothing"
            yield place, energy, f"a number below {where}"


def _start_errors(block, start, place):
    """A point {x, xdot} or {x, y} must lie inside the section at the scene's energy."""
    if ("xdot" in start) == ("y" in start):
        yield place, start, "a point {x, xdot} or {x, y}"
        return
    k, g, energy = (exact(x) for x in (*(block["ball"][n] for n in "kg"), block["energy"]))
    x = exact(start["x"])
    rest = 2 * energy + 2 * g * x - k * x * x  # twice the kinetic energy
    least = Fraction(1, 10**12) * (2 * energy + g * g / k)  # that near the rim roundings decide
    if "y" in start:
        y = exact(start["y"])
        inside = (1 + k) * rest - y * y > least
        where = "y^2/(1+k) + k (x - g/k)^2 < 2E + g^2/k"
    else:
        v = exact(start["xdot"])
        square = rest - v * v  # k udot^2
        inside = square > least and (v >= 0 or square - k * v * v > least)
        where = "xdot^2 < 2E + 2gx - kx^2 and xdot + udot > 0"
    if not inside:
        yield place, start, f"a point on the section at energy {block['energy']}, {where}"
