"""The method of inflections: between two zeros of f'' the gap is convex or concave.

The zeros are known in closed form, and there P = -g and Q = +-r = +-sqrt(x^2 + c^2 - g^2), so that
f = x + b t + g t^2/2 + g and f' = b + g t + Q need no sine. Let f < 0 or t = 0 at a piece's start.

- A convex piece with f < 0 at its end has no root, since f lies below the chord. With f >= 0 there
  it has one, since f rises from where it first meets zero.
- A concave piece with f >= 0 at its end has one root, for the same reason backwards.
- On a concave piece with f < 0 at its end, f lies below the tangents at both ends. It has no root
  if f' <= 0 at its beginning, f' >= 0 at its end, or the tangents meet below zero. Otherwise
  Newton's method from the left cannot pass the first root, since each tangent lies above f.

First step, first condition for the end, landing and impact-free time are those of the march. A
wrong sign of f can only make the method pass or report a touch within rounding errors. Angles are
computed from + - * / alone, as sine and cosine are.
"""

import math

from pseudorigid.kernel.arithmetic import WIDE, quadrant
from pseudorigid.kernel.compiled import jit
from pseudorigid.kernel.flight import (
    amplitude_bound,
    first_step,
    gap,
    impact_free_time,
    rises_to_its_root,
    rotated,
    series,
)

from .landing import Impact, land

# No inflection is looked for if the first step all but reaches the root, or if the march would land
# from there.
SIMPLE, BEST = 0.0, 1.0
_TURN = 2.0 * math.pi
# Tangents of pi/16, pi/8 and 3 pi/16.
_T1, _T2, _T3 = 0.19891236737965801, 0.41421356237309503, 0.66817863791929891
# Minimax polynomial for (atan r - r)/r^3 in r^2, |r| <= tan(pi/16), with an error of 1e-17 of r.
_ARC = tuple(float.fromhex(digits) for digits in (
    "-0x1.55555555553e3p-2", "0x1.9999999924639p-3", "-0x1.249248c02b3e0p-3",
    "0x1.c71c201e1bb7ep-4", "-0x1.744b48c8c966ep-4", "0x1.38ee6fbeee8ffp-4",
    "-0x1.dc95056978fe9p-5",
))  # fmt: skip
_SLACK = 1e-17  # relative error of a first step that is the root, as in the march


@jit
def angle(y: float, x: float) -> float:
    """Return the angle of the point (x, y) from the x-axis, 0 to 2 pi, within 2 ulp."""
    steep = abs(y) > abs(x)
    near = abs(x) if steep else abs(y)
    far = abs(y) if steep else abs(x)
    first, second = near < _T1 * far, near < _T3 * far  # of three sectors
    tangent = 0.0 if first else _T2 if second else 1.0
    base = 0.0 if first else 0.125 * math.pi if second else 0.25 * math.pi
    r = (near - tangent * far) / (far + tangent * near)
    z = r * r
    z2 = z * z
    a, b, c, d, e, f, last = _ARC
    tail = (a + z * b) + z2 * ((c + z * d) + z2 * ((e + z * f) + z2 * last))
    turn = base + (r + r * z * tail)
    turn = 0.5 * math.pi - turn if steep else turn
    turn = math.pi - turn if x < 0.0 else turn
    return _TURN - turn if y < 0.0 else turn


@jit
def first_inflection(x: float, c: float, g: float, r: float, convex: bool) -> float:
    """Return the first zero of f'', at which a convex or concave piece from t = 0 ends.

    The point (P, Q) turns from (x, c) to (-g, r) or (-g, -r), where r^2 = x^2 + c^2 - g^2. Near
    x = -g its sine is a product with g + x, so that it has the right sign.
    """
    e = c if convex else -c
    if e > 0.0:
        sine = abs(g + x) * (e + x * (x - g) / (r + e))
    else:
        sine = r * x + g * e if convex else -r * x - g * e
    return angle(sine, r * e - g * x)


@jit
def first_impact(x: float, b: float, c: float, s: float, g: float, care: float) -> Impact:
    """Return tau, P and Q at the first impact, sines and cosines, and inverse functions."""
    s = max(s, 0.0)
    amplitude = amplitude_bound(x, c)
    bend = g + x
    start = first_step(x, c, s, g, amplitude)
    if start == 0.0 or (bend > 0.0 and amplitude * start <= _SLACK * bend and start < WIDE):
        p, q = rotated(x, c, start)
        return start, p, q, 0, 0
    rise, rate, free = impact_free_time(x, b, g, amplitude)
    if start < free and start * rate >= rise:
        start = free
    square = (x - g) * bend + c * c  # of Q at inflections, if there are any
    convex = bend > 0.0 or (bend == 0.0 and c <= 0.0)
    # f < 0 at t, or t = 0; no impact happens before t.
    t, f, df, ddf, p, q, count, angles = 0.0, 0.0, -s, bend, x, c, 0, 0
    if care == BEST or convex or not square > 0.0:
        t = start
        f, df, ddf, p, q = gap(t, x, b, c, s, g, quadrant(t))
        count = 1
        is_sure = rises_to_its_root(-f, df, ddf, q, g, amplitude)
        if care == SIMPLE and is_sure:
            _, _, is_sure = series(f, df, ddf, p, q, t, amplitude)
        if is_sure or not (square > 0.0 and f < 0.0):
            low = t if f < 0.0 else 0.0
            return *land(
                low, math.inf, t, f, df, ddf, p, q, x, b, c, s, g, amplitude, count
            ), angles
    r = math.sqrt(square)
    z = first_inflection(x, c, g, r, convex)
    angles += 1
    concave_length = 0.0
    while True:
        if z < free and z * rate >= rise:
            z += _TURN * math.floor((free - z) / _TURN)
        if z > t:  # look at the piece from t to z
            if z < 0.25 * math.pi:  # where the terms cancel
                fz, dz, ddz, pz, qz = gap(z, x, b, c, s, g, quadrant(z))
                count += 1
            else:
                ddz, pz, qz = 0.0, -g, r if convex else -r
                fz, dz = x + z * (b + 0.5 * g * z) + g, b + g * z + qz
            if fz >= 0.0:
                if df <= 0.0 or (dz > 0.0 and fz * df < -f * dz):  # the end is nearer to the root
                    return *land(
                        t, z, z, fz, dz, ddz, pz, qz, x, b, c, s, g, amplitude, count
                    ), angles
                return *land(t, z, t, f, df, ddf, p, q, x, b, c, s, g, amplitude, count), angles
            # Tangents at both ends of a concave piece bound the maximum of the gap.
            while not convex and dz < 0.0 < df:
                if f * (df - dz) + df * (fz - f - dz * (z - t)) < 0.0:
                    break
                after = t - f / df
                if df * df >= -2.0 * f * (amplitude - g) or after == t:
                    return *land(t, z, t, f, df, ddf, p, q, x, b, c, s, g, amplitude, count), angles
                if after >= z:
                    break
                low, t = t, after
                f, df, ddf, p, q = gap(t, x, b, c, s, g, quadrant(t))
                count += 1
                if not f < 0.0:  # by rounding
                    return *land(
                        low, t, t, f, df, ddf, p, q, x, b, c, s, g, amplitude, count
                    ), angles
            t, f, df, ddf, p, q = z, fz, dz, ddz, pz, qz
        if concave_length == 0.0:
            concave_length = 2.0 * angle(r, g)
            angles += 1
        convex = not convex
        z += _TURN - concave_length if convex else concave_length
