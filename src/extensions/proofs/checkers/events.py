"""Energies at which periodic orbits double their period or lose an impact.

Each event is a regular zero of equations in the energy and perhaps a position, enclosed by interval
Newton; theory/births.md has the equations and what follows from a zero.
"""

from collections.abc import Sequence
from fractions import Fraction
from functools import partial

from flint import arb, ctx

from pseudorigid.verified.flight import Flight, NotProvedError, UndecidedError, launch

from ..enclosure.jets import Jet, algebra
from ..enclosure.surface import Surface, first_root, flight_of_constants
from .certificate import (
    Certificate,
    Finding,
    Range,
    box,
    check_stated,
    check_within,
    holds_throughout,
    lower_bound,
    naming,
)
from .newton import System, enclose_zero, solve
from .periodic import BITS, CLOSE, check_distinct

_MOST_CUTS = 60  # halvings of a time until the flight is proved to have left the floor

Half = tuple[int, str]  # flights of a half orbit, and where it ends: "impact" or "apex"


def check_doubling(
    text: str,
    k: Fraction,
    g: Fraction,
    *,
    period: int,
    trace: int,
    radius: Fraction,
    energies: Range,
    positions: Range,
) -> Finding:
    """Prove that an orbit of even period doubles its period, at one energy and position.

    The orbit meets y = 0 in two points, the first at the position x. Of the half orbit between
    them, the derivative of x by x vanishes, so that the trace is -2. Both unknowns are alone in a
    square of at least the radius.
    """
    if trace != -2 or period % 2:
        raise NotProvedError("a period doubling of an even period has the trace -2")
    with ctx.workprec(BITS):
        certificate = Certificate(text, "period doubling", ball=(k, g))
        energy, x = _prove_event(certificate, partial(doubling, k, g, period=period), 2, radius)
        check_within("energy", energy, energies)
        check_within("position", x, positions)
        ends = (_after_impacts(k, g, (energy, x), n, order=1) for n in range(1, period // 2 + 1))
        check_distinct([(x, arb(0)), *((a.coefficients[0], b.coefficients[0]) for a, b in ends)])
        slope = _trace_slope(k, g, (energy, x), period)
        if not slope < 0:
            raise NotProvedError("the trace is not proved to fall through -2")
        margins = {"radius": float(certificate.number("radius")), "slope": lower_bound(-slope)}
        return Finding({"energy": energy, "x": x, "slope of the trace": slope}, margins)


def check_grazing(
    text: str,
    k: Fraction,
    g: Fraction,
    *,
    halves: tuple[Half, ...],
    periods: tuple[int, int],
    sides: tuple[int, int],
    radius: Fraction,
    energies: Range,
) -> Finding:
    """Prove that a periodic orbit has an impact that grazes, at one energy.

    There an orbit with one or two impacts that graze and one without these meet; `periods` has
    theirs, and `sides` 1 for an orbit that exists above this energy and -1 for one below. With one
    half orbit the ball is at rest at the grazing impact; with two they lead forwards and, mirrored,
    backwards from it, and its mirror image grazes too.
    """
    longer = 2 * sum(flights for flights, _ in halves) + sum(end == "apex" for _, end in halves)
    if periods != (longer, longer - len(halves)):
        raise NotProvedError(f"the orbits have the periods {longer}, {longer - len(halves)}")
    with ctx.workprec(BITS):
        certificate = Certificate(text, "grazing orbit", ball=(k, g))
        system = partial(grazing, k, g, halves=halves)
        values = _prove_event(certificate, system, len(halves), radius)
        check_within("energy", values[0], energies)
        slopes = []  # of the energy, by the contact speed or by the gap, along the zeros
        for by in ("speed", "gap"):
            _, rows = system(values, by=by)
            slopes.append(-solve(rows, [row[len(values)] for row in rows])[0])
        for slope, sign, name in zip(slopes, sides, ("longer", "shorter"), strict=True):
            if not sign * slope > 0:
                where = "above" if sign > 0 else "below"
                raise NotProvedError(f"the {name} orbit is not proved to exist {where} the energy")
        named_slopes = dict(zip(("dE/ds", "dE/dh"), slopes, strict=True))
        margins = {name: lower_bound(abs(slope)) for name, slope in named_slopes.items()}
        return Finding(
            dict(zip(("energy", "y"), values, strict=False)) | named_slopes,
            {"radius": float(certificate.number("radius"))} | margins,
        )


def _prove_event(
    certificate: Certificate, system: System, unknowns: int, radius: Fraction
) -> list[arb]:
    """Prove that a system has one zero in the certificate's box, and enclose it narrowly."""
    centre = certificate.row("event", unknowns)
    boxes = box(centre, certificate.at_least("radius", radius) + CLOSE)
    with naming("the box around the event"):
        values = enclose_zero(system, boxes)
    check_stated("event", values, centre, CLOSE)
    return values


def _land(flight: Flight, gap: Jet | int = 0) -> tuple[Jet, Jet, Jet]:
    """Return x, xdot, udot at the end of a flight; it begins with a small gap above the floor."""
    tau = first_root(flight)
    if isinstance(gap, Jet):  # f(tau) = gap, to first order, around gap = 0
        tau = tau + gap * (1 / flight.slope(tau).constant)
    return flight.end(tau)


def grazing(
    k: Fraction, g: Fraction, values: Sequence[arb], halves: tuple[Half, ...], by: str = ""
) -> tuple[list[arb], list[list[arb]]]:
    """Return the conditions of a grazing orbit, and their derivatives by E, y and `by`.

    Each half orbit begins at a point of the rim with x < -g, the second one at its mirror image. It
    ends with y = 0 before an impact, or at the apex of a flight with U' = 0. `by` is "speed", the
    contact speed s of the impact, or "gap", by which the flight misses the floor.
    """
    inertia, gravity, _ = Surface(k, g, Fraction(0)).constants()
    jets = Jet.series(algebra(len(values) + 1, 1), *values, arb(0))
    energy, unfold, zero = jets[0], jets[-1], 0 * jets[-1]
    speed = unfold if by == "speed" else zero
    gap = unfold if by == "gap" else zero
    ends = []
    for i, (flights, where) in enumerate(halves):
        y = (-1) ** i * jets[1] if len(values) > 1 else zero
        v, w = (y + inertia * speed) / (1 + inertia), (speed - y) / (1 + inertia)
        square = gravity * gravity + inertia * (
            2 * energy - 2 * gravity * gap - v * v - inertia * w * w
        )
        if not square.constant > 0:
            raise UndecidedError("there may be no point of the rim")
        x = (gravity - square.sqrt()) / inertia
        flight = launch(inertia, gravity, x, v, w, speed)
        for leg in range(flights):
            x, v, w = _land(flight, gap if leg == 0 else 0)
            flight = launch(inertia, gravity, x, v, w, v + w)
        ends.append(v - inertia * w if where == "impact" else _strain_rate_at_apex(flight))
    return [e.constant for e in ends], [e.coefficients[1:] for e in ends]


def _strain_rate_at_apex(flight: Flight) -> Jet:
    """Return the rate of strain where the centre is highest in a flight."""
    t = flight.b * (-1 / flight.g)
    if not t.constant > 0:
        raise UndecidedError("a flight may have no apex")
    _check_clear(flight_of_constants(flight), t.constant.upper())
    return flight.end(t)[2]


def _check_clear(flight: Flight, until: arb) -> None:
    """Prove that a flight does not touch the floor up to a time; a touch may follow at once.

    Near 0, f <= -s t + (g + x) t^2/2 - c t^3/6 + A t^4/24, and s must not be negative. Raises
    UndecidedError.
    """
    if not flight.s >= 0:
        raise UndecidedError("the contact speed may be negative")
    amplitude = (flight.x * flight.x + flight.c * flight.c).sqrt()
    bend, jerk = (flight.g + flight.x).upper(), abs(flight.c).upper()
    first = until
    for _ in range(_MOST_CUTS):
        rest = jerk * first / 6 + amplitude * first * first / 24
        if bend / 2 + rest < 0 or -flight.s + first * (abs(bend) / 2 + rest) < 0:
            break
        first = first / 2
    else:
        raise UndecidedError("the impact may be grazing")
    if not holds_throughout(lambda t: flight.height(t) < 0, first.lower(), until, until / 10**6):
        raise UndecidedError("an impact may come before the apex")


def _after_impacts(
    k: Fraction, g: Fraction, values: Sequence[arb], impacts: int, order: int
) -> tuple[Jet, Jet]:
    """Return (x, y) after some impacts from (x, 0), as jets in E, x and y."""
    inertia, gravity, _ = Surface(k, g, Fraction(0)).constants()
    energy, x, y = Jet.series(algebra(3, order), *values, arb(0))
    square = (1 + inertia) * (2 * energy + x * (2 * gravity - inertia * x)) - y * y
    if not square.constant > 0:
        raise UndecidedError("a point is not proved to lie inside the section's rim")
    s = (square / inertia).sqrt()
    v, w = (y + inertia * s) / (1 + inertia), (s - y) / (1 + inertia)
    for _ in range(impacts):
        x, v, w = _land(launch(inertia, gravity, x, v, w, v + w))
    return x, v - inertia * w


def doubling(
    k: Fraction, g: Fraction, values: Sequence[arb], period: int
) -> tuple[list[arb], list[list[arb]]]:
    """Return y and dx/dx after half a period, and the derivatives of both by E and x."""
    x, y = _after_impacts(k, g, values, period // 2, order=2)
    slopes = [[y[1, 0, 0], y[0, 1, 0]], [x[1, 1, 0], 2 * x[0, 2, 0]]]
    return [y.constant, x[0, 1, 0]], slopes


def _trace_slope(k: Fraction, g: Fraction, values: Sequence[arb], period: int) -> arb:
    """Return the derivative by E, along the family, of the trace 4 A D - 2 where A = dx/dx = 0."""
    _, y = _after_impacts(k, g, values, period // 2, order=1)
    _, ((y_energy, y_x), (by_energy, by_x)) = doubling(k, g, values, period)
    return 4 * y[0, 0, 1] * (by_energy - by_x * y_energy / y_x)
