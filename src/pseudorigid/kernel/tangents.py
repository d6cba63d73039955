"""Tangent vectors along many orbits at once: their growth, and winding around a centre.

Impacts are processed in chunks: first the orbits advance, then the derivatives of all flights of
the chunk are computed, and then the vectors are carried from impact to impact. The loops run over
rows of flat arrays, which LLVM vectorises, and call the functions of `impact`, so that each orbit
equals the same orbit alone, bit for bit. From `begin` on, lengths are in g R, so that g = 1.
"""

import math

import numpy as np

from . import lanes
from .arithmetic import log, narrow_log, narrow_quadrant
from .compiled import jit
from .impact import flight_derivatives, impact_coefficients, iterate, rebound, tangent

# Impacts in a chunk and orbits in a group; the buffers then fit into the processor's cache.
CHUNK = 32
GROUP = lanes.LANES
# Offsets of blocks of rows; a row has GROUP numbers, one for each orbit. Blocks of states have a
# row from before the chunk and one for each impact, blocks of flights only the latter.
X, V, W, TAU = (i * (CHUNK + 1) * GROUP for i in range(4))
SINE, COSINE, TAU_X, TAU_S, TAU_C = (i * CHUNK * GROUP for i in range(5))
_EIGHTH = math.sqrt(2.0) - 1.0  # tan(pi/8)
# Chebyshev polynomial for (atan t - t)/t^3 in z = t^2 on |t| <= tan(pi/8), error below 1e-14
_A0 = float.fromhex("-0x1.55555555553a3p-2")
_A1 = float.fromhex("0x1.99999998d12f0p-3")
_A2 = float.fromhex("-0x1.249248aa52bc5p-3")
_A3 = float.fromhex("0x1.c71c381ab56c6p-4")
_A4 = float.fromhex("-0x1.74563c795c0ffp-4")
_A5 = float.fromhex("0x1.3a9d83feefaedp-4")
_A6 = float.fromhex("-0x1.0c52a4b5af878p-4")
_A7 = float.fromhex("0x1.a769bd3353c1cp-5")
_A8 = float.fromhex("-0x1.be20c62f176ddp-6")

# Rows of an orbit's data between calls of `propagate_with_tangent`: the state x, v, w; a tangent
# vector and the logarithm of the factors by which it was divided; the logarithm of its whole
# length; the x of the centre, at y = 0 in the chart, and the turns around it to expect of an
# impact.
VECTOR, GROWN, SIZE, CENTRE, EXPECTED, KEPT = 3, 6, 7, 8, 9, 10
# Offsets of rows of GROUP numbers during propagation. The first rows are as above; the others hold
# the last position relative to the centre and the last turn.
_DX, _DV, _DW = ((VECTOR + i) * GROUP for i in range(3))
_GROWN, _SIZE, _CENTRE, _EXPECTED = (i * GROUP for i in (GROWN, SIZE, CENTRE, EXPECTED))
_P, _Q, _TURN = ((KEPT + i) * GROUP for i in range(3))
_ROWS = (KEPT + 3) * GROUP
# A tangent vector with a length beyond these limits is normalized, so that it cannot overflow.
SHORTEST, LONGEST = 1e-50, 1e50


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
        lanes.iterate(x, v, w, k, g, impacts, np.empty(n), out)
    else:
        missed = iterate(x, v, w, k, g, impacts, np.empty(n), out, root_finder)
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


@jit
def angle(across, up):
    """Return the angle of a vector in the plane, in (-pi, pi] to 1e-14; 0 for the vector 0.

    It selects instead of branching, so that LLVM can vectorise it.
    """
    a, b = abs(across), abs(up)
    large = max(a, b)
    t = min(a, b) / large
    wide = t > _EIGHTH
    t = (t - 1.0) / (t + 1.0) if wide else t
    base = 0.25 * math.pi if wide else 0.0
    z = t * t
    z2 = z * z
    low = (_A0 + z * _A1) + z2 * (_A2 + z * _A3)
    high = (_A4 + z * _A5) + z2 * (_A6 + z * _A7) + (z2 * z2) * _A8
    turn = base + (t + t * z * (low + (z2 * z2) * high))
    turn = 0.5 * math.pi - turn if b > a else turn
    turn = math.pi - turn if across < 0.0 else turn
    turn = -turn if up < 0.0 else turn
    return turn if large > 0.0 else 0.0


@jit
def turn_between(p, q, r, s, expected):
    """Return the turn from (p, q) to (r, s), clockwise, within half a turn of the expected one."""
    turn = angle(p * r + q * s, q * r - p * s) / (2.0 * math.pi)
    shift = 1.0 if turn < expected - 0.5 else 0.0
    shift = -1.0 if turn > expected + 0.5 else shift
    return turn + shift


def begin(k, states, centre, expected):
    """Return orbits (KEPT, n) for `propagate_with_tangent`, with tangents of the energy surface.

    `states` are arrays x, v, w (n,) just before an impact. `centre` is the x, at y = 0, around
    which turns are counted, and `expected` the turns to expect of an impact: half a turn where it
    is NaN, because the centre is no elliptic point.
    """
    x, v, w = states
    orbits = np.zeros((KEPT, x.size))
    orbits[:VECTOR], orbits[VECTOR + 1], orbits[VECTOR + 2] = (x, v, w), k * w, -v
    orbits[CENTRE], orbits[EXPECTED] = centre, np.where(np.isnan(expected), 0.5, expected)
    return orbits


def bump(impact, length):
    """Return the weight (t (1 - t))^3 of one impact of a window, of which t is its middle."""
    t = (impact + 0.5) / length
    product = t * (1.0 - t)
    return product * product * product


_compiled_bump = jit(bump)


