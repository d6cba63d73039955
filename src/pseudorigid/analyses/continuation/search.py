"""Search for all families: brute force on a grid, branch switching, parents and partners."""

import math
from collections.abc import Iterator
from itertools import product

import numpy as np

from .curve import Point, at_parameter, solve_at
from .families import COLLAPSED, End, Event, Family, find_events, follow
from .grazing import grazing
from .half_orbit import FIX_R, FIX_RP, TIMES, X_END, XI, landing, scan
from .symmetric import CELLS, SAME, Orbits, Parameter, divisors, lines, root_between, roots

# Separation below which a collapsed orbit is the shorter orbit traversed several times.
SHORTER = 20.0 * COLLAPSED
# Distances in the parameter's range at which branches are sought beside an event, and distances in
# q from the parent's point between which they are.
_BESIDE = 1e-6, 1e-5, 1e-4, 1e-3
_OFFSETS = np.cumprod(np.append(1e-5, np.full(399, 1.0204)))
_NEAR_RIM, _NEAR_TIME = 2e-5, 1e-2  # of a grazing orbit from its partner, in p and total time
NEAR_EVENT = 1e-3  # largest distance, in p and in q, from a collapsed end to the parent's event
_MARGIN = 0.01  # in q, beyond the ends of a step along a curve, within which the curve stays
_AT_REST = 0.999  # |q| on both lines, above which the ball is all but at rest on the floor


