"""Verdicts on the orbits of cells, by a card that has the kernel of `orbit`."""

from inspect import isfunction
from typing import Any

import numpy as np
from numba.extending import register_jitable

from pseudorigid.dynamics import fixed_point
from pseudorigid.dynamics.verdict import VERDICT
from pseudorigid.kernel.compiled import jit

from . import orbit
from .card import Card, CardError
from .plans import levels

MOST_ORBITS = 2_000_000  # at once: with more, a slow card would not answer for long
_FREE_SHARE = 0.9  # of the memory that is free
for _function in filter(isfunction, vars(fixed_point).values()):
    register_jitable(_function)  # they call each other


@jit
def _fixed_points(k: np.ndarray, e: np.ndarray, found: np.ndarray) -> None:
    for i in range(k.size):
        found[i, 0], found[i, 1], found[i, 2] = fixed_point.numbers(k[i], e[i])


def fixed_points(cells: Any) -> np.ndarray:
    """Return the numbers (n, 3) of `fixed_point.numbers` of cells (n, 2), k and E/g^2."""
    found = np.empty((len(cells), 3))
    k, e = np.ascontiguousarray(np.transpose(cells))
    _fixed_points(k, e, found)
    return found


def orbits_at_once(card: Card, starts: int, impacts: int) -> int:
    """Return how many orbits fit into a card's memory; raises CardError if not those of a cell."""
    _, shares, sums = levels(impacts)
    each = 8 * (orbit.KEPT + sums + len(orbit.FOUND)) + 4 + 1 + 32  # bytes, with those of a cell
    room = int(_FREE_SHARE * card.memory) - shares.nbytes
    if room < each * starts:
        words = f"{card.memory / 1e9:.1f} GB free, a cell of {starts} orbits takes"
        raise CardError(f"--gpu: {card.name} has {words} {each * starts / 1e9:.1f} GB")
    return min(MOST_ORBITS, room // each)


def classified(card: Any, cells: np.ndarray, starts: int, impacts: int) -> np.recarray:
    """Return the verdicts (n starts,) on the orbits of cells, as `classify_orbits` does.

    `cells` (n, 4) are k, E/g^2, the x of the fixed point and its rotation number, NaN where it is
    not elliptic. Raises ArithmeticError where `kernel.flight` does.
    """
    count = len(cells) * starts
    all_levels, shares, sums = levels(impacts)
    flags = card.empty(count, np.uint8)
    found = card.empty(len(orbit.FOUND) * count, float)
    kept, summed = card.empty(orbit.KEPT * count, float), card.empty(sums * count, float)
    of_cells = card.copied(np.where(np.isnan(cells), 0.5, cells))  # as in `kernel.tangents.begin`
    of_shares = card.copied(shares)
    followed = np.empty(count, np.int64)
    undecided = np.arange(count, dtype=np.int32)
    for level in all_levels:
        given = of_cells, starts, count, card.copied(level.plan), of_shares
        written = card.copied(level.weights), kept, summed, found, flags
        card.run("classify", undecided.size, card.copied(undecided), *given, *written)
        followed[undecided] = level.length
        flag = card.read(flags, np.uint8)
        if np.any(flag == orbit.FAILED):
            raise ArithmeticError("a flight on the card does not end")
        undecided = undecided[flag[undecided] & orbit.DECIDED == 0]
        if not undecided.size:
            break
    verdicts = np.empty(count, VERDICT).view(np.recarray)
    numbers = card.read(found, float).reshape(-1, count)
    bits = {name: flag & bit != 0 for name, bit in orbit.FLAGS.items()}
    for name, values in zip(orbit.FOUND, numbers, strict=True):
        verdicts[name] = values
    for name, values in (bits | {"followed": followed}).items():
        verdicts[name] = values
    return verdicts
