"""Pseudo-arclength continuation of solutions of n equations in n positions and a parameter.

n is 1 or 2. A place is (position, ..., parameter). Lengths and vectors are in scaled coordinates,
(position, ..., parameter/scale). The equations orient a curve: the unit tangent is the normalized
cross product of their gradients, and never changes its sign along a curve. At the neighbouring zero
of an equation the gradient points the other way, so a step to a neighbouring curve is noticed.
"""

import math
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple, Protocol

import numpy as np

Place = tuple[float, ...]

LARGEST_STEP, FIRST_STEP, LEAST_STEP = 0.02, 1e-3, 1e-11
# Least cosine of the angle by which the tangent turns in a step, and from predictor to solution.
_STRAIGHT = 0.98
_CORRECTION = 0.25  # largest distance from predictor to solution, in units of the step
_CONTROL_CHANGE = 0.2  # largest change of an entry of Point.controls in a step
# Least factor by which a vector of Point.separations shrinks in a step, and cosine of its turn.
_SHRINK, _TURN = 0.6, 0.7
_NEWTON_STEPS = 12
_ROUNDING = 1e-9  # Newton steps below this that no longer fall have reached rounding
_DEFECT_DROP = 0.1  # a defect that falls by this factor is progress, even if the step does not
_DEFECT = 1e-5  # largest defect of a solution; at a jump the Newton steps shrink but it does not
_HALVINGS = 30  # bisections of a chord, to find a parameter
_CUTS = 200  # most cuts of a chord, to locate an event
MOST_POINTS = 20_000


class Point(NamedTuple):
    """A point near or on a curve."""

    place: Place
    defect: Place  # values of the equations
    gradients: tuple[Place, ...]  # of each equation
    controls: np.ndarray  # quantities that may change by at most _CONTROL_CHANGE in a step
    # Differences between points of an orbit, or of its mirror image, that vanish only where the
    # curve ends because the orbit merges with a shorter or more symmetric one.
    separations: tuple[np.ndarray, ...]
    data: Any  # the orbit, as the System represents it

    @property
    def q(self) -> float:
        """The first position."""
        return self.place[0]

    @property
    def p(self) -> float:
        """The parameter."""
        return self.place[-1]


class System(Protocol):
    """Equations whose solutions are curves."""

    scale: float  # change of the parameter that counts as the length 1
    limits: tuple[float, float]  # range of the parameter

    def point(self, place: Place) -> Point | None:
        """Evaluate the equations at a place; None where they are not defined."""


def dot(a: Place, b: Place) -> float:
    return sum(x * y for x, y in zip(a, b, strict=True))


def cross(a: Place, b: Place) -> Place:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def _scaled_gradients(system: System, point: Point) -> list[Place]:
    """Return the gradients of the equations with respect to the scaled coordinates."""
    return [(*row[:-1], row[-1] * system.scale) for row in point.gradients]


def tangent(system: System, point: Point) -> Place:
    """Return the unit tangent, in scaled coordinates, or NaN if the gradients are dependent."""
    rows = _scaled_gradients(system, point)
    vector = (-rows[0][1], rows[0][0]) if len(rows) == 1 else cross(*rows)
    size = math.sqrt(dot(vector, vector))
    return tuple(x / size for x in vector) if 0.0 < size < math.inf else (math.nan,) * len(vector)


def displaced(system: System, place: Place, vector: Place, length: float = 1.0) -> Place:
    """Return the place that is reached from a place by a scaled vector times a length."""
    steps = (*vector[:-1], vector[-1] * system.scale)
    return tuple(x + length * step for x, step in zip(place, steps, strict=True))


def distance(system: System, first: Place, last: Place) -> float:
    """Return the maximum norm of the difference of two places in scaled coordinates."""
    *ends, parameter = (abs(a - b) for a, b in zip(first, last, strict=True))
    return max(*ends, parameter / system.scale)


def newton_step(rows: Sequence[Place], values: Place) -> Place | None:
    """Return the step at which linear functions with these gradients and values vanish, or None."""
    if len(rows) == 2:
        (a, b), (c, d) = rows
        vectors: list[Place] = [(d, -c), (-b, a)]
    else:
        first, second, third = rows
        vectors = [cross(second, third), cross(third, first), cross(first, second)]
    determinant = dot(rows[0], vectors[0])
    if not 0.0 < abs(determinant) < math.inf:
        return None
    return tuple(
        -sum(h * vector[i] for h, vector in zip(values, vectors, strict=True)) / determinant
        for i in range(len(rows))
    )


