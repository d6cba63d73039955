"""Impact map, eqs. (25)-(28), and its Jacobian, eq. (33): one impact, and loops over impacts.

All functions are compiled. A state is (x, v, w), that is (x, xdot, udot) just before an impact, and
`coefficients` are `impact_coefficients` of k. `root_finder` selects, when a function is compiled,
how the next impact is found: None for `flight.first_impact`, (step, tolerance) in 1/omega for
`scanned_impact`. Loops return how many impacts the scan missed. The arrays x, v, w have the shape
(n,), and a loop gives each state the bits that it has alone.

The scan reads the paper's "variant of the bisection method", for which it gives no step, and serves
only for comparison. It can step over an impact; the ball then passes through the floor, and its
energy does not show it. Every flight is therefore also computed by `flight.first_impact`, and late
impacts are counted.
"""

import math

from . import formulas
from .arithmetic import quadrant, quarter_turns, sincos
from .compiled import jit
from .flight import first_impact

# Steps after which a scan gives up. A flight takes about 3 time units, or 3e7 steps of 1e-7.
MOST_SCAN_STEPS = 50_000_000
# Time beyond the tolerance by which a scan's impact is late if an earlier one was missed. Where the
# ball almost touches the floor, the first impact is only known to the root of a rounding, 1e-8.
_TOUCH = 1e-6

impact_coefficients = jit(formulas.impact_coefficients)
rebound = jit(formulas.rebound)


@jit
def _gap(t, x, b, c, g):
    """Return f(t), eq. (21), with its terms as in the paper."""
    sine, cosine = sincos(t)
    return (x + t * (b + 0.5 * g * t)) + (c * sine - x * cosine)


@jit
def scan(x, b, c, g, step, tolerance):
    """Find the next impact by steps and bisection, without a guarantee that it is the first.

    Bisection ends with a bracket no longer than the tolerance or of neighbouring doubles. Returns
    its middle and the evaluations of the gap. The time is NaN for input that is not finite, and if
    the gap keeps its sign over MOST_SCAN_STEPS steps.
    """
    if not abs(x) + abs(b) + abs(c) + g < math.inf:
        return math.nan, 0
    low = 0.0
    high = 0.0
    count = 0
    while True:
        count += 1
        high = count * step
        if _gap(high, x, b, c, g) > 0.0:
            break
        low = high
        if not count < MOST_SCAN_STEPS:
            return math.nan, count
    while high - low > tolerance:
        middle = 0.5 * (low + high)
        if middle in (low, high):
            break
        count += 1
        if _gap(middle, x, b, c, g) > 0.0:
            high = middle
        else:
            low = middle
    return 0.5 * (low + high), count


@jit
def scanned_impact(x, b, c, s, g, root_finder):
    """Return the scan's tau, position and udot, and 1 if it missed an earlier impact, else 0.

    `root_finder` is (step, tolerance) in 1/omega. Raises ArithmeticError if no impact is found.
    """
    step, tolerance = root_finder
    tau, count = scan(x, b, c, g, step, tolerance)
    if math.isnan(tau) and count:
        raise ArithmeticError("the scan for the next impact does not end")
    first, _, _, _ = first_impact(x, b, c, s, g)
    sine, cosine = sincos(tau)
    missed = 1 if tau > first + tolerance + _TOUCH else 0
    return tau, x * cosine - c * sine, x * sine + c * cosine, missed


@jit
def step(x, v, w, k, g, coefficients, root_finder):
    """Apply the map, eq. (28): return x, v, w, tau (1/omega), evaluations of the gap, misses."""
    b, c, s = rebound(v, w, k, coefficients)
    evaluations, missed = 0, 0
    if root_finder is None:
        tau, p, q, evaluations = first_impact(x, b, c, s, g)
    else:
        tau, p, q, missed = scanned_impact(x, b, c, s, g, root_finder)
    v = b + g * tau
    # max keeps the state on the section, w >= -v, despite rounding where the impact grazes.
    return p, v, max(q, -v), tau, evaluations, missed


