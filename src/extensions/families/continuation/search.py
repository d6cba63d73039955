"""Search for all families: brute force on a grid, branch switching, parents and partners."""

from collections.abc import Callable, Iterator
from itertools import product

import numpy as np

from .asymmetric import NO_LINE, AsymmetricOrbits
from .curve import Point, at_parameter, solve_at
from .families import End, Event, Family, follow
from .half_orbit import FIX_R, FIX_RP
from .starts import beyond_rim, beyond_touch, starts_beside
from .symmetric import CELLS, Orbits, Parameter, lines, roots

# Distances in the parameter's range at which branches are sought beside an event, and distances in
# q from the parent's point between which they are.
_BESIDE = 1e-6, 1e-5, 1e-4, 1e-3
_OFFSETS = np.cumprod(np.append(1e-5, np.full(399, 1.0204)))
_NEAR_RIM, _NEAR_TIME = 2e-5, 1e-2  # of a grazing orbit from its partner, in p and total time
# Largest distance, in p and in q or total time, from a collapsed end to the parent's event.
_NEAR_EVENT = 1e-3
_MARGIN = 0.01  # in a position, beyond the ends of a step along a curve, in which the curve stays
_AT_REST = 0.999  # |q| on both lines, above which the ball is all but at rest on the floor
_GRID = (2.0 * np.arange(CELLS) + 1.0) / CELLS - 1.0  # positions on a symmetry line


