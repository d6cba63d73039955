"""The edge of the main island: Greene's residues of the convergents of noble rotation numbers.

A curve whose rotation number is noble exists if the residues of the periodic orbits whose rotation
numbers are its convergents go to zero, and is broken if they grow without bound (Greene, J. Math.
Phys. 20, 1979). The residue is (2 - trace)/4 of the orbit's Jacobian on the energy surface.
"""

import math

import numpy as np
import xarray as xr

from ..dynamics.orbits import orbit
from ..dynamics.tangent_orbits import angle
from ..dynamics.variables import LENGTH, RADIUS, SPEED, chart, of_rows, states_of
from ..kernel import impact as kernel
from ..kernel.compiled import jit
from .rotation import LOCKED, regular
from .winding import fixed, winding

# A bracket of the symmetric flight begins so wide, in section radii, a thousand roundings, and
# grows up to the other.
_NARROW, _WIDE = 1e-13, 1e-3
# Where nobles are chosen: the starts over `between`, how long their orbits are, the longest period
# of a chain of islands that is told from curves, and how many curves back from the last one
# rotation numbers are compared.
_STARTS, _IMPACTS, _LOCKED_TO, _BACK = 400, 16_000, 200, 8
_CELLS = 64  # of `between`, where no orbit is found between its ends
_CLOSED = 1e-6  # section radii; an orbit that misses its start by more is a jump of the turns
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


def last_curve(ball, energy, convergents, between, impacts, drawn, nobles=None):
    """Residues of the convergents of noble rotation numbers, and orbits where curves would be.

    Parameters
    ----------
    ball : Ball
    energy : float
        In m omega^2 R^2.
    convergents : int
        How many of each noble number, from the one that ends with its last given quotient on.
    between : (float, float)
        Part of y = 0, in section radii, where the orbits are looked for; the first end is nearer
        to the fixed point.
    impacts, drawn : int
        Length of the orbit that starts at the last convergent's point, and how much of it is kept.
    nobles : sequence of sequences of int, optional
        Continued fractions up to where nothing but ones follows, [0, a1, a2, ...]; by default those
        of `edge_nobles`.

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
        A convergent with no orbit between the two places, or, where nobles are chosen, no edge of
        an island there.

    References
    ----------
    Greene, A method for determining a stochastic transition, J. Math. Phys. 20 (1979).

    Examples
    --------
    >>> from pseudorigid import Ball
    >>> between, nobles = (-0.2, -0.03), [[0, 5, 1, 15]]
    >>> found = last_curve(Ball(k=0.2, g=0.04), 0.01, 0, between, 100, 10, nobles)
    >>> found["period"].values.tolist()
    [[95.0]]
    """
    given = nobles is not None
    chosen, rows = nobles if given else edge_nobles(ball, energy, between), []
    for i, noble in enumerate(chosen):
        quotients = [int(a) for a in noble]
        try:
            rows.append(_one(ball, energy, quotients, convergents, between, impacts, drawn))
        except ValueError:
            if given or i == 0:
                raise
    return xr.Dataset(of_rows(_VARIABLES, rows), attrs={"impacts": impacts})


def edge_nobles(ball, energy, between):
    """Noble rotation numbers on either side of the edge of the island at the first of two places.

    Parameters
    ----------
    ball : Ball
    energy : float
        In m omega^2 R^2.
    between : (float, float)
        Part of y = 0, in section radii; the first end is in the island, the second outside.

    Returns
    -------
    list of list of int
        Two continued fractions, each followed by ones. The first number is next to that of the
        last curve, on its inner side, the second as far beyond it. Chains of islands, whose
        rotation numbers are fractions, are no curves.

    Raises
    ------
    ValueError
        No edge between the two places.

    Examples
    --------
    >>> from pseudorigid import Ball
    >>> edge_nobles(Ball(k=0.2, g=0.04), 0.011, (-0.2, 0.1))
    [[0, 5, 1, 4], [0, 5, 1, 6]]
    """
    place = between[0] + (between[1] - between[0]) * (np.arange(_STARTS) + 0.5) / _STARTS
    turns, grown = winding(ball, energy, place, _IMPACTS)
    good = regular(grown, _IMPACTS)
    periods = np.arange(1, _LOCKED_TO + 1)[:, None]
    locked = np.any(np.abs(turns - np.rint(turns * periods) / periods) < LOCKED, axis=0)
    (curves,) = np.nonzero(good & ~locked)
    if curves.size < _BACK or good[curves[-1] :].all():
        what = "no curves around the fixed point and sea beyond them are seen there"
        raise ValueError(f"between = {list(between)} is not allowed: {what}")
    last, back = turns[curves[-1]], turns[curves[-_BACK]]
    return [noble_between(last, back), noble_between(last, 2.0 * last - back)]


