"""Certificates of the fixed point at all energies, from its closed form."""

from collections.abc import Callable
from fractions import Fraction
from math import ceil, sqrt

from flint import arb, ctx

from ..checkers.fixed_point import energy_at, trace_at
from ..checkers.periodic import BITS, enclose
from ..checkers.twist import complex_map, resonant_coefficients
from ..enclosure.surface import Surface, ball_of, fraction_of
from .certificate_text import Theorem, ball_header, bisected, fixed, row
from .periodic import DIGITS, approximate_points, polished

_DECIMALS = 38  # of theta
_BAND_DECIMALS = 16  # of theta at the ends of a band
_BELOW_PI = Fraction("3.1415926535")  # up to where theta is sought
_BANDS = 64  # of theta, on each of which the checker encloses the slope of the trace
_COEFFICIENT_DIGITS = 12  # of which the checker compares nine


def propose_unique(theorem: Theorem) -> str:
    """Return the certificate that there is one fixed point at each energy up to the theorem's."""
    k, g, energy = (theorem.bounds[name] for name in ("k", "g", "energy"))
    theta = ceil(100 * sqrt((2 * k * energy / g**2 + 1) / (1 + k))) / 100
    fields = f'energy_up_to = "{energy}"\ntheta_below = {theta}\n'
    return ball_header("only fixed point", k, g) + fields


def propose_elliptic(theorem: Theorem) -> str:
    """Return the certificate that the fixed point is elliptic at energies up to the theorem's."""
    k, g, energy = (theorem.bounds[name] for name in ("k", "g", "energy"))
    with ctx.workprec(BITS):
        _, theta = _bisected_theta(
            lambda it: energy_at(ball_of(k), ball_of(g), it) < ball_of(energy)
        )
    return (
        ball_header("elliptic fixed point", k, g) + f'energy_up_to = "{energy}"\n{theta}'
        f"trace_above = {float(theorem.bounds['trace']):g}\nbands = {_BANDS}\n"
    )


def _bisected_theta(is_below: Callable[[arb], bool]) -> tuple[arb, str]:
    """Return the theta up to which a condition holds, and a certificate's field around it."""
    theta, _ = bisected(lambda it: is_below(ball_of(it)), Fraction(0), _BELOW_PI, _DECIMALS + 2)
    unit = Fraction(1, 10**_DECIMALS)
    ends = ", ".join(fixed(theta + sign * unit, _DECIMALS) for sign in (-1, 1))
    return ball_of(theta), f"theta = [{ends}]\n"


def propose_resonance(theorem: Theorem) -> str:
    """Return a certificate of the fixed point's resonance at a rotation number."""
    k, g, rotation = (theorem.bounds[name] for name in ("k", "g", "rotation"))
    with ctx.workprec(BITS):
        wanted = 2 * (2 * arb.pi() * ball_of(rotation)).cos()
        theta, field = _bisected_theta(lambda it: trace_at(ball_of(k), it) > wanted)
        energy = row([energy_at(ball_of(k), ball_of(g), theta)], DIGITS)
    return ball_header("resonance", k, g) + f"event = {energy}\n{field}"


def propose_unstable(theorem: Theorem) -> str:
    """Return a certificate of the instability at the resonance 1/4."""
    k, g = theorem.bounds["k"], theorem.bounds["g"]
    with ctx.workprec(BITS):
        ends = bisected(
            lambda theta: trace_at(ball_of(k), ball_of(theta)) > 0,
            Fraction(1), _BELOW_PI, _BAND_DECIMALS,
        )  # fmt: skip
        surface = Surface(k, g, fraction_of(energy_at(*map(ball_of, (k, g, ends[0])))))
        point = polished(surface, approximate_points(surface, 1, "elliptic"))
        form = resonant_coefficients(*complex_map(surface, enclose(surface, point), 3))
        theta = ", ".join(fixed(end, _BAND_DECIMALS) for end in ends)
        return (
            ball_header("instability", k, g) + f"theta = [{theta}]\n"
            f"coefficients = {row(map(abs, form), _COEFFICIENT_DIGITS)}\n"
            f"margin = {float(theorem.bounds['margin']):g}\n"
        )
