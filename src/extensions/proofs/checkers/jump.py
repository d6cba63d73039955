"""The curve S+ on which the map jumps, and the energy below which the map is a diffeomorphism.

A flight may touch the floor, f = f' = 0, without landing. The state there is a point r of the rim,
s = 0, with x < -g. Backwards from r the ball comes from the point R P(r); these points form S+.
theory/jumps.md and circles.md have the arguments.
"""

from fractions import Fraction
from itertools import pairwise

from flint import arb, ctx

from pseudorigid.verified.flight import NotProvedError, UndecidedError, flight_from_rim

from ..enclosure.jets import Jet
from ..enclosure.surface import Impact, Surface, ball_of
from . import hsets, periodic
from .certificate import Certificate, Finding, Window, check_stated, holds_throughout, lower_bound
from .hsets import HSet
from .periodic import Point

BITS = 192  # twice what points to 1e-28 need
_CHAIN_BITS = 64  # the smallest sets of a chain to the jump set are 1e-5 wide
_SHORT_FLIGHTS = 0.95  # of the largest xdot: beyond it flights from the rim are short
_CROSSING_PARTS = 64  # of the part of S+ that crosses an h-set


def check(
    text: str, surface: Surface, *, radius: Fraction, length: Fraction, jump: Fraction
) -> Finding:
    """Prove a certificate's point of the jump set with its two images, and the set's two ends.

    `radius` is the largest error of a certificate's point. `length` and `jump` are lower bounds, to
    be proved, of the curve's length in (x, y), and of the distance of the one-sided images in x or
    in y.
    """
    with ctx.workprec(BITS):
        certificate = Certificate(text, "jump set", surface)
        size = certificate.at_most("radius", radius)
        speed = ball_of(certificate.number("speed"))
        points = stated_points(surface, speed)
        transversality = _transversality(surface, speed)
        check_landings(surface)
        excess = _polygon_length(surface) - ball_of(length)
        if not excess > 0:
            raise NotProvedError(f"the curve is not proved to be longer than {float(length):g}")
        digits: dict[str, arb] = {}
        for name, point in points.items():
            check_stated(name, point, certificate.row(name.replace(" ", "_"), 2), size)
            digits |= {f"{name} x": point[0], f"{name} y": point[1]}
        images = zip(points["near image"], points["far image"], strict=True)
        apart = max(lower_bound(abs(near - far) - ball_of(jump)) for near, far in images)
        if not (jump >= 0 and apart > 0):
            raise NotProvedError(f"the one-sided images may be within {float(jump):g}")
        margins = {"jump": apart, "transversality": transversality, "length": lower_bound(excess)}
        return Finding(digits, margins)


def check_no_circle(
    text: str, surface: Surface, *, period: int, radius: Fraction, window: Window
) -> Finding:
    """Prove that the unstable manifold of a certificate's hyperbolic orbit meets the jump set.

    The orbit must have this prime period, be the only one within the radius of the centres of the
    S, and have a point in the window; the jump set must be one curve. The S are sets around the
    orbit's points, of which each covers the next. A chain of sets leads from one of them to N, each
    covering the next, and the jump set crosses N. The margins are the least over all relations. The
    parts are the chain, a list of HSet with N last, and the orbit.
    """
    certificate = Certificate(text, "jump crossing", surface)
    orbit = periodic.prove_saddles(certificate, surface, period, radius, window)
    with ctx.workprec(_CHAIN_BITS):
        saddles = hsets.read_sets(certificate, "saddles", "S")
        chain = hsets.read_sets(certificate, "chain", "M", first=1)
        hsets.check_contained(saddles, orbit.points)
        leaves = certificate.whole("leaves")
        if leaves not in range(len(saddles)):
            raise NotProvedError("the certificate's chain does not begin at its saddles")
        loop = [hsets.prove_hyperbolic(surface, *it) for it in pairwise([*saddles, saddles[0]])]
        margins = [hsets.prove_covering(surface, *it) for it in pairwise([saddles[leaves], *chain])]
    with ctx.workprec(BITS):
        check_landings(surface)
        low, high = map(ball_of, certificate.row("touches", 2))
        across = prove_crossing(surface, chain[-1], low, high)
    beyond, room = map(min, zip(*margins, *(pair for pair, _, _ in loop), strict=True))
    cone = min(least for _, least, _ in loop)
    return Finding(
        {"jump set at x": chain[-1].box(hsets.UNIT, hsets.UNIT)[0]},
        {"beyond": beyond, "room": room, "cones": cone, "crossing": across},
        {"chain": chain, "orbit": orbit},
    )


