"""Families of periodic orbits: curves, their events and their ends."""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from pseudorigid.kernel.arithmetic import sincos

from .asymmetric import NO_LINE, AsymmetricOrbits
from .curve import Place, Point, continue_both_ways, locate, newton_step, part_of_chord
from .half_orbit import FIX_RP
from .symmetric import COLLAPSED, SymmetricOrbits

# Largest |trace - 2| at a collapse. Where an impact grazes, rounds of an orbit come near each other
# too.
_RESTS = 0.1
_STRONG = 4  # largest order of the resonances at which islands vanish
# Residues below this are rounding: the signs of what vanishes with them are no events.
_NOISE = 1e-8
_SLOW = 1e-3  # contact speed, in units where g = 1, of an impact that all but grazes
_ROUNDING = 1e-14  # of a value, over its gradient
_NEWTON_STEPS = 30  # to a touch
FAR = 1e-4  # a touch farther than this from the last point of a curve is another one

OrbitSystem = SymmetricOrbits | AsymmetricOrbits


class Event(NamedTuple):
    """Something that happens to an orbit of a family at one point of its curve."""

    kind: str  # fold, doubling, pitchfork, resonance
    turns: int
    order: int  # the children have the parent's period times this
    point: Point
    curve_index: float  # its place along the family, an index of its points


@dataclass
class End:
    """How a family ends."""

    kind: str  # range, resonance, doubling, pitchfork, touch, rim, closed, unresolved
    point: Point  # the last one of the curve, or the touching orbit
    p: float  # parameter of the event or grazing, or of the point
    impact: int = -1  # the flight that touches, or the impact that grazes, along the half orbit
    family: int = -1  # the parent, or the family on the other side of the grazing
    turns: int = 0  # p and q of the parent's rotation number p/q
    order: int = 0


@dataclass
class Family:
    """A curve of periodic orbits."""

    system: OrbitSystem
    points: list[Point]
    ends: list[End]
    events: list[Event] = field(default_factory=list)
    number: int = -1

    @property
    def period(self) -> int:
        """Number of impacts."""
        return self.system.period

    @property
    def line(self) -> int:
        """Symmetry line on which the positions lie."""
        return self.system.line

    @property
    def symmetric(self) -> bool:
        """Whether the orbits meet the symmetry lines."""
        return self.line != NO_LINE

    @cached_property
    def places(self) -> tuple[np.ndarray, np.ndarray]:
        """The parameters (n,) of the points, and all their positions (n, ...)."""
        positions = [self.system.positions(point) for point in self.points]
        return np.array([point.p for point in self.points]), np.array(positions)

    @property
    def grazings(self) -> list[End]:
        """The ends at which an impact grazes."""
        return [end for end in self.ends if end.kind in ("rim", "touch")]


def follow(system: OrbitSystem, start: Point, longest: int) -> Family:
    """Follow the family of a solution to both its ends, and find its events.

    Resonances are those whose children have periods up to `longest`, and those of orders 3 and 4,
    at which islands vanish.
    """

    def collapsed(point: Point) -> bool:
        near = system.separation(point) < COLLAPSED
        return near and abs(system.trace(point) - 2.0) < _RESTS

    points, reasons = continue_both_ways(system, start, collapsed)
    ends = [
        _grazing(system, last) if reason == "blocked" else End(reason, last, last.p)
        for reason, last in zip(reasons, (points[0], points[-1]), strict=True)
    ]
    family = Family(system, points, ends)
    _find_events(family, longest)
    return family


def _grazing(system: OrbitSystem, last: Point) -> End:
    """Return the grazing end that is next to the last point of a blocked curve.

    It is a touch, where a flight meets the floor without an impact and is solved for, or at the
    rim, where the speed of an impact vanishes.
    """
    speed, times = last.data.lowest_speed, last.data.times
    heights = system.heights(last.place, times, np.full(times.size, np.nan))
    touching = not np.all(np.isnan(heights[:, 1]))
    flight = int(np.nanargmax(heights[:, 1])) if touching else -1
    symmetric = system.line != NO_LINE
    if symmetric:
        at_rim = not touching or 0.5 * speed * speed < -float(heights[flight, 1])
    else:
        at_rim = speed < 2.0 * _SLOW
    if at_rim:
        return End("rim", last, last.p)
    point = _touch(system, last, flight, float(heights[flight, 0])) if touching else None
    if point is not None:
        return End("touch", point, point.p, flight)
    if symmetric and speed < _SLOW:
        return End("rim", last, last.p, flight)
    return End("unresolved", last, last.p, flight if symmetric else -1)


