"""Ends of families where an impact grazes, and orbits beyond them."""

import math
from dataclasses import dataclass

import numpy as np

from ...kernel.arithmetic import quadrant
from ...kernel.flight import gap
from ...kernel.impact import impact_coefficients, rebound
from .asymmetric import (
    FLIGHTS,
    NO_LINE,
    POINTS,
    ROOM,
    AsymmetricOrbits,
    evaluate_orbit,
    state_at,
)
from .curve import Place, Point, correct, cramer, tangent
from .half_orbit import FIX_RP, H_P
from .symmetric import COLLAPSED, NO_GUESS, Orbits

_SLOW = 1e-3  # contact speed, in units where g = 1, of an impact that all but grazes
# Contact speeds, over the largest one, at which an orbit is entered whose new impact is slow.
_SPEEDS = 1e-2, 1e-3, 1e-4, 1e-5
_DIFFERENCE = 1e-10  # for derivatives of the way to an orbit with a slow impact
_ROUNDING = 1e-14  # of a value, over its gradient
_NEWTON_STEPS = 20
_ASTRAY = 0.05  # longest Newton step towards an orbit without a slow impact, in section radii
_FAR = 1e-4  # a touch farther than this from the last point of a curve is another one


@dataclass
class End:
    """How a family ends."""

    kind: str  # range, resonance, doubling, pitchfork, touch, rim, closed, unresolved
    p: float
    q: float
    family: int = -1  # the parent, or the family on the other side of the grazing
    turns: int = 0
    order: int = 0
    impact: int = -1  # the flight that touches, or the impact that grazes, along the half orbit
    point: Point | None = None


def grazing(system: Orbits | AsymmetricOrbits, last: Point) -> End:
    """Return the grazing end that is next to the last point of a blocked curve.

    It is a touch, where a flight meets the floor without an impact and is solved for, or at the
    rim, where the speed of an impact vanishes.
    """
    speed, times = system.speed(last), system.times(last.data)
    heights = system.heights(last.place, times, np.full(times.size, np.nan))
    touching = not np.all(np.isnan(heights[:, 1]))
    flight = int(np.nanargmax(heights[:, 1])) if touching else -1
    if system.line == NO_LINE:
        at_rim = speed < 2.0 * _SLOW
    else:
        at_rim = not touching or 0.5 * speed * speed < -float(heights[flight, 1])
    if at_rim:
        return End("rim", last.p, last.q, point=last)
    end = _touch(system, last, times, flight, float(heights[flight, 0])) if touching else None
    if end is not None:
        return end
    if system.line == NO_LINE:
        return End("unresolved", last.p, last.q, point=last)
    kind = "rim" if speed < _SLOW else "unresolved"
    return End(kind, last.p, last.q, impact=flight, point=last)


def _touch(
    system: Orbits | AsymmetricOrbits, last: Point, times: np.ndarray, flight: int, at: float
) -> End | None:
    """Solve for the orbit of which a flight touches the floor, from a point next to it."""
    near = np.full(times.size, np.nan)
    near[flight] = at

    def values(place: Place) -> Place:
        data, defect = system.tracked(place, times)
        heights = system.heights(place, system.times(data), near)
        return *defect, float(heights[flight, 1])

    place = last.place
    if system.line == FIX_RP and flight == 0 and at == 0.0:  # the ball is at rest on the floor
        q, p = math.copysign(1.0, last.q), last.p
        for _ in range(_NEWTON_STEPS):
            data, (defect,) = system.tracked((q, p), times)
            step = -defect / float(data[H_P])
            p += step
            if abs(step) < 1e-15 * p:
                break
        best = q, p
    else:
        least, best = math.inf, place
        for _ in range(30):
            here = values(place)
            error = sum(map(abs, here))
            if error < least:
                least, best = error, place
            elif least < 1e-12:
                break
            columns = []
            for i in range(len(place)):
                step = 1e-7 * (place[-1] if i == len(place) - 1 else 1.0)
                beside = values(tuple(z + step * (i == j) for j, z in enumerate(place)))
                columns.append([(b - a) / step for a, b in zip(here, beside, strict=True)])
            step = cramer(list(zip(*columns, strict=True)), here)
            if step is None:
                return None
            place = tuple(z + dz for z, dz in zip(place, step, strict=True))
            if not _is_next_to(place, last):
                return None
        # The largest gradients, times the rounding of the place, are the rounding of the values.
        scales = [max(1.0, abs(z)) for z in best]
        sizes = sum(z * abs(x) for z, row in zip(scales, columns, strict=True) for x in row)
        if not least < max(1e-11, _ROUNDING * sizes):
            return None
    if not _is_next_to(best, last):
        return None
    point = last._replace(place=best, data=system.tracked(best, times)[0])
    return End("touch", point.p, point.q, impact=flight, point=point)


