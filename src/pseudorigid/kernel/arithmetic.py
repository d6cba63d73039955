"""Sine, cosine and logarithm from + - * / alone, with the same bits on every machine.

The C library's sin, cos and log differ in the last bit between processors and versions, and a
chaotic orbit turns one bit into a difference of order one within about 130 impacts. The functions
here are within 0.8 ulp of the exact value: sine and cosine below 2^20 radians, the logarithm for
every finite argument.
"""

import math

import numpy as np

from .compiled import jit

# pi/2 in four parts. The first three have 33 bits, so that n * part is exact for |n| < 2**20.
_HALF_PI_1 = float.fromhex("0x1.921fb54400000p+0")
_HALF_PI_2 = float.fromhex("0x1.0b4611a600000p-34")
_HALF_PI_3 = float.fromhex("0x1.3198a2e000000p-69")
_HALF_PI_4 = float.fromhex("0x1.b839a252049c1p-104")
_TWO_OVER_PI = float.fromhex("0x1.45f306dc9c883p-1")
_ROUND = 1.5 * 2.0**52  # adding and subtracting this rounds to the nearest integer
_HALVE = 1.5 * 2.0**26  # adding and subtracting this keeps 26 bits of a number below 1
WIDE = 2.0**20  # radians; sine and cosine of larger angles are NaN

# Minimax polynomials for (sin r - r)/r^3 and (cos r - 1 + z/2)/z^2 in z = r^2 on |r| <= pi/4. The
# first coefficients are -1/6 and 1/24 rounded, which keeps the tails accurate for short flights.
_S0 = float.fromhex("-0x1.5555555555555p-3")
_S1 = float.fromhex("0x1.1111111110a05p-7")
_S2 = float.fromhex("-0x1.a01a019e1ec1ep-13")
_S3 = float.fromhex("0x1.71de3724190a8p-19")
_S4 = float.fromhex("-0x1.ae5fa34c1b1edp-26")
_S5 = float.fromhex("0x1.5dea46b8b8ebep-33")
_C0 = float.fromhex("0x1.5555555555555p-5")
_C1 = float.fromhex("-0x1.6c16c16c168d3p-10")
_C2 = float.fromhex("0x1.a01a019f3a18bp-16")
_C3 = float.fromhex("-0x1.27e4fa04fd240p-22")
_C4 = float.fromhex("0x1.1eeb59bb136b0p-29")
_C5 = float.fromhex("-0x1.9074bbdd55b66p-37")

# Polynomial for (2 atanh(s) - 2 s)/s^3 on the reduced range of log, and ln 2 in two parts, of which
# the first has 32 bits.
_L0 = float.fromhex("0x1.5555555555558p-1")
_L1 = float.fromhex("0x1.9999999995273p-2")
_L2 = float.fromhex("0x1.2492492dfd86cp-2")
_L3 = float.fromhex("0x1.c71c62d5e53e0p-3")
_L4 = float.fromhex("0x1.7462b91b8df65p-3")
_L5 = float.fromhex("0x1.39fdcceb4bb45p-3")
_L6 = float.fromhex("0x1.2b5f68a50d903p-3")
_LN2_HI = float.fromhex("0x1.62e42fee00000p-1")
_LN2_LO = float.fromhex("0x1.a39ef35793c76p-33")
_SQRT_HALF = float.fromhex("0x1.6a09e667f3bcdp-1")


@jit
def _reduce(t):
    """Return t - n pi/2 as a sum (r, low), and the nearest integer n as a float; |t| < 2**20."""
    n = (t * _TWO_OVER_PI + _ROUND) - _ROUND
    a = t - n * _HALF_PI_1
    w2 = n * _HALF_PI_2
    y = a - w2
    e = (a - y) - w2
    w3 = n * _HALF_PI_3
    r = y - w3
    low = (((y - r) - w3) + e) - n * _HALF_PI_4
    return r, low, n


