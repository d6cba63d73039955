"""The curve S+ on which the map jumps, and the energy below which the map is a diffeomorphism.

A flight may touch the floor, f = f' = 0, without landing. The state there is a point r of the rim,
s = 0, with x < -g, since f'' = g + x < 0. Backwards from r the ball comes from the point R P(r).
These points, for all r on the rim with x < -g, form S+, a smooth curve, if every flight from that
arc ends at its first root with s > 0. At each point of S+ the map has two one-sided limits: R r
where the flight just reaches the floor, and P(R r) where it just misses it. One end of S+ is on the
rim, where x = -g and flights shrink to nothing; at the other end the tangency is cubic.

On the rim E = (1+k) xdot^2/2 + k x^2/2 - g x. By the identity

    k x^2/2 - g x - g^2 (1 + k/2) = (k/2) (x + g) (x - g - 2 g/k),

whose factors are both negative for x < -g, no flight touches the floor for E < g^2 (1 + k/2), and P
is analytic with an analytic inverse. docs/proofs.md has the arguments.
"""

from fractions import Fraction
from itertools import pairwise

from flint import arb, ctx, fmpq, fmpq_poly

from ..enclosure.flight import Gap, UndecidedError, fly
from ..enclosure.jets import Jet, algebra
from ..enclosure.surface import Impact, Surface, ball_of
from .certificate import Certificate, Finding, NotProvedError, lowest

BITS = 192  # twice what points to 1e-28 need
_START_FACTOR = 1 - arb(2) ** -20  # shortens a bound's root so far that the bound is negative there
_SHORT_FLIGHTS = 0.95  # of the largest xdot: beyond it flights from the rim are short

Point = tuple[arb, arb]


def check(
    text: str, surface: Surface, *, radius: Fraction, length: Fraction, jump: Fraction
) -> Finding:
    """Prove a certificate's point of the jump set with its two images, and the set's two ends.

    Parameters
    ----------
    text : str
        The certificate.
    surface : Surface
    radius : Fraction
        The largest error of a certificate's point.
    length : Fraction
        A lower bound of the curve's length in (x, y), to be proved.
    jump : Fraction
        A lower bound of the distance of the one-sided images in x or in y, to be proved.

    Returns
    -------
    Finding
        digits: x and y of the point, its near and far image and the outer and inner end. margins:
        jump and length, by which the bounds are exceeded; transversality.

    Raises
    ------
    NotProvedError
    """
    with ctx.workprec(BITS):
        certificate = Certificate(text, "jump set")
        certificate.check_surface(surface)
        size = certificate.number("radius")
        if not 0 < size <= radius:
            raise NotProvedError(f"the radius is {float(size):g}, not at most {float(radius):g}")
        speed = ball_of(certificate.number("speed"))
        try:
            x, impact, transversality = _touch(surface, speed)
            points = {
                "point": (impact.x, -impact.y),
                "near image": (x, -(1 + surface.constants()[0]) * speed),
                "far image": _flight_from_rim(surface, -speed)[1][:2],
                **_ends(surface),
            }
            _check_no_second_touch(surface)
            excess = _polygon(surface) - ball_of(length)
        except UndecidedError as error:
            raise NotProvedError(f"a flight that touches the floor: {error}") from None
        if not excess > 0:
            raise NotProvedError(f"the curve is not proved to be longer than {float(length):g}")
        for name, point in points.items():
            for value, stated in zip(
                point, certificate.row(name.replace(" ", "_"), 2), strict=True
            ):
                if not abs(value - ball_of(stated)) < ball_of(size):
                    raise NotProvedError(f"the {name} is not within the radius of the stated one")
        images = zip(points["near image"], points["far image"], strict=True)
        apart = max(lowest(abs(near - far) - ball_of(jump)) for near, far in images)
        if not apart > 0:
            raise NotProvedError(f"the one-sided images may be within {float(jump):g}")
        digits = {
            f"{name} {axis}": value
            for name, point in points.items()
            for axis, value in zip("xy", point, strict=True)
        }
        margins = {"jump": apart, "transversality": transversality, "length": lowest(excess)}
        return Finding(digits, margins)


def check_smooth(text: str, k: Fraction, g: Fraction, energy: Fraction) -> Finding:
    """Prove that no flight touches the floor below an energy, so that P is a diffeomorphism there.

    Returns a Finding with digits energy below, and margins above least, the distance from the least
    energy, -g^2/(2k). Raises NotProvedError.
    """
    certificate = Certificate(text, "no touch")
    certificate.check_ball(k, g)
    threshold = certificate.number("energy_below")
    if threshold != energy:
        raise NotProvedError(f"the certificate is of energies below {threshold}, not {energy}")
    roots = certificate.row("roots", 2)
    product = _polynomial(k / 2)
    for root in roots:
        product *= _polynomial(-root, 1)
    if _polynomial(-threshold, -g, k / 2) != product:
        raise NotProvedError("the energy of a touch is not the stated product of factors")
    if not all(root >= -g for root in roots):
        raise NotProvedError("the factors are not proved to be negative for x < -g")
    margin = lowest(ball_of(threshold + g * g / (2 * k)))
    return Finding({"energy below": ball_of(threshold)}, {"above least": margin})


