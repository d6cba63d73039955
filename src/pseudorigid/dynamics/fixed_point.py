"""Symmetric fixed point in closed form, in units where g = 1: lengths in g R.

With v, w = xdot, udot just before an impact, tau the time of flight, and theta = tau/2 in (0, pi):
v = theta, w = theta/k, x = theta cot(theta)/k, and

    E         = ((1+k) theta^2 + (1 - theta cot theta)^2 - 1) / (2k)
    trace/2   = (1 + k cos 2 theta)/(1+k)
                - k (1 - theta cot theta)(2 theta - sin 2 theta) / (theta (1+k)^2)

where the trace is that of the map's Jacobian in the chart (x, y = v - k w). The point is elliptic
while |trace| < 2. Nearby orbits then wind around it with the rotation number rho, in turns per
impact, trace = 2 cos(2 pi rho). Times are in 1/omega, k is the Euler inertia, eq. (5), and energies
e are E/g^2.
"""

import math
from collections.abc import Callable

from ..kernel.arithmetic import sincos


def _one_minus_theta_cot(theta: float) -> float:
    sine, cosine = sincos(theta)
    return 1.0 - theta * cosine / sine


def energy(k: float, theta: float) -> float:
    """Return E/g^2, which rises with theta = tau/2 from -1/(2k)."""
    rest = _one_minus_theta_cot(theta)
    return ((1.0 + k) * theta * theta + rest * rest - 1.0) / (2.0 * k)


def half_time(k: float, e: float) -> float:
    """Return theta = tau/2, to the last bit, at the energy e > -1/(2k)."""
    return _root(_is_below_energy, math.pi, k, e)


def place(k: float, theta: float) -> float:
    """Return x in g R; the fixed point lies on the symmetry line y = 0."""
    return (1.0 - _one_minus_theta_cot(theta)) / k


def trace_at(k: float, theta: float) -> float:
    """Return the trace, which falls with theta from 2; the point is elliptic above -2."""
    sine, cosine = sincos(2.0 * theta)
    shear = _one_minus_theta_cot(theta) * (2.0 * theta - sine) / (theta * (1.0 + k))
    return 2.0 * (1.0 + k * (cosine - shear)) / (1.0 + k)


def rotation(trace: float) -> float:
    """Return the rotation number, from 0 to 1/2; NaN where |trace| > 2."""
    if not -2.0 <= trace <= 2.0:
        return math.nan
    return _root(_is_above_trace, 0.5, trace)


def numbers(k: float, e: float) -> tuple[float, float, float]:
    """Return x, trace and rotation number of the fixed point at the energy e."""
    theta = half_time(k, e)
    trace_of_point = trace_at(k, theta)
    return place(k, theta), trace_of_point, rotation(trace_of_point)


def resonance(k: float, turns: int, impacts: int) -> float:
    """Return the E/g^2 at which the rotation number is turns/impacts <= 1/2."""
    resonant_trace = 2.0 * sincos(2.0 * math.pi * turns / impacts)[1]
    return energy(k, _root(_has_larger_trace, math.pi, k, resonant_trace))


# Numba, which compiles all of this for cells of the atlas, takes no closures as arguments.
def _is_below_energy(theta: float, k: float, e: float) -> bool:
    return energy(k, theta) < e


def _is_above_trace(rho: float, trace: float) -> bool:
    return 2.0 * sincos(2.0 * math.pi * rho)[1] > trace


def _has_larger_trace(theta: float, k: float, other: float) -> bool:
    return trace_at(k, theta) > other


def _root(is_below: Callable[..., bool], upper: float, *others: float) -> float:
    """Return the last double in (0, upper) at which `is_below` holds, by bisection."""
    low, high = 0.0, upper
    while True:
        middle = 0.5 * (low + high)
        if middle in (low, high):
            return low if low > 0.0 else high
        if is_below(middle, *others):
            low = middle
        else:
            high = middle
