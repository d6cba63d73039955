"""Where the map jumps, and below which energy it cannot.

A flight may touch the floor, f = f' = 0, without landing. The state there lies on the rim, s = 0,
with x <= -g, since f'' = g + x <= 0 at a touch from below; f'' = 0 there makes it land, so x < -g.
Backwards from such a rim point r the ball comes from R P(r): these points are the curve S+.

P jumps at each point of S+. The flow takes the states of the section to those with f' = 0 near the
touch by a local diffeomorphism, since s > 0 at the one and f'' < 0 at the other. At f' = 0 the gap
is X + U at the energy E with xdot = -udot, whose gradients (1, 1, 0) and (-g, k U, (1 + k) xdot) in
(X, U, xdot) are parallel only for X = g/k > 0, not at x < -g. So the gap's maximum changes sign
across S+: on the side where the flight just reaches the floor the image tends to R r, on the rim,
on the other to P(R r), inside it if that flight lands with s > 0.

S+ is one smooth curve, the image of an arc of the rim. R P is injective on the arc: two of its
points with one image would lie on one flight, which would touch at the later one; but every flight
from the arc ends at its first root with s > 0. It is an immersion there: the flow crosses the rim
s = 0 with sdot = g + x, not zero.

At one end of S+, x = -g on the rim with xdot < 0 after the touch is reversed, flights shrink to
nothing: the end is on the rim. At the other f'' = 0 too: the tangency is cubic, and the flow does
not cross the rim, so that the speed of the curve's parameter vanishes.

On the rim E = (1+k) xdot^2/2 + k x^2/2 - g x. By the identity

    k x^2/2 - g x - g^2 (1 + k/2) = (k/2) (x + g) (x - g - 2 g/k),

whose factors are both negative for x < -g, no flight touches the floor for E < g^2 (1 + k/2). Then
the first root of every flight from the open disk s > 0 is simple: were f' = 0 there, f'' <= 0 and
x <= -g. So P is analytic on the disk; it maps it to itself, and R P R undoes it, by time reversal.
"""

from itertools import pairwise

from flint import arb, ctx, fmpq, fmpq_poly

from ..enclosure.flight import Gap, UndecidedError, first_root
from ..enclosure.jets import Jet, algebra
from ..enclosure.surface import Impact, ball_of
from .certificate import Certificate, Finding, NotProvedError, lowest

BITS = 192  # twice what points to 1e-28 need
BELOW_ROOT = 1 - arb(2) ** -20  # of a bound's root: far enough for its value there to be below zero
SHORT = 0.95  # of the largest xdot: from there on flights from the rim are short


def check(text, surface, *, radius, length, jump):
    """Prove a certificate's point of the jump set with its two images, and the set's two ends.

    Parameters
    ----------
    text : str
        The certificate.
    surface : Surface
        Whose map it is about.
    radius : Fraction
        The most that a certificate's point may be off.
    length : Fraction
        A lower bound of the curve's length in (x, y), to be proved.
    jump : Fraction
        The two one-sided images must be further apart than that, in x or in y.

    Returns
    -------
    Finding
        digits: x and y of the point, its near and far image and the outer and inner end; margins:
        jump and length, by which the images are further apart, and a polygon on the curve is
        longer, than the bounds; transversality.

    Raises
    ------
    NotProvedError
        With the reason.

    References
    ----------
    The paper's section 3: "The map (28) is smooth and invertible with a smooth inverse".
    """
    with ctx.workprec(BITS):
        certificate = Certificate(text, "jump set")
        certificate.surface(surface)
        size = certificate.number("radius")
        if not 0 < size <= radius:
            raise NotProvedError(f"the radius is {float(size):g}, not at most {float(radius):g}")
        speed = ball_of(certificate.number("speed"))
        try:
            x, flight, margin = _touch(surface, speed)
            found = {
                "point": (flight.x, -flight.y),
                "near image": (x, -(1 + surface.constants()[0]) * speed),
                "far image": rim_flight(surface, -speed)[1][:2],
                **ends(surface),
            }
            _no_second_touch(surface)
            longer = _polygon(surface) - ball_of(length)
        except UndecidedError as error:
            raise NotProvedError(f"a flight that touches the floor: {error}") from None
        if not longer > 0:
            raise NotProvedError(f"the curve is not proved to be longer than {float(length):g}")
        for name, (x, y) in found.items():
            stated = certificate.row(name.replace(" ", "_"), 2)
            for value, at in zip((x, y), stated, strict=True):
                if not abs(value - ball_of(at)) < ball_of(size):
                    raise NotProvedError(f"the {name} is not within the radius of the stated one")
        near, far = found["near image"], found["far image"]
        further = max(lowest(abs(a - b) - ball_of(jump)) for a, b in zip(near, far, strict=True))
        if not further > 0:
            raise NotProvedError(f"the one-sided images may be within {float(jump):g}")
        digits = {f"{name} {axis}": value for name, pair in found.items()
                  for axis, value in zip("xy", pair, strict=True)}  # fmt: skip
        return Finding(digits, {
            "jump": further, "transversality": margin, "length": lowest(longer),
        })  # fmt: skip


