"""Periodic orbits without symmetry, which branch off where a symmetric orbit breaks its own.

Unknowns are a point of the section, in section radii, and the parameter: with rho = sqrt(1 + 2 k E)
and g = 1 the point (X, Y) of the unit disk is x = (1 + rho X)/k, y = rho sqrt((1 + k)/k) Y. The
reversor is (X, Y) -> (X, -Y), so that such orbits come in pairs, of which one is followed.
"""

import math

import numpy as np

from ...kernel.arithmetic import quadrant
from ...kernel.compiled import jit
from ...kernel.flight import first_impact, gap
from ...kernel.impact import flight_derivatives, impact_coefficients, rebound
from .curve import Place, Point
from .half_orbit import ENERGY, LONGEST_PERIOD, maximum, nearby_root

# Entries of the result of `evaluate_orbit`: the derivatives of (X, Y) after the period by X, Y and
# the parameter; from POINTS on the points (X, Y), from FLIGHTS on the times of flight.
DX, DY, DP, TOTAL, SLOWEST, POINTS = 0, 2, 4, 6, 7, 8
FLIGHTS = POINTS + 2 * (LONGEST_PERIOD + 1)
ROOM = FLIGHTS + LONGEST_PERIOD
NO_GUESS = np.empty(0)
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
    for j in range(3):
        dx = unit_x if j == 0 else 0.0
        dy = unit_y if j == 1 else 0.0
        ds = -unit_s * (at_x if j == 0 else at_y) / rest
        dk = 0.0
        if j == 2:
            dx, dy, ds = (rho_p * at_x - x * k_p) / k, y * grow_y, s * grow_s
            dk = k_p
        t[j, 0] = dx
        t[j, 1] = (dy + k * ds + s * dk - v * dk) / (1.0 + k)
        t[j, 2] = (ds - dy - w * dk) / (1.0 + k)
    slowest, total = s, 0.0
    out[POINTS], out[POINTS + 1] = at_x, at_y
    for i in range(period):
        b, c, s = rebound(v, w, k, coefficients)
        if guess.size > 0:
            tau = nearby_root(guess[i], x, b, c, s, 0.0)
            _, _, _, p, rate = gap(tau, x, b, c, s, 1.0, quadrant(tau))
        else:
            tau, p, rate, _ = first_impact(x, b, c, s, 1.0)
        sine, cosine, tau_x, tau_s, tau_c = flight_derivatives(x, b, c, s, 1.0, tau, quadrant(tau))
        more = 2.0 * s / ((1.0 + k) * (1.0 + k))
        x, v = p, b + tau
        w = max(rate, -v)
        for j in range(3):
            db, dc, ds = rebound(t[j, 1], t[j, 2], k, coefficients)
            if j == 2:
                db, dc = db - k_p * more, dc + k_p * more
            dt = tau_x * t[j, 0] + tau_s * ds + tau_c * dc
            t[j, 0], t[j, 1], t[j, 2] = (
                cosine * t[j, 0] - sine * dc - w * dt,
                db + dt,
                sine * t[j, 0] + cosine * dc + x * dt,
            )
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


@jit
def flight_heights(k, rho, at_x, at_y, times, near, out):
    """Write the time and value of the gap's largest maximum in each flight to out (flights, 2).

    `times` are the flights' times. Where near[i] is not NaN the maximum next to that time is taken;
    rows without a maximum are NaN. The gap is negative where the flight misses the floor.
    """
    coefficients = impact_coefficients(k)
    x, y = (1.0 + rho * at_x) / k, rho * math.sqrt((1.0 + k) / k) * at_y
    s = rho * math.sqrt(1.0 + k) / k * math.sqrt(1.0 - at_x * at_x - at_y * at_y)
    v, w = (y + k * s) / (1.0 + k), (s - y) / (1.0 + k)
    for i in range(times.size):
        b, c, s = rebound(v, w, k, coefficients)
        tau = times[i]
        out[i, 0], out[i, 1] = math.nan, math.nan
        if near[i] > 0.0:
            t = maximum(near[i], x, b, c, s)
            out[i, 0], out[i, 1] = t, gap(t, x, b, c, s, 1.0, quadrant(t))[0]
        else:
            steps = int(tau / 0.02) + 8
            before = 0.0
            for j in range(1, steps + 1):
                t = tau * j / steps
                _, df, _, _, _ = gap(t, x, b, c, s, 1.0, quadrant(t))
                if before > 0.0 and df <= 0.0:
                    peak = maximum(t - 0.5 * tau / steps, x, b, c, s)
                    height = gap(peak, x, b, c, s, 1.0, quadrant(peak))[0]
                    if 0.0 < peak < tau and not height <= out[i, 1]:
                        out[i, 0], out[i, 1] = peak, height
                before = df
        _, _, _, p, rate = gap(tau, x, b, c, s, 1.0, quadrant(tau))
        x, v, w = p, b + tau, max(rate, -(b + tau))


