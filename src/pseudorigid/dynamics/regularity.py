"""The rule by which an orbit is called regular, chaotic or undecided, and two ways to its numbers.

The length exp(G) of a tangent vector grows in proportion to the number of impacts n on a regular
orbit, and like exp(lambda n), with a Lyapunov exponent lambda > 0, on a chaotic one. The *growth*
of an orbit of n impacts is the mean of G over its last quarter less the mean of G over its second
quarter: ln(7/3) = 0.85 on average on a regular orbit of any length, lambda n/2 on a chaotic one.
The *winding number* is the weighted Birkhoff average of the turns around the symmetric fixed point
(Das et al., Nonlinearity 30, 2017). On a regular orbit those of the two halves agree.

An orbit is judged at each of LENGTHS, by what it did there and at the length before (`judge`).
Chaotic orbits often stick to an island for thousands of impacts, where either number alone is that
of a regular orbit. So the verdict "regular" needs both, at two lengths, of which none is below
LEAST_REGULAR. An orbit that is still not decided at the last length is undecided. The verdict
depends on the state alone. The page of the atlas shows how often it is wrong.
"""

import math
from collections.abc import Generator
from typing import Any

import numpy as np

from ..kernel.arithmetic import log
from ..kernel.tangents import VECTOR, begin, bump, propagate_with_tangent, weight
from . import fixed_point
from .ball import Ball
from .ensemble import in_threads
from .verdict import windows

LENGTHS = tuple(500 << i for i in range(8))  # impacts, up to 64,000
LEAST_REGULAR = 16_000  # impacts
REGULAR_GROWTH, GROWTH_MARGIN = 0.85, 1.0
GROWTH_CHANGE = 0.5  # from one length to the next, on a regular orbit
HALVES_TOLERANCE = 1e-5  # turns an impact
CHAOTIC_GROWTH = 6.0  # regular orbits reach 2.8 at most in the runs behind the atlas's page
_LEAST_TURNS = 2.0  # of a regular orbit; one that makes less has not seen its surroundings
# At first. On y = 0 a vector of the energy surface with dx = 0 runs along the curve of a regular
# orbit, where it does not grow.
_VECTOR = 1.0, 0.0, 0.0
_STRIDE = 20  # impacts between values of G of an orbit that is followed alone
_FEW = 100  # orbits that are faster one by one, as long as no loop in lanes is compiled
_AT_CENTRE = 1e-12  # relative distance from the fixed point at which roundings decide the turns
# Yields growth and winding numbers of the whole and of its halves (4, n) at each length, and takes
# which of the orbits to follow further.
_Numbers = Generator[np.ndarray, np.ndarray, None]


def judge(length: int, before: np.ndarray, now: np.ndarray) -> np.ndarray:
    """Return the words for orbits after `length` impacts: "undecided" until the rule is met.

    `now` (4, n) has their growths, and the winding numbers of the whole orbits and of their first
    and second halves; `before` has those after half as many impacts. A growth of NaN means that the
    orbit grazes exactly, where the map has no derivative.
    """
    growth, winding, first, second = np.swapaxes([before, now], 0, 1)
    calm = (abs(growth - REGULAR_GROWTH) < GROWTH_MARGIN) & (abs(first - second) < HALVES_TOLERANCE)
    regular = calm.all(axis=0) & (abs(growth[1] - growth[0]) < GROWTH_CHANGE)
    regular &= abs(winding[1]) * length >= _LEAST_TURNS
    cases = {
        "undefined": np.isnan(growth[1]),
        "chaotic": (growth > CHAOTIC_GROWTH).all(axis=0),
        "regular": regular & (length >= 2 * LEAST_REGULAR),
    }
    return np.select([*cases.values()], [*cases], "undecided").astype(object)


def orbit_types(ball: Ball, states: Any) -> list[str]:
    """Return the type of each orbit of states (3, n) just before an impact.

    It is "regular", "chaotic", "undecided", or "undefined" for an orbit that grazes exactly.
    """
    return list(judged(ball, states, in_lanes=np.shape(states)[1] > _FEW)[0])


