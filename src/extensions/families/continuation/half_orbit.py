"""Half orbits between two symmetry lines, and their derivatives, in units where g = 1.

A symmetric periodic orbit meets the symmetry lines Fix R and Fix RP in two points, which halve it
(De Vogelaere 1958). Both lines are parametrized by q in (-1, 1). With rho = sqrt(1 + 2 k E),
u = 2 q/(1 + q^2), r = (1 - q^2)/(1 + q^2) and a = (1 + rho u)/k,

    Fix R    is the state x = a, w = rho r/(k sqrt(1 + k)), v = k w,
    Fix RP   is the flight that is at rest at its apex, with strain -a and gap -(rho r)^2/(2k).

A half orbit of period n starts on one of these lines, makes its impacts, and ends on Fix R (even n
from Fix R), or on Fix RP. Its defect, which vanishes for a symmetric orbit, is y = v - k w on Fix
R, and eta = -k U' at the apex X' = 0 on Fix RP. The pairs (x, y) and (xi = -U, eta) are canonical
coordinates, so that the derivatives A, B, C, D of the end by the start, along and across the lines,
have A D - B C = 1, and the trace of the whole orbit is 2 (A D + B C). Hence

    C = 0   a fold                     B = 0   a pitchfork that breaks the symmetry
    A = 0, D = 0   period doubling, on the first or on the second line.
"""

import math
from typing import NamedTuple

import numpy as np

from pseudorigid.kernel import flight
from pseudorigid.kernel.arithmetic import quadrant
from pseudorigid.kernel.compiled import jit
from pseudorigid.kernel.flight import first_impact, longest_stride, rises_to_its_root
from pseudorigid.kernel.impact import flight_derivatives, impact_coefficients, rebound

FIX_R, FIX_RP = 0, 1  # symmetry lines
ENERGY, INERTIA = 0, 1  # parameters: rho at fixed k, and k at fixed E
_MOST_STEPS = 10_000


class HalfOrbit(NamedTuple):
    """A half orbit, its defect, and the derivatives of its end."""

    exists: bool  # False if an impact ends the last flight before its apex
    h: float  # the defect, and its derivatives by q and by the parameter
    h_q: float
    h_p: float
    a: float  # A, B, C and D: the end's derivatives by the start
    b: float
    c: float
    d: float
    xi: float  # position of the start along its line
    x_end: float  # position of the end along its line
    time: float  # total time of the whole orbit
    lowest_speed: float  # lowest contact speed
    times: np.ndarray  # (flights,) times of flight
    points: np.ndarray  # (n, 2) in canonical coordinates: impacts from Fix R, apices from Fix RP


@jit
def gap(t, x, b, c, s):
    """Return the gap, its two derivatives, position and rate after a time of flight."""
    return flight.gap(t, x, b, c, s, 1.0, quadrant(t))


@jit
def parameter_derivatives(parameter, k, rho):
    """Return the derivatives of rho and of k by the parameter, ENERGY or INERTIA."""
    energy = 0.5 * (rho - 1.0) * (rho + 1.0) / k
    return (1.0, 0.0) if parameter == ENERGY else (energy / rho, 1.0)


@jit
def _place(k, rho, q, rho_p, k_p):
    """Return a and r at q on a line, their derivatives by q, and that of a by the parameter."""
    square = 1.0 + q * q
    u, r = 2.0 * q / square, (1.0 - q) * (1.0 + q) / square
    u_q, r_q = 2.0 * r / square, -4.0 * q / (square * square)
    a = (1.0 + rho * u) / k
    return a, r, rho * u_q / k, r_q, u * rho_p / k - k_p * a / k


@jit
def line_state(line, k, rho, q):
    """Return the state (x, v, w) at q on Fix R, or at rest at the apex on Fix RP, and its depth.

    The depth, which is minus the gap there, is 0 on Fix R.
    """
    a, r, _, _, _ = _place(k, rho, q, 0.0, 0.0)
    if line == FIX_R:
        w = rho * r / (k * math.sqrt(1.0 + k))
        return a, k * w, w, 0.0
    return a, 0.0, 0.0, 0.5 * (rho * r) * (rho * r) / k


@jit
def landing(a, theta):
    """Return the state (x, v, w) at the end of a fall of length theta from an apex on Fix RP."""
    _, _, _, x, w = gap(theta, a, 0.0, 0.0, 0.0)
    return x, theta, max(w, -theta)


