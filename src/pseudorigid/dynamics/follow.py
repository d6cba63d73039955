"""Many orbits of one ball: how fast neighbours part, and how often the orbit winds round a centre.

The one place where a sweep calls the compiled map. Lengths are in units of g R, so that g = 1.
"""

import math

from ..kernel import impact as kernel
from ..kernel.arithmetic import log
from ..kernel.compiled import jit

_EIGHTH = math.sqrt(2.0) - 1.0  # tan(pi/8)
# (atan t - t)/t^3 in z = t^2, Chebyshev on |t| <= tan(pi/8), error below 1e-14
_A0 = float.fromhex("-0x1.55555555553a3p-2")
_A1 = float.fromhex("0x1.99999998d12f0p-3")
_A2 = float.fromhex("-0x1.249248aa52bc5p-3")
_A3 = float.fromhex("0x1.c71c381ab56c6p-4")
_A4 = float.fromhex("-0x1.74563c795c0ffp-4")
_A5 = float.fromhex("0x1.3a9d83feefaedp-4")
_A6 = float.fromhex("-0x1.0c52a4b5af878p-4")
_A7 = float.fromhex("0x1.a769bd3353c1cp-5")
_A8 = float.fromhex("-0x1.be20c62f176ddp-6")


@jit
def angle(across, up):
    """The angle of the vector (across, up), in (-pi, pi], to 1e-14; 0 for the vector 0."""
    a, b = abs(across), abs(up)
    large = max(a, b)
    if not large > 0.0:
        return 0.0
    t = min(a, b) / large
    base = 0.0
    if t > _EIGHTH:
        t = (t - 1.0) / (t + 1.0)
        base = 0.25 * math.pi
    z = t * t
    z2 = z * z
    low = (_A0 + z * _A1) + z2 * (_A2 + z * _A3)
    high = (_A4 + z * _A5) + z2 * (_A6 + z * _A7) + (z2 * z2) * _A8
    turn = base + (t + t * z * (low + (z2 * z2) * high))
    if b > a:
        turn = 0.5 * math.pi - turn
    if across < 0.0:
        turn = math.pi - turn
    return -turn if up < 0.0 else turn


@jit
def follow(x, v, w, k, centre, expected, weight, growth, winding):
    """Follow the states x, v, w (n,), in units where g = 1, for as many impacts as `weight` has.

    `growth` (n,) becomes the Lyapunov exponent an impact: the logarithm of a tangent vector's
    length, averaged over the second and over the last quarter, their difference over the time
    between. Averages rid it of the wobble that an island's shape gives. NaN from an exactly
    grazing impact on, where the map has no derivative.

    `winding` (n,) becomes the number of turns an impact around the point x = `centre`, y = 0 of
    the chart, the mean of the turns between impacts with the weights `weight` (m,), whose sum is 1.
    A turn is taken within half a turn of `expected`.
    """
    head, low = kernel.transfer(k)
    round_y = 1.0 / math.sqrt(k * (1.0 + k))  # the section is a disk in x, round_y * y
    impacts = weight.size
    quarter = impacts // 4
    for i in range(x.size):
        a, b, c = x[i], v[i], w[i]
        dx, dv, dw = 0.0, k * c, -b  # along the energy surface
        grown = 0.0
        early, late = 0.0, 0.0
        turns = 0.0
        p, q = a - centre, round_y * (b - k * c)
        for j in range(impacts):
            a, b, c, _, sine, cosine, tau_x, tau_s, tau_c, _ = kernel.step_with_flight(
                a, b, c, k, 1.0, head, low, None
            )
            dx, dv, dw = kernel.tangent(
                dx, dv, dw, k, 1.0, head, low, a, c, sine, cosine, tau_x, tau_s, tau_c
            )
            size = (abs(dx) + abs(dv)) + abs(dw)
            if not 1e-50 < size < 1e50:
                grown += log(size)
                dx, dv, dw = dx / size, dv / size, dw / size
                size = 1.0
            if quarter <= j < 2 * quarter:
                early += grown + log(size)
            elif j >= impacts - quarter:
                late += grown + log(size)
            r, s = a - centre, round_y * (b - k * c)
            turn = angle(p * r + q * s, q * r - p * s) / (2.0 * math.pi)
            if turn < expected - 0.5:
                turn += 1.0
            elif turn > expected + 0.5:
                turn -= 1.0
            turns += weight[j] * turn
            p, q = r, s
        growth[i] = (late - early) / (quarter * (impacts - 2.0 * quarter))
        winding[i] = turns
