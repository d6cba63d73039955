"""A control: which orbits stay regular if the map keeps area, is reversible, both, or neither.

The impact map is changed a little after, and before, each impact, by the maps of `perturbed_map`:
for each of two forms of change, with each of the four sets of properties.
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
from collections.abc import Callable

import numpy as np
import xarray as xr

from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.periodic import symmetric_orbits
from pseudorigid.dynamics.regularity import GROWTH_THRESHOLD
from pseudorigid.dynamics.variables import (
    RADIUS,
    NoOrbitError,
    chart,
    described,
    of_type,
    states_of,
)
from pseudorigid.kernel.arithmetic import log, sincos
from pseudorigid.kernel.compiled import jit

from .perturbed_map import (
    DA,
    DB,
    KEPT,
    MAPS,
    MIRROR_A,
    NEAREST,
    PerturbedMap,
    apply,
    perturbed_map,
    propagate,
)
from .sea import half_axes, section_points

_LENGTHS = 4  # numbers of impacts at which orbits are classified, each twice the one before
# A ring of orbits around a periodic point measures its spiral: their number, their distance from
# it in section radii, and their impacts.
_RING, _DISTANCE, _RING_IMPACTS = 32, 1e-4, 120
_STEPS, _NEWTON, _CLOSED, _NEAR = 8, 30, 1e-13, 0.05  # continuation of a periodic point
_PROBES, _MIRRORS = 200, 36  # points and mirror lines for which reversors are tried
_MIRRORED = (
    0.02  # section radii from its start's mirror image, within which a symmetric orbit comes
)
_Z95 = 1.959964  # standard deviations that hold 95 %
_FEW = 50  # a mean over less than one in so many orbits is not of a class, but of what is left
_NONE = np.empty((2, 0, 0))
CLASSES = ("regular", "spiral", "chaotic")


def control(
    ball,
    energy,
    strengths,
    orbits,
    impacts,
    period,
    starts,
    shown,
    drawn,
    resamples,
    seed,
    *,
    progress: Callable[[float, str], None] | None = None,
) -> xr.Dataset:
    """Compute shares of regular, spiral and chaotic orbits for maps with and without properties.

    The maps are those of `perturbed_map.MAPS`, at strength 0, which is the impact map, and at each
    of `strengths`. Shares have Wilson's 95 % intervals, means over orbits those of a bootstrap. The
    fixed point and the elliptic orbit of `period` are continued in the strength. `progress` is
    called with the share of maps done and a text.

    >>> from pseudorigid import Ball
    >>> ball = Ball(k=0.2, g=0.04)
    >>> data = control(ball, 0.01, [0.02], 20, 200, 6, [0.1], 0.02, 10, 20, 1)
    >>> data["class_share"].values[0, 0, -1].sum().item()
    1.0
    """
    levels = [0.0, *map(float, strengths)]
    points = _disk(ball, energy, *section_points(ball, energy, orbits))
    resampled = np.random.default_rng(seed).integers(0, orbits, (resamples, orbits))
    ring = np.random.default_rng(seed).integers(0, _RING, (resamples, _RING))
    lengths = [impacts >> i for i in reversed(range(_LENGTHS))]
    rows = {}
    for name in MAPS:
        for level in levels:
            # At strength 0 all maps are one.
            if level == 0.0 and rows:
                rows[name, level] = next(iter(rows.values()))
                continue
            if progress is not None:
                progress(len(rows) / (len(MAPS) * len(levels)), f"{name}, strength {level}")
            grown = _growths(perturbed_map(ball, energy, name, level), points, lengths)
            rows[name, level] = _statistics(*grown, lengths[-1], resampled)
    shares, intervals, means, symmetric, wander = (
        np.array([[rows[name, level][part] for level in levels] for name in MAPS])
        for part in range(5)
    )
    # Without the reversor, orbits have no mirror images.
    symmetric[[not reversible for *_, reversible in MAPS.values()], 1:] = math.nan
    cells = ("map", "strength")
    data = {
        "map": (
            "map",
            list(MAPS),
            "form of the change, and which of the map's properties it keeps",
        ),
        "class": ("class", list(CLASSES), "class of an orbit"),
        "strength": ("strength", levels, "strength of the change"),
        "length": ("length", lengths, "number of impacts"),
        "class_share": ((*cells, "length", "class"), shares, "share of starts of a class"),
        "class_low": ((*cells, "length", "class"), intervals[..., 0], _SHARE + "from"),
        "class_high": ((*cells, "length", "class"), intervals[..., 1], _SHARE + "to"),
        "symmetric": (cells, symmetric, "share of starts of regular, symmetric orbits"),
        "wander": ((*cells, "length"), wander, _WANDER),
    }
    for i, (name, meaning) in enumerate(_MEANS.items()):
        for j, (end, text) in enumerate(_INTERVAL.items()):
            data[name + end] = cells, means[:, :, i, j], meaning + text
    defects = [
        [_defect(perturbed_map(ball, energy, name, level)) for level in levels] for name in MAPS
    ]
    data["defect"] = cells, defects, _DEFECT, RADIUS
    data |= _islands(ball, energy, levels, period, ring)
    data |= _pictures(ball, energy, np.asarray(starts, dtype=float), shown, impacts, drawn)
    return xr.Dataset(described(data), attrs={"shown": float(shown)})


_SHARE = "share of starts of a class, 95 % interval "
_INTERVAL = {"": "", "_low": ", 95 % interval from", "_high": ", 95 % interval to"}
_MEANS = {
    "exponent": "mean exponent of the chaotic orbits",
    "contraction": "mean logarithm of the determinant an impact, on chaotic orbits",
    "attraction": "mean logarithm of the determinant an impact, on spirals",
}
_WANDER = "standard deviation over chaotic orbits of an area's growth, a logarithm"
_DEFECT = "median of |S F S F z - z|, least over the reversors S tried"


def _disk(ball: Ball, energy: float, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return the points (a, b) in the unit disk as an array (2, n)."""
    width, height = half_axes(ball, energy)
    return np.stack([(np.asarray(x) - ball.section(energy)[0]) / width, np.asarray(y) / height])


