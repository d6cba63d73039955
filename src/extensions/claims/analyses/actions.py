"""Heteroclinic orbits and the areas of lobes, by differences of action, to many digits.

Along an impact and a flight at constant energy, the one-form y dx, y = xdot - k udot, changes by
the differential of the action S, the integral of xdot^2 + k udot^2 over the flight. So the area
between an unstable and a stable arc with common ends is the sum, over the whole orbits of the two
ends, of the differences of S (MacKay, Meiss and Percival, Physica D 13, 1984). The terms nearly
cancel; they are therefore computed in ball arithmetic, whose radii enclose every rounding.
"""

from typing import NamedTuple

import numpy as np
import xarray as xr
from flint import arb

from extensions.proofs.checks.certificate import NotProvedError
from extensions.proofs.search.horseshoe import directions
from extensions.proofs.search.periodic import polished
from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.variables import chart, states_of
from study.enclosure.jets import Jet, algebra
from study.enclosure.surface import Surface

_NEWTON_STEPS = 30  # to a crossing, at most; each doubles the digits
_SADDLE_STEPS = 9  # of Newton's method from doubles, to 20,000 bits
_SCAN_POINTS = 64  # parameters of an unstable segment at which a crossing is looked for
_SCAN_END = 1e-6  # where that segment ends, as a distance from the saddle in the plane (x, y)
_MOST_IMAGES = 60  # a branch of a multiplier above 1.26 has then grown from there to order one
_CROSSING_BITS = 160  # of the parameter at which an orbit meets y = 0: 48 digits, 25 are shown
_TANGENT = algebra(1, 1)  # jets of a value and its derivative along a tangent

Vector = tuple[arb, ...]


class Saddle(NamedTuple):
    """A point of a hyperbolic periodic orbit, and its unstable direction, in the plane (x, y).

    Numbers are rounded to the working precision; the direction has length one. The energy, k and g
    are taken as the decimals that they print as.
    """

    ball: Ball
    surface: Surface
    period: int
    point: Vector
    direction: Vector
    multiplier: arb


def saddles_of(ball: Ball, energy: float, orbit: xr.Dataset) -> list[Saddle]:
    """Return the points of a hyperbolic orbit, given to double precision.

    Raises ValueError for an orbit that is not proved to be hyperbolic.
    """
    surface = Surface(*(repr(float(a)) for a in (ball.k, ball.g, energy)))
    points = polished(surface, chart(ball.k, *states_of(orbit)).T.tolist(), _SADDLE_STEPS)
    try:
        rho, vectors = directions(surface, points, 1)
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
    """Return the next impact of a point with a tangent vector, and the action of its flight.

    Raises UndecidedError, an ArithmeticError, if the precision does not enclose the flight.
    """
    k, g, _ = surface.constants()
    image = surface.impact(x, y)
    x, y, tau = (jet.constant for jet in (x, y, image.tau))
    s = surface.speed(x, y)
    b, c = (y - k * s) / (1 + k), -(y + s) / (1 + k)
    sine, cosine = tau.sin_cos()
    mixed = sine * cosine
    action = tau * (b * b + tau * g * (b + g * tau / 3)) + k * (
        (x * x * (tau - mixed) + c * c * (tau + mixed)) / 2 + x * c * sine * sine
    )
    return image.x, image.y, action


class Heteroclinic:
    """An orbit on a branch of a saddle that meets y = 0, where the reversor mirrors it.

    `sign` tells the branch along the saddle's direction from the one against it. `parameter`, the
    distance of the orbit's start from the saddle, is refined so that the orbit meets y = 0 after
    `impacts`. `points` are (x, y) up to there, `actions` those of the flights, and `tangent` is
    that of the branch at y = 0. Raises ValueError or ArithmeticError if Newton's method does not
    find the crossing, or the precision encloses too little.
    """

    def __init__(self, saddle: Saddle, sign: int, parameter: arb, impacts: int):
        small = arb(2) ** -_CROSSING_BITS
        for _ in range(_NEWTON_STEPS):
            self._follow(saddle, sign, parameter, impacts)
            step = (self.points[-1][1] / self.tangent[1]).mid()
            parameter = (parameter - step).mid()
            if abs(step) < abs(parameter) * small:
                break
        else:
            if not abs(self.points[-1][1] / self.tangent[1]).rad() < abs(parameter) * small:
                raise ArithmeticError("the crossing is not enclosed: more bits are needed")
            raise ValueError("Newton's method does not find the crossing with y = 0")
        self._follow(saddle, sign, parameter, impacts)
        self.impacts = impacts

    def _follow(self, saddle, sign, parameter, impacts):
        """Set the points, actions and tangent of the orbit that starts at a parameter."""
        x, y = (
            Jet(_TANGENT, [a + parameter * (sign * e), sign * e])
            for a, e in zip(saddle.point, saddle.direction, strict=True)
        )
        self.points, self.actions = [(x.constant, y.constant)], []
        for _ in range(impacts):
            x, y, action = flight(saddle.surface, x, y)
            self.points.append((x.constant, y.constant))
            self.actions.append(action)
        self.tangent = x.coefficients[1], y.coefficients[1]

    def sine(self) -> arb:
        """Return the sine of the angle from the unstable arc to its mirror image, the stable."""
        x, y = self.tangent
        return -2 * x * y / (x * x + y * y)

    def action(self, flight: int) -> arb:
        """Return the action of a flight, 0 to 2 impacts - 1; those after y = 0 by time reversal."""
        return self.actions[min(flight, 2 * self.impacts - flight - 1)]