def check_smooth(text, k, g, energy):
    """Prove that no flight touches the floor below an energy: P is a diffeomorphism there.

    Parameters
    ----------
    text : str
        The certificate.
    k, g : Fraction
        The ball.
    energy : Fraction
        The threshold that the certificate must state.

    Returns
    -------
    Finding
        digits: energy below; margins: above least, from the least energy, -g^2/(2k).

    Raises
    ------
    NotProvedError
        With the reason.
    """
    certificate = Certificate(text, "no touch")
    certificate.ball(k, g)
    threshold = certificate.number("energy_below")
    if threshold != energy:
        raise NotProvedError(f"the certificate is of energies below {threshold}, not {energy}")
    roots = certificate.row("roots", 2)
    rest = fmpq_poly([_q(-threshold), _q(-g), _q(k / 2)])
    factors = [fmpq_poly([_q(-root), 1]) for root in roots]
    if rest != fmpq_poly([_q(k / 2)]) * factors[0] * factors[1]:
        raise NotProvedError("the energy of a touch is not the stated product of factors")
    if not all(root >= -g for root in roots):
        raise NotProvedError("the factors are not proved to be negative for x < -g")
    margin = lowest(ball_of(threshold + g * g / (2 * k)))
    return Finding({"energy below": ball_of(threshold)}, {"above least": margin})


def rim_flight(surface, xdot):
    """The flight from the rim point with x <= -g and a given xdot.

    Parameters
    ----------
    surface : Surface
    xdot : arb

    Returns
    -------
    x : arb
        Of the rim point.
    impact : Impact
        Its next one.

    Raises
    ------
    UndecidedError
        Where that flight may touch the floor earlier.
    """
    k, g, energy = surface.constants()
    square = g * g + k * (2 * energy - (1 + k) * xdot * xdot)
    return _flight(surface, (g - square.sqrt()) / k, xdot)


def _flight(surface, x, xdot):
    """The same from a point (x, xdot) of the rim with x <= -g."""
    k, g, _ = surface.constants()
    after = None
    if xdot < 0:  # f/t^2 <= (g + x)/2 + xdot t/6 + A t^2/24 with g + x <= 0
        after = (BELOW_ROOT * -4 * xdot / (x * x + xdot * xdot).sqrt()).lower()
    tau = first_root(x, -xdot, arb(0), g, after)
    sine, cosine = tau.sin_cos()
    v, w = xdot + g * tau, x * sine - xdot * cosine
    return x, Impact(x * cosine + xdot * sine, v - k * w, tau, v + w)


