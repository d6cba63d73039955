"""How often a verdict on an orbit, regular or chaotic, is wrong, and what it costs.

Cells are drawn over the whole plane of the atlas. The truth on an orbit is the growth of a tangent
vector over LONG impacts, a hundred times as many as the 4,000 of the sweeps before; an orbit whose
vector has grown beyond DOUBT after EARLY impacts is chaotic, and is followed no further. Compared
are:

    growth below 3            over a fixed number of impacts: the sweeps' verdict before
    growth                    the same with the best threshold
    SALI                      the smaller alignment index of two tangent vectors (Skokos 2001); in
                              two dimensions GALI_2 is the same up to a factor
    weighted Birkhoff average of the turns around the fixed point: how far apart the winding numbers
                              of the two halves are (Das et al. 2017)
    as soon as safe           `sweep.verdict`, with at most that many impacts

The best thresholds are those with the fewest wrong verdicts on the first set of cells; the second
set is unseen.
"""

import math
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import xarray as xr

from ..dynamics import fixed_point
from ..dynamics.ensemble import threads
from ..dynamics.tangent_orbits import CENTRE, SIZE, VECTOR, begin, propagate_with_tangent
from ..dynamics.variables import described, of_rows
from ..sweep.blocks import AXES
from ..sweep.cell import sunflower_points
from ..sweep.verdict import THRESHOLD, classify_orbits, means, windows

LONG, EARLY = 400_000, 20_000
DOUBT = 10 * THRESHOLD  # a regular orbit's growth is about 0.85 whatever its length
LENGTHS = (250, 500, 1000, 2000, 4000, 8000)
METHODS = {
    "growth below 3": "growth",
    "growth, best threshold": "growth",
    "SALI (two vectors)": "alignment",
    "weighted Birkhoff average": "unsettled",
    "as soon as safe": "safe",
}
SETS = ("cells on which thresholds were chosen", "unseen cells")
K, ENERGY = (0.012, 0.332), (0.1, 40.0)


def verdicts(cells=36, orbits=128):
    """Errors and costs of the methods.

    Parameters
    ----------
    cells : int
        How many in each set, at random over the plane.
    orbits : int
        Of each cell, evenly over its section as in a sweep.

    Returns
    -------
    xarray.Dataset
        On (set, method, length): wrong, the share of wrong verdicts; missed, chaotic
        orbits called regular, and alarms, regular ones called chaotic, as shares of all; cost,
        impacts of an orbit. On (method, length): threshold. On (set, cell): k, energy, regular,
        the true share of regular orbits; exponent and exponent_error as `sweep.cell` has them;
        exponent_long, from all impacts of the orbits that are chaotic.

    References
    ----------
    Skokos, Alignment indices: a new, simple method for determining the ordered or chaotic nature of
    orbits, J. Phys. A 34 (2001). Das, Saiki, Sander and Yorke, Quantitative quasiperiodicity,
    Nonlinearity 30 (2017).
    """
    drawn = [place for number in range(len(SETS)) for place in places(cells, number)]
    with ThreadPoolExecutor(threads()) as pool:
        found = list(pool.map(lambda place: _cell(*place, orbits), drawn))
    sets = [_joined(found[i * cells : (i + 1) * cells]) for i in range(len(SETS))]
    shape = len(SETS), len(METHODS), len(LENGTHS)
    missed, alarms, cost = np.empty((3, *shape))
    threshold = np.full(shape[1:], np.nan)
    threshold[0] = 3.0
    for m, key in enumerate(METHODS.values()):
        for j, length in enumerate(LENGTHS):
            if m and key != "safe":
                threshold[m, j] = _best(sets[0][key][j], sets[0]["truth"])
            for i, orbit in enumerate(sets):
                regular = orbit[key][j] < threshold[m, j] if key != "safe" else orbit[key][j]
                missed[i, m, j] = np.mean(regular & ~orbit["truth"])
                alarms[i, m, j] = np.mean(~regular & orbit["truth"])
                cost[i, m, j] = np.mean(orbit["followed"][j]) if key == "safe" else length
    variables = {
        "wrong": (_EACH, missed + alarms, "share of wrong verdicts"),
        "missed": (_EACH, missed, "chaotic orbits called regular, share of all"),
        "alarms": (_EACH, alarms, "regular orbits called chaotic, share of all"),
        "cost": (_EACH, cost, "mean number of impacts of an orbit"),
        "threshold": (_EACH[1:], threshold, "regular is what lies below"),
        "name": ("method", list(METHODS), "how an orbit is judged"),
        "cells": ("set", SETS, "set of cells"),
        "length": ("length", LENGTHS, "largest number of impacts"),
    }
    numbers = np.array([_exponents(one) for one in found]).reshape(len(SETS), cells, len(_CELL))
    variables = described(variables) | of_rows(_CELL, np.moveaxis(numbers, -1, 1))
    return xr.Dataset(variables, attrs={"orbits": orbits, "impacts_of_the_truth": LONG})


