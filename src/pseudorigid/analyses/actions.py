"""Heteroclinic orbits and the areas between them, by differences of action, to many digits.

The one-form y dx, y = xdot - k udot, changes over an impact and a flight at constant energy by the
differential of the action S, the integral of xdot^2 + k udot^2 over the flight. So the area between
an unstable and a stable arc with common ends w1, w2 is the sum, over the whole orbits of w1 and w2,
of the differences of S (MacKay, Meiss and Percival, Physica D 13, 1984). It comes out of numbers
that nearly cancel: by balls of python-flint, whose radii enclose every rounding.
"""

import numpy as np
from flint import arb, ctx

from ..dynamics.variables import chart

_NEWTON = 30  # steps at most; each doubles the digits
_SCANNED = 64  # parameters of an unstable segment at which a crossing is looked for
_FIRST = 1e-6  # where that segment ends, in the plane (x, y)
_MOST_IMAGES = 60  # by then a branch of a multiplier above 1.26 has grown from there to order one
_CROSSED = 160  # bits of the parameter at which an orbit meets y = 0: 48 digits, 25 are shown
_GOOD = 0.75  # of the working precision, which a solution by Newton's method must have


class Saddle:
    """A point of a hyperbolic periodic orbit, and its unstable direction in (x, y).

    Parameters
    ----------
    law : Law
    state : (float, float, float)
        x, xdot, udot of the point to double precision.
    period : int
        Of the orbit, in impacts.

    Attributes
    ----------
    x, y, multiplier, ex, ey : arb
        The point, the orbit's multiplier and the direction, of length 1, rounded to the working
        precision.

    Raises
    ------
    ValueError
        An orbit that is elliptic or inverse hyperbolic.
    ArithmeticError
        Where Newton's method does not find the point.
    """

    def __init__(self, law, state, period):
        self.law, self.period = law, period
        x, y = arb(state[0]), arb(state[1]) - law.k * arb(state[2])
        for _ in range(_NEWTON):
            end, (a, b), (c, d) = self._return(x, y)
            fx, fy = end[0] - x, end[1] - y
            determinant = (a - 1) * (d - 1) - b * c
            dx = ((b * fy - (d - 1) * fx) / determinant).mid()
            dy = ((c * fx - (a - 1) * fy) / determinant).mid()
            x, y = (x + dx).mid(), (y + dy).mid()
            if abs(dx) + abs(dy) < arb(2) ** int(-_GOOD * ctx.prec):
                break
        else:
            raise ArithmeticError("Newton's method does not find the saddle")
        _, (a, b), (c, d) = self._return(x, y)
        trace = a + d
        if not trace > 2:
            raise ValueError("the orbit is not hyperbolic with positive multipliers")
        multiplier = (trace + (trace * trace - 4).sqrt()) / 2
        ex, ey = (b, multiplier - a) if abs(float(b)) > abs(float(c)) else (multiplier - d, c)
        length = (ex * ex + ey * ey).sqrt()
        self.x, self.y, self.multiplier = x, y, multiplier.mid()
        self.ex, self.ey = (ex / length).mid(), (ey / length).mid()

    def _return(self, x, y):
        """The midpoint of P^period (x, y), and the rows of its derivative."""
        columns = []
        for direction in ((arb(1), arb(0)), (arb(0), arb(1))):
            state, tangent = self.law.lift(x, y, *direction)
            for _ in range(self.period):
                state, tangent, _ = self.law.flight(_middle(state), _middle(tangent))
            columns.append(self.law.chart(tangent))
        rows = zip(*columns, strict=True)
        return self.law.chart(state), *rows


