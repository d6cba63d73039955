"""Certificates of the energies at which orbits are born, double their period, or lose an impact."""

from collections.abc import Callable, Sequence
from fractions import Fraction
from functools import partial

from flint import arb, ctx

from ..checks.events import doubling, grazing
from ..checks.newton import System, newton
from ..checks.periodic import BITS
from ..enclosure.fixed_point import energy_at, trace_at
from ..enclosure.surface import ball_of
from .certificate_text import ball_header, row
from .ellipticity import bisected_theta
from .periodic import DIGITS, with_largest_radius

_STEPS = 9  # of Newton's method from doubles


def propose_resonance(k: Fraction, g: Fraction, *, rotation: Fraction, **_: object) -> str:
    """Return a certificate of the fixed point's resonance at a rotation number."""
    with ctx.workprec(BITS):
        wanted = 2 * (2 * arb.pi() * ball_of(rotation)).cos()
        theta, field = bisected_theta(lambda it: trace_at(ball_of(k), it) > wanted)
        energy = row([energy_at(ball_of(k), ball_of(g), theta)], DIGITS)
    return ball_header("resonance", k, g) + f"event = {energy}\n{field}"


def propose_doubling(
    near: Sequence[str], holds: Callable[[str], bool], k: Fraction, g: Fraction, *,
    period: int, **_: object,
) -> str:  # fmt: skip
    """Return a certificate of a period doubling near an energy and a position.

    Its radius is the largest for which the checker `holds` accepts the text.
    """
    before = ball_header("period doubling", k, g)
    return _propose(before, near, holds, partial(doubling, k, g, period=period))


def propose_grazing(
    near: Sequence[str], holds: Callable[[str], bool], k: Fraction, g: Fraction, *,
    halves: tuple, **_: object,
) -> str:  # fmt: skip
    """Return a certificate of a grazing orbit near an energy and perhaps a y.

    Its radius is the largest for which the checker `holds` accepts the text.
    """
    before = ball_header("grazing orbit", k, g)
    return _propose(before, near, holds, partial(grazing, k, g, halves=halves))


def _propose(before: str, near: Sequence[str], holds: Callable, system: System) -> str:
    with ctx.workprec(BITS):
        values = [arb(value) for value in near]
        for _ in range(_STEPS):
            values = [value.mid() for value in newton(system, values)]
        event = f"event = {row(values, DIGITS)}\n"
    return with_largest_radius(before + event, "", holds)
