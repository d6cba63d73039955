"""Tangent vectors carried along many orbits at once.

A stretch of impacts at a time: first the orbits, in lanes or one after the other; then, for all
flights of the stretch, what a tangent vector needs of them; then the vectors, impact by impact.
The loops are plain ones over the rows of flat arrays, which the compiler turns into vector
instructions, and call the functions of `impact`: so the bits are those that each orbit has alone.
"""

import numpy as np

from . import lanes
from .arithmetic import WIDE, narrow_quadrant, quadrant
from .compiled import jit
from .impact import flight_derivatives, history, impact_coefficients, rebound, tangent

# Impacts of a stretch, and orbits that are followed together: what is kept of them fits into the
# processor's own memory.
CHUNK = 32
GROUP = 256
# Rows of GROUP numbers, one an orbit. Of the states: x, v, w before each impact, and the time of
# the flight that led there, the first row of each from before the stretch. Of the flights: what
# `flight_derivatives` returns.
X, V, W, TAU = (i * (CHUNK + 1) * GROUP for i in range(4))
SINE, COSINE, TAU_X, TAU_S, TAU_C = (i * CHUNK * GROUP for i in range(5))


@jit
def allocate_buffers():
    """The arrays that `advance_chunk` fills.

    Returns
    -------
    states : ndarray, shape (4 (STRETCH + 1) GROUP,)
        Rows of GROUP orbits: of each of X, V, W and TAU that before the stretch, then one an
        impact.
    flights : ndarray, shape (5 STRETCH GROUP,)
        Rows of GROUP orbits: of each number from `flight_derivatives` one an impact.
    """
    return np.empty(4 * (CHUNK + 1) * GROUP), np.empty(5 * CHUNK * GROUP)


@jit
def advance_chunk(x, v, w, k, g, impacts, states, flights, root_finder):
    """Advance orbits by a few impacts, and keep what tangent vectors need.

    Parameters
    ----------
    x, v, w : ndarray, shape (n,)
        States just before an impact, n <= GROUP; overwritten by the last ones.
    k, g : float
        The ball.
    impacts : int
        At most STRETCH.
    states, flights : ndarray
        From `allocate_buffers`; overwritten.
    root_finder : None or (float, float)
        As in `impact`.

    Returns
    -------
    int
        Impacts missed.
    """
    n = x.size
    states[X : X + n], states[V : V + n], states[W : W + n] = x, v, w
    rows = states.reshape(4, CHUNK + 1, GROUP)
    out = rows[:, 1 : impacts + 1, :n].transpose(2, 1, 0)
    missed = 0
    if root_finder is None:
        if n < lanes.MIN_ORBITS_FOR_LANES:
            history(x, v, w, k, g, out, None)
        else:
            lanes.steps(x, v, w, k, g, impacts, np.empty(n), out)
    else:
        missed = history(x, v, w, k, g, out, root_finder)
    coefficients = impact_coefficients(k)
    for j in range(impacts):
        if not _derive(states, flights, j * GROUP, n, k, g, coefficients):
            _derive_wide(states, flights, j * GROUP, n, k, g, coefficients)
    return missed


@jit
def _derive(states, flights, row, n, k, g, coefficients):
    """`flight_derivatives` of a row of flights; whether none is too long, or NaN, for that."""
    wide = 0
    row = max(row, 0)  # where an index may be negative, no vector instructions come of a loop
    for i in range(n):
        at = row + i
        b, c, s = rebound(states[V + at], states[W + at], k, coefficients)
        tau = states[TAU + GROUP + at]
        found = flight_derivatives(states[X + at], b, c, s, g, tau, narrow_quadrant(tau))
        flights[SINE + at], flights[COSINE + at] = found[0], found[1]
        flights[TAU_X + at], flights[TAU_S + at], flights[TAU_C + at] = found[2], found[3], found[4]
        wide += 0 if tau < WIDE else 1
    return wide == 0


@jit
def _derive_wide(states, flights, row, n, k, g, coefficients):
    for i in range(row, row + n):
        tau = states[TAU + GROUP + i]
        if not tau < WIDE:
            b, c, s = rebound(states[V + i], states[W + i], k, coefficients)
            found = flight_derivatives(states[X + i], b, c, s, g, tau, quadrant(tau))
            flights[SINE + i], flights[COSINE + i] = found[0], found[1]
            flights[TAU_X + i], flights[TAU_S + i], flights[TAU_C + i] = found[2:]


@jit
def push_tangent(dx, dv, dw, k, g, coefficients, states, flights, at):
    """A tangent vector of one orbit carried over one impact of a stretch.

    Parameters
    ----------
    dx, dv, dw : float
        The vector.
    k, g, coefficients : float
        The ball, and `impact_coefficients` of k.
    states, flights : ndarray
        As `advance_chunk` filled them.
    at : int
        j GROUP + i for orbit i and impact j of the stretch, from 0.

    Returns
    -------
    dx, dv, dw : float
    """
    return tangent(
        dx, dv, dw, k, g, coefficients, states[X + GROUP + at], states[W + GROUP + at],
        flights[SINE + at], flights[COSINE + at],
        flights[TAU_X + at], flights[TAU_S + at], flights[TAU_C + at],
    )  # fmt: skip
