"""Certificates of the energies at which orbits are born, double their period, or lose an impact."""

from collections.abc import Callable, Sequence
from fractions import Fraction

from flint import arb, ctx

from ..checks.events import System, doubling, grazing, newton
from ..checks.periodic import BITS
from ..enclosure.fixed_point import energy_at, trace_at
from ..enclosure.surface import ball_of
from .certificate_text import row
from .periodic import DIGITS, with_largest_radius

_STEPS = 9  # of Newton's method from doubles
_THETA_DIGITS = 40


def propose_resonance(k: Fraction, g: Fraction, *, rotation: Fraction, **_: object) -> str:
    """Return a certificate of the fixed point's resonance at a rotation number."""
    with ctx.workprec(BITS):
        wanted = 2 * (2 * arb.pi() * ball_of(rotation)).cos()
        low, high = arb(0), arb.pi()
        for _step in range(BITS - 8):
            middle = ((low + high) / 2).mid()
            low, high = (middle, high) if trace_at(ball_of(k), middle) > wanted else (low, middle)
        digits = low.str(_THETA_DIGITS, radius=False)
        energy = row([energy_at(ball_of(k), ball_of(g), low)], DIGITS)
    unit = Fraction(1, 10 ** (_THETA_DIGITS - 2))
    ends = ", ".join(_decimal(Fraction(digits) + sign * unit) for sign in (-1, 1))
    return _header("resonance", k, g) + f"event = {energy}\ntheta = [{ends}]\n"


def propose_doubling(
    near: Sequence[str], holds: Callable[[str], bool], k: Fraction, g: Fraction, *,
    period: int, line: int, **_: object,
) -> str:  # fmt: skip
    """Return a certificate of a period doubling near an energy and a position.

    Its radius is the largest for which the checker `holds` accepts the text.
    """
    return _propose("period doubling", near, holds, k, g, lambda v: doubling(k, g, v, period, line))


def propose_grazing(
    near: Sequence[str], holds: Callable[[str], bool], k: Fraction, g: Fraction, *,
    halves: tuple, **_: object,
) -> str:  # fmt: skip
    """Return a certificate of a grazing orbit near an energy and perhaps a y.

    Its radius is the largest for which the checker `holds` accepts the text.
    """
    return _propose("grazing orbit", near, holds, k, g, lambda v: grazing(k, g, v, halves))


def _propose(
    kind: str, near: Sequence[str], holds: Callable[[str], bool], k: Fraction, g: Fraction,
    system: System,
) -> str:  # fmt: skip
    with ctx.workprec(BITS):
        values = [arb(value) for value in near]
        for _ in range(_STEPS):
            values = [value.mid() for value in newton(system, values)]
        event = f"event = {row(values, DIGITS)}\n"
    return with_largest_radius(_header(kind, k, g) + event, "", holds)


def _header(kind: str, k: Fraction, g: Fraction) -> str:
    return (
        "# Proposed by a search in floating point; "
        "every number is meant as the exact decimal that it is.\n"
        f'kind = "{kind}"\nk = "{k}"\ng = "{g}"\n'
    )


def _decimal(value: Fraction) -> str:
    """Format a number between 0 and 10 with all its digits."""
    digits = str(value.numerator * 10**_THETA_DIGITS // value.denominator).zfill(_THETA_DIGITS + 1)
    return f"{digits[0]}.{digits[1:]}".rstrip("0")
