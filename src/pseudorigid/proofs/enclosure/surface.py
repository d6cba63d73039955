"""A surface of constant energy of a ball with exact parameters, and the impact map on it."""

import re
from dataclasses import dataclass, field
from decimal import Decimal
from fractions import Fraction
from typing import NamedTuple

from flint import arb, ctx, fmpq

from .flight import UndecidedError, first_root
from .jets import Jet, algebra

_NUMBER = re.compile(r"\s*[+-]?(\d+(\.\d*)?|\.\d+)([eE][+-]?\d{1,3}|\s*/\s*\d+)?\s*", re.ASCII)


def exact(name, value):
    """An exact number as a Fraction.

    Parameters
    ----------
    name : str
        What the message calls it.
    value : int, Fraction, Decimal or str
        Text is such as "1/5" or "0.2". A float is refused: 0.2 is not 1/5.

    Returns
    -------
    Fraction

    Raises
    ------
    ValueError
        For anything else.
    """
    if isinstance(value, float):
        raise ValueError(
            f"{name} = {value!r} is a rounded number: give text or a Fraction, such as '{value!r}'"
        )
    try:
        if isinstance(value, str):
            if not _NUMBER.fullmatch(value):
                raise ValueError
            top, _, below = value.partition("/")
            return Fraction(top.strip()) / Fraction(below.strip() or 1)
        if isinstance(value, (int, Fraction, Decimal)) and not isinstance(value, bool):
            return Fraction(value)
    except (ValueError, ZeroDivisionError, OverflowError):
        pass
    raise ValueError(f"{name} = {value!r} is not an exact number, such as '1/5' or '0.2'")


def ball_of(fraction):
    """The narrowest ball of the context's precision around a Fraction.

    Parameters
    ----------
    fraction : Fraction

    Returns
    -------
    arb
    """
    return arb(fmpq(fraction.numerator, fraction.denominator))


class Impact(NamedTuple):
    """The next impact of a point: the chart's x and y, the flight, and s = xdot + udot there.

    Attributes
    ----------
    x, y, tau, s : arb or Jet
        In R, R omega, 1/omega and R omega.
    """

    x: object
    y: object
    tau: object
    s: object


@dataclass(frozen=True)
class Surface:
    """The states just before an impact at one energy, in the chart x, y = xdot - k udot.

    Parameters
    ----------
    k, g, energy : int, Fraction, Decimal or str
        Exact: Euler inertia, gravity and total energy, dimensionless.
    width : int, Fraction, Decimal or str
        With a width the energy is every one from `energy` to `energy + width`: what is proved then
        holds for each of them.

    Raises
    ------
    ValueError
        For what is not an exact number or lies outside 0 < k <= 1, g > 0, energy > -g^2/(2k).

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
    width: Fraction = Fraction(0)
    _balls: dict = field(default_factory=dict, compare=False, repr=False)

    def __post_init__(self):
        for name in ("k", "g", "energy", "width"):
            object.__setattr__(self, name, exact(name, getattr(self, name)))
        if not 0 < self.k <= 1:
            raise ValueError(f"k = {self.k} is not allowed: 0 < k <= 1")
        if not self.g > 0:
            raise ValueError(f"g = {self.g} is not allowed: g > 0")
        lowest = -self.g * self.g / (2 * self.k)
        if not self.energy > lowest:
            raise ValueError(f"energy = {self.energy} is not allowed: above {lowest}")

    def __str__(self):
        return ", ".join(
            f"{name} = {value if value.denominator < 10**15 else float(value)}"
            for name, value in (("k", self.k), ("g", self.g), ("E", self.energy))
        )

    def constants(self):
        """The surface's numbers in balls of the context's precision.

        Returns
        -------
        k, g, energy : arb
        """
        if ctx.prec not in self._balls:
            if len(self._balls) > 50:
                self._balls.clear()
            k, g, energy = (ball_of(a) for a in (self.k, self.g, self.energy))
            if self.width:
                energy = energy.union(ball_of(self.energy + self.width))
            self._balls[ctx.prec] = k, g, energy
        return self._balls[ctx.prec]

    def radius(self):
        """Half the section's width along y = 0.

        Returns
        -------
        arb
            In R.
        """
        k, g, energy = self.constants()
        return ((2 * energy + g * g / k) / k).sqrt()

    def speed(self, x, y):
        """The contact point's speed s = xdot + udot just before the impact.

        Parameters
        ----------
        x, y : arb or Jet
            Of the chart.

        Returns
        -------
        arb or Jet
            In R omega.

        Raises
        ------
        UndecidedError
            Where a point may lie on or off the rim.
        """
        k, g, energy = self.constants()
        square = ((1 + k) * (2 * energy + x * (2 * g - k * x)) - y * y) / k
        if not (square.constant if isinstance(square, Jet) else square) > 0:
            raise UndecidedError("a point is not proved to lie inside the section's rim")
        return square.sqrt()

    def velocities(self, x, y):
        """The velocities just before the impact.

        Parameters
        ----------
        x, y : arb or Jet
            Of the chart.

        Returns
        -------
        xdot, udot : arb or Jet
            In R omega and omega.

        Raises
        ------
        UndecidedError
            Where a point may lie on or off the rim.
        """
        k = self.constants()[0]
        s = self.speed(x, y)
        return (y + k * s) / (1 + k), (s - y) / (1 + k)

    def impact(self, x, y):
        """The impact map P, eq. (28), at points of the chart.

        Parameters
        ----------
        x, y : arb or Jet
            Balls stand for all points in them.

        Returns
        -------
        Impact
            It contains that of every point.

        Raises
        ------
        UndecidedError
            Where a point may lie on the rim, or the next flight may touch the floor earlier.
        """
        k, g, _ = self.constants()
        s = self.speed(x, y)
        b, c = (y - k * s) / (1 + k), -(y + s) / (1 + k)
        tau = first_root(x, c, s, g)
        sine, cosine = tau.sin_cos()
        xdot, udot = b + g * tau, x * sine + c * cosine
        return Impact(x * cosine - c * sine, xdot - k * udot, tau, xdot + udot)

    def jacobian(self, x, y):
        """The map's derivative over a box.

        Parameters
        ----------
        x, y : arb
            The box.

        Returns
        -------
        rows : ((arb, arb), (arb, arb))
            Every DP of its points is inside.
        image : Impact
            Every image is inside.

        Raises
        ------
        UndecidedError
            As for `impact`.
        """
        plane = algebra(2, 1)
        image = self.impact(Jet.variable(plane, 0, x), Jet.variable(plane, 1, y))
        rows = tuple(tuple(image[i].coefficients[1:]) for i in (0, 1))
        return rows, Impact(*(part.constant for part in image))
