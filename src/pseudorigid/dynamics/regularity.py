"""The rule by which orbits are called regular, chaotic or undecided, and its criteria.

The length exp(G) of a tangent vector grows in proportion to the number of impacts n on a regular
orbit, and like exp(lambda n), with a Lyapunov exponent lambda > 0, on a chaotic one.

The *growth* of an orbit of n impacts is the mean of G over its last quarter less the mean of G over
its second quarter. It is ln(7/3) = 0.85 on average on a regular orbit of any length, and lambda n/2
on a chaotic one. An orbit is chaotic if its growth is at least GROWTH_THRESHOLD.

From exponents of whole orbits the growth cannot be computed. A second criterion serves for these:
an orbit is chaotic if its largest exponent exceeds `regular_bound`.
tests/dynamics/test_regularity.py checks that both criteria agree.

No criterion decides early. A short orbit is followed for LEAST_IMPACTS. A slow one, such as one
along the rim, has not met yet what makes it chaotic: no orbit is called regular before it has made
one whole turn around the symmetric fixed point, and has been followed for as long again. An orbit
that makes none within half of _MOST_IMPACTS and is not chaotic is undecided.
"""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from ..kernel.arithmetic import log
from ..kernel.verdict import GROWTH_THRESHOLD
from . import fixed_point
from .ball import Ball

LEAST_IMPACTS = 2000  # behind a verdict
_MOST_IMPACTS = 64_000  # to which an orbit that makes no whole turn is followed
_STRIDE = 10  # impacts
_BLOCK = 2000  # strides whose states are in memory at once
_IN_MEMORY = 1 << 18  # states, while turns are counted
_AT_CENTRE = 1e-12  # relative distance from the fixed point at which roundings decide the turns


def regular(exponent: np.ndarray, impacts: int) -> np.ndarray:
    """Return which orbits are regular by their growth.

    `exponent` is that of `rotation.winding`: the growth divided by half the number of impacts.
    """
    return exponent * (0.5 * impacts) < GROWTH_THRESHOLD


def regular_bound(length: int) -> float:
    """Upper bound of a regular orbit's exponents over a whole orbit, 3 ln n/n.

    ln n/n is the exponent of a tangent vector that grows exactly like n; the factor of 3 leaves
    room for any other constant of proportionality.
    """
    return 3.0 * log(float(length)) / length


