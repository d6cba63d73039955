"""Certificates of the twist, and of the energy at which the fixed point's twist vanishes.

The twist is proposed by the closed formula for Birkhoff's first coefficient.
"""

from collections.abc import Sequence
from fractions import Fraction

from flint import arb, ctx

from ..checkers.periodic import enclose
from ..checkers.twist import complex_map
from ..enclosure.surface import Surface
from .certificate_text import Theorem, bisected, decimal, header
from .periodic import (
    BITS,
    approximate_points,
    centre_rows,
    points_of,
    polished,
    with_largest_radius,
)

_TWIST_DIGITS = 13  # the checker compares nine of them with the twist
_ENERGY_DECIMALS = 13


def propose(theorem: Theorem) -> str:
    """Return a certificate of the twist of an elliptic orbit, with the largest radius."""
    surface = theorem.bounds["surface"]
    with ctx.workprec(BITS):
        points = polished(surface, points_of(theorem, "elliptic"))
        value = decimal(_approximate_twist(surface, points), _TWIST_DIGITS)
        before = header("twist", surface) + f"twist = {value}\n" + centre_rows(points)
    return with_largest_radius(theorem, before)


def propose_zero(theorem: Theorem, energies: tuple[Fraction, Fraction]) -> str:
    """Return a certificate of a zero of the fixed point's twist between two energies."""
    k, g = theorem.bounds["k"], theorem.bounds["g"]
    start = approximate_points(Surface(k, g, energies[0]), 1, "elliptic")
    with ctx.workprec(BITS):
        band, point = bisect_zero(k, g, *energies, start)
        width = f"width = {float(band.width):.0e}\n"
        below = Surface(k, g, band.energy)
        before = header("zero of the twist", below) + width + centre_rows(point)
    return with_largest_radius(theorem, before)


def bisect_zero(
    k: Fraction, g: Fraction, low: Fraction, high: Fraction, point: Sequence
) -> tuple[Surface, list[list[arb]]]:
    """Find a band between two energies with 13 decimals in which the twist falls through zero.

    The twist must be positive at the energy `low` and negative at `high`; `point` has (x, y) of the
    fixed point at one of them. Returns the band, and the fixed point at its lower end.
    """

    def is_positive(energy: Fraction) -> bool:
        nonlocal point
        point = polished(Surface(k, g, energy), point)
        return _approximate_twist(Surface(k, g, energy), point) > 0

    low, high = bisected(is_positive, low, high, _ENERGY_DECIMALS)
    return Surface(k, g, low, high - low), polished(Surface(k, g, low), point)


def _approximate_twist(surface: Surface, points: Sequence) -> arb:
    """Estimate tau_1 of `checkers.twist` at the first point (x, y) of a nearly exact orbit."""
    z, map_ = complex_map(surface, enclose(surface, points), 3)
    w = z.conjugate()
    g20, g11, g02, g21 = 2 * map_[2, 0], map_[1, 1], 2 * map_[0, 2], 2 * map_[2, 1]
    first = (
        g20 * g11 * (w - 3 + 2 * z) / (2 * (z * z - z) * (w - 1))
        + g11 * g11.conjugate() / (1 - w)
        + g02 * g02.conjugate() / (2 * (z * z - w))
        + g21 / 2
    )
    return (2 * (w * first).imag).mid()
