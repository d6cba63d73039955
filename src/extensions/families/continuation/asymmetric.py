"""Periodic orbits without symmetry, which branch off where a symmetric orbit breaks its own.

Unknowns are a point of the section, in section radii, and the parameter: with rho = sqrt(1 + 2 k E)
and g = 1 the point (X, Y) of the unit disk is x = (1 + rho X)/k, y = rho sqrt((1 + k)/k) Y. The
reversor is (X, Y) -> (X, -Y), so that such orbits come in pairs, of which one is followed.
"""

import math
from collections.abc import Callable

import numpy as np

from pseudorigid.kernel.compiled import jit
from pseudorigid.kernel.impact import impact_coefficients

from .curve import Place, Point
from .half_orbit import ENERGY, LONGEST_PERIOD, flight_heights, fly
from .symmetric import NO_GUESS, SAME, Parameter, PeriodicOrbits

# Entries of the result of `evaluate_orbit`: the derivatives of (X, Y) after the period by X, Y and
# the parameter; from POINTS on the points (X, Y), from FLIGHTS on the times of flight.
DX, DY, DP, TOTAL, SLOWEST, POINTS = 0, 2, 4, 6, 7, 8
FLIGHTS = POINTS + 2 * (LONGEST_PERIOD + 1)
ROOM = FLIGHTS + LONGEST_PERIOD
NO_LINE = -1  # in place of the symmetry line of an orbit without symmetry
_MIRROR = np.array([1.0, -1.0])

# Contact speed, in units where g = 1, below which an orbit is not followed: derivatives grow like
# its reciprocal.
_LEAST_SPEED = 1e-5


@jit
def evaluate_orbit(period, parameter, k, rho, at_x, at_y, guess, out):
    """Write an orbit of `period` impacts from (X, Y) and its derivatives to out (ROOM,).

    If `guess` is not empty, it has approximate times of flight, from whose neighbourhood the times
    are taken, whether an earlier impact ends the flight or not.
    """
    coefficients = impact_coefficients(k)
    energy = 0.5 * (rho - 1.0) * (rho + 1.0) / k
    rho_p, k_p = (1.0, 0.0) if parameter == ENERGY else (energy / rho, 1.0)
    unit_x, unit_y = rho / k, rho * math.sqrt((1.0 + k) / k)
    # relative growth of the units of y and s with the parameter
    grow_y = rho_p / rho + 0.5 * k_p * (1.0 / (1.0 + k) - 1.0 / k)
    rest = math.sqrt(1.0 - at_x * at_x - at_y * at_y)
    x, y = (1.0 + rho * at_x) / k, unit_y * at_y
    unit_s = rho * math.sqrt(1.0 + k) / k
    s = unit_s * rest
    grow_s = rho_p / rho + k_p * (0.5 / (1.0 + k) - 1.0 / k)
    v, w = (y + k * s) / (1.0 + k), (s - y) / (1.0 + k)
    # three tangent vectors: by X, by Y, by the parameter
    t = np.zeros((3, 3))
    by_p = (rho_p * at_x - x * k_p) / k, y * grow_y, s * grow_s, k_p
    by_x, by_y = -unit_s * at_x / rest, -unit_s * at_y / rest
    for j, (dx, dy, ds, dk) in enumerate(
        ((unit_x, 0.0, by_x, 0.0), (0.0, unit_y, by_y, 0.0), by_p)
    ):
        t[j, 0] = dx
        t[j, 1] = (dy + k * ds + s * dk - v * dk) / (1.0 + k)
        t[j, 2] = (ds - dy - w * dk) / (1.0 + k)
    slowest, total = s, 0.0
    out[POINTS], out[POINTS + 1] = at_x, at_y
    for i in range(period):
        near = guess[i] if guess.size > 0 else 0.0
        x, v, w, tau = fly(x, v, w, k, k_p, coefficients, near, t)
        total += tau
        slowest = min(slowest, v + w)
        out[FLIGHTS + i] = tau
        out[POINTS + 2 * i + 2] = (k * x - 1.0) / rho
        out[POINTS + 2 * i + 3] = (v - k * w) / unit_y
    for j in range(3):
        dx, dy = t[j, 0], t[j, 1] - k * t[j, 2]
        if j == 2:
            dx += (x * k_p - rho_p * (k * x - 1.0) / rho) / k
            dy += -w * k_p - (v - k * w) * grow_y
        out[2 * j], out[2 * j + 1] = dx / unit_x, dy / unit_y
    out[TOTAL], out[SLOWEST] = total, slowest


