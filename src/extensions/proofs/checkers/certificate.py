"""Certificates: TOML files whose numbers are taken as the exact decimals written there."""

import tomllib
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from fractions import Fraction
from math import inf, nextafter
from typing import Any

from flint import arb

from pseudorigid.verified.flight import NotProvedError

from ..enclosure.surface import Surface, ball_of, exact

Ball = tuple[Fraction, Fraction]  # k and g
Range = tuple[Fraction, Fraction]  # lower and upper limit
Window = tuple[Range, Range]  # of x and of xdot
MOST_DIGITS = 100  # of the numerator and the denominator of a certificate's number


@contextmanager
def naming(what: str) -> Iterator[None]:
    """Begin the reason of a refusal with what could not be enclosed."""
    try:
        yield
    except NotProvedError as reason:
        raise NotProvedError(f"{what}: {reason}") from None


@dataclass
class Finding:
    """The result of a checker: enclosures, margins, and proved objects that later steps use.

    A margin says by how much an inequality holds. Raises NotProvedError for a margin that is not
    positive and finite.
    """

    digits: dict[str, arb] = field(default_factory=dict)
    margins: dict[str, float] = field(default_factory=dict)
    parts: dict[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for name, margin in self.margins.items():
            if not 0 < margin < inf:
                raise NotProvedError(f"the margin {name} is {margin:g}, not positive and finite")


class Certificate:
    """The fields of a certificate, a TOML text, which must have the given kind.

    It must also have the constants of the Surface, or the k and g of the ball, if these are given.
    Every method raises NotProvedError for a field that is missing, misshapen or not as expected.
    """

    def __init__(
        self, text: str, kind: str, surface: Surface | None = None, ball: Ball | None = None
    ):
        try:
            self._fields = tomllib.loads(text, parse_float=str)
        except (ValueError, ArithmeticError, RecursionError) as error:
            raise NotProvedError(f"the certificate cannot be read: {error}") from None
        if self._fields.get("kind") != kind:
            raise NotProvedError(f"the certificate is not one of kind {kind!r}")
        if ball is not None:
            self._check_ball(ball)
        if surface is not None and (its := self.surface((surface.k, surface.g))) != surface:
            raise NotProvedError(f"the certificate is of {its}, the statement of {surface}")

    def surface(self, ball: Ball) -> Surface:
        """Return the Surface of the ball at the certificate's energy."""
        self._check_ball(ball)
        try:
            return Surface(*ball, self.number("energy", str))
        except ValueError as error:
            raise NotProvedError(f"the certificate's {error}") from None

    def _check_ball(self, ball: Ball) -> None:
        if not (0 < ball[0] <= 1 and ball[1] > 0):
            raise NotProvedError("no ball has these k and g: 0 < k <= 1 and g > 0")
        for name, value in zip("kg", ball, strict=True):
            self.check(name, value, str)

    def check(self, name: str, expected: Fraction, kind: type = object) -> None:
        """Check that a number is as the statement has it."""
        value = self.number(name, kind)
        if value != expected:
            text = name.replace("_", " ")
            raise NotProvedError(f"the certificate is of {text} {value}, not {expected}")

    def number(self, name: str, kind: type = object) -> Fraction:
        """Return one number, which TOML must give as a value of this kind."""
        return self._exact(name, self._take(name, kind))

    def numbers(self, name: str, width: int) -> list[list[Fraction]]:
        """Return a list of rows of `width` numbers each."""
        rows = self._take(name, list)
        if not rows:
            raise NotProvedError(f"the certificate's {name} has no rows")
        return [self._row(name, row, width) for row in rows]

    def at_least(self, name: str, least: Fraction) -> Fraction:
        """Return a number, which must be at least the statement's."""
        value = self.number(name)
        if not value >= least:
            found, stated = float(value), float(least)
            raise NotProvedError(f"the certificate's {name} is {found:g}, not {stated:g} as stated")
        return value

    def at_most(self, name: str, most: Fraction) -> Fraction:
        """Return a positive number, which must be at most the statement's."""
        value = self.number(name)
        if not 0 < value <= most:
            found, stated = float(value), float(most)
            raise NotProvedError(
                f"the certificate's {name} is {found:g}, not above 0 and at most {stated:g}"
            )
        return value

    def whole(self, name: str) -> int:
        """Return a whole number."""
        return self._take(name, int)

    def whole_numbers(self, name: str) -> list[int]:
        """Return a list of whole numbers, which may be empty."""
        numbers = self._take(name, list)
        if not all(type(a) is int for a in numbers):
            raise NotProvedError(f"the certificate's {name} is no list of whole numbers")
        return numbers

    def row(self, name: str, width: int) -> list[Fraction]:
        """Return one row of `width` numbers."""
        return self._row(name, self._take(name, list), width)

    def _row(self, name: str, row: Any, width: int) -> list[Fraction]:
        if not isinstance(row, list) or len(row) != width:
            raise NotProvedError(f"the certificate's {name} is no row of {width} numbers")
        return [self._exact(name, value) for value in row]

    def _take(self, name: str, kind: type) -> Any:
        value = self._fields.get(name)
        if value is None or kind not in (object, type(value)):
            raise NotProvedError(f"the certificate's {name} is missing or of another form")
        return value

    @staticmethod
    def _exact(name: str, value: Any) -> Fraction:
        try:
            number = exact(name, value)
        except ValueError as error:
            raise NotProvedError(f"the certificate's {error}") from None
        if max(abs(number.numerator), number.denominator) >= 10**MOST_DIGITS:
            raise NotProvedError(f"the certificate's {name} has more than {MOST_DIGITS} digits")
        return number


def check_stated(
    name: str, values: Sequence[arb], stated: Sequence[Fraction], error: Fraction
) -> None:
    """Check that enclosed numbers are those that a certificate states, up to an error."""
    for value, near in zip(values, stated, strict=True):
        apart = abs(value - ball_of(near))
        if apart < ball_of(error):
            continue
        is_not = "is not" if apart > ball_of(error) else "is enclosed too widely to be"
        raise NotProvedError(f"the {name} {is_not} the stated one, near {float(near):.10g}")


def check_within(name: str, value: arb, limits: Range) -> None:
    """Check that an enclosed quantity lies between exact limits."""
    low, high = limits
    if not ball_of(low) < value < ball_of(high):
        raise NotProvedError(f"the {name} is not proved to lie where the statement says")


def holds_throughout(holds: Callable[[arb], bool], low: arb, high: arb, width: arb) -> bool:
    """Return whether a property is proved on an interval, in pieces not narrower than a width.

    The ends must be exact, low <= high, and the width positive.
    """
    if not (low.is_exact() and high.is_exact() and low <= high and width > 0):
        raise NotProvedError("an interval is not one, or has no exact ends")
    pieces = [(low, high)]
    while pieces:
        low, high = pieces.pop()
        if not low < high or holds(low.union(high)):
            continue
        if high - low < width:
            return False
        middle = ((low + high) / 2).mid()
        pieces += [(low, middle), (middle, high)]
    return True


def box(centre: Sequence[Fraction], radius: Fraction) -> list[arb]:
    """Enclose the box of all points within a radius, above 0, of a centre, per coordinate."""
    if not radius > 0:
        raise NotProvedError(f"a radius of {float(radius):g} is no size of a box")
    half = ball_of(Fraction(radius)).upper()
    return [arb(ball_of(c).mid(), (half + ball_of(c).rad()).upper()) for c in centre]


def lower_bound(value: arb) -> float:
    """Return a lower bound of a ball, rounded down."""
    low = float(value.lower())
    return low if arb(low) <= value.lower() else nextafter(low, -inf)
