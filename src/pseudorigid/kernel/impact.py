"""The impact map, eqs. (25)-(28), and its Jacobian, eq. (33): one step, and loops over it.

Everything here is compiled. A state is (x, v, w), that is (x, xdot, udot) just before an impact,
and a loop gives each state the bits it would have alone. `root_finder` says
how the next impact is found: None by the certified march of `flight`, (step, tolerance) by the scan
of `scan`; it is decided when a function is compiled. Loops return how many impacts a scan flew
past, 0 for the march.
"""

from . import impact_law
from .arithmetic import quadrant, quarter_turns
from .compiled import jit
from .flight import first_impact
from .scan import scanned_impact

impact_coefficients = jit(impact_law.impact_coefficients)
rebound = jit(impact_law.rebound)


@jit
def next_impact(x, b, c, s, g, root_finder):
    """The flight after an impact, by the march or by the scan.

    Parameters
    ----------
    x, b, c, s, g : float
        As for `flight.first_impact`.
    root_finder : None or (float, float)

    Returns
    -------
    tau, p, q : float
        Time of flight, position and udot at its end.
    evaluations : int
        Of the gap, by the march.
    missed : int
        1 where the scan flew past an impact.
    """
    if root_finder is None:
        tau, p, q, evaluations = first_impact(x, b, c, s, g)
        return tau, p, q, evaluations, 0
    tau, p, q, missed = scanned_impact(x, b, c, s, g, root_finder)
    return tau, p, q, 0, missed


@jit
def step(x, v, w, k, g, coefficients, root_finder):
    """The impact map, eq. (28): one impact and the flight after it.

    Parameters
    ----------
    x, v, w : float
        State just before the impact: position (R), xdot (R omega), udot (omega).
    k, g : float
        The ball.
    coefficients : float
        `impact_coefficients` of k.
    root_finder : None or (float, float)

    Returns
    -------
    x, v, w : float
        The state just before the next impact.
    tau : float
        The flight's time (1/omega).
    evaluations, missed : int
        As from `next_impact`.
    """
    b, c, s = rebound(v, w, k, coefficients)
    tau, p, q, evaluations, missed = next_impact(x, b, c, s, g, root_finder)
    v = b + g * tau
    # on the section to the last bit, also where the impact grazes
    return p, v, max(q, -v), tau, evaluations, missed


@jit
def flight_derivatives(x, b, c, s, g, tau, trigonometry):
    """Sine and cosine of a flight's time, and how it depends on the flight's beginning.

    s = v + w and c are varied separately: so nothing cancels where tau is small.

    Parameters
    ----------
    x, b, c, s, g : float
        As for `flight.first_impact`.
    tau : float
        The flight's time (1/omega).
    trigonometry : tuple
        `quadrant` of tau.

    Returns
    -------
    sine, cosine : float
        Of tau.
    tau_x, tau_s, tau_c : float
        Derivatives from f = 0: -(1 - cos tau)/f', tau/f' and -(sin tau - tau)/f', where f' is the
        speed v' + w' of the next impact.
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
    """A tangent vector carried over one impact and flight: J times (dx, dv, dw), eq. (33).

    Parameters
    ----------
    dx, dv, dw : float
        The vector at the state before.
    k, g : float
        The ball.
    coefficients : float
        `impact_coefficients` of k.
    p, q : float
        Position and udot just before the next impact.
    sine, cosine, tau_x, tau_s, tau_c : float
        As from `flight_derivatives`.

    Returns
    -------
    dx, dv, dw : float
        The vector at the next state.
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
    """One `step`, and what `tangent` needs to carry vectors along with it.

    Parameters
    ----------
    x, v, w, k, g, coefficients, root_finder
        As for `step`.

    Returns
    -------
    x, v, w, tau : float
        The state just before the next impact, and the flight's time.
    sine, cosine, tau_x, tau_s, tau_c : float
        As from `flight_derivatives`.
    missed : int
    """
    b, c, s = rebound(v, w, k, coefficients)
    p, v, q, tau, _, missed = step(x, v, w, k, g, coefficients, root_finder)
    sine, cosine, tau_x, tau_s, tau_c = flight_derivatives(x, b, c, s, g, tau, quadrant(tau))
    return p, v, q, tau, sine, cosine, tau_x, tau_s, tau_c, missed


