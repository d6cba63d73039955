"""Limits of axes where a scene gives none, of data or a window, and whether they show anything.

Matplotlib's own locators take logarithms of the C library; these are exact.
"""

import math
from fractions import Fraction
from functools import partial

import numpy as np

from ..canvas import style

# How many times as large as the data limits may be: of a box or window, of a line's abscissa (a run
# may be a short try-out of a longer one), of its ordinate (where it may be flat); and at least.
_SPOT, _LINE, _FLAT, _LEAST = 1e3, 1e4, 1e6, 1e-12


def of_window(low, high):
    """An axis for a window: its edges as limits, the shortest decimals near them as ticks."""
    for digits in range(1, 16):
        power = 10**digits
        ticks = [math.ceil(low * power) / power, math.floor(high * power) / power]
        if ticks[1] - ticks[0] >= 0.6 * (high - low):
            break
    return {"limits": [low, high], "ticks": ticks}


def of_data(*values, margin=0.0, room=0.03, most=8):
    """An axis with round limits around data.

    Parameters
    ----------
    *values : array_like
        Their NaN do not count.
    margin : float
        The part of the axis at either end that stays without a tick: where axes meet, the labels
        of two would too.
    room : float
        What is left between data and limits, as a part of the data's span.
    most : int
        Steps between ticks at the most.

    Returns
    -------
    dict
        limits and ticks, the doubles nearest to decimals.
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
    """The scene with an axis of each name: its own, or what the function of that name makes."""
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


def refuse_empty(axes, values, joined=False):
    """Refuse axes that show nothing of the data, or no more of it than a spot.

    Parameters
    ----------
    axes : mapping
        Name -> axis, with limits; may have more names than `values`.
    values : mapping
        Name -> ndarray, all of one shape.
    joined : bool
        Whether values that follow each other along the first dimension are joined by lines. Then
        the first name is the abscissa, and along the others the data may be flat.

    Raises
    ------
    ValueError
        One line with the axis, its limits, and where the data lie.
    """
    shown = []
    for name, value in values.items():
        low, high = axes[name]["limits"]
        known = value[np.isfinite(value)]
        if known.size == 0:
            raise ValueError(f"axes.{name}: there is nothing to be drawn")
        least, most = float(known.min()), float(known.max())
        size = max(abs(least), abs(most))
        widest = (_FLAT if shown else _LINE) if joined else _SPOT
        half = 0.5 * high - 0.5 * low  # the whole may overflow
        why = {
            "all data lie beyond them": high < least or most < low,
            "too wide to show the data": half > 0.5 * widest * size > 0.0,
            "too narrow to show the data": half < _LEAST * size,
        }
        for words in (words for words, wrong in why.items() if wrong):
            where = f"the data lie from {least:.6g} to {most:.6g}"
            raise ValueError(f"axes.{name}.limits [{low}, {high}]: {words}: {where}")
        ends = (value[:-1], value[1:]) if joined else (value, value)
        shown.append((np.minimum(*ends) <= high) & (np.maximum(*ends) >= low))
    if not np.logical_and.reduce(shown).any():
        said = ", ".join(f"axes.{name}.limits {axes[name]['limits']}" for name in values)
        raise ValueError(f"nothing lies within {said} at once")
