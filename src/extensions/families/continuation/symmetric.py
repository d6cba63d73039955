"""Symmetric periodic orbits as zeros of a function of a position and a parameter."""

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from .curve import Place, Point, solve_at
from .half_orbit import (
    ENERGY,
    FIX_R,
    FIX_RP,
    H_P,
    H_Q,
    LOWEST_SPEED,
    PLACES,
    SIZE,
    TIME,
    TIMES,
    X_END,
    XI,
    A,
    B,
    C,
    D,
    H,
    evaluate,
    flight_heights,
    half_length,
    landing,
    line_state,
    scan,
)

NO_GUESS = np.empty(0)
# Cells into which a symmetry line is divided to find sign changes.
CELLS = 20_000
# Distance in a position below which two solutions are the same.
SAME = 1e-7
# Vectors between points of an orbit, in section radii, below which they are the same point.
NEAR = 1e-7
# Separation from a shorter or symmetric orbit, in section radii, where a curve has arrived there,
# and below which the orbit there is called the shorter orbit traversed several times.
COLLAPSED = 3e-4
_SHORTER = 20.0 * COLLAPSED


class Parameter(NamedTuple):
    """What a family is followed against: rho = sqrt(1 + 2 k E) at fixed k, or k at fixed E.

    Units are those in which g = 1.
    """

    kind: int  # ENERGY or INERTIA
    fixed: float  # k for ENERGY, E for INERTIA
    low: float
    high: float

    def k_and_rho(self, p: float) -> tuple[float, float]:
        """Return k and rho at a value of the parameter."""
        if self.kind == ENERGY:
            return self.fixed, p
        return p, math.sqrt(1.0 + 2.0 * p * self.fixed)

    def energy(self, p: float) -> float:
        """Return the energy, in units where g = 1, at a value of the parameter."""
        return 0.5 * (p - 1.0) * (p + 1.0) / self.fixed if self.kind == ENERGY else self.fixed


def lines(period: int) -> tuple[int, ...]:
    """Return the symmetry lines on which half orbits of a period start."""
    return (FIX_R,) if period % 2 else (FIX_R, FIX_RP)


class PeriodicOrbits:
    """Orbits of one period, as a `System` of `curve`: what symmetric and other ones share."""

    # Parts of a point's data: the total time, the lowest contact speed, and the times of flight.
    total_time: int
    lowest_speed: int
    flights: slice

    def __init__(self, line: int, period: int, parameter: Parameter):
        self.line, self.period, self.parameter = line, period, parameter
        self.limits = parameter.low, parameter.high
        self.scale = parameter.high - parameter.low
        self.divisors = [d for d in range(1, period) if period % d == 0]

    def time(self, point: Point) -> float:
        """Return the total time of the orbit."""
        return float(point.data[self.total_time])

    def speed(self, point: Point) -> float:
        """Return the lowest contact speed, in units where g = 1."""
        return float(point.data[self.lowest_speed])

    def times(self, data: np.ndarray) -> np.ndarray:
        """Return the times of flight in a point's data."""
        return data[self.flights].copy()

    def separation(self, point: Point) -> float:
        """Return how far the orbit is from a shorter or more symmetric one, in section radii."""
        return min((float(np.max(np.abs(a))) for a in point.apart), default=math.inf)

    def shorter(self, point: Point) -> int:
        """Return the period of the shorter orbit that an orbit is near, or its own period."""
        sizes = (float(np.max(np.abs(vectors))) for vectors in point.apart)
        near = (d for d, size in zip(self.divisors, sizes, strict=False) if size < _SHORTER)
        return next(near, self.period)


