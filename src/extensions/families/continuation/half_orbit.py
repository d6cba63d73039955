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

import numpy as np

from pseudorigid.kernel.arithmetic import quadrant
from pseudorigid.kernel.compiled import jit
from pseudorigid.kernel.flight import (
    amplitude_bound,
    first_impact,
    gap,
    longest_stride,
    rises_to_its_root,
)
from pseudorigid.kernel.impact import flight_derivatives, impact_coefficients, rebound

FIX_R, FIX_RP = 0, 1  # symmetry lines
ENERGY, INERTIA = 0, 1  # parameters: rho at fixed k, and k at fixed E
LONGEST_PERIOD = 24
# Entries of the result of `evaluate`. From TIMES on stand the times of flight, from PLACES on the
# points (x, y) after each impact, or (xi, eta) of the apex after it for orbits from Fix RP.
H, H_Q, H_P, A, B, C, D, XI, X_END, TIME, LOWEST_SPEED, TIMES = range(12)
PLACES = TIMES + LONGEST_PERIOD // 2 + 2
SIZE = PLACES + LONGEST_PERIOD + 4
_MOST_STEPS = 10_000


@jit
def place(k, rho, q):
    """Return a, r, and the derivatives of u and r by q, at a parameter q of a line."""
    square = 1.0 + q * q
    r = (1.0 - q) * (1.0 + q) / square
    u = 2.0 * q / square
    return (1.0 + rho * u) / k, u, r, 2.0 * r / square, -4.0 * q / (square * square)


@jit
def line_state(line, k, rho, q):
    """Return the state (x, v, w) at q on Fix R, or at rest at the apex on Fix RP, and its depth.

    The depth, which is minus the gap there, is 0 on Fix R.
    """
    a, _, r, _, _ = place(k, rho, q)
    if line == FIX_R:
        w = rho * r / (k * math.sqrt(1.0 + k))
        return a, k * w, w, 0.0
    return a, 0.0, 0.0, 0.5 * (rho * r) * (rho * r) / k


@jit
def landing(a, theta):
    """Return the state (x, v, w) at the end of a fall of length theta from an apex on Fix RP."""
    _, _, _, x, w = gap(theta, a, 0.0, 0.0, 0.0, 1.0, quadrant(theta))
    return x, theta, max(w, -theta)


@jit
def _fall(a, depth):
    """Return the time from rest at the apex, with strain -a and gap -depth, to the impact."""
    amplitude = amplitude_bound(a, 0.0)
    t = math.sqrt(2.0 * depth / (1.0 + amplitude))
    low, high = 0.0, math.inf
    landing = False
    for _ in range(_MOST_STEPS):
        f, df, ddf, _, q = gap(t, a, 0.0, 0.0, 0.0, 1.0, quadrant(t))
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
def nearby_root(t, x, b, c, s, depth):
    """Return the root of the gap, less `depth`, that Newton's method reaches from t."""
    for _ in range(50):
        f, df, _, _, _ = gap(t, x, b, c, s, 1.0, quadrant(t))
        after = t - (f - depth) / df
        if abs(after - t) <= 4e-16 * abs(t):
            return after
        t = after
    return t


@jit
def fly(x, v, w, k, k_p, coefficients, guess, tangents):
    """Return the state after an impact and a flight, and the flight's time.

    The rows of `tangents` (3, 3) are tangent vectors, which are carried along in place; the last
    one is the derivative by the parameter, by which k has the derivative k_p. If `guess` is above
    0, the flight ends at the root of the gap next to it, otherwise at the first impact.
    """
    b, c, s = rebound(v, w, k, coefficients)
    if guess > 0.0:
        tau = nearby_root(guess, x, b, c, s, 0.0)
        _, _, _, p, rate = gap(tau, x, b, c, s, 1.0, quadrant(tau))
    else:
        tau, p, rate, _ = first_impact(x, b, c, s, 1.0)
    sine, cosine, tau_x, tau_s, tau_c = flight_derivatives(x, b, c, s, 1.0, tau, quadrant(tau))
    x, v = p, b + tau
    w = max(rate, -v)
    more = k_p * 2.0 * s / ((1.0 + k) * (1.0 + k))  # the impact law's derivative by k
    for j in range(3):
        db, dc, ds = rebound(tangents[j, 1], tangents[j, 2], k, coefficients)
        if j == 2:
            db, dc = db - more, dc + more
        dx = tangents[j, 0]
        dt = tau_x * dx + tau_s * ds + tau_c * dc
        tangents[j, 0] = cosine * dx - sine * dc - w * dt
        tangents[j, 1] = db + dt
        tangents[j, 2] = sine * dx + cosine * dc + x * dt
    return x, v, w, tau


@jit
def half_length(line, period):
    """Return the number of times that the map is applied along a half orbit."""
    return period // 2 if line == FIX_R else period // 2 - 1


