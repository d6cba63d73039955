"""Search for families without symmetry: from pitchforks, from each other, and beyond grazings."""

import math
from typing import NamedTuple

import numpy as np

from ...kernel.arithmetic import sincos
from .asymmetric import NO_GUESS, POINTS, ROOM, TOTAL, AsymmetricOrbits, evaluate_orbit
from .curve import Place, Point, correct, dot
from .families import COLLAPSED, End, Event, Family, find_events, follow
from .grazing import beyond_rim, beyond_touch, grazing
from .search import NEAR_EVENT, SHORTER, Search, first_point

_ASIDE = 3e-3  # distance from an event, in section radii, at which its branch is entered
_FARTHER = 1.0, 3.0, 9.0  # that distance at resonances, in this unit
_ANGLES = 12  # per branch, at which branches of a resonance are sought
_NEWTON_STEPS = 8
_UNTURNED = 1e-10  # largest angle from its ray, in radians, of a point that stays on it
_SAME = 1e-7  # distance, in section radii, below which two points are the same
_NEAR_PITCHFORK = 1e-3  # largest distance, in p and total time, from an end to its pitchfork


def break_symmetry(search: Search) -> None:
    """Add to a search the families without symmetry that are connected with its families.

    They branch off at pitchforks of symmetric families, and at period doublings and resonances of
    each other, and go on with one impact more or less where one grazes.
    """
    branches = _Branches(search)
    for family in list(search.families):
        for event in family.events:
            if family.line >= 0 and event.kind == "pitchfork":
                branches.from_pitchfork(family, event)
    number = 0
    while number < len(search.families):
        family = search.families[number]
        number += 1
        for event in family.events:
            if family.line < 0 and event.kind in ("doubling", "resonance"):
                branches.from_event(family, event)
        for end in family.ends:
            branches.beyond(family, end)
    for family in search.families:
        for end in family.ends:
            if family.line < 0 and end.kind == "collapse":
                branches.parent(family, end)


