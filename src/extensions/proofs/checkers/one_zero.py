"""The sign of the fixed point's twist at all energies from the least to eq. (31).

theory/twist.md ("One zero of the twist") has the argument. In theta, half the flight time of the
fixed point, everything is explicit, so that no flight has to be searched. In the coordinates
x = x_0(theta) + theta xi, y = theta eta the map is

    P = id + theta V(xi, eta; theta),

and V is analytic at theta = 0 too, where the section shrinks to a point. So theta tau_1 is enclosed
over bands of theta that begin at 0.
"""

from collections.abc import Sequence
from fractions import Fraction
from functools import cache
from itertools import pairwise
from math import comb, factorial
from typing import NamedTuple

from flint import arb, ctx

from pseudorigid.verified.flight import NotProvedError

from ..enclosure.jets import Jet, algebra
from ..enclosure.surface import ball_of
from .certificate import Certificate, Finding, Range, lower_bound, naming
from .fixed_point import energy_at

BITS = 128
MOST_BANDS = 1000
_ORDER = 3  # of the map's series in xi and eta
_PARAMETER_ORDER = 5  # of the remainder of its Taylor polynomials in theta
_SERIES_TERMS = 60  # of a power series, at arguments below 5
_EXTRA_ORDERS = 8  # orders of its Taylor polynomial over a ball, beyond those of a jet

ZEROS = "zero", "resonance"  # fields of BandEnclosure that vanish at one energy each
Field = dict[tuple[int, int], Jet]  # powers of xi and eta -> coefficient, a series in theta


class Enclosed(NamedTuple):
    """A function of theta over a band: its values and its derivatives."""

    value: arb
    slope: arb


class BandEnclosure(NamedTuple):
    """Enclosures over a band; third is theta^2 (3 cot^2(omega/2) - 1)."""

    resonance: Enclosed  # cos(omega), zero where lambda^4 = 1
    zero: Enclosed  # theta tau_1
    third: arb


def check(
    text: str, k: Fraction, g: Fraction, *, energy: Fraction, zero: Range, resonance: Range
) -> Finding:
    """Prove that the fixed point's twist has one zero between the least energy and a given one.

    At all of these energies the fixed point must be elliptic, and lambda^j not be 1 for j <= 3;
    lambda^4 = 1 must hold at one of them only. `zero` and `resonance` are bounds of the two
    energies. The certificate has the edges of the bands, and bounds of theta at the two energies.
    """
    with ctx.workprec(BITS):
        certificate = Certificate(text, "one zero of the twist", ball=(k, g))
        certificate.check("energy_up_to", energy)
        edges = [theta for (theta,) in certificate.numbers("edges", 1)]
        _check_edges(k, g, edges, energy)
        digits = {"energies up to": ball_of(energy)}
        if not max(zero[1], resonance[1]) <= energy:
            raise NotProvedError("the bands do not reach the statement's zero and resonance")
        for name, bounds in (("zero", zero), ("resonance", resonance)):
            digits[name] = _energy_of(certificate.row(name, 2), k, g, bounds, name)
        bands = [over_band(k, g, *ends) for ends in pairwise(edges)]
        margins = {"third resonance": min(lower_bound(band.third) for band in bands)}
        for name in ZEROS:
            margins[name] = margin_of_one_zero([getattr(band, name) for band in bands], name)
        return Finding(digits, margins)


def over_band(k: Fraction, g: Fraction, low: Fraction, high: Fraction) -> BandEnclosure:
    """Enclose cos(omega) and theta tau_1 over a band, each with its derivative in theta.

    By the mean value theorem each is its value at the middle plus the derivative over the band
    times the distance. The field `third` is positive where omega < 2 pi/3. Raises NotProvedError
    where that or ellipticity is not proved, and for bands that do not lie in 0 <= theta < 2.5.
    """
    if not 0 <= low <= high:
        raise NotProvedError(f"theta from {float(low):g} to {float(high):g} is no band")
    band = ball_of(low).union(ball_of(high))
    middle = band.mid()
    with naming(f"theta from {float(low):g} to {float(high):g}"):
        fields = _fields(ball_of(k), ball_of(g), band)
        cosine, twist, third = _cosine_and_twist(fields[0], band)
        cosine_at, twist_at, _ = _cosine_and_twist(fields[1], middle)

    def narrowed(over: Jet, at: Jet) -> Enclosed:
        value, slope = over.coefficients
        if not (value.is_finite() and slope.is_finite()):
            raise NotProvedError("the twist over a band is not finite")
        return Enclosed(value.intersection(at.constant + slope * (band - middle)), slope)

    return BandEnclosure(narrowed(cosine, cosine_at), narrowed(twist, twist_at), third)


