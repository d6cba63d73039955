"""The edge of the main island: Greene's residues of the convergents of noble rotation numbers.

A curve whose rotation number is noble exists if the residues of the periodic orbits whose rotation
numbers are its convergents go to zero, and is broken if they grow without bound (Greene, J. Math.
Phys. 20, 1979). The residue is (2 - trace)/4 of the orbit's Jacobian on the energy surface.
"""

import math

import numpy as np
import xarray as xr

from ..dynamics.follow import angle
from ..dynamics.orbits import orbit
from ..dynamics.variables import LENGTH, RADIUS, SPEED, chart, of_rows, states_of
from ..kernel import impact as kernel
from ..kernel.compiled import jit
from .winding import fixed, winding

# A bracket of the symmetric flight begins so wide, in section radii, a thousand roundings, and
# grows up to the other.
_NARROW, _WIDE = 1e-13, 1e-3
_CONVERGENT = ("noble", "convergent")
_VARIABLES = {
    "turns": (_CONVERGENT, "turns around the fixed point"),
    "period": (_CONVERGENT, "impacts in which it makes them"),
    "place": (_CONVERGENT, "the orbit's point on y = 0, in section radii", RADIUS),
    "residue": (_CONVERGENT, "Greene's residue"),
    "closure": (_CONVERGENT, "by how much the orbit misses its start, in section radii", RADIUS),
    "rotation": ("noble", "noble rotation number"),
    "orbit_rotation": ("noble", "rotation number of the orbit there"),
    "orbit_exponent": ("noble", "Lyapunov exponent of the orbit there"),
    "x": (("noble", "impact"), "position at impact, downwards", LENGTH),
    "y": (("noble", "impact"), "xdot - k udot just before impact", SPEED),
}


def last_curve(ball, energy, nobles, convergents, between, impacts, drawn):
    """Residues of the convergents of noble rotation numbers, and orbits where curves would be.

    Parameters
    ----------
    ball : Ball
    energy : float
        In m omega^2 R^2.
    nobles : sequence of sequences of int
        Continued fractions up to where nothing but ones follows, [0, a1, a2, ...].
    convergents : int
        How many of each, from the one that ends with the last given number on.
    between : (float, float)
        Part of y = 0, in section radii, where the orbits are looked for; the first end is nearer
        to the fixed point.
    impacts, drawn : int
        Length of the orbit that starts at the last convergent's point, and how much of it is kept.

    Returns
    -------
    xarray.Dataset
        On (noble, convergent): turns and period, of the convergent; place, of its orbit's point on
        y = 0, in section radii; residue; closure, by how much the orbit misses its start, in
        section radii. On noble: rotation, the number itself; orbit_rotation and orbit_exponent, of
        the long orbit. On (noble, impact): x and y = xdot - k udot of its beginning.

    Raises
    ------
    ValueError
        A convergent with no orbit between the two places.

    References
    ----------
    Greene, A method for determining a stochastic transition, J. Math. Phys. 20 (1979).

    Examples
    --------
    >>> from pseudorigid import Ball
    >>> found = last_curve(Ball(k=0.2, g=0.04), 0.01, [[0, 5, 1, 15]], 0, (-0.2, -0.03), 100, 10)
    >>> found["period"].values.tolist()
    [[95.0]]
    """
    quotients = [[int(a) for a in noble] for noble in nobles]
    rows = [_one(ball, energy, noble, convergents, between, impacts, drawn) for noble in quotients]
    return xr.Dataset(of_rows(_VARIABLES, rows), attrs={"impacts": impacts})


def _one(ball, energy, noble, convergents, between, impacts, drawn):
    """Of one noble number what _VARIABLES says, in that order."""
    search = _Search(ball, energy, between)
    found = [(p, q, *search.orbit(p, q)) for p, q in fractions(noble, convergents)]
    place = found[-1][2]
    (turns,), (grown,) = winding(ball, energy, np.array([place]), impacts)
    path = chart(ball.k, *states_of(orbit(ball, ball.start(place, energy), drawn)))
    return *np.array(found, dtype=float).T, value(noble), turns, grown, *path


