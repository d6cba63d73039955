"""Ellipticity of the fixed point up to an energy, from the closed form of its trace.

README.md of this extension has the argument ("Periodic orbits"). theta is half the time of flight.
"""

from fractions import Fraction
from itertools import pairwise

from flint import arb, ctx

from study.enclosure.flight import NotProvedError
from study.enclosure.surface import ball_of

from ..enclosure.fixed_point import energy_at, slope_at, trace_at
from .certificate import Certificate, Finding, lower_bound
from .periodic import BITS, CLOSE

_MOST_BANDS = 10_000


def check(text: str, k: Fraction, g: Fraction, energy: Fraction, trace: Fraction) -> Finding:
    """Prove that the fixed point is elliptic at all energies from -g^2/(2k) up to a given one.

    As the energy rises, the trace falls strictly from its limit 2, and at `energy` it is above
    `trace`. Each term of the trace's derivative by theta is negative for theta <= pi/2; from there
    to the theta of `energy` the derivative is enclosed over bands. The certificate `text` encloses
    this theta and states the number of bands.
    """
    with ctx.workprec(BITS):
        certificate = Certificate(text, "elliptic fixed point", ball=(k, g))
        certificate.check("energy_up_to", energy)
        stated = certificate.number("trace_above")
        if not trace <= stated:
            raise NotProvedError(f"the trace is above {float(stated):g}, not {float(trace):g}")
        inertia, gravity = ball_of(k), ball_of(g)
        ends = theta_ends(certificate)
        below, above = (energy_at(inertia, gravity, end) for end in ends)
        if not below < ball_of(energy) < above:
            raise NotProvedError("theta is not the one of the highest energy")
        theta = ends[0].union(ends[1])
        last = trace_at(inertia, theta)
        room = last - ball_of(stated)
        if not (room > 0 and last > -2):
            raise NotProvedError(f"the trace is not proved to be above {float(stated):g}")
        slope = _least_fall(inertia, theta.upper(), certificate.whole("bands"))
        turns = (last / 2).acos() / (2 * arb.pi())
        digits = {"energies up to": ball_of(energy), "trace": last, "rotation number": turns}
        margins = {"slope": slope, "trace": lower_bound(room), "elliptic": lower_bound(last + 2)}
        return Finding(digits, margins)


def theta_ends(certificate: Certificate) -> list[arb]:
    """Return the ends of the certificate's interval of theta, narrow and in (0, pi)."""
    low, high = certificate.row("theta", 2)
    if not 0 < high - low <= CLOSE:
        raise NotProvedError("theta is not enclosed to 1e-30")
    ends = [ball_of(low), ball_of(high)]
    if not (ends[0] > 0 and ends[1] < arb.pi()):
        raise NotProvedError("theta is not proved to lie between 0 and pi")
    return ends


def _least_fall(k: arb, end: arb, bands: int) -> float:
    """Prove that the trace falls in theta from pi/2 to `end`; return a lower bound of -slope."""
    if not 1 <= bands <= _MOST_BANDS:
        raise NotProvedError(f"{bands} bands are not from 1 to {_MOST_BANDS}")
    start = (arb.pi() / 2).lower()
    width = (end - start).upper() / bands
    if not width > 0:
        raise NotProvedError("theta does not reach pi/2, where the bands begin")
    edges = [start + band * width for band in range(bands + 1)]
    slopes = [slope_at(k, low.union(high)) for low, high in pairwise(edges)]
    if not all(slope < 0 for slope in slopes):
        raise NotProvedError("the trace is not proved to fall on each band of theta")
    return min(lower_bound(-slope) for slope in slopes)
