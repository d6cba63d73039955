"""Formatting of certificates as text."""

from collections.abc import Iterable

from flint import arb

from ..enclosure.surface import Surface

_HEADER = """\
# Proposed by a search in floating point; every number is meant as the exact decimal that it is.
kind = "{kind}"
k = "{surface.k}"
g = "{surface.g}"
energy = "{surface.energy}"
"""


def header(kind: str, surface: Surface) -> str:
    """Return the first lines of a certificate."""
    return _HEADER.format(kind=kind, surface=surface)


def decimal(value: arb, digits: int) -> str:
    """Format the midpoint of a ball with this many significant digits."""
    text = value.mid().str(digits, radius=False)
    return text if "." in text or "e" in text else text + ".0"


def decimals(values: Iterable[Iterable[arb]], digits: int) -> list[list[str]]:
    """Format the midpoints of rows of balls."""
    return [[decimal(value, digits) for value in row] for row in values]


def rows(name: str, values: Iterable[Iterable[str]]) -> str:
    """Return the field of this name, a list of rows of formatted decimals."""
    lines = "".join(f"  [{', '.join(row)}],\n" for row in values)
    return f"{name} = [\n{lines}]\n"
