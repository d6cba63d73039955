"""A surface of constant energy of a ball with exact parameters, and the impact map on it."""

import re
from dataclasses import dataclass, fields
from decimal import Decimal
from fractions import Fraction
from functools import cached_property
from typing import Any, Generic, NamedTuple, overload

from flint import acb, arb, ctx, fmpq

from pseudorigid.dynamics.inputs import in_one_line
from pseudorigid.verified.flight import Flight, UndecidedError

from .jets import Jet, Real, Value, square_root

_NUMBER = re.compile(r"\s*[+-]?(\d+(\.\d*)?|\.\d+)([eE][+-]?\d{1,3}|\s*/\s*\d+)?\s*", re.ASCII)

_MOST_PRECISIONS = 50  # whose constants are kept

Exact = int | Fraction | Decimal | str


def exact(name: str, value: Exact) -> Fraction:
    """Convert an exact number, such as the text "1/5" or "0.2", to a Fraction.

    Raises ValueError, with the name, for anything else. A float is refused: 0.2 is not 1/5.
    """
    if isinstance(value, float):
        raise ValueError(
            f"{name} = {value!r} is a rounded number: give text or a Fraction, such as '{value!r}'"
        )
    try:
        if isinstance(value, str) and _NUMBER.fullmatch(value):
            numerator, _, denominator = "".join(value.split()).partition("/")
            return Fraction(numerator) / Fraction(denominator or 1)
        if isinstance(value, (int, Fraction, Decimal)) and not isinstance(value, bool):
            return Fraction(value)
    except (ValueError, ZeroDivisionError, OverflowError):
        pass
    text = in_one_line(value)
    raise ValueError(f"{name} = {text} is not an exact number, such as '1/5' or '0.2'")


def _shortened(value: Fraction) -> Fraction | float:
    """Return the Fraction, or the nearest double if its denominator is long."""
    return value if value.denominator < 10**15 else float(value)


def ball_of(fraction: Fraction) -> arb:
    """Return the narrowest ball of the context's precision around a Fraction."""
    return arb(fmpq(fraction.numerator, fraction.denominator))


def fraction_of(value: arb) -> Fraction:
    """Return the midpoint of a ball, which is exact, as a Fraction."""
    mantissa, exponent = value.mid().man_exp()
    return Fraction(int(mantissa)) * Fraction(2) ** int(exponent)


def flight_of_constants(flight: Flight) -> Flight:
    """Return the flight of the constant terms of a flight of jets."""
    x, b, c, s = (part.constant for part in (flight.x, flight.b, flight.c, flight.s))
    return Flight(x, b, c, s, flight.g)


def first_root(flight: Flight) -> Any:
    """Enclose the time of the next impact, also for a flight of jets.

    This is `Flight.first_root`; for jets it is the Taylor series of that root.
    """
    if isinstance(flight.x, Jet):
        return expand(flight, flight_of_constants(flight).first_root())
    return flight.first_root()


def expand(flight: Flight, root: arb | acb) -> Jet:
    """Expand a root in a series: Newton steps on jets, whose constant term solves f = 0."""
    time, order = Jet.constant_of(flight.x.algebra, root), 0
    while order < flight.x.algebra.order:
        height, slope = flight.height_and_slope(time, *time.sin_cos())
        height.coefficients[0] = 0 * root
        time = time - height / slope
        order = 2 * order + 1
    return time


class Impact(NamedTuple, Generic[Value]):
    """The next impact of a point: its x and y, the time of flight tau, and s = xdot + udot."""

    x: Value
    y: Value
    tau: Value
    s: Value


