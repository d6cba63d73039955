"""Errors of sincos and log against mpmath, and their frozen bits."""

import hashlib
import math

import mpmath
import numba
import numpy as np
import pytest
from mpmath import mpf

from pseudorigid.kernel import arithmetic

LARGEST_ERROR = 0.8  # ulp


@numba.njit
def log_each(a):
    out = np.empty_like(a)
    for i in range(a.size):
        out[i] = arithmetic.log(a[i])
    return out


def any_doubles(rng, count, top=0x7FE):
    """Draw positive doubles with uniformly distributed exponents."""
    bits = (rng.integers(0, top + 1, count) << 52) | rng.integers(0, 2**52, count)
    return bits.view(np.float64)


def neighbours(points, steps=2):
    """Return the doubles up to some steps away from each point."""
    bits = np.asarray(points, dtype=float).view(np.int64)
    return np.concatenate([(bits + i).view(np.float64) for i in range(-steps, steps + 1)])


@mpmath.workdps(60)
def angles(rng):
    quarters = [float(n * mpmath.pi / 4) for n in [*range(1, 400), *(2**n for n in range(9, 20))]]
    return np.concatenate(
        [
            rng.uniform(0, math.pi / 4, 3000), rng.uniform(0, 20, 5000),
            2.0 ** rng.uniform(-40, 20, 3000), any_doubles(rng, 3000, 1022 + 20),
            neighbours(quarters),
        ]
    )  # fmt: skip


def error_in_ulp(value, exact):
    return float(abs(mpf(float(value)) - exact) / math.ulp(float(exact)))


def test_sincos_against_mpmath():
    t = angles(np.random.default_rng(1))
    sines, cosines = arithmetic.sincos_each(t)
    assert np.array_equal(arithmetic.sincos_each(-t), (-sines, cosines))
    for a, sine, cosine in zip(t, sines, cosines, strict=True):
        with mpmath.workdps(40 + max(0, math.frexp(a)[1] // 3)):
            c, s = mpmath.cos_sin(mpf(float(a)))
        assert max(error_in_ulp(sine, s), error_in_ulp(cosine, c)) < LARGEST_ERROR, a


def test_log_against_mpmath():
    rng = np.random.default_rng(2)
    near_one = 1.0 + np.concatenate([[0.0], 2.0 ** rng.uniform(-52, 0, 3000)])
    a = np.concatenate(
        [
            rng.uniform(0.5, 2.0, 8000), near_one, 2.0 - near_one[1:], any_doubles(rng, 4000),
            neighbours(2.0 ** np.arange(-1022.0, 1024.0)),
            neighbours([math.sqrt(0.5), math.sqrt(2.0)], 20),
            [5e-324, 1e-310, 1.7976931348623157e308],
        ]
    )  # fmt: skip
    a = a[(a > 0) & np.isfinite(a)]
    for x, y in zip(a[a != 1.0], log_each(a[a != 1.0]), strict=True):
        with mpmath.workdps(40):
            assert error_in_ulp(y, mpmath.log(mpf(float(x)))) < LARGEST_ERROR, x


def test_special_values():
    for t in (math.nan, math.inf, -math.inf, arithmetic.WIDE, -1e7, 1e300):
        assert all(math.isnan(a) for a in arithmetic.sincos(t))
    assert arithmetic.sincos(0.0) == (0.0, 1.0)
    for t in (5e-324, 1e-310, 1e-20):
        assert arithmetic.sincos(t) == (t, 1.0)
    assert arithmetic.log(0.0) == arithmetic.log(-0.0) == -math.inf
    assert arithmetic.log(math.inf) == math.inf and arithmetic.log(1.0) == 0.0
    for a in (-1.0, -math.inf, math.nan):
        assert math.isnan(arithmetic.log(a))


@pytest.mark.parametrize("t", [1e-8, 1e-3, 0.1, 0.5, 0.785, -0.3])
def test_tails_have_no_cancellation(t):
    """Short flights need sin t - t and cos t - 1 + t^2/2 to a few roundings of their own."""
    _, _, sine_tail, cosine_tail, n = arithmetic.quadrant(t)
    with mpmath.workdps(60):
        c, s = mpmath.cos_sin(mpf(t))
        assert n == 0.0 and abs(sine_tail / (s - mpf(t)) - 1) < 5e-16
        assert abs(cosine_tail / (c - 1 + mpf(t) ** 2 / 2) - 1) < 5e-16


def frozen_arguments():
    """Return 200,000 numbers from a generator that is the same on every machine."""
    rng = np.random.default_rng(4)
    return np.concatenate(
        [
            200.0 * rng.random(100_000) - 100.0, 1.6 * rng.random(40_000) - 0.8,
            any_doubles(rng, 40_000), any_doubles(rng, 20_000, 1023 + 30),
        ]
    )  # fmt: skip


def digest(*arrays):
    data = b"".join(np.asarray(a).astype("<f8").tobytes() for a in arrays)
    return hashlib.sha256(data).hexdigest()


def test_frozen_bits():
    t = frozen_arguments()
    assert digest(*arithmetic.sincos_each(t[np.abs(t) < arithmetic.WIDE])) == SINCOS
    assert digest(log_each(np.abs(frozen_arguments()))) == LOG


SINCOS = "7ae097ee27006f39fbd63f882ae782737249f33a0e389e160140e5392db14291"
LOG = "5bab1f155c86bdcb0e3a8bb57f2a490b22e3a3bdbe9973a2ccbca08774cc959b"
