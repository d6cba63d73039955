"""Certificates: TOML files whose numbers are taken as the exact decimals written there."""

import tomllib
from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from math import inf

from flint import arb

from ..enclosure.surface import Exact, Surface, ball_of, exact

MOST_DIGITS = 100  # of the numerator and the denominator of a certificate's number


class NotProvedError(Exception):
    """The reason why a checker does not take a statement as proved."""


@dataclass
class Finding:
    """The result of a checker.

    Attributes
    ----------
    digits : dict of str to arb
        Enclosures.
    margins : dict of str to float
        By how much inequalities hold: positive and finite.
    parts : dict
        Proved objects that later steps use.
    """

    digits: dict = field(default_factory=dict)
    margins: dict = field(default_factory=dict)
    parts: dict = field(default_factory=dict)

    def __post_init__(self):
        for name, margin in self.margins.items():
            if not 0 < margin < inf:
                raise NotProvedError(f"the margin {name} is {margin:g}, not positive and finite")


class Certificate:
    """The fields of a certificate, read by name and shape.

    Every method raises NotProvedError for text that is not TOML, and for a field that is missing,
    misshapen or not as expected.

    Parameters
    ----------
    text : str
        TOML.
    kind : str
        The required value of the field `kind`.
    """

    def __init__(self, text: str, kind: str):
        try:
            self._fields = tomllib.loads(text, parse_float=str)
        except (ValueError, ArithmeticError, RecursionError) as error:
            raise NotProvedError(f"the certificate cannot be read: {error}") from None
        if self._fields.get("kind") != kind:
            raise NotProvedError(f"the certificate is not one of kind {kind!r}")

    def check_surface(self, expected: Surface) -> None:
        """Check that the certificate is for a Surface."""
        surface = self.surface(expected.k, expected.g)
        if surface != expected:
            raise NotProvedError(f"the certificate is of {surface}, the statement of {expected}")

    def surface(self, k: Fraction, g: Fraction) -> Surface:
        """Return the Surface, at any energy, that the certificate is for; its ball is given."""
        self.check_ball(k, g)
        try:
            return Surface(k, g, self._exact("energy", self._take("energy", str)))
        except ValueError as error:
            raise NotProvedError(f"the certificate's {error}") from None

    def check_ball(self, k: Fraction, g: Fraction) -> None:
        """Check that the certificate is for the ball with this k and g."""
        for name, expected in (("k", k), ("g", g)):
            value = self._exact(name, self._take(name, str))
            if value != expected:
                raise NotProvedError(f"the certificate is of {name} = {value}, not {expected}")

    def number(self, name: str) -> Fraction:
        """Return one number."""
        return self._exact(name, self._take(name, object))

    def numbers(self, name: str, width: int) -> list[list[Fraction]]:
        """Return a list of rows of `width` numbers each."""
        rows = self._take(name, list)
        if not rows or any(not isinstance(row, list) or len(row) != width for row in rows):
            raise NotProvedError(f"the certificate's {name} is no list of rows of {width} numbers")
        return [[self._exact(name, value) for value in row] for row in rows]

    def row(self, name: str, width: int) -> list[Fraction]:
        """Return one row of `width` numbers."""
        self._fields |= {name: [self._fields.get(name)]}
        return self.numbers(name, width)[0]

    def _take(self, name, kind):
        value = self._fields.get(name)
        if value is None or not isinstance(value, kind):
            raise NotProvedError(f"the certificate's {name} is missing or of another form")
        return value

    @staticmethod
    def _exact(name: str, value: Exact) -> Fraction:
        try:
            number = exact(name, value)
        except ValueError as error:
            raise NotProvedError(f"the certificate's {error}") from None
        if max(abs(number.numerator), number.denominator) >= 10**MOST_DIGITS:
            raise NotProvedError(f"the certificate's {name} has more than {MOST_DIGITS} digits")
        return number


def box(centre: Sequence[Fraction], radius: Fraction) -> list[arb]:
    """Enclose the box of all points within a radius of a centre, per coordinate."""
    half = ball_of(Fraction(radius)).upper()
    return [arb(ball_of(c).mid(), (half + ball_of(c).rad()).upper()) for c in centre]


def lowest(value: arb) -> float:
    """Return a lower bound of a ball, rounded down."""
    low = float(value.lower())
    return low if arb(low) <= value.lower() else float(arb(low) - abs(low) * 2.0**-52)