@jit
def steps(x, v, w, k, g, impacts, tau, root_finder):
    """Advance states by a number of impacts, in place.

    Parameters
    ----------
    x, v, w : ndarray, shape (n,)
        States just before an impact; overwritten.
    k, g : float
        The ball.
    impacts : int
        At least 0.
    tau : ndarray, shape (n,)
        The last flights' times are written here.
    root_finder : None or (float, float)

    Returns
    -------
    int
        Impacts missed.
    """
    coefficients = impact_coefficients(k)
    missed = 0
    for i in range(x.size):
        a, b, c, t = x[i], v[i], w[i], tau[i]
        for _ in range(impacts):
            a, b, c, t, _, late = step(a, b, c, k, g, coefficients, root_finder)
            missed += late
        x[i], v[i], w[i], tau[i] = a, b, c, t
    return missed


@jit
def steps_back(x, v, w, k, g, impacts, tau, root_finder):
    """`steps` towards the past: F^-1 = R F R, where R reverses the velocities after an impact.

    Parameters
    ----------
    x, v, w, k, g, impacts, tau, root_finder
        As for `steps`; tau are the flights from the states reached to those after them.

    Returns
    -------
    int
        Impacts missed.
    """
    coefficients = impact_coefficients(k)
    missed = 0
    for i in range(x.size):
        a, b, c, t = x[i], v[i], w[i], tau[i]
        for _ in range(impacts):
            t, p, q, _, late = next_impact(a, -b, -c, b + c, g, root_finder)
            b, c, _ = rebound(g * t - b, q, k, coefficients)
            a, b, c = p, -b, max(-c, b)  # as in `step`
            missed += late
        x[i], v[i], w[i], tau[i] = a, b, c, t
    return missed


@jit
def history(x, v, w, k, g, out, root_finder):
    """`steps` with every impact kept.

    Parameters
    ----------
    x, v, w : ndarray, shape (n,)
        States just before an impact; overwritten by the last ones.
    k, g : float
        The ball.
    out : ndarray, shape (n, impacts, 4)
        x, v, w and tau of every impact, the start excluded, are written here.
    root_finder : None or (float, float)

    Returns
    -------
    int
        Impacts missed.
    """
    coefficients = impact_coefficients(k)
    missed = 0
    for i in range(x.size):
        a, b, c = x[i], v[i], w[i]
        for j in range(out.shape[1]):
            a, b, c, t, _, late = step(a, b, c, k, g, coefficients, root_finder)
            out[i, j, 0], out[i, j, 1], out[i, j, 2], out[i, j, 3] = a, b, c, t
            missed += late
        x[i], v[i], w[i] = a, b, c
    return missed


@jit
def jacobians(x, v, w, k, g, impacts, out, root_finder):
    """The Jacobian of the map's iterate at each state, eq. (33), by the chain rule.

    Parameters
    ----------
    x, v, w : ndarray, shape (n,)
        States just before an impact.
    k, g : float
        The ball.
    impacts : int
        Of the iterate.
    out : ndarray, shape (n, 3, 3)
        Row i, column j: the derivative of the i-th new variable by the j-th old one.
    root_finder : None or (float, float)

    Returns
    -------
    int
        Impacts missed.
    """
    coefficients = impact_coefficients(k)
    missed = 0
    for i in range(x.size):
        a, b, c = x[i], v[i], w[i]
        for m in range(3):
            for j in range(3):
                out[i, m, j] = 1.0 if m == j else 0.0
        for _ in range(impacts):
            a, b, c, _, sine, cosine, tau_x, tau_s, tau_c, late = step_with_flight(
                a, b, c, k, g, coefficients, root_finder
            )
            missed += late
            for j in range(3):
                out[i, 0, j], out[i, 1, j], out[i, 2, j] = tangent(
                    out[i, 0, j], out[i, 1, j], out[i, 2, j],
                    k, g, coefficients, a, c, sine, cosine, tau_x, tau_s, tau_c,
                )  # fmt: skip
    return missed
