"""Curves over the plane of k and E along which an orbit folds or doubles its period.

A place is (q, rho, k): the position of a symmetric half orbit on its line, and both parameters. Its
two equations are the half orbit's defect h = 0 and an entry of its derivatives, A, B, C or D, that
vanishes at the event. `curve.trace` follows their solutions, also through folds in k.
"""

import math
from typing import NamedTuple

import numpy as np

from pseudorigid.dynamics import fixed_point

from .curve import Place, Point, correct, solve_at, trace_both_ways
from .families import Event, Family
from .half_orbit import ENERGY, FIX_R, scan
from .search import Search
from .symmetric import COLLAPSED, Parameter, PeriodicOrbits, SymmetricOrbits

# Steps of the differences from which Newton's method takes the gradients.
_STEP = 1e-6
# How far beyond a resonance its chain is sought, as a factor of rho.
_REACH = 0.5, 2.5
_NEAR = 0.05  # reach of Newton's method for the fixed point, in q
_SLOW = 2e-3  # contact speed at which an orbit has all but lost an impact
_AT_REST = np.array([-1.0])  # the ball at rest on the floor, as a position on Fix R


class Limits(NamedTuple):
    """The part of the plane, in units where g = 1."""

    k: tuple[float, float]
    energy: tuple[float, float]


class Start(NamedTuple):
    """An event of a family at one k."""

    line: int
    entry: str  # name of the derivative that vanishes: a, b, c or d of a HalfOrbit
    place: Place


class Locus(PeriodicOrbits):
    """Orbits of one period at which an entry of their derivatives vanishes, as a `System`."""

    def __init__(self, line: int, period: int, entry: str, limits: Limits):
        super().__init__(line, period, Parameter(ENERGY, math.nan, *limits.k))
        self.entry = entry
        self._energies = limits.energy

    def _orbit(self, place: Place) -> Point | None:
        """Return the half orbit at a place with the values of both equations, or None."""
        q, rho, k = place
        if not (k > 0.0 and rho > 0.0):
            return None
        orbits = SymmetricOrbits(self.line, self.period, Parameter(ENERGY, k, 0.0, math.inf))
        point = orbits.point((q, rho))
        if point is None:
            return None
        defect = point.defect[0], getattr(point.data, self.entry)
        return point._replace(place=place, defect=defect)

    def point(self, place: Place) -> Point | None:
        """Return the two equations at a place, or None outside the plane or without an orbit."""
        low, high = self._energies
        if not (place[2] > 0.0 and low <= energy_at(place) <= high):
            return None
        centre = self._orbit(place)
        if centre is None:
            return None
        columns = []
        for i in range(3):
            ahead, behind = (
                self._orbit(tuple(z + step * (i == j) for j, z in enumerate(place)))
                for step in (_STEP, -_STEP)
            )
            if ahead is None or behind is None:
                return None
            ends = zip(ahead.defect, behind.defect, strict=True)
            columns.append([(a - b) / (2.0 * _STEP) for a, b in ends])
        return centre._replace(gradients=tuple(zip(*columns, strict=True)))


def energy_at(place: Place) -> float:
    """Return E, in units where g = 1, at a place (q, rho, k)."""
    _, rho, k = place
    return 0.5 * (rho - 1.0) * (rho + 1.0) / k


def follow(period: int, start: Start, limits: Limits) -> list[Point]:
    """Follow an event from where it was found, in both directions, as far as it goes."""
    system = Locus(start.line, period, start.entry, limits)
    first = correct(system, start.place, (0.0, 0.0, 1.0), _NEAR)
    if first is None:
        return []

    def collapsed(point: Point) -> bool:
        return system.separation(point) < COLLAPSED or point.data.lowest_speed < _SLOW

    return trace_both_ways(system, first, collapsed)[0]


def lost_impact(k: float, period: int, rho: float) -> float:
    """Return rho, next to a given one, at which an orbit of this period loses an impact at rest.

    At this impact, on Fix R at the section's rim, the ball is at rest on the floor. NaN if there is
    no such orbit.
    """

    def defect(value: float) -> float:
        return float(scan(FIX_R, k, value, _AT_REST, period)[0, period])

    last, here = rho * (1.0 + _STEP), rho
    at_last, at = defect(last), defect(here)
    for _ in range(60):
        if at == at_last or not here > 1.0:
            break
        last, here, at_last = here, here - at * (here - last) / (at - at_last), at
        at = defect(here)
        if abs(here - last) <= 1e-15 * here:
            return here
    return here if abs(here - last) <= 1e-13 * here else math.nan


def chain_events(k: float, order: int) -> dict[str, Start]:
    """Find where the elliptic orbit of the chain 1/`order` is born and first doubles, at one k.

    The orbit branches off from the fixed point's resonance 1/`order`, and then its birth is not in
    the result, or is born with the orbit that does, at a `fold`. Other keys are `doubling`, and
    `rim`, where it loses an impact.
    """
    rho = math.sqrt(1.0 + 2.0 * k * fixed_point.resonance(k, 1, order))
    parameter = Parameter(ENERGY, k, max(_REACH[0] * rho, 1e-3), _REACH[1] * rho)
    search = Search(parameter, order)
    system = SymmetricOrbits(FIX_R, 1, parameter)
    x = fixed_point.place(k, fixed_point.half_time(k, parameter.energy(rho)))
    parent = solve_at(system, (system.position(rho, x), rho), _NEAR)
    if parent is None:
        return {}
    search.add(system, parent)
    fixed = search.families[0]
    for event in list(fixed.events):
        if (event.kind, event.turns, event.order) == ("resonance", 1, order):
            for start in search.branches(fixed, event):
                search.add(*start)
    chains = []
    for family in search.families[1:]:
        events = _from_birth(family)
        doublings = [event for event in events if event.kind == "doubling"]
        if doublings:
            chains.append((doublings[0].point.p, family.number, events, doublings[0]))
    if not chains:
        return {}
    # The other orbit of the chain may double its period too, far from its birth.
    _, number, events, doubling = min(chains)
    family = search.families[number]
    folds = [event for event in events[: events.index(doubling)] if event.kind == "fold"]
    starts = {"doubling": _start(family, doubling, k)}
    if folds:
        starts["fold"] = _start(family, folds[-1], k)
    rims = [end.p for end in family.ends if end.kind == "rim"]
    if rims:
        starts["rim"] = Start(family.line, "", (-1.0, rims[0], k))
    return starts


def _from_birth(family: Family) -> list[Event]:
    """Return the events of a family in order from the end at which it is one with its parent."""
    events = [event for event in family.events if event.kind != "resonance"]
    if family.ends[1].kind == "collapse" and family.ends[0].kind != "collapse":
        events.reverse()
    return events


def _start(family: Family, event: Event, k: float) -> Start:
    """Return where to start following an event; a doubling is at a zero of A or of D."""
    half = event.point.data
    at_doubling = "a" if abs(half.a) <= abs(half.d) else "d"
    entry = "c" if event.kind == "fold" else at_doubling
    return Start(family.line, entry, (event.point.q, event.point.p, k))
