"""Invariant curves around elliptic points: Moser's twist theorem, and where the twist vanishes.

Theorem (Moser 1962; Siegel and Moser, sections 32-34): an area-preserving analytic map with an
elliptic fixed point, lambda^j != 1 for j = 1 ... 4 and twist tau_1 != 0 has invariant closed curves
around the point in each of its neighbourhoods. They fill a set of positive area, and the point is
stable for all time.

The map is analytic near the point because the first root of each flight is simple, which the
enclosure of the orbit shows, and keeps dx ^ dy.

Where tau_1 falls through zero as the energy rises while tau_2 < 0, the normal form's frequency
omega + tau_1 I + tau_2 I^2 has, just below that energy, a maximum at I = -tau_1/(2 tau_2), which
tends to 0: a curve without shear that shrinks into the point (Moeckel 1990). tau_1 depends
continuously on the energy, so that it has a zero between two energies where its signs differ.
"""

from fractions import Fraction

from flint import ctx

from ..enclosure.surface import Surface, ball_of
from . import birkhoff, periodic
from .certificate import Certificate, Finding, NotProvedError, lowest

CLOSE = Fraction(1, 10**9)  # relative: how near a certificate's twist must be to the true one


def check(text, surface, *, period, radius):
    """Prove that the twist of a certificate's elliptic orbit is the stated one, and not zero.

    Parameters
    ----------
    text : str
        The certificate.
    surface : Surface
        Whose map it is about.
    period : int
        Of the orbit.
    radius : Fraction
        It must be the only one within that, at least.

    Returns
    -------
    Finding
        digits: twist, in radians for a unit of the action, and trace; margins: twist, nonresonance;
        parts: orbit, an Orbit.

    Raises
    ------
    NotProvedError
        With the reason.

    References
    ----------
    Moser, Nachr. Akad. Wiss. Goettingen (1962); Siegel and Moser, Lectures on Celestial Mechanics,
    sections 32-34.
    """
    with ctx.workprec(periodic.BITS):
        certificate = Certificate(text, "twist")
        certificate.surface(surface)
        orbit = periodic.stated(certificate, surface, period, "elliptic", radius)
        periodic.meets(orbit, certificate)
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


def check_zero(text, k, g, *, radius, width):
    """Prove that the fixed point's twist falls through zero within a band of energies.

    Parameters
    ----------
    text : str
        The certificate.
    k, g : Fraction
        The ball.
    radius : Fraction
        The fixed point must be the only one within that, at least.
    width : Fraction
        The certificate's band of energies may be at most so wide.

    Returns
    -------
    Finding
        digits: energy, the band, and second twist; margins: twist, second twist, nonresonance.

    Raises
    ------
    NotProvedError
        With the reason.

    References
    ----------
    Moeckel, Generic bifurcations of the twist coefficient, Ergodic Theory Dynam. Systems 10 (1990).
    """
    with ctx.workprec(periodic.BITS):
        certificate = Certificate(text, "zero of the twist")
        low = certificate.any_surface(k, g)
        band = certificate.number("width")
        if not 0 < band <= width:
            raise NotProvedError(
                f"the band is {float(band):g} wide, not {float(width):g} as stated"
            )
        high = Surface(low.k, low.g, low.energy + band)
        between = Surface(low.k, low.g, low.energy, band)
        twists = []
        for part in (low, high, between):
            orbit = periodic.stated(certificate, part, 1, "elliptic", radius)
            if part is low:
                periodic.meets(orbit, certificate)
            twists.append(birkhoff.normal_form(part, orbit, order=5))
        first, last, whole = (form.twists for form in twists)
        if not (first[0] > 0 and last[0] < 0):
            raise NotProvedError("the twist is not proved to fall through zero in the band")
        if not whole[1] < 0:
            raise NotProvedError("the second twist is not proved to be negative in the band")
        digits = {"energy": between.constants()[2], "second twist": whole[1]}
        margins = {
            "twist": min(lowest(first[0]), lowest(-last[0])),
            "second twist": lowest(-whole[1]),
            "nonresonance": lowest(twists[2].nonresonance),
        }
        return Finding(digits, margins)