def fractions(noble, count):
    """Convergents of a noble number, from that of the given quotients on.

    Parameters
    ----------
    noble : sequence of int
        [a0, a1, ...], followed by ones.
    count : int
        How many, at least one.

    Returns
    -------
    list of (int, int)
        p, q of p/q.
    """
    found = [(1, 0), (noble[0], 1)]
    for quotient in [*noble[1:], *[1] * (count - 1)]:
        (p, q), (r, s) = found[-2:]
        found.append((p + quotient * r, q + quotient * s))
    return found[len(noble) :]


def value(noble):
    """The number [a0, a1, ..., 1, 1, 1, ...].

    Parameters
    ----------
    noble : sequence of int
        [a0, a1, ...].

    Returns
    -------
    float
    """
    number = 0.5 * (math.sqrt(5.0) + 1.0)
    for quotient in reversed(noble):
        number = quotient + 1.0 / number
    return number


class _Search:
    """Symmetric orbits by their turns around the fixed point, from starts on y = 0.

    With m = period // 2 the orbit is symmetric if after m impacts it is on y = 0 (even periods) or
    its next flight is symmetric in time (odd ones). Which of the many zeros belongs to a rotation
    number is decided by the turns around the fixed point in that time.
    """

    def __init__(self, ball, energy, between):
        self.ball, self.energy, self.between = ball, energy, between
        middle, self.radius = ball.section(energy)
        at, self.expected = fixed(ball, energy)
        self.centre = middle + self.radius * at

    def orbit(self, turns, period):
        """(place, residue, closure) of the orbit that makes so many turns in a period."""
        half, odd = divmod(period, 2)

        def excess(place):
            before, last, _ = self._half(place, half)
            return 2.0 * before + odd * last - turns

        ends = self.between
        if not excess(ends[0]) > 0.0 > excess(ends[1]):
            raise ValueError(
                f"between = {list(ends)} is not allowed: no rotation number {turns}/{period} there"
            )
        place = _bisect(excess, *ends)
        if odd:
            place = self._symmetric_flight(place, half)
        state = self.ball.start(place, self.energy)
        jacobian = self.ball.jacobian(*state, impacts=period)
        trace = float(jacobian[0, 0] + jacobian[1, 1] + jacobian[2, 2] - 1.0)
        after = states_of(orbit(self.ball, state, period, keep="last"))
        return place, 0.25 * (2.0 - trace), np.max(np.abs(after - state)) / self.radius

    def _half(self, place, half):
        ball, about = self.ball, (self.centre, self.expected)
        return _turned(*ball.start(place, self.energy), ball.k, ball.g, *about, half)

    def _symmetric_flight(self, place, half):
        """The place next to this one from which the flight after `half` impacts is symmetric."""

        def defect(at):
            return self._half(at, half)[2]

        room = _NARROW
        while room < _WIDE:
            for above, below in ((place - room, place + room), (place + room, place - room)):
                if defect(above) > 0.0 > defect(below):
                    return _bisect(defect, above, below)
            room *= 2.0
        raise ValueError(f"no symmetric flight after {half} impacts next to {place!r}")


def _bisect(function, above, below):
    """Where a function that is above 0 at one place and below at another changes, to a double."""
    while (middle := 0.5 * (above + below)) not in (above, below):
        if function(middle) > 0.0:
            above = middle
        else:
            below = middle
    return middle


@jit
def _turned(x, v, w, k, g, centre, expected, impacts):
    """(turns, turns of one impact more, b + g tau/2 of that one's flight) around x = centre."""
    head, low = kernel.transfer(k)
    round_y = 1.0 / math.sqrt(k * (1.0 + k))
    total, turn, defect = 0.0, 0.0, 0.0
    p, q = x - centre, round_y * (v - k * w)
    for i in range(impacts + 1):
        total += turn if i else 0.0
        x, v, w, tau, _, _ = kernel.step(x, v, w, k, g, head, low, None)
        r, s = x - centre, round_y * (v - k * w)
        turn = angle(p * r + q * s, q * r - p * s) / (2.0 * math.pi)
        if turn < expected - 0.5:
            turn += 1.0
        elif turn > expected + 0.5:
            turn -= 1.0
        defect = v - 0.5 * g * tau
        p, q = r, s
    return total, turn, defect
