"""Short form of the rule of `regularity`, for sweeps: most orbits are decided early.

It errs more often than the rule; the page of the atlas says how often.

All orbits are followed for FIRST_LENGTH impacts, those still undecided for twice as many, and so
on, at most to the end. At each of these lengths two quantities decide: the *growth* of a tangent
vector (`regularity`), and the difference between the winding numbers of the two halves, which are
weighted Birkhoff averages (`kernel.tangents.propagate_with_tangent`).

Before the end an orbit is regular if its growth is below half of GROWTH_THRESHOLD and its winding
numbers agree to WINDING_TOLERANCE. It is chaotic if its growth is above twice GROWTH_THRESHOLD and
the logarithm of the tangent vector's length is above MIN_CHAOTIC_G. At the end an undecided orbit
is regular if its growth is below GROWTH_THRESHOLD. An orbit with an exactly grazing impact, where
the map has no derivative, is not regular.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..kernel.tangents import SIZE, begin, propagate_with_tangent, weight
from ..kernel.verdict import judge_each

FIRST_LENGTH = 500  # impacts of every orbit; exponents are taken from these
JUDGED = "winding", "growth", "regular", "strict", "lenient"  # by `judge_each`, in this order
# Verdict on an orbit and what it rests on. `strict` and `lenient` are the verdicts with half and
# with twice the threshold.
VERDICT = [
    ("regular", bool),
    ("strict", bool),
    ("lenient", bool),
    ("winding", float),  # turns an impact
    ("growth", float),
    ("exponent", float),  # of a tangent vector, over FIRST_LENGTH without its first quarter
    ("followed", np.int64),  # impacts
]


def lengths_to_decide(impacts: int) -> list[int]:
    """Return the lengths at which orbits are classified, the last one `impacts`."""
    lengths = [FIRST_LENGTH]
    while lengths[-1] < impacts:
        lengths.append(2 * lengths[-1])
    return [*lengths[:-1], impacts]


def classify_orbits(
    k: float, states: Any, centre: np.ndarray, expected: np.ndarray, impacts: int
) -> np.recarray:
    """Follow orbits for at most `impacts` impacts, at least 4, and return their VERDICT (n,).

    `states` are x, v, w (n,) just before an impact, lengths in g R. `centre` (n,) is the x of the
    point at y = 0 around which turns are counted, and `expected` (n,) the turns of an impact, or
    NaN.
    """
    lengths = lengths_to_decide(impacts)
    turning, growing = all_windows(lengths)
    orbits = begin(k, states, centre, expected)
    turned, growth = (np.zeros((len(rows), len(centre))) for rows in (turning, growing))
    verdicts = np.zeros(len(centre), VERDICT).view(np.recarray)
    undecided = np.arange(len(centre))
    start = 0
    for level, length in enumerate(lengths):
        propagate_with_tangent(orbits, k, start, length, turning, growing, turned, growth)
        if not start:
            verdicts.exponent[:] = (growth[-1] - growth[-2]) / (length - length // 4)
        turns, grows = slice(3 * level, 3 * level + 3), slice(2 * level, 2 * level + 2)
        weights = tuple(weight(length) for _, length in turning[turns])
        numbers, flags = np.empty((2, undecided.size)), np.empty((undecided.size, 4), bool)
        judged = weights, growth[grows], length // 4, orbits[SIZE], length == impacts
        judge_each(turned[turns], *judged, *numbers, flags)
        values = dict(zip(JUDGED, (*numbers, *flags.T), strict=False))
        for name, value in (values | {"followed": length}).items():
            verdicts[name][undecided] = value
        start, going_on = length, ~flags[:, 3]
        undecided = undecided[going_on]
        if not undecided.size:
            break
        # Indexing by a mask changes the order in memory, for which all kernels compile again.
        orbits, turned, growth = (np.compress(going_on, a, 1) for a in (orbits, turned, growth))
    return verdicts


def all_windows(lengths: Sequence[int]) -> tuple[np.ndarray, np.ndarray]:
    """Return `windows`, and with those of growth the ends of the exponent's impacts."""
    turning, growing = windows(lengths)
    shared = [(lengths[0] // 4 - 1, 1), (lengths[0] - 1, 1)]
    return turning, np.concatenate([growing, shared])


def windows(lengths: Sequence[int]) -> tuple[np.ndarray, np.ndarray]:
    """Return windows, as (first impact, length), over which orbits of m lengths are averaged.

    Turns (3 m, 2) are averaged over each length and its two halves; the logarithm of the tangent
    vector (2 m, 2) over the second and the last quarter.
    """
    turning, growing = [], []
    for length in lengths:
        half, quarter = length // 2, length // 4
        turning += [(0, length), (0, half), (length - half, half)]
        growing += [(quarter, quarter), (length - quarter, quarter)]
    return np.array(turning), np.array(growing)
