"""Heteroclinic orbits and the areas of lobes, by differences of action, to many digits.

Along an impact and a flight at constant energy, the one-form y dx, y = xdot - k udot, changes by
the differential of the action S, the integral of xdot^2 + k udot^2 over the flight. The area
between an unstable and a stable arc with common ends is therefore a sum of differences of S between
the orbits of the two ends, over all flights (MacKay, Meiss and Percival, Physica D 13, 1984). The
terms nearly cancel. They are computed in ball arithmetic, whose radii enclose every rounding.
"""

from collections.abc import Sequence
from fractions import Fraction
from typing import NamedTuple

import numpy as np
import xarray as xr
from flint import arb

from extensions.proofs.enclosure.jets import Jet, algebra
from extensions.proofs.enclosure.surface import Surface
from extensions.proofs.search.horseshoe import directions
from extensions.proofs.search.periodic import polished
from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.variables import chart, states_of
from pseudorigid.verified.flight import NotProvedError

_NEWTON_STEPS = 30  # of the search for a crossing, at most; each doubles the digits
_SADDLE_STEPS = 9  # of Newton's method for a saddle, from doubles to 20,000 bits
_SCAN_POINTS = 64  # parameters of an unstable segment at which a crossing is looked for
_SCAN_END = 1e-6  # where that segment ends, as a distance from the saddle in the plane (x, y)
# Periods for which a branch is followed from _SCAN_END. If the multiplier is above 1.26, the branch
# has then grown to order one.
_MAX_PERIODS = 60
_CROSSING_BITS = 160  # of the parameter at which an orbit meets y = 0: 48 digits, 25 are shown
_TANGENT = algebra(1, 1)  # jets of a value and its derivative along a tangent

Vector = tuple[arb, ...]


class Saddle(NamedTuple):
    """A point of a hyperbolic periodic orbit, and its unstable direction, in the plane (x, y).

    Numbers are rounded to flint's working precision. The direction has length one, and points
    outwards at the orbit's first point; the map carries it to the others. The energy, k and g are
    taken as the decimals that they print as.
    """

    ball: Ball
    surface: Surface
    period: int
    point: Vector
    direction: Vector
    multiplier: arb


def saddles_of(ball: Ball, energy: float, orbit: xr.Dataset) -> list[Saddle]:
    """Return each point of a hyperbolic orbit to the working precision, refined from doubles.

    Raises ValueError for an orbit that is not proved to be hyperbolic.
    """
    k, g, exact_energy = (Fraction(repr(float(a))) for a in (ball.k, ball.g, energy))
    surface, doubles = Surface(k, g, exact_energy), chart(ball.k, *states_of(orbit)).T.tolist()
    points: list[Sequence[arb]] = [*polished(surface, doubles, _SADDLE_STEPS)]
    try:
        rho, vectors = directions(surface, points, side=1)
    except NotProvedError as error:
        raise ValueError(str(error)) from None
    saddles = []
    for point, (ex, ey) in zip(points, vectors, strict=True):
        length = (ex * ex + ey * ey).sqrt()
        unit = (ex / length).mid(), (ey / length).mid()
        multiplier = (rho ** len(points)).mid()
        saddles.append(Saddle(ball, surface, len(points), tuple(point), unit, multiplier))
    return saddles


def flight(surface: Surface, x: Jet, y: Jet) -> tuple[Jet, Jet, arb]:
    """Return the image (x, y) of a point with a tangent vector, and the action of its flight.

    Raises UndecidedError, an ArithmeticError, if the precision is too low to enclose the flight.
    """
    k, g, _ = surface.constants()
    image = surface.impact(x, y)
    assert isinstance(image.x, Jet) and isinstance(image.y, Jet) and isinstance(image.tau, Jet)
    start, tau = surface.flight(x.constant, y.constant), image.tau.constant
    b, c, position = start.b, start.c, start.x
    sine, cosine = tau.sin_cos()
    mixed = sine * cosine
    # as `action` of the derivations' symbols, with the terms in another order
    action = tau * (b * b + tau * g * (b + g * tau / 3)) + k * (
        (position * position * (tau - mixed) + c * c * (tau + mixed)) / 2
        + position * c * sine * sine
    )
    return image.x, image.y, action


