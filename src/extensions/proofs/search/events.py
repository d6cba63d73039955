"""Certificates of the energies at which orbits double their period or lose an impact."""

from collections.abc import Callable, Sequence
from functools import partial

from flint import arb, ctx

from ..checkers.events import doubling, grazing
from ..checkers.newton import System, newton
from ..checkers.periodic import BITS
from .certificate_text import Theorem, ball_header, row
from .periodic import DIGITS, with_largest_radius

_STEPS = 9  # of Newton's method from doubles


def propose_doubling(theorem: Theorem, near: Sequence[str]) -> str:
    """Return a certificate of a period doubling near an energy and a position."""
    return _propose("period doubling", theorem, near, doubling, "period")


def propose_grazing(theorem: Theorem, near: Sequence[str]) -> str:
    """Return a certificate of a grazing orbit near an energy and perhaps a y."""
    return _propose("grazing orbit", theorem, near, grazing, "halves")


def _propose(
    kind: str, theorem: Theorem, near: Sequence[str], equations: Callable, bound: str
) -> str:
    """Return a certificate of an event with the largest radius that the checker accepts."""
    k, g = theorem.bounds["k"], theorem.bounds["g"]
    system: System = partial(equations, k, g, **{bound: theorem.bounds[bound]})
    with ctx.workprec(BITS):
        values = [arb(value) for value in near]
        for _ in range(_STEPS):
            values = [value.mid() for value in newton(system, values)]
        event = f"event = {row(values, DIGITS)}\n"
    return with_largest_radius(theorem, ball_header(kind, k, g) + event)
