"""Invariant curves around elliptic points: Moser's twist theorem, and where the twist vanishes.

Theorem (Moser 1962; Siegel and Moser, sections 32-34): an area-preserving analytic map with an
elliptic fixed point, lambda^j != 1 for j = 1 ... 4 and twist tau_1 != 0 has invariant closed curves
around the point in each of its neighbourhoods, and the point is stable for all time. The curves
fill a set of positive area (Lazutkin 1973; Poschel 1982).

The map is analytic near the point because the first root of each flight is simple, which the
enclosure of the orbit shows, and keeps dx ^ dy.

tau_1 depends continuously on the energy, so that it has zeros between two energies where its
signs differ. Let tau_1 be positive at the lower energy and E* the first zero above it, and
tau_2 < 0 in between. Then the angle -omega + tau_1 I + tau_2 I^2 by which the truncated normal form
turns has, for each E below E* in the band, its maximum on the circle I = -tau_1/(2 tau_2), which
shrinks into the point as E tends to E*: a circle without shear. That the map itself has curves
without shear is not checked: see docs/proofs.md.
"""

from fractions import Fraction

from flint import ctx

from ..enclosure.surface import Surface, ball_of
from . import birkhoff, periodic
from .certificate import Certificate, Finding, NotProvedError, lowest

CLOSE = Fraction(1, 10**9)  # relative: how near a certificate's twist must be to the true one


def check(text, surface, *, period, radius, window=None):
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
    window : ((x low, x high), (xdot low, xdot high)), optional
        Fractions: must contain one of its points; None for any orbit.

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
        orbit = periodic.stated(certificate, surface, period, "elliptic", radius, window)
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
    """Prove that the fixed point's twist changes from positive to negative in a band of energies.

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
        digits: energy, the band, and second twist, over it; margins: twist, at its two ends,
        second twist and nonresonance, over the band.

    Raises
    ------
    NotProvedError
        With the reason.

    References
    ----------
    Dullin, Meiss and Sterling, Generic twistless bifurcations, Nonlinearity 13 (2000).
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
        first = periodic.stated(certificate, low, 1, "elliptic", radius)
        centres = certificate.numbers("points", 2)
        others = [(part, periodic.prove(part, centres, first.radius)) for part in (high, between)]
        forms = [birkhoff.normal_form(*pair, order=5) for pair in ((low, first), *others)]
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