class Search:
    """All families that brute force on a grid of the parameter and branch switching find."""

    def __init__(self, parameter: Parameter, longest: int, cells: int = CELLS):
        self.parameter, self.longest, self.cells = parameter, longest, cells
        self.systems = {
            (period, line): Orbits(line, period, parameter)
            for period in range(1, longest + 1)
            for line in lines(period)
        }
        self.families: list[Family] = []
        self.starts: list[tuple[int, int, float, float]] = []  # of each symmetric family
        self._curves: dict[int, tuple[np.ndarray, np.ndarray]] = {}

    def resume(self, starts: list[tuple[int, int, float, float]]) -> None:
        """Follow the families again of which an earlier search kept the starts."""
        for period, line, q, p in starts:
            point = self.systems[period, line].point((q, p))
            if point is None:
                raise ValueError("the starts are not those of this search")
            self._append(self._followed(period, line, point), point)

    def crossings(self, family: Family, p: float) -> list[Point]:
        """Return the points of a family at a parameter."""
        found = []
        for old, new in zip(family.points, family.points[1:], strict=False):
            if (old.p < p) != (new.p < p):
                point = at_parameter(family.system, old, new, p)
                if point is not None:
                    found.append(point)
        return found

    def holders(self, period: int, line: int, point: Point) -> list[int]:
        """Return the numbers of the families that hold a solution."""
        return [
            family.number
            for family in self.families
            if (family.period, family.line) == (period, line) and self._holds(family, point)
        ]

    def _holds(self, family: Family, point: Point) -> bool:
        """Return whether a family holds a solution.

        Its place is solved for only on those parts of the curve that come near the solution.
        """
        levels, places = self._curve(family)
        below = levels < point.p
        (cells,) = np.nonzero(below[:-1] != below[1:])
        for i in cells.tolist():
            low, high = places[i : i + 2].min(axis=0), places[i : i + 2].max(axis=0)
            margin = _MARGIN + (high - low)
            if np.any((low - margin < point.q) & (point.q < high + margin)):
                at = at_parameter(family.system, *family.points[i : i + 2], point.p)
                if at is not None and any(
                    abs(q - point.q) < SAME for q in positions(family.system, at)
                ):
                    return True
        return False

    def _curve(self, family: Family) -> tuple[np.ndarray, np.ndarray]:
        """Return the parameters (n,) of a family's points, and their positions (n, 1 or 2)."""
        if family.number not in self._curves:
            self._curves[family.number] = (
                np.array([point.p for point in family.points]),
                np.array([positions(family.system, point) for point in family.points]),
            )
        return self._curves[family.number]

    def add(self, period: int, line: int, point: Point) -> bool:
        """Follow the family of a solution unless a known family holds it; return if it is new."""
        if self.holders(period, line, point):
            return False
        family = self._followed(period, line, point)
        # Next to its end at a shorter orbit a known family has no points; farther away it has.
        middle = family.points[len(family.points) // 2]
        if self.holders(period, line, middle):
            return False
        self._append(family, point)
        return True

    def _followed(self, period: int, line: int, point: Point) -> Family:
        family = follow(self.systems[period, line], point, grazing)
        find_events(family, self.longest)
        return family

    def _append(self, family: Family, start: Point) -> None:
        family.number = len(self.families)
        self.families.append(family)
        self.starts.append((family.period, family.line, start.q, start.p))

    def sweep(self, levels: list[float], first: int = 0) -> Iterator[int]:
        """Add the families of all solutions on a grid of the parameter, a level at a time.

        Yields the number of levels done. `first` levels are left out.
        """
        for done, p in enumerate(levels[first:], first + 1):
            for period, line, point in roots(self.parameter, p, self.longest, self.cells):
                self.add(period, line, point)
            yield done

    def switch(self) -> int:
        """Add the families that branch off or go on beyond a grazing; return how many are new."""
        before, number = len(self.families), 0
        while number < len(self.families):
            family = self.families[number]
            number += 1
            for event in family.events:
                short = family.period * event.order <= self.longest
                if event.kind in ("resonance", "doubling") and short:
                    for child in self.children(family, event):
                        self.add(*child)
            for end in family.ends:
                if end.kind in ("rim", "touch") and end.point is not None:
                    self._go_on(family, end)
        return len(self.families) - before

    def children(self, family: Family, event: Event) -> list[tuple[int, int, Point]]:
        """Return (period, line, point) of the orbits next to an event, on both sides of it."""
        found = []
        for p in self.levels_beside(event.point.p):
            near = solve_at(family.system, (event.point.q, p), 0.05)
            if near is None:  # past a fold of the parent
                near = event.point
            for line, q in symmetric_points(family.system, near):
                found += self._beside(family.period * event.order, line, q, p)
        return found

    def _go_on(self, family: Family, end: End) -> None:
        """Add the families that go on where an impact of this one grazes, unless one is known."""
        if any(self.meet(family, end, *other) for other in self.grazing_ends()):
            return
        longer = end.kind == "touch"
        rounds = range(1, self.longest // family.period + 1) if longer else (1,)
        periods = [
            n
            for r in rounds
            for less in range(1, 2 * r + 1)
            for n in ((r * family.period + less,) if longer else (family.period - less,))
            if 1 <= n <= self.longest
        ]
        for line, q in symmetric_points(family.system, end.point):
            # At rest on the floor an orbit passes from one line to the other.
            sides = (FIX_R, FIX_RP) if abs(q) > _AT_REST else (line,)
            for p in self.levels_beside(end.p):
                for period, side in product(dict.fromkeys(periods), sides):
                    for child in self._beside(period, side, q, p):
                        self.add(*child)

    def levels_beside(self, p: float) -> list[float]:
        """Return parameters on both sides of one, within the range."""
        low, high = self.parameter.low, self.parameter.high
        beside = (p + sign * part * (high - low) for part in _BESIDE for sign in (-1.0, 1.0))
        return [value for value in beside if low < value < high]

    def _beside(self, period: int, line: int, q: float, p: float) -> list[tuple[int, int, Point]]:
        """Return (period, line, point) of the orbits on both sides of a point of a line."""
        found: list[tuple[int, int, Point]] = []
        if line not in lines(period):
            return found
        system = self.systems[period, line]
        k, rho = self.parameter.k_and_rho(p)
        for side in (_OFFSETS, -_OFFSETS):
            grid = q + side
            grid = grid[(grid > -1.0) & (grid < 1.0)]
            values = np.empty((grid.size, period + 1))
            scan(line, k, rho, grid, period, values)
            column = values[:, period]
            (cell,) = np.nonzero(column[:-1] * column[1:] <= 0.0)
            for i in cell.tolist():
                low, high = sorted((grid[i], grid[i + 1]))
                point = root_between(system, p, low, high)
                if point is not None and system.is_prime(point):
                    found.append((period, line, point))
        return found

    def link(self) -> None:
        """Name the parents of families that begin at a point of a shorter orbit, and partners."""
        for family in self.families:
            for end in family.ends:
                if end.kind == "collapse" and family.line >= 0:
                    self._parent(family, end)
                if end.kind == "collapse":
                    end.kind = "unresolved"
        for family in self.families:
            for end in family.ends:
                if end.kind == "rim":
                    self._partner(family, end)

    def _parent(self, family: Family, end: End) -> None:
        """Find the event of a shorter orbit at which a family ends."""
        best, distance = None, NEAR_EVENT
        separations = dict(
            zip(
                divisors(family.period),
                (float(np.max(np.abs(a))) for a in end.point.apart),
                strict=True,
            )
        )
        shorter = next(d for d, size in separations.items() if size < SHORTER)
        scale = self.parameter.high - self.parameter.low
        for parent in self.families:
            if parent.period != shorter or parent.line < 0:
                continue
            for event in parent.events:
                if event.order != family.period // shorter or event.kind == "fold":
                    continue
                for line, q in symmetric_points(parent.system, event.point):
                    away = abs(q - end.q) + abs(event.point.p - end.p) / scale
                    if line == family.line and away < distance:
                        best, distance = (parent, event, q), away
        if best is not None:
            parent, event, q = best
            end.kind, end.family = event.kind, parent.number
            end.turns, end.order = event.turns, event.order
            end.p, end.q = event.point.p, q

    def grazing_ends(self) -> Iterator[tuple[Family, End]]:
        """Yield the ends at which an impact grazes."""
        for family in self.families:
            yield from ((family, end) for end in family.ends if end.kind in ("rim", "touch"))

    @staticmethod
    def meet(first: Family, end: End, second: Family, other: End) -> int:
        """Return in how many rounds of the shorter of two orbits they meet, 0 if they do not.

        One of them touches the floor in a flight where an impact of the other one grazes. Without
        its grazing impacts the longer orbit is the shorter one, traversed once or, where it grazes
        only in some of its rounds, several times.
        """
        if (end.kind, other.kind) == ("touch", "rim"):
            first, end, second, other = second, other, first, end
        if (end.kind, other.kind) != ("rim", "touch"):
            return 0
        if not abs(other.p - end.p) < _NEAR_RIM * end.p:
            return 0
        for rounds in range(1, first.period // second.period + 1):
            grazing_impacts = first.period - rounds * second.period
            time = first.system.time(end.point) - rounds * second.system.time(other.point)
            if 1 <= grazing_impacts <= 2 * rounds and abs(time) < _NEAR_TIME:
                return rounds
        return 0

    def _partner(self, family: Family, end: End) -> None:
        """Find the family whose flight touches the floor where an impact of this one grazes."""
        for other, touch in self.grazing_ends():
            rounds = self.meet(family, end, other, touch)
            if rounds:
                end.family, end.p = other.number, touch.p
                if rounds == 1 and (family.line < 0) == (other.line < 0):
                    touch.family = family.number
                return


def positions(system: Orbits, point: Point) -> list[float]:
    """Return the parameters q of an orbit's points on the line on which its half orbit starts."""
    if system.period % 2:
        return [point.q]
    return [point.q, system.position(point.p, float(point.data[X_END]))]


def symmetric_points(system: Orbits, point: Point) -> list[tuple[int, float]]:
    """Return (line, q) of the two points at which an orbit meets the symmetry lines."""
    end = FIX_RP if system.period % 2 else system.line
    return [
        (system.line, point.q),
        (end, system.position(point.p, float(point.data[X_END]))),
    ]


def first_point(system: Orbits, point: Point) -> tuple[float, float]:
    """Return (X, Y), in section radii, of the first impact of a symmetric half orbit."""
    k, rho = system.parameter.k_and_rho(point.p)
    if system.line == FIX_R:
        return (k * float(point.data[XI]) - 1.0) / rho, 0.0
    x, v, w = landing(float(point.data[XI]), float(point.data[TIMES]))
    return (k * x - 1.0) / rho, (v - k * w) / (rho * math.sqrt((1.0 + k) / k))
