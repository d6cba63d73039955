"""Cells (k, E) of a sweep: share of regular orbits, chains of islands, exponent of the sea.

Lengths are in g R and energies are E/g^2. The sea is the set of orbits that are not regular. Cells
are computed in blocks; the dataset of a sweep does not depend on the blocks.
"""

import math
from collections import Counter
from collections.abc import Iterable, Sequence
from itertools import groupby
from typing import Any

import numpy as np
import xarray as xr

from pseudorigid.dynamics import fixed_point
from pseudorigid.dynamics.variables import described
from pseudorigid.dynamics.verdict import classify_orbits

from .starts import sunflower_points

MAX_ISLANDS = 24  # of a chain; longer chains count as curves around the fixed point
WINDING_TOLERANCE = 1e-5  # turns an impact; a winding number as near to a fraction counts as equal
NORMAL_95 = 1.959964  # standard deviations on either side of the mean that hold 95 %
BATCH_SIZE = 40_000  # orbits followed together: SIMD lanes stay full, and memory small

Cell = tuple[float, float]  # k and E/g^2
# Numbers (n, 3) of the fixed points of cells, and verdicts (n starts,) on their orbits.
Judged = tuple[np.ndarray, np.recarray]

AXES = {"k": ("Euler inertia", "m R^2"), "energy": ("energy over g^2", "m (gravity/omega)^2")}
# Variable -> long name. A cell has one number of each, and one of `chains` per number of islands.
VARIABLES = {
    "trace": "trace of the fixed point's Jacobian",
    "rotation": "rotation number of the fixed point, NaN where it is not elliptic",
    "regular": "share of the section's area with regular orbits",
    "regular_low": "lower end of its 95 % interval, starts and threshold together",
    "regular_high": "upper end of its 95 % interval, starts and threshold together",
    "regular_strict": "the share with half the threshold",
    "regular_lenient": "the share with twice the threshold",
    "exponent": "Lyapunov exponent an impact of the other orbits, the sea, pooled",
    "exponent_error": "standard error of the exponent, from the spread between orbits",
    "exponent_low": "lower quartile of the single orbits' exponents",
    "exponent_high": "upper quartile of the single orbits' exponents",
    "followed": "mean number of impacts of an orbit",
    "chain_period": "islands of the largest chain, 0 where there is none",
    "chain_turns": "turns around the fixed point in that many impacts",
    "chain_share": "share of the section's area in that chain's islands",
    "chains": "regular starts in chains of so many islands",
}


def block_of_cells_of_a_sweep(
    cells: list[Cell], starts: int, impacts: int, judged: Judged | None = None
) -> xr.Dataset:
    """Compute regular and chaotic motion in cells [k, E/g^2], as from `kinds.blocks`.

    They may have been `judged` already, by another processor.
    """
    rows = numbers_of_cells(cells, starts, impacts, judged)
    table: dict[str, tuple[Any, ...]] = {}
    for name, text in VARIABLES.items():
        values = np.array([row[name] for row in rows])
        table[name] = ("cell", "period")[: values.ndim], values, text
    for axis, values in zip(AXES, np.array(cells, float).T, strict=True):
        table[axis] = "cell", values, *AXES[axis]
    table["period"] = "period", np.arange(1, MAX_ISLANDS + 1), "islands of a chain"
    return xr.Dataset(described(table))


def cells_of_a_sweep(
    *blocks: xr.Dataset, k: list[float], energy: list[float], **orbits: int
) -> xr.Dataset:
    """Join blocks, in the order of their cells, to the dataset of a sweep on (k, energy).

    `orbits` are starts and impacts, which decided the blocks.
    """
    joined = xr.concat(blocks, "cell", data_vars="minimal", coords="minimal", compat="override")
    data: dict[str, Any] = {}
    for name in VARIABLES:
        variable = joined.variables[name]
        values = variable.values.reshape(len(k), len(energy), *variable.shape[1:])
        data[name] = ("k", "energy", *variable.dims[1:]), values, variable.attrs
    data |= described({"k": ("k", k, *AXES["k"]), "energy": ("energy", energy, *AXES["energy"])})
    return xr.Dataset(data | {"period": joined.variables["period"]})


def cell(k: float, e: float, starts: int, impacts: int) -> dict[str, Any]:
    """Compute the numbers of one cell, with the keys of VARIABLES.

    Each of the `starts` orbits is followed for at most `impacts` >= 4 impacts. The orbits start
    evenly over one half, y >= 0, of the section's area; the reversor maps regular orbits of this
    half to those of the other half. The interval of the regular share goes from the lower end of
    Wilson's interval with half the threshold to the upper end of the one with twice the threshold.
    The sea's exponent is the growth rate of tangent vectors over those impacts that every orbit is
    followed for, so that it does not depend on when an orbit was classified.

    A regular orbit belongs to a chain of q islands if its winding number around the fixed point is
    within WINDING_TOLERANCE of a fraction p/q, q <= MAX_ISLANDS, but not of the fixed point's own
    rotation number. On curves around the fixed point the winding number changes from curve to
    curve; in islands it does not. Chains inside the main island and islands around islands are
    counted, too, and chains of the same p/q count as one.
    """
    return numbers_of_cells([(k, e)], starts, impacts)[0]


