"""Limits of axes: those of the data or of a window where a scene gives none, and whether they show
anything.
"""

import math
from fractions import Fraction
from functools import partial

import numpy as np

from ..canvas import style


def of_window(low, high):
    """An axis for a window: its edges as limits, the shortest decimals near them as ticks."""
    for digits in range(1, 16):
        power = 10**digits
        ticks = [math.ceil(low * power) / power, math.floor(high * power) / power]
        if ticks[1] - ticks[0] >= 0.6 * (high - low):
            break
    return {"limits": [low, high], "ticks": ticks}


def of_data(*values, margin=0.0, room=0.03, most=8):
    """An axis around all finite `values` (arrays): round limits, at most `most` steps of ticks.

    `room` is left between data and limits, as a part of the data's span. `margin` is the part of
    the axis at either end that stays without a tick: where axes meet, the labels of two would.
    """
    low = min(float(np.nanmin(part)) for part in values)
    high = max(float(np.nanmax(part)) for part in values)
    size = max(abs(low), abs(high))
    if not high - low > 1e-9 * size:  # one value, as far as a label can tell
        low, high = low - (size or 1.0), high + (size or 1.0)
    low, high = low - room * (high - low), high + room * (high - low)
    step = _step((high - low) / most)
    fine = step / 5  # limits are whole numbers of it
    low, high = _written(low) // fine, -(-_written(high) // fine)
    first, last = low + margin * (high - low), high - margin * (high - low)
    ticks = range(-int(-first // 5), int(last // 5) + 1)
    return {
        "limits": [float(low * fine), float(high * fine)],
        "ticks": [float(tick * step) for tick in ticks],
    }


def complete(scene, **axes):
    """The scene with an axis of each name: its own, or what the function of that name returns."""
    own = scene.get("axes", {})
    return scene | {
        "axes": {name: own[name] if name in own else make() for name, make in axes.items()}
    }


def complete_box(scene, *datasets):
    """The scene with the axes of a box, whose corners meet: its own or around the data."""
    data = {name: [dataset[name].values for dataset in datasets] for name in style.NAMES}
    axes = {name: partial(of_data, *data[name], margin=0.08, most=6) for name in data}
    return complete(scene, **axes)


def inside(limits, values):
    """Where every one of `values`, arrays of one shape, is within its limits (low, high)."""
    pairs = zip(limits, values, strict=True)
    return np.logical_and.reduce([(low <= part) & (part <= high) for (low, high), part in pairs])


def _step(least):
    """The smallest of 1, 2, 5 times a power of ten that is at least `least`, exactly."""
    power = Fraction(10) ** int(f"{least:e}".partition("e")[2])
    return next(digit * power for digit in (1, 2, 5, 10, 20) if float(digit * power) >= least)


def _written(value):
    """The decimal that a double is written as: 0.3 is three tenths, not a little less."""
    return Fraction(repr(value))


def refuse_empty(axes, data):
    """Raise ValueError, one line, where no row of `data` lies within the limits of `axes`."""
    limits = [axis["limits"] for axis in axes.values()]
    if not np.any(inside(limits, [data[name].values for name in axes])):
        said = ", ".join(f"{name} {axis['limits']}" for name, axis in axes.items())
        raise ValueError(f"nothing lies within the limits of axes: {said}")