@jit
def _fall(a, depth):
    """Return the time from rest at the apex, with strain -a and gap -depth, to the impact."""
    amplitude = flight.amplitude_bound(a, 0.0)
    t = math.sqrt(2.0 * depth / (1.0 + amplitude))
    low, high = 0.0, math.inf
    landing = False
    for _ in range(_MOST_STEPS):
        f, df, ddf, _, q = gap(t, a, 0.0, 0.0, 0.0)
        f -= depth
        if f < 0.0:
            low = t
        else:
            high = t
        if not landing and f < 0.0 and not rises_to_its_root(-f, df, ddf, q, 1.0, amplitude):
            after = t + longest_stride(-f, df, ddf, q, 1.0, amplitude)
        else:
            landing = True
            if f == 0.0 or not df > 0.0:
                return t
            after = t - f / df
            if after == t:
                return t
            if not low < after < high:
                after = 0.5 * (low + high)
        if after in (t, low, high) or not after < math.inf:
            return t
        t = after
    raise ArithmeticError("the fall from an apex does not end")


@jit
def _newton(t, x, b, c, s, order, value):
    """Return the time that Newton's method reaches from t, where the gap's derivative has a value.

    The derivative is of `order` 0, the gap itself, or 1.
    """
    for _ in range(50):
        f, df, ddf, _, _ = gap(t, x, b, c, s)
        off, slope = (f, df) if order == 0 else (df, ddf)
        after = t - (off - value) / slope
        if abs(after - t) <= 4e-16 * abs(t):
            return after
        t = after
    return t


@jit
def _tangent_after_impact(tangents, j, s, k, k_p, coefficients):
    """Return the derivatives of b, c and s after an impact along the j-th of `tangents`."""
    db, dc, ds = rebound(tangents[j, 1], tangents[j, 2], k, coefficients)
    if j == 2:
        by_k = k_p * 2.0 * s / ((1.0 + k) * (1.0 + k))  # the impact law's derivative by k
        db, dc = db - by_k, dc + by_k
    return db, dc, ds


@jit
def fly(x, v, w, k, k_p, coefficients, guess, tangents):
    """Return the state after an impact and a flight, and the flight's time.

    The rows of `tangents` (3, 3) are tangent vectors, which are carried along in place; the last
    one is the derivative by the parameter, by which k has the derivative k_p. If `guess` is above
    0, the flight ends at the root of the gap next to it, otherwise at the first impact.
    """
    b, c, s = rebound(v, w, k, coefficients)
    if guess > 0.0:
        tau = _newton(guess, x, b, c, s, 0, 0.0)
        _, _, _, p, rate = gap(tau, x, b, c, s)
    else:
        tau, p, rate, _ = first_impact(x, b, c, s, 1.0)
    sine, cosine, tau_x, tau_s, tau_c = flight_derivatives(x, b, c, s, 1.0, tau, quadrant(tau))
    x, v = p, b + tau
    w = max(rate, -v)
    for j in range(3):
        db, dc, ds = _tangent_after_impact(tangents, j, s, k, k_p, coefficients)
        dx = tangents[j, 0]
        dt = tau_x * dx + tau_s * ds + tau_c * dc
        tangents[j, 0] = cosine * dx - sine * dc - w * dt
        tangents[j, 1] = db + dt
        tangents[j, 2] = sine * dx + cosine * dc + x * dt
    return x, v, w, tau


@jit
def ends_at_apex(line, period):
    """Return whether half orbits end at the apex of a flight, on Fix RP."""
    return line == FIX_RP or period % 2 == 1


@jit
def scan(line, k, rho, q, longest):
    """Return the defects (n, longest + 1) of half orbits of all periods up to `longest`.

    `q` (n,) are starts. A defect is NaN where the line has no such half orbit: for odd periods
    from Fix RP, and where an impact ends the last flight before its apex.
    """
    coefficients = impact_coefficients(k)
    out = np.full((q.size, longest + 1), math.nan)
    for i in range(q.size):
        x, v, w, depth = line_state(line, k, rho, q[i])
        if line == FIX_RP:
            x, v, w = landing(x, _fall(x, depth))
        period = 1 if line == FIX_R else 2
        while period <= longest:
            b, c, s = rebound(v, w, k, coefficients)
            tau, p, u, _ = first_impact(x, b, c, s, 1.0)
            if 0.0 < -b < tau:  # the apex
                _, _, _, _, rate = gap(-b, x, b, c, s)
                out[i, period] = -k * rate
            x, v = p, b + tau
            w = max(u, -v)
            if line == FIX_R and period + 1 <= longest:
                out[i, period + 1] = v - k * w
            period += 2
    return out


