"""Certificates: TOML files whose numbers are taken as the exact decimals that stand there."""

import tomllib
from dataclasses import dataclass, field
from fractions import Fraction
from math import inf

from flint import arb

from ..enclosure.surface import Surface, ball_of, exact

DIGITS = 100  # of the numerator and the denominator of a certificate's number, at most


class NotProvedError(Exception):
    """The reason why a checker does not take a statement as proved."""


@dataclass
class Finding:
    """What a checker has proved.

    Attributes
    ----------
    digits : dict of str to arb
        Enclosures.
    margins : dict of str to float
        By how much inequalities hold: positive and finite.
    parts : dict
        What later steps use.
    """

    digits: dict = field(default_factory=dict)
    margins: dict = field(default_factory=dict)
    parts: dict = field(default_factory=dict)

    def __post_init__(self):
        for name, margin in self.margins.items():
            if not 0 < margin < inf:
                raise NotProvedError(f"the margin {name} is {margin:g}, not positive and finite")


class Certificate:
    """The fields of a certificate, asked for by name and shape.

    Parameters
    ----------
    text : str
        TOML.
    kind : str
        What its field `kind` must be.

    Raises
    ------
    NotProvedError
        For text that is no certificate, of another kind or with a field missing or misshapen.
    """

    def __init__(self, text, kind):
        try:
            self._fields = tomllib.loads(text, parse_float=str)
        except (ValueError, ArithmeticError, RecursionError) as error:
            raise NotProvedError(f"the certificate cannot be read: {error}") from None
        if self._fields.get("kind") != kind:
            raise NotProvedError(f"the certificate is not one of kind {kind!r}")

    def surface(self, expected):
        """The Surface the certificate is for, which must be the expected one."""
        found = self.any_surface(expected.k, expected.g)
        if found != expected:
            raise NotProvedError(f"the certificate is of {found}, the statement of {expected}")
        return found

    def any_surface(self, k, g):
        """The Surface the certificate is for, which must be of the ball with this k and g."""
        self.ball(k, g)
        try:
            return Surface(k, g, self._exact("energy", self._take("energy", str)))
        except ValueError as error:
            raise NotProvedError(f"the certificate's {error}") from None

    def ball(self, k, g):
        """Check that the certificate is for the ball with this k and g."""
        for name, expected in (("k", k), ("g", g)):
            found = self._exact(name, self._take(name, str))
            if found != expected:
                raise NotProvedError(f"the certificate is of {name} = {found}, not {expected}")

    def number(self, name):
        """One number, as a Fraction."""
        return self._exact(name, self._take(name, object))

    def numbers(self, name, width):
        """A list of rows of `width` numbers, as Fractions."""
        rows = self._take(name, list)
        if not rows or any(not isinstance(row, list) or len(row) != width for row in rows):
            raise NotProvedError(f"the certificate's {name} is no list of rows of {width} numbers")
        return [[self._exact(name, value) for value in row] for row in rows]

    def row(self, name, width):
        """One row of `width` numbers, as Fractions."""
        self._fields |= {name: [self._fields.get(name)]}
        return self.numbers(name, width)[0]

    def _take(self, name, kind):
        value = self._fields.get(name)
        if value is None or not isinstance(value, kind):
            raise NotProvedError(f"the certificate has no {name}, or not of its form")
        return value

    @staticmethod
    def _exact(name, value):
        try:
            number = exact(name, value)
        except ValueError as error:
            raise NotProvedError(f"the certificate's {error}") from None
        if max(abs(number.numerator), number.denominator) >= 10**DIGITS:
            raise NotProvedError(f"the certificate's {name} has more than {DIGITS} digits")
        return number


def box(centre, radius):
    """A box around a point, of one radius in each coordinate.

    Parameters
    ----------
    centre : sequence of Fraction
    radius : Fraction

    Returns
    -------
    list of arb
        They contain the exact box.
    """
    half = ball_of(Fraction(radius)).upper()
    return [arb(ball_of(c).mid(), (half + ball_of(c).rad()).upper()) for c in centre]


def lowest(value):
    """A lower bound of a ball, rounded down.

    Parameters
    ----------
    value : arb

    Returns
    -------
    float
    """
    low = float(value.lower())
    return low if arb(low) <= value.lower() else float(arb(low) - abs(low) * 2.0**-52)