_EACH = ("set", "method", "length")
_CELL = {
    "k": (("set", "cell"), *AXES["k"]),
    "energy": (("set", "cell"), *AXES["energy"]),
    "regular": (("set", "cell"), "true share of regular orbits"),
    "exponent": (("set", "cell"), "exponent of the sea from the impacts that all orbits share"),
    "exponent_error": (("set", "cell"), "its standard error"),
    "exponent_long": (("set", "cell"), "exponent of the sea from all impacts that were followed"),
}


def places(count, number):
    """(k, e) of the cells of a set: energies evenly in their logarithm, to six digits."""
    random = np.random.default_rng([7, number])
    found = []
    for _ in range(count):
        k = random.uniform(*K)
        # evenly in the logarithm, by halving: a power would depend on the machine
        low, high = ENERGY
        for half in random.random(40) < 0.5:
            middle = math.sqrt(low * high)
            low, high = (low, middle) if half else (middle, high)
        found.append((float(f"{k:.6g}"), float(f"{low:.6g}")))
    return found


def _cell(k, e, count):
    """What each method has to say about the orbits of a cell, and the truth."""
    place, _, rotation = fixed_point.numbers(k, e)
    about = (
        k,
        np.stack(sunflower_points(k, e, count)),
        np.full(count, place),
        np.full(count, rotation),
    )
    found = {"k": k, "energy": e} | _watched(*about)
    found["alignment"] = _alignment(*about)
    safe = [classify_orbits(*about, length) for length in LENGTHS]
    found["safe"] = np.array([one.regular for one in safe])
    found["followed"] = np.array([one.followed for one in safe])
    found["exponent"] = safe[-1].exponent
    return found


def _watched(k, states, centre, expected):
    """Growth and how unsettled the winding number is after each of LENGTHS, and the truth."""
    turning, growing = windows((*LENGTHS, EARLY, LONG))
    turning = turning[: 3 * len(LENGTHS)]
    orbits = begin(k, states, centre, expected)
    turned = np.zeros((len(turning), centre.size))
    sums = np.zeros((len(growing), centre.size))
    propagate_with_tangent(orbits, k, 0, EARLY, turning, growing, turned, sums)
    winding, growth = means(turning, growing, turned, sums)
    exponent = orbits[SIZE] / EARLY
    rest = ~(growth[-2] > DOUBT)  # NaN, of orbits that graze, goes on
    truth = np.zeros(centre.size, bool)
    if rest.any():
        orbits, turned, sums = (np.compress(rest, a, 1) for a in (orbits, turned, sums))
        propagate_with_tangent(orbits, k, EARLY, LONG, turning, growing, turned, sums)
        exponent[rest] = orbits[SIZE] / LONG
        truth[rest] = means(turning, growing, turned, sums)[1][-1] < THRESHOLD
    return {
        "growth": growth[: len(LENGTHS)],
        "unsettled": np.array([np.abs(a - b) for _, a, b in winding]),
        "truth": truth,
        "exponent_long": exponent,
    }


def _alignment(k, states, centre, expected):
    """SALI of two tangent vectors of the energy surface after each of LENGTHS."""
    one, other = (begin(k, states, centre, expected) for _ in range(2))
    x, v, w = states
    length = np.sqrt(v * v + (k * w) * (k * w))
    # the second one up the slope of the kinetic energy, x with it
    other[VECTOR], other[VECTOR + 1] = 1.0, (1.0 - k * x) * v / (length * length)
    other[VECTOR + 2] = (1.0 - k * x) * w * k / (length * length)
    nothing, sums = np.zeros((0, 2), np.int64), np.zeros((0, centre.size))
    found, start = [], 0
    for stop in LENGTHS:
        for orbits in (one, other):
            propagate_with_tangent(orbits, k, start, stop, nothing, nothing, sums, sums)
        a, b = (orbits[VECTOR:CENTRE][:3] for orbits in (one, other))
        a, b = (c / np.sqrt((c[0] * c[0] + c[1] * c[1]) + c[2] * c[2]) for c in (a, b))
        gaps = [np.sqrt(np.sum((a + sign * b) ** 2, axis=0)) for sign in (1.0, -1.0)]
        found.append(-np.minimum(*gaps))  # small where vectors point apart: regular
        start = stop
    return np.array(found)


def _joined(cells):
    return {
        key: np.concatenate([cell[key] for cell in cells], axis=-1)
        for key in ("growth", "unsettled", "alignment", "safe", "followed", "truth")
    }


def _best(values, truth):
    """The threshold below which to call orbits regular, with the fewest wrong verdicts."""
    order = np.argsort(values, kind="stable")
    values, truth = values[order], truth[order]
    below = np.concatenate([[0], np.cumsum(~truth)])  # chaotic ones called regular
    above = np.sum(truth) - np.concatenate([[0], np.cumsum(truth)])
    at = int(np.argmin(below + above))
    return float(values[min(at, values.size - 1)])


def _exponents(cell):
    """k, energy and so on of a cell, in the order of _CELL."""
    sea = ~cell["truth"] & ~np.isnan(cell["exponent"])
    own, long = cell["exponent"][sea], cell["exponent_long"][sea]
    some = own.size > 1
    return (
        cell["k"],
        cell["energy"],
        np.mean(cell["truth"]),
        np.mean(own) if some else math.nan,
        np.std(own, ddof=1) / math.sqrt(own.size) if some else math.nan,
        np.mean(long) if some else math.nan,
    )
