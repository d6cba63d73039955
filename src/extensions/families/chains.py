"""Curves over the plane of k and E/g^2: births of chains, and where they lose stability.

Along a curve an orbit folds, doubles its period or loses an impact. A place on a curve of folds or
doublings is (q, rho, k): the position of a symmetric half orbit on its line, and both parameters.
Its two equations are the half orbit's defect h = 0 and an entry of its derivatives, A, B, C or D,
that vanishes at the event. Continuation follows their solutions, also through folds in k. Energies
are in units where g = 1.
"""

import math
from itertools import pairwise
from typing import NamedTuple

import numpy as np
import xarray as xr

from extensions.atlas.cell import AXES
from pseudorigid.dynamics import fixed_point
from pseudorigid.dynamics.variables import described

from .continuation.curve import Place, Point, continue_both_ways, correct, solve_at
from .continuation.family import Event, Family
from .continuation.half_orbit import ENERGY, FIX_R, scan
from .continuation.search import Search
from .continuation.symmetric import COLLAPSED, Parameter, PeriodicOrbits, SymmetricOrbits

KINDS = "resonance", "fold", "doubling", "rim", "jumps"
_POINTS = 401  # values of k of the curves that are solved for at each k
_SOUGHT = 8  # values of k at which a chain's events are sought
_ASIDE = 1.01  # factor from the least k of the doublings to where folds are sought
_SAME = 1e-2  # relative difference of energies of the same curve, between its points
_BEYOND = 0.01  # how far the curves reach beyond the cells, as a share of the axes' spans
# Steps of the differences from which Newton's method takes the gradients.
_STEP = 1e-6
# How far beyond a resonance its chain is sought, as a factor of rho.
_REACH = 0.5, 2.5
_NEAR = 0.05  # distance in q within which Newton's method may find the fixed point
_SLOW = 2e-3  # contact speed at which an orbit has all but lost an impact
_AT_REST = np.array([-1.0])  # the ball at rest on the floor, as a position on Fix R

Rows = list[tuple[float, float]]  # k and E/g^2


class Limits(NamedTuple):
    """The part of the plane in which curves are followed."""

    k: tuple[float, float]
    energy: tuple[float, float]


class Start(NamedTuple):
    """An event of a family at one k."""

    line: int
    entry: str  # name of the derivative that vanishes: a, b, c or d of a HalfOrbit
    place: Place


def chains(k: list[float], energy: list[float], chains: list[int]) -> xr.Dataset:
    """Follow births and losses of stability of the chains 1/q over the plane of a sweep.

    A chain is that of the period-q orbit that branches off where the fixed point's rotation number
    is 1/q. Its events are found at nine k at which this lies in the plane, and followed in k. The k
    and energies, E/g^2, of a sweep span the plane; its `chains` has the orders q.

    The kind of a curve is "resonance" 1/q of the fixed point, "fold" where an elliptic orbit of the
    chain is born or ends, its first "doubling", the "rim", where it loses an impact while the ball
    is at rest on the floor, or "jumps" (order 0), above which the map jumps. On `point` are the
    curves one after the other (CF).
    """
    (low, high), energies = (_wider(np.array(axis)) for axis in (k, energy))
    low = max(low, 1e-3)
    limits = Limits((low, high), energies)
    grid = [low + (high - low) * i / (_POINTS - 1) for i in range(_POINTS)]
    curves = [(0, "jumps", _within([(k, 1.0 + 0.5 * k) for k in grid], limits))]
    for order in chains:
        inside = _within([(k, fixed_point.resonance(k, 1, order)) for k in grid], limits)
        if inside:
            curves.append((order, "resonance", inside))
            curves += [(order, *curve) for curve in _events(order, inside, grid, limits)]
    curves = [curve for curve in curves if curve[-1]]
    points = np.array([pair for _, _, rows in curves for pair in rows]).reshape(-1, 2)
    table = {
        "order": ("curve", [order for order, _, _ in curves], "q of the chain 1/q; 0 for jumps"),
        "kind": ("curve", [kind for _, kind, _ in curves], ", ".join(KINDS)),
        "row_size": ("curve", [len(rows) for _, _, rows in curves], "points of each curve"),
    } | {axis: ("point", points[:, i], *AXES[axis]) for i, axis in enumerate(AXES)}
    data = described(table)
    data["row_size"][2]["sample_dimension"] = "point"
    return xr.Dataset(data)


def _wider(values: np.ndarray) -> tuple[float, float]:
    """Return the ends of an axis, a little farther apart."""
    margin = _BEYOND * (values[-1] - values[0])
    low = values[0] * (1.0 - _BEYOND) if 0.0 < values[0] < margin else values[0] - margin
    return float(low), float(values[-1] + margin)


def _within(rows: Rows, limits: Limits) -> Rows:
    """Return the rows whose energies lie in the plane."""
    low, high = limits.energy
    return [(k, energy) for k, energy in rows if low <= energy <= high]


