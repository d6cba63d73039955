"""Symmetric periodic orbits as zeros of a function of a position and a parameter."""

import math
from collections.abc import Callable, Sequence
from operator import attrgetter
from typing import NamedTuple

import numpy as np

from .curve import Place, Point, solve_at
from .half_orbit import (
    ENERGY,
    FIX_R,
    FIX_RP,
    HalfOrbit,
    ends_at_apex,
    evaluate,
    flight_heights,
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

    # Kinds of event, and functions of a point that change their sign there.
    monitors: Sequence[tuple[str, Callable[[Point], float]]]

    def __init__(self, line: int, period: int, parameter: Parameter):
        self.line, self.period, self.parameter = line, period, parameter
        self.limits = parameter.low, parameter.high
        self.scale = parameter.high - parameter.low
        self.divisors = [d for d in range(1, period) if period % d == 0]

    def separation(self, point: Point) -> float:
        """Return how far the orbit is from a shorter or more symmetric one, in section radii."""
        return min((float(np.max(np.abs(a))) for a in point.separations), default=math.inf)

    def shorter(self, point: Point) -> int:
        """Return the period of the shorter orbit that an orbit is near, or its own period."""
        sizes = (float(np.max(np.abs(vectors))) for vectors in point.separations)
        near = (d for d, size in zip(self.divisors, sizes, strict=False) if size < _SHORTER)
        return next(near, self.period)


class SymmetricOrbits(PeriodicOrbits):
    """Symmetric orbits of one period from one symmetry line. A place is (q, parameter)."""

    monitors = (
        ("fold", attrgetter("data.c")),
        ("pitchfork", attrgetter("data.b")),
        ("doubling", attrgetter("data.a")),
        ("doubling", attrgetter("data.d")),
    )

    def point(self, place: Place) -> Point | None:
        """Return the half orbit at a position and parameter, or None where there is none."""
        q, p = place
        if not (-1.0 < q < 1.0 and p > 0.0):
            return None
        half, defect = self.tracked(place, NO_GUESS)
        if not half.exists:
            return None
        k, rho = self.parameter.k_and_rho(p)
        ratio = math.sqrt(k * (1.0 + k))  # y/x of the section
        a, b, c, d = half.a, half.b * ratio, half.c / ratio, half.d
        size = math.sqrt(a * a + b * b + c * c + d * d)
        controls = np.concatenate(([a / size, b / size, c / size, d / size], half.times))
        # In section radii, so that the vectors do not turn when the section grows.
        points = half.points * np.array([k / rho, k / (rho * ratio)])
        separations = tuple((points[d:] - points[:-d]).ravel() for d in self.divisors)
        return Point(place, defect, ((half.h_q, half.h_p),), controls, separations, half)

    def tracked(self, place: Place, times: np.ndarray) -> tuple[HalfOrbit, Place]:
        """Return the half orbit with about these times of flight, and its defect."""
        q, p = place
        k, rho = self.parameter.k_and_rho(p)
        half = evaluate(self.line, self.period, self.parameter.kind, k, rho, q, times)
        return half, (half.h,)

    def heights(self, place: Place, times: np.ndarray, near: np.ndarray) -> np.ndarray:
        """Return time and height of the highest point of each flight above the floor (n, 2)."""
        q, p = place
        k, rho = self.parameter.k_and_rho(p)
        x, v, w, depth = line_state(self.line, k, rho, q)
        to_apex = ends_at_apex(self.line, self.period)
        return flight_heights(x, v, w, k, depth, to_apex, times, near)

    def trace(self, point: Point) -> float:
        """Return the trace of the whole orbit's Jacobian in canonical coordinates."""
        half = point.data
        a, b, c, d = half.a, half.b, half.c, half.d
        return 2.0 + 4.0 * b * c if abs(b * c) < abs(a * d) else 4.0 * a * d - 2.0

    def residue(self, point: Point) -> float:
        """Return the size of (trace - 2)/4, which vanishes at folds and pitchforks."""
        return abs(point.data.b * point.data.c)

    def position(self, p: float, xi: float) -> float:
        """Return the parameter q of a position x, or xi, on a symmetry line."""
        k, rho = self.parameter.k_and_rho(p)
        u = (k * xi - 1.0) / rho
        return u / (1.0 + math.sqrt(max(0.0, 1.0 - u * u)))

    def symmetric_points(self, point: Point) -> list[tuple[int, float]]:
        """Return (line, q) of the two points at which an orbit meets the symmetry lines."""
        end = FIX_RP if self.period % 2 else self.line
        return [(self.line, point.q), (end, self.position(point.p, point.data.x_end))]

    def positions(self, point: Point) -> list[float]:
        """Return the q of an orbit's points on the line on which its half orbit starts."""
        return [q for line, q in self.symmetric_points(point) if line == self.line]

    def same(self, first: Point, second: Point) -> bool:
        """Return whether two solutions at one parameter are points of one orbit."""
        return any(abs(q - second.q) < SAME for q in self.positions(first))

    def first_impact(self, point: Point) -> tuple[float, float]:
        """Return x and y of the half orbit's first impact, in units where g = 1."""
        if self.line == FIX_R:
            return point.data.xi, 0.0
        k, _ = self.parameter.k_and_rho(point.p)
        x, v, w = landing(point.data.xi, float(point.data.times[0]))
        return x, v - k * w

    def first_place(self, point: Point) -> Place:
        """Return (X, Y, parameter), X and Y in section radii, of the half orbit's first impact."""
        k, rho = self.parameter.k_and_rho(point.p)
        x, y = self.first_impact(point)
        return (k * x - 1.0) / rho, y / (rho * math.sqrt((1.0 + k) / k)), point.p


def roots(
    parameter: Parameter, p: float, line: int, grid: np.ndarray, periods: list[int]
) -> list[tuple[SymmetricOrbits, Point]]:
    """Return the orbits that sign changes on a grid of a line show, each with its system."""
    found = []
    values = scan(line, *parameter.k_and_rho(p), grid, max(periods, default=0))
    for period in periods:
        system = SymmetricOrbits(line, period, parameter)
        column = values[:, period]
        (cells,) = np.nonzero(column[:-1] * column[1:] <= 0.0)
        for i in cells.tolist():
            point = _root_between(system, p, *sorted((grid[i], grid[i + 1])))
            if point is not None and system.separation(point) > NEAR:
                found.append((system, point))
    return found


def _root_between(system: SymmetricOrbits, p: float, low: float, high: float) -> Point | None:
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