@jit
def flight_derivatives(x, b, c, s, g, tau, trigonometry):
    """Return sine and cosine of a flight's time tau, and the derivatives of tau by x, s and c.

    From f = 0 these are -(1 - cos tau)/f', tau/f' and -(sin tau - tau)/f', where f' = v' + w' is
    the contact speed at the next impact. s = v + w and c are varied separately, so that nothing
    cancels where tau is small. `trigonometry` is `quadrant` of tau.
    """
    sine, cosine, sine_tail, cosine_tail, n = trigonometry
    cosine, sine = quarter_turns(cosine, sine, n)
    is_short = n == 0.0
    versine = 0.5 * tau * tau - cosine_tail if is_short else 1.0 - cosine
    speed_short = ((g + x) * tau - s) + (x * sine_tail - c * versine)
    speed_long = b + g * tau + (x * sine + c * cosine)
    speed = speed_short if is_short else speed_long
    tail = sine_tail if is_short else sine - tau
    return sine, cosine, -versine / speed, tau / speed, -tail / speed


@jit
def tangent(dx, dv, dw, k, g, coefficients, p, q, sine, cosine, tau_x, tau_s, tau_c):
    """Return J (dx, dv, dw), eq. (33): a tangent vector after one impact and flight.

    p and q are position and udot just before the next impact; the last five arguments come from
    `flight_derivatives`.
    """
    db, dc, ds = rebound(dv, dw, k, coefficients)
    dtau = tau_x * dx + tau_s * ds + tau_c * dc
    return (
        cosine * dx - sine * dc - q * dtau,
        db + g * dtau,
        sine * dx + cosine * dc + p * dtau,
    )


@jit
def step_with_flight(x, v, w, k, g, coefficients, root_finder):
    """Apply `step`; return x, v, w, tau, the results of `flight_derivatives`, impacts missed."""
    b, c, s = rebound(v, w, k, coefficients)
    p, v, q, tau, _, missed = step(x, v, w, k, g, coefficients, root_finder)
    sine, cosine, tau_x, tau_s, tau_c = flight_derivatives(x, b, c, s, g, tau, quadrant(tau))
    return p, v, q, tau, sine, cosine, tau_x, tau_s, tau_c, missed


@jit
def iterate(x, v, w, k, g, impacts, tau, out, root_finder):
    """Advance states by `impacts` in place.

    `tau` (n,) receives the times of the last flights, and `out` (n, impacts, 4), unless it is
    empty, x, v, w and tau of every impact.
    """
    coefficients = impact_coefficients(k)
    missed = 0
    for i in range(x.size):
        xi, vi, wi, t = x[i], v[i], w[i], tau[i]
        for j in range(impacts):
            xi, vi, wi, t, _, missed_one = step(xi, vi, wi, k, g, coefficients, root_finder)
            missed += missed_one
            if out.size > 0:
                out[i, j, 0], out[i, j, 1], out[i, j, 2], out[i, j, 3] = xi, vi, wi, t
        x[i], v[i], w[i], tau[i] = xi, vi, wi, t
    return missed


@jit
def reflect(x, v, w, k, coefficients):
    """Apply the reversor R: reverse the velocities after the impact. R F R is the inverse of F."""
    b, c, _ = rebound(v, w, k, coefficients)
    return x, -b, max(-c, b)  # max as in `step`


@jit
def jacobians(x, v, w, k, g, impacts, out, root_finder):
    """Write the Jacobian of the iterated map at each state, eq. (33), to out (n, 3, 3)."""
    coefficients = impact_coefficients(k)
    missed = 0
    for i in range(x.size):
        xi, vi, wi = x[i], v[i], w[i]
        for m in range(3):
            for j in range(3):
                out[i, m, j] = 1.0 if m == j else 0.0
        for _ in range(impacts):
            xi, vi, wi, _, sine, cosine, tau_x, tau_s, tau_c, missed_one = step_with_flight(
                xi, vi, wi, k, g, coefficients, root_finder
            )
            missed += missed_one
            for j in range(3):
                out[i, 0, j], out[i, 1, j], out[i, 2, j] = tangent(
                    out[i, 0, j], out[i, 1, j], out[i, 2, j],
                    k, g, coefficients, xi, wi, sine, cosine, tau_x, tau_s, tau_c,
                )  # fmt: skip
    return missed
