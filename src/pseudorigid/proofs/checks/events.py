"""Energies at which periodic orbits are born, double their period, or lose an impact.

Each event is a regular zero of equations in the energy and perhaps a position, enclosed by interval
Newton; docs/proofs.md ("Births and ends") has the equations and what follows from a zero.
"""

from collections.abc import Callable, Sequence
from fractions import Fraction

from flint import arb, arb_mat, ctx

from ..enclosure.fixed_point import energy_at, slope_at, trace_at
from ..enclosure.flight import Gap, UndecidedError, first_root
from ..enclosure.jets import Jet, algebra
from ..enclosure.surface import Surface, ball_of
from . import periodic
from .birkhoff import normal_form
from .certificate import Certificate, Finding, NotProvedError, box, lowest
from .periodic import BITS, CLOSE

_MOST_CUTS = 60  # halvings of a time until the flight is proved to have left the floor
_RADIUS = Fraction(1, 10**8)  # of the box in which the fixed point is proved at a resonance

# Values of the equations, and their derivatives by the unknowns and perhaps by more.
System = Callable[[Sequence[arb]], tuple[list[arb], list[list[arb]]]]
Range = tuple[Fraction, Fraction]
Half = tuple[int, str]  # flights of a half orbit, and where it ends: "impact" or "apex"


def check_resonance(
    text: str, k: Fraction, g: Fraction, *, rotation: Fraction, period: int, energies: Range
) -> Finding:
    """Prove that the fixed point passes a resonance with positive twist, at one energy.

    There its rotation number is `rotation` and rises with the energy, which lies in `energies`.
    Two orbits of this period branch off to higher energies.
    """
    if rotation.denominator != period or period < 5:
        raise NotProvedError(f"no two orbits of period {period} branch off at {rotation}")
    with ctx.workprec(BITS):
        certificate = Certificate(text, "resonance")
        certificate.check_ball(k, g)
        low, high = certificate.row("theta", 2)
        if not 0 < high - low <= CLOSE:
            raise NotProvedError("theta is not enclosed to 1e-30")
        inertia, gravity = _constants(k, g)
        ends = [ball_of(end) for end in (low, high)]
        if not (ends[0] > 0 and ends[1] < arb.pi()):
            raise NotProvedError("theta is not proved to lie between 0 and pi")
        wanted = 2 * (2 * arb.pi() * ball_of(rotation)).cos()
        above, below = (trace_at(inertia, end) - wanted for end in ends)
        theta = ends[0].union(ends[1])
        slope = slope_at(inertia, theta)
        if not (above > 0 and below < 0 and slope < 0):
            raise NotProvedError("the trace is not proved to fall through the resonance's")
        energy = energy_at(inertia, gravity, theta)
        _check_stated([energy], certificate.row("event", 1))
        _check_within("energy", energy, energies)
        bottom = _fraction(energy.lower()) - CLOSE
        band = Surface(k, g, bottom, _fraction(energy.upper()) + CLOSE - bottom)
        x = gravity / inertia * theta * theta.cot()
        orbit = periodic.prove(band, [[_fraction(x.mid()), Fraction(0)]], _RADIUS)
        form = normal_form(band, orbit)
        if not form.twists[0] > 0:
            raise NotProvedError("the twist is not proved to be positive")
        digits = {"energy": energy, "x": orbit.points[0][0], "twist": form.twists[0]}
        margins = {
            "slope": lowest(-slope),
            "twist": lowest(form.twists[0]),
            "nonresonance": lowest(form.nonresonance),
        }
        return Finding(digits, margins)


