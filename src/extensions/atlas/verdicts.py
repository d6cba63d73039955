"""Errors and costs of methods that classify orbits as regular or chaotic.

Orbits are drawn on cells over the whole plane of the atlas, and in SETTINGS, where chaos is slow.
The true verdict on an orbit follows from the growth of a tangent vector over LONG impacts; an orbit
whose growth exceeds SURELY_CHAOTIC after EARLY impacts is chaotic and is followed no further. The
methods are:

    growth, one threshold     GROWTH_THRESHOLD, after a fixed number of impacts
    SALI                      the smaller alignment index of two tangent vectors (Skokos, J. Phys. A
                              34, 2001); in two dimensions GALI_2 equals it up to a factor
    MEGNO                     the mean exponential growth factor of nearby orbits (Cincotta and
                              Simo, Astron. Astrophys. Suppl. 147, 2000)
    weighted Birkhoff average of the turns around the fixed point: the difference between the
                              winding numbers of the two halves (Das et al., Nonlinearity 30, 2017)
    short form                `pseudorigid.dynamics.verdict`, with at most that many impacts
    rule                      `pseudorigid.dynamics.regularity`, with at most that many impacts

The thresholds of SALI, MEGNO and the average give the fewest wrong verdicts on other cells of the
plane.
"""

import math
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
import xarray as xr

from pseudorigid.dynamics import fixed_point
from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.ensemble import threads
from pseudorigid.dynamics.regularity import LENGTHS, judged
from pseudorigid.dynamics.variables import described
from pseudorigid.dynamics.verdict import classify_orbits, windows
from pseudorigid.kernel.arithmetic import log
from pseudorigid.kernel.tangents import CENTRE, SIZE, VECTOR, begin, propagate_with_tangent, weight
from pseudorigid.kernel.verdict import GROWTH_THRESHOLD

from .starts import sunflower_points

LONG, EARLY = 1_000_000, 64_000  # impacts
SURELY_CHAOTIC = 10 * GROWTH_THRESHOLD  # a regular orbit's growth is about 0.85 at any length
_STRIDE = 25  # impacts between values of the logarithm of a tangent vector's length
_PIECE = 256  # orbits that one thread follows at once
# Name -> quantity of an orbit; the threshold below which it is regular, None for the best one; and
# the time of an impact, in impacts of orbits without tangent vectors (`bench.py`).
METHODS: dict[str, tuple[str, float | None, float]] = {
    "growth, one threshold": ("growth", GROWTH_THRESHOLD, 1.5),
    "SALI (two vectors)": ("alignment", None, 1.8),
    "MEGNO": ("megno", None, 1.5),
    "weighted Birkhoff average": ("unsettled", None, 1.1),
    "short form": ("short form", math.nan, 1.6),
    "rule": ("rule", math.nan, 1.6),
}
SETTINGS = {  # name -> k, E/g^2
    "$E$ = 0.01 (Figure 2)": (0.2, 6.25),
    "$E$ = 0.001 (Figure 8)": (0.2, 0.625),
    "$k$ = 1/3, $E/g^2$ = 1.2": (1.0 / 3.0, 1.2),
}
SETS = ("the plane of the atlas", *SETTINGS)
K, ENERGY = (0.012, 0.332), (0.1, 40.0)  # ranges of k and E/g^2

Arrays = dict[str, np.ndarray]  # quantity -> its values on orbits, the last dim
_EACH = ("set", "method", "length")