class Heteroclinic:
    """An orbit on a branch of a saddle that meets y = 0, where the reversor mirrors it.

    The branch leaves the saddle along its direction if `sign` is 1, and against it if -1.
    `parameter`, the distance of the orbit's start from the saddle, is refined so that the orbit
    meets y = 0 after `impacts`. The attributes are the `points` (x, y) from the start to y = 0, the
    `actions` of the flights between them, and the branch's `tangent` at y = 0. Raises ValueError if
    Newton's method does not find the crossing, and ArithmeticError if the precision is too low.
    """

    def __init__(self, saddle: Saddle, sign: int, parameter: arb, impacts: int):
        small = arb(2) ** -_CROSSING_BITS
        for _ in range(_NEWTON_STEPS):
            self._propagate(saddle, sign, parameter, impacts)
            step = (self.points[-1][1] / self.tangent[1]).mid()
            parameter = (parameter - step).mid()
            if abs(step) < abs(parameter) * small:
                break
        else:
            if not abs(self.points[-1][1] / self.tangent[1]).rad() < abs(parameter) * small:
                raise ArithmeticError("the crossing is not enclosed: more bits are needed")
            raise ValueError("Newton's method does not find the crossing with y = 0")
        self._propagate(saddle, sign, parameter, impacts)
        self.impacts = impacts

    def _propagate(self, saddle: Saddle, sign: int, parameter: arb, impacts: int) -> None:
        """Set the points, actions and tangent of the orbit that starts at a parameter."""
        x, y = (
            Jet(_TANGENT, [a + parameter * (sign * e), sign * e])
            for a, e in zip(saddle.point, saddle.direction, strict=True)
        )
        self.points = [(x.coefficients[0], y.coefficients[0])]
        self.actions: list[arb] = []
        for _ in range(impacts):
            x, y, action = flight(saddle.surface, x, y)
            self.points.append((x.coefficients[0], y.coefficients[0]))
            self.actions.append(action)
        self.tangent = x.coefficients[1], y.coefficients[1]

    def sine(self) -> arb:
        """Return the sine of the angle from the unstable arc to its mirror image, a stable arc."""
        x, y = self.tangent
        return -2 * x * y / (x * x + y * y)

    def action(self, index: int) -> arb:
        """Return the action of flight 0 to 2 impacts - 1; the reversor gives those after y = 0."""
        return self.actions[min(index, 2 * self.impacts - index - 1)]


# A crossing of a branch with y = 0: its orbit's initial distance from the saddle, and the impacts
# from there.
Crossing = tuple[float, int]
PrimaryPair = tuple[Heteroclinic, Heteroclinic]  # the orbits of the two crossings of `lobe`