def check_doubling(
    text: str,
    k: Fraction,
    g: Fraction,
    *,
    period: int,
    line: int,
    trace: int,
    radius: Fraction,
    energies: Range,
    positions: Range,
) -> Finding:
    """Prove that an orbit of even period doubles its period, at one energy and position.

    The orbit meets y = 0 in two points, the first at the position x. Of the half orbit between
    them, the derivative of x by x (`line` 0) or of y by y (1) vanishes, so that the trace is -2.
    Both unknowns are alone in a square of at least the radius.
    """
    if trace != -2 or period % 2:
        raise NotProvedError("a period doubling of an even period has the trace -2")
    with ctx.workprec(BITS):
        certificate = Certificate(text, "period doubling")
        certificate.check_ball(k, g)

        def system(values):
            return doubling(k, g, values, period, line)

        energy, x = _proved(certificate, system, 2, radius)
        _check_within("energy", energy, energies)
        _check_within("position", x, positions)
        points = _half_orbit(k, g, energy, x, period // 2)
        if not all(_apart(a, b) for i, a in enumerate(points) for b in points[:i]):
            raise NotProvedError("two points may be one: the period may be shorter")
        slope = _trace_slope(k, g, (energy, x), period, line)
        if not slope < 0:
            raise NotProvedError("the trace is not proved to fall through -2")
        margins = {"radius": float(certificate.number("radius")), "slope": lowest(-slope)}
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
        certificate = Certificate(text, "grazing orbit")
        certificate.check_ball(k, g)

        def system(values):
            return grazing(k, g, values, halves)

        values = _proved(certificate, system, len(halves), radius)
        _check_within("energy", values[0], energies)
        slopes = [_slope(grazing(k, g, values, halves, by)) for by in ("speed", "gap")]
        for slope, sign, name in zip(slopes, sides, ("longer", "shorter"), strict=True):
            if not sign * slope > 0:
                where = "above" if sign > 0 else "below"
                raise NotProvedError(f"the {name} orbit is not proved to exist {where} the energy")
        digits = {"energy": values[0]}
        if len(values) > 1:
            digits["y"] = values[1]
        digits |= {"dE/ds": slopes[0], "dE/dh": slopes[1]}
        margins = {
            "radius": float(certificate.number("radius")),
            **{name: lowest(abs(s)) for name, s in zip(("dE/ds", "dE/dh"), slopes, strict=True)},
        }
        return Finding(digits, margins)


def _proved(certificate: Certificate, system: System, unknowns: int, radius: Fraction) -> list[arb]:
    """Prove that a system has one zero in the certificate's box, and enclose it narrowly."""
    centre, size = certificate.row("event", unknowns), certificate.number("radius")
    if not size >= radius:
        raise NotProvedError(f"the radius is {float(size):g}, not {float(radius):g} as stated")
    values = box(centre, size + CLOSE)
    try:
        image = newton(system, values)
        if not all(o.contains_interior(i) for i, o in zip(image, values, strict=True)):
            raise NotProvedError("the Newton image of the box does not lie inside it")
        while image[0].rad() < values[0].rad() / 2:
            values = [a.intersection(b) for a, b in zip(image, values, strict=True)]
            image = newton(system, values)
    except (UndecidedError, ZeroDivisionError) as error:
        raise NotProvedError(f"the box around the event: {error}") from None
    _check_stated(values, centre)
    return values


def _check_stated(values: Sequence[arb], event: Sequence[Fraction]) -> None:
    """Check that enclosures are those of a certificate's event."""
    for value, stated in zip(values, event, strict=True):
        if not abs(value - ball_of(stated)) < ball_of(CLOSE):
            raise NotProvedError(f"the event is not the stated one, near {float(stated):.10g}")


def newton(system: System, values: Sequence[arb]) -> list[arb]:
    """Return the image of a box under interval Newton."""
    n = len(values)
    centre = [value.mid() for value in values]
    residual, _ = system(centre)
    _, slopes = system(values)
    matrix = arb_mat([row[:n] for row in slopes])
    step = matrix.solve(arb_mat([[value] for value in residual]), algorithm="precond")
    return [centre[i] - step[i, 0] for i in range(n)]


def _slope(result: tuple[list[arb], list[list[arb]]]) -> arb:
    """Return the energy's derivative by the last variable, along the zeros of a system."""
    n = len(result[0])
    matrix = arb_mat([row[:n] for row in result[1]])
    return -matrix.solve(arb_mat([[row[n]] for row in result[1]]), algorithm="precond")[0, 0]


def _constants(k: Fraction, g: Fraction) -> tuple[arb, arb]:
    """Return k and g in balls."""
    return Surface(k, g, Fraction(0)).constants()[:2]


def _check_within(name: str, value: arb, limits: Range) -> None:
    """Check that an enclosed quantity lies between exact limits."""
    low, high = limits
    if not ball_of(low) < value < ball_of(high):
        raise NotProvedError(f"the {name} is not proved to lie where the statement says")


def _fraction(value: arb) -> Fraction:
    """Return an exact arb as a Fraction."""
    mantissa, exponent = value.man_exp()
    return Fraction(int(mantissa)) * Fraction(2) ** int(exponent)


def _variables(values: Sequence[arb], order: int, more: int = 0) -> list[Jet]:
    """Return jets of variables around values, and of `more` variables around exact zeros."""
    series = algebra(len(values) + more, order)
    jets = [Jet.constant_of(series, value) for value in [*values, *[arb(0)] * more]]
    for i, jet in enumerate(jets, 1):
        jet.coefficients[i] = arb(1)
    return jets


def _launch(k: arb, x: Jet, v: Jet, w: Jet, s: Jet) -> tuple[Jet, Jet, Jet, Jet]:
    """Return position, velocities b and c after an impact, and s, which v + w would round."""
    return x, v - 2 * k * s / (1 + k), w - 2 * s / (1 + k), s


def _land(g: arb, x: Jet, b: Jet, c: Jet, s: Jet, gap: Jet | int = 0) -> tuple[Jet, Jet, Jet]:
    """Return x, xdot, udot at the end of a flight; it begins with a small gap above the floor."""
    tau = first_root(x, c, s, g)
    if isinstance(gap, Jet):  # f(tau) = gap, to first order, around gap = 0
        tau = tau + gap * (1 / Gap(x, c, s, g).derivatives(tau)[1].constant)
    sine, cosine = tau.sin_cos()
    return x * cosine - c * sine, b + g * tau, x * sine + c * cosine


def grazing(
    k: Fraction, g: Fraction, values: Sequence[arb], halves: tuple[Half, ...], by: str = ""
) -> tuple[list[arb], list[list[arb]]]:
    """Return the conditions of a grazing orbit, and their derivatives by E, y and `by`.

    Each half orbit begins at a point of the rim with x < -g, the second one at its mirror image. It
    ends with y = 0 before an impact, or at the apex of a flight with U' = 0. `by` is "speed", the
    contact speed s of the impact, or "gap", by which the flight misses the floor.
    """
    inertia, gravity = _constants(k, g)
    jets = _variables(values, 1, more=1)
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
        flight = _launch(inertia, x, v, w, speed)
        for leg in range(flights):
            x, v, w = _land(gravity, *flight, gap=gap if leg == 0 else 0)
            flight = _launch(inertia, x, v, w, v + w)
        ends.append(v - inertia * w if where == "impact" else _apex(gravity, *flight))
    return [e.constant for e in ends], [e.coefficients[1:] for e in ends]


def _apex(g: arb, x: Jet, b: Jet, c: Jet, s: Jet) -> Jet:
    """Return the rate of strain where the centre is highest in a flight."""
    t = b * (-1 / g)
    if not t.constant > 0:
        raise UndecidedError("a flight may have no apex")
    _check_clear(Gap(x.constant, c.constant, s.constant, g), t.constant.upper())
    sine, cosine = t.sin_cos()
    return x * sine + c * cosine


def _check_clear(gap: Gap, until: arb) -> None:
    """Prove that a flight does not touch the floor up to a time; a touch may follow at once.

    Near 0, f <= -s t + (g + x) t^2/2 - c t^3/6 + A t^4/24. Raises UndecidedError.
    """
    amplitude = (gap.x * gap.x + gap.c * gap.c).sqrt()
    bend, jerk = (gap.g + gap.x).upper(), abs(gap.c).upper()
    first = until
    for _ in range(_MOST_CUTS):
        rest = jerk * first / 6 + amplitude * first * first / 24
        if bend / 2 + rest < 0 or -gap.s + first * (abs(bend) / 2 + rest) < 0:
            break
        first = first / 2
    else:
        raise UndecidedError("the impact may be grazing")
    pieces = [(first.lower(), until)]
    while pieces:
        low, high = pieces.pop()
        if not low < high or gap.derivatives(low.union(high))[0] < 0:
            continue
        if high - low < until / 10**6:
            raise UndecidedError("an impact may come before the apex")
        middle = ((low + high) / 2).mid()
        pieces += [(low, middle), (middle, high)]


def _end(
    k: Fraction, g: Fraction, values: Sequence[arb], impacts: int, order: int
) -> tuple[Jet, Jet]:
    """Return (x, y) after some impacts from (x, 0), as jets in E, x and y."""
    inertia, gravity = _constants(k, g)
    energy, x, y = _variables(values, order, more=1)
    square = (1 + inertia) * (2 * energy + x * (2 * gravity - inertia * x)) - y * y
    if not square.constant > 0:
        raise UndecidedError("a point is not proved to lie inside the section's rim")
    s = (square / inertia).sqrt()
    v, w = (y + inertia * s) / (1 + inertia), (s - y) / (1 + inertia)
    for _ in range(impacts):
        x, v, w = _land(gravity, *_launch(inertia, x, v, w, v + w))
    return x, v - inertia * w


def doubling(
    k: Fraction, g: Fraction, values: Sequence[arb], period: int, line: int
) -> tuple[list[arb], list[list[arb]]]:
    """Return y after half a period, the half orbit's entry, and both derivatives by E and x."""
    x, y = _end(k, g, values, period // 2, order=2)
    along = (0, 1, 0) if line == 0 else (0, 0, 1)
    jet = x if line == 0 else y
    by_energy = jet[1, along[1], along[2]]
    by_x = 2 * jet[0, 2, 0] if line == 0 else jet[0, 1, 1]
    return [y.constant, jet[along]], [[y[1, 0, 0], y[0, 1, 0]], [by_energy, by_x]]


def _trace_slope(k: Fraction, g: Fraction, values: Sequence[arb], period: int, line: int) -> arb:
    """Return the derivative by E, along the family, of the trace 4 A D - 2 where A or D is 0."""
    x, y = _end(k, g, values, period // 2, order=1)
    other = y[0, 0, 1] if line == 0 else x[0, 1, 0]
    (_, _), ((h_energy, h_x), (by_energy, by_x)) = doubling(k, g, values, period, line)
    return 4 * other * (by_energy - by_x * h_energy / h_x)


def _half_orbit(k: Fraction, g: Fraction, energy: arb, x: arb, impacts: int) -> list[tuple]:
    """Return the points (x, y) from the first to the second one on y = 0."""
    ends = (_end(k, g, (energy, x), n, order=1) for n in range(1, impacts + 1))
    return [(x, arb(0)), *((a.constant, b.constant) for a, b in ends)]


def _apart(first: Sequence[arb], last: Sequence[arb]) -> bool:
    """Return whether two enclosed points are proved to differ."""
    return not all(a.overlaps(b) for a, b in zip(first, last, strict=True))