def verdicts(cells: int = 24, orbits: int = 128, each: int = 1024) -> xr.Dataset:
    """Compute errors and costs of the methods, on (set, method, length).

    There are `orbits` of each of the `cells` of the plane, and `each` of each setting. They start
    evenly over the section, as in a sweep.
    """
    pieces = list(_pieces(cells, orbits, each))
    with ThreadPoolExecutor(threads()) as pool:
        found = list(pool.map(lambda piece: _quantities(*piece[1:]), pieces))
    of_orbit = np.repeat([piece[0] for piece in pieces], [len(piece[2][0]) for piece in pieces])
    quantities = {name: np.concatenate([f[name] for f in found], axis=-1) for name in found[0]}
    sets = [{n: v[..., of_orbit == i] for n, v in quantities.items()} for i in range(len(SETS) + 1)]
    shares, thresholds = [], []
    for quantity, fixed, time in METHODS.values():
        threshold = np.full(len(LENGTHS), fixed, float)
        if fixed is None:
            threshold[:] = [_best_threshold(v, sets[0]["truth"]) for v in sets[0][quantity]]
        thresholds.append(threshold)
        shares.append([_shares(one, quantity, threshold, time) for one in sets[1:]])
    # (method, set, share, length)
    missed, alarms, undecided, cost, times = np.transpose(shares, (2, 1, 0, 3))
    variables = {
        "missed": (_EACH, missed, "chaotic orbits called regular, share of all"),
        "alarms": (_EACH, alarms, "regular orbits called chaotic, share of all"),
        "undecided": (_EACH, undecided, "undecided orbits, share of all"),
        "cost": (_EACH, cost, "mean number of impacts of an orbit"),
        "time": (_EACH, times, "mean time of an orbit, in impacts without tangent vectors"),
        "threshold": (_EACH[1:], thresholds, "regular is what lies below"),
        "orbits": ("set", [one["truth"].size for one in sets[1:]], "number of orbits"),
        "regular": ("set", [one["truth"].mean() for one in sets[1:]], "share of regular orbits"),
        "name": ("method", list(METHODS), "how an orbit is judged"),
        "place": ("set", SETS, "where the orbits lie"),
        "length": ("length", np.array(LENGTHS), "largest number of impacts"),
    }
    return xr.Dataset(described(variables), attrs={"impacts_of_the_truth": LONG})


def random_cells(count: int, number: int) -> list[tuple[float, float]]:
    """Return (k, E/g^2) of the cells of a set, to six digits; the logarithm of E/g^2 is uniform."""
    random = np.random.default_rng([7, number])
    cells = []
    for _ in range(count):
        k = random.uniform(*K)
        # evenly in the logarithm, by halving: a power would depend on the machine
        low, high = ENERGY
        for half in random.random(40) < 0.5:
            middle = math.sqrt(low * high)
            low, high = (low, middle) if half else (middle, high)
        cells.append((float(f"{k:.6g}"), float(f"{low:.6g}")))
    return cells


def _pieces(cells: int, orbits: int, each: int) -> Iterator[tuple[int, float, np.ndarray, float]]:
    """Yield (set, k, states, E/g^2) of all orbits; thresholds are chosen on set 0."""
    settings = [(2 + i, *setting, each) for i, setting in enumerate(SETTINGS.values())]
    plane = [(i, *cell, orbits) for i in (0, 1) for cell in random_cells(cells, i)]
    for number, k, e, count in (*settings, *plane):
        states = np.stack(sunflower_points(k, e, count))
        for first in range(0, count, _PIECE):
            yield number, k, states[:, first : first + _PIECE], e


def _shares(one: Arrays, quantity: str, threshold: np.ndarray, time: float) -> list[np.ndarray]:
    """Return shares of wrong and undecided verdicts of a method at each length, and its cost."""
    truth = one["truth"]
    if quantity in ("short form", "rule"):
        regular, chaotic = one[f"{quantity}, regular"], one[f"{quantity}, chaotic"]
        cost = one[f"{quantity}, followed"].mean(axis=-1)
    else:
        regular = one[quantity] < threshold[:, None]
        chaotic, cost = ~regular, np.array(LENGTHS, float)
    wrong = (regular & ~truth).mean(axis=-1), (chaotic & truth).mean(axis=-1)
    return [*wrong, (~regular & ~chaotic).mean(axis=-1), cost, time * cost]


def _quantities(k: float, states: np.ndarray, e: float) -> Arrays:
    """Return the quantities by which the methods decide on orbits, and the truth."""
    x, _, rotation = fixed_point.numbers(k, e)
    n, lengths = states.shape[1], np.array(LENGTHS)[:, None]
    orbits = k, states, np.full(n, x), np.full(n, rotation)
    short = [classify_orbits(*orbits, length) for length in LENGTHS]
    types, _, followed = judged(Ball(k, 1.0), states)
    regular = np.array([verdicts.regular for verdicts in short])
    return _growth_and_truth(*orbits) | {
        "alignment": _alignment(*orbits),
        "short form, regular": regular,
        "short form, chaotic": ~regular,
        "short form, followed": np.array([verdicts.followed for verdicts in short]),
        "rule, regular": (types == "regular") & (followed <= lengths),
        "rule, chaotic": (types == "chaotic") & (followed <= lengths),
        "rule, followed": np.minimum(followed, lengths),
    }