@jit
def scan(line, k, rho, q, longest, out):
    """Write the defects of half orbits of all periods up to `longest` to out (n, longest + 1).

    `q` (n,) are starts. A defect is NaN where the line has no such half orbit: for odd periods
    from Fix RP, and where an impact ends the last flight before its apex.
    """
    coefficients = impact_coefficients(k)
    for i in range(q.size):
        for n in range(longest + 1):
            out[i, n] = math.nan
        x, v, w, depth = line_state(line, k, rho, q[i])
        if line == FIX_RP:
            x, v, w = landing(x, _fall(x, depth))
        period = 1 if line == FIX_R else 2
        while period <= longest:
            b, c, s = rebound(v, w, k, coefficients)
            tau, p, u, _ = first_impact(x, b, c, s, 1.0)
            if 0.0 < -b < tau:  # the apex
                _, _, _, _, rate = gap(-b, x, b, c, s, 1.0, quadrant(-b))
                out[i, period] = -k * rate
            x, v = p, b + tau
            w = max(u, -v)
            if line == FIX_R and period + 1 <= longest:
                out[i, period + 1] = v - k * w
            period += 2


@jit
def evaluate(line, period, parameter, k, rho, q, guess, out):
    """Compute one half orbit and its derivatives into out (SIZE,).

    `parameter` is ENERGY or INERTIA: what H_P differentiates by, rho or k. If `guess` is not empty,
    it has approximate times of flight, from whose neighbourhood the times are taken, whether an
    earlier impact ends the flight or not; otherwise impacts are the first ones. Returns whether
    the half orbit exists: it does not if the last flight ends before its apex.
    """
    coefficients = impact_coefficients(k)
    tracked = guess.size > 0
    a, u, r, u_q, r_q = place(k, rho, q)
    energy = 0.5 * (rho - 1.0) * (rho + 1.0) / k
    rho_p, k_p = (1.0, 0.0) if parameter == ENERGY else (energy / rho, 1.0)
    a_q, a_p = rho * u_q / k, u * rho_p / k - k_p * a / k
    # Derivatives of x, v and w by the start's place along its line and across it, and by the
    # parameter.
    tangents = np.empty((3, 3))
    total = 0.0
    n_times = 0
    if line == FIX_R:
        root = math.sqrt(1.0 + k)
        x, w = a, rho * r / (k * root)
        v = k * w
        w_q = rho * r_q / (k * root)
        w_p = w * (rho_p / rho) - k_p * (w * (1.0 / k + 0.5 / (1.0 + k)))
        tangents[0, 0], tangents[0, 1], tangents[0, 2] = a_q, k * w_q, w_q
        tangents[1, 0], tangents[1, 1], tangents[1, 2] = 0.0, 1.0 / (1.0 + k), -1.0 / (1.0 + k)
        tangents[2, 0], tangents[2, 1], tangents[2, 2] = a_p, k * w_p + k_p * w, w_p
    else:
        depth = 0.5 * (rho * r) * (rho * r) / k
        theta = nearby_root(guess[0], a, 0.0, 0.0, 0.0, depth) if tracked else _fall(a, depth)
        out[TIMES] = theta
        n_times = 1
        total = theta
        slope = gap(theta, a, 0.0, 0.0, 0.0, 1.0, quadrant(theta))[1]
        x, v, w = landing(a, theta)
        _, _, _, cosine, sine = gap(theta, 1.0, 0.0, 0.0, 0.0, 1.0, quadrant(theta))
        depth_q = rho * r * rho * r_q / k
        depth_p = rho * r * r * rho_p / k - k_p * depth / k
        # f = -depth + t^2/2 + a (1 - cos t)
        t_q = (depth_q - a_q * (1.0 - cosine)) / slope
        t_n = sine / (k * slope)
        t_p = (depth_p - a_p * (1.0 - cosine)) / slope
        for j, (dx, dw, dt) in enumerate(
            (
                (a_q * cosine, a_q * sine, t_q),
                (sine / k, -cosine / k, t_n),
                (a_p * cosine, a_p * sine, t_p),
            )
        ):
            tangents[j, 0], tangents[j, 1], tangents[j, 2] = dx - w * dt, dt, dw + x * dt
    lowest = v + w
    out[PLACES], out[PLACES + 1] = a, 0.0
    n_places = 1
    for _ in range(half_length(line, period)):
        if line == FIX_RP:
            b, c, s = rebound(v, w, k, coefficients)
            _, _, _, apex, apex_rate = gap(-b, x, b, c, s, 1.0, quadrant(-b))
            out[PLACES + 2 * n_places], out[PLACES + 2 * n_places + 1] = apex, -k * apex_rate
        near = guess[n_times] if tracked else 0.0
        x, v, w, tau = fly(x, v, w, k, k_p, coefficients, near, tangents)
        if line == FIX_R:
            out[PLACES + 2 * n_places], out[PLACES + 2 * n_places + 1] = x, v - k * w
        n_places += 1
        total += tau
        out[TIMES + n_times] = tau
        n_times += 1
        lowest = min(lowest, v + w)
    exists = True
    ends = np.empty((3, 2))  # derivatives of the end along its line and across it
    if line == FIX_R and period % 2 == 0:
        h, along = v - k * w, x
        for j in range(3):
            ends[j, 0], ends[j, 1] = tangents[j, 0], tangents[j, 1] - k * tangents[j, 2]
        ends[2, 1] -= k_p * w
    else:
        b, c, s = rebound(v, w, k, coefficients)
        t = -b
        tau = first_impact(x, b, c, s, 1.0)[0]
        exists = t > 0.0 and (t < tau or tracked)
        _, _, _, along, rate = gap(t, x, b, c, s, 1.0, quadrant(t))
        _, _, _, cosine, sine = gap(t, 1.0, 0.0, 0.0, 0.0, 1.0, quadrant(t))
        more = k_p * 2.0 * s / ((1.0 + k) * (1.0 + k))
        h = -k * rate
        for j in range(3):
            db, dc, _ = rebound(tangents[j, 1], tangents[j, 2], k, coefficients)
            if j == 2:
                db, dc = db - more, dc + more
            dx = tangents[j, 0]
            ends[j, 0] = cosine * dx - sine * dc + rate * db
            ends[j, 1] = -k * (sine * dx + cosine * dc - along * db)
        ends[2, 1] -= k_p * rate
        total += t
        out[TIMES + n_times] = t
        n_times += 1
        if line == FIX_RP:
            out[PLACES + 2 * n_places], out[PLACES + 2 * n_places + 1] = along, h
    out[H], out[H_Q], out[H_P] = h, ends[0, 1], ends[2, 1]
    out[A], out[B], out[C], out[D] = ends[0, 0] / a_q, ends[1, 0], ends[0, 1] / a_q, ends[1, 1]
    out[XI], out[X_END], out[TIME], out[LOWEST_SPEED] = a, along, 2.0 * total, lowest
    return exists