def numbers_of_cells(
    cells: Sequence[Cell], starts: int, impacts: int, judged: Judged | None = None
) -> list[dict[str, Any]]:
    """Compute several cells, bit for bit as `cell` does but in less time."""
    each = _judged(cells, starts, impacts)
    if judged:
        each = zip(judged[0].tolist(), np.split(judged[1], len(cells)), strict=True)
    return [
        {"trace": trace, "rotation": rotation} | _summary(orbits, rotation)
        for (_, trace, rotation), orbits in each
    ]


def _judged(
    cells: Sequence[Cell], starts: int, impacts: int
) -> Iterable[tuple[Sequence[float], Any]]:
    """Yield the fixed point's numbers of each cell, and the verdicts on its orbits."""
    step = max(1, BATCH_SIZE // starts)
    for k, row in groupby(cells, key=lambda pair: pair[0]):
        energies = [e for _, e in row]
        for batch in (energies[first : first + step] for first in range(0, len(energies), step)):
            fixed = [fixed_point.numbers(k, e) for e in batch]
            x, _, rotation = np.repeat(np.transpose(fixed), starts, axis=1)
            states = np.concatenate([sunflower_points(k, e, starts) for e in batch], axis=1)
            verdicts = classify_orbits(k, states, x, rotation, impacts)
            yield from zip(fixed, np.split(verdicts, len(batch)), strict=True)


def _summary(orbits: Any, rotation: float) -> dict[str, Any]:
    """Return the numbers of a cell that follow from its classified orbits.

    `orbits` is the array of `classify_orbits`, `rotation` the fixed point's rotation number.
    """
    starts, regular = orbits.regular.size, orbits.regular
    sea = np.sort(orbits.exponent[~regular & ~np.isnan(orbits.exponent)])
    apart = ~(np.abs(orbits.winding - rotation) <= WINDING_TOLERANCE)
    turns, islands = nearest_fractions(orbits.winding[regular & apart])
    # Of equally frequent chains `most_common` returns the first: the fewest islands, then turns.
    chains = sorted(zip(islands[islands > 0].tolist(), turns[islands > 0].tolist(), strict=True))
    ((chain_period, chain_turns), count) = (Counter(chains).most_common(1) or [((0, 0), 0)])[0]
    sea_or_nan = sea if sea.size else np.array([math.nan])
    low, high = np.quantile(sea_or_nan, (0.25, 0.75), method="lower")
    return {
        "regular": regular.sum() / starts,
        "regular_low": wilson(int(orbits.strict.sum()), starts)[0],
        "regular_high": wilson(int(orbits.lenient.sum()), starts)[1],
        "regular_strict": orbits.strict.sum() / starts,
        "regular_lenient": orbits.lenient.sum() / starts,
        "exponent": np.mean(sea_or_nan),
        "exponent_error": np.std(sea, ddof=1) / math.sqrt(sea.size) if sea.size > 1 else math.nan,
        "exponent_low": low,
        "exponent_high": high,
        "followed": np.mean(orbits.followed),
        "chain_period": np.int32(chain_period),
        "chain_turns": np.int32(chain_turns),
        "chain_share": count / starts,
        "chains": np.bincount(islands, minlength=MAX_ISLANDS + 1)[1:].astype(np.int32),
    }


def wilson(count: int, total: int) -> tuple[float, float]:
    """Return Wilson's 95 % interval (1927) of a share, which is conservative for spread starts."""
    share, z2 = count / total, NORMAL_95 * NORMAL_95 / total
    middle = (share + 0.5 * z2) / (1.0 + z2)
    half = math.sqrt(share * (1.0 - share) * z2 + 0.25 * z2 * z2) / (1.0 + z2)
    return max(0.0, middle - half), min(1.0, middle + half)


def nearest_fractions(winding: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return p and the least q of fractions p/q that winding numbers equal; zeros without one.

    q is at most MAX_ISLANDS, and numbers are equal to within WINDING_TOLERANCE.
    """
    turns, islands = np.zeros(winding.size, np.int64), np.zeros(winding.size, np.int64)
    for q in range(1, MAX_ISLANDS + 1):
        nearest = np.rint(winding * q)
        equal = (islands == 0) & (np.abs(winding - nearest / q) < WINDING_TOLERANCE)
        turns[equal], islands[equal] = nearest[equal], q
    return turns, islands