@dataclass(frozen=True, init=False)
class Surface:
    """The states just before an impact at one energy, in the chart x, y = xdot - k udot.

    Parameters
    ----------
    k, g, energy : int, Fraction, Decimal or str
        Exact: Euler inertia, gravity and total energy, dimensionless.
    width : int, Fraction, Decimal or str
        With a width the surface is that of every energy from `energy` to `energy + width`. What is
        proved then holds for each of them.

    Raises
    ------
    ValueError
        A number is not exact, or not in 0 < k <= 1, g > 0, energy > -g^2/(2k), width >= 0.

    Examples
    --------
    >>> surface = Surface("1/5", "1/25", "1/100")
    >>> image = surface.impact(arb("0.1"), arb(0))
    >>> bool(image.tau > 0), image.s.rad() < 1e-12
    (True, True)
    """

    k: Fraction
    g: Fraction
    energy: Fraction
    width: Fraction

    def __init__(self, k: Exact, g: Exact, energy: Exact, width: Exact = 0) -> None:
        for name, value in {"k": k, "g": g, "energy": energy, "width": width}.items():
            object.__setattr__(self, name, exact(name, value))
        if not 0 < self.k <= 1:
            raise ValueError(f"k = {self.k} is not allowed: 0 < k <= 1")
        if not self.g > 0:
            raise ValueError(f"g = {self.g} is not allowed: g > 0")
        lowest = -self.g * self.g / (2 * self.k)
        if not self.energy > lowest:
            asked, least = map(_shortened, (self.energy, lowest))
            raise ValueError(f"energy = {asked} is not allowed: above {least}")
        if not self.width >= 0:
            raise ValueError(f"width = {self.width} is not allowed: at least 0")

    def __str__(self) -> str:
        k, g, energy = map(_shortened, (self.k, self.g, self.energy))
        return f"k = {k}, g = {g}, E = {energy}"

    def constants(self) -> tuple[arb, arb, arb]:
        """Return k, g and the energy in balls of the context's precision."""
        if ctx.prec not in self._constants:
            if len(self._constants) == _MOST_PRECISIONS:
                self._constants.clear()
            k, g, energy = map(ball_of, (self.k, self.g, self.energy))
            if self.width:
                energy = energy.union(ball_of(self.energy + self.width))
            self._constants[ctx.prec] = k, g, energy
        return self._constants[ctx.prec]

    def __getstate__(self) -> dict[str, Fraction]:
        return {field.name: getattr(self, field.name) for field in fields(self)}

    @cached_property
    def _constants(self) -> dict[int, tuple[arb, arb, arb]]:
        """Constants by precision, as far as they were computed."""
        return {}

    def radius(self) -> arb:
        """Return half the section's width along y = 0."""
        k, g, energy = self.constants()
        return ((2 * energy + g * g / k) / k).sqrt()

    def area(self) -> arb:
        """Return the section's area in (x, y)."""
        k, g, energy = self.constants()
        return arb.pi() * (2 * energy + g * g / k) * ((1 + k) / k).sqrt()

    def speed(self, x: Value, y: Value) -> Value:
        """Return the contact speed s = xdot + udot just before the impact.

        At complex points it is the square root with positive real part. Raises UndecidedError where
        a point may lie on or off the rim, or s may not be analytic.
        """
        k, g, energy = self.constants()
        square = ((1 + k) * (2 * energy + x * (2 * g - k * x)) - y * y) / k
        if not (square.constant if isinstance(square, Jet) else square).real > 0:
            raise UndecidedError("a point is not proved to lie inside the section's rim")
        return square_root(square)

    def velocities(self, x: Value, y: Value) -> tuple[Value, Value]:
        """Return xdot and udot just before the impact; raises UndecidedError as `speed` does."""
        k = self.constants()[0]
        s = self.speed(x, y)
        return (y + k * s) / (1 + k), (s - y) / (1 + k)

    def flight(self, x: Value, y: Value) -> Flight:
        """Return the flight after the impact; raises UndecidedError as `speed` does."""
        k, g, _ = self.constants()
        s = self.speed(x, y)
        return Flight(x, (y - k * s) / (1 + k), -(y + s) / (1 + k), s, g)

    @overload
    def impact(self, x: Real, y: Real) -> Impact[Real]: ...
    @overload
    def impact(self, x: Value, y: Value, root: acb) -> Impact[Value]: ...
    def impact(self, x: Any, y: Any, root: acb | None = None) -> Impact[Any]:
        """Enclose the next impact of every point of the balls x and y, eq. (28).

        At complex points `root` encloses the flight times, which `complex_flight` continues. Raises
        UndecidedError where a point may lie on the rim, or a flight may touch the floor earlier.
        """
        flight = self.flight(x, y)
        if root is None:
            tau = first_root(flight)
        else:
            tau = expand(flight, root) if isinstance(x, Jet) else root
        x, xdot, udot = flight.end(tau)
        return Impact(x, xdot - self.constants()[0] * udot, tau, xdot + udot)

    def jacobian(self, x: arb, y: arb) -> tuple[list[list[arb]], Impact[arb]]:
        """Enclose the derivative DP over a box, as two rows, and the box's image.

        Raises UndecidedError as `impact` does.
        """
        image = self.impact(*Jet.plane(1, x, y))
        rows = [jet.coefficients[1:] for jet in image[:2]]
        return rows, Impact(*(part.constant for part in image))
