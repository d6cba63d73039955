"""Certificates of the fixed point's trace over all energies."""

from collections.abc import Callable
from fractions import Fraction

from flint import arb, ctx

from study.enclosure.surface import ball_of, fraction_of

from ..checks.periodic import BITS
from ..enclosure.fixed_point import energy_at
from .certificate_text import ball_header, fixed

_DECIMALS = 38  # of theta
_BANDS = 64  # of theta, on each of which the checker encloses the slope of the trace


def propose(theorem) -> str:
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
    """Return the theta, from 0 to pi, up to which a condition holds, and a certificate's field."""
    low, high = arb(0), arb.pi()
    for _ in range(BITS - 8):
        middle = ((low + high) / 2).mid()
        low, high = (middle, high) if is_below(middle) else (low, middle)
    unit = Fraction(1, 10**_DECIMALS)
    ends = ", ".join(fixed(fraction_of(low) + sign * unit, _DECIMALS) for sign in (-1, 1))
    return low, f"theta = [{ends}]\n"
