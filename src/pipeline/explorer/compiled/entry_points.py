"""Functions that the page calls in the compiled kernel.

They take doubles, 32-bit counts, and addresses of doubles in the module's memory. k, g and energies
are as in `pseudorigid.Ball`, and are not checked. A state is x, xdot, udot and one more double.
"""

from numba import carray, int64, types
from numba.extending import register_jitable

from pseudorigid.kernel import lanes, section
from pseudorigid.kernel.arithmetic import log, sincos
from pseudorigid.kernel.impact import (
    impact_coefficients,
    rebound,
    reflect,
    step,
    step_with_flight,
    tangent,
)
from pseudorigid.kernel.spectrum import push_frame, with_logarithms

_DOUBLE, _COUNT = types.float64, types.int32
_ARRAY, _ORDER = types.CPointer(types.float64), types.CPointer(types.int64)
for _formula in (
    *(section.radius_squared, section.start),
    *(section.contact_speed_squared, section.chart_state),
):
    register_jitable(_formula)


def history(state, k, g, impacts, keep, rows):
    """Advance a state; the fourth double gets tau. With keep = 1, write four rows of all impacts.

    With keep = 0, `rows` needs room for one impact.
    """
    coefficients = impact_coefficients(k)
    x, v, w, tau = state[0], state[1], state[2], 0.0
    row = keep * (impacts - 1) + 1
    for i in range(impacts):
        x, v, w, tau, _, _ = step(x, v, w, k, g, coefficients, None)
        at = keep * i
        rows[at], rows[row + at], rows[2 * row + at], rows[3 * row + at] = x, v, w, tau
    state[0], state[1], state[2], state[3] = x, v, w, tau


def history_in_lanes(memory, order, n, k, g, impacts):
    """Advance up to LANES orbits, whose x, xdot, udot and tau are the first rows of `memory`.

    `memory` has lanes.SIZE doubles, `order` room for LANES integers of 64 bits.
    """
    coefficients = impact_coefficients(k)
    rows, orbit = carray(memory, (lanes.SIZE,)), carray(order, (lanes.LANES,))
    for _ in range(impacts):
        lanes.advance(rows, orbit, int64(n), k, g, coefficients)


def follow(orbit, k, g, impacts, rows):
    """Advance an orbit with tangent vectors, and write five rows.

    The orbit has 24 doubles: the state and tau, a tangent vector (3) and the logarithm by which it
    was divided, the frame (9), lengths (3) and sums (3) of `push_frame`, and the sum of logarithms
    of the frame's first vector. The rows are x, xdot, udot and tau of each impact, and the
    logarithm of the tangent vector's length |.|_1.
    """
    coefficients = impact_coefficients(k)
    x, v, w, tau = orbit[0], orbit[1], orbit[2], orbit[3]
    dx, dv, dw, grown = orbit[4], orbit[5], orbit[6], orbit[7]
    a, b = (orbit[8], orbit[9], orbit[10]), (orbit[11], orbit[12], orbit[13])
    c, lengths = (orbit[14], orbit[15], orbit[16]), (orbit[17], orbit[18], orbit[19])
    sums = orbit[20], orbit[21], orbit[22]
    for i in range(impacts):
        after = step_with_flight(x, v, w, k, g, coefficients, None)
        x, v, w, tau, flight = after[0], after[1], after[2], after[3], after[4:9]
        dx, dv, dw = tangent(dx, dv, dw, k, g, coefficients, x, w, *flight)
        length = abs(dx) + abs(dv) + abs(dw)
        size = grown + log(length)
        if not 1e-50 < length < 1e50:
            dx, dv, dw, grown = dx / length, dv / length, dw / length, size
        a, b, c, lengths, sums = push_frame(
            a, b, c, lengths, sums, k, g, coefficients, x, w, *flight
        )
        rows[i], rows[impacts + i], rows[2 * impacts + i] = x, v, w
        rows[3 * impacts + i], rows[4 * impacts + i] = tau, size
    orbit[0], orbit[1], orbit[2], orbit[3] = x, v, w, tau
    orbit[4], orbit[5], orbit[6], orbit[7] = dx, dv, dw, grown
    orbit[8], orbit[9], orbit[10] = a
    orbit[11], orbit[12], orbit[13] = b
    orbit[14], orbit[15], orbit[16] = c
    orbit[17], orbit[18], orbit[19] = lengths
    orbit[20], orbit[21], orbit[22] = sums
    orbit[23], _, _ = with_logarithms(sums, lengths)


