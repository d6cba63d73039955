"""The edge of the main island: Greene's residues of the convergents of noble rotation numbers.

An invariant curve with a noble rotation number exists if the residues of the periodic orbits whose
rotation numbers are its convergents go to zero, and is broken if they grow without bound (Greene,
A method for determining a stochastic transition, J. Math. Phys. 20, 1979). The residue is
(2 - trace)/4 of the orbit's Jacobian on the energy surface.
"""

import itertools
import math
from collections.abc import Callable, Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from extensions.atlas.symmetry_line import LOCKED, regular, symmetric_fixed_point, winding
from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.orbits import orbit
from pseudorigid.dynamics.variables import LENGTH, RADIUS, SPEED, chart, of_rows, states_of
from pseudorigid.kernel import formulas
from pseudorigid.kernel import impact as kernel
from pseudorigid.kernel.compiled import jit
from pseudorigid.kernel.tangents import angle

# Half widths, in section radii, of the first and the last bracket of a symmetric flight: a thousand
# rounding errors, doubled until it is as wide as the other.
_MIN_HALF_WIDTH, _MAX_HALF_WIDTH = 1e-13, 1e-3
# How nobles are chosen: the number of starts over `between` and of impacts of their orbits, the
# longest chain of islands that is told from curves, and how many curves back from the last one
# rotation numbers are compared.
_STARTS, _IMPACTS, _MAX_ISLANDS, _CURVES_BACK = 400, 16_000, 200, 8
_CELLS = 64  # of `between`, searched if no orbit is found between its ends
_MAX_CLOSURE = 1e-6  # section radii; an orbit that misses its start by more is a jump of the turns
Interval = tuple[float, float]
Triple = tuple[float, float, float]
Function = Callable[[float], float]
_CONVERGENT = ("noble", "convergent")
_VARIABLES = {
    "turns": (_CONVERGENT, "turns around the fixed point"),
    "period": (_CONVERGENT, "impacts in which it makes them"),
    "place": (_CONVERGENT, "the orbit's point on y = 0, in section radii", RADIUS),
    "residue": (_CONVERGENT, "Greene's residue"),
    "closure": (_CONVERGENT, "by how much the orbit misses its start, in section radii", RADIUS),
    "rotation": ("noble", "noble rotation number"),
    "x": (("noble", "impact"), "position at impact, downwards", LENGTH),
    "y": (("noble", "impact"), "xdot - k udot just before impact", SPEED),
}


def last_curve(
    ball: Ball, energy: float, convergents: int, between: Interval, drawn: int,
    nobles: Sequence[Sequence[int]] | None = None,
) -> xr.Dataset:  # fmt: skip
    """Compute residues of the convergents of noble rotation numbers, and orbits near these curves.

    `nobles` are continued fractions [0, a1, a2, ...], after which all quotients are 1; by default
    they are those of `edge_nobles`. The `convergents` of each begin with that of its given
    quotients. The orbit that starts at the last one's point is kept for `drawn` impacts. ValueError
    is raised if there is no orbit of a convergent in `between`, or no edge of an island.

    >>> from pseudorigid import Ball
    >>> between, nobles = (-0.2, -0.03), [[0, 5, 1, 15]]
    >>> data = last_curve(Ball(k=0.2, g=0.04), 0.01, 0, between, 10, nobles)
    >>> data["period"].values.tolist()
    [[95.0]]
    """
    rows = []
    for i, noble in enumerate(edge_nobles(ball, energy, between) if nobles is None else nobles):
        try:
            search = OrbitSearch(ball, energy, between)
            rows.append(_row(search, [int(a) for a in noble], convergents, drawn))
        except ValueError:
            if nobles is not None or i == 0:
                raise
    return xr.Dataset(of_rows(_VARIABLES, rows))


