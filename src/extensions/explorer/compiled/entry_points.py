"""Functions that the page calls in the compiled kernel: the kernel's own, and loops over impacts.

They take doubles, 32-bit counts, and addresses in the module's memory. k, g and energies are as in
`pseudorigid.Ball`, and are not checked.
"""

import math

from numba import carray, int64  # type: ignore[attr-defined] # numba marks no exports
from numba.extending import register_jitable

from pseudorigid.kernel import arithmetic, formulas, impact, lanes, spectrum, tangents

for _formula in (formulas.radius_squared, formulas.contact_speed_squared, formulas.chart_state):
    register_jitable(_formula)  # the states on the section call them

# Rows of `follow_in_lanes` after those of `lanes.advance`, as kernel_api.js reads them: the state
# before the impact; a unit vector (in _A), the product of its lengths since their logarithms were
# last added to a sum, and that sum; the place relative to the fixed point, the turns around it so
# far, their weighted sum, and the impact that ends the first whole turn; and the sum of G.
_X0, _V0, _W0, _A, _B, _C, _LENGTH, _SUM, _P, _Q, _TURNED, _WEIGHTED, _WHOLE, _GROWN = (
    lanes.SIZE + i * lanes.LANES for i in range(14)
)
_ROWS = lanes.SIZE + 14 * lanes.LANES
_bump = register_jitable(tangents.bump)


def history(x, v, w, k, g, impacts, rows):
    """Write four rows of all impacts, x, xdot, udot and tau, and return the last of each."""
    coefficients, tau = impact.impact_coefficients(k), 0.0
    for i in range(impacts):
        x, v, w, tau, _, _ = impact.step(x, v, w, k, g, coefficients, None)
        rows[i], rows[impacts + i], rows[2 * impacts + i], rows[3 * impacts + i] = x, v, w, tau
    return x, v, w, tau


def history_in_lanes(memory, order, n, k, g, impacts):
    """Advance up to LANES orbits, whose x, xdot, udot and tau are the first rows of `memory`.

    `memory` has lanes.SIZE doubles, `order` room for LANES integers of 64 bits.
    """
    coefficients = impact.impact_coefficients(k)
    rows, orbit = carray(memory, (lanes.SIZE,)), carray(order, (lanes.LANES,))
    for _ in range(impacts):
        lanes.advance(rows, orbit, int64(n), k, g, coefficients)


@register_jitable
def _carried(rows, n, k, g, coefficients):
    """Carry the unit vectors of n orbits over an impact; return how many products are extreme."""
    for i in range(n):
        b, c, s = impact.rebound(rows[_V0 + i], rows[_W0 + i], k, coefficients)
        tau = rows[lanes.TAU + i]
        quadrant = arithmetic.narrow_quadrant(tau)
        flight = impact.flight_derivatives(rows[_X0 + i], b, c, s, g, tau, quadrant)
        vector = rows[_A + i], rows[_B + i], rows[_C + i]
        x, w = rows[lanes.X + i], rows[lanes.W + i]
        vector = impact.tangent(*vector, k, g, coefficients, x, w, *flight)
        rows[_A + i], rows[_B + i], rows[_C + i] = vector
    extremes = 0
    for i in range(n):
        length, a, b, c = spectrum.normalized(rows[_A + i], rows[_B + i], rows[_C + i])
        rows[_A + i], rows[_B + i], rows[_C + i] = a, b, c
        length = rows[_LENGTH + i] * length
        rows[_LENGTH + i] = length
        rows[_GROWN + i] += rows[_SUM + i] + arithmetic.narrow_log(length)
        extremes += 0 if spectrum.in_range(length) else 1
    return extremes


def follow_in_lanes(memory, order, n, k, g, centre, expected, start, stop, length):
    """Follow up to LANES orbits over impacts `start` to `stop`, with a vector and with turns.

    `memory` has _ROWS doubles, `order` room for LANES integers. G is the logarithm of the vector's
    length, of which _GROWN receives the sum over these impacts. Turns around the point (centre, 0),
    each within half a turn of `expected`, have the weights of a window of `length` impacts.
    """
    coefficients, round_y = impact.impact_coefficients(k), 1.0 / math.sqrt(k * (1.0 + k))
    rows, orbit = carray(memory, (_ROWS,)), carray(order, (lanes.LANES,))
    count = int64(n)
    for i in range(count):
        rows[_GROWN + i] = 0.0
    for done in range(start, stop):
        for i in range(count):
            rows[_X0 + i], rows[_V0 + i] = rows[lanes.X + i], rows[lanes.V + i]
            rows[_W0 + i] = rows[lanes.W + i]
        lanes.advance(rows, orbit, count, k, g, coefficients)
        if _carried(rows, count, k, g, coefficients) > 0:
            for i in range(count):
                if not spectrum.in_range(rows[_LENGTH + i]):
                    rows[_SUM + i] += arithmetic.log(rows[_LENGTH + i])
                    rows[_LENGTH + i] = 1.0
        share, whole = _bump(done, length) if done < length else 0.0, done + 1.0
        for i in range(count):
            p, q = rows[lanes.X + i] - centre, rows[lanes.V + i] - k * rows[lanes.W + i]
            q = round_y * q
            turn = tangents.turn_between(rows[_P + i], rows[_Q + i], p, q, expected)
            turned = rows[_TURNED + i] + turn
            first = min(rows[_WHOLE + i], whole)
            rows[_P + i], rows[_Q + i], rows[_TURNED + i] = p, q, turned
            rows[_WEIGHTED + i] += share * turn
            rows[_WHOLE + i] = first if abs(turned) >= 1.0 else rows[_WHOLE + i]


