"""The twist of elliptic orbits: Birkhoff's normal form of an area-preserving map.

In z = q + i p, dx ^ dy = dq ^ dp, the map is z -> lambda z + ..., lambda = exp(-i omega). If y
pushes x forward (DP[0, 1] > 0) it turns clockwise: 0 < omega < pi. A change of variables
z + sum h_ij z^i conj(z)^j, degree by degree, leaves only the terms that commute with rotations:

    z -> lambda z exp(i (tau_1 I + tau_2 I^2 + ...)),   I = |z|^2/2,

if lambda^j != 1 for j up to the order plus one (Siegel and Moser, Lectures on Celestial Mechanics,
sections 23 and 31). tau_2 depends on how the changes of variables are chosen, but not where
tau_1 = 0.

theory/twist.md has Moser's theorem. The map is analytic near an orbit because its
enclosure shows that the first root of each flight is simple. tau_1 depends continuously on the
energy, so it has a zero between two energies at which its signs differ.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import accumulate
from operator import mul
from typing import Any

from flint import acb, arb, ctx

from pseudorigid.verified.flight import NotProvedError

from ..enclosure.jets import Jet
from ..enclosure.surface import Surface
from . import periodic
from .certificate import Certificate, Finding, check_stated, lower_bound, naming
from .periodic import Orbit

I = acb(0, 1)  # noqa: E741
CLOSE = Fraction(1, 10**9)  # largest relative distance of a certificate's twist from the true one


@dataclass(frozen=True)
class NormalForm:
    """Birkhoff's normal form: tau_1, tau_2, ..., and the least |lambda^j - 1|, j <= order + 1."""

    twists: tuple[arb, ...]
    nonresonance: arb


def normal_form(surface: Surface, orbit: Orbit, order: int = 3) -> NormalForm:
    """Compute the normal form of P^n at the first of an elliptic orbit's n points.

    A jet of order 3 gives tau_1, one of order 5 also tau_2. Raises NotProvedError where the point
    may not be elliptic, a power of the multiplier may be 1, the form drifts, or a flight from the
    orbit's boxes may touch the floor earlier.
    """
    multiplier, map_ = complex_map(surface, orbit, order)
    distances = [abs(power - 1) for power in accumulate([multiplier] * (order + 1), mul)]
    if not all(distance > 0 for distance in distances):
        raise NotProvedError(f"a power of the multiplier up to {order + 1} may be 1")
    nonresonance = min(distances, key=lambda distance: distance.lower())
    normal = _normalised(multiplier, map_, order, order + 2)
    twists: list[arb] = []
    for n in range(1, (order + 1) // 2):  # of exp(i tau_1 I + ...), in |z|^2 = 2 I
        term = normal[n + 1, n] * multiplier.conjugate()
        drift = term.real if n == 1 else term.real + twists[0] ** 2 / 8
        if not drift.contains(0):
            raise NotProvedError("the normal form drifts: the map does not keep area")
        twists.append(term.imag * 2**n)
    return NormalForm(tuple(twists), nonresonance)


def complex_map(surface: Surface, orbit: Orbit, order: int) -> tuple[acb, Jet]:
    """Return lambda, and the jet of P^n in z and conj(z); the errors are those of `normal_form`."""
    x, y = Jet.plane(order, *orbit.points[0])
    with naming("a flight from the orbit"):
        for _ in orbit.points:
            x, y, *_ = surface.impact(x, y)
    (a, b), cosine = orbit.matrix.table()[0], orbit.trace / 2
    if not (abs(cosine) < 1 and abs(b) > 0):
        raise NotProvedError("the point is not proved to be elliptic")
    sine = (1 - cosine * cosine).sqrt() * (1 if b > 0 else -1)
    beta = (b / sine).sqrt()
    delta = beta * (cosine - a) / b
    z, conjugate = Jet.plane(order, acb(0), acb(0))
    q, p = (z + conjugate) * acb(0.5), (z - conjugate) * (acb(0.5) / I)
    old = (q * acb(beta), q * acb(delta) + p * acb(1 / beta))
    shifted = [Jet(z.algebra, [acb(0), *map(acb, jet.coefficients[1:])]) for jet in (x, y)]
    x, y = (jet.at(*old) for jet in shifted)
    map_ = x * (1 / beta - I * delta) + y * (I * beta)
    multiplier = acb(cosine, -sine)
    map_.coefficients[1:3] = [multiplier, acb(0)]  # exact by the choice of q and p
    return multiplier, map_


def resonant_coefficients(multiplier: acb, map_: Jet) -> tuple[acb, acb]:
    """Return A and B of z -> lambda (z + A |z|^2 z + B conj(z)^3) + ..., where lambda^4 = 1.

    The terms of second order, and the others of third, are removed. Raises NotProvedError where A
    may have a real part: then the map does not keep area.
    """
    normal = _normalised(multiplier, map_, 3, 4)
    a, b = (normal[powers] * multiplier.conjugate() for powers in ((2, 1), (0, 3)))
    if not a.real.contains(0):
        raise NotProvedError("the normal form drifts: the map does not keep area")
    return a, b


def _normalised(multiplier: acb, map_: Jet, order: int, resonance: int) -> Jet:
    """Normalise the map degree by degree; terms that commute with 1/resonance of a turn are left.

    With a resonance above order + 1 these commute with all rotations.
    """
    change, _ = Jet.plane(order, acb(0), acb(0))
    normal = change * multiplier
    inverse = multiplier.conjugate()

    def with_conjugate(jet: Jet) -> tuple[Jet, Jet]:
        return jet, Jet(jet.algebra, [jet[j, i].conjugate() for i, j in jet.algebra.monomials])

    for degree in range(2, order + 1):
        error = map_.at(*with_conjugate(change)) - change.at(*with_conjugate(normal))
        for index, (i, j) in enumerate(change.algebra.monomials):
            if i + j != degree:
                continue
            if (i - j - 1) % resonance == 0:
                normal.coefficients[index] = error.coefficients[index]
            else:
                divisor = multiplier**i * inverse**j - multiplier
                change.coefficients[index] = error.coefficients[index] / divisor
    return normal


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
        between = Surface(k, g, low.energy, certificate.at_most("width", width))
        periodic.prove_stated(certificate, low, period=1, type="elliptic", radius=radius)
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
