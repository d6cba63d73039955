"""Periodic orbits by interval Newton on the shooting map, eq. F_i = P(z_i) - z_(i+1).

Theorem (Moore; Neumaier, Interval Methods for Systems of Equations, 1990): let X be a box with
midpoint c and A an interval matrix that contains DF on X and is regular. If N = c - A^-1 F(c) lies
in the interior of X, then F has exactly one zero in X, and it is in N.

All fixed points at once, by hand. A flight rotates (x, udot+) into (x', udot'): at a fixed point
x^2 + (udot+)^2 = x^2 + udot^2, so udot+ is udot or -udot. By eq. (25) udot+ = udot means
xdot = -udot, thus s = 0: a point of the rim, not of the open disk. So udot+ = -udot, which by
eq. (25) means y = 0, and xdot+ = -xdot. With theta = tau/2 then xdot = g theta, udot = g theta/k,
x = udot cot(theta), and

    E = (g^2/2k) ((1 + k) theta^2 + (1 - theta cot(theta))^2 - 1).

On (0, pi) both terms rise, from E = -g^2/(2k) without bound: one theta for each energy. Its flight
is the first, since the gap at theta + r, udot cot(theta) + g (r^2 - theta^2)/2 - udot cos(r)/
sin(theta), rises for r in (0, theta). theta = n pi would need udot = 0, thus s = 0. On
(pi, 3 pi/2) the gap is above zero at r = 0, so that there was an impact before, if
(1 + |cos|)/(k |sin|) > theta/2, for which 1/k > theta/2 is enough. By the first term alone,
theta^2 <= (2 k E/g^2 + 1)/(1 + k), so that theta stays below a bound up to a given energy.
"""

from dataclasses import dataclass, replace
from fractions import Fraction

from flint import arb, arb_mat, ctx

from ..enclosure.flight import UndecidedError
from ..enclosure.surface import ball_of
from .certificate import Certificate, Finding, NotProvedError, box, lowest

BITS = 256  # twice what points to CLOSE need, and room for the periods
CLOSE = Fraction(1, 10**30)  # how near a certificate's points must be to the orbit's


@dataclass(frozen=True)
class Orbit:
    """A periodic orbit, enclosed.

    Attributes
    ----------
    points : tuple of (arb, arb)
        (x, y = xdot - k udot).
    impacts : tuple of Impact
        After each point.
    matrix : arb_mat
        The product of DP along the orbit, from the first point.
    type : {"elliptic", "hyperbolic", "inverse hyperbolic"}
    radius : Fraction
        Of the boxes around the centres in which it is the only one.
    """

    points: tuple
    impacts: tuple
    matrix: arb_mat
    type: str
    radius: object

    @property
    def trace(self):
        """Trace of the matrix, an arb."""
        return self.matrix[0, 0] + self.matrix[1, 1]


def check(text, surface, *, period, type, radius, window=None):
    """Prove a certificate's orbit.

    Parameters
    ----------
    text : str
        The certificate.
    surface : Surface
        Whose map it is about.
    period : int
        Its prime period.
    type : {"elliptic", "hyperbolic", "inverse hyperbolic"}
    radius : Fraction
        It must be the only one within that, at least.
    window : ((x low, x high), (xdot low, xdot high)), optional
        Fractions: must contain one of its points; None for any orbit.

    Returns
    -------
    Finding
        digits: x, xdot, udot of the first point, period, the sum of its times (1/omega), and trace;
        margins: radius, and trace, from 2 and -2; parts: orbit, an Orbit.

    Raises
    ------
    NotProvedError
        With the reason.
    """
    with ctx.workprec(BITS):
        certificate = Certificate(text, "periodic orbit")
        certificate.surface(surface)
        orbit = stated(certificate, surface, period, type, radius, window)
        margins = {"radius": float(orbit.radius), "trace": lowest(abs(abs(orbit.trace) - 2))}
        return Finding(_digits(surface, orbit), margins, {"orbit": orbit})


def check_only_fixed_point(text, k, g, energy):
    """Prove that the map has one fixed point at each energy up to a given one.

    Parameters
    ----------
    text : str
        The certificate.
    k, g : Fraction
        The ball.
    energy : Fraction
        The energies are those from -g^2/(2k) up to this one.

    Returns
    -------
    Finding
        digits: energies up to; margins: theta and earlier, of the two conditions.

    Raises
    ------
    NotProvedError
        With the reason.
    """
    with ctx.workprec(BITS):
        certificate = Certificate(text, "only fixed point")
        certificate.ball(k, g)
        highest, longest = certificate.number("energy_up_to"), certificate.number("theta_below")
        if highest != energy:
            raise NotProvedError(f"the certificate is of energies up to {highest}, not {energy}")
        needed = (2 * k * highest / (g * g) + 1) / (1 + k)  # theta^2 is at most this
        if not (longest - Fraction(1, 100)) ** 2 < needed <= longest**2:
            raise NotProvedError("theta is not proved to be below the stated one")
        bound = ball_of(longest)
        if not (bound < 3 * arb.pi() / 2 and longest * k < 2):
            raise NotProvedError("a second fixed point is not excluded")
        margins = {
            "theta": lowest(3 * arb.pi() / 2 - bound),
            "earlier": lowest(ball_of(2 - longest * k)),
        }
        return Finding({"energies up to": ball_of(highest)}, margins)


