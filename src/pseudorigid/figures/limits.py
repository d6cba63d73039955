"""Limits of axes: those of a window where a scene gives none, and whether they show anything."""

import math

import numpy as np


def of_window(low, high):
    """An axis for a window: its edges as limits, the shortest decimals near them as ticks."""
    for digits in range(1, 16):
        power = 10**digits
        ticks = [math.ceil(low * power) / power, math.floor(high * power) / power]
        if ticks[1] - ticks[0] >= 0.6 * (high - low):
            break
    return {"limits": [low, high], "ticks": ticks}


def refuse_empty(axes, data):
    """Raise ValueError, one line, where no row of `data` lies within the limits of `axes`."""
    inside = True
    for name, axis in axes.items():
        low, high = axis["limits"]
        values = data[name].values
        inside = inside & (values >= low) & (values <= high)
    if not np.any(inside):
        said = ", ".join(f"{name} {axis['limits']}" for name, axis in axes.items())
        raise ValueError(f"nothing lies within the limits of axes: {said}")
