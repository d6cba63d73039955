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

from ...kernel.arithmetic import quadrant
from ...kernel.compiled import jit
from ...kernel.flight import (
    amplitude_bound,
    first_impact,
    gap,
    longest_stride,
    rises_to_its_root,
)
from ...kernel.impact import flight_derivatives, impact_coefficients, rebound

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
    root = math.sqrt(1.0 + k)
    for i in range(q.size):
        for n in range(longest + 1):
            out[i, n] = math.nan
        a, _, r, _, _ = place(k, rho, q[i])
        if line == FIX_R:
            x, w = a, rho * r / (k * root)
            v = k * w
        else:
            theta = _fall(a, 0.5 * (rho * r) * (rho * r) / k)
            _, v, _, x, w = gap(theta, a, 0.0, 0.0, 0.0, 1.0, quadrant(theta))
            v = theta
            w = max(w, -v)
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
    rho_p = 1.0 if parameter == ENERGY else energy / rho
    a_q = rho * u_q / k
    a_p = u * rho_p / k - (a / k if parameter == INERTIA else 0.0)
    total = 0.0
    n_times = 0
    if line == FIX_R:
        root = math.sqrt(1.0 + k)
        x, w = a, rho * r / (k * root)
        v = k * w
        w_q = rho * r_q / (k * root)
        w_p = w * (rho_p / rho)
        if parameter == INERTIA:
            w_p -= w * (1.0 / k + 0.5 / (1.0 + k))
        xq, vq, wq = a_q, k * w_q, w_q
        xn, vn, wn = 0.0, 1.0 / (1.0 + k), -1.0 / (1.0 + k)
        xp, vp, wp = a_p, k * w_p + (w if parameter == INERTIA else 0.0), w_p
    else:
        depth = 0.5 * (rho * r) * (rho * r) / k
        theta = nearby_root(guess[0], a, 0.0, 0.0, 0.0, depth) if tracked else _fall(a, depth)
        out[TIMES] = theta
        n_times = 1
        total = theta
        _, slope, _, x, w = gap(theta, a, 0.0, 0.0, 0.0, 1.0, quadrant(theta))
        v = theta
        w = max(w, -v)
        _, _, _, cosine_of, sine_of = gap(theta, 1.0, 0.0, 0.0, 0.0, 1.0, quadrant(theta))
        depth_q = rho * r * rho * r_q / k
        depth_p = rho * r * r * rho_p / k - (depth / k if parameter == INERTIA else 0.0)
        # f = -depth + t^2/2 + a (1 - cos t)
        t_q = (depth_q - a_q * (1.0 - cosine_of)) / slope
        t_n = sine_of / (k * slope)
        t_p = (depth_p - a_p * (1.0 - cosine_of)) / slope
        xq, vq, wq = a_q * cosine_of - w * t_q, t_q, a_q * sine_of + x * t_q
        xn, vn, wn = sine_of / k - w * t_n, t_n, x * t_n - cosine_of / k
        xp, vp, wp = a_p * cosine_of - w * t_p, t_p, a_p * sine_of + x * t_p
    lowest = v + w
    out[PLACES], out[PLACES + 1] = a, 0.0
    n_places = 1
    kick = 1.0 if parameter == INERTIA else 0.0
    for _ in range(half_length(line, period)):
        b, c, s = rebound(v, w, k, coefficients)
        if tracked:
            tau = nearby_root(guess[n_times], x, b, c, s, 0.0)
            _, _, _, p, rate = gap(tau, x, b, c, s, 1.0, quadrant(tau))
        else:
            tau, p, rate, _ = first_impact(x, b, c, s, 1.0)
        sine, cosine, tau_x, tau_s, tau_c = flight_derivatives(x, b, c, s, 1.0, tau, quadrant(tau))
        more = kick * 2.0 * s / ((1.0 + k) * (1.0 + k))  # the impact law's derivative by k
        if line == FIX_RP:
            _, _, _, apex, apex_rate = gap(-b, x, b, c, s, 1.0, quadrant(-b))
            out[PLACES + 2 * n_places], out[PLACES + 2 * n_places + 1] = apex, -k * apex_rate
        x, v = p, b + tau
        w = max(rate, -v)
        if line == FIX_R:
            out[PLACES + 2 * n_places], out[PLACES + 2 * n_places + 1] = x, v - k * w
        n_places += 1
        db, dc, ds = rebound(vq, wq, k, coefficients)
        dt = tau_x * xq + tau_s * ds + tau_c * dc
        xq, vq, wq = cosine * xq - sine * dc - w * dt, db + dt, sine * xq + cosine * dc + x * dt
        db, dc, ds = rebound(vn, wn, k, coefficients)
        dt = tau_x * xn + tau_s * ds + tau_c * dc
        xn, vn, wn = cosine * xn - sine * dc - w * dt, db + dt, sine * xn + cosine * dc + x * dt
        db, dc, ds = rebound(vp, wp, k, coefficients)
        db, dc = db - more, dc + more
        dt = tau_x * xp + tau_s * ds + tau_c * dc
        xp, vp, wp = cosine * xp - sine * dc - w * dt, db + dt, sine * xp + cosine * dc + x * dt
        total += tau
        out[TIMES + n_times] = tau
        n_times += 1
        lowest = min(lowest, v + w)
    exists = True
    if line == FIX_R and period % 2 == 0:
        h, along = v - k * w, x
        h_q, h_n, h_p = vq - k * wq, vn - k * wn, vp - k * wp - kick * w
        x_q, x_n = xq, xn
    else:
        b, c, s = rebound(v, w, k, coefficients)
        t = -b
        tau = first_impact(x, b, c, s, 1.0)[0]
        exists = t > 0.0 and (t < tau or tracked)
        _, _, _, p, rate = gap(t, x, b, c, s, 1.0, quadrant(t))
        _, _, _, cosine, sine = gap(t, 1.0, 0.0, 0.0, 0.0, 1.0, quadrant(t))
        more = kick * 2.0 * s / ((1.0 + k) * (1.0 + k))
        h, along = -k * rate, p
        db, dc, _ = rebound(vq, wq, k, coefficients)
        x_q, h_q = cosine * xq - sine * dc + rate * db, -k * (sine * xq + cosine * dc - p * db)
        db, dc, _ = rebound(vn, wn, k, coefficients)
        x_n, h_n = cosine * xn - sine * dc + rate * db, -k * (sine * xn + cosine * dc - p * db)
        db, dc, _ = rebound(vp, wp, k, coefficients)
        db, dc = db - more, dc + more
        h_p = -k * (sine * xp + cosine * dc - p * db) - kick * rate
        total += t
        out[TIMES + n_times] = t
        n_times += 1
        if line == FIX_RP:
            out[PLACES + 2 * n_places], out[PLACES + 2 * n_places + 1] = p, h
    out[H], out[H_Q], out[H_P] = h, h_q, h_p
    out[A], out[B], out[C], out[D] = x_q / a_q, x_n, h_q / a_q, h_n
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
def touches(line, period, k, rho, q, times, near, out):
    """Write the time and height of each flight's highest touch of the floor to out (flights, 2).

    The height is the largest local maximum of the gap before the flight's end, and negative where
    the flight misses the floor. `times` are the flights' times. Where near[i] is not NaN the
    maximum next to that time is taken; rows without a maximum are NaN.
    """
    coefficients = impact_coefficients(k)
    a, _, r, _, _ = place(k, rho, q)
    depth = 0.5 * (rho * r) * (rho * r) / k
    if line == FIX_R:
        x, w = a, rho * r / (k * math.sqrt(1.0 + k))
        v = k * w
    else:
        x, v, w = a, 0.0, 0.0
    for i in range(times.size):
        b, c, s, low = 0.0, 0.0, 0.0, depth
        if i > 0 or line == FIX_R:
            b, c, s = rebound(v, w, k, coefficients)
            low = 0.0
        tau = times[i]
        out[i, 0], out[i, 1] = math.nan, math.nan
        if near[i] >= 0.0 or near[i] < 0.0:
            t = near[i]
            if t > 0.0:
                t = maximum(t, x, b, c, s)
            out[i, 0], out[i, 1] = t, gap(t, x, b, c, s, 1.0, quadrant(t))[0] - low
        else:
            steps = int(tau / 0.02) + 8
            if line == FIX_RP and i == 0 and 1.0 + a < 0.0:
                out[i, 0], out[i, 1] = 0.0, -low
            _, before, _, _, _ = gap(tau / steps, x, b, c, s, 1.0, quadrant(tau / steps))
            for j in range(2, steps + 1):
                t = tau * j / steps
                _, df, _, _, _ = gap(t, x, b, c, s, 1.0, quadrant(t))
                if before > 0.0 and df <= 0.0:
                    peak = maximum(t - 0.5 * tau / steps, x, b, c, s)
                    if not 0.0 < peak < tau * (1.0 + 1e-9):
                        peak = t
                    height = gap(peak, x, b, c, s, 1.0, quadrant(peak))[0] - low
                    if not height <= out[i, 1]:
                        out[i, 0], out[i, 1] = peak, height
                before = df
            if i == times.size - 1 and (period % 2 == 1 or line == FIX_RP):
                # the flight's apex
                f, _, ddf, _, _ = gap(tau, x, b, c, s, 1.0, quadrant(tau))
                if ddf < 0.0 and not f - low <= out[i, 1]:
                    out[i, 0], out[i, 1] = tau, f - low
        f, _, _, p, rate = gap(tau, x, b, c, s, 1.0, quadrant(tau))
        x, v, w = p, b + tau, max(rate, -(b + tau))


@jit
def landing(a, theta):
    """Return the state (x, v, w) at the end of a fall of length theta from an apex on Fix RP."""
    _, _, _, x, w = gap(theta, a, 0.0, 0.0, 0.0, 1.0, quadrant(theta))
    return x, theta, max(w, -theta)
