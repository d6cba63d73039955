"""Starts of families without symmetry: beside events of other ones, and beyond grazings."""

import math
from typing import NamedTuple

import numpy as np

from pseudorigid.kernel.arithmetic import sincos
from pseudorigid.kernel.impact import impact_coefficients, rebound

from .asymmetric import AsymmetricOrbits, evaluate_orbit, state_at
from .curve import Place, Point, correct, dot, newton_step, tangent
from .family import FAR, Event, OrbitSystem
from .half_orbit import gap
from .symmetric import COLLAPSED, NO_GUESS, Parameter

_ASIDE = 3e-3  # distance from an event, in section radii, at which its branch is entered
_FARTHER = 1.0, 3.0, 9.0  # that distance at resonances, in this unit
_ANGLES = 12  # per branch, at which branches of a resonance are sought
_NEWTON_STEPS = 8  # at resonances
_UNTURNED = 1e-10  # largest angle from its ray, in radians, of a point that stays on it
# Contact speeds, over the largest one, at which an orbit is entered whose new impact is slow.
_SPEEDS = 1e-2, 1e-3, 1e-4, 1e-5
_DIFFERENCE = 1e-10  # for derivatives of the way to an orbit with a slow impact
_STEPS_BEYOND = 20  # of Newton's method
_ASTRAY = 0.05  # longest Newton step towards an orbit without a slow impact, in section radii

Vector = tuple[float, float]


def starts_beside(system: AsymmetricOrbits, parent: OrbitSystem, event: Event) -> list[Point]:
    """Return orbits of a system beside the event of another one at which they branch off."""
    if event.kind == "resonance":
        return _beside_resonance(system, event)
    if event.kind == "doubling":
        place = event.point.place
        (a, c), (b, d), _ = event.point.data.derivatives.tolist()  # of P^n
        a, d = a + 1.0, d + 1.0
    else:  # a pitchfork
        point = _innermost(system, system.point(parent.first_place(event.point)))
        if point is None:
            return []
        place, ((a, b, _), (c, d, _)) = point.place, point.gradients
    # A null vector of the singular matrix with the rows (a, b) and (c, d).
    across = (b, -a) if abs(a) + abs(b) > abs(c) + abs(d) else (d, -c)
    return _aside(system, place, across, _ASIDE, _ASIDE)


def _innermost(system: AsymmetricOrbits, point: Point | None) -> Point | None:
    """Return an orbit from its point farthest from the rim, where derivatives are bounded."""
    return system.point((*system.innermost(point), point.p)) if point is not None else None


def _aside(
    system: AsymmetricOrbits, place: Place, across: Vector, distance: float, radius: float
) -> list[Point]:
    """Return the orbit at a distance from a place in a direction, unless it is more symmetric."""
    size = math.sqrt(dot(across, across))
    if not 0.0 < size < math.inf:
        return []
    along = (across[0] / size, across[1] / size, 0.0)
    x, y, p = place
    beside = (x + distance * along[0], y + distance * along[1], p)
    return _separate(system, correct(system, beside, along, radius))


def _separate(system: AsymmetricOrbits, start: Point | None) -> list[Point]:
    """Return an orbit in a list, which is empty if it is missing, shorter or more symmetric."""
    return [start] if start is not None and system.separation(start) > COLLAPSED else []


def _beside_resonance(system: AsymmetricOrbits, event: Event) -> list[Point]:
    """Return orbits of q times the period beside a resonance p/q.

    At each point of a small ellipse around the parent, which the linearized map keeps, the
    parameter is chosen so that P^n brings the point back to its ray. Between two points that P^n
    moves in opposite directions along their rays is an orbit.
    """
    a, c = event.point.data.derivatives[0].tolist()  # of the parent's map
    sine, cosine = sincos(2.0 * math.pi * event.turns / event.order)
    conjugate = (a - cosine) / sine, c / sine
    size = _ASIDE / math.sqrt(1.0 + dot(conjugate, conjugate))
    found = []
    for radius in (size * factor for factor in _FARTHER):
        before = math.nan
        for i in range(2 * _ANGLES + 1):
            sine, cosine = sincos(math.pi * i / (_ANGLES * event.order))
            # to the ellipse, and along it to the next quarter
            outward = radius * (cosine + sine * conjugate[0]), radius * sine * conjugate[1]
            around = radius * (cosine * conjugate[0] - sine), radius * cosine * conjugate[1]
            way, place = _way_along_ray(system, event.point, outward, around)
            if way * before < 0.0:
                found += _aside(system, place, outward, 0.0, math.sqrt(dot(outward, outward)))
            before = way
    return found


