"""Impact map, eqs. (25)-(28), and its Jacobian, eq. (33): one impact, and loops over impacts.

All functions are compiled. A state is (x, v, w), that is (x, xdot, udot) just before an impact, and
`coefficients` are `impact_coefficients` of k. `root_finder` selects, when a function is compiled,
how the next impact is found: None for `flight.first_impact`, (step, tolerance) in 1/omega for
`scan.scanned_impact`. Loops return how many impacts the scan missed. The arrays x, v, w have the
shape (n,), and a loop gives each state the bits that it has alone.
"""

from . import impact_law
from .arithmetic import quadrant, quarter_turns
from .compiled import jit
from .flight import first_impact
from .scan import scanned_impact

impact_coefficients = jit(impact_law.impact_coefficients)
rebound = jit(impact_law.rebound)


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
    near = n == 0.0
    versine = 0.5 * tau * tau - cosine_tail if near else 1.0 - cosine
    speed_near = ((g + x) * tau - s) + (x * sine_tail - c * versine)
    speed_far = b + g * tau + (x * sine + c * cosine)
    speed = speed_near if near else speed_far
    tail = sine_tail if near else sine - tau
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
def steps(x, v, w, k, g, impacts, tau, out, root_finder):
    """Advance states by `impacts` in place.

    `tau` (n,) receives the times of the last flights, and `out` (n, impacts, 4), unless it is
    empty, x, v, w and tau of every impact.
    """
    coefficients = impact_coefficients(k)
    missed = 0
    for i in range(x.size):
        xi, vi, wi, t = x[i], v[i], w[i], tau[i]
        for j in range(impacts):
            xi, vi, wi, t, _, late = step(xi, vi, wi, k, g, coefficients, root_finder)
            missed += late
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
            xi, vi, wi, _, sine, cosine, tau_x, tau_s, tau_c, late = step_with_flight(
                xi, vi, wi, k, g, coefficients, root_finder
            )
            missed += late
            for j in range(3):
                out[i, 0, j], out[i, 1, j], out[i, 2, j] = tangent(
                    out[i, 0, j], out[i, 1, j], out[i, 2, j],
                    k, g, coefficients, xi, wi, sine, cosine, tau_x, tau_s, tau_c,
                )  # fmt: skip
    return missed
