"""Axis limits and ticks from data, what limits hide, and refusal of those that show nothing.

Matplotlib's locators use the C library's logarithm, whose last bit varies between machines. Here
fractions, IEEE arithmetic and compiled logarithms decide, with the same bits everywhere.
"""

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from fractions import Fraction
from functools import partial
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from ..canvas import style
from .panel import Axis, log10
from .view import OccludingEllipsoid

# Limits are refused if they are wider than the data's largest modulus by these factors. The
# abscissa of a line may be wide because a run may be a short trial of a longer one, and its
# ordinate because it may be flat.
_WIDEST_DOTS, _WIDEST_ABSCISSA, _WIDEST_ORDINATE = 1e3, 1e4, 1e6
_NARROWEST = 1e-12  # of that modulus
# What lies beyond limits by less than a part of their distance is shown: a pixel of most axes. The
# surface of Figure 8 touches xdot = 0.1, but where limits cut off a part h of a surface's height,
# they leave a hole of about 2 sqrt(h): one pixel would leave 60.
_PIXEL, _ROUNDING = 1e-3, 1e-9
_LONGEST_LABEL = 7  # characters of a tick label that fit at the left of a chart
_FEW_DECADES = 0.7  # decades in which two of 1, 2, 5 times powers of ten lie
_MOST_DECADES = 9  # decades with a tick each; beyond that every second, third, ... has one