def _way_along_ray(
    system: AsymmetricOrbits, parent: Point, outward: Vector, around: Vector
) -> tuple[float, Place]:
    """Return how far P^n moves a point along its ray, and the place where it stays on the ray.

    The first result is NaN if there is no such place.
    """
    ((a, b, x_p), (c, d, y_p)), (x, y, p) = parent.gradients, parent.place
    drift = newton_step([(a, b), (c, d)], (x_p, y_p))
    wedge = outward[0] * around[1] - outward[1] * around[0]
    if drift is None or wedge == 0.0:
        return math.nan, parent.place
    for _ in range(_NEWTON_STEPS):
        at_x = x + (p - parent.p) * drift[0] + outward[0]
        at_y = y + (p - parent.p) * drift[1] + outward[1]
        if not at_x * at_x + at_y * at_y < 1.0:
            break
        whole, (dx, dy) = system.tracked((at_x, at_y, p), NO_GUESS)
        (a, c), (b, d), (x_p, y_p) = whole.derivatives.tolist()
        x_p += (a - 1.0) * drift[0] + b * drift[1]
        y_p += c * drift[0] + (d - 1.0) * drift[1]
        turned = (outward[0] * dy - outward[1] * dx) / wedge
        rate = (outward[0] * y_p - outward[1] * x_p) / wedge
        if abs(turned) < _UNTURNED:
            return (around[1] * dx - around[0] * dy) / wedge, (at_x, at_y, p)
        if not 0.0 < abs(rate) < math.inf:
            break
        p -= turned / rate
        if not abs(p - parent.p) < 0.05 * system.scale:
            break
    return math.nan, parent.place


def _entered(system: AsymmetricOrbits, place: Place) -> list[Point]:
    """Return the orbit next to a place, if any, starting at its point farthest from the rim."""
    point = system.point(place)
    if point is None or not max(map(abs, point.defect)) < FAR:
        return []
    point = _innermost(system, point)
    if point is None:
        return []
    along = tangent(system, point)
    if not all(map(math.isfinite, along)):
        return []
    return _separate(system, correct(system, point.place, along, FAR))


def beyond_rim(system: AsymmetricOrbits, longer: Point, levels: list[float]) -> list[Point]:
    """Return orbits that lack the slowest impact of a longer one, at values of the parameter."""
    points, times = longer.data.points[:-1], longer.data.times
    slowest = int(np.argmax(np.sum(points * points, axis=1)))
    x, y = points[(slowest + 1) % len(points)].tolist()
    *times, before, after = np.roll(times, -slowest - 1)
    times = np.array([*times, before + after])
    found = []
    for p in levels:
        place = _with_flight_times(system, (x, y, p), times)
        if place is not None:
            found += _entered(system, place)
    return found


def _with_flight_times(system: AsymmetricOrbits, place: Place, times: np.ndarray) -> Place | None:
    """Return the place of the orbit with about these times of flight at a parameter, or None."""
    x, y, p = place
    for _ in range(_STEPS_BEYOND):
        if not x * x + y * y < 1.0:
            return None
        whole, defect = system.tracked((x, y, p), times)
        (a, c), (b, d), _ = whole.derivatives.tolist()
        step = newton_step([(a - 1.0, b), (c, d - 1.0)], defect)
        if step is None:
            return None
        x, y = x + step[0], y + step[1]
        size = max(map(abs, step))
        if size < 1e-10:
            return x, y, p
        if not size < _ASTRAY:
            return None
    return None