def _touch(system: OrbitSystem, last: Point, flight: int, time: float) -> Point | None:
    """Return the orbit near a given one whose flight touches the floor near a time, or None."""
    place: Place | None
    if isinstance(system, SymmetricOrbits) and (system.line, flight, time) == (FIX_RP, 0, 0.0):
        place = _at_rest(system, last)
    else:
        place = _touching(system, last, flight, time)
    if place is None or not _is_next_to(place, last):
        return None
    return last._replace(place=place, data=system.tracked(place, last.data.times)[0])


def _at_rest(system: SymmetricOrbits, last: Point) -> Place:
    """Return the place on Fix RP next to an orbit at which the ball is at rest on the floor."""
    q, p = math.copysign(1.0, last.q), last.p
    for _ in range(_NEWTON_STEPS):
        data, (defect,) = system.tracked((q, p), last.data.times)
        step = -defect / data.h_p
        p += step
        if abs(step) < 1e-15 * p:
            break
    return q, p


def _touching(system: OrbitSystem, last: Point, flight: int, time: float) -> Place | None:
    """Return the place near an orbit from which a flight touches the floor, or None."""
    near = np.full(last.data.times.size, np.nan)
    near[flight] = time

    def values(place: Place) -> Place:
        data, defect = system.tracked(place, last.data.times)
        return *defect, float(system.heights(place, data.times, near)[flight, 1])

    least, best, place = math.inf, last.place, last.place
    for _ in range(_NEWTON_STEPS):
        here = values(place)
        error = sum(map(abs, here))
        if error < least:
            least, best = error, place
        elif least < 1e-12:
            break
        columns = []
        for i in range(len(place)):
            step = 1e-7 * (place[-1] if i == len(place) - 1 else 1.0)
            beside = values(tuple(z + step * (i == j) for j, z in enumerate(place)))
            columns.append([(b - a) / step for a, b in zip(here, beside, strict=True)])
        newton = newton_step(list(zip(*columns, strict=True)), here)
        if newton is None:
            return None
        place = tuple(z + dz for z, dz in zip(place, newton, strict=True))
        if not _is_next_to(place, last):
            return None
    # The largest gradients, times the rounding of the place, are the rounding of the values.
    scales = [max(1.0, abs(z)) for z in best]
    sizes = sum(z * abs(x) for z, row in zip(scales, columns, strict=True) for x in row)
    return best if least < max(1e-11, _ROUNDING * sizes) else None


def _is_next_to(place: Place, last: Point) -> bool:
    pairs = zip(place, last.place, strict=True)
    return all(abs(a - b) < FAR * max(1.0, abs(b)) for a, b in pairs)


def _find_events(family: Family, longest: int) -> None:
    """Find folds, pitchforks, doublings and resonances of a family, and put them on its curve."""
    system, points = family.system, family.points
    marks = []
    for kind, monitor in system.monitors:
        sure = [
            i
            for i, point in enumerate(points)
            if kind == "doubling" or system.residue(point) >= _NOISE
        ]
        for i, part, event in _zeros(system, points, sure, monitor):
            marks.append((i, part, kind, event))
    for before, (i, _, kind, event) in enumerate(sorted(marks, key=lambda mark: mark[:2])):
        points.insert(i + before, event)
        order = 2 if kind == "doubling" else 1
        family.events.append(Event(kind, 1, order, event, float(i + before)))
    for turns, order in fractions(max(_STRONG, longest // family.period)):
        wanted = 2.0 * sincos(2.0 * math.pi * turns / order)[1]

        def above(point: Point, wanted: float = wanted) -> float:
            return system.trace(point) - wanted

        for i, part, event in _zeros(system, points, range(len(points)), above):
            family.events.append(Event("resonance", turns, order, event, i - 1 + part))
    family.events.sort(key=lambda event: event.curve_index)


def _zeros(
    system: OrbitSystem,
    points: list[Point],
    numbers: Sequence[int],
    value: Callable[[Point], float],
) -> Iterator[tuple[int, float, Point]]:
    """Yield the zeros of a function between points of a curve that are given by their numbers.

    With each are the number of the point after it, and where it lies along the last step to there.
    """
    for i, j in pairwise(numbers):
        before, after = value(points[i]), value(points[j])
        if before * after < 0.0 or after == 0.0:
            zero = locate(system, points[i], points[j], value)
            if zero is not None:
                yield j, part_of_chord(system, points[j - 1], points[j], zero), zero


def fractions(order: int) -> list[tuple[int, int]]:
    """Return (turns, order) of the resonances of orders from 3 to `order` below one half."""
    return [
        (turns, q)
        for q in range(3, order + 1)
        for turns in range(1, (q + 1) // 2)
        if math.gcd(turns, q) == 1
    ]
