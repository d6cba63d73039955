"""The fixed point is unstable at the resonance 1/4.

README.md ("Unstable at one energy") has the argument. Where lambda^4 = 1 the normal form of
third order is P z = lambda (z + A |z|^2 z + B conj(z)^3), and |B| > |A| makes the point unstable.
"""

from fractions import Fraction

from flint import arb, ctx

from study.enclosure.flight import NotProvedError
from study.enclosure.surface import ball_of

from ..enclosure.fixed_point import energy_at, slope_at, trace_at
from .birkhoff import complex_map, resonant_coefficients
from .certificate import Certificate, Finding, Range, check_stated, lower_bound
from .periodic import BITS, prove_fixed_point_over

CLOSE = Fraction(1, 10**9)  # largest distance of a certificate's coefficients from the true ones
_REACH = arb(2) ** -30  # of theta, on both sides of the band: there the trace falls too


def check(text: str, k: Fraction, g: Fraction, *, energies: Range, margin: Fraction) -> Finding:
    """Prove that lambda^4 = 1 at one energy between `energies`, and the fixed point unstable there.

    The certificate's two theta are the ends of a band. Checked: the trace falls over all of
    `energies`, and through zero between the two theta; over the band's energies there is a fixed
    point, elliptic, whose flights have simple first roots; |A| and |B| are those stated there, and
    |B| - |A| is above the certificate's margin, which is at least the given one.
    """
    with ctx.workprec(BITS):
        certificate = Certificate(text, "instability", ball=(k, g))
        theta = certificate.row("theta", 2)
        if not 0 < theta[0] < theta[1] < 3:
            raise NotProvedError("the certificate's theta do not rise from 0 to 3")
        ends = [ball_of(end) for end in theta]
        around = [ends[0] - _REACH, ends[1] + _REACH]
        slope = slope_at(ball_of(k), arb.union(*around))
        above, below = (trace_at(ball_of(k), end) for end in ends)
        if not (above > 0 > below and slope < 0):
            raise NotProvedError("the band is not proved to hold the resonance 1/4 once")
        energy = arb.union(*(energy_at(ball_of(k), ball_of(g), end) for end in ends))
        low, high = map(ball_of, energies)
        first, last = (energy_at(ball_of(k), ball_of(g), end) for end in around)
        if not first < low < energy < high < last:
            raise NotProvedError("the band is not proved to lie between the statement's energies")
        band, orbit = prove_fixed_point_over(k, g, energy, ends[0])
        a, b = map(abs, resonant_coefficients(*complex_map(band, orbit, order=3)))
        check_stated("normal form", [a, b], certificate.row("coefficients", 2), CLOSE)
        least = certificate.number("margin")
        if not least >= margin:
            raise NotProvedError(f"the margin is {float(least):g}, not {float(margin):g} as stated")
        if not b - a > ball_of(least):
            raise NotProvedError(f"|B| is not proved to be above |A| by {float(least):g}")
        margins = {"slope": lower_bound(-slope), "|B| - |A|": lower_bound(b - a)}
        return Finding({"energy": energy, "|A|": a, "|B|": b}, margins)