def check_smooth(text: str, k: Fraction, g: Fraction, energy: Fraction) -> Finding:
    """Prove that no flight touches the floor below an energy, so that P is a diffeomorphism there.

    The margin is the distance from the least energy, -g^2/(2k).
    """
    certificate = Certificate(text, "no touch", ball=(k, g))
    certificate.check("energy_below", energy)
    roots = certificate.row("roots", 2)
    # k/2 (x - roots[0]) (x - roots[1]) is to be k/2 x^2 - g x - energy
    if (k / 2 * (roots[0] + roots[1]), k / 2 * roots[0] * roots[1]) != (g, -energy):
        raise NotProvedError("the energy of a touch is not the stated product of factors")
    if not all(root >= -g for root in roots):
        raise NotProvedError("the factors are not proved to be negative for x < -g")
    margin = lower_bound(ball_of(energy + g * g / (2 * k)))
    return Finding({"energy below": ball_of(energy)}, {"above least": margin})


def stated_points(surface: Surface, speed: arb) -> dict[str, Point]:
    """Return a point of the jump set with its one-sided images, and the set's ends, in the chart.

    `speed` is xdot on the rim where the flight from the point touches. Raises NotProvedError as
    `_landing_from_rim`.
    """
    (k, g, _), (inner, outer) = surface.constants(), _ends(surface)
    return {
        "point": _mirrored(_landing_from_rim(surface, speed)),
        "near image": (-g - _rim_point(surface, _rim_angle(surface, speed))[1], -(1 + k) * speed),
        "far image": _landing_from_rim(surface, -speed)[:2],
        "outer end": outer,
        "inner end": inner,
    }


def _ends(surface: Surface) -> tuple[Point, Point]:
    """Return the inner and the outer end of the jump set in the chart."""
    k, g, _ = surface.constants()
    return _mirrored(_landing(surface, arb.pi())), (-g, -(1 + k) * fastest_touch(surface))


def _mirrored(impact: Impact) -> Point:
    return impact.x, -impact.y


def _rim_point(surface: Surface, angle: arb) -> tuple[arb, arb]:
    """Return xdot and d >= 0 of points of the rim, s = 0, with x = -g - d.

    xdot is the fastest touch's times the cosine of the angle: each angle gives such a point, and
    each point with x <= -g has an angle. Raises NotProvedError if the rim has no x < -g.
    """
    k, g, _ = surface.constants()
    fastest, pressed = fastest_touch(surface), g * (1 + k)
    sine, cosine = angle.sin_cos()
    square = (1 + k) * (fastest * sine) ** 2  # the energy's excess over that at x = -g, twice
    beyond = square / (pressed + (pressed * pressed + k * square).sqrt())
    return fastest * cosine, beyond.nonnegative_part()


def _rim_angle(surface: Surface, xdot: arb) -> arb:
    """Return the angle of `_rim_point` for an xdot; the point must have x < -g."""
    fastest = fastest_touch(surface)
    if not abs(xdot) < fastest:
        raise NotProvedError("the speed is not one of a rim point with x < -g")
    return (xdot / fastest).acos()


def _landing_from_rim(surface: Surface, xdot: arb) -> Impact:
    """Return the next impact of the rim points with some xdot and x < -g; NotProvedError if none.

    It refuses every ball of xdot with a number that no such point has.
    """
    return _landing(surface, _rim_angle(surface, xdot))


def _landing(surface: Surface, angle: arb) -> Impact:
    """Return the next impact of the rim points with x <= -g at an angle of `_rim_point`."""
    flight, tau = flight_from_rim(surface.constants()[1], *_rim_point(surface, angle))
    x, v, w = flight.end(tau)
    return Impact(x, v - surface.constants()[0] * w, tau, v + w)


def fastest_touch(surface: Surface) -> arb:
    """Return the largest xdot on the rim, at x = -g, if any flight touches the floor."""
    k, g, energy = surface.constants()
    square = (2 * energy - g * g * (2 + k)) / (1 + k)
    if not square > 0:
        raise NotProvedError(f"no flight touches the floor: E <= g^2 (1 + k/2) at {surface}")
    return square.sqrt()


