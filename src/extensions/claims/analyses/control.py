"""A control experiment: which orbits stay regular if the map loses area, the reversor or both.

The impact map keeps area and has a reversor. It is changed a little after, and before, each impact,
by the maps of `perturbed_map`: for each of three forms of change, so that the changed map keeps
both properties, one of them, or neither.
Starts are spread uniformly over the section, the same for all maps. Each orbit has one of three
classes, by two growths from the middle of the second quarter of its impacts to the middle of the
last: of a tangent vector and of an area, as logarithms. An orbit is chaotic if the first exceeds
GROWTH_THRESHOLD; else it is a spiral if the second does so in size; else it is regular. The first
quarter, a transient, counts for nothing. Spirals are captured by attracting orbits. In a map with
the reversor a regular orbit is symmetric if it comes close to the mirror image of its start: curves
around symmetric points are their own mirror images, or mirror images of each other. A growth per
impact is seen only if it exceeds about twice the threshold divided by the number of impacts, so
shares are kept for four numbers of them.
"""

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import xarray as xr

from extensions.atlas.cell import NORMAL_95
from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.variables import (
    RADIUS,
    described,
)
from pseudorigid.kernel.arithmetic import sincos
from pseudorigid.kernel.compiled import jit
from pseudorigid.kernel.verdict import GROWTH_THRESHOLD

from .perturbed_map import (
    MAPS,
    NEAREST,
    NO_POINTS,
    PerturbedMap,
    apply,
    orbit_rows,
    perturbed_map,
    propagate,
)
from .sea import half_axes, section_points

_LENGTHS = 4  # numbers of impacts at which orbits are classified, each twice the one before
# Orbits that start on a small circle around a periodic point measure its spiral: their number,
# their distance from it in section radii, and their impacts.
_PROBES, _MIRRORS = 200, 36  # points and mirror lines for which reversors are tried
_MIRRORED = 0.02  # section radii from its start's mirror image, which a symmetric orbit enters
_ORBITS_PER_MEMBER = 50  # a class with fewer than one in so many orbits has no mean
CLASSES = ("regular", "spiral", "chaotic")
# Growths of tangent vectors and of areas (length, orbit) as logarithms, and which orbits are
# symmetric (orbit).
Growths = tuple[np.ndarray, np.ndarray, np.ndarray]
_CELLS = "map", "strength"
_BY_CLASS = (*_CELLS, "length", "class")
_OF_MAPS = {
    "class_share": (_BY_CLASS, "share of starts of a class"),
    "class_low": (_BY_CLASS, "share of starts of a class, 95 % interval from"),
    "class_high": (_BY_CLASS, "share of starts of a class, 95 % interval to"),
    "symmetric": (_CELLS, "share of starts of regular, symmetric orbits"),
    "wander": (
        (*_CELLS, "length"),
        "standard deviation over chaotic orbits of an area's growth, a logarithm",
    ),
    "defect": (_CELLS, "median of |S F S F z - z|, least over the reversors S tried", RADIUS),
}


def control(
    ball: Ball, energy: float, strengths: Sequence[float], orbits: int, impacts: int,
    starts: Sequence[float], shown: float, drawn: int, *,
    progress: Callable[[float, str], None] | None = None,
) -> xr.Dataset:  # fmt: skip
    """Compute shares of regular, spiral and chaotic orbits for maps with and without properties.

    The maps are those of `perturbed_map.MAPS`, at strength 0, which is the impact map, and at each
    of `strengths`. Shares have Wilson's 95 % intervals. `progress` is called with the share of maps
    done and a text.

    >>> from pseudorigid import Ball
    >>> ball = Ball(k=0.2, g=0.04)
    >>> data = control(ball, 0.01, [0.02], 20, 200, [0.1], 0.02, 10)
    >>> data["class_share"].values[0, 0, -1].sum().item()
    1.0
    """
    levels = [0.0, *map(float, strengths)]
    points = _in_disk(ball, energy, *section_points(ball, energy, orbits))
    lengths = [impacts >> i for i in reversed(range(_LENGTHS))]
    statistics: dict[tuple[str, float], dict[str, Any]] = {}
    for name, (*_, reversible) in MAPS.items():
        for level in levels:
            if level == 0.0 and statistics:  # at strength 0 all maps are the impact map
                statistics[name, level] = next(iter(statistics.values()))
                continue
            if progress is not None:
                done = len(statistics) / (len(MAPS) * len(levels))
                progress(done, f"{name}, strength {level}")
            perturbed = perturbed_map(ball, energy, name, level)
            of_map = _statistics(_growths(perturbed, points, lengths))
            if level > 0.0 and not reversible:  # orbits have no mirror images
                of_map["symmetric"] = math.nan
            statistics[name, level] = of_map | {"defect": _reversor_defect(perturbed)}
    data: dict[str, tuple[Any, ...]] = {
        "map": ("map", [*MAPS], "form of the change, and which of the map's properties it keeps"),
        "class": ("class", [*CLASSES], "class of an orbit"),
        "strength": ("strength", levels, "strength of the change"),
        "length": ("length", lengths, "number of impacts"),
    }
    for variable, (dims, *text) in _OF_MAPS.items():
        values = [[statistics[name, level][variable] for level in levels] for name in MAPS]
        data[variable] = dims, values, *text
    data |= _portraits(ball, energy, np.asarray(starts, dtype=float), shown, impacts, drawn)
    return xr.Dataset(described(data), attrs={"shown": float(shown)})


