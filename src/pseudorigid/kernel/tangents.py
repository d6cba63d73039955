"""Tangent vectors along many orbits at once.

Impacts are processed in chunks: first the orbits advance, then the derivatives of all flights of
the chunk are computed, and then the vectors are carried from impact to impact. The loops run over
rows of flat arrays, which LLVM vectorises, and call the functions of `impact`, so that each orbit
has the bits that it has alone.
"""

import numpy as np

from . import lanes
from .arithmetic import narrow_quadrant
from .compiled import jit
from .impact import flight_derivatives, impact_coefficients, rebound, steps, tangent

# Impacts in a chunk and orbits in a group; the buffers then fit into the processor's cache.
CHUNK = 32
GROUP = lanes.LANES
# Offsets of blocks of rows; a row has GROUP numbers, one for each orbit. Blocks of states have a
# row from before the chunk and one for each impact, blocks of flights only the latter.
X, V, W, TAU = (i * (CHUNK + 1) * GROUP for i in range(4))
SINE, COSINE, TAU_X, TAU_S, TAU_C = (i * CHUNK * GROUP for i in range(5))


@jit
def allocate_buffers():
    """Return the flat arrays of states and of flights that `advance_chunk` fills."""
    return np.empty(4 * (CHUNK + 1) * GROUP), np.empty(5 * CHUNK * GROUP)


@jit
def advance_chunk(x, v, w, k, g, impacts, states, flights, root_finder):
    """Advance orbits by up to CHUNK impacts in place, fill the buffers, count missed impacts."""
    n = x.size
    states[X : X + n], states[V : V + n], states[W : W + n] = x, v, w
    rows = states.reshape(4, CHUNK + 1, GROUP)
    out = rows[:, 1 : impacts + 1, :n].transpose(2, 1, 0)
    missed = 0
    if root_finder is None and n >= lanes.MIN_ORBITS_FOR_LANES:
        lanes.steps(x, v, w, k, g, impacts, np.empty(n), out)
    else:
        missed = steps(x, v, w, k, g, impacts, np.empty(n), out, root_finder)
    coefficients = impact_coefficients(k)
    for j in range(impacts):
        _derive(states, flights, j * GROUP, n, k, g, coefficients)
    return missed


@jit
def _derive(states, flights, row, n, k, g, coefficients):
    """Compute the derivatives of a row of flights."""
    row = max(row, 0)  # LLVM vectorises the loop only if no index can be negative
    for i in range(n):
        at = row + i
        b, c, s = rebound(states[V + at], states[W + at], k, coefficients)
        tau = states[TAU + GROUP + at]
        flight = flight_derivatives(states[X + at], b, c, s, g, tau, narrow_quadrant(tau))
        flights[SINE + at], flights[COSINE + at] = flight[0], flight[1]
        flights[TAU_X + at], flights[TAU_S + at], flights[TAU_C + at] = flight[2:]


@jit
def push_tangent(dx, dv, dw, k, g, coefficients, states, flights, at):
    """Return a tangent vector of one orbit after one impact of a chunk.

    `at` is j GROUP + i for orbit i and impact j of the chunk, from 0; `states` and `flights` are as
    `advance_chunk` filled them, `coefficients` as in `impact`.
    """
    return tangent(
        dx, dv, dw, k, g, coefficients, states[X + GROUP + at], states[W + GROUP + at],
        flights[SINE + at], flights[COSINE + at],
        flights[TAU_X + at], flights[TAU_S + at], flights[TAU_C + at],
    )  # fmt: skip
