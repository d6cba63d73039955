"""One cell of a sweep: what share of the section is regular, how chaotic the rest is, and why."""

import math
from collections import Counter

import numpy as np

from ..kernel.arithmetic import sincos
from ..kernel.compiled import jit
from . import fixed_point
from .follow import follow

# Over the second half of its impacts a tangent vector of a regular orbit grows like the number of
# impacts, and ln(7/3) = 0.85 is its mean; a chaotic one grows by many times e.
THRESHOLD = 3.0
PERIODS = 24  # chains of more islands are not told from curves around the fixed point
LOCKED = 1e-5  # turns an impact; that far from a fraction a winding number is taken for it
NORMAL = 1.959964  # standard deviations either way that hold 95 %
_GOLDEN = 0.6180339887498949

# Variable -> (long name, type); each is a number a cell, but `chains`, one a cell and period.
VARIABLES = {
    "trace": ("trace of the fixed point's Jacobian", "f8"),
    "rotation": ("rotation number of the fixed point, NaN where it is not elliptic", "f8"),
    "regular": ("share of the section's area with regular orbits", "f8"),
    "regular_low": ("lower end of the share's 95 % interval (Wilson)", "f8"),
    "regular_high": ("upper end of the share's 95 % interval (Wilson)", "f8"),
    "regular_strict": ("the share with half the threshold", "f8"),
    "regular_lenient": ("the share with twice the threshold", "f8"),
    "exponent": ("median Lyapunov exponent an impact of the other orbits, the sea", "f8"),
    "exponent_low": ("lower quartile of the sea's exponents", "f8"),
    "exponent_high": ("upper quartile of the sea's exponents", "f8"),
    "chain_period": ("islands of the largest chain, 0 where there is none", "i4"),
    "chain_turns": ("turns around the fixed point in that many impacts", "i4"),
    "chain_share": ("share of the section's area in that chain's islands", "f8"),
    "chains": ("regular starts in chains of so many islands", "i4"),
}


def cell(k, e, starts, impacts):
    """The numbers of one cell, as a dict with the keys of VARIABLES.

    Args:
        k: Euler inertia.
        e: energy E/g^2, above -1/(2k).
        starts: how many orbits. They start evenly over one half, y >= 0, of the section's area;
            the reversor maps regular orbits of the one half to those of the other.
        impacts: of each.

    An orbit is regular while a tangent vector grows by less than THRESHOLD in the mean logarithm
    from the second to the last quarter, which bounds its exponent by about 2 THRESHOLD/impacts. One
    that grazes exactly, where there is no derivative, is not.

    A regular orbit belongs to a chain of q islands where its winding number around the fixed point
    is within LOCKED of a fraction p/q, q <= PERIODS: on curves around the fixed point the winding
    number changes from one to the next, in islands it does not; one within LOCKED of the fixed
    point's own is not told from it. It is a weighted Birkhoff average, with weight (t (1-t))^3 over
    the run (Das et al. 2017). A chain inside the main island counts
    too, islands around an island count with it, and so do those of a second orbit of that period.
    """
    theta = fixed_point.half_time(k, e)
    trace = fixed_point.trace(k, theta)
    rotation = fixed_point.rotation(trace)
    expected = 0.5 if math.isnan(rotation) else rotation
    time = (np.arange(impacts) + 0.5) / impacts
    bump = time * (1.0 - time)
    weight = bump * bump * bump
    weight /= weight.sum()
    growth, winding = np.empty(starts), np.empty(starts)
    states = _even(k, e, starts)
    follow(*states, k, fixed_point.place(k, theta), expected, weight, growth, winding)
    grown = growth * (impacts - 2 * (impacts // 4))
    regular = grown < THRESHOLD
    low, high = wilson(int(regular.sum()), starts)
    sea = np.sort(growth[~regular & ~np.isnan(growth)])
    apart = ~(np.abs(winding - rotation) <= LOCKED)
    turns, periods = fractions(winding[regular & apart])
    chains = np.bincount(periods, minlength=PERIODS + 1)[1:]
    found = {
        "trace": trace,
        "rotation": rotation,
        "regular": regular.sum() / starts,
        "regular_low": low,
        "regular_high": high,
        "regular_strict": (grown < 0.5 * THRESHOLD).sum() / starts,
        "regular_lenient": (grown < 2.0 * THRESHOLD).sum() / starts,
        "exponent": _quantile(sea, 2),
        "exponent_low": _quantile(sea, 1),
        "exponent_high": _quantile(sea, 3),
    }
    period, winds, count = _largest(turns, periods)
    return found | {
        "chain_period": period,
        "chain_turns": winds,
        "chain_share": count / starts,
        "chains": chains,
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


def _even(k, e, count):
    """`count` states, evenly over the half y >= 0 of the section's area: x, v, w (count,).

    Radius by equal areas, angle by the golden section.
    """
    x, v, w = np.empty(count), np.empty(count), np.empty(count)
    _spiral(e, k, x, v, w)
    return x, v, w