def _begin(points: np.ndarray) -> np.ndarray:
    """Return rows of orbits for `propagate`, from points (2, n)."""
    rows = np.zeros((KEPT, points.shape[1]))
    rows[:2], rows[DA], rows[DB], rows[NEAREST] = points, 0.5, 0.5, math.inf
    rows[MIRROR_A : MIRROR_A + 2] = points[0], -points[1]
    return rows


def _growths(
    perturbed: PerturbedMap, points: np.ndarray, lengths: list[int], out: np.ndarray = _NONE
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return growths of tangent vectors and of areas (length, n), and which are symmetric."""
    windows = np.array([(at, n // 4) for n in lengths for at in (n // 4, n - n // 4)])
    grown, area = (np.zeros((len(windows), points.shape[1])) for _ in range(2))
    rows = _begin(points)
    propagate(rows, *perturbed, max(lengths), windows, grown, area, out)
    grown, area = grown / windows[:, 1:], area / windows[:, 1:]
    symmetric = rows[NEAREST] < _MIRRORED * _MIRRORED
    return grown[1::2] - grown[::2], area[1::2] - area[::2], symmetric


def classes(grown: np.ndarray, area: np.ndarray) -> np.ndarray:
    """Return the place in CLASSES of each orbit, from its growths; NaN counts as chaotic."""
    spiral = np.where(np.abs(area) < GROWTH_THRESHOLD, 0, 1)
    return np.where(grown < GROWTH_THRESHOLD, spiral, 2)


def _statistics(grown, area, symmetric, impacts, resampled):
    """Return shares (length, class), intervals, means (_MEANS, 3), symmetric share, and wander.

    The intervals are an array (length, class, 2). If a map keeps any smooth area, the growth of an
    area along an orbit is bounded, and so is its standard deviation, the wander (length).
    """
    kinds = classes(grown, area)
    counts = np.stack([np.sum(kinds == i, axis=1) for i in range(len(CLASSES))], axis=1)
    total = kinds.shape[1]
    intervals = np.array([[_wilson(int(n), total) for n in row] for row in counts])
    growth, contraction = (sums[-1] / (impacts - impacts // 2) for sums in (grown, area))
    means = [
        _interval(rate, kinds[-1] == kind, resampled)
        for rate, kind in ((growth, 2), (contraction, 2), (contraction, 1))
    ]
    wander = np.full(len(kinds), math.nan)
    if np.sum(kinds[-1] == 2) >= max(total // _FEW, 1):
        wander = np.std(area[:, kinds[-1] == 2], axis=1)
    return counts / total, intervals, means, np.mean(symmetric & (kinds[-1] == 0)), wander


def _wilson(count: int, total: int) -> tuple[float, float]:
    """Return Wilson's 95 % interval (1927) of the share count/total."""
    square = _Z95 * _Z95
    middle, scale = count + 0.5 * square, total + square
    reach = _Z95 * math.sqrt(count * (total - count) / total + 0.25 * square)
    return max(0.0, (middle - reach) / scale), min(1.0, (middle + reach) / scale)


def _interval(values, chosen, resampled) -> tuple[float, float, float]:
    """Return the mean of the chosen values, and its bootstrap interval; NaN if they are few."""
    chosen = chosen & np.isfinite(values)
    if np.sum(chosen) < max(2, chosen.size // _FEW):
        return math.nan, math.nan, math.nan
    picked = np.where(chosen, values, 0.0)
    counts = np.maximum(np.sum(chosen[resampled], axis=1), 1)
    drawn = np.sort(np.sum(picked[resampled], axis=1) / counts)
    cut = len(drawn) // 40
    mean = np.sum(picked) / np.sum(chosen)
    return mean, drawn[cut], drawn[len(drawn) - 1 - cut]


def images(perturbed: PerturbedMap, points: np.ndarray, impacts: int = 1) -> np.ndarray:
    """Return the images of points (2, n) after some impacts of a perturbed map."""
    return _propagated(perturbed, _begin(points), impacts)[:2]


def _propagated(perturbed: PerturbedMap, rows: np.ndarray, impacts: int) -> np.ndarray:
    """Propagate rows of orbits in place without normalizing vectors, and return them."""
    none = np.empty((0, rows.shape[1]))
    propagate(rows, *perturbed, impacts, np.empty((0, 2), dtype=np.int64), none, none, _NONE)
    return rows


@jit
def _applied(row, points):
    """Return the images of points (2, n) under a change."""
    out = np.empty_like(points)
    for i in range(points.shape[1]):
        image = apply(row, points[0, i], points[1, i])
        out[0, i], out[1, i] = image[0], image[1]
    return out


def _defect(perturbed: PerturbedMap) -> float:
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
                image = _combined(mirror, images(perturbed, image))
                image = image if after is None else _applied(after, image)
            off = image - points
            distance = np.sort(np.sqrt(off[0] * off[0] + off[1] * off[1]))
            least = min(least, float(distance[_PROBES // 2]))
    return least


def _combined(matrix: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Return matrix times points (2, n), without BLAS."""
    return matrix[:, 0, None] * points[0] + matrix[:, 1, None] * points[1]


def _islands(ball, energy, levels, period, resampled) -> dict:
    """Continue the fixed point and the elliptic orbit of a period, and measure their spirals."""
    periods = (1, period)
    table = np.full((len(MAPS), len(levels), 2, 7), math.nan)
    for column, steps in enumerate(periods):
        try:
            orbit = of_type(symmetric_orbits(ball, energy, steps), "elliptic")
        except NoOrbitError:
            continue
        x, y = chart(ball.k, *states_of(orbit))
        start = _disk(ball, energy, x[:1], y[:1])
        for row, name in enumerate(MAPS):
            point, before = start, 0.0
            for at, level in enumerate(levels):
                for i in range(1, _STEPS + 1):
                    here = before + (level - before) * i / _STEPS
                    perturbed = perturbed_map(ball, energy, name, here)
                    point = _closed(perturbed, point, steps)
                before = level
                if np.isnan(point).any():
                    break
                jacobian = _jacobian(perturbed, point, steps)[1]
                table[row, at, column] = (
                    *point[:, 0],
                    _determinant(jacobian),
                    jacobian[0, 0] + jacobian[1, 1],
                    *_rate(perturbed, point, jacobian, steps, resampled),
                )
    dims = ("map", "strength", "island")
    names = {
        "island_a": ("a of a point of the orbit", RADIUS),
        "island_b": ("b of that point", RADIUS),
        "island_determinant": ("determinant of the Jacobian over one period",),
        "island_trace": ("trace of the Jacobian over one period",),
        "rate": ("growth rate an impact of the distance from it",),
        "rate_low": ("growth rate of the distance, 95 % interval from",),
        "rate_high": ("growth rate of the distance, 95 % interval to",),
    }
    data = {name: (dims, table[..., i], *text) for i, (name, text) in enumerate(names.items())}
    return {"island": ("island", np.array(periods), "period of the continued orbit")} | data


def _jacobian(perturbed: PerturbedMap, point: np.ndarray, steps: int):
    """Return the image (2, 1) of a point under some impacts, and the Jacobian (2, 2)."""
    rows = _begin(np.repeat(point, 2, axis=1))
    rows[DA], rows[DB] = (1.0, 0.0), (0.0, 1.0)
    _propagated(perturbed, rows, steps)
    return rows[:2, :1], rows[[DA, DB]]


def _determinant(matrix: np.ndarray) -> float:
    return matrix[0, 0] * matrix[1, 1] - matrix[0, 1] * matrix[1, 0]


def _closed(perturbed: PerturbedMap, point: np.ndarray, steps: int) -> np.ndarray:
    """Return the periodic point next to a point (2, 1) by Newton's method; NaN if there is none."""
    start = point
    for _ in range(_NEWTON):
        image, jacobian = _jacobian(perturbed, point, steps)
        off = image - point
        if not np.max(np.abs(off)) > _CLOSED:
            return point
        slope = jacobian - np.array([[1.0, 0.0], [0.0, 1.0]])
        scale = _determinant(slope)
        inverse = np.array([[slope[1, 1], -slope[0, 1]], [-slope[1, 0], slope[0, 0]]]) / scale
        point = point - _combined(inverse, off)
        if not np.max(np.abs(point - start)) < _NEAR:
            break
    return np.full((2, 1), math.nan)


def _rate(perturbed, point, jacobian, steps, resampled) -> tuple[float, float, float]:
    """Return the growth rate of the distance from an elliptic point or a spiral, with its interval.

    The distance is the root of the quadratic form that a multiple of the Jacobian keeps.
    """
    trace = jacobian[0, 0] + jacobian[1, 1]
    if not trace * trace < 4.0 * _determinant(jacobian):
        return math.nan, math.nan, math.nan
    sines = np.array([sincos(2.0 * math.pi * i / _RING) for i in range(_RING)]).T
    out = np.empty((2, _RING, _RING_IMPACTS))
    windows, sums = np.array([[0, 1]]), np.zeros((2, 1, _RING))
    ring = _begin(point + _DISTANCE * sines[::-1])
    propagate(ring, *perturbed, _RING_IMPACTS, windows, *sums, out)
    a, b = out[:, :, steps - 1 :: steps] - point[:, :, None]
    form = jacobian[1, 0] * a * a + (jacobian[1, 1] - jacobian[0, 0]) * a * b
    size = 0.5 * _logs(np.abs(form - jacobian[0, 1] * b * b))
    quarter = size.shape[1] // 4
    late, early = size[:, -quarter:], size[:, quarter : 2 * quarter]
    apart = steps * (size.shape[1] - 2 * quarter)
    rates = (late - early).sum(axis=1) / (quarter * apart)
    return _interval(rates, np.ones(_RING, bool), resampled)


@jit
def _logs(values):
    """Return the logarithms of an array."""
    out = np.empty(values.shape)
    for i in range(values.shape[0]):
        for j in range(values.shape[1]):
            out[i, j] = log(values[i, j])
    return out


def _pictures(ball, energy, starts, shown, impacts, drawn) -> dict:
    """Return orbits of P and of each map at one strength, with their classes."""
    points = np.stack([starts, np.zeros(starts.size)])
    kept, kinds = [], []
    for name, strength in ((next(iter(MAPS)), 0.0), *((name, shown) for name in MAPS)):
        perturbed = perturbed_map(ball, energy, name, strength)
        out = np.empty((2, starts.size, impacts))
        grown, area, _ = _growths(perturbed, points, [impacts], out)
        kept.append(out[:, :, :drawn])
        kinds.append(classes(grown[0], area[0]))
    dims = ("panel", "start", "impact")
    a, b = np.stack(kept, axis=1)
    return {
        "panel": ("panel", ["none", *MAPS], "the impact map, and the perturbed maps"),
        "start": ("start", starts, "start on y = 0, in section radii", RADIUS),
        "a": (dims, a, "a after each impact", RADIUS),
        "b": (dims, b, "b after each impact", RADIUS),
        "kind": (("panel", "start"), np.array(kinds), "class of the orbit, its place in `class`"),
    }