def _events(
    order: int, resonance: Rows, grid: list[float], limits: Limits
) -> list[tuple[str, Rows]]:
    """Return (kind, rows) of folds, first doubling and rim of a chain.

    They are sought at some k at which the resonance lies in the plane, and next to the least k of
    the doublings, where folds are near. They are followed from the first k at which they are found,
    unless a curve already passes there.
    """
    curves: list[tuple[str, Rows]] = []

    def add(k: float) -> None:
        for kind, start in chain_events(k, order).items():
            energy = energy_at(start.place)
            if any(kind == known and _passes(rows, k, energy) for known, rows in curves):
                continue
            if kind == "rim":
                rows = _within(_rim(order, k, start.place[1], grid), limits)
            else:
                points = follow(order, start, limits)
                rows = [(float(z.place[2]), energy_at(z.place)) for z in points]
            if rows:
                curves.append((kind, rows if rows[0][0] < rows[-1][0] else rows[::-1]))

    for i in reversed(range(_SOUGHT)):
        add(resonance[(2 * i + 1) * len(resonance) // (2 * _SOUGHT)][0])
    ends = [rows[0][0] for kind, rows in curves if kind == "doubling"]
    if ends:
        add(_ASIDE * min(ends))
    return curves


def _passes(rows: Rows, k: float, energy: float) -> bool:
    """Return whether a curve passes through a point of the plane."""
    for (k0, e0), (k1, e1) in pairwise(rows):
        if min(k0, k1) <= k <= max(k0, k1) and k0 != k1:
            there = e0 + (e1 - e0) * (k - k0) / (k1 - k0)
            if abs(there - energy) <= _SAME * abs(energy):
                return True
    return False


def _rim(order: int, middle: float, rho: float, grid: list[float]) -> Rows:
    """Return (k, E/g^2) at which a chain loses an impact, from the k where rho is known."""
    rows = {}
    ends = [k for k in grid if k > middle], [k for k in reversed(grid) if k <= middle]
    for side in ends:
        near = rho
        for k in side:
            near = _lost_impact(k, order, near)
            if not near > 1.0:
                break
            rows[k] = energy_at((-1.0, near, k))
    return sorted(rows.items())


def _lost_impact(k: float, period: int, rho: float) -> float:
    """Return rho, next to a given one, at which an orbit of this period loses an impact at rest.

    At this impact, on Fix R at the section's rim, the ball is at rest on the floor. NaN if there is
    no such orbit.
    """

    def defect(value: float) -> float:
        return float(scan(FIX_R, k, value, _AT_REST, period)[0, period])

    last, here = rho * (1.0 + _STEP), rho
    defect_last, defect_here = defect(last), defect(here)
    for _ in range(60):
        if defect_here == defect_last or not here > 1.0:
            break
        step = defect_here * (here - last) / (defect_here - defect_last)
        last, here, defect_last = here, here - step, defect_here
        defect_here = defect(here)
        if abs(here - last) <= 1e-15 * here:
            return here
    return here if abs(here - last) <= 1e-13 * here else math.nan


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
    """Return E at a place (q, rho, k)."""
    _, rho, k = place
    return float(0.5 * (rho - 1.0) * (rho + 1.0) / k)


def follow(period: int, start: Start, limits: Limits) -> list[Point]:
    """Follow an event from where it was found, in both directions, as far as it goes."""
    system = Locus(start.line, period, start.entry, limits)
    first = correct(system, start.place, (0.0, 0.0, 1.0), _NEAR)
    if first is None:
        return []

    def collapsed(point: Point) -> bool:
        return system.separation(point) < COLLAPSED or point.data.lowest_speed < _SLOW

    return continue_both_ways(system, first, collapsed)[0]


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
        events = [event for event in family.events if event.kind != "resonance"]
        if [end.kind == "collapse" for end in family.ends] == [False, True]:
            events.reverse()  # so that they begin where the family is one with its parent
        for i, event in enumerate(events):
            if event.kind == "doubling":
                chains.append((event.point.p, family.number, events[: i + 1]))
                break
    if not chains:
        return {}
    # The other orbit of the chain may double its period too, far from its birth.
    _, number, (*earlier, doubling) = min(chains)
    family = search.families[number]
    starts = {"doubling": _start(family, doubling, k)}
    folds = [event for event in earlier if event.kind == "fold"]
    if folds:
        starts["fold"] = _start(family, folds[-1], k)
    rims = [end.p for end in family.ends if end.kind == "rim"]
    if rims:
        starts["rim"] = Start(family.line, "", (-1.0, rims[0], k))
    return starts


def _start(family: Family, event: Event, k: float) -> Start:
    """Return where to start following an event; a doubling is at a zero of A or of D."""
    half = event.point.data
    at_doubling = "a" if abs(half.a) <= abs(half.d) else "d"
    entry = "c" if event.kind == "fold" else at_doubling
    return Start(family.line, entry, (event.point.q, event.point.p, k))
