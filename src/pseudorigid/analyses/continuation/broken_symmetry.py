"""Starts of families without symmetry beside pitchforks, period doublings and resonances."""

import math

from ...kernel.arithmetic import sincos
from .asymmetric import TOTAL, AsymmetricOrbits
from .curve import Place, Point, correct, cramer, dot
from .families import Event
from .symmetric import COLLAPSED, NO_GUESS, Orbits

_ASIDE = 3e-3  # distance from an event, in section radii, at which its branch is entered
_FARTHER = 1.0, 3.0, 9.0  # that distance at resonances, in this unit
_ANGLES = 12  # per branch, at which branches of a resonance are sought
_NEWTON_STEPS = 8
_UNTURNED = 1e-10  # largest angle from its ray, in radians, of a point that stays on it

Vector = tuple[float, float]


def starts_beside(
    system: AsymmetricOrbits, parent: Orbits | AsymmetricOrbits, event: Event
) -> list[Point]:
    """Return orbits of a system beside the event of another one at which they branch off."""
    if event.kind == "pitchfork":
        return _beside_pitchfork(system, parent, event)
    return (_beside_doubling if event.kind == "doubling" else _beside_resonance)(system, event)


def _beside_pitchfork(system: AsymmetricOrbits, parent: Orbits, event: Event) -> list[Point]:
    """Return an orbit without symmetry beside a pitchfork of a symmetric one."""
    point = system.point(parent.first_place(event.point))
    if point is None:
        return []
    # Start at the orbit's point that is farthest from the rim, where derivatives are bounded.
    point = system.point((*system.innermost(point), event.point.p))
    if point is None:
        return []
    (a, b, _), (c, d, _) = point.gradients
    return _aside(system, point.place, _kernel(a, b, c, d), _ASIDE, _ASIDE)


def _beside_doubling(system: AsymmetricOrbits, event: Event) -> list[Point]:
    """Return orbits of twice the period beside a period doubling."""
    a, c, b, d = event.point.data[:4].tolist()  # of P^n
    across = _kernel(a + 1.0, b, c, d + 1.0)
    return _aside(system, event.point.place, across, _ASIDE, _ASIDE)


def _kernel(a: float, b: float, c: float, d: float) -> Vector:
    """Return a vector of which a singular matrix makes nothing."""
    return (b, -a) if abs(a) + abs(b) > abs(c) + abs(d) else (d, -c)


def _aside(
    system: AsymmetricOrbits, place: Place, across: Vector, distance: float, reach: float
) -> list[Point]:
    """Return the orbit beside a place in a direction, unless it is a more symmetric one."""
    size = math.sqrt(dot(across, across))
    if not 0.0 < size < math.inf:
        return []
    x, y, p = place
    along = (across[0] / size, across[1] / size, 0.0)
    beside = (x + distance * along[0], y + distance * along[1], p)
    start = correct(system, beside, along, reach)
    return [start] if start is not None and system.separation(start) > COLLAPSED else []


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
            # to the ellipse, and along it to the next quarter
            outward = radius * (cosine + sine * conjugate[0]), radius * sine * conjugate[1]
            around = radius * (cosine * conjugate[0] - sine), radius * cosine * conjugate[1]
            moved = _moved_outward(system, event.point, outward, around)
            if moved is not None and before is not None and moved[0] * before < 0.0:
                found += _aside(system, moved[1], outward, 0.0, math.sqrt(dot(outward, outward)))
            before = None if moved is None else moved[0]
    return found


def _moved_outward(
    system: AsymmetricOrbits, parent: Point, outward: Vector, around: Vector
) -> tuple[float, Place] | None:
    """Return how far P^n moves a point along its ray, and the place where it stays on the ray."""
    ((a, b, x_p), (c, d, y_p)), (x, y, p) = parent.gradients, parent.place
    drift = cramer([(a, b), (c, d)], (x_p, y_p))
    wedge = outward[0] * around[1] - outward[1] * around[0]
    if drift is None or wedge == 0.0:
        return None
    for _ in range(_NEWTON_STEPS):
        at_x = x + (p - parent.p) * drift[0] + outward[0]
        at_y = y + (p - parent.p) * drift[1] + outward[1]
        if not at_x * at_x + at_y * at_y < 1.0:
            return None
        data, (dx, dy) = system.tracked((at_x, at_y, p), NO_GUESS)
        a, c, b, d, x_p, y_p = data[:TOTAL].tolist()
        x_p += (a - 1.0) * drift[0] + b * drift[1]
        y_p += c * drift[0] + (d - 1.0) * drift[1]
        turned = (outward[0] * dy - outward[1] * dx) / wedge
        rate = (outward[0] * y_p - outward[1] * x_p) / wedge
        if abs(turned) < _UNTURNED:
            return (around[1] * dx - around[0] * dy) / wedge, (at_x, at_y, p)
        if not 0.0 < abs(rate) < math.inf:
            return None
        p -= turned / rate
        if not abs(p - parent.p) < 0.05 * system.scale:
            return None
    return None
