"""Invariant curves around elliptic points by Moser's twist theorem, and zeros of the twist.

Theorem (Moser 1962; Siegel and Moser, sections 32-34): an area-preserving analytic map with an
elliptic fixed point, lambda^j != 1 for j = 1 ... 4 and twist tau_1 != 0 has invariant closed curves
around the point in each of its neighbourhoods, and the point is stable for all time. The curves
fill a set of positive area (Lazutkin 1973; Poschel 1982). The map is analytic near the point
because the enclosure of the orbit shows that the first root of each flight is simple.

tau_1 depends continuously on the energy, so it has a zero between two energies at which its signs
differ. docs/proofs.md says what follows if tau_2 < 0 there.
"""

from fractions import Fraction

from flint import ctx

from ..enclosure.surface import Surface, ball_of
from . import birkhoff, periodic
from .certificate import Certificate, Finding, NotProvedError, lowest

CLOSE = Fraction(1, 10**9)  # largest relative distance of a certificate's twist from the true one


def check(text: str, surface: Surface, **bounds) -> Finding:
    """Prove that the twist of a certificate's elliptic orbit is the stated one, and not zero.

    The bounds are those of `periodic.prove_stated`. Returns a Finding with digits twist, in radians
    per unit of the action, and trace; margins twist and nonresonance; parts orbit, an Orbit. Raises
    NotProvedError.

    References
    ----------
    Moser, Nachr. Akad. Wiss. Goettingen (1962); Siegel and Moser, Lectures on Celestial Mechanics,
    sections 32-34.
    """
    with ctx.workprec(periodic.BITS):
        certificate = Certificate(text, "twist")
        certificate.check_surface(surface)
        orbit = periodic.prove_stated(certificate, surface, type="elliptic", **bounds)
        form = birkhoff.normal_form(surface, orbit)
        (twist,) = form.twists
        stated = certificate.number("twist")
        if not abs(twist - ball_of(stated)) < ball_of(CLOSE * abs(stated)):
            raise NotProvedError(f"the twist is not the stated {float(stated):.10g}")
        if not abs(twist) > 0:
            raise NotProvedError("the twist may be zero")
        digits = {"twist": twist, "trace": orbit.trace}
        margins = {"twist": lowest(abs(twist)), "nonresonance": lowest(form.nonresonance)}
        return Finding(digits, margins, {"orbit": orbit})


def check_zero(
    text: str, k: Fraction, g: Fraction, *, radius: Fraction, width: Fraction
) -> Finding:
    """Prove that the fixed point's twist changes from positive to negative in a band of energies.

    The fixed point must be the only one within the radius, and `width` is the largest width of the
    certificate's band. Returns a Finding with digits energy (the band) and second twist (over the
    band); margins twist, at the two ends, second twist and nonresonance. Raises NotProvedError.

    References
    ----------
    Dullin, Meiss and Sterling, Generic twistless bifurcations, Nonlinearity 13 (2000).
    """
    with ctx.workprec(periodic.BITS):
        certificate = Certificate(text, "zero of the twist")
        low = certificate.surface(k, g)
        band = certificate.number("width")
        if not 0 < band <= width:
            raise NotProvedError(
                f"the band is {float(band):g} wide, not {float(width):g} as stated"
            )
        high = Surface(low.k, low.g, low.energy + band)
        between = Surface(low.k, low.g, low.energy, band)
        orbit = periodic.prove_stated(certificate, low, period=1, type="elliptic", radius=radius)
        centres = certificate.numbers("points", 2)
        orbits = [(low, orbit)]
        orbits += [(s, periodic.prove(s, centres, orbit.radius)) for s in (high, between)]
        forms = [birkhoff.normal_form(*pair, order=5) for pair in orbits]
        (before, _), (after, _), (_, second) = (form.twists for form in forms)
        if not (before > 0 and after < 0):
            raise NotProvedError("the twist is not proved to fall through zero in the band")
        if not second < 0:
            raise NotProvedError("the second twist is not proved to be negative in the band")
        digits = {"energy": between.constants()[2], "second twist": second}
        margins = {
            "twist": min(lowest(before), lowest(-after)),
            "second twist": lowest(-second),
            "nonresonance": lowest(forms[2].nonresonance),
        }
        return Finding(digits, margins)