def correct(system: System, place: Place, along: Place, radius: float) -> Point | None:
    """Return the solution in the plane through a place that is normal to `along`, or None.

    Newton's method may move by at most 2 `radius`. With two equations, whose gradients are nearly
    dependent at large multipliers, it also continues while only the defect falls.
    """
    first, previous, previous_defect = place, math.inf, math.inf
    for _ in range(_NEWTON_STEPS):
        point = system.point(place)
        if point is None:
            return None
        step = newton_step([*_scaled_gradients(system, point), along], (*point.defect, 0.0))
        if step is None:
            return None
        size, defect = max(map(abs, step)), max(map(abs, point.defect))
        defect_falls = len(along) > 2 and defect < _DEFECT_DROP * previous_defect
        stalls = previous <= _ROUNDING and size >= 0.25 * previous and not defect_falls
        converged = size <= 4e-17 or stalls
        if converged:
            break
        falls = size < 0.7 * previous or defect_falls
        previous, previous_defect, converged = size, defect, size <= _ROUNDING
        place = displaced(system, place, step)
        if not (falls and distance(system, first, place) <= 2.0 * radius):
            return None
    return point if converged and defect < _DEFECT else None


def solve_at(system: System, place: Place, radius: float) -> Point | None:
    """Return the solution near a place that has the place's parameter, or None."""
    return correct(system, place, (*(0.0,) * (len(place) - 1), 1.0), radius)


def _acceptable(system: System, old: Point, predicted: Point, new: Point, step: float) -> bool:
    """Return whether so little changes in a step that the new point is on the old one's curve."""
    before, expected, after = (tangent(system, point) for point in (old, predicted, new))
    if not (dot(before, after) > _STRAIGHT and dot(expected, after) > _STRAIGHT):
        return False
    if not distance(system, new.place, predicted.place) <= _CORRECTION * step:
        return False
    if not np.all(np.abs(new.controls - old.controls) <= _CONTROL_CHANGE):
        return False
    for first, last in zip(old.separations, new.separations, strict=True):
        square, last_square = float(np.sum(first * first)), float(np.sum(last * last))
        if last_square < _SHRINK * _SHRINK * square:
            return False
        if not np.sum(first * last) > _TURN * math.sqrt(square * last_square):
            return False
    return True


def continue_curve(
    system: System, start: Point, sign: float, collapsed: Callable[[Point], bool]
) -> tuple[list[Point], str]:
    """Return the points of a curve from one of them to its end, and why it stops.

    The direction is that of the tangent if `sign` is 1, and opposite if it is -1. `collapsed` says
    whether a point is so near to the curve's end, where a vector of `separations` vanishes, that
    the curve need not be followed further. The reasons are "range", "closed", "collapse", and
    "blocked" if not even LEAST_STEP leads on or there are MOST_POINTS.
    """
    points, step = [start], FIRST_STEP
    low, high = system.limits
    while len(points) < MOST_POINTS:
        old = points[-1]
        along = tuple(sign * x for x in tangent(system, old))
        place = displaced(system, old.place, along, step)
        predicted = system.point(place)
        new = correct(system, place, along, step) if predicted else None
        if not (predicted and new and _acceptable(system, old, predicted, new, step)):
            step *= 0.5
            if step < LEAST_STEP:
                break
            continue
        if not low <= new.p <= high:
            end = at_parameter(system, old, new, high if new.p > high else low)
            return [*points, *filter(None, [end])], "range"
        points.append(new)
        if collapsed(new):
            return points, "collapse"
        if len(points) > 3 and _returns(system, start, old, new):
            return points, "closed"
        step = min(1.5 * step, LARGEST_STEP)
    return points, "blocked"


def continue_both_ways(
    system: System, start: Point, collapsed: Callable[[Point], bool]
) -> tuple[list[Point], list[str]]:
    """Return the points of a curve through a point on it, and why it stops at its two ends."""
    ahead, last = continue_curve(system, start, 1.0, collapsed)
    if last == "closed":
        return [*ahead[:-1], start], ["closed", "closed"]
    back, first = continue_curve(system, start, -1.0, collapsed)
    return [*reversed(back), *ahead[1:]], [first, last]


def _chord(system: System, first: Point, last: Point) -> tuple[Place, float]:
    """Return the unit vector from one point to another, in scaled coordinates, and its length."""
    difference = [b - a for a, b in zip(first.place, last.place, strict=True)]
    vector = (*difference[:-1], difference[-1] / system.scale)
    length = math.sqrt(dot(vector, vector))
    return tuple(x / length if length > 0.0 else 0.0 for x in vector), length