@jit
def _start_on_fix_r(k, rho, q, rho_p, k_p):
    """Return position, its derivative by q, state and tangents (3, 3) of the start at q on Fix R.

    The rows of the tangents are the derivatives of the state by the position along the line, up to
    a factor, by the coordinate across it, and by the parameter.
    """
    a, r, a_q, r_q, a_p = _place(k, rho, q, rho_p, k_p)
    root = math.sqrt(1.0 + k)
    w = rho * r / (k * root)
    w_q = rho * r_q / (k * root)
    w_p = w * (rho_p / rho) - k_p * (w * (1.0 / k + 0.5 / (1.0 + k)))
    by_q = a_q, k * w_q, w_q
    across = 0.0, 1.0 / (1.0 + k), -1.0 / (1.0 + k)
    by_parameter = a_p, k * w_p + k_p * w, w_p
    return a, a_q, (a, k * w, w), np.array((by_q, across, by_parameter))


@jit
def _start_on_fix_rp(k, rho, q, rho_p, k_p, guess):
    """Return xi, its derivative by q, state and tangents (3, 3) after the fall from q on Fix RP.

    The rows of the tangents are as in `_start_on_fix_r`. If `guess` is above 0, the fall ends at
    the root of the gap next to it.
    """
    a, r, a_q, r_q, a_p = _place(k, rho, q, rho_p, k_p)
    depth = 0.5 * (rho * r) * (rho * r) / k
    theta = _newton(guess, a, 0.0, 0.0, 0.0, 0, depth) if guess > 0.0 else _fall(a, depth)
    x, v, w = landing(a, theta)
    _, slope, _, _, _ = gap(theta, a, 0.0, 0.0, 0.0)
    _, _, _, cosine, sine = gap(theta, 1.0, 0.0, 0.0, 0.0)
    depth_q = rho * r * rho * r_q / k
    depth_p = rho * r * r * rho_p / k - k_p * depth / k
    # theta solves -depth + theta^2/2 + a (1 - cos theta) = 0.
    theta_q = (depth_q - a_q * (1.0 - cosine)) / slope
    theta_across = sine / (k * slope)
    theta_p = (depth_p - a_p * (1.0 - cosine)) / slope
    by_q = a_q * cosine - w * theta_q, theta_q, a_q * sine + x * theta_q
    across = sine / k - w * theta_across, theta_across, -cosine / k + x * theta_across
    by_parameter = a_p * cosine - w * theta_p, theta_p, a_p * sine + x * theta_p
    return a, a_q, (x, v, w), np.array((by_q, across, by_parameter))


@jit
def _end_at_apex(x, v, w, k, k_p, coefficients, tangents):
    """Return the end (xi, eta) at the apex of the next flight, and the derivatives (3, 2) of both.

    The other results are the time to the apex, and whether no impact ends the flight before.
    """
    b, c, s = rebound(v, w, k, coefficients)
    t = -b
    reached = 0.0 < t < first_impact(x, b, c, s, 1.0)[0]
    _, _, _, along, rate = gap(t, x, b, c, s)
    _, _, _, cosine, sine = gap(t, 1.0, 0.0, 0.0, 0.0)
    ends = np.empty((3, 2))
    for j in range(3):
        db, dc, _ = _tangent_after_impact(tangents, j, s, k, k_p, coefficients)
        dx = tangents[j, 0]
        ends[j, 0] = cosine * dx - sine * dc + rate * db
        ends[j, 1] = -k * (sine * dx + cosine * dc - along * db)
    ends[2, 1] -= k_p * rate
    return along, -k * rate, ends, t, reached