def follow(orbit, k, g, impacts, rows):
    """Advance an orbit with tangent vectors, and write five rows.

    The orbit is eight triples of doubles: the state; a tangent vector; the three of the frame; its
    lengths and sums of `push_frame`; and at last tau, the logarithm by which the tangent vector was
    divided, and the sum of logarithms of the frame's first vector. The rows are x, xdot, udot and
    tau of each impact, and the logarithm of the tangent vector's length |.|_1.
    """
    coefficients = impact.impact_coefficients(k)
    (x, v, w), (dx, dv, dw), (tau, grown, _) = orbit[0][0], orbit[0][1], orbit[0][7]
    frame = orbit[0][2:7]
    for i in range(impacts):
        after = impact.step_with_flight(x, v, w, k, g, coefficients, None)
        (x, v, w, tau), flight = after[:4], after[4:9]
        dx, dv, dw = impact.tangent(dx, dv, dw, k, g, coefficients, x, w, *flight)
        length = abs(dx) + abs(dv) + abs(dw)
        size = grown + arithmetic.log(length)
        if not 1e-50 < length < 1e50:
            dx, dv, dw, grown = dx / length, dv / length, dw / length, size
        frame = spectrum.push_frame(*frame, k, g, coefficients, x, w, *flight)
        rows[i], rows[impacts + i], rows[2 * impacts + i] = x, v, w
        rows[3 * impacts + i], rows[4 * impacts + i] = tau, size
    first = spectrum.with_logarithms(frame[4], frame[3])[0]
    orbit[0] = ((x, v, w), (dx, dv, dw), *frame, (tau, grown, first))


@register_jitable
def advanced(x, v, w, k, g, impacts):
    """Return the point (x, y) after some impacts, and the derivative by the first one, by rows."""
    coefficients = impact.impact_coefficients(k)
    # Derivatives of s = v + w at fixed energy, and of the state, by x and by y.
    s, y = v + w, v - k * w
    by_x, by_y = (1.0 + k) * (g - k * x) / (k * s), -y / (k * s)
    a = 1.0, k * by_x / (1.0 + k), by_x / (1.0 + k)
    b = 0.0, (k * by_y + 1.0) / (1.0 + k), (by_y - 1.0) / (1.0 + k)
    for _ in range(impacts):
        after = impact.step_with_flight(x, v, w, k, g, coefficients, None)
        (x, v, w), flight = after[:3], after[4:9]
        a = impact.tangent(*a, k, g, coefficients, x, w, *flight)
        b = impact.tangent(*b, k, g, coefficients, x, w, *flight)
    return x, v - k * w, a[0], b[0], a[1] - k * a[2], b[1] - k * b[2]


def chart_tangent(x, v, w, k, g, impacts):
    """Return the derivative of the iterated map in the chart (x, y), row by row."""
    return advanced(x, v, w, k, g, impacts)[2:]


def newton(x, y, k, g, energy, period, steps):
    """Return the point that Newton steps towards P^n z = z reach, and x and y of the last step."""
    across = up = 0.0
    for _ in range(steps):
        _, v, w = formulas.chart_state(k, g, energy, x, y)
        p, q, a, b, c, d = advanced(x, v, w, k, g, period)
        p, q, a, d = p - x, q - y, 1.0 - a, 1.0 - d
        determinant = a * d - b * c
        across, up = (d * p + b * q) / determinant, (c * p + a * q) / determinant
        x, y = x + across, y + up
    return x, y, across, up


def elementary(a):
    """Return sine, cosine and logarithm, to compare processors by."""
    sine, cosine = arithmetic.sincos(a)
    return sine, cosine, arithmetic.log(a)


# Function -> the types of its arguments, in numba's words.
ENTRY_POINTS = {
    history: "f8, f8, f8, f8, f8, i4, CPointer(f8)",
    history_in_lanes: "CPointer(f8), CPointer(i8), i4, f8, f8, i4",
    follow_in_lanes: "CPointer(f8), CPointer(i8), i4, f8, f8, f8, f8, i4, i4, i4",
    follow: "CPointer(UniTuple(UniTuple(f8, 3), 8)), f8, f8, i4, CPointer(f8)",
    chart_tangent: "f8, f8, f8, f8, f8, i4",
    newton: "f8, f8, f8, f8, f8, i4, i4",
    impact.impact_coefficients: "f8,",
    impact.rebound: "f8, f8, f8, UniTuple(f8, 2)",
    impact.reflect: "f8, f8, f8, f8, UniTuple(f8, 2)",
    formulas.start: "f8, f8, f8, f8",
    formulas.chart_state: "f8, f8, f8, f8, f8",
    elementary: "f8,",
}