def part_of_chord(system: System, first: Point, last: Point, point: Point) -> float:
    """Return where a point projects onto the chord from `first` (0) to `last` (1)."""
    along, length = _chord(system, first, last)
    across, away = _chord(system, first, point)
    return dot(along, across) * away / length if length > 0.0 else 0.0


def _returns(system: System, start: Point, old: Point, new: Point) -> bool:
    """Return whether the step from `old` to `new` passes `start` with about the same tangent."""
    if not dot(tangent(system, start), tangent(system, new)) > _STRAIGHT:
        return False
    part = part_of_chord(system, old, new, start)
    along, length = _chord(system, old, new)
    beside = distance(system, displaced(system, old.place, along, part * length), start.place)
    return 0.0 <= part <= 1.0 and beside <= 0.05 * length


def _hermite_place(system: System, first: Point, last: Point, share: float) -> Place:
    """Return the place at a share, 0 to 1, of the Hermite cubic between two points of a curve."""
    along, length = _chord(system, first, last)
    tangents = [tangent(system, point) for point in (first, last)]
    start, end = (
        tuple(math.copysign(length, dot(vector, along)) * x for x in vector) for vector in tangents
    )
    if not all(map(math.isfinite, (*start, *end))):
        start = end = tuple(length * x for x in along)
    rest = 1.0 - share
    by_start, by_end = share * rest * rest, -share * share * rest
    by_chord = share * share * (3.0 - 2.0 * share) * length
    vectors = zip(start, end, along, strict=True)
    vector = tuple(by_chord * c + by_start * a + by_end * b for a, b, c in vectors)
    return displaced(system, first.place, vector)


def locate(
    system: System, first: Point, last: Point, value: Callable[[Point], float]
) -> Point | None:
    """Return the point between two points of a curve at which `value` of the point changes sign.

    `value` must have opposite signs at the two points. The interval of shares is cut by secants
    (the Illinois rule), with bisection as a safeguard, until its ends are neighbouring doubles or
    |value| no longer falls. Returns None where a point on the way is not found.
    """
    along, length = _chord(system, first, last)
    low, high = 0.0, 1.0
    at_low, at_high = value(first), value(last)
    best, least = (first, abs(at_low)) if abs(at_low) < abs(at_high) else (last, abs(at_high))
    weight_low, weight_high, idle = at_low, at_high, 0
    for turn in range(_CUTS):
        share = low + (high - low) * (weight_low / (weight_low - weight_high))
        if turn % 4 == 3 or not low < share < high:
            share = 0.5 * (low + high)
        if share in (low, high):
            break
        place = _hermite_place(system, first, last, share)
        point = correct(system, place, along, length) if length > 0.0 else first
        if point is None:
            return None
        here = value(point)
        idle = 0 if abs(here) < least else idle + 1
        if abs(here) <= least:
            best, least = point, abs(here)
        if here == 0.0 or (idle > 8 and high - low < 1e-9):
            break
        if (here > 0.0) == (at_low > 0.0):
            low, weight_low, weight_high = share, here, 0.5 * weight_high
        else:
            high, weight_high, weight_low = share, here, 0.5 * weight_low
    return best


def at_parameter(system: System, first: Point, last: Point, p: float) -> Point | None:
    """Return the point at the parameter p between two points of a curve, or None.

    Newton's method at fixed p starts from the Hermite cubic. If it leaves the neighbourhood of the
    two points, `locate` finds the point along the curve.
    """
    if p in (first.p, last.p):
        return first if p == first.p else last
    low, high = 0.0, 1.0
    for _ in range(_HALVINGS):
        share = 0.5 * (low + high)
        if (_hermite_place(system, first, last, share)[-1] < p) == (first.p < p):
            low = share
        else:
            high = share
    length = distance(system, first.place, last.place)
    point = solve_at(system, (*_hermite_place(system, first, last, high)[:-1], p), length)
    if point is not None:
        a, b, x = (np.array(each.place[:-1]) for each in (first, last, point))
        margin = 0.25 * np.abs(a - b) + 1e-9
        if np.all((np.minimum(a, b) - margin <= x) & (x <= np.maximum(a, b) + margin)):
            return point
    near = locate(system, first, last, lambda point: point.p - p)
    if near is None:
        return None
    return solve_at(system, (*near.place[:-1], p), length) or near
