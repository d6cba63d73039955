"""Ends of families where an impact grazes, and orbits beyond them."""

import math

import numpy as np

from ...kernel.arithmetic import quadrant
from ...kernel.flight import gap
from ...kernel.impact import impact_coefficients, rebound
from .asymmetric import (
    FLIGHTS,
    NO_GUESS,
    POINTS,
    ROOM,
    SLOWEST,
    AsymmetricOrbits,
    evaluate_orbit,
    flight_heights,
)
from .curve import Place, Point, correct, cross, dot, tangent
from .families import COLLAPSED, End
from .half_orbit import FIX_RP, H_P, LOWEST_SPEED, SIZE, H, evaluate, touches
from .symmetric import Orbits

_SLOW = 1e-3  # contact speed, in units where g = 1, of an impact that all but grazes
# Contact speeds, over the largest one, at which an orbit is entered whose new impact is slow.
_SPEEDS = 1e-2, 1e-3, 1e-4, 1e-5
_DIFFERENCE = 1e-10  # for derivatives of the way to an orbit with a slow impact
_ROUNDING = 1e-14  # of a value, over its gradient
_NEWTON_STEPS = 20
_ASTRAY = 0.05  # longest Newton step towards an orbit without a slow impact, in section radii
_FAR = 1e-4  # a touch farther than this from the last point of a curve is another one


def grazing(system: Orbits | AsymmetricOrbits, last: Point) -> End:
    """Return the grazing end that is next to the last point of a blocked curve.

    It is a touch, where a flight meets the floor without an impact and is solved for, or at the
    rim, where the speed of an impact vanishes.
    """
    if isinstance(system, AsymmetricOrbits):
        if float(last.data[SLOWEST]) < 2.0 * _SLOW:
            return End("rim", last.p, last.q, point=last)
        touched = _asymmetric_touch(system, last)
        return touched or End("unresolved", last.p, last.q, point=last)
    k, rho = system.parameter.k_and_rho(last.p)
    times = system.times(last)
    heights = np.empty((times.size, 2))
    touches(system.line, system.period, k, rho, last.q, times, np.full(times.size, np.nan), heights)
    speed = float(last.data[LOWEST_SPEED])
    flight = int(np.nanargmax(heights[:, 1])) if np.any(~np.isnan(heights[:, 1])) else -1
    height = -float(heights[flight, 1]) if flight >= 0 else math.inf
    if 0.5 * speed * speed < height:
        return End("rim", last.p, last.q, point=last)
    end = _touch(system, last, times, flight, float(heights[flight, 0]))
    if end is not None:
        return end
    kind = "rim" if speed < _SLOW else "unresolved"
    return End(kind, last.p, last.q, impact=flight, point=last)


def _asymmetric_touch(system: AsymmetricOrbits, last: Point) -> End | None:
    """Solve for the orbit without symmetry of which a flight touches the floor."""
    period, kind = system.period, system.parameter.kind
    times = last.data[FLIGHTS : FLIGHTS + period].copy()
    near, heights, out = np.full(period, np.nan), np.empty((period, 2)), np.empty(ROOM)
    place = last.place
    k, rho = system.parameter.k_and_rho(last.p)
    flight_heights(k, rho, *place[:2], times, near, heights)
    if np.all(np.isnan(heights[:, 1])):
        return None
    flight = int(np.nanargmax(heights[:, 1]))
    near[flight] = heights[flight, 0]

    def values(place: Place) -> Place:
        k, rho = system.parameter.k_and_rho(place[2])
        evaluate_orbit(period, kind, k, rho, *place[:2], times, out)
        found = out[FLIGHTS : FLIGHTS + period].copy()
        flight_heights(k, rho, *place[:2], found, near, heights)
        x, y = out[POINTS + 2 * period : POINTS + 2 * period + 2].tolist()
        return x - place[0], y - place[1], float(heights[flight, 1])

    least, best = math.inf, place
    for _ in range(30):
        at = values(place)
        error = sum(map(abs, at))
        if error < least:
            least, best = error, place
        elif least < 1e-12:
            break
        columns: list[list[float]] = []
        for i in range(3):
            step = 1e-7 * (place[2] if i == 2 else 1.0)
            moved = values(tuple(z + step * (i == j) for j, z in enumerate(place)))
            columns.append([(b - a) / step for a, b in zip(at, moved, strict=True)])
        first, second, third = (tuple(row) for row in zip(*columns, strict=True))
        vectors = cross(second, third), cross(third, first), cross(first, second)
        determinant = dot(first, vectors[0])
        if not 0.0 < abs(determinant) < math.inf:
            return None
        place = tuple(
            z - sum(h * vector[i] for h, vector in zip(at, vectors, strict=True)) / determinant
            for i, z in enumerate(place)
        )
        if not all(abs(a - b) < _FAR for a, b in zip(place, last.place, strict=True)):
            return None
    # The largest gradients, times the rounding of the place, are the rounding of the values.
    if not least < max(1e-11, _ROUNDING * sum(abs(x) for row in columns for x in row)):
        return None
    values(best)
    point = last._replace(place=best, data=out.copy())
    return End("touch", best[2], best[0], impact=flight, point=point)