@jit
def maximum(t, x, b, c, s):
    """Return the time near t at which the gap has a maximum, by Newton's method."""
    for _ in range(50):
        _, df, ddf, _, _ = gap(t, x, b, c, s, 1.0, quadrant(t))
        after = t - df / ddf
        if abs(after - t) <= 4e-16 * abs(t):
            return after
        t = after
    return t


@jit
def flight_heights(x, v, w, k, depth, to_apex, times, near, out):
    """Write the time and height of each flight's highest touch of the floor to out (flights, 2).

    The flights begin with the impact of the state (x, v, w), or at rest at a depth below which the
    floor lies, and have these `times`; if `to_apex`, the last one ends at its apex. The height is
    the largest local maximum of the gap before a flight's end, and negative where the flight misses
    the floor. Where near[i] is above 0 the maximum next to that time is taken; rows without a
    maximum are NaN.
    """
    coefficients = impact_coefficients(k)
    for i in range(times.size):
        b, c, s = rebound(v, w, k, coefficients)
        tau = times[i]
        out[i, 0], out[i, 1] = math.nan, math.nan
        if near[i] > 0.0:
            t = maximum(near[i], x, b, c, s)
            out[i, 0], out[i, 1] = t, gap(t, x, b, c, s, 1.0, quadrant(t))[0] - depth
        else:
            if depth > 0.0 and 1.0 + x < 0.0:
                out[i, 0], out[i, 1] = 0.0, -depth
            steps = int(tau / 0.02) + 8
            before = 0.0
            for j in range(1, steps + 1):
                t = tau * j / steps
                _, df, _, _, _ = gap(t, x, b, c, s, 1.0, quadrant(t))
                if before > 0.0 and df <= 0.0:
                    peak = maximum(t - 0.5 * tau / steps, x, b, c, s)
                    if not 0.0 < peak < tau * (1.0 + 1e-9):
                        peak = t
                    height = gap(peak, x, b, c, s, 1.0, quadrant(peak))[0] - depth
                    if not height <= out[i, 1]:
                        out[i, 0], out[i, 1] = peak, height
                before = df
            f, _, ddf, _, _ = gap(tau, x, b, c, s, 1.0, quadrant(tau))
            at_apex = to_apex and i == times.size - 1
            if at_apex and ddf < 0.0 and not f - depth <= out[i, 1]:
                out[i, 0], out[i, 1] = tau, f - depth
        _, _, _, p, rate = gap(tau, x, b, c, s, 1.0, quadrant(tau))
        x, v, w = p, b + tau, max(rate, -(b + tau))
        depth = 0.0
