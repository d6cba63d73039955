"""One cell of a sweep: what share of the section is regular, how chaotic the rest is, and why."""

import math
from collections import Counter

import numpy as np

from ..dynamics import fixed_point
from ..kernel.arithmetic import sincos
from ..kernel.compiled import jit
from .verdict import classify_orbits

PERIODS = 24  # chains of more islands are not told from curves around the fixed point
LOCKED = 1e-5  # turns an impact; that far from a fraction a winding number is taken for it
NORMAL = 1.959964  # standard deviations either way that hold 95 %
BATCH = 40_000  # orbits that are followed together: lanes stay full, and memory small
_GOLDEN = 0.6180339887498949

# Variable -> (long name, type); each is a number a cell, but `chains`, one a cell and period.
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


def cell(k, e, starts, impacts):
    """The numbers of one cell.

    Which orbits are regular is decided by `verdict.judge`. The interval of their share goes from
    the lower end of Wilson's interval with half the threshold to the upper end of that with twice
    the threshold.

    The sea's exponent is the growth of a tangent vector, all other orbits together, over the
    impacts that all have in common: so it does not depend on when the verdict on an orbit was safe.

    A regular orbit belongs to a chain of q islands where its winding number around the fixed point
    is within LOCKED of a fraction p/q, q <= PERIODS: on curves around the fixed point the winding
    number changes from one to the next, in islands it does not; one within LOCKED of the fixed
    point's own is not told from it. A chain inside the main island counts too, islands around an
    island count with it, and so do those of a second orbit of that period.

    Parameters
    ----------
    k : float
        Euler inertia, eq. (5).
    e : float
        E/g^2, above -1/(2k).
    starts : int
        How many orbits. They start evenly over one half, y >= 0, of the section's area;
        the reversor maps regular orbits of the one half to those of the other.
    impacts : int
        At most so many of each, at least 4.

    Returns
    -------
    dict
        With the keys of VARIABLES.

    References
    ----------
    Wilson, Probable inference, the law of succession, and statistical inference, J. Amer. Statist.
    Assoc. 22 (1927).
    """
    return cells(k, [e], starts, impacts)[0]


def cells(k, energies, starts, impacts):
    """What `cell` returns for each of several energies: the same bits, in less time.

    Parameters
    ----------
    k : float
        Euler inertia, eq. (5).
    energies : sequence of float
        E/g^2 of each.
    starts, impacts : int
        As for `cell`.

    Returns
    -------
    list of dict
    """
    step = max(1, BATCH // starts)
    batches = (energies[first : first + step] for first in range(0, len(energies), step))
    return [one for batch in batches for one in _batch(k, batch, starts, impacts)]


def _batch(k, energies, starts, impacts):
    fixed = [fixed_point.numbers(k, e) for e in energies]
    places, traces, rotations = zip(*fixed, strict=True)
    states = np.concatenate([sunflower_points(k, e, starts) for e in energies], axis=1)
    about = np.repeat(places, starts), np.repeat(rotations, starts)
    verdicts = classify_orbits(k, states, *about, impacts)
    return [
        {"trace": trace, "rotation": rotation}
        | _numbers(verdicts[i * starts : (i + 1) * starts], rotation)
        for i, (trace, rotation) in enumerate(zip(traces, rotations, strict=True))
    ]


def _numbers(orbits, rotation):
    """What the verdicts on the orbits of a cell come to."""
    starts, regular = orbits.regular.size, orbits.regular
    sea = np.sort(orbits.exponent[~regular & ~np.isnan(orbits.exponent)])
    apart = ~(np.abs(orbits.winding - rotation) <= LOCKED)
    turns, periods = fractions(orbits.winding[regular & apart])
    period, winds, count = _largest(turns, periods)
    return {
        "regular": regular.sum() / starts,
        "regular_low": wilson(int(orbits.strict.sum()), starts)[0],
        "regular_high": wilson(int(orbits.lenient.sum()), starts)[1],
        "regular_strict": orbits.strict.sum() / starts,
        "regular_lenient": orbits.lenient.sum() / starts,
        "exponent": np.mean(sea) if sea.size else math.nan,
        "exponent_error": np.std(sea, ddof=1) / math.sqrt(sea.size) if sea.size > 1 else math.nan,
        "exponent_low": _quantile(sea, 1),
        "exponent_high": _quantile(sea, 3),
        "followed": np.mean(orbits.followed),
        "chain_period": period,
        "chain_turns": winds,
        "chain_share": count / starts,
        "chains": np.bincount(periods, minlength=PERIODS + 1)[1:],
    }


def wilson(count, of):
    """The 95 % interval of a share, `count` of `of` found, by Wilson's score.

    For independent starts; evenly spread ones do better.
    """
    share, z2 = count / of, NORMAL * NORMAL / of
    middle = (share + 0.5 * z2) / (1.0 + z2)
    half = math.sqrt(share * (1.0 - share) * z2 + 0.25 * z2 * z2) / (1.0 + z2)
    return max(0.0, middle - half), min(1.0, middle + half)


def fractions(winding):
    """(p, q) of the fraction with the smallest q that each winding number (n,) is within LOCKED of.

    (0, 0) where none with q <= PERIODS is.
    """
    turns, periods = np.zeros(winding.size, np.int64), np.zeros(winding.size, np.int64)
    for q in range(1, PERIODS + 1):
        nearest = np.rint(winding * q)
        hit = (periods == 0) & (np.abs(winding - nearest / q) < LOCKED)
        turns[hit], periods[hit] = nearest[hit], q
    return turns, periods


def _largest(turns, periods):
    """(q, p, count) of the fraction p/q that most orbits have, the smallest p and q of several."""
    found = sorted(zip(periods[periods > 0].tolist(), turns[periods > 0].tolist(), strict=True))
    # the first of those that are equally many
    (period, winds), count = (Counter(found).most_common(1) or [((0, 0), 0)])[0]
    return period, winds, count


def _quantile(values, quarter):
    """That quarter's value of sorted values, the lower one of two; NaN if there is none."""
    return float(values[quarter * (values.size - 1) // 4]) if values.size else math.nan


@jit
def _spiral(e, k, x, v, w):
    energy = 2.0 * e + 1.0 / k  # twice that above the ball at rest
    wide = math.sqrt(energy / k)
    high = math.sqrt((1.0 + k) * energy)
    steep = math.sqrt((1.0 + k) * energy / k)
    for i in range(x.size):
        area = (i + 0.5) / x.size  # the share of the half disk that is nearer to the centre
        sine, cosine = sincos(math.pi * (i * _GOLDEN - int(i * _GOLDEN)))
        radius = math.sqrt(area)
        y = high * radius * sine
        s = steep * math.sqrt(1.0 - area)
        x[i] = 1.0 / k + wide * radius * cosine
        v[i] = (y + k * s) / (1.0 + k)
        w[i] = (s - y) / (1.0 + k)


def sunflower_points(k, e, count):
    """States evenly over the half y >= 0 of the section's area.

    Radius by equal areas, angle by the golden section.

    Parameters
    ----------
    k : float
        Euler inertia, eq. (5).
    e : float
        E/g^2.
    count : int

    Returns
    -------
    x, v, w : ndarray, shape (count,)
        x, xdot and udot, lengths in g R.
    """
    x, v, w = np.empty(count), np.empty(count), np.empty(count)
    _spiral(e, k, x, v, w)
    return x, v, w