def _touch(system: Orbits, last: Point, times: np.ndarray, flight: int, at: float) -> End | None:
    """Solve for the orbit of which a flight touches the floor, from a point next to it."""
    near = np.full(times.size, np.nan)
    near[flight] = at
    heights = np.empty((times.size, 2))
    out = np.empty(SIZE)

    def values(q: float, p: float) -> tuple[float, float]:
        k, rho = system.parameter.k_and_rho(p)
        evaluate(system.line, system.period, system.parameter.kind, k, rho, q, times, out)
        h = float(out[H])
        found = system.times_in(out).copy()
        touches(system.line, system.period, k, rho, q, found, near, heights)
        return h, float(heights[flight, 1])

    q, p = last.q, last.p
    if system.line == FIX_RP and flight == 0 and at == 0.0:  # the ball is at rest on the floor
        q = math.copysign(1.0, q)
        for _ in range(20):
            h = values(q, p)[0]
            step = -h / float(out[H_P])
            p += step
            if abs(step) < 1e-15 * p:
                break
        return _touched(system, last, q, p, flight, times, out)
    least = math.inf
    best = q, p
    for _ in range(30):
        h, height = values(q, p)
        error = abs(h) + abs(height)
        if error < least:
            least, best = error, (q, p)
        elif least < 1e-12:
            break
        dq, dp = 1e-7, 1e-7 * p
        h1, height1 = values(q + dq, p)
        h2, height2 = values(q, p + dp)
        a, b, c, d = (h1 - h) / dq, (h2 - h) / dp, (height1 - height) / dq, (height2 - height) / dp
        det = a * d - b * c
        if det == 0.0:
            return None
        q, p = q - (d * h - b * height) / det, p - (a * height - c * h) / det
        if not (abs(q - last.q) < _FAR and abs(p - last.p) < _FAR * last.p):
            return None
    if least > max(1e-12, _ROUNDING * (abs(a) + abs(c) + p * (abs(b) + abs(d)))):
        return None
    values(*best)
    return _touched(system, last, *best, flight, times, out)


def _touched(system, last, q, p, flight, times, out) -> End | None:
    if not (abs(q - last.q) < _FAR and abs(p - last.p) < _FAR * last.p):
        return None
    point = last._replace(place=(q, p), data=out.copy())
    return End("touch", p, q, impact=flight, point=point)


def entered(system: AsymmetricOrbits, place: Place) -> Point | None:
    """Return the orbit next to a place, at its point that is farthest from the rim, or None."""
    point = system.point(place)
    if point is None or not max(map(abs, point.defect)) < _FAR:
        return None
    point = system.point((*system.innermost(point), place[2]))
    along = tangent(system, point) if point is not None else (math.nan,)
    if not all(map(math.isfinite, along)):
        return None
    start = correct(system, point.place, along, _FAR)
    return start if start is not None and system.separation(start) > COLLAPSED else None


def beyond_rim(
    system: AsymmetricOrbits, longer: AsymmetricOrbits, point: Point, levels: list[float]
) -> list[Point]:
    """Return orbits that lack the slowest impact of a longer one, at values of the parameter."""
    period, points = system.period, longer.orbit(point)
    slowest = int(np.argmax(np.sum(points * points, axis=1)))
    place = points[(slowest + 1) % longer.period]
    times = np.roll(point.data[FLIGHTS : FLIGHTS + longer.period], -slowest - 1)
    times = np.append(times[: period - 1], times[period - 1] + times[period])
    out, found = np.empty(ROOM), []
    for p in levels:
        k, rho = system.parameter.k_and_rho(p)
        x, y = place.tolist()
        for _ in range(_NEWTON_STEPS):
            if not x * x + y * y < 1.0:
                break
            evaluate_orbit(period, system.parameter.kind, k, rho, x, y, times, out)
            a, c, b, d = out[:4].tolist()
            a, d = a - 1.0, d - 1.0
            gap_x, gap_y = (out[POINTS + 2 * period : POINTS + 2 * period + 2] - (x, y)).tolist()
            determinant = a * d - b * c
            if not 0.0 < abs(determinant) < math.inf:
                break
            step = (b * gap_y - d * gap_x) / determinant, (c * gap_x - a * gap_y) / determinant
            x, y = float(x + step[0]), float(y + step[1])
            if not max(map(abs, step)) < _ASTRAY:
                break
            if max(map(abs, step)) < 1e-10:
                start = entered(system, (x, y, p))
                found += [start] if start is not None else []
                break
    return found


