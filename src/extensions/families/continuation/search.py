"""Search for all families: brute force on a grid, branch switching, parents and partners."""

from collections.abc import Iterator

import numpy as np

from .asymmetric import AsymmetricOrbits
from .curve import Point, at_parameter, solve_at
from .family import End, Event, Family, OrbitSystem, follow
from .half_orbit import FIX_R, FIX_RP
from .starts import beyond_rim, beyond_touch, starts_beside
from .symmetric import CELLS, Parameter, SymmetricOrbits, lines, roots

Start = tuple[OrbitSystem, Point]

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
    """All families that brute force on a grid of the parameter and branch switching find."""

    def __init__(self, parameter: Parameter, longest: int):
        self.parameter, self.longest = parameter, longest
        self.families: list[Family] = []
        self.starts: list[tuple[int, int, float, float]] = []  # period, line, q, p of each family

    def resume(self, starts: list[tuple[int, int, float, float]]) -> None:
        """Follow the symmetric families again of which an earlier search kept the starts."""
        for period, line, q, p in starts:
            system = SymmetricOrbits(line, period, self.parameter)
            point = system.point((q, p))
            if point is None:
                raise ValueError("the starts are not those of this search")
            self._append(follow(system, point, self.longest), point)

    def add(self, system: OrbitSystem, point: Point) -> None:
        """Follow the family of a solution unless a known family holds it."""
        if self.held(system, point):
            return
        family = follow(system, point, self.longest)
        # Next to its end at a shorter orbit a known family has no points; farther away it has.
        if not self.held(system, family.points[len(family.points) // 2]):
            self._append(family, point)

    def held(self, system: OrbitSystem, point: Point) -> bool:
        """Return whether any known family holds a solution."""
        return any(
            (family.period, family.line) == (system.period, system.line)
            and self._holds(family, point)
            for family in self.families
        )

    def _holds(self, family: Family, point: Point) -> bool:
        """Return whether one family holds a solution.

        Its place is solved for only on those parts of the curve that come near the solution.
        """
        levels, places = family.places
        below = levels < point.p
        (cells,) = np.nonzero(below[:-1] != below[1:])
        for i in cells.tolist():
            low, high = places[i : i + 2].min(axis=0), places[i : i + 2].max(axis=0)
            margin = _MARGIN + (high - low)
            if np.any((low - margin < point.q) & (point.q < high + margin)):
                first, last = family.points[i : i + 2]
                there = at_parameter(family.system, first, last, point.p)
                if there is not None and family.system.same(there, point):
                    return True
        return False

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

    def complete(self) -> Iterator[int]:
        """Add families that branch off or go on beyond a grazing, and name all ends.

        Yields the number of families done, of a growing list.

        Families without symmetry branch off at pitchforks of symmetric ones, and at period
        doublings and resonances of each other, and go on with one impact more or less where one
        grazes.
        """
        for done, family in enumerate(self.families):  # the list grows
            yield done
            self._add_branches(family, "resonance", "doubling")
            for end in family.grazings:
                self._go_on(family, end)
        for family in list(self.families):
            self._add_branches(family, "pitchfork")
        for done, family in enumerate(self.families):
            yield done
            if not family.symmetric:
                self._add_branches(family, "resonance", "doubling")
            for end in family.grazings:
                self._go_on_without_symmetry(family, end)
        for family in self.families:
            for end in family.ends:
                if end.kind == "collapse":
                    self._name_parent(family, end)
        for family in self.families:
            for end in family.ends:
                if end.kind == "rim":
                    self._name_partner(family, end)

    def _add_branches(self, family: Family, *kinds: str) -> None:
        for event in family.events:
            if event.kind in kinds:
                for start in self.branches(family, event):
                    self.add(*start)

    def branches(self, family: Family, event: Event) -> list[Start]:
        """Return the orbits next to an event that branch off there."""
        period = family.period * event.order
        if period > self.longest:
            return []
        if event.kind == "pitchfork" or not family.symmetric:
            system = AsymmetricOrbits(period, self.parameter)
            return [(system, start) for start in starts_beside(system, family.system, event)]
        found: list[Start] = []
        for p in self._levels_beside(event.point.p):
            near = solve_at(family.system, (event.point.q, p), 0.05)
            if near is None:  # past a fold of the parent
                near = event.point
            for line, q in family.system.symmetric_points(near):
                found += self._beside(period, line, q, p)
        return found

    def _go_on(self, family: Family, end: End) -> None:
        """Add the symmetric families beyond a symmetric one's end at which an impact grazes."""
        if any(self._meet(family, end, *other) for other in self._grazing_ends()):
            return
        if end.kind == "touch":  # one or two more impacts in each of several rounds
            rounds = range(1, self.longest // family.period + 1)
            periods = [r * family.period + more for r in rounds for more in range(1, 2 * r + 1)]
        else:
            periods = [family.period - 1, family.period - 2]
        periods = [n for n in dict.fromkeys(periods) if 1 <= n <= self.longest]
        for line, q in family.system.symmetric_points(end.point):
            # At rest on the floor an orbit passes from one line to the other.
            sides = (FIX_R, FIX_RP) if abs(q) > _AT_REST else (line,)
            for p in self._levels_beside(end.p):
                for period in periods:
                    for side in sides:
                        for start in self._beside(period, side, q, p):
                            self.add(*start)

    def _go_on_without_symmetry(self, family: Family, end: End) -> None:
        """Add the families without symmetry beyond an end at which an impact grazes."""
        period = family.period + (1 if end.kind == "touch" else -1)
        if not 1 <= period <= self.longest:
            return
        for other in self._grazing_ends():
            one_without = not (family.symmetric and other[0].symmetric)
            if one_without and self._meet(family, end, *other):
                return
        system, starts = AsymmetricOrbits(period, self.parameter), []
        last = family.points[0 if end is family.ends[0] else -1]
        if end.kind == "touch":
            starts = beyond_touch(system, family.system.first_place(last), family.symmetric)
        elif not family.symmetric:
            starts = beyond_rim(system, last, self._levels_beside(end.p))
        for start in starts:
            self.add(system, start)

    def _levels_beside(self, p: float) -> list[float]:
        """Return parameters on both sides of one, within the range."""
        low, high = self.parameter.low, self.parameter.high
        beside = (p + sign * part * (high - low) for part in _BESIDE for sign in (-1.0, 1.0))
        return [value for value in beside if low < value < high]

    def _beside(self, period: int, line: int, q: float, p: float) -> list[Start]:
        """Return the symmetric orbits of a period on both sides of a point of a line."""
        if line not in lines(period):
            return []
        return [
            start
            for grid in (q + _OFFSETS, q - _OFFSETS)
            for start in roots(self.parameter, p, line, grid[np.abs(grid) < 1.0], [period])
        ]

    def _name_parent(self, family: Family, end: End) -> None:
        """Name the event of a shorter or more symmetric orbit at which a family ends."""
        origins = [item for item in self._origins(family, end) if item[0] < _NEAR_EVENT]
        end.kind = "unresolved"
        if origins:
            _, parent, event = min(origins, key=lambda item: item[0])
            end.kind, end.family, end.p = event.kind, parent.number, event.point.p
            end.turns, end.order = event.turns, event.order

    def _origins(self, family: Family, end: End) -> Iterator[tuple[float, Family, Event]]:
        """Yield how far events are at which a family may end, their families and the events."""
        period = family.system.shorter(end.point)
        at_pitchfork = period == family.period
        for parent in self.families:
            if (parent.period, parent.symmetric) != (period, family.symmetric or at_pitchfork):
                continue
            for event in parent.events:
                if event.order != family.period // period:
                    continue
                away = abs(event.point.p - end.p) / (self.parameter.high - self.parameter.low)
                if family.symmetric:
                    for line, q in parent.system.symmetric_points(event.point):
                        if line == family.line:
                            yield away + abs(q - end.point.q), parent, event
                elif not at_pitchfork or event.kind == "pitchfork":
                    time = event.order * event.point.data.time
                    yield away + abs(time - end.point.data.time), parent, event

    def _grazing_ends(self) -> Iterator[tuple[Family, End]]:
        """Yield the ends of all families at which an impact grazes."""
        for family in self.families:
            yield from ((family, end) for end in family.grazings)

    @staticmethod
    def _meet(first: Family, end: End, second: Family, other: End) -> int:
        """Return in how many rounds of the shorter orbit two grazing ends meet, 0 if they do not.

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
            time = end.point.data.time - rounds * other.point.data.time
            if 1 <= grazing_impacts <= 2 * rounds and abs(time) < _NEAR_TIME:
                return rounds
        return 0

    def _name_partner(self, family: Family, end: End) -> None:
        """Name the family whose flight touches the floor where an impact of this one grazes."""
        for other, touch in self._grazing_ends():
            rounds = self._meet(family, end, other, touch)
            if rounds:
                end.family, end.p = other.number, touch.p
                if rounds == 1 and family.symmetric == other.symmetric:
                    touch.family = family.number
                return
