"""Decimals of certificates, their formatting as text, and the theorem that one is to prove."""

from collections.abc import Callable, Iterable
from fractions import Fraction
from typing import Any, Protocol

from flint import arb

from ..checkers.certificate import Finding
from ..enclosure.surface import Surface


class Theorem(Protocol):
    """What a search uses of a `theorems.statements.Theorem`."""

    @property
    def bounds(self) -> dict[str, Any]: ...
    def prove(self, text: str) -> Finding: ...
    def holds_for_any_radius(self, text: str) -> bool: ...


def header(kind: str, surface: Surface) -> str:
    """Return the first lines of a certificate at one energy."""
    return ball_header(kind, surface.k, surface.g) + f'energy = "{surface.energy}"\n'


def ball_header(kind: str, k: Fraction, g: Fraction) -> str:
    """Return the first lines of a certificate at more than one energy."""
    return (
        "# Proposed by a search in floating point; "
        "every number is meant as the exact decimal that it is.\n"
        f'kind = "{kind}"\nk = "{k}"\ng = "{g}"\n'
    )


def decimal(value: arb, digits: int) -> str:
    """Format the midpoint of a ball with this many significant digits."""
    text = value.mid().str(digits, radius=False)
    return text if "." in text or "e" in text else text + ".0"


def fixed(value: Fraction, decimals: int) -> str:
    """Format a number with this many decimals."""
    return f"{round(value * 10**decimals)}e-{decimals}"


def bisected(
    is_positive: Callable[[Fraction], bool], low: Fraction, high: Fraction, decimals: int
) -> tuple[Fraction, Fraction]:
    """Return neighbouring decimals, of so many, between which a function falls through zero."""
    unit = 10**decimals
    while high - low > Fraction(1, unit):
        middle = Fraction(round((low + high) / 2 * unit), unit)
        low, high = (middle, high) if is_positive(middle) else (low, middle)
    return low, high


def row(values: Iterable[arb], digits: int) -> str:
    """Format the midpoints of balls as a row of decimals."""
    return f"[{', '.join(decimal(value, digits) for value in values)}]"


def rows(name: str, lines: Iterable[str]) -> str:
    """Return the field of this name, a list of formatted rows."""
    return f"{name} = [\n" + "".join(f"  {line},\n" for line in lines) + "]\n"
