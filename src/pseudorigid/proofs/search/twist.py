"""Certificates of the twist, and of the energy at which the fixed point's twist vanishes.

The twist is proposed by the closed formula for Birkhoff's first coefficient.
"""

from collections.abc import Callable, Sequence
from fractions import Fraction

from flint import acb, arb, arb_mat, ctx

from ..enclosure.jets import Jet, algebra
from ..enclosure.surface import Surface
from .certificate_text import decimal, decimals, header, rows
from .periodic import BITS, DIGITS, polished, with_largest_radius

_TWIST_DIGITS = 13  # the checker compares nine of them with the twist
_ENERGY_DECIMALS = 13


def propose(surface: Surface, points: Sequence, holds: Callable[[str], bool]) -> str:
    """Return a certificate of the twist of an elliptic orbit near points (x, y).

    Its radius is the largest for which the checker `holds` accepts the text.
    """
    with ctx.workprec(BITS):
        points = polished(surface, points)
        value = decimal(estimate(surface, points), _TWIST_DIGITS)
        centres = rows("points", decimals(points, DIGITS))
    before = header("twist", surface) + f"twist = {value}\n" + centres
    return with_largest_radius(before, "", holds)


def propose_zero(
    k: Fraction, g: Fraction, low: Fraction, high: Fraction, start: tuple[float, float], holds
) -> str:
    """Return a certificate of a zero of the fixed point's twist, between two energies.

    `start` is (x, y) of the fixed point at one of them. The radius is the largest for which the
    checker `holds` accepts the text.
    """
    with ctx.workprec(BITS):
        surface, above, point = bisect_zero(k, g, low, high, [start])
        centre = rows("points", decimals(point, DIGITS))
    width = f"width = {float(above.energy - surface.energy):.0e}\n"
    before = header("zero of the twist", surface) + width + centre
    return with_largest_radius(before, "", holds)


def bisect_zero(
    k: Fraction, g: Fraction, low: Fraction, high: Fraction, point: Sequence
) -> tuple[Surface, Surface, list[list[arb]]]:
    """Find two energies with 13 decimals between which the twist falls through zero.

    It must be positive at the energy `low` and negative at `high`; `point` has (x, y) of the fixed
    point at one of them. Returns the two surfaces, and the fixed point at the first.
    """
    unit = 10**_ENERGY_DECIMALS
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


def estimate(surface: Surface, points: Sequence) -> arb:
    """Estimate tau_1 of `checks.birkhoff` at the first point of a nearly exact orbit.

    The closed formula is applied to midpoints (x, y).
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
        x, y, *_ = surface.impact(x, y)
    q, p = x / beta, (y - x * (delta / beta)) * beta
    pairs = zip(q.coefficients, p.coefficients, strict=True)
    map_ = Jet(plane, [acb(a.mid(), b.mid()) for a, b in pairs])
    z, conjugate = (Jet.variable(plane, i, acb(0)) for i in (0, 1))
    map_ = map_.at((z + conjugate) * acb(0.5), (z - conjugate) * acb(0, -0.5))  # from q and p
    g20, g11, g02, g21 = 2 * map_[2, 0], map_[1, 1], 2 * map_[0, 2], 2 * map_[2, 1]
    z, w = acb(cosine, -sine), acb(cosine, sine)
    first = (
        g20 * g11 * (w - 3 + 2 * z) / (2 * (z * z - z) * (w - 1))
        + g11 * g11.conjugate() / (1 - w)
        + g02 * g02.conjugate() / (2 * (z * z - w))
        + g21 / 2
    )
    return (2 * (w * first).imag).mid()