def _is_next_to(place: Place, last: Point) -> bool:
    pairs = zip(place, last.place, strict=True)
    return all(abs(a - b) < _FAR * max(1.0, abs(b)) for a, b in pairs)


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
    period, points = system.period, longer.orbit(point.data)
    slowest = int(np.argmax(np.sum(points * points, axis=1)))
    place = points[(slowest + 1) % longer.period]
    times = np.roll(longer.times(point.data), -slowest - 1)
    times = np.append(times[: period - 1], times[period - 1] + times[period])
    found = []
    for p in levels:
        x, y = place.tolist()
        for _ in range(_NEWTON_STEPS):
            if not x * x + y * y < 1.0:
                break
            data, defect = system.tracked((x, y, p), times)
            a, c, b, d = data[:4].tolist()
            step = cramer([(a - 1.0, b), (c, d - 1.0)], defect)
            if step is None:
                break
            x, y = x + step[0], y + step[1]
            if not max(map(abs, step)) < _ASTRAY:
                break
            if max(map(abs, step)) < 1e-10:
                found.append(entered(system, (x, y, p)))
                break
    return [start for start in found if start is not None]


def beyond_touch(system: AsymmetricOrbits, place: Place, symmetric: bool) -> list[Point]:
    """Return orbits with one impact more than one that touches the floor, next to the touch.

    `place` is on a touching orbit of period n - 1, where n is the period of `system`. A symmetric
    orbit must touch the floor in two flights. Where the new impact is slow, its point is next to
    the section's rim. From there n - 1 impacts ahead, and one impact back in time, must lead to the
    same point: both depend smoothly on the contact speed, although P^n does not.
    """
    period, kind = system.period - 1, system.parameter.kind
    out, back = np.empty(ROOM), np.empty(ROOM)
    k, rho = system.parameter.k_and_rho(place[2])
    evaluate_orbit(period, kind, k, rho, *place[:2], NO_GUESS, out)
    times = out[FLIGHTS : FLIGHTS + period].copy()
    points = out[POINTS : POINTS + 2 * period].reshape(-1, 2).tolist()
    heights = system.heights(place, times, np.full(period, np.nan))
    (flights,) = np.nonzero(heights[:, 1] > -_FAR)
    if flights.size < (2 if symmetric else 1):
        return []
    flight = int(flights[0])
    at = float(heights[flight, 0])
    unit = _rim_point(k, rho, *points[flight], at)
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
            step = cramer([(x1 - x, x2 - x), (y1 - y, y2 - y)], (x, y))
            if step is None:
                break
            turn, p = turn + _DIFFERENCE * step[0], p * (1.0 + _DIFFERENCE * step[1])
            if not (abs(turn) < 0.1 and system.limits[0] < p < system.limits[1]):
                break
            if sum(map(abs, step)) < 1.0:
                found.append(entered(system, (*on_rim(turn, speed), p)))
                break
    return [start for start in found if start is not None]


def _rim_point(k: float, rho: float, at_x: float, at_y: float, t: float) -> tuple[float, float]:
    """Return the point of the rim where the flight from (X, Y) touches the floor after a time."""
    x, v, w = state_at(k, rho, at_x, at_y)
    b, c, s = rebound(v, w, k, impact_coefficients(k))
    position = gap(t, x, b, c, s, 1.0, quadrant(t))[3]
    X = (k * position - 1.0) / rho
    Y = (1.0 + k) * (b + t) / (rho * math.sqrt((1.0 + k) / k))
    size = math.sqrt(X * X + Y * Y)
    return X / size, Y / size