def _polynomial(*coefficients: Fraction | int) -> fmpq_poly:
    return fmpq_poly([fmpq(c.numerator, c.denominator) for c in coefficients])


def _rim_x(surface: Surface, xdot: arb) -> arb:
    """Return x <= -g of the rim point with a given xdot."""
    k, g, energy = surface.constants()
    return (g - (g * g + k * (2 * energy - (1 + k) * xdot * xdot)).sqrt()) / k


def _flight_from_rim(surface: Surface, xdot: arb) -> tuple[arb, Impact]:
    """Return x <= -g of the rim point with a given xdot, and its next impact."""
    x = _rim_x(surface, xdot)
    return x, _flight(surface, x, xdot)


def _flight(surface: Surface, x: arb, xdot: arb) -> Impact:
    """Return the next impact of the point (x, xdot) of the rim with x <= -g."""
    k, g, _ = surface.constants()
    start = None
    if xdot < 0:  # f/t^2 <= (g + x)/2 + xdot t/6 + A t^2/24 with g + x <= 0
        start = (_START_FACTOR * -4 * xdot / (x * x + xdot * xdot).sqrt()).lower()
    x, v, w, tau = fly(x, xdot, -xdot, arb(0), g, start)
    return Impact(x, v - k * w, tau, v + w)


def _fastest(surface: Surface) -> arb:
    """Return the largest xdot on the rim, at x = -g, if any flight touches the floor."""
    k, g, energy = surface.constants()
    square = (2 * energy - g * g * (2 + k)) / (1 + k)
    if not square > 0:
        raise NotProvedError(f"no flight touches the floor: E <= g^2 (1 + k/2) at {surface}")
    return square.sqrt()


def _ends(surface: Surface) -> dict[str, Point]:
    """Return the two ends of the jump set in the chart."""
    k, g, _ = surface.constants()
    fastest = _fastest(surface)
    impact = _flight(surface, -g, -fastest)
    return {"outer end": (-g, -(1 + k) * fastest), "inner end": (impact.x, -impact.y)}


def _touch(surface: Surface, xdot: arb) -> tuple[arb, Impact, float]:
    """Return x of the rim point, its next impact, and the slope of the gap's maximum across S+."""
    if not abs(xdot) < _fastest(surface):
        raise NotProvedError("the speed is not one of a rim point with x < -g")
    x, impact = _flight_from_rim(surface, xdot)
    k, g, _ = surface.constants()
    plane = algebra(2, 1)
    a, y = Jet.variable(plane, 0, impact.x), Jet.variable(plane, 1, -impact.y)
    s = surface.speed(a, y)
    height = Gap(a, -(y + s) / (1 + k), s, g).height(Jet.constant_of(plane, impact.tau))
    if not height.constant.contains(0):
        raise NotProvedError("the flight does not touch the floor where it should")
    slope = max(lowest(abs(part)) for part in height.coefficients[1:])
    if not slope > 0:
        raise NotProvedError("the gap's maximum may not change sign across the curve")
    return x, impact, slope


def curve(surface: Surface, count: int) -> list[Point]:
    """Return points of the jump set from its inner to its outer end, at `count` even xdot steps."""
    fastest, ends = _fastest(surface), _ends(surface)
    inner = []
    for i in range(1, count):
        impact = _flight_from_rim(surface, fastest * arb(2 * i - count) / count)[1]
        inner.append((impact.x, -impact.y))
    return [ends["inner end"], *inner, ends["outer end"]]


def _check_no_second_touch(surface: Surface) -> None:
    """Prove that no flight from the rim, x < -g, touches again before it lands with s > 0.

    Near x = -g with xdot > 0 flights are short: f/t^2 = (g + x)/2 + xdot t/6 + r,
    |r| <= A t^2/24, |r'| <= A t/12 + A t^2/120, rises up to t = xdot/A, where it is above zero if
    -(g + x) < xdot^2/(4 A).
    """
    g = surface.constants()[1]
    fastest = _fastest(surface)
    low, high = -fastest.upper(), (fastest * _SHORT_FLIGHTS).upper()
    xdot = high.union(fastest.upper())
    x = _rim_x(surface, xdot)
    if not -(g + x) < xdot * xdot / (4 * (x * x + xdot * xdot).sqrt()):
        raise NotProvedError("the shortest flights from the rim are not proved to land")
    intervals = [(low, high)]
    while intervals:
        low, high = intervals.pop()
        if _lands(surface, low.union(high)):
            continue
        if high - low < fastest / 10**5:
            raise NotProvedError("a flight from the rim may touch the floor a second time")
        middle = ((low + high) / 2).mid()
        intervals += [(low, middle), (middle, high)]


def _lands(surface: Surface, xdot: arb) -> bool:
    """Whether all flights from the rim with these xdot are proved to land with s > 0."""
    try:
        return _flight_from_rim(surface, xdot)[1].s > 0
    except UndecidedError:
        return False


def _polygon(surface: Surface, count: int = 400) -> arb:
    """Return the length of a polygon whose corners lie on the curve, which is longer."""
    total = arb(0)
    for (x0, y0), (x1, y1) in pairwise(curve(surface, count)):
        total += ((x1 - x0) ** 2 + (y1 - y0) ** 2).sqrt()
    return total