def chart_tangent(state, k, g, impacts, out):
    """Advance a state, and write the derivative in the chart (x, y), row by row, to `out`."""
    coefficients = impact_coefficients(k)
    x, v, w, tau = state[0], state[1], state[2], 0.0
    # Derivatives of s = v + w at fixed energy, and of the state, by x and by y.
    s, y = v + w, v - k * w
    by_x, by_y = (1.0 + k) * (g - k * x) / (k * s), -y / (k * s)
    a = 1.0, k * by_x / (1.0 + k), by_x / (1.0 + k)
    b = 0.0, (k * by_y + 1.0) / (1.0 + k), (by_y - 1.0) / (1.0 + k)
    for _ in range(impacts):
        after = step_with_flight(x, v, w, k, g, coefficients, None)
        x, v, w, tau, flight = after[0], after[1], after[2], after[3], after[4:9]
        a = tangent(*a, k, g, coefficients, x, w, *flight)
        b = tangent(*b, k, g, coefficients, x, w, *flight)
    state[0], state[1], state[2], state[3] = x, v, w, tau
    out[0], out[1], out[2], out[3] = a[0], b[0], a[1] - k * a[2], b[1] - k * b[2]


def after_impact(state, k):
    """Replace xdot and udot of a state by the velocities just after the impact, eq. (25)."""
    state[1], state[2], _ = rebound(state[1], state[2], k, impact_coefficients(k))


def reverse(state, k):
    """Replace a state by its image under the reversor."""
    x, v, w = state[0], state[1], state[2]
    state[0], state[1], state[2] = reflect(x, v, w, k, impact_coefficients(k))


def start(state, k, g, energy, fraction):
    """Write the state on y = 0 at a fraction of the section's radius, and the radius squared."""
    state[0], state[1], state[2] = section.start(k, g, energy, fraction)
    state[3] = section.radius_squared(k, g, energy)


def chart_state(state, k, g, energy, x, y):
    """Write the state at a point of the chart, and its contact speed squared."""
    state[0], state[1], state[2] = section.chart_state(k, g, energy, x, y)
    state[3] = section.contact_speed_squared(k, g, energy, x, y)


def elementary(values, n, rows):
    """Write sines, cosines and logarithms of n values: a table to compare processors by."""
    for i in range(n):
        rows[i], rows[n + i] = sincos(values[i])
        rows[2 * n + i] = log(values[i])


# Function -> the types of its arguments.
ENTRY_POINTS = {
    history: (_ARRAY, _DOUBLE, _DOUBLE, _COUNT, _COUNT, _ARRAY),
    history_in_lanes: (_ARRAY, _ORDER, _COUNT, _DOUBLE, _DOUBLE, _COUNT),
    follow: (_ARRAY, _DOUBLE, _DOUBLE, _COUNT, _ARRAY),
    chart_tangent: (_ARRAY, _DOUBLE, _DOUBLE, _COUNT, _ARRAY),
    after_impact: (_ARRAY, _DOUBLE),
    reverse: (_ARRAY, _DOUBLE),
    start: (_ARRAY, _DOUBLE, _DOUBLE, _DOUBLE, _DOUBLE),
    chart_state: (_ARRAY, _DOUBLE, _DOUBLE, _DOUBLE, _DOUBLE, _DOUBLE),
    elementary: (_ARRAY, _COUNT, _ARRAY),
}
