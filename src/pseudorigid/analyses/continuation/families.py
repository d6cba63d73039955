"""Families of periodic orbits: curves, their events and their ends."""

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import pairwise
from typing import NamedTuple

from ...kernel.arithmetic import sincos
from .asymmetric import AsymmetricOrbits
from .curve import Curve, Point, locate, part_of_chord, trace
from .symmetric import Orbits

# Separation from a shorter or symmetric orbit, in section radii, where a curve has arrived there.
COLLAPSED = 3e-4
# Largest |trace - 2| there. Where an impact grazes, rounds of an orbit come near each other too.
_RESTS = 0.1
_STRONG = 4  # largest order of the resonances at which islands vanish
# Products B C below this are rounding: their signs are no events.
_NOISE = 1e-8


class Event(NamedTuple):
    """Something that happens to an orbit of a family at one point of its curve."""

    kind: str  # fold, doubling, pitchfork, resonance
    turns: int
    order: int  # the children have the parent's period times this
    point: Point
    at: float  # place along the family, an index of its points


@dataclass
class End:
    """How a family ends."""

    kind: str  # range, resonance, doubling, pitchfork, touch, rim, closed, unresolved
    p: float
    q: float
    family: int = -1  # the parent, or the family on the other side of the grazing
    turns: int = 0
    order: int = 0
    impact: int = -1  # the flight that touches, or the impact that grazes, along the half orbit
    point: Point | None = None


@dataclass
class Family:
    """A curve of symmetric periodic orbits."""

    system: Orbits | AsymmetricOrbits
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


def follow(system: Orbits | AsymmetricOrbits, start: Point, grazing: Callable[..., End]) -> Family:
    """Follow the family of a solution in both directions.

    `grazing(system, point)` returns the end of a curve that cannot be followed beyond a point.
    """

    def collapsed(point: Point) -> bool:
        near = system.separation(point) < COLLAPSED
        return near and abs(system.trace(point) - 2.0) < _RESTS

    curves: list[Curve] = [trace(system, start, 1.0, collapsed)]
    if curves[0].reason == "closed":
        points = [*curves[0].points[:-1], start]
        return Family(system, points, [End("closed", start.p, start.q) for _ in range(2)])
    curves.append(trace(system, start, -1.0, collapsed))
    points = [*reversed(curves[1].points), *curves[0].points[1:]]
    ends = []
    for curve in reversed(curves):
        last = curve.points[-1]
        end = End(curve.reason, last.p, last.q, point=last)
        ends.append(grazing(system, last) if curve.reason == "blocked" else end)
    return Family(system, points, ends)


def find_events(family: Family, longest: int) -> None:
    """Find folds, pitchforks, doublings and resonances of a family, and put them on its curve.

    Resonances are those whose children have periods up to `longest`, and those of orders 3 and 4,
    at which islands vanish.
    """
    system = family.system
    points: list[Point] = [family.points[0]]
    marks: list[tuple[int, str]] = []
    tests = system.tests
    last: list[Point | None] = [
        family.points[0] if size(family.points[0]) >= _NOISE else None for _, _, size in tests
    ]
    for new in family.points[1:]:
        inside = []
        for i, (kind, value, size) in enumerate(tests):
            if size(new) < _NOISE:
                continue
            old, last[i] = last[i], new
            if old is not None and value(old) * value(new) < 0.0:
                event = locate(system, old, new, value)
                if event is not None:
                    inside.append((part_of_chord(system, points[-1], new, event), kind, event))
        for _, kind, event in sorted(inside, key=lambda item: item[0]):
            points.append(event)
            marks.append((len(points) - 1, kind))
        points.append(new)
    family.points = points
    family.events = [
        Event(kind, 1, 2 if kind == "doubling" else 1, points[i], float(i)) for i, kind in marks
    ]
    for turns, order in fractions(max(_STRONG, longest // family.period)):
        wanted = 2.0 * sincos(2.0 * math.pi * turns / order)[1]

        def above(point: Point, wanted: float = wanted) -> float:
            return system.trace(point) - wanted

        for i, (old, new) in enumerate(pairwise(points)):
            if above(old) * above(new) < 0.0 or above(new) == 0.0:
                event = locate(system, old, new, above)
                if event is not None:
                    at = i + part_of_chord(system, old, new, event)
                    family.events.append(Event("resonance", turns, order, event, at))
    family.events.sort(key=lambda event: event.at)


def fractions(order: int) -> list[tuple[int, int]]:
    """Return (turns, order) of the resonances of orders from 3 to `order` below one half."""
    return [
        (turns, q)
        for q in range(3, order + 1)
        for turns in range(1, (q + 1) // 2)
        if math.gcd(turns, q) == 1
    ]