class Orbits(PeriodicOrbits):
    """Symmetric orbits of one period from one symmetry line. A place is (q, parameter)."""

    total_time, lowest_speed = TIME, LOWEST_SPEED

    def __init__(self, line: int, period: int, parameter: Parameter):
        super().__init__(line, period, parameter)
        flights = half_length(line, period) + line + (1 if period % 2 else line)
        self.flights = slice(TIMES, TIMES + flights)
        self._places = slice(PLACES, PLACES + 2 * (period // 2 + 1))

    def point(self, place: Place) -> Point | None:
        """Return the half orbit at a position and parameter, or None where there is none."""
        q, p = place
        if not (-1.0 < q < 1.0 and p > 0.0):
            return None
        k, rho = self.parameter.k_and_rho(p)
        out = np.empty(SIZE)
        if not evaluate(self.line, self.period, self.parameter.kind, k, rho, q, NO_GUESS, out):
            return None
        a, b, c, d = out[A : A + 4].tolist()
        ratio = math.sqrt(k * (1.0 + k))  # y/x of the section
        b, c = b * ratio, c / ratio
        size = math.sqrt(a * a + b * b + c * c + d * d)
        guard = np.concatenate(([a / size, b / size, c / size, d / size], out[self.flights]))
        # In section radii, so that the vectors do not turn when the section grows.
        places = out[self._places].reshape(-1, 2) * np.array([k / rho, k / (rho * ratio)])
        apart = tuple((places[d:] - places[:-d]).ravel() for d in self.divisors)
        h, h_q, h_p = out[H], out[H_Q], out[H_P]
        return Point((q, p), (float(h),), ((float(h_q), float(h_p)),), guard, apart, out)

    def tracked(self, place: Place, times: np.ndarray) -> tuple[np.ndarray, Place]:
        """Return data and defect of the half orbit whose times of flight are next to given ones."""
        q, p = place
        k, rho = self.parameter.k_and_rho(p)
        out = np.empty(SIZE)
        evaluate(self.line, self.period, self.parameter.kind, k, rho, q, times, out)
        return out, (float(out[H]),)

    def heights(self, place: Place, times: np.ndarray, near: np.ndarray) -> np.ndarray:
        """Return the result of `flight_heights`."""
        q, p = place
        k, rho = self.parameter.k_and_rho(p)
        x, v, w, depth = line_state(self.line, k, rho, q)
        out = np.empty((times.size, 2))
        to_apex = self.period % 2 == 1 or self.line == FIX_RP
        flight_heights(x, v, w, k, depth, to_apex, times, near, out)
        return out

    def trace(self, point: Point) -> float:
        """Return the trace of the whole orbit's Jacobian in canonical coordinates."""
        a, b, c, d = point.data[A : D + 1].tolist()
        return 2.0 + 4.0 * b * c if abs(b * c) < abs(a * d) else 4.0 * a * d - 2.0

    def residue(self, point: Point) -> float:
        """Return the size of (trace - 2)/4, which vanishes at folds and pitchforks."""
        return abs(float(point.data[B] * point.data[C]))

    @property
    def monitors(self) -> list[tuple[str, Callable[[Point], float]]]:
        """Kinds of event, and functions of a point that change their sign there."""

        def entry(index: int) -> Callable[[Point], float]:
            return lambda point: float(point.data[index])

        kinds = ("fold", C), ("pitchfork", B), ("doubling", A), ("doubling", D)
        return [(kind, entry(index)) for kind, index in kinds]

    def position(self, p: float, xi: float) -> float:
        """Return the parameter q of a position x, or xi, on a symmetry line."""
        k, rho = self.parameter.k_and_rho(p)
        u = (k * xi - 1.0) / rho
        return u / (1.0 + math.sqrt(max(0.0, 1.0 - u * u)))

    def symmetric_points(self, point: Point) -> list[tuple[int, float]]:
        """Return (line, q) of the two points at which an orbit meets the symmetry lines."""
        end = FIX_RP if self.period % 2 else self.line
        return [(self.line, point.q), (end, self.position(point.p, float(point.data[X_END])))]

    def positions(self, point: Point) -> list[float]:
        """Return the q of an orbit's points on the line on which its half orbit starts."""
        return [q for line, q in self.symmetric_points(point) if line == self.line]

    def same(self, first: Point, second: Point) -> bool:
        """Return whether two solutions at one parameter are points of one orbit."""
        return any(abs(q - second.q) < SAME for q in self.positions(first))

    def first_impact(self, point: Point) -> tuple[float, float]:
        """Return x and y of the half orbit's first impact, in units where g = 1."""
        if self.line == FIX_R:
            return float(point.data[XI]), 0.0
        k, _ = self.parameter.k_and_rho(point.p)
        x, v, w = landing(float(point.data[XI]), float(point.data[TIMES]))
        return x, v - k * w

    def first_place(self, point: Point) -> Place:
        """Return (X, Y, parameter), X and Y in section radii, of the half orbit's first impact."""
        k, rho = self.parameter.k_and_rho(point.p)
        x, y = self.first_impact(point)
        return (k * x - 1.0) / rho, y / (rho * math.sqrt((1.0 + k) / k)), point.p


def roots(
    parameter: Parameter, p: float, line: int, grid: np.ndarray, periods: list[int]
) -> list[tuple[int, int, Point]]:
    """Return (period, line, point) of the orbits that sign changes on a grid of a line show."""
    k, rho = parameter.k_and_rho(p)
    longest = max(periods, default=0)
    values = np.empty((grid.size, longest + 1))
    scan(line, k, rho, grid, longest, values)
    found = []
    for period in periods:
        system = Orbits(line, period, parameter)
        column = values[:, period]
        (cell,) = np.nonzero(column[:-1] * column[1:] <= 0.0)
        for i in cell.tolist():
            point = root_between(system, p, *sorted((grid[i], grid[i + 1])))
            if point is not None and system.separation(point) > NEAR:
                found.append((period, line, point))
    return found


def root_between(system: Orbits, p: float, low: float, high: float) -> Point | None:
    """Return the solution between two positions with opposite signs; None if it is a jump."""
    width = high - low
    first = system.point((low, p))
    if first is None:
        return None
    for _ in range(60):
        middle = 0.5 * (low + high)
        point = system.point((middle, p))
        if point is None or middle in (low, high):
            return None
        near = solve_at(system, (middle, p), 0.25 * (high - low))
        if near is not None and low <= near.q <= high:
            return near
        if (point.defect[0] > 0.0) == (first.defect[0] > 0.0):
            low = middle
        else:
            high = middle
        if high - low < 1e-13 * width:
            return None
    return None