def lobe(saddle: Saddle, sign: int, nearer: int) -> tuple[arb, tuple[Heteroclinic, Heteroclinic]]:
    """Return the area between neighbouring crossings of two branches, and the two primary orbits.

    The unstable branch on the side `sign` of a saddle of even period must lead to the mirror image
    of the saddle, so that it meets y = 0 on the way, and so must its image half a period later. The
    primary orbits start `nearer` images nearer to the saddle than _SCAN_END, on the branch's
    tangent instead of the branch. This changes the area by the cube of their distance from the
    saddle, which the ball does not contain. Raises ValueError or ArithmeticError as Heteroclinic
    does, and where the branch is not seen to meet y = 0.
    """
    crossings = [first_crossing(saddle, sign, offset) for offset in (0, saddle.period // 2)]
    if None in crossings:
        raise ValueError("the branch does not meet y = 0")
    try:
        return _lobe_between(saddle, sign, nearer, crossings)
    except ValueError:  # the branch bends strongly: Newton's method needs a better start
        refined = [_refined(saddle, sign, *crossing) for crossing in crossings]
        return _lobe_between(saddle, sign, nearer, refined)


def _lobe_between(saddle, sign, nearer, crossings):
    """Compute the lobe between two crossings, each a parameter and a number of impacts."""
    ratio, period = float(saddle.multiplier), saddle.period
    (near, impacts), (far, far_impacts) = crossings
    while far >= near:  # the crossing before that of the first orbit
        far, far_impacts = far / ratio, far_impacts + period
    while far * ratio < near:
        far, far_impacts = far * ratio, far_impacts - period
    shrink = saddle.multiplier**nearer
    first, second = (
        Heteroclinic(saddle, sign, (arb(parameter) / shrink).mid(), count + nearer * period)
        for parameter, count in ((near, impacts), (far, far_impacts))
    )
    # y dx around the lobe: along the unstable arc one way, along the stable one back
    flights = 2 * min(first.impacts, second.impacts)
    area = _area_under_line(first.points[0], second.points[0])
    for flight in range(flights):
        area += second.action(flight) - first.action(flight)
    # both orbits are near the other saddle now, at the mirror images of points at the start
    last = (orbit.points[2 * orbit.impacts - flights] for orbit in (first, second))
    return abs(area + _area_under_line(*last)), (first, second)


def _area_under_line(begin: Vector, end: Vector) -> arb:
    """Integral of y dx along a straight line."""
    return (begin[1] + end[1]) / 2 * (end[0] - begin[0])


def first_crossing(saddle: Saddle, sign: int, impacts: int) -> tuple[float, int] | None:
    """Find, in doubles, where a branch first meets y = 0 after `impacts` + m periods.

    Returns the parameter of its start, in the last segment before _SCAN_END from the saddle, and
    the impacts from there; None without a crossing in _MOST_IMAGES images.
    """
    ball, parameters = saddle.ball, _scan_parameters(saddle)
    states = _images(saddle, sign, parameters, impacts)
    for _ in range(_MOST_IMAGES):
        crossings = _crossings(ball, states)
        if crossings.size:
            return float(parameters[crossings[0]]), impacts
        states = ball.after(states, saddle.period)[:3]
        impacts += saddle.period
    return None


def _crossings(ball: Ball, states: np.ndarray) -> np.ndarray:
    """Indices of the states after which y changes its sign."""
    _, y = chart(ball.k, *states)
    return np.flatnonzero(y[1:] * y[:-1] <= 0.0)


def _scan_parameters(saddle: Saddle) -> np.ndarray:
    """Parameters of the last fundamental segment before _SCAN_END."""
    ratio = 1.0 / float(saddle.multiplier)
    return _SCAN_END * (ratio + (1.0 - ratio) * np.arange(_SCAN_POINTS + 1) / _SCAN_POINTS)


def _images(saddle: Saddle, sign: int, parameters: np.ndarray, impacts: int) -> np.ndarray:
    """States, in doubles, some impacts after the points of the branch's tangent."""
    ball = saddle.ball
    x, y = (
        float(a) + sign * parameters * float(e)
        for a, e in zip(saddle.point, saddle.direction, strict=True)
    )
    return ball.after(ball.state_xy(x, y, float(saddle.surface.energy)), impacts)[:3]


def _refined(saddle: Saddle, sign: int, parameter: float, impacts: int) -> tuple[float, int]:
    """Refine a crossing of `first_crossing` to a millionth of the distance scanned."""
    scanned = _scan_parameters(saddle)
    low, high = parameter, parameter + (scanned[1] - scanned[0])
    for _ in range(3):
        parameters = low + (high - low) * np.arange(_SCAN_POINTS + 1) / _SCAN_POINTS
        crossings = _crossings(saddle.ball, _images(saddle, sign, parameters, impacts))
        if not crossings.size:  # a jump of the map, or rounding, decides
            break
        low, high = parameters[crossings[0]], parameters[crossings[0] + 1]
    return float(low), impacts