def judged(
    ball: Ball, states: Any, impacts: int = LENGTHS[-1], in_lanes: bool = True
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return types, rotation numbers and numbers of impacts followed (n,) of orbits.

    `states` (3, n) are just before an impact, and no orbit is followed for more than `impacts`.
    Orbits advance in SIMD lanes on all cores, or one by one with the two functions of the ball by
    which stages compute orbits and their periods, so that a drawing need not compile other loops.
    """
    x, centre, expected = around_fixed_point(ball, states)
    n, lengths = len(centre), [length for length in LENGTHS if length <= impacts] or [impacts]
    types, rotation = np.full(n, "undecided", object), np.full(n, math.nan)
    columns = *x, centre, expected, types, rotation, np.zeros(n, np.int64)

    def decide(*piece: np.ndarray) -> int:
        numbers = _numbers_in_lanes if in_lanes else _numbers_alone
        _decide(lengths, ball.k, numbers(lengths, ball.k, *piece[:5]), *piece)
        return 0

    if in_lanes:
        in_threads(decide, lengths[-1], *columns)
    else:
        for i in range(n):
            decide(*(column[i : i + 1] for column in columns))
    return columns[-3:]


def around_fixed_point(ball: Ball, states: Any) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return orbits as `kernel.tangents.begin` takes them.

    These are states (3, n) with lengths in g R, and x and rotation number of the symmetric fixed
    point at each orbit's energy.
    """
    energies, inverse = np.unique(ball.energy(*states) / ball.g**2, return_inverse=True)
    fixed_points = [fixed_point.numbers(ball.k, energy) for energy in energies.tolist()]
    centre, _, expected = np.array(fixed_points).reshape(-1, 3)[inverse.reshape(-1)].T
    return np.asarray(states) / ball.g, centre, expected


@np.errstate(all="ignore")
def _decide(
    lengths: list[int], k: float, numbers: _Numbers, x: np.ndarray, v: np.ndarray, w: np.ndarray,
    centre: np.ndarray, expected: np.ndarray, types: np.ndarray, rotation: np.ndarray,
    followed: np.ndarray,
) -> None:  # fmt: skip
    """Follow orbits (n,) until they are decided, and write the last three arrays."""
    # At the elliptic fixed point roundings decide the turns, and all of them are the expected one.
    still = abs(x - centre) + abs(v - k * w) <= _AT_CENTRE * (abs(x) + abs(w))
    turn = np.where(still, expected, math.nan)
    at, before = np.arange(x.size), np.full((4, x.size), math.nan)
    now = next(numbers)
    for length in lengths:
        now[0] = np.where(v[at] + w[at] > 0.0, now[0], math.nan)  # from the rim
        now[1:] = np.where(np.isnan(turn[at]), now[1:], turn[at])
        types[at] = judge(length, before, now)
        regular = types[at] == "regular"
        rotation[at[regular]], followed[at] = now[1, regular], length
        going_on = types[at] == "undecided"
        at, before = at[going_on], now[:, going_on]
        if not at.size or length == lengths[-1]:
            return
        now = numbers.send(going_on)


def _numbers_in_lanes(
    lengths: list[int], k: float, x: np.ndarray, v: np.ndarray, w: np.ndarray, centre: np.ndarray,
    expected: np.ndarray,
) -> _Numbers:  # fmt: skip
    """Follow orbits in lanes. Winding numbers begin at LEAST_REGULAR, and are NaN before."""
    turning, growing = windows(lengths)
    short = sum(length < LEAST_REGULAR for length in lengths)
    turning = turning[3 * short :]
    orbits, start = begin(k, (x, v, w), centre, expected), 0
    orbits[VECTOR : VECTOR + 3] = np.array(_VECTOR)[:, None]
    turned, sums = np.zeros((len(turning), x.size)), np.zeros((len(growing), x.size))
    for level, length in enumerate(lengths):
        propagate_with_tangent(orbits, k, start, length, turning, growing, turned, sums)
        numbers = np.full((4, orbits.shape[1]), math.nan)
        numbers[0] = (sums[2 * level + 1] - sums[2 * level]) / (length // 4)
        for i in range(3 if level >= short else 0):
            row = 3 * (level - short) + i
            numbers[1 + i] = turned[row] / weight(turning[row][1])
        going_on, start = (yield numbers), length
        # Indexing by a mask changes the order in memory, for which all kernels compile again.
        orbits, turned, sums = (np.compress(going_on, a, 1) for a in (orbits, turned, sums))


def _numbers_alone(
    lengths: list[int], k: float, x: np.ndarray, v: np.ndarray, w: np.ndarray, centre: np.ndarray,
    expected: np.ndarray,
) -> _Numbers:  # fmt: skip
    """Follow one orbit. G is taken after each _STRIDE impacts."""
    ball, state = Ball.dimensionless(k), np.array([x[0], v[0], w[0]])
    expected = np.where(np.isnan(expected), 0.5, expected)
    vector, total, start = _VECTOR, 0.0, 0
    sizes, turns = np.empty(lengths[-1] // _STRIDE), np.empty(lengths[-1])
    for length in lengths:
        orbit = np.column_stack([state, ball.history(state, length - start)[0, :, :3].T])
        turns[start:length] = _turns(k, orbit, centre, expected)
        before, state = orbit[:, :-1:_STRIDE], orbit[:, -1]
        jacobians = ball.jacobian(before[0], before[1], before[2], _STRIDE).tolist()
        for i, rows in enumerate(jacobians, start // _STRIDE):
            p, q, r = vector
            a, b, c = [row[0] * p + row[1] * q + row[2] * r for row in rows]
            size = abs(a) + abs(b) + abs(c)
            vector = a / size, b / size, c / size
            total += log(size)
            sizes[i] = total
        end, start = length // _STRIDE, length
        quarter, half = end // 4, length // 2
        growth = np.mean(sizes[end - quarter : end]) - np.mean(sizes[quarter : 2 * quarter])
        parts = turns[:length], turns[:half], turns[half:length]
        sums = [np.sum(bump(np.arange(a.size), a.size) * a) / weight(a.size) for a in parts]
        yield np.array([growth, *sums])[:, None]


def _turns(k: float, orbit: np.ndarray, centre: np.ndarray, expected: np.ndarray) -> np.ndarray:
    """Return the turns between successive states of an orbit (3, m), clockwise.

    In place of an angle they are counted along the square |p| + |q| = 1: this needs no arcus
    tangent, and changes no average over many turns; over 32,000 impacts it changed one by 2e-9.
    """
    x, v, w = orbit
    p, q = x - centre, (v - k * w) / math.sqrt(k * (1.0 + k))
    place = 0.25 * np.copysign(1.0 - p / (abs(p) + abs(q)), q)
    turns = place[:-1] - place[1:]
    return np.asarray(turns - np.floor(turns - (expected - 0.5)))