class Law:
    """The map in balls: states (x, v, w) before an impact, their tangents and actions.

    Parameters
    ----------
    ball : Ball
        Its k and g are taken as the decimals they print as; it proposes the flight times.
    energy : float
        Taken as the decimal it prints as (m omega^2 R^2).
    """

    def __init__(self, ball, energy):
        self.ball = ball
        self.k, self.g, self.energy = (arb(repr(float(a))) for a in (ball.k, ball.g, energy))

    def chart(self, state):
        """The point of the chart under a state, or under a tangent.

        Parameters
        ----------
        state : (arb, arb, arb)
            x, xdot, udot.

        Returns
        -------
        x, y : arb
            y = xdot - k udot.
        """
        return state[0], state[1] - self.k * state[2]

    def lift(self, x, y, dx, dy):
        """The state over a point of the chart, and the tangent over one of its directions.

        Parameters
        ----------
        x, y, dx, dy : arb

        Returns
        -------
        state, tangent : (arb, arb, arb)
            x, xdot, udot.
        """
        k, g = self.k, self.g
        s = (((1 + k) * (2 * self.energy + 2 * g * x - k * x * x) - y * y) / k).sqrt()
        ds = ((1 + k) * (g - k * x) * dx - y * dy) / (k * s)
        state = x, (y + k * s) / (1 + k), (s - y) / (1 + k)
        return state, (dx, (dy + k * ds) / (1 + k), (ds - dy) / (1 + k))

    def flight(self, state, tangent):
        """One impact and the flight after it.

        Parameters
        ----------
        state, tangent : (arb, arb, arb)

        Returns
        -------
        state, tangent : (arb, arb, arb)
            At the next impact, eqs. (28) and (33).
        action : arb
            The integral of xdot^2 + k udot^2 over the flight (omega R^2).

        Raises
        ------
        ArithmeticError
            Where the working precision does not enclose the time of flight.
        """
        k, g = self.k, self.g
        (x, v, w), (dx, dv, dw) = state, tangent
        jump, step = 2 * (v + w) / (1 + k), 2 * (dv + dw) / (1 + k)
        b, c = v - k * jump, w - jump
        db, dc = dv - k * step, dw - step
        tau = self._time(state, b, c)
        sine, cosine = tau.sin_cos()
        x1, v1, w1 = x * cosine - c * sine, b + g * tau, x * sine + c * cosine
        dtau = -((1 - cosine) * dx + tau * db + sine * dc) / (v1 + w1)
        after = cosine * dx - sine * dc - w1 * dtau, db + g * dtau, sine * dx + cosine * dc
        both = sine * cosine
        action = tau * (b * b + tau * g * (b + g * tau / 3)) + k * (
            (x * x * (tau - both) + c * c * (tau + both)) / 2 + x * c * sine * sine
        )
        return (x1, v1, w1), (after[0], after[1], after[2] + x1 * dtau), action

    def _time(self, state, b, c):
        """The ball of the root of the gap next to the certified root of the midpoints."""
        x, g = state[0], self.g
        tau = arb(self.ball.time_to_impact(*map(float, state)))
        middle = x.mid(), b.mid(), c.mid()
        for _ in range(_NEWTON):
            f, df = _gap(tau, *middle, g)
            step = (f / df).mid()
            tau = (tau - step).mid()
            if abs(step) < abs(tau) * arb(2) ** int(-_GOOD * ctx.prec):
                break
        f, df = _gap(tau, x, b, c, g)
        room = 4 * abs(f / df).upper() + arb(2) ** -ctx.prec
        _, df = _gap(tau + arb(0, 1) * room, x, b, c, g)
        found = tau - f / df
        if not (df > 0 and (tau + arb(0, 1) * room).contains(found)):
            raise ArithmeticError("the flight time is not enclosed: more bits are needed")
        return found


def _gap(t, x, b, c, g):
    sine, cosine = t.sin_cos()
    value = x * (1 - cosine) + t * (b + g * t / 2) + c * sine
    return value, b + g * t + x * sine + c * cosine


def _middle(values):
    return tuple(a.mid() for a in values)


class Heteroclinic:
    """An orbit on a branch of a saddle that meets y = 0, where the reversor mirrors it.

    Parameters
    ----------
    saddle : Saddle
    sign : int
        The side of the branch, along the saddle's direction or against it.
    parameter : arb
        Distance of the orbit's start from the saddle, refined to meet y = 0.
    impacts : int
        From there to y = 0.

    Attributes
    ----------
    points : list of (arb, arb)
        (x, y) of the orbit from its start to y = 0.
    actions : list of arb
        Of its flights.
    tangent : (arb, arb)
        Of the branch at y = 0.

    Raises
    ------
    ValueError
        Where Newton's method does not find the crossing.
    ArithmeticError
        Where the working precision does not enclose a time of flight or the crossing.
    """

    def __init__(self, saddle, sign, parameter, impacts):
        small = arb(2) ** -_CROSSED
        for _ in range(_NEWTON):
            self._follow(saddle, sign, parameter, impacts)
            step = (self.points[-1][1] / self.tangent[1]).mid()
            parameter = (parameter - step).mid()
            if abs(step) < abs(parameter) * small:
                break
        else:
            if not abs(self.points[-1][1] / self.tangent[1]).rad() < abs(parameter) * small:
                raise ArithmeticError("the crossing is not enclosed: more bits are needed")
            raise ValueError("Newton's method does not find the crossing with y = 0")
        self._follow(saddle, sign, parameter, impacts)
        self.parameter, self.impacts = parameter, impacts

    def _follow(self, saddle, sign, parameter, impacts):
        law = saddle.law
        ex, ey = sign * saddle.ex, sign * saddle.ey
        state, tangent = law.lift(saddle.x + parameter * ex, saddle.y + parameter * ey, ex, ey)
        self.points, self.actions = [law.chart(state)], []
        for _ in range(impacts):
            state, tangent, action = law.flight(state, tangent)
            self.points.append(law.chart(state))
            self.actions.append(action)
        self.tangent = law.chart(tangent)

    def sine(self):
        """Sine of the angle from the unstable arc to the stable one, its mirror image.

        Returns
        -------
        arb
        """
        x, y = self.tangent
        return -2 * x * y / (x * x + y * y)

    def action(self, flight):
        """Action of one flight of the orbit.

        Parameters
        ----------
        flight : int
            From 0 to 2 impacts - 1; those after y = 0 by reversal of time.

        Returns
        -------
        arb
            In omega R^2.
        """
        return self.actions[min(flight, 2 * self.impacts - flight - 1)]