@jit
def _kernel(r, low):
    """Return sin and cos of r + low, |r| <= pi/4, and the tails sin r - r and cos r - 1 + r^2/2."""
    z = r * r
    z2 = z * z
    z4 = z2 * z2
    sine_tail = r * z * (_S0 + (z * _S1 + (z2 * (_S2 + z * _S3) + z4 * (_S4 + z * _S5))))
    cosine_tail = z2 * ((_C0 + z * _C1) + z2 * (_C2 + z * _C3) + z4 * (_C4 + z * _C5))
    half = 0.5 * z
    w = 1.0 - half
    sine = r + (sine_tail + low * w)
    cosine = w + (((1.0 - w) - half) + (cosine_tail - r * low))
    return sine, cosine, sine_tail, cosine_tail


@jit
def narrow_quadrant(t):
    """Compute `quadrant` for |t| < WIDE without a branch."""
    r, low, n = _reduce(t)
    return *_kernel(r, low), n


@jit
def quadrant(t):
    """Return sin r, cos r, sin r - r, cos r - 1 + r^2/2 and n, for t = r + n pi/2, |r| <= pi/4.

    n is a float. All but n are NaN unless |t| < WIDE.
    """
    if abs(t) < WIDE:
        return narrow_quadrant(t)
    return math.nan, math.nan, math.nan, math.nan, 0.0


@jit
def quarter_turns(a, b, n):
    """Turn (a, b) by n right angles, to (-b, a) for n = 1, without a branch to mispredict."""
    turns = n - 4.0 * ((0.25 * n + _ROUND) - _ROUND)  # 0, 1, -2 or 2, -1
    first = b if abs(turns) == 1.0 else a
    second = a if turns * turns == 1.0 else b
    return (
        -first if abs(turns + 0.5) > 0.75 else first,
        -second if abs(turns - 0.5) > 0.75 else second,
    )


@jit
def sincos(t):
    """Return sine and cosine of an angle |t| < WIDE in radians, each within 0.8 ulp, else NaN.

    The argument is reduced as in Cody and Waite, Software Manual for the Elementary Functions
    (1980).
    """
    sine, cosine, _, _, n = quadrant(t)
    cosine, sine = quarter_turns(cosine, sine, n)
    return sine, cosine


@jit
def sincos_each(t):
    """Return sines and cosines of an array of angles (n,) in radians."""
    sine = np.empty(t.size)
    cosine = np.empty(t.size)
    for i in range(t.size):
        sine[i], cosine[i] = sincos(t[i])
    return sine, cosine


@jit
def _log(a, exponent):
    """Compute log(a 2**exponent) for a normal number a and a float exponent, without a branch."""
    bits = np.float64(a).view(np.int64)
    m = np.int64((bits & 0xFFFFFFFFFFFFF) | 0x3FE0000000000000).view(np.float64)
    n = np.int64((bits >> 52) | 0x4330000000000000).view(np.float64) - (2.0**52 + 1023.0)
    small = m < _SQRT_HALF
    m = m * 2.0 if small else m
    n = exponent + (n if small else n + 1.0)
    f = m - 1.0  # exact
    s = f / (2.0 + f)
    z = s * s
    z2 = z * z
    odd = z * ((_L0 + z * _L1) + z2 * ((_L2 + z * _L3) + z2 * ((_L4 + z * _L5) + z2 * _L6)))
    head = (f + _HALVE) - _HALVE  # f^2/2 = half + rest, where half is exact
    half = 0.5 * head * head
    rest = 0.5 * (f - head) * (f + head)
    odd = s * ((half + rest) + odd) - rest
    return n * _LN2_HI - ((half - (odd + n * _LN2_LO)) - f)


@jit
def narrow_log(a):
    """Compute `log` without a branch for a finite number from 2**-1022 up."""
    return _log(a, 0.0)


@jit
def log(a):
    """Return the natural logarithm within 0.8 ulp: -inf at 0, NaN below 0, inf at inf."""
    if not a > 0.0:
        return -math.inf if a == 0.0 else math.nan
    if a == math.inf:
        return a
    if a < 2.0**-1022:  # subnormal
        return _log(a * 2.0**54, -54.0)
    return _log(a, 0.0)
