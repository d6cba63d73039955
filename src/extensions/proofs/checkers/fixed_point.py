"""The fixed point at all energies, from its closed form: one, elliptic, resonant, unstable.

The trace is that of the impact map's Jacobian at the fixed point on y = 0. With theta half the time
of flight, L = 1/theta - cot(theta) and Q = 2 theta - sin(2 theta),

    E = (g^2/2k) ((1+k) theta^2 + (theta L)^2 - 1),
    trace/2 = (1 + k cos(2 theta))/(1+k) - k L Q/(1+k)^2.

`energy_at`, `trace_at` and `slope_at` raise NotProvedError unless 0 < theta < pi is proved.
theory/orbits.md, births.md and unstable.md derive the formulas and have the arguments.
"""

from fractions import Fraction
from itertools import pairwise

from flint import arb, ctx

from pseudorigid.verified.flight import NotProvedError

from ..enclosure.jets import Jet, Real, algebra
from ..enclosure.surface import Surface, ball_of, fraction_of
from .certificate import Certificate, Finding, Range, check_stated, check_within, lower_bound
from .periodic import BITS, CLOSE, Orbit, prove
from .twist import complex_map, normal_form, resonant_coefficients

_MOST_BANDS = 10_000
_RADIUS = Fraction(1, 10**8)  # of the box in which the point is proved over a band of energies
_COEFFICIENT_ERROR = Fraction(1, 10**9)  # of a certificate's |A| and |B|
_REACH = arb(2) ** -30  # of theta, on both sides of the band: there the trace falls too


def energy_at(k: arb, g: arb, theta: arb) -> arb:
    """Enclose the energy E at theta, from 0 to pi, with which it rises."""
    _check(theta)
    one_minus_theta_cot = 1 - theta * theta.cot()
    square = one_minus_theta_cot * one_minus_theta_cot
    return g * g / (2 * k) * ((1 + k) * theta * theta + square - 1)


def trace_at(k: arb, theta: Real) -> Real:
    """Enclose the trace at theta, from 0 to pi, or its Taylor series if theta is a Jet."""
    _check(theta.constant if isinstance(theta, Jet) else theta)
    sine, cosine = theta.sin_cos()
    double_sine, double_cosine = (2 * theta).sin_cos()
    shear = (1 / theta - cosine / sine) * (2 * theta - double_sine)
    return 2 * ((1 + k * double_cosine) / (1 + k) - k * shear / (1 + k) ** 2)


def slope_at(k: arb, theta: arb) -> arb:
    """Enclose the derivative of the trace by theta."""
    (jet,) = Jet.series(algebra(1, 1), theta)
    return trace_at(k, jet).coefficients[1]


def _check(theta: arb) -> None:
    """Raise NotProvedError unless theta is proved to lie between 0 and pi."""
    if not (theta > 0 and theta < arb.pi()):
        raise NotProvedError("theta is not proved to lie between 0 and pi")


def check_unique(text: str, k: Fraction, g: Fraction, energy: Fraction) -> Finding:
    """Prove that the map has one fixed point at each energy from -g^2/(2k) up to a given one.

    This verifies the two inequalities of the argument in theory/orbits.md.
    """
    with ctx.workprec(BITS):
        certificate = Certificate(text, "only fixed point", ball=(k, g))
        certificate.check("energy_up_to", energy)
        theta = certificate.number("theta_below")
        square = (2 * k * energy / (g * g) + 1) / (1 + k)  # theta^2 is at most this
        if not (theta - Fraction(1, 100)) ** 2 < square <= theta**2:
            raise NotProvedError("theta is not proved to be below the stated one")
        below_limit = 3 * arb.pi() / 2 - ball_of(theta)
        if not (below_limit > 0 and theta * k < 2):
            raise NotProvedError("a second fixed point is not excluded")
        margins = {"theta": below_limit, "earlier": ball_of(2 - theta * k)}
        return Finding(
            {"energies up to": ball_of(energy)},
            {name: lower_bound(margin) for name, margin in margins.items()},
        )


def check_elliptic(
    text: str, k: Fraction, g: Fraction, energy: Fraction, trace: Fraction
) -> Finding:
    """Prove that the fixed point is elliptic at all energies from -g^2/(2k) up to a given one.

    As the energy rises, the trace falls strictly from its limit 2, and at `energy` it is above
    `trace`. Each term of the trace's derivative by theta is negative for theta <= pi/2; from there
    to the theta of `energy` the derivative is enclosed over bands. The certificate `text` encloses
    this theta and states the number of bands.
    """
    with ctx.workprec(BITS):
        certificate = Certificate(text, "elliptic fixed point", ball=(k, g))
        certificate.check("energy_up_to", energy)
        stated = certificate.at_least("trace_above", trace)
        inertia, gravity = ball_of(k), ball_of(g)
        ends = _theta_ends(certificate)
        below, above = (energy_at(inertia, gravity, end) for end in ends)
        if not below < ball_of(energy) < above:
            raise NotProvedError("theta is not the one of the highest energy")
        theta = ends[0].union(ends[1])
        last = trace_at(inertia, theta)
        above_stated = last - ball_of(stated)
        if not (above_stated > 0 and last > -2):
            raise NotProvedError(f"the trace is not proved to be above {float(stated):g}")
        slope = _prove_falling_trace(inertia, theta.upper(), certificate.whole("bands"))
        turns = (last / 2).acos() / (2 * arb.pi())
        digits = {"energies up to": ball_of(energy), "trace": last, "rotation number": turns}
        margins = {"trace": lower_bound(above_stated), "elliptic": lower_bound(last + 2)}
        return Finding(digits, {"slope": slope} | margins)


