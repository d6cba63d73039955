"""Periodic orbits without symmetry, which branch off where a symmetric orbit breaks its own.

Unknowns are a point of the section, in section radii, and the parameter: with rho = sqrt(1 + 2 k E)
and g = 1 the point (X, Y) of the unit disk is x = (1 + rho X)/k, y = rho sqrt((1 + k)/k) Y. The
reversor is (X, Y) -> (X, -Y), so that such orbits come in pairs, of which one is followed.
"""

import math
from typing import NamedTuple

import numpy as np

from pseudorigid.kernel.compiled import jit
from pseudorigid.kernel.impact import impact_coefficients

from .curve import Place, Point
from .half_orbit import flight_heights, fly, parameter_derivatives
from .symmetric import NO_GUESS, SAME, Parameter, PeriodicOrbits

NO_LINE = -1  # in place of the symmetry line of an orbit without symmetry
_MIRROR = np.array([1.0, -1.0])

# Contact speed, in units where g = 1, below which an orbit is not followed: derivatives grow like
# its reciprocal.
_LEAST_SPEED = 1e-5


class WholeOrbit(NamedTuple):
    """An orbit from a point of the section, and the derivatives of its end."""

    derivatives: np.ndarray  # (3, 2) of the end (X, Y) by X, by Y and by the parameter
    time: float  # total time
    lowest_speed: float  # lowest contact speed
    times: np.ndarray  # (n,) times of flight
    points: np.ndarray  # (n + 1, 2) points (X, Y), with start and end


