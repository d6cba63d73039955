"""Certificates of the twist, and of the energy at which the fixed point's twist vanishes.

The twist is proposed by the closed formula for Birkhoff's first coefficient.
"""

from fractions import Fraction

from flint import acb, arb, arb_mat, ctx

from ..enclosure.jets import Jet, algebra
from ..enclosure.surface import Surface
from .certificate_text import decimal, decimals, header, rows
from .periodic import BITS, DIGITS, largest, polished

TWIST_DIGITS = 13  # the checker holds nine of them against the twist
ENERGY_DIGITS = 13  # decimals of the energy


def propose(surface, points, holds):
    """A certificate of the twist of an elliptic orbit.

    Parameters
    ----------
    surface : Surface
    points : sequence of (float, float)
        (x, y) near the orbit's.
    holds : callable
        Whether a checker takes a text; the radius is the largest for which it does.

    Returns
    -------
    str
    """
    with ctx.workprec(BITS):
        points = polished(surface, points)
        value = decimal(estimate(surface, points), TWIST_DIGITS)
        centres = rows("points", decimals(points, DIGITS))
    return largest(header("twist", surface) + f"twist = {value}\n" + centres, "", holds)


def propose_zero(k, g, low, high, start, holds):
    """A certificate of a zero of the fixed point's twist.

    Parameters
    ----------
    k, g : Fraction
        The ball.
    low, high : Fraction
        Energies: the twist is above zero at the first, below at the other.
    start : (float, float)
        (x, y) of the fixed point at one of these energies.
    holds : callable
        Whether a checker takes a text; the radius is the largest for which it does.

    Returns
    -------
    str
    """
    with ctx.workprec(BITS):
        surface, above, point = bisect_zero(k, g, low, high, [start])
        centre = rows("points", decimals(point, DIGITS))
    width = f"width = {float(above.energy - surface.energy):.0e}\n"
    return largest(header("zero of the twist", surface) + width + centre, "", holds)


def bisect_zero(k, g, low, high, point):
    """Two energies, ENERGY_DIGITS decimals each, between which the twist falls through zero.

    Parameters
    ----------
    k, g : Fraction
        The ball.
    low, high : Fraction
        Energies: the twist is above zero at the first, below at the other.
    point : list of (float, float)
        (x, y) of the fixed point at one of these energies.

    Returns
    -------
    low, high : Surface
    point : list of (arb, arb)
        The fixed point at the first.
    """
    unit = 10**ENERGY_DIGITS
    while high - low > Fraction(1, unit):
        middle = Fraction(round((low + high) / 2 * unit), unit)
        surface = Surface(k, g, middle)
        point = polished(surface, point)
        if estimate(surface, point) > 0:
            low = middle
        else:
            high = middle
    low = Surface(k, g, low)
    return low, Surface(k, g, high), polished(low, point)


def estimate(surface, points):
    """The twist of the first point of an orbit that is all but exact, by the closed formula.

    Parameters
    ----------
    surface : Surface
    points : sequence of (arb, arb)
        (x, y), exact.

    Returns
    -------
    arb
        tau_1 of `checks.birkhoff`, a midpoint: an estimate.
    """
    matrix = arb_mat([[1, 0], [0, 1]])
    for point in points:
        matrix = (arb_mat(surface.jacobian(*point)[0]) * matrix).mid()
    (a, b), (_, d) = matrix.table()
    cosine = ((a + d) / 2).mid()
    sine = (1 - cosine * cosine).sqrt() * (1 if b > 0 else -1)
    beta = (b / sine).sqrt().mid()
    delta = (beta * (cosine - a) / b).mid()
    plane = algebra(2, 3)
    q, p = (Jet.variable(plane, i, arb(0)) for i in (0, 1))
    (x0, y0) = points[0]
    x, y = x0 + q * beta, y0 + q * delta + p / beta
    for _ in points:
        image = surface.impact(x, y)
        x, y = image.x, image.y
    q, p = x / beta, (y - x * (delta / beta)) * beta
    pairs = zip(q.coefficients, p.coefficients, strict=True)
    map_ = Jet(plane, [acb(a.mid(), b.mid()) for a, b in pairs])
    z, bar = (Jet.variable(plane, i, acb(0)) for i in (0, 1))
    map_ = map_.at((z + bar) * acb(0.5), (z - bar) * acb(0, -0.5))  # from q and p
    g20, g11, g02, g21 = 2 * map_[2, 0], map_[1, 1], 2 * map_[0, 2], 2 * map_[2, 1]
    z, w = acb(cosine, -sine), acb(cosine, sine)
    first = (
        g20 * g11 * (w - 3 + 2 * z) / (2 * (z * z - z) * (w - 1))
        + g11 * g11.conjugate() / (1 - w)
        + g02 * g02.conjugate() / (2 * (z * z - w))
        + g21 / 2
    )
    return (2 * (w * first).imag).mid()
