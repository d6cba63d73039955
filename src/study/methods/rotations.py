"""Methods that turn P and Q by known angles, and so need fewer sines and cosines.

After a further time h, (P, Q) is turned by the angle h: four products, where sin h and cos h are
known. The scan takes steps of constant length, with the first step, end, landing and impact-free
time of the certified march; no argument shows that it finds the first root. The march by table
takes the march's steps, cut down to multiples of 1/8 where they are longer than that. A shorter
step cannot pass the first root either, so that the march's proof holds.
"""

import math

import numpy as np

from pseudorigid.kernel.arithmetic import WIDE, quadrant, sincos_each
from pseudorigid.kernel.compiled import jit
from pseudorigid.kernel.flight import (
    amplitude_bound,
    first_step,
    gap,
    impact_free_time,
    longest_stride,
    rises_to_its_root,
    rotated,
)
from pseudorigid.kernel.impact import MOST_SCAN_STEPS

from .careful_scan import maximum
from .landing import Impact, land

SCAN, MARCH = 0.0, 1.0
_SLACK = 1e-17  # relative error of a first step that is the root, as in the march
_PARTS, _MOST = 8, 64  # steps of the table in a time unit, and in the longest step
_SINES, _COSINES = (
    tuple(part.tolist()) for part in sincos_each(np.arange(_MOST + 1) / float(_PARTS))
)
_SHORT = 0.8  # up to this time the terms of the gap cancel, so that it needs the tails of a sine


@jit
def first_impact(x: float, b: float, c: float, s: float, g: float, way: float) -> Impact:
    """Return tau, P and Q at the next impact, sines and cosines, and rotations."""
    s = max(s, 0.0)
    amplitude = amplitude_bound(x, c)
    t = first_step(x, c, s, g, amplitude)
    if t == 0.0 or (g + x > 0.0 and amplitude * t <= _SLACK * (g + x) and t < WIDE):
        p, q = rotated(x, c, t)
        return t, p, q, 0, 0
    rise, rate, free = impact_free_time(x, b, g, amplitude)
    if t < free and t * rate >= rise:
        t = free
    f, df, ddf, p, q = gap(t, x, b, c, s, g, quadrant(t))
    low, count, turns = 0.0, 1, 0
    while f < 0.0 and not rises_to_its_root(-f, df, ddf, q, g, amplitude):
        step, parts = 0.0, _PARTS
        if way == MARCH:
            step = longest_stride(-f, df, ddf, q, g, amplitude)
            parts = min(int(_PARTS * step), _MOST) if t > _SHORT else 0
            if parts == 0 and t + step == t:
                return t, p, q, count, turns
        low, rising = t, df > 0.0
        if parts == 0:
            t += step
            if t < free and t * rate >= rise:
                t = free
            f, df, ddf, p, q = gap(t, x, b, c, s, g, quadrant(t))
            count += 1
            continue
        t += parts / _PARTS
        p, q = p * _COSINES[parts] - q * _SINES[parts], p * _SINES[parts] + q * _COSINES[parts]
        f, df, ddf = (x + t * (b + 0.5 * g * t)) - p, b + g * t + q, g + p
        turns += 1
        if way == SCAN and rising and f < 0.0 and not df > 0.0:  # it may have risen above 0
            top, f_top, df_top, ddf_top, looks = maximum(low, t, df, ddf, x, b, c, s, g)
            count += looks
            if f_top >= 0.0:
                t, f, df, ddf = top, f_top, df_top, ddf_top
                p, q = ddf - g, df - (b + g * t)
        if turns > MOST_SCAN_STEPS:
            return math.nan, p, q, count, turns
    low, high = (t, math.inf) if f < 0.0 else (low, t)
    return *land(low, high, t, f, df, ddf, p, q, x, b, c, s, g, amplitude, count), turns