def _check_edges(k: Fraction, g: Fraction, edges: list[Fraction], energy: Fraction) -> None:
    """Check that the bands begin at theta = 0 and reach the energy, below theta = pi."""
    if not 2 <= len(edges) <= MOST_BANDS + 1:
        raise NotProvedError(f"the certificate has {len(edges)} edges, not 2 to {MOST_BANDS + 1}")
    if edges[0] != 0 or not all(a < b for a, b in pairwise(edges)):
        raise NotProvedError("the bands' edges do not rise from theta = 0")
    last = ball_of(edges[-1])
    if not (last < arb.pi() and energy_at(ball_of(k), ball_of(g), last) > ball_of(energy)):
        raise NotProvedError("the bands are not proved to reach the statement's energy")


def margin_of_one_zero(functions: Sequence[Enclosed], name: str) -> float:
    """Check that a function is positive, then falls, then is negative, over neighbouring bands.

    So it has one zero over all bands together. Returns the margin.
    """
    stages, margins = [], []
    for value, slope in functions:
        if value > 0:
            stage, bound = 0, value
        elif value < 0:
            stage, bound = 2, -value
        elif slope < 0:
            stage, bound = 1, -slope
        else:
            raise NotProvedError(f"the {name} is not proved to be the only one: a band is too wide")
        stages.append(stage)
        margins.append(lower_bound(bound))
    if stages != sorted(stages) or stages[0] != 0 or stages[-1] != 2:
        raise NotProvedError(f"the {name} is not proved to be the only one: the signs differ")
    return min(margins)


def _energy_of(row: list[Fraction], k: Fraction, g: Fraction, bounds: Range, name: str) -> arb:
    """Prove that a zero lies between two theta, and its energy between the bounds."""
    low, high = row
    if not 0 < low < high < Fraction("2.5"):  # and so below pi
        raise NotProvedError(f"the certificate's {name} is no interval of theta")
    signs = [getattr(over_band(k, g, theta, theta), name).value for theta in row]
    if not signs[0] > 0 > signs[1]:
        raise NotProvedError(f"the {name} is not proved to lie between the certificate's theta")
    ends = (energy_at(ball_of(k), ball_of(g), ball_of(theta)) for theta in row)
    energy = arb.union(*ends)
    if not ball_of(bounds[0]) < energy < ball_of(bounds[1]):
        raise NotProvedError(f"the {name} is not proved to lie between the statement's energies")
    return energy


def _cosine_and_twist(field: list[Field], theta: arb) -> tuple[Jet, Jet, arb]:
    """Return cos(omega) and theta tau_1 as series in theta, and the third number of `over_band`."""
    x, y = field
    (t,) = Jet.series(x[1, 0].algebra, theta)
    cosine, push = 1 + t * x[1, 0], x[0, 1]
    square = -push * y[1, 0]  # (sin(omega)/theta)^2: the diagonal elements of DP are equal
    if not (push.constant > 0 and square.constant > 0):
        raise NotProvedError("the fixed point is not proved to be elliptic")
    sine = square.sqrt()
    cot = (1 + cosine) / sine  # theta cot(omega/2)
    third = 3 * cot * cot - t * t
    if not third.constant > 0:
        raise NotProvedError("the third power of the multiplier may be 1")
    cot_of_three = cot * (cot * cot - 3 * t * t) / third  # theta cot(3 omega/2)
    g11, g02, g21 = _quadratic_and_cubic(x, y, (push / sine).sqrt())
    twist = (3 * cot * _squared_modulus(g11) + cot_of_three * _squared_modulus(g02)) / 2
    return cosine, twist + cosine * g21[1] + t * sine * g21[0], third.constant


def _quadratic_and_cubic(x: Field, y: Field, beta: Jet) -> list[tuple[Jet, Jet]]:
    """Return g_11, g_02 and g_21 over theta, each as its real and its imaginary part.

    z = q + i p with xi = beta q and eta = p/beta, and g_ij is i! j! times the coefficient of
    z^i conj(z)^j in the map.
    """

    def scaled(i: int, j: int) -> tuple[Jet, Jet]:
        """The coefficients of q^i p^j in q and in p after the map."""
        right, up = x[i, j] / beta, y[i, j] * beta
        for _ in range(abs(i - j)):
            right, up = (v * beta if i > j else v / beta for v in (right, up))
        return right, up

    (a, b), (c, d), (e, f) = scaled(2, 0), scaled(0, 2), scaled(1, 1)
    g11 = (a + c) / 2, (b + d) / 2
    g02 = (a - c - f) / 2, (b - d + e) / 2
    (a, b), (c, d), (e, f), (h, i) = scaled(3, 0), scaled(1, 2), scaled(2, 1), scaled(0, 3)
    g21 = (3 * a + c + f + 3 * i) / 4, (3 * b + d - e - 3 * h) / 4
    return [g11, g02, g21]


def _squared_modulus(pair: tuple[Jet, Jet]) -> Jet:
    """Return the square of a complex number's modulus."""
    return pair[0] * pair[0] + pair[1] * pair[1]