def lobe(saddle: Saddle, sign: int, periods_earlier: int) -> tuple[arb, PrimaryPair]:
    """Return the area of the lobe between two neighbouring crossings, and the orbits there.

    The lobe lies between an unstable branch and its mirror image in y = 0. The branch leaves the
    saddle, of even period, on the side `sign`, and leads to the saddle's mirror image. One crossing
    with y = 0 is its own, the other that of its image half a period later. Both orbits start on the
    branch's tangent, `periods_earlier` periods before the last fundamental segment within _SCAN_END
    of the saddle. This changes the area by the cube of their distance from the saddle, an error
    that the enclosure does not include. Raises ValueError if a crossing is not found, and
    ArithmeticError if the precision is too low.
    """
    first = first_crossing(saddle, sign, 0)
    second = first_crossing(saddle, sign, saddle.period // 2)
    if first is None or second is None:
        raise ValueError("the branch does not meet y = 0")
    try:
        return _lobe_between(saddle, sign, periods_earlier, first, second)
    except ValueError:  # the branch bends strongly: Newton's method needs a better start
        refined = [_refined(saddle, sign, *crossing) for crossing in (first, second)]
        return _lobe_between(saddle, sign, periods_earlier, *refined)


def _lobe_between(
    saddle: Saddle, sign: int, periods_earlier: int, first: Crossing, second: Crossing
) -> tuple[arb, PrimaryPair]:
    """Return the area between the orbits of two crossings, and these orbits; see `lobe`."""
    (start, impacts), (other_start, other_impacts) = first, second
    ratio, period = float(saddle.multiplier), saddle.period
    # the second orbit starts in the fundamental segment that ends where the first one starts
    while other_start >= start:
        other_start, other_impacts = other_start / ratio, other_impacts + period
    while other_start * ratio < start:
        other_start, other_impacts = other_start * ratio, other_impacts - period
    shrink = saddle.multiplier**periods_earlier
    orbit, other = (
        Heteroclinic(saddle, sign, (arb(begin) / shrink).mid(), n + periods_earlier * period)
        for begin, n in ((start, impacts), (other_start, other_impacts))
    )
    # y dx around the lobe: along the unstable arc one way, along the stable one back
    flights = 2 * min(orbit.impacts, other.impacts)
    area = _line_integral(orbit.points[0], other.points[0])
    for index in range(flights):
        area += other.action(index) - orbit.action(index)
    # Both orbits are now near the other saddle, at mirror images of points near their starts. The
    # mirror reverses y and the direction, so that this integral has the sign of the first one.
    begin, end = (each.points[2 * each.impacts - flights] for each in (orbit, other))
    return abs(area + _line_integral(begin, end)), (orbit, other)


def _line_integral(begin: Vector, end: Vector) -> arb:
    """Return the integral of y dx along the straight line between two points."""
    return (begin[1] + end[1]) / 2 * (end[0] - begin[0])


def first_crossing(saddle: Saddle, sign: int, impacts: int) -> Crossing | None:
    """Find, in doubles, where a branch first meets y = 0 after `impacts` and some whole periods.

    The crossing's orbit starts in the branch's last fundamental segment within _SCAN_END of the
    saddle. Returns None if no image of this segment over _MAX_PERIODS periods meets y = 0.
    """
    ball, parameters = saddle.ball, _scan_parameters(saddle)
    states = _images(saddle, sign, parameters, impacts)
    for _ in range(_MAX_PERIODS):
        crossings = _crossings(ball, states)
        if crossings.size:
            return float(parameters[crossings[0]]), impacts
        states = ball.after(states, saddle.period)[:3]
        impacts += saddle.period
    return None


def _crossings(ball: Ball, states: np.ndarray) -> np.ndarray:
    """Return the indices of the states after which y changes its sign."""
    _, y = chart(ball.k, *states)
    return np.flatnonzero(y[1:] * y[:-1] <= 0.0)


def _scan_parameters(saddle: Saddle) -> np.ndarray:
    """Return parameters over the last fundamental segment within _SCAN_END of the saddle."""
    ratio = 1.0 / float(saddle.multiplier)
    return _SCAN_END * (ratio + (1.0 - ratio) * np.arange(_SCAN_POINTS + 1) / _SCAN_POINTS)


def _images(saddle: Saddle, sign: int, parameters: np.ndarray, impacts: int) -> np.ndarray:
    """Return the states, in doubles, that points of the branch's tangent reach after `impacts`."""
    ball = saddle.ball
    x, y = (
        float(a) + sign * parameters * float(e)
        for a, e in zip(saddle.point, saddle.direction, strict=True)
    )
    return ball.after(ball.state_xy(x, y, float(saddle.surface.energy)), impacts)[:3]


def _refined(saddle: Saddle, sign: int, parameter: float, impacts: int) -> Crossing:
    """Refine a crossing of `first_crossing` by three finer scans of its cell of the segment."""
    scanned = _scan_parameters(saddle)
    low, high = parameter, parameter + (scanned[1] - scanned[0])
    for _ in range(3):
        parameters = low + (high - low) * np.arange(_SCAN_POINTS + 1) / _SCAN_POINTS
        crossings = _crossings(saddle.ball, _images(saddle, sign, parameters, impacts))
        if not crossings.size:  # the sign change was made by rounding, or by a jump of the map
            break
        low, high = parameters[crossings[0]], parameters[crossings[0] + 1]
    return float(low), impacts