def edge_nobles(ball: Ball, energy: float, between: Interval) -> list[list[int]]:
    """Choose two noble rotation numbers, on either side of the edge of an island.

    `between` is a part of y = 0, in section radii, that begins in the island and ends outside; a
    ValueError is raised if no edge lies in it. The first number is next to that of the last curve,
    on its inner side, the second as far beyond it. Orbits in chains of islands, whose rotation
    numbers are fractions, do not count as curves.

    >>> from pseudorigid import Ball
    >>> edge_nobles(Ball(k=0.2, g=0.04), 0.011, (-0.2, 0.1))
    [[0, 5, 1, 4], [0, 5, 1, 6]]
    """
    start = between[0] + (between[1] - between[0]) * (np.arange(_STARTS) + 0.5) / _STARTS
    turns, exponent = winding(ball, energy, start, _IMPACTS)
    good = regular(exponent, _IMPACTS)
    periods = np.arange(1, _MAX_ISLANDS + 1)[:, None]
    locked = np.any(np.abs(turns - np.rint(turns * periods) / periods) < LOCKED, axis=0)
    (curves,) = np.nonzero(good & ~locked)
    if curves.size < _CURVES_BACK or good[curves[-1] :].all():
        reason = "begin among curves around the fixed point and end in the sea, or give nobles"
        raise ValueError(f"between = {list(between)} is not allowed: {reason}")
    last, back = turns[curves[-1]], turns[curves[-_CURVES_BACK]]
    return [noble_between(last, back), noble_between(last, 2.0 * last - back)]


def noble_between(first: float, second: float) -> list[int]:
    """Return a simple noble number between two positive ones, as quotients before the ones.

    >>> noble_between(0.16, 0.17)
    [0, 6, 5]
    """
    low, high = sorted((first, second))
    while True:
        quotients = _simplest_between(low, high)
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


def _simplest_between(low: float, high: float) -> list[int]:
    """Return the continued fraction of the fraction with the smallest denominator in between."""
    whole = math.floor(low)
    if whole + 1 < high:
        return [whole + 1]
    upper = 1.0 / (low - whole) if low > whole else math.inf
    return [whole, *_simplest_between(1.0 / (high - whole), upper)]


def _row(search: "OrbitSearch", noble: list[int], convergents: int, drawn: int) -> tuple[Any, ...]:
    """Return the values of _VARIABLES for one noble number."""
    ball, energy = search.ball, search.energy
    orbits = [(p, q, *search.orbit(p, q)) for p, q in fractions(noble, convergents)]
    start = orbits[-1][2]
    path = chart(ball.k, *states_of(orbit(ball, ball.start(start, energy), drawn)))
    return *np.array(orbits, dtype=float).T, value(noble), *path


def fractions(noble: Sequence[int], count: int) -> list[tuple[int, int]]:
    """Return convergents (p, q) of a noble number, the first one that of its given quotients."""
    convergents = [(1, 0), (noble[0], 1)]
    for quotient in [*noble[1:], *[1] * (count - 1)]:
        (p, q), (r, s) = convergents[-2:]
        convergents.append((p + quotient * r, q + quotient * s))
    return convergents[len(noble) :]


def value(noble: Sequence[int]) -> float:
    """Return the number with the continued fraction [a0, a1, ..., 1, 1, 1, ...]."""
    number = 0.5 * (math.sqrt(5.0) + 1.0)
    for quotient in reversed(noble):
        number = quotient + 1.0 / number
    return number


class SymmetricOrbit(NamedTuple):
    """A symmetric periodic orbit, which starts on y = 0."""

    start: float  # section radii
    residue: float
    closure: float  # by how much the orbit misses its start, in section radii