def _transversality(surface: Surface, speed: arb) -> float:
    """Prove that the gap's maximum changes sign across S+, and return a lower bound of its slope.

    The point of S+ is the one from which the flight touches the rim with the given xdot.
    """
    impact = _landing_from_rim(surface, speed)
    flight = surface.flight(*Jet.plane(1, *_mirrored(impact)))
    height = flight.height(Jet.constant_of(flight.x.algebra, impact.tau))
    if not height.constant.contains(0):
        raise NotProvedError("the flight does not touch the floor where it should")
    slope = max(lower_bound(abs(part)) for part in height.coefficients[1:])
    if not slope > 0:
        raise NotProvedError("the gap's maximum may not change sign across the curve")
    return slope


def curve(surface: Surface, count: int) -> list[Point]:
    """Return points of the jump set from its inner to its outer end, at `count` even xdot steps."""
    fastest, (inner, outer) = fastest_touch(surface), _ends(surface)
    speeds = [fastest * arb(2 * i - count) / count for i in range(1, count)]
    return [inner, *(_mirrored(_landing_from_rim(surface, speed)) for speed in speeds), outer]


def prove_crossing(surface: Surface, hset: HSet, low: arb, high: arb) -> float:
    """Prove that S+ crosses an h-set from one edge |q| = 1 to the other, within |p| < 1.

    The crossing part is that of the flights that touch the floor with xdot from low to high, which
    must be those of rim points with x < -g. `check_landings` says what P does on it. This returns
    the least margin in p and q, and raises NotProvedError.
    """
    steps = [low + (high - low) * i / _CROSSING_PARTS for i in range(_CROSSING_PARTS + 1)]

    def touching(speed: arb) -> Point:
        """Return (p, q) of the point of S+ whose flight touches the floor with this xdot."""
        return hset.coordinates(*_mirrored(_landing_from_rim(surface, speed)))

    ends = [touching(speed)[1] for speed in (low, high)]
    across = [touching(a.union(b))[0] for a, b in pairwise(steps)]
    if not (ends[0] > 1 and ends[1] < -1) and not (ends[0] < -1 and ends[1] > 1):
        raise NotProvedError(f"{hset.name}: the jump set may not reach both of its edges")
    room = min(lower_bound(1 - abs(p)) for p in across)
    if not room > 0:
        raise NotProvedError(f"{hset.name}: the jump set may leave it sideways")
    return min(room, *(lower_bound(abs(q) - 1) for q in ends))


def check_landings(surface: Surface) -> None:
    """Prove that no flight from the rim, x < -g, touches again before it lands with s > 0.

    So S+ is one curve, and P jumps at each of its points. Near x = -g with xdot > 0 flights are
    short: f/t^2 = (g + x)/2 + xdot t/6 + r, |r| <= A t^2/24, |r'| <= A t/12 + A t^2/120, rises up
    to t = xdot/A <= 1, where it is above zero if -(g + x) < xdot^2/(4 A).
    """
    g, last = surface.constants()[1], arb(_SHORT_FLIGHTS).acos()
    xdot, beyond = _rim_point(surface, arb(0).union(last))
    x = -g - beyond
    # xdot > 0 holds at every energy, as the cosine of these angles is at least _SHORT_FLIGHTS
    if not (xdot > 0 and beyond < xdot * xdot / (4 * (x * x + xdot * xdot).sqrt())):
        raise NotProvedError("the shortest flights from the rim are not proved to land")

    def lands(angle: arb) -> bool:
        """Whether all flights from the rim at these angles are proved to land with s > 0."""
        try:
            return bool(_landing(surface, angle).s > 0)
        except UndecidedError:
            return False

    if not holds_throughout(lands, last.lower(), arb.pi().upper(), arb(1e-5)):
        raise NotProvedError("a flight from the rim may touch the floor a second time")


def _polygon_length(surface: Surface, count: int = 400) -> arb:
    """Return the length of a polygon whose corners lie on the curve, which is longer."""
    total = arb(0)
    for (x0, y0), (x1, y1) in pairwise(curve(surface, count)):
        total += ((x1 - x0) ** 2 + (y1 - y0) ** 2).sqrt()
    return total