def orbit_types(
    ball: Ball, states: Any, impacts: Sequence[int], exponents: Sequence[float] = ()
) -> list[str]:
    """Return the type of each orbit of n states (3, n), of which `impacts` were computed.

    It is "regular", "chaotic", "undecided", or "undefined" for an orbit that grazes exactly.
    `exponents` are the largest ones over these impacts, if they are known.
    """
    ball, states = Ball(ball.k, ball.g), np.asarray(states, dtype=float)
    orbits, centre, expected = around_fixed_point(ball, states)
    types = []
    for i, (state, run) in enumerate(zip(states.T, impacts, strict=True)):
        known = bool(exponents) and run >= LEAST_IMPACTS  # by the bound
        if known and exponents[i] > regular_bound(run):
            types.append("chaotic")
            continue
        judged = min(run, _MOST_IMPACTS) if known else run
        one = slice(i, i + 1)  # few orbits at once need no loop of their own compiled
        found = first_turn(ball.k, orbits[:, one], centre[one], expected[one], _MOST_IMPACTS // 2)
        needed = 2 * int(found[0])
        length = max(judged, LEAST_IMPACTS, min(needed, _MOST_IMPACTS))
        growth = _growth(ball, state, length) if state[1] + state[2] > 0.0 else math.nan
        unturned = "regular" if needed <= length else "undecided"
        word = unturned if growth < GROWTH_THRESHOLD else "chaotic"
        types.append(word if math.isfinite(growth) else "undefined")
    return types


@np.errstate(all="ignore")
def around_fixed_point(ball: Ball, states: Any) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return orbits as `kernel.tangents.begin` takes them.

    These are states (3, n) with lengths in g R, and x and rotation number of the symmetric fixed
    point at each orbit's energy.
    """
    energies, inverse = np.unique(ball.energy(*states) / ball.g**2, return_inverse=True)
    fixed_points = [fixed_point.numbers(ball.k, energy) for energy in energies.tolist()]
    centre, _, expected = np.array(fixed_points).reshape(-1, 3)[inverse.reshape(-1)].T
    return np.asarray(states) / ball.g, centre, expected


def first_turn(
    k: float, states: np.ndarray, centre: np.ndarray, expected: np.ndarray, most: int
) -> np.ndarray:
    """Return after how many impacts each orbit has made one whole turn (n,), most + 1 if later.

    Arguments are those of `kernel.tangents.begin`. A turn is counted within half a turn of the
    expected one, to 0.01 turns. At the fixed point itself each impact makes the expected one.
    """
    expected = np.where(np.isnan(expected), 0.5, expected)
    turned, found = np.zeros(len(centre)), np.full(len(centre), most + 1)
    at, done, ball = np.arange(len(centre)), 0, Ball.dimensionless(k)
    while done < most and at.size:
        count = min(max(64, done), 1 + _IN_MEMORY // at.size, most - done)
        orbits = np.moveaxis(ball.history(states, count)[..., :3], -1, 0)
        orbits = np.concatenate([states[:, :, None], orbits], axis=2)
        turns = _turns(k, orbits, centre[at, None], expected[at, None])
        so_far = turned[at, None] + np.cumsum(turns, axis=1)
        whole = np.abs(so_far) >= 1.0
        here = whole.any(axis=1)
        found[at[here]] = done + 1 + np.argmax(whole[here], axis=1)
        turned[at] = so_far[:, -1]
        at, states, done = at[~here], orbits[:, ~here, -1], done + count
    return found


def _turns(k: float, orbits: np.ndarray, centre: np.ndarray, expected: np.ndarray) -> np.ndarray:
    """Return the turns between successive states of orbits (3, n, m), clockwise."""
    x, v, w = orbits
    p, q = x - centre, (v - k * w) / np.sqrt(k * (1.0 + k))
    size = np.abs(p) + np.abs(q)
    away = size > _AT_CENTRE * (np.abs(x) + np.abs(w))
    # In place of an angle, the way around the square |p| + |q| = 1: it needs no arcus tangent.
    place = 0.25 * np.copysign(1.0 - p / np.where(away, size, np.inf), q)
    turns = place[:, :-1] - place[:, 1:]
    turns -= np.floor(turns - (expected - 0.5))
    return np.where(away[:, :-1] & away[:, 1:], turns, expected)


def _growth(ball: Ball, state: np.ndarray, impacts: int) -> float:
    """Return the growth of the tangent vector (1, 0, 0) along the orbit of a state.

    G is taken after each _STRIDE impacts. The two functions of the ball are those with which stages
    compute orbits and their periods, so that a drawing need not compile another loop.
    """
    x, v, w, total = 1.0, 0.0, 0.0, 0.0
    logarithms = np.empty(impacts // _STRIDE)
    for first in range(0, logarithms.size, _BLOCK):
        count = min(_BLOCK, logarithms.size - first)
        orbit = ball.history(state, count * _STRIDE)[0, :, :3].T
        before, state = orbit[:, ::_STRIDE], orbit[:, -1]
        jacobians = ball.jacobian(before[0], before[1], before[2], _STRIDE).tolist()
        for i, (of_x, of_v, of_w) in enumerate(jacobians, first):
            x, v, w = _product(of_x, x, v, w), _product(of_v, x, v, w), _product(of_w, x, v, w)
            length = abs(x) + abs(v) + abs(w)
            x, v, w = x / length, v / length, w / length
            total += log(length)
            logarithms[i] = total
    quarter = logarithms.size // 4
    return float(np.mean(logarithms[-quarter:]) - np.mean(logarithms[quarter : 2 * quarter]))


def _product(row: list[float], x: float, v: float, w: float) -> float:
    """Return the product of a matrix's row and a vector, in the order written."""
    return row[0] * x + row[1] * v + row[2] * w