def fastest(surface):
    """The largest xdot on the rim at x = -g.

    Parameters
    ----------
    surface : Surface

    Returns
    -------
    arb

    Raises
    ------
    NotProvedError
        Where no flight touches the floor.
    """
    k, g, energy = surface.constants()
    square = (2 * energy - g * g * (2 + k)) / (1 + k)
    if not square > 0:
        raise NotProvedError(f"no flight touches the floor: E <= g^2 (1 + k/2) at {surface}")
    return square.sqrt()


def ends(surface):
    """The two ends of the jump set in the chart.

    Parameters
    ----------
    surface : Surface

    Returns
    -------
    dict of str to (arb, arb)
        "outer end", on the rim, and "inner end".
    """
    k, g, _ = surface.constants()
    most = fastest(surface)
    _, flight = _flight(surface, -g, -most)
    return {"outer end": (-g, -(1 + k) * most), "inner end": (flight.x, -flight.y)}


def _touch(surface, xdot):
    """(x, flight from the rim point, how transversally the gap's maximum passes zero)."""
    if not abs(xdot) < fastest(surface):
        raise NotProvedError("the speed is not one of a rim point with x < -g")
    x, flight = rim_flight(surface, xdot)
    k, g, _ = surface.constants()
    plane = algebra(2, 1)
    a, y = Jet.variable(plane, 0, flight.x), Jet.variable(plane, 1, -flight.y)
    s = surface.speed(a, y)
    height = Gap(a, -(y + s) / (1 + k), s, g).height(Jet.constant_of(plane, flight.tau))
    if not height.constant.contains(0):
        raise NotProvedError("the flight does not touch the floor where it should")
    slope = max(lowest(abs(part)) for part in height.coefficients[1:])
    if not slope > 0:
        raise NotProvedError("the gap's maximum may not change sign across the curve")
    return x, flight, slope


def curve(surface, count):
    """Points of the jump set, from its inner end to its outer one, at even steps of xdot.

    Parameters
    ----------
    surface : Surface
    count : int
        Of steps.

    Returns
    -------
    list of (arb, arb)
        (x, y).
    """
    most, places = fastest(surface), ends(surface)
    inner = []
    for i in range(1, count):
        flight = rim_flight(surface, most * arb(2 * i - count) / count)[1]
        inner.append((flight.x, -flight.y))
    return [places["inner end"], *inner, places["outer end"]]


def _no_second_touch(surface, low=None, high=None):
    """Prove that no flight from the rim, x < -g, touches again before it lands with s > 0.

    Near x = -g with xdot > 0 flights are short: f/t^2 = (g + x)/2 + xdot t/6 + r,
    |r| <= A t^2/24, |r'| <= A t/12 + A t^2/120, rises up to t = xdot/A, where it is above zero if
    -(g + x) < xdot^2/(4 A).
    """
    k, g, energy = surface.constants()
    most = fastest(surface)
    if low is None:
        low, high = -most.upper(), (most * SHORT).upper()
        xdot = high.union(most.upper())
        x = (g - (g * g + k * (2 * energy - (1 + k) * xdot * xdot)).sqrt()) / k
        if not -(g + x) < xdot * xdot / (4 * (x * x + xdot * xdot).sqrt()):
            raise NotProvedError("the shortest flights from the rim are not proved to land")
    try:
        if rim_flight(surface, low.union(high))[1].s > 0:
            return
    except UndecidedError:
        pass
    if high - low < most / 10**5:
        raise NotProvedError("a flight from the rim may touch the floor a second time")
    middle = ((low + high) / 2).mid()
    _no_second_touch(surface, low, middle)
    _no_second_touch(surface, middle, high)


def _polygon(surface, count=400):
    """The length of a polygon whose corners lie on the whole curve, which is longer."""
    total = arb(0)
    for (x0, y0), (x1, y1) in pairwise(curve(surface, count)):
        total += ((x1 - x0) ** 2 + (y1 - y0) ** 2).sqrt()
    return total


def _q(fraction):
    return fmpq(fraction.numerator, fraction.denominator)
