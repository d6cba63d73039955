"""The impact map at complex points: the flight time that continues the first root of real points.

At a real point the flight time is the first root of the gap. At complex points near it the flight
time is defined by continuation. A `Branch` follows it from one complex box to the next one that
shares an edge: each box has a set in which the gap has exactly one root for each of its points.
"""

from dataclasses import dataclass

from flint import acb, arb

from .flight import Gap, UndecidedError, expand
from .jets import Jet
from .surface import Surface

_ATTEMPTS = 8  # at a set that contains its Newton image, each one wider
_LEAST_RADIUS = arb(2) ** -40  # of a set, before it is made wider
_WIDER = 1.2  # factor between the Newton image and the next set that is tried
_REFINEMENTS = 3


def gap_at(surface: Surface, x: acb | Jet, y: acb | Jet) -> Gap:
    """Return the gap after the impact at x, y; raises UndecidedError where s may not be analytic.

    s is the square root with positive real part.
    """
    k, g, energy = surface.constants()
    square = ((1 + k) * (2 * energy + x * (2 * g - k * x)) - y * y) / k
    if not (square.constant if isinstance(square, Jet) else square).real > 0:
        raise UndecidedError("the speed may not be analytic in the strip")
    s = _root_of_jet(square) if isinstance(square, Jet) else _square_root(square)
    return Gap(x, -(y + s) / (1 + k), s, g)


def _square_root(square: acb) -> acb:
    """Enclose the square roots of a set more narrowly than Arb does, from those of its midpoint.

    If s^2 = z and t^2 = m, then s = t + (z - m)/(s + t).
    """
    middle = square.mid()
    centre, root = middle.sqrt(), square.sqrt()
    for _ in range(3):
        root = _intersection(root, centre + (square - middle) / (root + centre))
    return root


def _root_of_jet(square: Jet) -> Jet:
    """Return the square root of a series: its constant term is known, the rest by Newton steps."""
    value = _square_root(square.constant)
    root, order = Jet.constant_of(square.algebra, value), 0
    while order < square.algebra.order:
        excess = root * root - square
        excess.coefficients[0] = acb(0)
        root = root - excess / (root * 2)
        order = 2 * order + 1
    return root


@dataclass(frozen=True)
class Flights:
    """The flights of all points of a box: the gap over the box, its series, and at the midpoint."""

    gap: Gap
    series: Gap
    middle: Gap
    offsets: tuple[acb, acb]  # of the box from its midpoint

    @classmethod
    def of(cls, surface: Surface, x: acb, y: acb) -> "Flights":
        """Return the flights of a box; raises UndecidedError as `gap_at` does."""
        series = gap_at(surface, *Jet.plane(1, x, y))
        gap = Gap(x, series.c.constant, series.s.constant, series.g)
        centre = x.mid(), y.mid()
        return cls(gap, series, gap_at(surface, *centre), (x - centre[0], y - centre[1]))

    def height(self, t: acb) -> acb:
        """Enclose f at one time for all points, by the mean value theorem in x and y."""
        change = self.series.height(Jet.constant_of(self.series.x.algebra, t)).coefficients
        value = self.middle.height(t)
        return value + change[1] * self.offsets[0] + change[2] * self.offsets[1]

    def newton(self, inside: acb) -> acb:
        """Return the Newton image m - f(m)/f'(U) of a set U."""
        middle, slope = inside.mid(), self.gap.slope(inside)
        if slope.contains(0):
            raise UndecidedError("the slope of the gap may vanish in the strip")
        return middle - self.height(middle) / slope


def unique_root(flights: Flights, known: acb) -> acb:
    """Enclose the root that continues a `known` one, which belongs to one of the box's points.

    N(U) = m - f(m)/f'(U) is computed over a convex set U with midpoint m. If N(U) is inside U, then
    U has exactly one root for each point: one by Brouwer's theorem, and no two, as f(a) - f(b) is
    in (a - b) f'(U) and f'(U) does not contain 0. Raises UndecidedError.
    """
    guess = flights.newton(known).union(known)
    for _ in range(_ATTEMPTS):
        inside = _wider(guess)
        image = flights.newton(inside)
        if inside.contains_interior(image) and inside.contains(known):
            value = image
            for _ in range(_REFINEMENTS):
                value = _intersection(value, flights.newton(value))
            return value
        guess = guess.union(image)
    raise UndecidedError("the flight time may not be analytic in the strip")


def point_root(gap: Gap, value: acb) -> acb:
    """Narrow the root of one of the box's points, from the enclosure of all of them."""
    for _ in range(8):
        middle = value.mid()
        image = middle - gap.height(middle) / gap.slope(value)
        narrow = _intersection(image, value)
        if not narrow.rad() < value.rad() * 0.5:
            return narrow
        value = narrow
    return value


def impact(surface: Surface, x: acb | Jet, y: acb | Jet, root: acb) -> tuple:
    """Return the next impact's x and y, or their jets, from the root of every point of a box."""
    gap, k = gap_at(surface, x, y), surface.constants()[0]
    tau = expand(gap, root) if isinstance(x, Jet) else root
    sine, cosine = tau.sin_cos()
    b = -gap.s - gap.c
    after = x * cosine - gap.c * sine
    return after, b + gap.g * tau - k * (x * sine + gap.c * cosine)


def _intersection(a: acb, b: acb) -> acb:
    """Return the intersection of two sets that are known to meet."""
    return acb(a.real.intersection(b.real), a.imag.intersection(b.imag))


def _wider(value: acb) -> acb:
    """Return a set around another one."""
    parts = value.real, value.imag
    return acb(*(arb(a.mid(), ((a.rad() + _LEAST_RADIUS) * _WIDER).upper()) for a in parts))