def _fields(k: arb, g: arb, theta: arb) -> tuple[list[Field], list[Field]]:
    """Return V over a ball of theta, with derivatives in theta, and V at the ball's middle.

    Over the ball the coefficients are Taylor polynomials in theta with Lagrange's remainder.
    """
    order, middle = _PARAMETER_ORDER, theta.mid()
    away = theta - middle
    over: list[Field] = []
    at: list[Field] = []
    pairs = zip(_series(k, g, middle, order - 1), _series(k, g, theta, order), strict=True)
    for near, wide in pairs:
        over.append({})
        at.append({})
        for i, j in algebra(2, _ORDER).monomials:
            value, slope = wide[i, j, order], order * wide[i, j, order]
            for n in range(order - 1, -1, -1):
                value = value * away + near[i, j, n]
                if n:
                    slope = slope * away + n * near[i, j, n]
            over[-1][i, j] = Jet(algebra(1, 1), [value, slope])
            at[-1][i, j] = Jet(algebra(1, 0), [near[i, j, 0]])
    return over, at


def _series(k: arb, g: arb, theta: arb, order: int) -> tuple[Jet, Jet]:
    """Return V = (P - id)/theta at the fixed point, as series in xi, eta and theta.

    Positions are g/k + theta z, speeds are theta times (s, c), and times theta tau. At the fixed
    point s = g (1 + 1/k) and tau = 2 for each theta.
    """
    series = algebra(2, _ORDER, order)
    xi, eta, t = Jet.series(series, arb(0), arb(0), theta)
    sine, versine = (
        t.compose(_even_function(kind, theta, series.order)) for kind in ("sine", "versine")
    )
    # (1 - theta cot(theta))/theta, which is analytic at theta = 0
    divided = t * ((sine + versine) / (1 + t * t * sine))
    z = xi - divided * (g / k)
    x = g / k + t * z
    speed = g + g / k
    s = (((1 + k) * (2 * g * divided * xi - k * xi * xi) - eta * eta) / k + speed * speed).sqrt()
    c = -(eta + s) / (1 + k)
    tau = Jet.constant_of(series, arb(2))
    kernels = [_even_function(kind, 2 * theta, series.order) for kind in ("sine", "versine")]
    time = t * tau
    sine, versine = (time.compose(terms) for terms in kernels)
    for degree in range(1, series.order + 1):
        # f/(theta^2 tau). Its derivative in tau at the fixed point is s/tau, since the flight ends
        # with the speed s with which it began; it is 0 at the fixed point for each theta.
        gap = tau * (g / 2) - s + time * time * c * sine + x * tau * versine
        for i, powers in enumerate(series.monomials):
            if sum(powers) == degree and powers[:2] != (0, 0):
                tau.coefficients[i] -= 2 * gap.coefficients[i] / speed
        time = t * tau
        sine, versine = (time.compose(terms) for terms in kernels)
    right = -(x * tau * tau * versine) - c * tau * (1 + time * time * sine)
    up = tau * (-k * z) - k * t * tau * tau * (x * tau * sine - c * versine)
    return right, up


def _even_function(kind: str, value: arb, order: int) -> list[arb]:
    """Return Taylor coefficients, over a ball, of (sin(z) - z)/z^3 or of (1 - cos(z))/z^2.

    They are the integrals over u in (0, 1) of -(1 - u)^2 cos(u z)/2 and (1 - u) cos(u z), so that
    no derivative exceeds 1/2 at real z. Those over the ball are those at its middle, shifted, with
    Lagrange's remainder.
    """
    if not abs(value) < 5:
        raise NotProvedError("the bands of theta are too wide")
    middle, most = value.mid(), order + _EXTRA_ORDERS
    away = value - middle
    reach, powers = away.abs_upper(), [arb(1)]
    while len(powers) <= 2 * _SERIES_TERMS:
        powers.append(powers[-1] * middle)
    # Of the terms C(2j, n) |z|^(2j - n)/(2j)! those with j > _SERIES_TERMS are left out. As |z| < 5
    # and C(2j, n) <= 4^j, their sum is less than the following.
    left_out = arb(0, arb(2 * 100**_SERIES_TERMS) / factorial(2 * _SERIES_TERMS))
    at_middle = [
        sum((c * powers[p] for p, c in _power_series(kind, n, ctx.prec)), left_out)
        for n in range(most + 1)
    ]
    terms = []
    for n in range(order + 1):
        total, beyond = arb(0), most + 1 - n
        for m in range(most, n - 1, -1):
            total = total * away + comb(m, n) * at_middle[m]
        rest = reach**beyond / (2 * factorial(n) * factorial(beyond))
        terms.append(total + arb(0, rest.upper()))
    return terms


@cache
def _power_series(kind: str, n: int, bits: int) -> list[tuple[int, arb]]:
    """Return powers and coefficients of the series of the n-th Taylor coefficient.

    `bits` is the context's precision, in which the coefficients are kept.
    """
    sign, more = (-1, 3) if kind == "sine" else (1, 2)
    return [
        (2 * j - n, ball_of(Fraction(sign * (-1) ** j * comb(2 * j, n), factorial(2 * j + more))))
        for j in range(_SERIES_TERMS + 1)
        if 2 * j >= n
    ]
