"""Ends of families where an impact grazes."""

import math

import numpy as np

from .asymmetric import (
    FLIGHTS,
    POINTS,
    ROOM,
    SLOWEST,
    AsymmetricOrbits,
    evaluate_orbit,
    flight_heights,
)
from .curve import Place, Point, cross, dot
from .families import End
from .half_orbit import FIX_RP, H_P, LOWEST_SPEED, SIZE, H, evaluate, touches
from .symmetric import Orbits

_SLOW = 1e-3  # contact speed, in units where g = 1, of an impact that all but grazes
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
        columns = []
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
    if not least < 1e-11:
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
    if least > 1e-12:
        return None
    values(*best)
    return _touched(system, last, *best, flight, times, out)


def _touched(system, last, q, p, flight, times, out) -> End | None:
    if not (abs(q - last.q) < _FAR and abs(p - last.p) < _FAR * last.p):
        return None
    point = last._replace(place=(q, p), data=out.copy())
    return End("touch", p, q, impact=flight, point=point)