class OrbitSearch:
    """Search on y = 0 for symmetric periodic orbits with a given number of turns.

    With m = period // 2 an orbit is symmetric if after m impacts it is on y = 0 (even periods) or
    its next flight is symmetric in time (odd periods). The turns around the fixed point by then
    select one of the many solutions.
    """

    def __init__(self, ball: Ball, energy: float, between: Interval):
        self.ball, self.energy, self.between = ball, energy, between
        centre, self.radius = ball.section(energy)
        fixed_place, self.fixed_rotation = symmetric_fixed_point(ball, energy)
        self.fixed_x = centre + self.radius * fixed_place

    def orbit(self, turns: int, period: int) -> SymmetricOrbit:
        """Return an orbit with so many turns in a period; raise ValueError if none is found."""
        excess_turns = self._excess_turns(turns, period)
        first, last = self.between
        whole = [self.between] if excess_turns(first) > 0.0 > excess_turns(last) else []
        for bracket in itertools.chain(whole, self._brackets(excess_turns, _CELLS)):
            if orbit := self._solve(excess_turns, period, bracket):
                return orbit
        nearby, _ = winding(self.ball, self.energy, np.linspace(first, last, _CELLS), _IMPACTS)
        raise ValueError(
            f"no symmetric orbit of rotation number {turns}/{period} = {turns / period:.6f} is "
            f"found on the part of y = 0 between {first:g} and {last:g}, where orbits have "
            f"{nearby.min():.6f} to {nearby.max():.6f}: choose other nobles, or leave nobles out"
        )

    def innermost(self, turns: int, period: int, cells: int) -> SymmetricOrbit | None:
        """Return the orbit that is nearest to the fixed point, or None if none is found.

        It is searched in the first of so many cells of `between` at whose ends orbits have too many
        and too few turns, or the other way round.
        """
        excess_turns = self._excess_turns(turns, period)
        bracket = next(self._brackets(excess_turns, cells), None)
        return bracket and self._solve(excess_turns, period, bracket)

    def _excess_turns(self, turns: int, period: int) -> Function:
        """Return the function of a start that is zero on an orbit with these turns."""
        half, odd = divmod(period, 2)

        def excess_turns(start: float) -> float:
            before, last, _ = self._half_orbit(start, half)
            return 2.0 * before + odd * last - turns

        return excess_turns

    def _solve(
        self, excess_turns: Function, period: int, bracket: Interval
    ) -> SymmetricOrbit | None:
        """Return the orbit in a bracket, or None if it does not close."""
        crossing = _bisect(excess_turns, *bracket)
        start = self._symmetric_flight(crossing, period // 2) if period % 2 else crossing
        if start is None:
            return None
        state = self.ball.start(start, self.energy)
        after = states_of(orbit(self.ball, state, period, keep="last"))
        closure = np.max(np.abs(after - state)) / self.radius
        if not closure < _MAX_CLOSURE:
            return None
        jacobian = self.ball.jacobian(*state, impacts=period)
        trace = float(jacobian[0, 0] + jacobian[1, 1] + jacobian[2, 2] - 1.0)
        return SymmetricOrbit(start, 0.25 * (2.0 - trace), closure)

    def _brackets(self, excess_turns: Function, cells: int) -> Iterator[Interval]:
        """Yield the ends of cells, that with too many turns first, which have an orbit between."""
        first, last = self.between
        low, above = first, excess_turns(first) > 0.0
        for i in range(1, cells + 1):
            high = first + (last - first) * i / cells
            if (excess_turns(high) > 0.0) != above:
                yield (low, high) if above else (high, low)
                above = not above
            low = high

    def _half_orbit(self, start: float, half: int) -> Triple:
        """Return `_turns` of the orbit from a start on y = 0."""
        k, g = self.ball.k, self.ball.g
        # the state of Ball.start, without its checks of a start, which take as long as the orbit
        state = formulas.start(k, g, self.energy, start)
        return _turns(state, k, g, self.fixed_x, self.fixed_rotation, half)

    def _symmetric_flight(self, start: float, half: int) -> float | None:
        """Return the nearby start whose flight after `half` impacts is symmetric, or None."""

        def asymmetry(at: float) -> float:
            return self._half_orbit(at, half)[2]

        width = _MIN_HALF_WIDTH
        while width < _MAX_HALF_WIDTH:
            for above, below in itertools.permutations((start - width, start + width)):
                if asymmetry(above) > 0.0 > asymmetry(below):
                    return _bisect(asymmetry, above, below)
            width *= 2.0
        return None


def _bisect(function: Function, above: float, below: float) -> float:
    """Return where a function changes from positive, at `above`, to not positive, to a double."""
    while (middle := 0.5 * (above + below)) not in (above, below):
        if function(middle) > 0.0:
            above = middle
        else:
            below = middle
    return middle


@jit
def _turns(state: Triple, k: float, g: float, x0: float, expected: float, impacts: int) -> Triple:
    """Return turns around x = x0 in `impacts`, in one impact more, and b + g tau/2 of that one."""
    x, v, w = state
    coefficients = kernel.impact_coefficients(k)
    round_y = 1.0 / math.sqrt(k * (1.0 + k))
    total, turn, asymmetry = 0.0, 0.0, 0.0
    p, q = x - x0, round_y * (v - k * w)
    for i in range(impacts + 1):
        total += turn if i else 0.0
        x, v, w, tau, _, _ = kernel.step(x, v, w, k, g, coefficients, None)
        r, s = x - x0, round_y * (v - k * w)
        turn = angle(p * r + q * s, q * r - p * s) / (2.0 * math.pi)
        if turn < expected - 0.5:
            turn += 1.0
        elif turn > expected + 0.5:
            turn -= 1.0
        asymmetry = v - 0.5 * g * tau
        p, q = r, s
    return total, turn, asymmetry