@jit
def evaluate_orbit(
    period: int, parameter: int, k: float, rho: float, at_x: float, at_y: float, guess: np.ndarray
) -> WholeOrbit:
    """Return an orbit of `period` impacts from (X, Y) as a WholeOrbit.

    If `guess` is not empty, it has approximate times of flight, from whose neighbourhood the times
    are taken, whether an earlier impact ends the flight or not.
    """
    coefficients = impact_coefficients(k)
    rho_p, k_p = parameter_derivatives(parameter, k, rho)
    unit_x, unit_y = rho / k, rho * math.sqrt((1.0 + k) / k)
    # relative growth of the units of y and s with the parameter
    grow_y = rho_p / rho + 0.5 * k_p * (1.0 / (1.0 + k) - 1.0 / k)
    rest = math.sqrt(1.0 - at_x * at_x - at_y * at_y)
    x, y = (1.0 + rho * at_x) / k, unit_y * at_y
    unit_s = rho * math.sqrt(1.0 + k) / k
    s = unit_s * rest
    grow_s = rho_p / rho + k_p * (0.5 / (1.0 + k) - 1.0 / k)
    v, w = (y + k * s) / (1.0 + k), (s - y) / (1.0 + k)
    by_x = unit_x, 0.0, -unit_s * at_x / rest, 0.0
    by_y = 0.0, unit_y, -unit_s * at_y / rest, 0.0
    by_parameter = (rho_p * at_x - x * k_p) / k, y * grow_y, s * grow_s, k_p
    tangents = np.empty((3, 3))
    for j, (dx, dy, ds, dk) in enumerate((by_x, by_y, by_parameter)):
        tangents[j, 0] = dx
        tangents[j, 1] = (dy + k * ds + s * dk - v * dk) / (1.0 + k)
        tangents[j, 2] = (ds - dy - w * dk) / (1.0 + k)
    lowest, total = s, 0.0
    times, points = np.empty(period), np.empty((period + 1, 2))
    points[0, 0], points[0, 1] = at_x, at_y
    for i in range(period):
        near = guess[i] if guess.size > 0 else 0.0
        x, v, w, times[i] = fly(x, v, w, k, k_p, coefficients, near, tangents)
        total += times[i]
        lowest = min(lowest, v + w)
        points[i + 1, 0], points[i + 1, 1] = (k * x - 1.0) / rho, (v - k * w) / unit_y
    derivatives = np.empty((3, 2))
    for j in range(3):
        dx, dy = tangents[j, 0], tangents[j, 1] - k * tangents[j, 2]
        if j == 2:
            dx += (x * k_p - rho_p * (k * x - 1.0) / rho) / k
            dy += -w * k_p - (v - k * w) * grow_y
        derivatives[j, 0], derivatives[j, 1] = dx / unit_x, dy / unit_y
    return WholeOrbit(derivatives, total, lowest, times, points)


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

    def __init__(self, period: int, parameter: Parameter):
        super().__init__(NO_LINE, period, parameter)
        self.monitors = (
            ("fold", lambda point: self.trace(point) - 2.0),
            ("doubling", lambda point: self.trace(point) + 2.0),
        )

    def point(self, place: Place) -> Point | None:
        """Return the orbit from a place (X, Y, parameter), or None beyond the section."""
        at_x, at_y, p = place
        if not (at_x * at_x + at_y * at_y < 1.0 and p > 0.0):
            return None
        middle = (self.period + 1) // 2
        whole, ahead, back = self._halves(place, middle)
        radii = np.sum(whole.points[:-1] ** 2, axis=1)
        if self.period > 1 and np.argmax(radii) == middle % self.period:
            # Both ways to an impact that all but grazes have unbounded derivatives.
            whole, ahead, back = self._halves(place, middle - 1)
        if not (np.all(np.isfinite(whole.derivatives)) and whole.lowest_speed >= _LEAST_SPEED):
            return None
        gradients = tuple(map(tuple, (ahead - back)[:, :3].tolist()))
        defect = tuple((ahead - back)[:, 3].tolist())
        matrix = whole.derivatives[:2].ravel()
        controls = np.concatenate((matrix / math.sqrt(np.sum(matrix * matrix)), whole.times))
        orbit = whole.points[:-1]
        mirrored = orbit * _MIRROR
        index = np.arange(self.period)
        vectors = [np.roll(orbit, -d, axis=0) - orbit for d in self.divisors]
        vectors += [orbit[(shift - index) % self.period] - mirrored for shift in index]
        separations = tuple(each.ravel() for each in vectors)
        return Point(place, defect, gradients, controls, separations, whole)

    def _halves(self, place: Place, first: int) -> tuple[WholeOrbit, np.ndarray, np.ndarray]:
        """Return the orbit from a place, and the ways ahead and back in time.

        The ways meet `first` impacts after the place. Rows of a way are X and Y there, columns the
        derivatives by X, Y and the parameter, and the value. The way back is the reversor's image.
        """
        at_x, at_y, p = place
        k, rho = self.parameter.k_and_rho(p)
        kind, last = self.parameter.kind, self.period - first
        out = evaluate_orbit(first, kind, k, rho, at_x, at_y, NO_GUESS)
        mirrored = evaluate_orbit(last, kind, k, rho, at_x, -at_y, NO_GUESS)
        points = mirrored.points * _MIRROR
        ahead = np.column_stack((out.derivatives.T, out.points[first]))
        back = mirrored.derivatives.T * _MIRROR[:, None] * np.array([1.0, -1.0, 1.0])
        back = np.column_stack((back, points[last]))
        # P^n is the inverse of the way back after the way ahead; its determinant is 1.
        inverse = np.array([[back[1, 1], -back[0, 1]], [-back[1, 0], back[0, 0]]])
        change = ahead[:, :3] - np.column_stack((np.zeros((2, 2)), back[:, 2]))
        rows = [inverse[row, 0] * change[0] + inverse[row, 1] * change[1] for row in (0, 1)]
        whole = WholeOrbit(
            np.column_stack(rows),
            out.time + mirrored.time,
            min(out.lowest_speed, mirrored.lowest_speed),
            np.concatenate((out.times, mirrored.times[::-1])),
            np.concatenate((out.points, points[:last][::-1])),
        )
        return whole, ahead, back

    def tracked(self, place: Place, times: np.ndarray) -> tuple[WholeOrbit, Place]:
        """Return the orbit with about these times of flight, and its defect."""
        at_x, at_y, p = place
        k, rho = self.parameter.k_and_rho(p)
        whole = evaluate_orbit(self.period, self.parameter.kind, k, rho, at_x, at_y, times)
        x, y = whole.points[-1].tolist()
        return whole, (x - at_x, y - at_y)

    def heights(self, place: Place, times: np.ndarray, near: np.ndarray) -> np.ndarray:
        """Return time and height of the highest point of each flight above the floor (n, 2)."""
        at_x, at_y, p = place
        k, rho = self.parameter.k_and_rho(p)
        return flight_heights(*state_at(k, rho, at_x, at_y), k, 0.0, False, times, near)

    def symmetric_points(self, point: Point) -> list[tuple[int, float]]:
        """Return the points of an orbit on the symmetry lines: none."""
        return []

    def positions(self, point: Point) -> list[float]:
        """Return X of an orbit's points, which its mirror image shares."""
        return point.data.points[:-1, 0].tolist()

    def same(self, first: Point, second: Point) -> bool:
        """Return whether two solutions are points of one orbit, or of it and its mirror image."""
        place = np.array(second.place[:2])
        points = first.data.points[:-1]
        return any(
            np.any(np.max(np.abs(points - start), axis=1) < SAME)
            for start in (place, place * _MIRROR)
        )

    def innermost(self, point: Point) -> tuple[float, float]:
        """Return the orbit's point that is farthest from the rim."""
        points = point.data.points[:-1]
        return tuple(points[np.argmin(np.sum(points * points, axis=1))].tolist())

    def first_impact(self, point: Point) -> tuple[float, float]:
        """Return x and y of the orbit's first impact, in units where g = 1."""
        at_x, at_y, p = point.place
        k, rho = self.parameter.k_and_rho(p)
        return (1.0 + rho * at_x) / k, rho * math.sqrt((1.0 + k) / k) * at_y

    def first_place(self, point: Point) -> Place:
        """Return (X, Y, parameter) of the orbit's first impact, X and Y in section radii."""
        return point.place

    def trace(self, point: Point) -> float:
        """Return the trace of the orbit's Jacobian in canonical coordinates."""
        return float(point.data.derivatives[0, 0] + point.data.derivatives[1, 1])

    def residue(self, point: Point) -> float:
        """Return the size of trace - 2, which vanishes at folds."""
        return abs(self.trace(point) - 2.0)
