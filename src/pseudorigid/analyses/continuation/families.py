"""Families of periodic orbits: curves, their events and their ends."""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import NamedTuple

from ...kernel.arithmetic import sincos
from .asymmetric import AsymmetricOrbits
from .curve import Point, System, locate, part_of_chord, trace_both_ways
from .grazing import End, grazing
from .symmetric import COLLAPSED, Orbits

# Largest |trace - 2| at a collapse. Where an impact grazes, rounds of an orbit come near each other
# too.
_RESTS = 0.1
_STRONG = 4  # largest order of the resonances at which islands vanish
# Residues below this are rounding: the signs of what vanishes with them are no events.
_NOISE = 1e-8


class Event(NamedTuple):
    """Something that happens to an orbit of a family at one point of its curve."""

    kind: str  # fold, doubling, pitchfork, resonance
    turns: int
    order: int  # the children have the parent's period times this
    point: Point
    at: float  # place along the family, an index of its points


@dataclass
class Family:
    """A curve of periodic orbits."""

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


def follow(system: Orbits | AsymmetricOrbits, start: Point, longest: int) -> Family:
    """Follow the family of a solution to both its ends, and find its events.

    Resonances are those whose children have periods up to `longest`, and those of orders 3 and 4,
    at which islands vanish.
    """

    def collapsed(point: Point) -> bool:
        near = system.separation(point) < COLLAPSED
        return near and abs(system.trace(point) - 2.0) < _RESTS

    points, reasons = trace_both_ways(system, start, collapsed)
    ends = [
        grazing(system, last) if reason == "blocked" else End(reason, last.p, last.q, point=last)
        for reason, last in zip(reasons, (points[0], points[-1]), strict=True)
    ]
    family = Family(system, points, ends)
    _find_events(family, longest)
    return family


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
    family.events.sort(key=lambda event: event.at)


def _zeros(
    system: System, points: list[Point], numbers: Sequence[int], value: Callable[[Point], float]
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