def _prove_falling_trace(k: arb, end: arb, bands: int) -> float:
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


def check_resonance(
    text: str, k: Fraction, g: Fraction, *, rotation: Fraction, period: int, energies: Range
) -> Finding:
    """Prove that the fixed point passes a resonance with positive twist, at one energy.

    There its rotation number is `rotation`, below 1/2, and rises with the energy, which lies in
    `energies`, a range of those with theta <= pi/2, where the trace falls. Two orbits of this
    period, even and at least 6, branch off to higher energies.
    """
    # of even period one of the two orbits meets y = 0; lambda and its conjugate have one trace
    if not (rotation.denominator == period >= 5 and period % 2 == 0 and 0 < rotation < 1 / 2):
        raise NotProvedError(f"no two orbits of period {period} branch off at {rotation}")
    with ctx.workprec(BITS):
        certificate = Certificate(text, "resonance", ball=(k, g))
        inertia, gravity, _ = Surface(k, g, Fraction(0)).constants()
        ends = _theta_ends(certificate)
        wanted = 2 * (2 * arb.pi() * ball_of(rotation)).cos()
        above, below = (trace_at(inertia, end) - wanted for end in ends)
        theta = ends[0].union(ends[1])
        slope = slope_at(inertia, theta)
        if not (above > 0 and below < 0 and slope < 0):
            raise NotProvedError("the trace is not proved to fall through the resonance's")
        energy = energy_at(inertia, gravity, theta)
        if not ball_of(energies[1]) < energy_at(inertia, gravity, (arb.pi() / 2).lower()):
            raise NotProvedError("the energies go beyond theta = pi/2, up to where the trace falls")
        check_stated("event", [energy], certificate.row("event", 1), CLOSE)
        check_within("energy", energy, energies)
        band, orbit = _prove_over(k, g, energy, theta)
        form = normal_form(band, orbit)
        (twist,) = form.twists
        if not twist > 0:
            raise NotProvedError("the twist is not proved to be positive")
        margins = {"slope": -slope, "twist": twist, "nonresonance": form.nonresonance}
        return Finding(
            {"energy": energy, "x": orbit.points[0][0], "twist": twist},
            {name: lower_bound(margin) for name, margin in margins.items()},
        )


def check_unstable(
    text: str, k: Fraction, g: Fraction, *, energies: Range, margin: Fraction
) -> Finding:
    """Prove that lambda^4 = 1 at one energy between `energies`, and the fixed point unstable there.

    There P z = lambda (z + A |z|^2 z + B conj(z)^3) + ..., and |B| > |A| makes the point unstable.
    The certificate's two theta, 0 < theta < 3, are the ends of a band. Checked: the trace falls
    over all of `energies`, and through zero between the two theta; over the band's energies there
    is a fixed point, elliptic, whose flights have simple first roots; |A| and |B| are those stated
    there, and |B| - |A| is above the certificate's margin, which is at least the given one.
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
        band, orbit = _prove_over(k, g, energy, ends[0])
        a, b = map(abs, resonant_coefficients(*complex_map(band, orbit, order=3)))
        check_stated("normal form", [a, b], certificate.row("coefficients", 2), _COEFFICIENT_ERROR)
        least = certificate.at_least("margin", margin)
        if not b - a > ball_of(least):
            raise NotProvedError(f"|B| is not proved to be above |A| by {float(least):g}")
        margins = {"slope": lower_bound(-slope), "|B| - |A|": lower_bound(b - a)}
        return Finding({"energy": energy, "|A|": a, "|B|": b}, margins)


def _theta_ends(certificate: Certificate) -> list[arb]:
    """Return the ends of the certificate's interval of theta, narrow and in (0, pi)."""
    low, high = certificate.row("theta", 2)
    if not 0 < high - low <= CLOSE:
        raise NotProvedError("theta is not enclosed to 1e-30")
    ends = [ball_of(low), ball_of(high)]
    if not (ends[0] > 0 and ends[1] < arb.pi()):
        raise NotProvedError("theta is not proved to lie between 0 and pi")
    return ends


def _prove_over(k: Fraction, g: Fraction, energy: arb, theta: arb) -> tuple[Surface, Orbit]:
    """Prove the fixed point over a band around an energy's ball; theta is half its flight time."""
    bottom = fraction_of(energy.lower()) - CLOSE
    band = Surface(k, g, bottom, fraction_of(energy.upper()) + CLOSE - bottom)
    x = ball_of(g / k) * theta * theta.cot()
    return band, prove(band, [[fraction_of(x), Fraction(0)]], _RADIUS)