class _Touch(NamedTuple):
    """A flight that touches the floor, in which an orbit nearby has another, slow impact.

    Where this impact is slow its point is next to the section's rim. From there n - 1 impacts
    ahead, and one impact back in time, must lead to the same point: both depend smoothly on the
    contact speed, although P^n does not.
    """

    parameter: Parameter
    rim: Vector  # the point of the rim at the touch
    times: np.ndarray  # (n - 1,) of the flights from the touch on
    before: float  # time from the last impact to the touch

    def point(self, turn: float, speed: float) -> Vector:
        """Return the point at an angle from the touch, with a contact speed over the largest."""
        size = math.sqrt((1.0 - speed) * (1.0 + speed)) / (1.0 + turn * turn)
        cosine, sine = size * (1.0 - turn) * (1.0 + turn), size * 2.0 * turn
        x, y = self.rim
        return cosine * x - sine * y, cosine * y + sine * x

    def mismatch(self, turn: float, p: float, speed: float) -> Vector:
        """Return by how much the ways ahead and back from the slow impact miss each other."""
        x, y = self.point(turn, speed)
        kind, (k, rho) = self.parameter.kind, self.parameter.k_and_rho(p)
        ahead = evaluate_orbit(self.times.size, kind, k, rho, x, y, self.times)
        back = evaluate_orbit(1, kind, k, rho, x, -y, np.array([self.before]))
        (x, y), (back_x, back_y) = ahead.points[-1].tolist(), back.points[-1].tolist()
        return x - back_x, y + back_y

    def solved(self, p: float, speed: float) -> tuple[float, float] | None:
        """Return angle and parameter, next to a given one, at which both ways meet, or None."""
        turn = 0.0
        for _ in range(_STEPS_BEYOND):
            x, y = self.mismatch(turn, p, speed)
            x1, y1 = self.mismatch(turn + _DIFFERENCE, p, speed)
            x2, y2 = self.mismatch(turn, p * (1.0 + _DIFFERENCE), speed)
            step = newton_step([(x1 - x, x2 - x), (y1 - y, y2 - y)], (x, y))
            if step is None:
                return None
            turn, p = turn + _DIFFERENCE * step[0], p * (1.0 + _DIFFERENCE * step[1])
            if not (abs(turn) < 0.1 and self.parameter.low < p < self.parameter.high):
                return None
            if sum(map(abs, step)) < 1.0:
                return turn, p
        return None


def beyond_touch(system: AsymmetricOrbits, place: Place, symmetric: bool) -> list[Point]:
    """Return orbits with one impact more than one that touches the floor, next to the touch.

    `place` is on a touching orbit of period n - 1, where n is the period of `system`. A symmetric
    orbit must touch the floor in two flights.
    """
    at_x, at_y, p = place
    k, rho = system.parameter.k_and_rho(p)
    orbit = evaluate_orbit(system.period - 1, system.parameter.kind, k, rho, at_x, at_y, NO_GUESS)
    heights = system.heights(place, orbit.times, np.full(orbit.times.size, np.nan))
    (flights,) = np.nonzero(heights[:, 1] > -FAR)
    if flights.size < (2 if symmetric else 1):
        return []
    flight = int(flights[0])
    before = float(heights[flight, 0])
    x, y = orbit.points[flight].tolist()
    rim = _rim_point(k, rho, x, y, before)
    times = np.roll(orbit.times, -flight)
    times[0] -= before
    touch = _Touch(system.parameter, rim, times, before)
    found = []
    for speed in _SPEEDS:
        solution = touch.solved(p, speed)
        if solution is not None:
            turn, at_p = solution
            found += _entered(system, (*touch.point(turn, speed), at_p))
    return found


def _rim_point(k: float, rho: float, at_x: float, at_y: float, t: float) -> Vector:
    """Return the point of the rim where the flight from (X, Y) touches the floor after a time."""
    x, v, w = state_at(k, rho, at_x, at_y)
    b, c, s = rebound(v, w, k, impact_coefficients(k))
    _, _, _, position, _ = gap(t, x, b, c, s)
    X = (k * position - 1.0) / rho
    Y = (1.0 + k) * (b + t) / (rho * math.sqrt((1.0 + k) / k))
    size = math.sqrt(X * X + Y * Y)
    return X / size, Y / size
