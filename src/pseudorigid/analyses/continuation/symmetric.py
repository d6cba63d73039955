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
    PLACES,
    SIZE,
    TIME,
    TIMES,
    A,
    B,
    C,
    D,
    H,
    evaluate,
    half_length,
    scan,
)

Test = tuple[str, Callable[[Point], float], Callable[[Point], float]]
NO_GUESS = np.empty(0)
# Cells into which a symmetry line is divided to find sign changes.
CELLS = 20_000
# Distance in q below which two solutions are the same.
SAME = 1e-7
# Vectors between points of an orbit, in section radii, below which they are the same point.
NEAR = 1e-7


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


def divisors(period: int) -> list[int]:
    """Return the proper divisors of a period."""
    return [d for d in range(1, period) if period % d == 0]


def lines(period: int) -> tuple[int, ...]:
    """Return the symmetry lines on which half orbits of a period start."""
    return (FIX_R,) if period % 2 else (FIX_R, FIX_RP)


class Orbits:
    """Symmetric orbits of one period from one symmetry line, as a `System` of `curve`."""

    def __init__(self, line: int, period: int, parameter: Parameter):
        self.line, self.period, self.parameter = line, period, parameter
        self.limits = parameter.low, parameter.high
        self.scale = parameter.high - parameter.low
        self._impacts = half_length(line, period) + line
        self._times = slice(TIMES, TIMES + self._impacts + (1 if period % 2 else line))
        self._places = period // 2 + 1
        self._divisors = divisors(period)

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
        guard = np.concatenate(([a / size, b / size, c / size, d / size], out[self._times]))
        # In section radii, so that the vectors do not turn when the section grows.
        places = out[PLACES : PLACES + 2 * self._places].reshape(-1, 2)
        places = places * np.array([k / rho, k / (rho * ratio)])
        apart = tuple((places[d:] - places[:-d]).ravel() for d in self._divisors)
        h, h_q, h_p = out[H], out[H_Q], out[H_P]
        return Point((q, p), (float(h),), ((float(h_q), float(h_p)),), guard, apart, out)

    def times(self, point: Point) -> np.ndarray:
        """Return the times of flight along the half orbit."""
        return self.times_in(point.data)

    def times_in(self, out: np.ndarray) -> np.ndarray:
        """Return the times of flight in a result of `evaluate`."""
        return out[self._times]

    @staticmethod
    def trace(point: Point) -> float:
        """Return the trace of the whole orbit's Jacobian in canonical coordinates."""
        a, b, c, d = point.data[A : D + 1].tolist()
        return 2.0 + 4.0 * b * c if abs(b * c) < abs(a * d) else 4.0 * a * d - 2.0

    @staticmethod
    def time(point: Point) -> float:
        """Return the total time of the orbit."""
        return float(point.data[TIME])

    @property
    def tests(self) -> list[Test]:
        """Events: kind, function that changes its sign there, and its size against rounding."""

        def entry(index: int) -> Callable[[Point], float]:
            return lambda point: float(point.data[index])

        def residue(point: Point) -> float:
            return abs(float(point.data[B] * point.data[C]))

        def apart(point: Point) -> float:
            return 1.0

        return [
            ("fold", entry(C), residue),
            ("pitchfork", entry(B), residue),
            ("doubling", entry(A), apart),
            ("doubling", entry(D), apart),
        ]

    def is_prime(self, point: Point) -> bool:
        """Return whether no proper divisor of the period is a period."""
        return self.separation(point) > NEAR

    def separation(self, point: Point) -> float:
        """Return how far the orbit is from one of a shorter period, in section radii."""
        return min((float(np.max(np.abs(a))) for a in point.apart), default=math.inf)

    def position(self, p: float, xi: float) -> float:
        """Return the parameter q of a position x, or xi, on a symmetry line."""
        k, rho = self.parameter.k_and_rho(p)
        u = (k * xi - 1.0) / rho
        return u / (1.0 + math.sqrt(max(0.0, 1.0 - u * u)))


def roots(parameter: Parameter, p: float, longest: int, cells: int = CELLS) -> list:
    """Return (period, line, point) of all symmetric orbits that sign changes on the lines show."""
    k, rho = parameter.k_and_rho(p)
    grid = (2.0 * np.arange(cells) + 1.0) / cells - 1.0
    found = []
    for line in (FIX_R, FIX_RP):
        values = np.empty((cells, longest + 1))
        scan(line, k, rho, grid, longest, values)
        for period in range(1, longest + 1):
            if line not in lines(period):
                continue
            system = Orbits(line, period, parameter)
            column = values[:, period]
            (cell,) = np.nonzero(column[:-1] * column[1:] <= 0.0)
            for i in cell.tolist():
                point = root_between(system, p, grid[i], grid[i + 1])
                if point is not None and system.is_prime(point):
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