def state_at(k: float, rho: float, at_x: float, at_y: float) -> tuple[float, float, float]:
    """Return the state (x, v, w) of a point (X, Y) of the section."""
    x, y = (1.0 + rho * at_x) / k, rho * math.sqrt((1.0 + k) / k) * at_y
    s = rho * math.sqrt(1.0 + k) / k * math.sqrt(1.0 - at_x * at_x - at_y * at_y)
    return x, (y + k * s) / (1.0 + k), (s - y) / (1.0 + k)


class AsymmetricOrbits(PeriodicOrbits):
    """Orbits of one period without symmetry. A place is (X, Y, parameter).

    The equations are that half of the impacts ahead and half of them back in time lead to the same
    point. So their errors grow like the square root of the orbit's multiplier.
    """

    total_time, lowest_speed = TOTAL, SLOWEST

    def __init__(self, period: int, parameter: Parameter):
        super().__init__(NO_LINE, period, parameter)
        self.flights = slice(FLIGHTS, FLIGHTS + period)

    def point(self, place: Place) -> Point | None:
        """Return the orbit from a place (X, Y, parameter), or None beyond the section."""
        at_x, at_y, p = place
        if not (at_x * at_x + at_y * at_y < 1.0 and p > 0.0):
            return None
        middle = (self.period + 1) // 2
        out, ahead, back = self._halves(place, middle)
        radii = np.sum(self.orbit(out) ** 2, axis=1)
        if self.period > 1 and np.argmax(radii) == middle % self.period:
            # Both ways to an impact that all but grazes have unbounded derivatives.
            out, ahead, back = self._halves(place, middle - 1)
        if not (np.all(np.isfinite(out[:TOTAL])) and out[SLOWEST] >= _LEAST_SPEED):
            return None
        gradients = tuple(map(tuple, (ahead - back)[:, :3].tolist()))
        defect = tuple((ahead - back)[:, 3].tolist())
        matrix = out[:4] / math.sqrt(np.sum(out[:4] * out[:4]))
        guard = np.concatenate((matrix, out[self.flights]))
        orbit = self.orbit(out)
        mirrored = orbit * _MIRROR
        index = np.arange(self.period)
        apart = [np.roll(orbit, -d, axis=0) - orbit for d in self.divisors]
        apart += [orbit[(shift - index) % self.period] - mirrored for shift in index]
        return Point(place, defect, gradients, guard, tuple(v.ravel() for v in apart), out)

    def _halves(self, place: Place, first: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return an orbit, as from `evaluate_orbit`, and the ways ahead and back from a place.

        They meet `first` impacts after the place. Rows of a way are X and Y there, columns the
        derivatives by X, Y and the parameter, and the value. The way back is the reversor's image.
        """
        at_x, at_y, p = place
        k, rho = self.parameter.k_and_rho(p)
        kind, last = self.parameter.kind, self.period - first
        out, mirrored = np.empty(ROOM), np.empty(ROOM)
        evaluate_orbit(first, kind, k, rho, at_x, at_y, NO_GUESS, out)
        evaluate_orbit(last, kind, k, rho, at_x, -at_y, NO_GUESS, mirrored)
        middle = out[POINTS + 2 * first : POINTS + 2 * first + 2]
        ahead = np.column_stack((out[:TOTAL].reshape(3, 2).T, middle))
        points = mirrored[POINTS : POINTS + 2 * last + 2].reshape(-1, 2) * _MIRROR
        back = mirrored[:TOTAL].reshape(3, 2).T * _MIRROR[:, None] * np.array([1.0, -1.0, 1.0])
        back = np.column_stack((back, points[last]))
        # P^n is the inverse of the way back after the way ahead; its determinant is 1.
        inverse = np.array([[back[1, 1], -back[0, 1]], [-back[1, 0], back[0, 0]]])
        change = ahead[:, :3] - np.column_stack((np.zeros((2, 2)), back[:, 2]))
        for row in range(2):
            out[row:TOTAL:2] = inverse[row, 0] * change[0] + inverse[row, 1] * change[1]
        start = POINTS + 2 * (first + 1)
        out[start : start + 2 * last] = points[:last][::-1].ravel()
        flights = mirrored[FLIGHTS : FLIGHTS + last]
        out[FLIGHTS + first : FLIGHTS + self.period] = flights[::-1]
        out[TOTAL] += mirrored[TOTAL]
        out[SLOWEST] = min(out[SLOWEST], mirrored[SLOWEST])
        return out, ahead, back

    def tracked(self, place: Place, times: np.ndarray) -> tuple[np.ndarray, Place]:
        """Return data and defect of the orbit whose times of flight are next to given ones."""
        at_x, at_y, p = place
        k, rho = self.parameter.k_and_rho(p)
        out = np.empty(ROOM)
        evaluate_orbit(self.period, self.parameter.kind, k, rho, at_x, at_y, times, out)
        x, y = out[POINTS + 2 * self.period : POINTS + 2 * self.period + 2].tolist()
        return out, (x - at_x, y - at_y)

    def heights(self, place: Place, times: np.ndarray, near: np.ndarray) -> np.ndarray:
        """Return the result of `flight_heights`."""
        *at, p = place
        k, rho = self.parameter.k_and_rho(p)
        out = np.empty((times.size, 2))
        flight_heights(*state_at(k, rho, *at), k, 0.0, False, times, near, out)
        return out

    def orbit(self, data: np.ndarray) -> np.ndarray:
        """Return the points (period, 2) of an orbit, in section radii, in a point's data."""
        return data[POINTS : POINTS + 2 * self.period].reshape(-1, 2)

    def positions(self, point: Point) -> list[float]:
        """Return X of an orbit's points, which its mirror image shares."""
        return self.orbit(point.data)[:, 0].tolist()

    def same(self, first: Point, second: Point) -> bool:
        """Return whether two solutions are points of one orbit, or of it and its mirror image."""
        place = np.array(second.place[:2])
        points = self.orbit(first.data)
        return any(
            np.any(np.max(np.abs(points - at), axis=1) < SAME) for at in (place, place * _MIRROR)
        )

    def innermost(self, point: Point) -> tuple[float, float]:
        """Return the orbit's point that is farthest from the rim."""
        points = self.orbit(point.data)
        return tuple(points[np.argmin(np.sum(points * points, axis=1))].tolist())

    def first_impact(self, point: Point) -> tuple[float, float]:
        """Return x and y of the point, in units where g = 1."""
        at_x, at_y, p = point.place
        k, rho = self.parameter.k_and_rho(p)
        return (1.0 + rho * at_x) / k, rho * math.sqrt((1.0 + k) / k) * at_y

    def first_place(self, point: Point) -> Place:
        """Return (X, Y, parameter), X and Y in section radii."""
        return point.place

    def trace(self, point: Point) -> float:
        """Return the trace of the orbit's Jacobian in canonical coordinates."""
        return float(point.data[DX] + point.data[DY + 1])

    def residue(self, point: Point) -> float:
        """Return the size of trace - 2, which vanishes at folds."""
        return abs(self.trace(point) - 2.0)

    @property
    def monitors(self) -> list[tuple[str, Callable[[Point], float]]]:
        """Kinds of event, and functions of a point that change their sign there."""
        return [
            ("fold", lambda point: self.trace(point) - 2.0),
            ("doubling", lambda point: self.trace(point) + 2.0),
        ]