def _growth_and_truth(
    k: float, states: np.ndarray, centre: np.ndarray, expected: np.ndarray
) -> Arrays:
    """Return growth, MEGNO and difference of winding numbers after LENGTHS, and the truth."""
    turning, _ = windows(LENGTHS)
    quarter = LONG // 4
    growing = np.array([(quarter, quarter), (LONG - quarter, quarter)])
    orbits = begin(k, states, centre, expected)
    turned, sums = np.zeros((len(turning), centre.size)), np.zeros((2, centre.size))
    sizes = np.empty((EARLY // _STRIDE, centre.size))
    for i in range(len(sizes)):
        ends = _STRIDE * i, _STRIDE * (i + 1)
        propagate_with_tangent(orbits, k, *ends, turning, growing, turned, sums)
        sizes[i] = orbits[SIZE]
    weights = np.array([[weight(length)] for _, length in turning])
    _, first, second = np.swapaxes((turned / weights).reshape(-1, 3, centre.size), 0, 1)
    growth = np.array([_growth(sizes[: length // _STRIDE]) for length in LENGTHS])
    megno = np.array([_megno(sizes[: length // _STRIDE]) for length in LENGTHS])
    rest = ~(growth[-1] > SURELY_CHAOTIC)  # includes NaN, of orbits with a grazing impact
    truth = np.zeros(centre.size, bool)
    if rest.any():
        orbits, turned, sums = (np.compress(rest, a, 1) for a in (orbits, turned, sums))
        propagate_with_tangent(orbits, k, EARLY, LONG, turning, growing, turned, sums)
        truth[rest] = (sums[1] - sums[0]) / quarter < GROWTH_THRESHOLD
    return {"growth": growth, "megno": megno, "unsettled": abs(first - second), "truth": truth}


def _growth(sizes: np.ndarray) -> Any:
    """Return the growth from logarithms of a tangent vector's length (m, n)."""
    quarter = len(sizes) // 4
    return sizes[-quarter:].mean(axis=0) - sizes[quarter : 2 * quarter].mean(axis=0)


def _megno(sizes: np.ndarray) -> Any:
    """Return the averaged MEGNO, 2 on regular orbits, from G (m, n).

    MEGNO is 2/t times the integral of s dG(s) over s from 0 to t, which is 2 G(t) less twice the
    mean of G. Its mean over t up to T is 2/T times the integral of G(s) (1 - ln(T/s)).
    """
    m = len(sizes)
    weights = np.array([1.0 - log(m / (i + 0.5)) for i in range(m)])
    return 2.0 * (weights[:, None] * sizes).mean(axis=0)


def _alignment(
    k: float, states: np.ndarray, centre: np.ndarray, expected: np.ndarray
) -> np.ndarray:
    """Return minus SALI of two tangent vectors of the energy surface after each of LENGTHS."""
    first, second = (begin(k, states, centre, expected) for _ in range(2))
    x, v, w = states
    length = np.sqrt(v * v + (k * w) * (k * w))
    # the second vector points up the slope of the kinetic energy, and along x
    second[VECTOR], second[VECTOR + 1] = 1.0, (1.0 - k * x) * v / (length * length)
    second[VECTOR + 2] = (1.0 - k * x) * w * k / (length * length)
    no_windows, no_sums = np.zeros((0, 2), np.int64), np.zeros((0, centre.size))
    alignment, start = [], 0
    for stop in LENGTHS:
        for orbits in (first, second):
            propagate_with_tangent(orbits, k, start, stop, no_windows, no_windows, no_sums, no_sums)
        a, b = (orbits[VECTOR:CENTRE][:3] for orbits in (first, second))
        a, b = (c / np.sqrt((c[0] * c[0] + c[1] * c[1]) + c[2] * c[2]) for c in (a, b))
        gaps = [np.sqrt(np.sum((a + sign * b) ** 2, axis=0)) for sign in (1.0, -1.0)]
        alignment.append(-np.minimum(*gaps))  # low for vectors that point apart: regular
        start = stop
    return np.array(alignment)


def _best_threshold(values: np.ndarray, truth: np.ndarray) -> float:
    """Return the threshold, below which orbits are called regular, with fewest wrong verdicts."""
    order = np.argsort(values, kind="stable")
    values, truth = values[order], truth[order]
    below = np.concatenate([[0], np.cumsum(~truth)])  # chaotic ones called regular
    above = np.sum(truth) - np.concatenate([[0], np.cumsum(truth)])
    at = int(np.argmin(below + above))
    return float(values[min(at, values.size - 1)])