def beyond_touch(system: AsymmetricOrbits, place: Place, symmetric: bool) -> list[Point]:
    """Return orbits with one impact more than one that touches the floor, next to the touch.

    `place` is on a touching orbit of period n - 1, where n is the period of `system`. A symmetric
    orbit must touch the floor in two flights. Where the new impact is slow, its point is next to
    the section's rim. From there n - 1 impacts ahead, and one impact back in time, must lead to the
    same point: both depend smoothly on the contact speed, although P^n does not.
    """
    period, kind = system.period - 1, system.parameter.kind
    out, back, heights = np.empty(ROOM), np.empty(ROOM), np.empty((period, 2))
    at_x, at_y, p = place
    k, rho = system.parameter.k_and_rho(p)
    evaluate_orbit(period, kind, k, rho, at_x, at_y, NO_GUESS, out)
    times = out[FLIGHTS : FLIGHTS + period].copy()
    points = out[POINTS : POINTS + 2 * period].reshape(-1, 2).copy()
    flight_heights(k, rho, at_x, at_y, times, np.full(period, np.nan), heights)
    (flights,) = np.nonzero(heights[:, 1] > -_FAR)
    if flights.size < (2 if symmetric else 1):
        return []
    flight = int(flights[0])
    at = float(heights[flight, 0])
    unit = _rim_point(k, rho, *points[flight].tolist(), at)
    ahead = np.roll(times, -flight)
    ahead[0] -= at

    def on_rim(turn: float, speed: float) -> tuple[float, float]:
        size = math.sqrt((1.0 - speed) * (1.0 + speed)) / (1.0 + turn * turn)
        cosine, sine = size * (1.0 - turn) * (1.0 + turn), size * 2.0 * turn
        return cosine * unit[0] - sine * unit[1], cosine * unit[1] + sine * unit[0]

    def mismatch(turn: float, p: float, speed: float) -> tuple[float, float]:
        x, y = on_rim(turn, speed)
        k, rho = system.parameter.k_and_rho(p)
        evaluate_orbit(period, kind, k, rho, x, y, ahead, out)
        evaluate_orbit(1, kind, k, rho, x, -y, np.array([at]), back)
        x, y = out[POINTS + 2 * period : POINTS + 2 * period + 2].tolist()
        return x - float(back[POINTS + 2]), y + float(back[POINTS + 3])

    found = []
    for speed in _SPEEDS:
        turn, p = 0.0, place[2]
        for _ in range(_NEWTON_STEPS):
            x, y = mismatch(turn, p, speed)
            x1, y1 = mismatch(turn + _DIFFERENCE, p, speed)
            x2, y2 = mismatch(turn, p * (1.0 + _DIFFERENCE), speed)
            a, b, c, d = x1 - x, x2 - x, y1 - y, y2 - y
            determinant = a * d - b * c
            if not 0.0 < abs(determinant) < math.inf:
                break
            step, part = (b * y - d * x) / determinant, (c * x - a * y) / determinant
            turn, p = turn + _DIFFERENCE * step, p * (1.0 + _DIFFERENCE * part)
            if not (abs(turn) < 0.1 and system.limits[0] < p < system.limits[1]):
                break
            if abs(step) + abs(part) < 1.0:
                start = entered(system, (*on_rim(turn, speed), p))
                found += [start] if start is not None else []
                break
    return found


def _rim_point(k: float, rho: float, at_x: float, at_y: float, t: float) -> tuple[float, float]:
    """Return the point of the rim where the flight from (X, Y) touches the floor after a time."""
    unit_y = math.sqrt((1.0 + k) / k)
    rest = math.sqrt(1.0 - at_x * at_x - at_y * at_y)
    x, y, s = (1.0 + rho * at_x) / k, rho * unit_y * at_y, rho * math.sqrt(1.0 + k) / k * rest
    b, c, s = rebound((y + k * s) / (1.0 + k), (s - y) / (1.0 + k), k, impact_coefficients(k))
    position = gap(t, x, b, c, s, 1.0, quadrant(t))[3]
    X, Y = (k * position - 1.0) / rho, (1.0 + k) * (b + t) / (rho * unit_y)
    size = math.sqrt(X * X + Y * Y)
    return X / size, Y / size