class _Branches:
    """Families without symmetry of a search."""

    def __init__(self, search: Search):
        self.search, self.families = search, search.families
        self.parameter = search.parameter
        self.systems = {
            period: AsymmetricOrbits(period, search.parameter)
            for period in range(1, search.longest + 1)
        }

    def from_pitchfork(self, family: Family, event: Event) -> None:
        """Add the family that branches off at a pitchfork, unless it is known."""
        known = any(
            end.kind == "pitchfork" and end.family == family.number and end.p == event.point.p
            for branch in self.families
            if branch.line < 0
            for end in branch.ends
        )
        start = None if known else self._aside(family, event)
        if start is not None:
            branch = self._append(self._followed(family.period, start))
            for end in branch.ends:
                if end.kind == "collapse":
                    self._pitchfork(branch, end)

    def from_event(self, family: Family, event: Event) -> None:
        """Add the families that branch off at a doubling or a resonance."""
        period = family.period * event.order
        if period <= self.search.longest:
            beside = _beside_doubling if event.kind == "doubling" else _beside_resonance
            for start in beside(self.systems[period], event):
                self._add(period, start)

    def beyond(self, family: Family, end: End) -> None:
        """Add the families that go on with one impact more or less where one grazes."""
        period = family.period + (1 if end.kind == "touch" else -1)
        if end.kind not in ("touch", "rim") or not 1 <= period <= self.search.longest:
            return
        partners = [o for o in self.search.grazing_ends() if o[0].line < 0 or family.line < 0]
        if any(self.search.meet(family, end, *other) for other in partners):
            return
        system = self.systems[period]
        last = family.points[0 if end is family.ends[0] else -1]
        if end.kind == "touch":
            place = last.place if family.line < 0 else (*first_point(family.system, last), last.p)
            for start in beyond_touch(system, place, symmetric=family.line >= 0):
                self._add(period, start)
        elif family.line < 0:
            levels = self.search.levels_beside(end.p)
            for start in beyond_rim(system, family.system, last, levels):
                self._add(period, start)

    def parent(self, branch: Family, end: End) -> None:
        """Find the event of a shorter family without symmetry at which a family ends."""
        shorter = self.systems[branch.period].shorter(end.point, SHORTER)
        if shorter == branch.period:
            self._pitchfork(branch, end)
            return
        order, best, distance = branch.period // shorter, None, NEAR_EVENT
        for parent in self.families:
            if (parent.period, parent.line < 0) != (shorter, True):
                continue
            for event in parent.events:
                away = self._away(branch, end, parent, event, order)
                if event.order == order and away < distance:
                    best, distance = (parent, event), away
        if best is not None:
            parent, event = best
            end.kind, end.family = event.kind, parent.number
            end.turns, end.order = event.turns, event.order
            end.p = event.point.p

    def _away(self, branch: Family, end: End, parent: Family, event: Event, rounds: int) -> float:
        """Return how far, in p and total time, an end is from an event of another family."""
        away = abs(event.point.p - end.p) / (self.parameter.high - self.parameter.low)
        time = rounds * parent.system.time(event.point) - branch.system.time(end.point)
        return away + abs(time)

    def _pitchfork(self, branch: Family, end: End) -> None:
        """Find the pitchfork of a symmetric family at which a branch without symmetry ends."""
        best, distance = None, _NEAR_PITCHFORK
        for parent in self.families:
            if (parent.period, parent.line < 0) != (branch.period, False):
                continue
            for event in parent.events:
                away = self._away(branch, end, parent, event, 1)
                if event.kind == "pitchfork" and away < distance:
                    best, distance = (parent, event), away
        if best is not None:
            parent, event = best
            end.kind, end.family, end.turns, end.order = "pitchfork", parent.number, 1, 1
            end.p, end.q = event.point.p, first_point(parent.system, event.point)[0]

    def _add(self, period: int, start: Point) -> None:
        """Follow the family of an orbit unless a known family holds it."""
        if self._held(period, start):
            return
        branch = self._followed(period, start)
        if not self._held(period, branch.points[len(branch.points) // 2]):
            self._append(branch)

    def _held(self, period: int, point: Point) -> bool:
        """Return whether a known family holds an orbit or its mirror image."""
        place = np.array(point.place[:2])
        return any(
            np.any(np.max(np.abs(self.systems[period].orbit(z) - at), axis=1) < _SAME)
            for family in self.families
            if family.line < 0 and family.period == period
            for z in self.search.crossings(family, point.p)
            for at in (place, place * np.array([1.0, -1.0]))
        )

    def _followed(self, period: int, start: Point) -> Family:
        branch = follow(self.systems[period], start, grazing)
        find_events(branch, self.search.longest)
        return branch

    def _append(self, branch: Family) -> Family:
        branch.number = len(self.families)
        self.families.append(branch)
        return branch

    def _aside(self, family: Family, event: Event) -> Point | None:
        """Return an orbit without symmetry beside a pitchfork, or None."""
        system = self.systems[family.period]
        point = system.point((*first_point(family.system, event.point), event.point.p))
        if point is None:
            return None
        # Start at the orbit's point that is farthest from the rim, where derivatives are bounded.
        place = system.innermost(point)
        point = system.point((*place, event.point.p))
        if point is None:
            return None
        (a, b, _), (c, d, _) = point.gradients
        across = (b, -a) if abs(a) + abs(b) > abs(c) + abs(d) else (d, -c)
        size = math.sqrt(dot(across, across))
        if not 0.0 < size < math.inf:
            return None
        along = (across[0] / size, across[1] / size, 0.0)
        beside = (place[0] + _ASIDE * along[0], place[1] + _ASIDE * along[1], event.point.p)
        start = correct(system, beside, along, _ASIDE)
        if start is None or system.separation(start) < COLLAPSED:
            return None
        return start


def _beside_doubling(system: AsymmetricOrbits, event: Event) -> list[Point]:
    """Return orbits of twice the period beside a period doubling."""
    x, y, p = event.point.place
    a, c, b, d = event.point.data[:4].tolist()  # of P^n
    across = (b, -(a + 1.0)) if abs(a + 1.0) + abs(b) > abs(c) + abs(d + 1.0) else (d + 1.0, -c)
    size = math.sqrt(dot(across, across))
    if not 0.0 < size < math.inf:
        return []
    along = (across[0] / size, across[1] / size, 0.0)
    start = correct(system, (x + _ASIDE * along[0], y + _ASIDE * along[1], p), along, _ASIDE)
    return [] if start is None or system.separation(start) < COLLAPSED else [start]


class _Ray(NamedTuple):
    """A ray from the parent's orbit through a small ellipse that the linearized map keeps."""

    outward: tuple[float, float]  # to the ellipse
    around: tuple[float, float]  # along the ellipse, to the next quarter


def _beside_resonance(system: AsymmetricOrbits, event: Event) -> list[Point]:
    """Return orbits of q times the period beside a resonance p/q.

    At each point of a small ellipse around the parent, which the linearized map keeps, the
    parameter is chosen so that P^n brings the point back to its ray. Between two points that P^n
    moves in opposite directions along their rays is an orbit.
    """
    a, c = event.point.data[:2].tolist()  # of the parent's map
    sine, cosine = sincos(2.0 * math.pi * event.turns / event.order)
    conjugate = (a - cosine) / sine, c / sine
    size = _ASIDE / math.sqrt(1.0 + dot(conjugate, conjugate))
    found = []
    for radius in (size * factor for factor in _FARTHER):
        before = None
        for i in range(2 * _ANGLES + 1):
            sine, cosine = sincos(math.pi * i / (_ANGLES * event.order))
            ray = _Ray(
                (radius * (cosine + sine * conjugate[0]), radius * sine * conjugate[1]),
                (radius * (cosine * conjugate[0] - sine), radius * cosine * conjugate[1]),
            )
            moved = _moved_outward(system, event.point, ray)
            if moved is not None and before is not None and moved[0] * before < 0.0:
                length = math.sqrt(dot(ray.outward, ray.outward))
                along = (ray.outward[0] / length, ray.outward[1] / length, 0.0)
                start = correct(system, moved[1], along, length)
                if start is not None and system.separation(start) > COLLAPSED:
                    found.append(start)
            before = None if moved is None else moved[0]
    return found


def _moved_outward(
    system: AsymmetricOrbits, parent: Point, ray: _Ray
) -> tuple[float, Place] | None:
    """Return how far P^n moves a point along its ray, and the place where it stays on the ray."""
    ((a, b, x_p), (c, d, y_p)), (x, y, p) = parent.gradients, parent.place
    determinant = a * d - b * c
    wedge = ray.outward[0] * ray.around[1] - ray.outward[1] * ray.around[0]
    if 0.0 in (determinant, wedge):
        return None
    drift = (b * y_p - d * x_p) / determinant, (c * x_p - a * y_p) / determinant
    out = np.empty(ROOM)
    for _ in range(_NEWTON_STEPS):
        at_x = x + (p - parent.p) * drift[0] + ray.outward[0]
        at_y = y + (p - parent.p) * drift[1] + ray.outward[1]
        k, rho = system.parameter.k_and_rho(p)
        if not at_x * at_x + at_y * at_y < 1.0:
            return None
        evaluate_orbit(system.period, system.parameter.kind, k, rho, at_x, at_y, NO_GUESS, out)
        last_x, last_y = out[POINTS + 2 * system.period : POINTS + 2 * system.period + 2].tolist()
        a, c, b, d, x_p, y_p = out[:TOTAL].tolist()
        x_p += (a - 1.0) * drift[0] + b * drift[1]
        y_p += c * drift[0] + (d - 1.0) * drift[1]
        turned = (ray.outward[0] * (last_y - at_y) - ray.outward[1] * (last_x - at_x)) / wedge
        rate = (ray.outward[0] * y_p - ray.outward[1] * x_p) / wedge
        if abs(turned) < _UNTURNED:
            along = ray.around[1] * (last_x - at_x) - ray.around[0] * (last_y - at_y)
            return along / wedge, (at_x, at_y, p)
        if not 0.0 < abs(rate) < math.inf:
            return None
        p -= turned / rate
        if not abs(p - parent.p) < 0.05 * system.scale:
            return None
    return None