def weight(length):
    """Return the sum of the weights of turns over a window of `length` impacts."""
    return np.sum(bump(np.arange(length), length))


@jit
def _observe(rows, n, k, round_y, coefficients, states, flights, row):
    """Carry tangent vectors over an impact, count turns, and return whether a vector is extreme."""
    extreme = 0
    row = max(row, 0)  # LLVM vectorises the loop only if no index can be negative
    for i in range(n):
        dx, dv, dw = rows[_DX + i], rows[_DV + i], rows[_DW + i]
        dx, dv, dw = push_tangent(dx, dv, dw, k, 1.0, coefficients, states, flights, row + i)
        size = (abs(dx) + abs(dv)) + abs(dw)
        grown = rows[_GROWN + i] + narrow_log(size)
        rows[_DX + i], rows[_DV + i], rows[_DW + i], rows[_SIZE + i] = dx, dv, dw, grown
        extreme += 0 if (size > SHORTEST) & (size < LONGEST) else 1
    for i in range(n):
        at = GROUP + row + i
        expected, p, q = rows[_EXPECTED + i], rows[_P + i], rows[_Q + i]
        r = states[X + at] - rows[_CENTRE + i]
        s = round_y * (states[V + at] - k * states[W + at])
        rows[_TURN + i] = turn_between(p, q, r, s, expected)
        rows[_P + i], rows[_Q + i] = r, s
    return extreme > 0


@jit
def _rescale(rows, n):
    """Normalize tangent vectors whose length is extreme."""
    for i in range(n):
        dx, dv, dw = rows[_DX + i], rows[_DV + i], rows[_DW + i]
        size = (abs(dx) + abs(dv)) + abs(dw)
        if not SHORTEST < size < LONGEST:
            rows[_GROWN + i] += log(size)
            rows[_SIZE + i] = rows[_GROWN + i]
            rows[_DX + i], rows[_DV + i], rows[_DW + i] = dx / size, dv / size, dw / size


@jit
def _add(sums, weight, rows, row):
    """Add a weighted row to some sums."""
    for i in range(sums.size):
        sums[i] += weight * rows[row + i]


@jit
def _propagate_group(orbits, low_end, high_end, k, start, stop, turning, growing, turned, growth):
    """Propagate the orbits from `low_end` to before `high_end`, at most GROUP of them."""
    n = high_end - low_end
    coefficients = impact_coefficients(k)
    round_y = 1.0 / math.sqrt(k * (1.0 + k))  # the section is a disk in (x, round_y * y)
    states, flights = allocate_buffers()
    rows = np.zeros(_ROWS)
    for i in range(n):
        for m in range(KEPT):
            rows[m * GROUP + i] = orbits[m, low_end + i]
        rows[_P + i] = rows[i] - rows[_CENTRE + i]
        rows[_Q + i] = round_y * (rows[GROUP + i] - k * rows[2 * GROUP + i])
    x, v, w = orbits[0, low_end:high_end], orbits[1, low_end:high_end], orbits[2, low_end:high_end]
    done = start
    while done < stop:
        impacts = min(CHUNK, stop - done)
        advance_chunk(x, v, w, k, 1.0, impacts, states, flights, None)
        for row in range(0, impacts * GROUP, GROUP):
            if _observe(rows, n, k, round_y, coefficients, states, flights, row):
                _rescale(rows, n)
            for m in range(len(turning)):
                first, length = turning[m]
                if first <= done < first + length:
                    share = _compiled_bump(done - first, length)
                    _add(turned[m, low_end:high_end], share, rows, _TURN)
            for m in range(len(growing)):
                first, length = growing[m]
                if first <= done < first + length:
                    _add(growth[m, low_end:high_end], 1.0, rows, _SIZE)
            done += 1
    for m in range(VECTOR, CENTRE):
        for i in range(n):
            orbits[m, low_end + i] = rows[m * GROUP + i]


@jit
def propagate_with_tangent(orbits, k, start, stop, turning, growing, turned, growth):
    """Propagate orbits from `begin` in place, with tangent vectors along the energy surface.

    Impacts `start` to `stop` are done, counted from the orbits' beginning. The rows of `turning`
    and `growing` are windows (first impact, length). The turns around the centre, each within half
    a turn of the expected one, are added to `turned` (windows, n), with the weights (t (1 - t))^3
    over each window, t from 0 to 1, of a weighted Birkhoff average (Das, Saiki, Sander and Yorke,
    Nonlinearity 30, 2017). The logarithms of the tangent vector's length, summed over each window,
    are added to `growth`. A vector is NaN from an exactly grazing impact on, where the map has no
    derivative.
    """
    count = orbits.shape[1]
    for first in range(0, count, GROUP):
        last = min(first + GROUP, count)
        _propagate_group(orbits, first, last, k, start, stop, turning, growing, turned, growth)


def turns_and_growth(k, states, centre, expected, impacts) -> tuple[np.ndarray, np.ndarray]:
    """Return rotation numbers and exponents of orbits from states with lengths in g R.

    A rotation number, in turns an impact, is a weighted Birkhoff average as in
    `propagate_with_tangent`. An exponent is the growth rate of a tangent vector, in nats an impact,
    from the middle of the second quarter to the middle of the last. Arguments are those of `begin`.
    """
    quarter = impacts // 4
    turning = np.array([(0, impacts)])
    growing = np.array([(quarter, quarter), (impacts - quarter, quarter)])
    orbits = begin(k, states, centre, expected)
    turned, growth = np.zeros((1, orbits.shape[1])), np.zeros((2, orbits.shape[1]))
    propagate_with_tangent(orbits, k, 0, impacts, turning, growing, turned, growth)
    exponent = (growth[1] - growth[0]) / (quarter * (impacts - 2.0 * quarter))
    return turned[0] / weight(impacts), exponent
