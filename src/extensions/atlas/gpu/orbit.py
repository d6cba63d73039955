"""What one thread of a graphics processor does: follow one orbit of a cell, and judge it.

`classify` gives the bits of `dynamics.verdict.classify_orbits`; `plans` says what a plan is. Two
more functions serve to compare processors.
"""

import math

from numba import int64

from pseudorigid.kernel.arithmetic import log, narrow_log, sincos
from pseudorigid.kernel.impact import impact_coefficients, step, step_with_flight, tangent
from pseudorigid.kernel.tangents import LONGEST, SHORTEST, turn_between
from pseudorigid.kernel.verdict import judge

from ..starts import sunflower_point

# Rows of numbers of an orbit: between calls the state, the tangent vector, the logarithm of the
# factors by which it was divided, and that of its whole length; and what is found.
KEPT, FOUND = 8, ("winding", "growth", "exponent")
# The flag of an orbit has a bit for each verdict, and one where they are decided. It is FAILED
# while the orbit is followed, and stays so after an error.
FLAGS = {"regular": 1, "strict": 2, "lenient": 4}
DECIDED, FAILED = 8, 255
HEADER = 7  # numbers of a plan before its segments


def classify(thread, chosen, cells, starts, count, plan, shares, weights, kept, sums, found, flags):
    """Follow the orbit `chosen[thread]` (32 bits) to the end of a plan, and judge it there.

    There are `count` orbits, `starts` in each cell. `cells` has k, E/g^2, the x of the fixed point
    and the turns to expect of an impact, cell after cell; `plan`, `shares` and `weights` are those
    of `plans`. `kept`, `sums` and `found` have rows of `count` numbers, KEPT of them, one for each
    window, and those of FOUND; `flags` has a byte of each orbit.
    """
    orbit = int64(chosen[thread])
    flags[orbit] = FAILED
    at = 4 * (orbit // starts)
    k, e, centre, expected = cells[at], cells[at + 1], cells[at + 2], cells[at + 3]
    coefficients = impact_coefficients(k)
    round_y = 1.0 / math.sqrt(k * (1.0 + k))  # as in `kernel.tangents`
    done, stop = plan[0], plan[1]
    if done == 0:
        x, v, w = sunflower_point(k, e, orbit % starts, starts)
        dx, dv, dw, grown, size = 0.0, k * w, -v, 0.0, 0.0
        for m in range(plan[5] + 2):
            sums[m * count + orbit] = 0.0
    else:
        x, v, w = kept[orbit], kept[count + orbit], kept[2 * count + orbit]
        dx, dv, dw = kept[3 * count + orbit], kept[4 * count + orbit], kept[5 * count + orbit]
        grown, size = kept[6 * count + orbit], kept[7 * count + orbit]
    p, q = x - centre, round_y * (v - k * w)
    at = HEADER
    while done < stop:
        end, turning, growing = plan[at], at + 3, at + 3 + 2 * plan[at + 1]
        at = growing + plan[at + 2]
        while done < end:
            after = step_with_flight(x, v, w, k, 1.0, coefficients, None)
            (x, v, w), flight = after[:3], after[4:9]
            dx, dv, dw = tangent(dx, dv, dw, k, 1.0, coefficients, x, w, *flight)
            length = (abs(dx) + abs(dv)) + abs(dw)
            size = grown + narrow_log(length)
            if not SHORTEST < length < LONGEST:
                grown += log(length)
                size, dx, dv, dw = grown, dx / length, dv / length, dw / length
            r, s = x - centre, round_y * (v - k * w)
            turn = turn_between(p, q, r, s, expected)
            p, q = r, s
            for m in range(turning, growing, 2):
                sums[plan[m] * count + orbit] += shares[plan[m + 1] + done] * turn
            for m in range(growing, at):
                sums[plan[m] * count + orbit] += size
            done += 1
    kept[orbit], kept[count + orbit], kept[2 * count + orbit] = x, v, w
    kept[3 * count + orbit], kept[4 * count + orbit], kept[5 * count + orbit] = dx, dv, dw
    kept[6 * count + orbit], kept[7 * count + orbit] = grown, size
    at = plan[3] * count + orbit
    turned = sums[at], sums[at + count], sums[at + 2 * count]
    at = plan[4] * count + orbit
    logarithms = sums[at], sums[at + count]
    if plan[0] == 0:
        at = plan[5] * count + orbit
        found[2 * count + orbit] = (sums[at + count] - sums[at]) / (stop - stop // 4)
    of_turns, at_end = (weights[0], weights[1], weights[2]), plan[6] == 1
    verdict = judge(turned, of_turns, logarithms, plan[2], size, at_end)
    winding, growth, regular, strict, lenient, decided = verdict
    found[orbit], found[count + orbit] = winding, growth
    flags[orbit] = 1 * regular + 2 * strict + 4 * lenient + DECIDED * decided


def advance(thread, count, impacts, orbits):
    """Advance an orbit by some impacts, in place; rows are x, v, w, k and g of `count` orbits."""
    x, v, w = orbits[thread], orbits[count + thread], orbits[2 * count + thread]
    k, g = orbits[3 * count + thread], orbits[4 * count + thread]
    coefficients = impact_coefficients(k)
    for _ in range(impacts):
        x, v, w, _, _, _ = step(x, v, w, k, g, coefficients, None)
    orbits[thread], orbits[count + thread], orbits[2 * count + thread] = x, v, w


def elementary(thread, count, values, found):
    """Write rows of sine, cosine and logarithm of `count` values, to compare processors by."""
    sine, cosine = sincos(values[thread])
    found[thread], found[count + thread] = sine, cosine
    found[2 * count + thread] = log(values[thread])


ENTRY_POINTS = {
    classify: "i8, CPointer(i4), CPointer(f8), i8, i8, CPointer(i8), CPointer(f8), CPointer(f8), "
    "CPointer(f8), CPointer(f8), CPointer(f8), CPointer(u1)",
    advance: "i8, i8, i8, CPointer(f8)",
    elementary: "i8, i8, CPointer(f8), CPointer(f8)",
}
