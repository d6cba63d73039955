"""Certificates of the fixed point's trace over all energies."""

from collections.abc import Callable
from fractions import Fraction

from flint import arb, ctx

from study.enclosure.surface import ball_of

from ..checks.periodic import BITS
from ..enclosure.fixed_point import energy_at
from .certificate_text import Theorem, ball_header, bisected, fixed

_DECIMALS = 38  # of theta
_BANDS = 64  # of theta, on each of which the checker encloses the slope of the trace


def propose(theorem: Theorem) -> str:
    """Return the certificate that the fixed point is elliptic at energies up to the theorem's."""
    k, g, energy = (theorem.bounds[name] for name in ("k", "g", "energy"))
    with ctx.workprec(BITS):
        _, theta = bisected_theta(
            lambda it: energy_at(ball_of(k), ball_of(g), it) < ball_of(energy)
        )
    return (
        ball_header("elliptic fixed point", k, g) + f'energy_up_to = "{energy}"\n{theta}'
        f"trace_above = {float(theorem.bounds['trace']):g}\nbands = {_BANDS}\n"
    )


def bisected_theta(is_below: Callable[[arb], bool]) -> tuple[arb, str]:
    """Return the theta up to which a condition holds, and a certificate's field around it."""
    theta, _ = bisected(lambda it: is_below(ball_of(it)), Fraction(0), Fraction(3), _DECIMALS + 2)
    unit = Fraction(1, 10**_DECIMALS)
    ends = ", ".join(fixed(theta + sign * unit, _DECIMALS) for sign in (-1, 1))
    return ball_of(theta), f"theta = [{ends}]\n"