class Search:
    """All families that brute force on a grid of the parameter and branch switching find.

    A system of orbits is named by its period and its line, which is NO_LINE for orbits without
    symmetry.
    """

    def __init__(self, parameter: Parameter, longest: int):
        self.parameter, self.longest = parameter, longest
        self.systems: dict[tuple[int, int], Orbits | AsymmetricOrbits] = {}
        for period in range(1, longest + 1):
            for line in lines(period):
                self.systems[period, line] = Orbits(line, period, parameter)
            self.systems[period, NO_LINE] = AsymmetricOrbits(period, parameter)
        self.families: list[Family] = []
        self.starts: list[tuple[int, int, float, float]] = []  # of each symmetric family
        self._curves: dict[int, tuple[np.ndarray, np.ndarray]] = {}

    def resume(self, starts: list[tuple[int, int, float, float]]) -> None:
        """Follow the families again of which an earlier search kept the starts."""
        for period, line, q, p in starts:
            point = self.systems[period, line].point((q, p))
            if point is None:
                raise ValueError("the starts are not those of this search")
            self._append(follow(self.systems[period, line], point, self.longest), point)

    def add(self, period: int, line: int, point: Point) -> None:
        """Follow the family of a solution unless a known family holds it."""
        if self.held(period, line, point):
            return
        family = follow(self.systems[period, line], point, self.longest)
        # Next to its end at a shorter orbit a known family has no points; farther away it has.
        middle = family.points[len(family.points) // 2]
        if not self.held(period, line, middle):
            self._append(family, point)

    def held(self, period: int, line: int, point: Point) -> bool:
        """Return whether a family holds a solution."""
        return any(
            (family.period, family.line) == (period, line) and self._holds(family, point)
            for family in self.families
        )

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
                if at is not None and family.system.same(at, point):
                    return True
        return False

    def _curve(self, family: Family) -> tuple[np.ndarray, np.ndarray]:
        """Return the parameters (n,) of a family's points, and all their positions (n, ...)."""
        if family.number not in self._curves:
            self._curves[family.number] = (
                np.array([point.p for point in family.points]),
                np.array([family.system.positions(point) for point in family.points]),
            )
        return self._curves[family.number]

    def _append(self, family: Family, start: Point) -> None:
        family.number = len(self.families)
        self.families.append(family)
        self.starts.append((family.period, family.line, start.q, start.p))

    def sweep(self, levels: list[float], first: int = 0) -> Iterator[int]:
        """Add the families of all solutions on a grid of the parameter, a level at a time.

        Yields the number of levels done. `first` levels are left out.
        """
        for done, p in enumerate(levels[first:], first + 1):
            for line in (FIX_R, FIX_RP):
                periods = [n for n in range(1, self.longest + 1) if line in lines(n)]
                for start in roots(self.parameter, p, line, _GRID, periods):
                    self.add(*start)
            yield done

    def complete(self, report: Callable[[int], None] = lambda done: None) -> None:
        """Add families that branch off or go on beyond a grazing, and name all ends.

        `report` is called with the number of families done, of a growing list.

        Families without symmetry branch off at pitchforks of symmetric ones, and at period
        doublings and resonances of each other, and go on with one impact more or less where one
        grazes.
        """
        for done, family in enumerate(self.families):  # the list grows
            report(done)
            self._add_branches(family, "resonance", "doubling")
            for end in family.ends:
                if end.kind in ("rim", "touch"):
                    self._go_on(family, end)
        for family in list(self.families):
            self._add_branches(family, "pitchfork")
        for done, family in enumerate(self.families):
            report(done)
            if family.line == NO_LINE:
                self._add_branches(family, "resonance", "doubling")
            for end in family.ends:
                if end.kind in ("rim", "touch"):
                    self._go_on_without_symmetry(family, end)
        self._link()

    def _add_branches(self, family: Family, *kinds: str) -> None:
        for event in family.events:
            if event.kind in kinds:
                for start in self.branches(family, event):
                    self.add(*start)

    def branches(self, family: Family, event: Event) -> list[tuple[int, int, Point]]:
        """Return (period, line, point) of the orbits next to an event that branch off there."""
        period = family.period * event.order
        if period > self.longest:
            return []
        if event.kind == "pitchfork" or family.line == NO_LINE:
            starts = starts_beside(self.systems[period, NO_LINE], family.system, event)
            return [(period, NO_LINE, start) for start in starts]
        found = []
        for p in self._levels_beside(event.point.p):
            near = solve_at(family.system, (event.point.q, p), 0.05)
            if near is None:  # past a fold of the parent
                near = event.point
            for line, q in family.system.symmetric_points(near):
                found += self._beside(period, line, q, p)
        return found

    def _go_on(self, family: Family, end: End) -> None:
        """Add the symmetric families that go on where an impact of this one grazes."""
        if any(self._meet(family, end, *other) for other in self._grazing_ends()):
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
        for line, q in family.system.symmetric_points(end.point):
            # At rest on the floor an orbit passes from one line to the other.
            sides = (FIX_R, FIX_RP) if abs(q) > _AT_REST else (line,)
            for p in self._levels_beside(end.p):
                for period, side in product(dict.fromkeys(periods), sides):
                    for start in self._beside(period, side, q, p):
                        self.add(*start)

    def _go_on_without_symmetry(self, family: Family, end: End) -> None:
        """Add the families without symmetry that go on where an impact of this one grazes."""
        period = family.period + (1 if end.kind == "touch" else -1)
        if not 1 <= period <= self.longest:
            return
        for other in self._grazing_ends():
            if NO_LINE in (family.line, other[0].line) and self._meet(family, end, *other):
                return
        system, starts = self.systems[period, NO_LINE], []
        last = family.points[0 if end is family.ends[0] else -1]
        if end.kind == "touch":
            place = family.system.first_place(last)
            starts = beyond_touch(system, place, symmetric=family.line != NO_LINE)
        elif family.line == NO_LINE:
            starts = beyond_rim(system, family.system, last, self._levels_beside(end.p))
        for start in starts:
            self.add(period, NO_LINE, start)

    def _levels_beside(self, p: float) -> list[float]:
        """Return parameters on both sides of one, within the range."""
        low, high = self.parameter.low, self.parameter.high
        beside = (p + sign * part * (high - low) for part in _BESIDE for sign in (-1.0, 1.0))
        return [value for value in beside if low < value < high]

    def _beside(self, period: int, line: int, q: float, p: float) -> list[tuple[int, int, Point]]:
        """Return (period, line, point) of the orbits on both sides of a point of a line."""
        if line not in lines(period):
            return []
        grids = (q + _OFFSETS, q - _OFFSETS)
        return [
            start
            for grid in grids
            for start in roots(self.parameter, p, line, grid[np.abs(grid) < 1.0], [period])
        ]

    def _link(self) -> None:
        """Name the parents of families that begin at an event of another one, and partners."""
        for family in self.families:
            for end in family.ends:
                if end.kind == "collapse":
                    self._name_parent(family, end)
        for family in self.families:
            for end in family.ends:
                if end.kind == "rim":
                    self._name_partner(family, end)

    def _name_parent(self, family: Family, end: End) -> None:
        """Find the event of a shorter or more symmetric orbit at which a family ends."""
        origins = [item for item in self._origins(family, end) if item[0] < _NEAR_EVENT]
        end.kind = "unresolved"
        if origins:
            _, parent, event, q = min(origins, key=lambda item: item[0])
            end.kind, end.family = event.kind, parent.number
            end.turns, end.order = event.turns, event.order
            end.p, end.q = event.point.p, q

    def _origins(self, family: Family, end: End) -> Iterator[tuple[float, Family, Event, float]]:
        """Yield how far events are at which a family may end, their families, they, and their q."""
        period = family.system.shorter(end.point)
        at_pitchfork = period == family.period
        symmetric = family.line != NO_LINE
        for parent in self.families:
            if (parent.period, parent.line != NO_LINE) != (period, symmetric or at_pitchfork):
                continue
            for event in parent.events:
                if event.order != family.period // period:
                    continue
                away = abs(event.point.p - end.p) / (self.parameter.high - self.parameter.low)
                if symmetric:
                    for line, q in parent.system.symmetric_points(event.point):
                        if line == family.line:
                            yield away + abs(q - end.q), parent, event, q
                elif not at_pitchfork or event.kind == "pitchfork":
                    time = event.order * parent.system.time(event.point)
                    q = parent.system.first_place(event.point)[0] if at_pitchfork else end.q
                    yield away + abs(time - family.system.time(end.point)), parent, event, q

    def _grazing_ends(self) -> Iterator[tuple[Family, End]]:
        """Yield the ends at which an impact grazes."""
        for family in self.families:
            yield from ((family, end) for end in family.ends if end.kind in ("rim", "touch"))

    @staticmethod
    def _meet(first: Family, end: End, second: Family, other: End) -> int:
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

    def _name_partner(self, family: Family, end: End) -> None:
        """Find the family whose flight touches the floor where an impact of this one grazes."""
        for other, touch in self._grazing_ends():
            rounds = self._meet(family, end, other, touch)
            if rounds:
                end.family, end.p = other.number, touch.p
                if rounds == 1 and (family.line == NO_LINE) == (other.line == NO_LINE):
                    touch.family = family.number
                return
