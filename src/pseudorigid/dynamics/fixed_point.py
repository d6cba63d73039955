"""The symmetric fixed point in closed form, in units where g = 1: lengths in g R.

With theta = tau/2 on (0, pi): v = theta, w = theta/k, x = theta cot(theta)/k, and

    E         = ((1+k) theta^2 + (1 - theta cot theta)^2 - 1) / (2k)
    trace/2   = (1 + k cos 2 theta)/(1+k)
                - k (1 - theta cot theta)(2 theta - sin 2 theta) / (theta (1+k)^2)

the trace being that of the map's Jacobian in the chart (x, y = v - k w). It is elliptic while
|trace| < 2; nearby orbits then go round it by the rotation number rho of a turn each impact,
trace = 2 cos(2 pi rho).
"""

import math

from ..kernel.arithmetic import sincos


def one_minus_theta_cot(theta):
    """1 - theta cot(theta), for 0 < theta < pi."""
    sine, cosine = sincos(theta)
    return 1.0 - theta * cosine / sine


def energy(k, theta):
    """The fixed point's energy, from half its time of flight.

    Parameters
    ----------
    k : float
        Euler inertia, eq. (5).
    theta : float
        tau/2 (1/omega), 0 < theta < pi.

    Returns
    -------
    float
        E/g^2, which rises with theta from -1/(2k).
    """
    b = one_minus_theta_cot(theta)
    return ((1.0 + k) * theta * theta + b * b - 1.0) / (2.0 * k)


def half_time(k, e):
    """Half the fixed point's time of flight, from its energy.

    Parameters
    ----------
    k : float
        Euler inertia, eq. (5).
    e : float
        E/g^2 > -1/(2k).

    Returns
    -------
    float
        theta = tau/2 (1/omega), between 0 and pi, to the last bit.
    """
    return _root(lambda theta: energy(k, theta) < e, math.pi)


def place(k, theta):
    """Where the fixed point is on the symmetry line y = 0.

    Parameters
    ----------
    k : float
        Euler inertia, eq. (5).
    theta : float
        Half the time of flight (1/omega).

    Returns
    -------
    float
        x in g R.
    """
    return (1.0 - one_minus_theta_cot(theta)) / k


def trace(k, theta):
    """Trace of the map's Jacobian at the fixed point, in the chart (x, y = xdot - k udot).

    Parameters
    ----------
    k : float
        Euler inertia, eq. (5).
    theta : float
        Half the time of flight (1/omega).

    Returns
    -------
    float
        Falls with theta from 2; elliptic above -2.
    """
    sine, cosine = sincos(2.0 * theta)
    shear = one_minus_theta_cot(theta) * (2.0 * theta - sine) / (theta * (1.0 + k))
    return 2.0 * (1.0 + k * (cosine - shear)) / (1.0 + k)


def rotation(trace):
    """The rotation number of an elliptic fixed point.

    Parameters
    ----------
    trace : float
        2 cos(2 pi rho).

    Returns
    -------
    float
        rho, turns an impact, 0 to 1/2; NaN where the trace is beyond 2 or -2.
    """
    if not -2.0 <= trace <= 2.0:
        return math.nan
    return _root(lambda rho: 2.0 * sincos(2.0 * math.pi * rho)[1] > trace, 0.5)


def numbers(k, e):
    """Of the fixed point at E/g^2 = e: its place, the trace there and its rotation number.

    Parameters
    ----------
    k, e : float

    Returns
    -------
    place, trace, rotation : float
        As from the functions of these names.
    """
    theta = half_time(k, e)
    found = trace(k, theta)
    return place(k, theta), found, rotation(found)


def resonance(k, turns, impacts):
    """The energy at which the fixed point's rotation number is a given fraction.

    Parameters
    ----------
    k : float
        Euler inertia, eq. (5).
    turns, impacts : int
        The fraction turns/impacts, at most 1/2.

    Returns
    -------
    float
        E/g^2, the first on the way up.
    """
    wanted = 2.0 * sincos(2.0 * math.pi * turns / impacts)[1]
    return energy(k, _root(lambda theta: trace(k, theta) > wanted, math.pi))


def _root(below, end):
    """The number in (0, end) up to which `below` holds, by bisection to the last bit."""
    low, high = 0.0, end
    while True:
        middle = 0.5 * (low + high)
        if middle in (low, high):
            return low if low > 0.0 else high
        if below(middle):
            low = middle
        else:
            high = middle