def of_data(
    *values: ArrayLike, margin: float = 0.0, room: float = 0.03, most: int = 8
) -> dict[str, list[float]]:
    """Return an axis, limits and ticks, with round limits around arrays that may have NaN.

    `margin` is the part of the axis without ticks at either end, for axes that meet at a corner;
    `room` is the space between data and limits in spans of the data, and `most` the largest number
    of steps.
    """
    low = min(float(np.nanmin(part)) for part in values)
    high = max(float(np.nanmax(part)) for part in values)
    size = max(abs(low), abs(high))
    if not high - low > 1e-9 * size:  # labels could not tell the values apart
        low, high = low - (size or 1.0), high + (size or 1.0)
    low, high = low - room * (high - low), high + room * (high - low)
    step = _step((high - low) / most)
    fine = step / 5  # the unit of limits; every fifth one is a tick
    start, end = _as_written(low) // fine, -(-_as_written(high) // fine)
    first, last = start + margin * (end - start), end - margin * (end - start)
    ticks = range(-int(-first // 5), int(last // 5) + 1)
    return {
        "limits": [float(start * fine), float(end * fine)],
        "ticks": [float(tick * step) for tick in ticks],
    }


def linear(low: float, high: float, count: float, name: str = "") -> Axis:
    """Return an axis with round ticks. If labels are long, their common part moves to the name."""
    low, high = float(low), float(high)
    values = ticks(low, high, count) if count else []
    labels = [style.number(value) for value in values]
    if all(len(label) <= _LONGEST_LABEL and "e" not in label for label in labels):
        return Axis((low, high), values, name)
    power = int(f"{(high - low) / count:e}".partition("e")[2])
    unit = Fraction(10) ** power
    base = 1000 * unit * (_as_written(values[0]) // (1000 * unit))
    labels = [style.number(float((_as_written(value) - base) / unit)) for value in values]
    if base:
        name = f"({name} less {style.number(float(base))})"
    return Axis((low, high), values, rf"{name} $/\;10^{{{power}}}$", labels=labels)


def around(
    values: ArrayLike, room: float, count: float, name: str = "", above: float | None = None
) -> Axis:
    """Return an axis with round ticks around values that may have NaN.

    It is wider by `room` of their span at either end, or by `above` of it at the upper one.
    """
    low, high = float(np.nanmin(values)), float(np.nanmax(values))
    if not high > low:
        low, high = low - 0.01, high + 0.01
    span = high - low
    return linear(low - room * span, high + (room if above is None else above) * span, count, name)


def ticks(low: float, high: float, count: float) -> list[float]:
    """Return about `count` round numbers from low to high, more if they would be fewer than two."""
    step = _step((high - low) / count * (1.0 + 1e-9))
    first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
    if first >= last:
        return ticks(low, high, 2 * count)
    return [float(i * step) for i in range(first, last + 1)]


def decades(limits: Sequence[float], name: str = "") -> Axis:
    """Return a logarithmic axis; `limits` are the logarithms to base ten of its ends.

    Ticks are at every n-th whole power of ten, or, if at most one of these lies between the limits,
    at multiples of the powers.
    """
    low, high = limits
    if math.floor(high + 1e-9) <= math.ceil(low - 1e-9):
        digits = (1, 2, 5) if high - low > _FEW_DECADES else (1, 1.5, 2, 3, 4, 5, 6, 8)
        powers = range(math.floor(low), math.floor(high) + 1)
        values = [
            float(Fraction(10) ** power * Fraction(digit)) for power in powers for digit in digits
        ]
        at = {float(log10(value)[0]): style.number(value) for value in values}
        at = {log: label for log, label in at.items() if low <= log <= high}
        return Axis(limits, list(at), name, decades=True, labels=list(at.values()))
    every = 1 + int(high - low) // _MOST_DECADES
    first = math.ceil(low / every - 1e-9) * every
    return Axis(limits, range(first, math.floor(high + 1e-9) + 1, every), name, decades=True)


def complete(scene: dict[str, Any], **axes: Callable[[], Any]) -> dict[str, Any]:
    """Return the scene with all named axes, calling `axes[name]()` for those that it lacks.

    A caller that wants to know the axes gives an empty mapping scene["completed"].
    """
    own = scene.get("axes", {})
    whole = {name: own[name] if name in own else make() for name, make in axes.items()}
    scene.get("completed", {}).update(whole)
    return scene | {"axes": whole}


def complete_box(scene: dict[str, Any], *datasets: xr.Dataset) -> dict[str, Any]:
    """Return the scene with the axes of a box that holds the energy surface.

    Axes that the scene lacks hold the datasets and the surface. Where limits of the scene cut the
    surface, the box grows: an open surface shows its inside, and looks like another one. Raises
    ValueError if the axes show nothing of the last dataset.
    """
    data = {name: [dataset[name].values for dataset in datasets] for name in style.NAMES}
    ends = dict(zip(style.NAMES, _surface(scene).ends(), strict=True))
    own = {name: partial(of_data, *data[name], ends[name], margin=0.08, most=6) for name in data}
    axes = complete(scene, **own)["axes"]
    refuse_empty(axes, {name: parts[-1] for name, parts in data.items()})
    return complete(scene | {"axes": axes | _around_surface(scene, axes)}, **own)


def cuts(scene: dict[str, Any], what: str, dataset: xr.Dataset) -> Iterator[str]:
    """Yield a line for each axis of a scene whose limits cut the energy surface.

    `what` are the points of the dataset, of which it gives the share beyond the limits.
    """
    axes = scene.get("axes", {})
    for name, axis in _around_surface(scene, axes).items():
        limits, points = axes[name]["limits"], dataset[name].values
        share = _share_beyond(limits, points)
        also = f", and hide {share} of {np.isfinite(points).sum():,} {what}" if share else ""
        cut = f"axes.{name}.limits {limits} cut the energy surface at E = {scene['energy']:g}{also}"
        yield f"{cut}: drawn with {axis['limits']}: write these, or leave axes.{name} out"


def hides(scene: dict[str, Any], what: str, **values: np.ndarray) -> Iterator[str]:
    """Yield a line for each axis of a scene whose limits hide some of its values, named `what`."""
    axes = scene.get("axes", {})
    for name in (name for name in values if name in axes):
        limits = axes[name]["limits"]
        if share := _share_beyond(limits, values[name]):
            wide = of_data(limits, values[name], room=0.0)["limits"]
            advice = f"widen them to {wide}, or leave axes.{name} out"
            yield f"axes.{name}.limits {limits} hide {share} of {what}: {advice}"


def _share_beyond(limits: Sequence[float], values: np.ndarray, shown: float = _PIXEL) -> str:
    """Return the percentage of values beyond limits as text, empty for none."""
    low, high = limits
    excess = np.maximum(low - values, values - high)  # NaN where there is no value
    if not np.any(excess > shown * (high - low)):
        return ""
    return f"{100 * np.sum(excess > 0) / np.sum(~np.isnan(excess)):.3g} %"


def _surface(scene: dict[str, Any]) -> OccludingEllipsoid:
    """Return the energy surface of a scene."""
    return OccludingEllipsoid(**scene["ball"], energy=scene["energy"])


def _around_surface(scene: dict[str, Any], axes: dict[str, Any]) -> dict[str, Any]:
    """Return axes that hold the energy surface, for those of `axes` whose limits cut it."""
    return {
        name: of_data(pair, margin=0.08)
        for name, pair in zip(style.NAMES, _surface(scene).ends(), strict=True)
        if name in axes and _share_beyond(axes[name]["limits"], np.array(pair), _ROUNDING)
    }


def inside(limits: Iterable[Sequence[float]], values: Iterable[Any]) -> np.ndarray:
    """Return where every array of `values` is within its limits (low, high)."""
    pairs = zip(limits, values, strict=True)
    return np.all([(low <= part) & (part <= high) for (low, high), part in pairs], axis=0)


def _step(least: float) -> Fraction:
    """Return the smallest of 1, 2, 5 times a power of ten that is at least `least`, exactly."""
    power = Fraction(10) ** int(f"{least:e}".partition("e")[2])
    return next(digit * power for digit in (1, 2, 5, 10, 20) if float(digit * power) >= least)


def _as_written(value: float) -> Fraction:
    """Return the decimal that a double is written as: 0.3 is three tenths."""
    return Fraction(repr(value))


def refuse_empty(axes: dict[str, Any], values: dict[str, Any], joined: bool = False) -> None:
    """Raise ValueError, in one line, if axes show none of the data or are too wide or too narrow.

    `values` has an array, all of one shape, for each name. If lines join consecutive values
    (`joined`), the first name is the abscissa, and the data may be flat along the others.
    """
    visible: list[np.ndarray] = []
    abscissa = next(iter(values))
    for name, value in values.items():
        low, high = axes[name]["limits"]
        known = value[np.isfinite(value)]
        if known.size == 0:
            raise ValueError(f"axes.{name}: there is nothing to be drawn")
        least, most = float(known.min()), float(known.max())
        size = max(abs(least), abs(most))
        widest = _WIDEST_DOTS
        if joined:
            widest = _WIDEST_ABSCISSA if name == abscissa else _WIDEST_ORDINATE
        half = 0.5 * high - 0.5 * low  # the whole may overflow
        reasons = {
            "all data lie beyond them": high < least or most < low,
            "too wide to show the data": half > 0.5 * widest * size > 0.0,
            "too narrow to show the data": half < _NARROWEST * size,
        }
        for reason in (reason for reason, holds in reasons.items() if holds):
            where = f"the data lie from {least:.6g} to {most:.6g}"
            raise ValueError(f"axes.{name}.limits [{low}, {high}]: {reason}: {where}")
        ends = (value[:-1], value[1:]) if joined else (value, value)
        visible.append((np.minimum(*ends) <= high) & (np.maximum(*ends) >= low))
    if not np.logical_and.reduce(visible).any():
        limits = ", ".join(f"axes.{name}.limits {axes[name]['limits']}" for name in values)
        raise ValueError(f"nothing lies within {limits} at once")