@jit
def evaluate(line, period, parameter, k, rho, q, guess):
    """Return a half orbit from q on a line as a HalfOrbit.

    `parameter` is ENERGY or INERTIA: what h_p differentiates by, rho or k. If `guess` is not empty,
    it has approximate times of flight, from whose neighbourhood the times are taken, whether an
    earlier impact ends the flight or not; otherwise impacts are the first ones.
    """
    coefficients = impact_coefficients(k)
    tracked = guess.size > 0
    rho_p, k_p = parameter_derivatives(parameter, k, rho)
    maps = period // 2 - 1 if line == FIX_RP else period // 2  # applied along the half orbit
    to_apex = ends_at_apex(line, period)
    times = np.empty(line + maps + int(to_apex))
    points = np.empty((period // 2 + 1, 2))
    n = line  # the number of flights so far
    total = 0.0
    if line == FIX_R:
        xi, a_q, (x, v, w), tangents = _start_on_fix_r(k, rho, q, rho_p, k_p)
    else:
        near = guess[0] if tracked else 0.0
        xi, a_q, (x, v, w), tangents = _start_on_fix_rp(k, rho, q, rho_p, k_p, near)
        times[0] = total = v  # where g = 1, the time of the fall
    lowest = v + w
    points[0, 0], points[0, 1] = xi, 0.0
    for i in range(1, maps + 1):
        if line == FIX_RP:
            b, c, s = rebound(v, w, k, coefficients)
            _, _, _, apex, rate = gap(-b, x, b, c, s)
            points[i, 0], points[i, 1] = apex, -k * rate
        near = guess[n] if tracked else 0.0
        x, v, w, tau = fly(x, v, w, k, k_p, coefficients, near, tangents)
        if line == FIX_R:
            points[i, 0], points[i, 1] = x, v - k * w
        times[n] = tau
        n += 1
        total += tau
        lowest = min(lowest, v + w)
    exists = True
    if to_apex:
        x_end, h, ends, t, reached = _end_at_apex(x, v, w, k, k_p, coefficients, tangents)
        exists = reached or (tracked and t > 0.0)
        times[n] = t
        total += t
        if line == FIX_RP:
            points[-1, 0], points[-1, 1] = x_end, h
    else:
        x_end, h = x, v - k * w
        ends = np.column_stack((tangents[:, 0], tangents[:, 1] - k * tangents[:, 2]))
        ends[2, 1] -= k_p * w
    a, c, h_q = ends[0, 0] / a_q, ends[0, 1] / a_q, ends[0, 1]
    b, d, h_p = ends[1, 0], ends[1, 1], ends[2, 1]
    return HalfOrbit(exists, h, h_q, h_p, a, b, c, d, xi, x_end, 2.0 * total, lowest, times, points)


@jit
def _highest_touch(x, b, c, s, tau, depth, to_apex):
    """Return the time and height of the highest local maximum of the gap in a flight, or NaN.

    The flight has the length tau, and the floor lies below its start by `depth`. With `to_apex` its
    end counts too.
    """
    time, highest = math.nan, math.nan
    if depth > 0.0 and 1.0 + x < 0.0:
        time, highest = 0.0, -depth
    steps = int(tau / 0.02) + 8
    before = 0.0
    for j in range(1, steps + 1):
        t = tau * j / steps
        _, df, _, _, _ = gap(t, x, b, c, s)
        if before > 0.0 and df <= 0.0:
            peak = _newton(t - 0.5 * tau / steps, x, b, c, s, 1, 0.0)
            if not 0.0 < peak < tau * (1.0 + 1e-9):
                peak = t
            height = gap(peak, x, b, c, s)[0] - depth
            if not height <= highest:
                time, highest = peak, height
        before = df
    f, _, ddf, _, _ = gap(tau, x, b, c, s)
    if to_apex and ddf < 0.0 and not f - depth <= highest:
        time, highest = tau, f - depth
    return time, highest


@jit
def flight_heights(x, v, w, k, depth, to_apex, times, near):
    """Return the time and height of each flight's highest touch of the floor as (flights, 2).

    The flights begin with the impact of the state (x, v, w), or at rest at a depth below which the
    floor lies, and have these `times`; if `to_apex`, the last one ends at its apex. The height is
    the largest local maximum of the gap before a flight's end, and negative where the flight misses
    the floor. Where near[i] is above 0 the maximum next to that time is taken; rows without a
    maximum are NaN.
    """
    coefficients = impact_coefficients(k)
    heights = np.empty((times.size, 2))
    for i in range(times.size):
        b, c, s = rebound(v, w, k, coefficients)
        tau = times[i]
        if near[i] > 0.0:
            t = _newton(near[i], x, b, c, s, 1, 0.0)
            heights[i, 0], heights[i, 1] = t, gap(t, x, b, c, s)[0] - depth
        else:
            last = to_apex and i == times.size - 1
            heights[i, 0], heights[i, 1] = _highest_touch(x, b, c, s, tau, depth, last)
        _, _, _, p, rate = gap(tau, x, b, c, s)
        x, v, w = p, b + tau, max(rate, -(b + tau))
        depth = 0.0
    return heights