def stated(certificate, surface, period, type, radius, window=None):
    """Prove that an orbit meets its certificate, is of a type, and is alone in its boxes.

    The boxes are larger than the certificate's by CLOSE, so that they contain the stated ones
    around the orbit's own points.

    Parameters
    ----------
    certificate : Certificate
        Its fields points and radius.
    surface : Surface
    period : int
        How many points there must be.
    type : {"elliptic", "hyperbolic", "inverse hyperbolic"}
    radius : Fraction
        Of the boxes, at least.
    window : ((x low, x high), (xdot low, xdot high)), optional
        As for `passes`.

    Returns
    -------
    Orbit

    Raises
    ------
    NotProvedError
        With the reason.
    """
    centres, size = certificate.numbers("points", 2), certificate.number("radius")
    if len(centres) != period:
        raise NotProvedError(f"the certificate has {len(centres)} points, not {period}")
    if not size >= radius:
        raise NotProvedError(f"the radius is {float(size):g}, not {float(radius):g} as stated")
    orbit = prove(surface, centres, size + CLOSE)
    if orbit.type != type:
        raise NotProvedError(f"the orbit is {orbit.type}, not {type}")
    _meets(orbit, centres)
    passes(surface, orbit, window)
    return replace(orbit, radius=size)


def prove(surface, centres, radius):
    """The only Orbit with a point within `radius` of each centre, per coordinate.

    Parameters
    ----------
    surface : Surface
    centres : list of (Fraction, Fraction)
        (x, y), one pair an impact.
    radius : Fraction

    Returns
    -------
    Orbit

    Raises
    ------
    NotProvedError
        Where no orbit, or more than one, or a shorter one, cannot be excluded.

    References
    ----------
    Neumaier, Interval Methods for Systems of Equations (1990).
    """
    if not radius > 0:
        raise NotProvedError(f"a radius of {float(radius):g} is no size of a box")
    boxes = [box(centre, radius) for centre in centres]
    try:
        image = _newton(surface, boxes)
        for part, whole in zip(image, boxes, strict=True):
            if not all(w.contains_interior(p) for p, w in zip(part, whole, strict=True)):
                raise NotProvedError("the Newton image of the boxes does not lie inside them")
        orbit = _enclose(surface, _narrow(surface, image), radius)
    except (UndecidedError, ZeroDivisionError) as error:
        raise NotProvedError(f"the boxes around the orbit: {error}") from None
    for i, one in enumerate(orbit.points):
        for other in orbit.points[:i]:
            if all(a.overlaps(b) for a, b in zip(one, other, strict=True)):
                raise NotProvedError("two points may be one: the period may be shorter")
    return orbit


def _meets(orbit, centres):
    """Check that the orbit's points are the stated ones, to CLOSE."""
    for point, centre in zip(orbit.points, centres, strict=True):
        for value, stated in zip(point, centre, strict=True):
            if not abs(value - ball_of(stated)) < ball_of(CLOSE):
                raise NotProvedError(f"a point of the orbit is not the stated {float(stated):.10g}")


def _newton(surface, boxes):
    """The Newton image of boxes ((x, y), ...) as a list of (x, y)."""
    n = len(boxes)
    slopes = arb_mat(2 * n, 2 * n)
    rest = arb_mat(2 * n, 1)
    centres = [[a.mid() for a in part] for part in boxes]
    for i in range(n):
        after = (i + 1) % n
        rows, _ = surface.jacobian(*boxes[i])
        image = surface.impact(*centres[i])
        for r in range(2):
            for c in range(2):
                slopes[2 * i + r, 2 * i + c] += rows[r][c]
            slopes[2 * i + r, 2 * after + r] -= 1
            rest[2 * i + r, 0] = image[r] - centres[after][r]
    step = slopes.solve(rest, algorithm="precond")
    return [[centres[i][r] - step[2 * i + r, 0] for r in range(2)] for i in range(n)]


def _narrow(surface, boxes):
    """The orbit's points as narrow as the precision allows."""
    while True:
        image = _newton(surface, boxes)
        after = [
            [a.intersection(b) for a, b in zip(*pair, strict=True)]
            for pair in zip(image, boxes, strict=True)
        ]
        if not after[0][0].rad() < boxes[0][0].rad() / 2:
            return after
        boxes = after


def _enclose(surface, points, radius):
    matrix = arb_mat([[1, 0], [0, 1]])
    impacts = []
    for point in points:
        rows, impact = surface.jacobian(*point)
        matrix = arb_mat(rows) * matrix
        impacts.append(impact)
    trace = matrix[0, 0] + matrix[1, 1]
    kinds = {
        "elliptic": abs(trace) < 2,
        "hyperbolic": trace > 2,
        "inverse hyperbolic": trace < -2,
    }
    for kind, holds in kinds.items():
        if holds:
            return Orbit(tuple(map(tuple, points)), tuple(impacts), matrix, kind, radius)
    raise NotProvedError("the trace may be 2 or -2: the orbit's type is not proved")


def passes(surface, orbit, window):
    """Check that one of the orbit's points lies in a window of x and xdot.

    Parameters
    ----------
    surface : Surface
    orbit : Orbit
    window : ((x low, x high), (xdot low, xdot high)) or None
        Fractions; None for any orbit.

    Raises
    ------
    NotProvedError
        Where none is proved to.
    """
    if window is None:
        return
    for x, y in orbit.points:
        sides = zip((x, surface.velocities(x, y)[0]), window, strict=True)
        if all(ball_of(low) < value < ball_of(high) for value, (low, high) in sides):
            return
    raise NotProvedError("no point of the orbit is proved to lie in the statement's window")


def _digits(surface, orbit):
    x, y = orbit.points[0]
    xdot, udot = surface.velocities(x, y)
    total = sum((impact.tau for impact in orbit.impacts), arb(0))
    return {"x": x, "xdot": xdot, "udot": udot, "period": total, "trace": orbit.trace}