def lobe(saddle, sign, nearer):
    """The lobe between two neighbouring crossings of an unstable and a stable branch.

    The branch must lead to the mirror image of its saddle, so that it meets y = 0 on the way, and
    so must its image half a period later: these are the two primary orbits.

    Parameters
    ----------
    saddle : Saddle
        Of even period.
    sign : int
        The side of the branch.
    nearer : int
        By so many images the orbits start nearer to the saddle than _FIRST.

    Returns
    -------
    area : arb
        A ball around what the orbits give; their starts on the branch's tangent instead of the
        branch change it by the cube of their distance from the saddle.
    orbits : (Heteroclinic, Heteroclinic)

    Raises
    ------
    ValueError
        A branch that does not meet y = 0, as far as can be seen.
    ArithmeticError
        Where the working precision does not enclose a time of flight or the crossing.

    References
    ----------
    MacKay, Meiss and Percival, Transport in Hamiltonian systems, Physica D 13 (1984).
    """
    crossings = [first_crossing(saddle, sign, offset) for offset in (0, saddle.period // 2)]
    if None in crossings:
        raise ValueError("the branch does not meet y = 0")
    try:
        return _between(saddle, sign, nearer, crossings)
    except ValueError:  # where the branch bends much, Newton's method starts nearer
        return _between(saddle, sign, nearer, [_refined(saddle, sign, *one) for one in crossings])


def _between(saddle, sign, nearer, crossings):
    """`lobe` between two crossings, each a parameter and a number of impacts."""
    ratio, period = float(saddle.multiplier), saddle.period
    (near, impacts), (far, after) = crossings
    while far >= near:  # the crossing before that of the first orbit
        far, after = far / ratio, after + period
    while far * ratio < near:
        far, after = far * ratio, after - period
    shrink = saddle.multiplier**nearer
    first, second = (
        Heteroclinic(saddle, sign, (arb(parameter) / shrink).mid(), count + nearer * period)
        for parameter, count in ((near, impacts), (far, after))
    )
    # y dx around the lobe: along the unstable arc one way, along the stable one back
    flights = 2 * min(first.impacts, second.impacts)
    area = _under(first.points[0], second.points[0])
    for flight in range(flights):
        area += second.action(flight) - first.action(flight)
    # both orbits are near the other saddle now, at the mirror images of points at the start
    last = (orbit.points[2 * orbit.impacts - flights] for orbit in (first, second))
    return abs(area + _under(*last)), (first, second)


def _under(one, other):
    """The integral of y dx along a straight line."""
    return (one[1] + other[1]) / 2 * (other[0] - one[0])


def first_crossing(saddle, sign, impacts):
    """Where a branch first meets y = 0 after `impacts` + m periods, in doubles.

    Parameters
    ----------
    saddle : Saddle
    sign : int
        The side of the branch.
    impacts : int
        Done before the first look.

    Returns
    -------
    (float, int) or None
        The parameter, in the last segment before _FIRST from the saddle, and the impacts from
        there; None where there is no crossing within _MOST_IMAGES.
    """
    ball, parameter = saddle.law.ball, _scanned(saddle)
    states = _images(saddle, sign, parameter, impacts)
    for _ in range(_MOST_IMAGES):
        _, height = chart(ball.k, *states)
        (crossing,) = np.nonzero(height[1:] * height[:-1] <= 0.0)
        if crossing.size:
            return float(parameter[crossing[0]]), impacts
        ball.map.steps(*states, ball.k, ball.g, saddle.period, np.empty(parameter.size))
        impacts += saddle.period
    return None


def _scanned(saddle):
    """The parameters at which the last segment before _FIRST is looked at."""
    ratio = 1.0 / float(saddle.multiplier)
    return _FIRST * (ratio + (1.0 - ratio) * np.arange(_SCANNED + 1) / _SCANNED)


def _images(saddle, sign, parameter, impacts):
    """The states, in doubles, after some impacts from the points of the branch's tangent."""
    ball = saddle.law.ball
    x = float(saddle.x) + sign * parameter * float(saddle.ex)
    y = float(saddle.y) + sign * parameter * float(saddle.ey)
    states = [np.array(a) for a in ball.state_xy(x, y, float(saddle.law.energy))]
    ball.map.steps(*states, ball.k, ball.g, impacts, np.empty(x.size))
    return states


def _refined(saddle, sign, parameter, impacts):
    """A crossing seen by `first_crossing`, to a millionth of the distance scanned."""
    scanned = _scanned(saddle)
    low, high = parameter, parameter + (scanned[1] - scanned[0])
    for _ in range(3):
        parameter = low + (high - low) * np.arange(_SCANNED + 1) / _SCANNED
        _, height = chart(saddle.law.ball.k, *_images(saddle, sign, parameter, impacts))
        (at,) = np.nonzero(height[1:] * height[:-1] <= 0.0)
        if not at.size:  # where a jump, or rounding, decides
            break
        low, high = parameter[at[0]], parameter[at[0] + 1]
    return float(low), impacts
