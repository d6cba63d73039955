"""Flight times at complex points, which continue the first root of real points.

At complex points near a real one the flight time is defined by continuation, from one complex box
to the next one that shares an edge: each box has a set in which the gap has exactly one root for
each of its points.
"""

from flint import acb, arb

from pseudorigid.verified.flight import Flight, UndecidedError

from ..enclosure.jets import Jet, intersection
from ..enclosure.surface import Surface, flight_of_constants

_ATTEMPTS = 8  # at a set that contains its Newton image, each one wider
_LEAST_RADIUS = arb(2) ** -40  # of a set, before it is made wider
_WIDER = 1.2  # factor between the Newton image and the next set that is tried
_REFINEMENTS = 3


def unique_root(surface: Surface, x: acb, y: acb, known: acb) -> acb:
    """Enclose the root that continues a `known` one, which belongs to one of the box's points.

    N(U) = m - f(m)/f'(U) is computed over a convex set U with midpoint m. If N(U) is inside U, then
    U has exactly one root for each point: one by Brouwer's theorem, and no two, as f(a) - f(b) is
    in (a - b) f'(U) and f'(U) does not contain 0. Raises UndecidedError.
    """
    series, centre = surface.flight(*Jet.plane(1, x, y)), (x.mid(), y.mid())
    box, middle = flight_of_constants(series), surface.flight(*centre)

    def newton(inside: acb) -> acb:
        """Return N(U); f(m) is enclosed by the mean value theorem in x and y."""
        slope = box.slope(inside)
        if slope.contains(0):
            raise UndecidedError("the slope of the gap may vanish in the strip")
        m = inside.mid()
        change = series.height(Jet.constant_of(series.x.algebra, m)).coefficients
        height = middle.height(m) + change[1] * (x - centre[0]) + change[2] * (y - centre[1])
        return m - height / slope

    guess = newton(known).union(known)
    for _ in range(_ATTEMPTS):
        sides = guess.real, guess.imag
        inside = acb(*(arb(a.mid(), ((a.rad() + _LEAST_RADIUS) * _WIDER).upper()) for a in sides))
        image = newton(inside)
        if inside.contains_interior(image) and inside.contains(known):
            for _ in range(_REFINEMENTS):
                image = intersection(image, newton(image))
            return image
        guess = guess.union(image)
    raise UndecidedError("the flight time may not be analytic in the strip")


def point_root(flight: Flight, value: acb) -> acb:
    """Narrow the root of one of the box's points, from the enclosure of all of them."""
    for _ in range(8):
        middle = value.mid()
        image = middle - flight.height(middle) / flight.slope(value)
        narrow = intersection(image, value)
        if not narrow.rad() < value.rad() * 0.5:
            return narrow
        value = narrow
    return value
