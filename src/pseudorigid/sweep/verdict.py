"""Whether orbits are regular: each is followed until that is safe, and no longer.

All are followed for FIRST impacts; those still undecided for twice as many, and so on, at most to
the end. At each of these lengths L, with the tangent vector's length exp(G):

    growth   the mean of G over the last quarter less that over the second one. On a regular orbit
             a tangent vector grows like the number of impacts, and growth is ln(7/3) = 0.85 on
             average; on a chaotic one it is the exponent times L/2.
    settled  the difference between the winding numbers of the first and the second half: weighted
             Birkhoff averages, which converge on quasi-periodic orbits faster than any power of
             1/L that the smoothness of weight and orbit admits (Das et al. 2017).

An orbit is regular where growth is below half of THRESHOLD and the winding number has settled to
SETTLED; chaotic where growth is above twice THRESHOLD and G above SURE. What is undecided at the
end is regular where growth is below THRESHOLD. One that grazes exactly, where the map has no
derivative, is neither.
"""

import math
from dataclasses import dataclass, fields

import numpy as np

from ..dynamics.tangent_orbits import SIZE, begin, propagate_with_tangent, weight

FIRST = 500  # impacts that all orbits have: the exponent is taken from them
# Of growth: half of it is still above a regular orbit's 0.85. `study.verdicts` holds it against the
# threshold with the fewest wrong verdicts.
THRESHOLD = 2.2
SETTLED = 1e-7  # turns an impact
MIN_CHAOTIC_GROWTH = 15.0  # a regular orbit's G is about ln 16,000 = 9.7 after as many impacts


def levels(impacts):
    """The lengths at which orbits are judged, the last one `impacts`."""
    found = [FIRST]
    while found[-1] < impacts:
        found.append(2 * found[-1])
    return [*found[:-1], impacts]


@dataclass
class Verdicts:
    """What was found of each orbit, arrays (n,).

    Attributes
    ----------
    regular, strict, lenient : ndarray of bool
        Whether it is regular; the same with half and with twice the threshold.
    winding : ndarray
        Turns around the centre an impact.
    growth : ndarray
        What is compared with the threshold.
    exponent : ndarray
        The growth of a tangent vector, nats an impact, from a quarter of the first length to the
        whole of it, the impacts that all orbits have in common.
    followed : ndarray of int
        How many impacts.
    """

    regular: np.ndarray
    strict: np.ndarray
    lenient: np.ndarray
    winding: np.ndarray
    growth: np.ndarray
    exponent: np.ndarray
    followed: np.ndarray

    def __getitem__(self, part):
        """The verdicts on some of the orbits."""
        return Verdicts(*(getattr(self, field.name)[part] for field in fields(self)))


def classify_orbits(k, states, centre, expected, impacts):
    """Follow orbits for at most `impacts` and judge them.

    Parameters
    ----------
    k : float
        Euler inertia, eq. (5).
    states : (x, v, w), each of shape (n,)
        Just before an impact, lengths in g R.
    centre : ndarray, shape (n,)
        The x around which the turns are counted, at y = 0.
    expected : ndarray, shape (n,)
        The turn of an impact that is expected, NaN where none is.
    impacts : int
        At least 4.

    Returns
    -------
    Verdicts

    References
    ----------
    Das, Saiki, Sander and Yorke, Quantitative quasiperiodicity, Nonlinearity 30 (2017).
    """
    lengths = levels(impacts)
    turning, growing = windows(lengths)
    ends = [(lengths[0] // 4 - 1, 1), (lengths[0] - 1, 1)]  # of the impacts that all have
    growing = np.concatenate([growing, ends])
    orbits = begin(k, states, centre, expected)
    turned, growth = (np.zeros((len(rows), len(centre))) for rows in (turning, growing))
    found = Verdicts(
        *(np.zeros(len(centre), bool) for _ in range(3)),
        *(np.full(len(centre), math.nan) for _ in range(3)),
        np.zeros(len(centre), np.int64),
    )
    which = np.arange(len(centre))  # those that are still followed
    start = 0
    for level, length in enumerate(lengths):
        propagate_with_tangent(orbits, k, start, length, turning, growing, turned, growth)
        turns, grows = slice(3 * level, 3 * level + 3), slice(2 * level, 2 * level + 2)
        (winding,), (grown,) = means(turning[turns], growing[grows], turned[turns], growth[grows])
        if not start:
            found.exponent[:] = (growth[-1] - growth[-2]) / (length - length // 4)
        strict = grown < 0.5 * THRESHOLD
        if length < impacts:
            regular = strict & (np.abs(winding[1] - winding[2]) < SETTLED)
            chaotic = (grown > 2.0 * THRESHOLD) & (orbits[SIZE] > MIN_CHAOTIC_GROWTH)
            decided = regular | chaotic | np.isnan(grown)
            strict = lenient = regular
        else:
            regular, lenient = grown < THRESHOLD, grown < 2.0 * THRESHOLD
            decided = np.ones(which.size, bool)
        found.winding[which], found.growth[which], found.followed[which] = winding[0], grown, length
        for name, verdict in (("regular", regular), ("strict", strict), ("lenient", lenient)):
            getattr(found, name)[which[decided]] = verdict[decided]
        start, which = length, which[~decided]
        if not which.size:
            break
        # A mask as index would give another order in memory, for which all is compiled again.
        orbits, turned, growth = (np.compress(~decided, a, 1) for a in (orbits, turned, growth))
    return found


def windows(lengths):
    """Return the windows over which sums are taken, as pairs of first impact and length.

    Parameters
    ----------
    lengths : sequence of int
        At which orbits are judged.

    Returns
    -------
    turning : ndarray, shape (3 m, 2)
        Each of the m lengths and its two halves.
    growing : ndarray, shape (2 m, 2)
        The second and the last quarter of each.
    """
    turning, growing = [], []
    for length in lengths:
        half, quarter = length // 2, length // 4
        turning += [(0, length), (0, half), (length - half, half)]
        growing += [(quarter, quarter), (length - quarter, quarter)]
    return np.array(turning), np.array(growing)


def means(turning, growing, turned, growth):
    """Winding numbers and growth from the sums of `propagate_with_tangent` over `windows`.

    Parameters
    ----------
    turning, growing : ndarray
        As from `windows`, of m lengths.
    turned, growth : ndarray
        The sums for n orbits.

    Returns
    -------
    winding : ndarray, shape (m, 3, n)
        Turns an impact, of each length and of its two halves.
    growth : ndarray, shape (m, n)
        Of the mean logarithm of a tangent vector, from the second quarter to the last.
    """
    weights = np.array([[weight(length)] for _, length in turning])
    late, early = growth[1::2] / growing[1::2, 1:], growth[::2] / growing[::2, 1:]
    return (turned / weights).reshape(-1, 3, turned.shape[1]), late - early
