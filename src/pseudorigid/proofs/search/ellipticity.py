"""Certificates of the fixed point's trace over all energies."""

from fractions import Fraction

from flint import arb, ctx

from ..checks.periodic import BITS
from ..enclosure.fixed_point import energy_at
from ..enclosure.surface import ball_of
from .certificate_text import decimal

_DIGITS = 40  # of theta
_BANDS = 64  # of theta, on each of which the checker encloses the slope of the trace
_LAST_DIGIT = Fraction(1, 10 ** (_DIGITS - 1))


def propose(k: Fraction, g: Fraction, energy: Fraction, trace: Fraction) -> str:
    """Return the certificate that the fixed point is elliptic at energies up to this one."""
    with ctx.workprec(BITS):
        low, high = arb(0), arb.pi()
        for _ in range(BITS - 8):
            middle = ((low + high) / 2).mid()
            if energy_at(ball_of(k), ball_of(g), middle) < ball_of(energy):
                low = middle
            else:
                high = middle
        theta = Fraction(decimal(low, _DIGITS))
    ends = ", ".join(_text(theta + sign * _LAST_DIGIT) for sign in (-1, 1))
    return (
        f'kind = "elliptic fixed point"\nk = "{k}"\ng = "{g}"\nenergy_up_to = "{energy}"\n'
        f"theta = [{ends}]\ntrace_above = {float(trace):g}\nbands = {_BANDS}\n"
    )


def _text(value: Fraction) -> str:
    """Format a number between 1 and 10 with all its digits."""
    digits = str(value.numerator * 10 ** (_DIGITS - 1) // value.denominator)
    return f"{digits[0]}.{digits[1:]}"
