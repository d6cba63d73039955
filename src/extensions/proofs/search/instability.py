"""The certificate of the energy at which the fixed point is unstable."""

from fractions import Fraction

from flint import ctx

from study.enclosure.surface import Surface, ball_of, fraction_of

from ..checks.birkhoff import complex_map, resonant_coefficients
from ..checks.periodic import enclose
from ..enclosure.fixed_point import energy_at, trace_at
from . import approximate_orbits
from .certificate_text import Theorem, ball_header, bisected, fixed, row
from .periodic import BITS, polished

_DECIMALS = 16  # of theta
_DIGITS = 12  # of the coefficients, of which the checker compares nine


def propose(theorem: Theorem) -> str:
    """Return a certificate of the instability at the resonance 1/4."""
    k, g = theorem.bounds["k"], theorem.bounds["g"]
    with ctx.workprec(BITS):
        ends = bisected(
            lambda theta: trace_at(ball_of(k), ball_of(theta)) > 0,
            Fraction(1), Fraction(3), _DECIMALS,
        )  # fmt: skip
        surface = Surface(k, g, fraction_of(energy_at(*map(ball_of, (k, g, ends[0])))))
        point = polished(surface, approximate_orbits.points(surface, 1, "elliptic"))
        form = resonant_coefficients(*complex_map(surface, enclose(surface, point), 3))
        theta = ", ".join(fixed(end, _DECIMALS) for end in ends)
        return (
            ball_header("instability", k, g) + f"theta = [{theta}]\n"
            f"coefficients = {row(map(abs, form), _DIGITS)}\n"
            f"margin = {float(theorem.bounds['margin']):g}\n"
        )
