"""One cell (k, E) of a sweep: share of regular orbits, chains of islands, exponent of the sea.

Lengths are in g R and energies are E/g^2. The sea is the set of orbits that are not regular.
"""

import math
from collections import Counter
from collections.abc import Sequence
from typing import Any

import numpy as np

from pseudorigid.dynamics import fixed_point
from pseudorigid.dynamics.verdict import classify_orbits
from pseudorigid.kernel.arithmetic import sincos
from pseudorigid.kernel.compiled import jit

PERIODS = 24  # most islands of a chain; longer chains count as curves around the fixed point
LOCKED = 1e-5  # turns an impact; a winding number as near to a fraction is taken to equal it
NORMAL_95 = 1.959964  # standard deviations on either side of the mean that hold 95 %
BATCH_SIZE = 40_000  # orbits followed together: SIMD lanes stay full, and memory small
_GOLDEN_RATIO = 0.6180339887498949  # the smaller one

# Variable -> (long name, type). A cell has one number of each, and one of `chains` per period.
VARIABLES = {
    "trace": ("trace of the fixed point's Jacobian", "f8"),
    "rotation": ("rotation number of the fixed point, NaN where it is not elliptic", "f8"),
    "regular": ("share of the section's area with regular orbits", "f8"),
    "regular_low": ("lower end of its 95 % interval, starts and threshold together", "f8"),
    "regular_high": ("upper end of its 95 % interval, starts and threshold together", "f8"),
    "regular_strict": ("the share with half the threshold", "f8"),
    "regular_lenient": ("the share with twice the threshold", "f8"),
    "exponent": ("Lyapunov exponent an impact of the other orbits, the sea, pooled", "f8"),
    "exponent_error": ("standard error of the exponent, from the spread between orbits", "f8"),
    "exponent_low": ("lower quartile of the single orbits' exponents", "f8"),
    "exponent_high": ("upper quartile of the single orbits' exponents", "f8"),
    "followed": ("mean number of impacts of an orbit", "f8"),
    "chain_period": ("islands of the largest chain, 0 where there is none", "i4"),
    "chain_turns": ("turns around the fixed point in that many impacts", "i4"),
    "chain_share": ("share of the section's area in that chain's islands", "f8"),
    "chains": ("regular starts in chains of so many islands", "i4"),
}


def cell(k: float, e: float, starts: int, impacts: int) -> dict[str, Any]:
    """Compute the numbers of one cell, with the keys of VARIABLES.

    Each of the `starts` orbits is followed for at most `impacts` >= 4 impacts. The orbits start
    evenly over one half, y >= 0, of the section's area; the reversor maps regular orbits of this
    half to those of the other half. The interval of the regular share goes from the lower end of
    Wilson's interval with half the threshold to the upper end of the one with twice the threshold.
    The sea's exponent is the growth rate of tangent vectors over those impacts that every orbit is
    followed for, so that it does not depend on when an orbit was classified.

    A regular orbit belongs to a chain of q islands if its winding number around the fixed point is
    within LOCKED of a fraction p/q, q <= PERIODS, but not of the fixed point's own rotation number.
    On curves around the fixed point the winding number changes from curve to curve; in islands it
    does not. Chains inside the main island and islands around islands are counted, too, and chains
    of the same p/q count as one.
    """
    return cells_of_k(k, [e], starts, impacts)[0]


def cells_of_k(
    k: float, energies: Sequence[float], starts: int, impacts: int
) -> list[dict[str, Any]]:
    """Compute several cells with one k, bit for bit as `cell` does but in less time."""
    cells = []
    step = max(1, BATCH_SIZE // starts)
    for batch in (energies[first : first + step] for first in range(0, len(energies), step)):
        places, traces, rotations = zip(*(fixed_point.numbers(k, e) for e in batch), strict=True)
        states = np.concatenate([sunflower_points(k, e, starts) for e in batch], axis=1)
        centre, expected = np.repeat(places, starts), np.repeat(rotations, starts)
        verdicts = classify_orbits(k, states, centre, expected, impacts)
        for i, (trace, rotation) in enumerate(zip(traces, rotations, strict=True)):
            orbits = verdicts[i * starts : (i + 1) * starts]
            cells.append({"trace": trace, "rotation": rotation} | _summary(orbits, rotation))
    return cells


def _summary(orbits: Any, rotation: float) -> dict[str, Any]:
    """Return the numbers of a cell that follow from its classified orbits.

    `orbits` is the array of `classify_orbits`, `rotation` the fixed point's rotation number.
    """
    starts, regular = orbits.regular.size, orbits.regular
    sea = np.sort(orbits.exponent[~regular & ~np.isnan(orbits.exponent)])
    apart = ~(np.abs(orbits.winding - rotation) <= LOCKED)
    turns, periods = fractions(orbits.winding[regular & apart])
    # Of equally frequent chains `most_common` returns the first: the smallest period, then turns.
    chains = sorted(zip(periods[periods > 0].tolist(), turns[periods > 0].tolist(), strict=True))
    ((period, winds), count) = (Counter(chains).most_common(1) or [((0, 0), 0)])[0]
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
        "chain_period": period,
        "chain_turns": winds,
        "chain_share": count / starts,
        "chains": np.bincount(periods, minlength=PERIODS + 1)[1:],
    }


def wilson(count: int, total: int) -> tuple[float, float]:
    """Return Wilson's 95 % interval (1927) of a share, which is conservative for spread starts."""
    share, z2 = count / total, NORMAL_95 * NORMAL_95 / total
    middle = (share + 0.5 * z2) / (1.0 + z2)
    half = math.sqrt(share * (1.0 - share) * z2 + 0.25 * z2 * z2) / (1.0 + z2)
    return max(0.0, middle - half), min(1.0, middle + half)


def fractions(winding: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return p and the least q <= PERIODS with p/q within LOCKED of each number, or zeros."""
    turns, periods = np.zeros(winding.size, np.int64), np.zeros(winding.size, np.int64)
    for q in range(1, PERIODS + 1):
        nearest = np.rint(winding * q)
        hit = (periods == 0) & (np.abs(winding - nearest / q) < LOCKED)
        turns[hit], periods[hit] = nearest[hit], q
    return turns, periods


@jit
def _spiral(e: float, k: float, x: np.ndarray, v: np.ndarray, w: np.ndarray) -> None:
    """Write x, v = xdot and w = udot of states evenly over half the section, on a golden spiral."""
    energy = 2.0 * e + 1.0 / k  # twice the energy above that of the ball at rest
    wide = math.sqrt(energy / k)
    high = math.sqrt((1.0 + k) * energy)
    steep = math.sqrt((1.0 + k) * energy / k)
    for i in range(x.size):
        area = (i + 0.5) / x.size  # share of the half disk that is nearer to the centre
        sine, cosine = sincos(math.pi * (i * _GOLDEN_RATIO - int(i * _GOLDEN_RATIO)))
        radius = math.sqrt(area)
        y = high * radius * sine
        s = steep * math.sqrt(1.0 - area)
        x[i] = 1.0 / k + wide * radius * cosine
        v[i] = (y + k * s) / (1.0 + k)
        w[i] = (s - y) / (1.0 + k)


def sunflower_points(k: float, e: float, count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return states (x, v, w), lengths in g R, evenly over the half y >= 0 of the section."""
    x, v, w = np.empty(count), np.empty(count), np.empty(count)
    _spiral(e, k, x, v, w)
    return x, v, w
