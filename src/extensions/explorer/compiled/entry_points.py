"""Functions that the page calls in the compiled kernel: the kernel's own, and loops over impacts.

They take doubles, 32-bit counts, and addresses in the module's memory. k, g and energies are as in
`pseudorigid.Ball`, and are not checked.
"""

from numba import carray, int64  # type: ignore[attr-defined] # numba marks no exports
from numba.extending import register_jitable

from pseudorigid.kernel import arithmetic, formulas, impact, lanes, spectrum

for _formula in (formulas.radius_squared, formulas.contact_speed_squared, formulas.chart_state):
    register_jitable(_formula)  # the states on the section call them


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
