"""Invariant curves around elliptic points by Moser's twist theorem, and zeros of the twist.

README.md has the theorem ("Invariant curves"). The map is analytic near an orbit because its
enclosure shows that the first root of each flight is simple. tau_1 depends continuously on the
energy, so it has a zero between two energies at which its signs differ.
"""

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from flint import ctx

from study.enclosure.flight import NotProvedError
from study.enclosure.surface import Surface

from . import periodic
from .birkhoff import NormalForm, normal_form
from .certificate import Certificate, Finding, check_stated, lower_bound

CLOSE = Fraction(1, 10**9)  # largest relative distance of a certificate's twist from the true one


def check(text: str, surface: Surface, **bounds: Any) -> Finding:
    """Prove that the twist of a certificate's elliptic orbit is the stated one, and not zero.

    The bounds are those of `periodic.prove_stated`. The twist is in radians per unit of the action
    (Siegel and Moser, Lectures on Celestial Mechanics, sections 32-34).
    """
    with ctx.workprec(periodic.BITS):
        certificate = Certificate(text, "twist", surface)
        orbit = periodic.prove_stated(certificate, surface, type="elliptic", **bounds)
        form = normal_form(surface, orbit)
        (twist,) = form.twists
        stated = certificate.number("twist")
        check_stated("twist", [twist], [stated], CLOSE * abs(stated))
        if not abs(twist) > 0:
            raise NotProvedError("the twist may be zero")
        margins = {"twist": lower_bound(abs(twist)), "nonresonance": lower_bound(form.nonresonance)}
        return Finding({"twist": twist, "trace": orbit.trace}, margins)


def check_zero(
    text: str, k: Fraction, g: Fraction, *, radius: Fraction, width: Fraction
) -> Finding:
    """Prove that the fixed point's twist changes from positive to negative in a band of energies.

    The fixed point must be the only one within the radius, and `width` is the largest width of the
    certificate's band. The digits are the band, and the second twist over it (Dullin, Meiss and
    Sterling, Generic twistless bifurcations, Nonlinearity 13, 2000).
    """
    with ctx.workprec(periodic.BITS):
        certificate = Certificate(text, "zero of the twist")
        low = certificate.surface((k, g))
        band = certificate.number("width")
        if not 0 < band <= width:
            raise NotProvedError(
                f"the band is {float(band):g} wide, not {float(width):g} as stated"
            )
        periodic.prove_stated(certificate, low, period=1, type="elliptic", radius=radius)
        between = Surface(k, g, low.energy, band)
        centres = certificate.numbers("points", 2)
        forms = falling_twist(between, centres, certificate.number("radius"), order=5)
        second = forms[2].twists[1]
        if not second < 0:
            raise NotProvedError("the second twist is not proved to be negative in the band")
        margins = {
            "twist": min(lower_bound(forms[0].twists[0]), lower_bound(-forms[1].twists[0])),
            "second twist": lower_bound(-second),
            "nonresonance": lower_bound(forms[2].nonresonance),
        }
        return Finding({"energy": between.constants()[2], "second twist": second}, margins)


def falling_twist(
    band: Surface, centres: Sequence[Sequence[Fraction]], radius: Fraction, order: int
) -> list[NormalForm]:
    """Prove that a fixed point's twist is positive at a band's lower end, negative at its upper.

    Returns the normal forms at the two ends and over the whole band, so that the twist is
    continuous there. Raises NotProvedError.
    """
    ends = [Surface(band.k, band.g, energy) for energy in (band.energy, band.energy + band.width)]
    forms = [
        normal_form(surface, periodic.prove(surface, centres, radius), order)
        for surface in (*ends, band)
    ]
    if not (forms[0].twists[0] > 0 and forms[1].twists[0] < 0):
        raise NotProvedError("the twist is not proved to fall through zero in the band")
    return forms