class AsymmetricOrbits:
    """Orbits of one period without symmetry, as a `System` of `curve`.

    The equations are that half of the impacts ahead and half of them back in time lead to the same
    point. So their errors grow like the square root of the orbit's multiplier.
    """

    line = -1

    def __init__(self, period, parameter):
        self.period, self.parameter = period, parameter
        self.limits = parameter.low, parameter.high
        self.scale = parameter.high - parameter.low
        self._divisors = [d for d in range(1, period) if period % d == 0]

    def point(self, place: Place) -> Point | None:
        """Return the orbit from a place (X, Y, parameter), or None beyond the section."""
        at_x, at_y, p = place
        if not (at_x * at_x + at_y * at_y < 1.0 and p > 0.0):
            return None
        middle = (self.period + 1) // 2
        out, ahead, back = self._halves(place, middle)
        radii = np.sum(self._orbit_in(out) ** 2, axis=1)
        if self.period > 1 and np.argmax(radii) == middle % self.period:
            # Both ways to an impact that all but grazes have unbounded derivatives.
            out, ahead, back = self._halves(place, middle - 1)
        if not (np.all(np.isfinite(out[:TOTAL])) and out[SLOWEST] >= _LEAST_SPEED):
            return None
        gradients = tuple(map(tuple, (ahead - back)[:, :3].tolist()))
        defect = tuple((ahead - back)[:, 3].tolist())
        matrix = out[:4] / math.sqrt(np.sum(out[:4] * out[:4]))
        guard = np.concatenate((matrix, out[FLIGHTS : FLIGHTS + self.period]))
        orbit = self._orbit_in(out)
        mirrored = orbit * _MIRROR
        index = np.arange(self.period)
        apart = [np.roll(orbit, -d, axis=0) - orbit for d in self._divisors]
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

    def orbit(self, point: Point) -> np.ndarray:
        """Return the points (period, 2) of an orbit, in section radii."""
        return self._orbit_in(point.data)

    def _orbit_in(self, out: np.ndarray) -> np.ndarray:
        """Return the points (period, 2) in a result of `evaluate_orbit`."""
        return out[POINTS : POINTS + 2 * self.period].reshape(-1, 2)

    def innermost(self, point: Point) -> tuple[float, float]:
        """Return the orbit's point that is farthest from the rim."""
        points = self.orbit(point)
        return tuple(points[np.argmin(np.sum(points * points, axis=1))].tolist())

    def shorter(self, point: Point, near: float) -> int:
        """Return the period of the shorter orbit that an orbit is near, or its own period."""
        for divisor, vectors in zip(self._divisors, point.apart, strict=False):
            if float(np.max(np.abs(vectors))) < near:
                return divisor
        return self.period

    def separation(self, point: Point) -> float:
        """Return how far the orbit is from a symmetric or a shorter one, in section radii."""
        return min(float(np.max(np.abs(a))) for a in point.apart)

    @staticmethod
    def trace(point: Point) -> float:
        """Return the trace of the orbit's Jacobian in canonical coordinates."""
        return float(point.data[DX] + point.data[DY + 1])

    @staticmethod
    def time(point: Point) -> float:
        """Return the total time of the orbit."""
        return float(point.data[TOTAL])

    @property
    def tests(self):
        """Events: kind, function that changes its sign there, and its size against rounding."""

        def fold(point: Point) -> float:
            return self.trace(point) - 2.0

        def doubling(point: Point) -> float:
            return self.trace(point) + 2.0

        return [
            ("fold", fold, lambda point: abs(fold(point))),
            ("doubling", doubling, lambda point: 1.0),
        ]
