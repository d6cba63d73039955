"""Birkhoff's normal form of an area-preserving map at an elliptic fixed point.

In z = q + i p, dx ^ dy = dq ^ dp, the map is z -> lambda z + ..., lambda = exp(-i omega) with
0 < omega < pi if y pushes x forward (DP[0, 1] > 0): it turns clockwise. A change of variables
z + sum h_ij z^i conj(z)^j, degree by degree, leaves only the terms that commute with rotations:

    z -> lambda z exp(i (tau_1 I + tau_2 I^2 + ...)),   I = |z|^2/2,

if lambda^j != 1 for j up to the order plus one. tau_1 is the twist: by how much the angle of
rotation grows with the action I (Siegel and Moser, Lectures on Celestial Mechanics, sections 23
and 31): counted as a positive number of turns, omega - tau_1 I, the rotation falls with I where
tau_1 > 0. tau_2 depends on how the changes of variables are chosen, but not where tau_1 = 0.
"""

from dataclasses import dataclass

from flint import acb, arb

from ..enclosure.flight import UndecidedError
from ..enclosure.jets import Jet, algebra
from .certificate import NotProvedError

I = acb(0, 1)  # noqa: E741


@dataclass(frozen=True)
class NormalForm:
    """Birkhoff's normal form at an elliptic orbit.

    Attributes
    ----------
    multiplier : acb
        lambda, on the unit circle.
    twists : tuple of arb
        tau_1, tau_2, ..., up to the order.
    nonresonance : arb
        The least |lambda^j - 1|, j up to the order + 1.
    """

    multiplier: acb
    twists: tuple
    nonresonance: arb


def normal_form(surface, orbit, order=3):
    """The normal form of P^n at the first point of an elliptic orbit.

    Parameters
    ----------
    surface : Surface
    orbit : checks.periodic.Orbit
        Of n points.
    order : int
        Of the map's jet: 3 gives tau_1, 5 also tau_2.

    Returns
    -------
    NormalForm

    Raises
    ------
    NotProvedError
        Where the point may not be elliptic, a power of the multiplier may be 1, the form drifts,
        or a flight from the orbit's boxes may touch the floor earlier.

    References
    ----------
    Siegel and Moser, Lectures on Celestial Mechanics, sections 23 and 31.
    """
    plane = algebra(2, order)
    x, y = (Jet.variable(plane, i, value) for i, value in enumerate(orbit.points[0]))
    try:
        for _ in orbit.points:
            image = surface.impact(x, y)
            x, y = image.x, image.y
    except UndecidedError as error:
        raise NotProvedError(f"a flight from the orbit: {error}") from None
    rotation, map_ = _complex(x, y, orbit.matrix)
    powers = [rotation]
    while len(powers) < order + 1:
        powers.append(powers[-1] * rotation)
    gaps = [abs(power - 1) for power in powers]
    if not all(gap > 0 for gap in gaps):
        raise NotProvedError(f"a power of the multiplier up to {order + 1} may be 1")
    twists = _twists(rotation, map_, order)
    return NormalForm(rotation, twists, min(gaps, key=lambda gap: gap.lower()))


def _complex(x, y, matrix):
    """lambda, and the map's jet in z and conj(z)."""
    plane = x.algebra
    (a, b), cosine = matrix.table()[0], (matrix[0, 0] + matrix[1, 1]) / 2
    if not (abs(cosine) < 1 and abs(b) > 0):
        raise NotProvedError("the point is not proved to be elliptic")
    sine = (1 - cosine * cosine).sqrt() * (1 if b > 0 else -1)
    beta = (b / sine).sqrt()
    delta = beta * (cosine - a) / b
    z, conjugate = (Jet.variable(plane, i, acb(0)) for i in (0, 1))
    q, p = (z + conjugate) * acb(0.5), (z - conjugate) * (acb(0.5) / I)
    place = (q * acb(beta), q * acb(delta) + p * acb(1 / beta))
    rest = [Jet(plane, [acb(0), *(acb(c) for c in jet.coefficients[1:])]) for jet in (x, y)]
    x, y = (jet.at(*place) for jet in rest)
    map_ = x * (1 / beta - I * delta) + y * (I * beta)
    rotation = acb(cosine, -sine)
    map_.coefficients[1:3] = [rotation, acb(0)]  # as they are by the choice of q and p
    return rotation, map_


def _conjugate(jet):
    """The conjugate of a jet in z and conj(z)."""
    return Jet(jet.algebra, [jet[j, i].conjugate() for i, j in jet.algebra.monomials])


def _twists(rotation, map_, order):
    plane = map_.algebra
    change = Jet.variable(plane, 0, acb(0))
    normal = change * rotation
    back = rotation.conjugate()
    twists = []
    for degree in range(2, order + 1):
        rest = map_.at(change, _conjugate(change)) - change.at(normal, _conjugate(normal))
        for place, (i, j) in enumerate(plane.monomials):
            if i + j != degree:
                continue
            if i == j + 1:
                normal.coefficients[place] = rest.coefficients[place]
                twists.append(rest.coefficients[place] * back)
            else:
                divisor = rotation**i * back**j - rotation
                change.coefficients[place] = rest.coefficients[place] / divisor
    values = []
    for n, term in enumerate(twists, 1):  # of exp(i tau_1 I + ...), in |z|^2 = 2 I
        drift = term.real if n == 1 else term.real + values[0] ** 2 / 8
        if not drift.contains(0):
            raise NotProvedError("the normal form drifts: the map does not keep area")
        values.append(term.imag * 2**n)
    return tuple(values)