def _in_disk(ball: Ball, energy: float, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return points (x, y) of the section as points (a, b) of the unit disk, an array (2, n)."""
    width, height = half_axes(ball, energy)
    return np.stack([(x - ball.section(energy)[0]) / width, y / height])


def _growths(
    perturbed: PerturbedMap, points: np.ndarray, lengths: Sequence[int], out: np.ndarray = NO_POINTS
) -> Growths:
    """Compute the growths of orbits that start at points (2, n); `out` is that of `propagate`."""
    windows = np.array([(at, n // 4) for n in lengths for at in (n // 4, n - n // 4)])
    sums = np.zeros((2, len(windows), points.shape[1]))
    rows = orbit_rows(points)
    propagate(rows, *perturbed, max(lengths), windows, sums, out)
    means = sums / windows[:, 1:]
    tangent, area = means[:, 1::2] - means[:, ::2]
    return tangent, area, rows[NEAREST] < _MIRRORED * _MIRRORED


def classes(grown: np.ndarray, area: np.ndarray) -> np.ndarray:
    """Return the place in CLASSES of each orbit, from its growths; NaN counts as chaotic."""
    spiral = np.where(np.abs(area) < GROWTH_THRESHOLD, 0, 1)
    return np.where(grown < GROWTH_THRESHOLD, spiral, 2)


def _statistics(growths: Growths) -> dict[str, Any]:
    """Return the values of _OF_MAPS, all but the defect, for orbits of one map.

    If a map keeps any smooth area, the growth of an area along an orbit is bounded, and so is its
    standard deviation, the wander.
    """
    tangent, area, symmetric = growths
    kinds = classes(tangent, area)
    counts = np.stack([np.sum(kinds == i, axis=1) for i in range(len(CLASSES))], axis=1)
    total = kinds.shape[1]
    intervals = np.array([[_wilson(int(n), total) for n in row] for row in counts])
    regular, _, chaotic = (kinds[-1] == i for i in range(len(CLASSES)))
    wander = np.full(len(kinds), math.nan)
    if np.sum(chaotic) >= max(total // _ORBITS_PER_MEMBER, 1):
        wander = np.std(area[:, chaotic], axis=1)
    return {
        "class_share": counts / total,
        "class_low": intervals[..., 0],
        "class_high": intervals[..., 1],
        "symmetric": np.mean(symmetric & regular),
        "wander": wander,
    }


def _wilson(count: int, total: int) -> tuple[float, float]:
    """Return Wilson's 95 % interval (1927) of the share count/total.

    It rounds otherwise than `wilson` of the atlas, whose bits are in published datasets too.
    """
    square = NORMAL_95 * NORMAL_95
    middle, scale = count + 0.5 * square, total + square
    reach = NORMAL_95 * math.sqrt(count * (total - count) / total + 0.25 * square)
    return max(0.0, (middle - reach) / scale), min(1.0, (middle + reach) / scale)


@jit
def _applied(change: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Return the images of points (2, n) under a change."""
    out = np.empty_like(points)
    for i in range(points.shape[1]):
        image = apply(change, points[0, i], points[1, i])
        out[0, i], out[1, i] = image[0], image[1]
    return out


def _reversor_defect(perturbed: PerturbedMap) -> float:
    """Return how far the reversors that are tried are from reversing a perturbed map.

    They are the mirrors S in lines through the middle of the section, one of them R, and T S.
    """
    step = np.array([0.7548776662466927, 0.5698402909980532])
    square = np.arange(1, _PROBES + 1)[:, None] * step
    points = 1.3 * (square - np.floor(square)).T - 0.65  # within the disk
    least = math.inf
    for i in range(_MIRRORS):
        sine, cosine = sincos(2.0 * math.pi * i / _MIRRORS)
        mirror = np.array([[cosine, sine], [sine, -cosine]])
        for after in (None, perturbed.changes[1]):
            image = points
            for _ in range(2):
                image = _product(mirror, perturbed.images(image))
                image = image if after is None else _applied(after, image)
            off = image - points
            distance = np.sort(np.sqrt(off[0] * off[0] + off[1] * off[1]))
            least = min(least, float(distance[_PROBES // 2]))
    return least


def _product(matrix: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Return a matrix (2, 2) times points (2, n), without BLAS."""
    return matrix[:, 0, None] * points[0] + matrix[:, 1, None] * points[1]


def _portraits(
    ball: Ball, energy: float, starts: np.ndarray, shown: float, impacts: int, drawn: int
) -> dict[str, tuple[Any, ...]]:
    """Return orbits of the impact map and of each map at one strength, with their classes."""
    points = np.stack([starts, np.zeros(starts.size)])
    orbits, kinds = [], []
    for name, strength in ((next(iter(MAPS)), 0.0), *((name, shown) for name in MAPS)):
        perturbed = perturbed_map(ball, energy, name, strength)
        out = np.empty((2, starts.size, impacts))
        tangent, area, _ = _growths(perturbed, points, [impacts], out)
        orbits.append(out[:, :, :drawn])
        kinds.append(classes(tangent[0], area[0]))
    dims = ("panel", "start", "impact")
    a, b = np.stack(orbits, axis=1)
    return {
        "panel": ("panel", ["none", *MAPS], "the impact map, and the perturbed maps"),
        "start": ("start", starts, "start on y = 0, in section radii", RADIUS),
        "a": (dims, a, "a after each impact", RADIUS),
        "b": (dims, b, "b after each impact", RADIUS),
        "kind": (("panel", "start"), np.array(kinds), "class of the orbit, its place in `class`"),
    }