def noble_between(one, other):
    """The continued fraction of a noble number between two numbers, the simplest that is found.

    Parameters
    ----------
    one, other : float
        Above 0 and not equal.

    Returns
    -------
    list of int
        To be followed by ones.

    Examples
    --------
    >>> noble_between(0.16, 0.17)
    [0, 6, 5]
    """
    low, high = sorted((one, other))
    while True:
        quotients = _simplest(low, high)
        *head, last = quotients
        for noble in (quotients, [*head, last - 1, 1] if last > 1 else quotients):
            if low < value(noble) < high:
                return noble
        ((p, q),) = fractions(quotients, 1)
        cut = p / q  # go on in the wider part, at a distance so that it is not found again
        if high - cut > cut - low:
            low = cut + 0.01 * (high - cut)
        else:
            high = cut - 0.01 * (cut - low)


def _simplest(low, high):
    """The continued fraction of the fraction with the smallest denominator between two numbers."""
    whole = math.floor(low)
    if whole + 1 < high:
        return [whole + 1]
    return [
        whole,
        *_simplest(1.0 / (high - whole), 1.0 / (low - whole) if low > whole else math.inf),
    ]


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

        for bracket in self._brackets(excess):
            place = _bisect(excess, *bracket)
            if odd:
                place = self._symmetric_flight(place, half)
            if place is not None:
                residue, closure = self._closes(place, period)
                if closure < _CLOSED:
                    return place, residue, closure
        one, other = self.between
        near, _ = winding(self.ball, self.energy, np.linspace(one, other, _CELLS), _IMPACTS)
        raise ValueError(
            f"no symmetric orbit of rotation number {turns}/{period} = {turns / period:.6f} is "
            f"found on the part of y = 0 between {one:g} and {other:g}, where orbits have "
            f"{near.min():.6f} to {near.max():.6f}: choose other nobles, or leave nobles out"
        )

    def _closes(self, place, period):
        """The residue at a place, and by how much the orbit misses its start."""
        state = self.ball.start(place, self.energy)
        jacobian = self.ball.jacobian(*state, impacts=period)
        trace = float(jacobian[0, 0] + jacobian[1, 1] + jacobian[2, 2] - 1.0)
        after = states_of(orbit(self.ball, state, period, keep="last"))
        return 0.25 * (2.0 - trace), np.max(np.abs(after - state)) / self.radius

    def _brackets(self, excess):
        """Pairs of places, a rotation number above the wanted one at the first, below at the other.

        The ends of the part searched, then those of its cells: where the rotation number jumps
        there is no orbit.
        """
        one, other = self.between
        if excess(one) > 0.0 > excess(other):
            yield one, other
        places = one + (other - one) * np.arange(_CELLS + 1) / _CELLS
        signs = np.sign([excess(place) for place in places])
        for i in np.flatnonzero(signs[1:] * signs[:-1] < 0.0):
            pair = places[i : i + 2].tolist()
            yield pair if signs[i] > 0.0 else pair[::-1]

    def _half(self, place, half):
        ball, about = self.ball, (self.centre, self.expected)
        return _turned(*ball.start(place, self.energy), ball.k, ball.g, *about, half)

    def _symmetric_flight(self, place, half):
        """The place next to this one whose flight after `half` impacts is symmetric, or None."""

        def defect(at):
            return self._half(at, half)[2]

        room = _NARROW
        while room < _WIDE:
            for above, below in ((place - room, place + room), (place + room, place - room)):
                if defect(above) > 0.0 > defect(below):
                    return _bisect(defect, above, below)
            room *= 2.0
        return None


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
    coefficients = kernel.impact_coefficients(k)
    round_y = 1.0 / math.sqrt(k * (1.0 + k))
    total, turn, defect = 0.0, 0.0, 0.0
    p, q = x - centre, round_y * (v - k * w)
    for i in range(impacts + 1):
        total += turn if i else 0.0
        x, v, w, tau, _, _ = kernel.step(x, v, w, k, g, coefficients, None)
        r, s = x - centre, round_y * (v - k * w)
        turn = angle(p * r + q * s, q * r - p * s) / (2.0 * math.pi)
        if turn < expected - 0.5:
            turn += 1.0
        elif turn > expected + 0.5:
            turn -= 1.0
        defect = v - 0.5 * g * tau
        p, q = r, s
    return total, turn, defect
