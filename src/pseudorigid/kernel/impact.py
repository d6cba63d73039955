"""The impact map, eqs. (25)-(28), and its Jacobian, eq. (33): one step, and loops over it.

Everything here is compiled. A state is (x, v, w), that is (x, xdot, udot) just before an impact,
and a loop gives each state the bits it would have alone. `how` says how the next impact is found:
None by the certified march of `flight`, (step, tolerance) by the scan of `scan`; it is decided when
a function is compiled. Loops return how many impacts a scan flew past, 0 for the march.
"""

from . import law
from .arithmetic import quadrant, quarter_turns
from .compiled import jit
from .flight import first_impact
from .scan import scanned_impact

transfer = jit(law.transfer)
rebound = jit(law.rebound)


@jit
def next_impact(x, b, c, s, g, how):
    """The flight from x with velocities b, c, s = -(b + c): (tau, P, Q, evaluations, missed).

    evaluations: evaluations of the gap by the march; missed: 1 where the scan flew past an impact.
    """
    if how is None:
        tau, p, q, evaluations = first_impact(x, b, c, s, g)
        return tau, p, q, evaluations, 0
    tau, p, q, missed = scanned_impact(x, b, c, s, g, how)
    return tau, p, q, 0, missed


@jit
def step(x, v, w, k, g, head, low, how):
    """(x', v', w', tau, evaluations, missed): the state just before the next impact, eq. (28)."""
    b, c, s = rebound(v, w, k, head, low)
    tau, p, q, evaluations, missed = next_impact(x, b, c, s, g, how)
    v = b + g * tau
    # on the section to the last bit, also where the impact grazes
    return p, v, max(q, -v), tau, evaluations, missed


@jit
def flight_derivatives(x, b, c, s, g, tau, trigonometry):
    """sin tau, cos tau, and the derivatives of tau by x, s and c, from f = 0.

    tau_x = -(1 - cos tau)/f', tau_s = tau/f', tau_c = -(sin tau - tau)/f', where s = v + w and c
    are varied separately: so nothing cancels where tau is small. f' is the speed v' + w' of the
    impact. `trigonometry` is `quadrant` of tau.
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
def tangent(dx, dv, dw, k, g, head, low, p, q, sine, cosine, tau_x, tau_s, tau_c):
    """A tangent vector carried over one impact and flight: J times (dx, dv, dw)."""
    db, dc, ds = rebound(dv, dw, k, head, low)
    dtau = tau_x * dx + tau_s * ds + tau_c * dc
    return (
        cosine * dx - sine * dc - q * dtau,
        db + g * dtau,
        sine * dx + cosine * dc + p * dtau,
    )


@jit
def step_with_flight(x, v, w, k, g, head, low, how):
    """One step, what `tangent` needs to carry vectors along with it, and missed."""
    b, c, s = rebound(v, w, k, head, low)
    p, v, q, tau, _, missed = step(x, v, w, k, g, head, low, how)
    sine, cosine, tau_x, tau_s, tau_c = flight_derivatives(x, b, c, s, g, tau, quadrant(tau))
    return p, v, q, tau, sine, cosine, tau_x, tau_s, tau_c, missed


@jit
def steps(x, v, w, k, g, impacts, tau, how):
    """Advance the states x, v, w (n,) in place by `impacts`; tau (n,) is the last flight's."""
    head, low = transfer(k)
    missed = 0
    for i in range(x.size):
        a, b, c, t = x[i], v[i], w[i], tau[i]
        for _ in range(impacts):
            a, b, c, t, _, late = step(a, b, c, k, g, head, low, how)
            missed += late
        x[i], v[i], w[i], tau[i] = a, b, c, t
    return missed


@jit
def steps_back(x, v, w, k, g, impacts, tau, how):
    """`steps` towards the past: F^-1 = R F R, where R reverses the velocities after an impact."""
    head, low = transfer(k)
    missed = 0
    for i in range(x.size):
        a, b, c, t = x[i], v[i], w[i], tau[i]
        for _ in range(impacts):
            t, p, q, _, late = next_impact(a, -b, -c, b + c, g, how)
            b, c, _ = rebound(g * t - b, q, k, head, low)
            a, b, c = p, -b, max(-c, b)  # as in `step`
            missed += late
        x[i], v[i], w[i], tau[i] = a, b, c, t
    return missed


@jit
def history(x, v, w, k, g, out, how):
    """The same with every impact kept: out (n, impacts, 4) holds x, v, w and tau."""
    head, low = transfer(k)
    missed = 0
    for i in range(x.size):
        a, b, c = x[i], v[i], w[i]
        for j in range(out.shape[1]):
            a, b, c, t, _, late = step(a, b, c, k, g, head, low, how)
            out[i, j, 0], out[i, j, 1], out[i, j, 2], out[i, j, 3] = a, b, c, t
            missed += late
        x[i], v[i], w[i] = a, b, c
    return missed


@jit
def jacobians(x, v, w, k, g, impacts, out, how):
    """The Jacobian of `impacts` impacts at each state (n,), by the chain rule: out (n, 3, 3)."""
    head, low = transfer(k)
    missed = 0
    for i in range(x.size):
        a, b, c = x[i], v[i], w[i]
        for m in range(3):
            for j in range(3):
                out[i, m, j] = 1.0 if m == j else 0.0
        for _ in range(impacts):
            a, b, c, _, sine, cosine, tau_x, tau_s, tau_c, late = step_with_flight(
                a, b, c, k, g, head, low, how
            )
            missed += late
            for j in range(3):
                out[i, 0, j], out[i, 1, j], out[i, 2, j] = tangent(
                    out[i, 0, j], out[i, 1, j], out[i, 2, j],
                    k, g, head, low, a, c, sine, cosine, tau_x, tau_s, tau_c,
                )  # fmt: skip
    return missed
