"""Benettin's method: Lyapunov exponents from a frame of three tangent vectors.

The analytic Jacobian, eq. (33), carries the frame over an impact, and Gram and Schmidt's method
makes it orthonormal again. The lengths are multiplied, and their logarithms are added to sums only
where a product nears the limits of a double, and at the end.

`exponents_of_orbit` and `exponents_of_group` write the three exponents and the time elapsed, after
each of the impacts `at` (m,), to `out`, (m, 4) or (n, m, 4), and return how many impacts were
missed, as in `impact`.
"""

import math

import numpy as np

from .arithmetic import log
from .compiled import jit
from .impact import impact_coefficients, step_with_flight, tangent
from .tangents import CHUNK, GROUP, TAU, advance_chunk, allocate_buffers, push_tangent

# Offsets of each orbit's frame, three vectors, and the products of their lengths; rows as in
# `tangents`.
_A, _B, _C, _GROWN, _SIZE = (3 * i * GROUP for i in range(5))


@jit
def normalized(a, b, c):
    """Return a vector's length and its direction."""
    length = math.sqrt((a * a + b * b) + c * c)
    return length, a / length, b / length, c / length


@jit
def orthogonal_part(a, b, c, d, e, f):
    """Return the part of the vector (d, e, f) orthogonal to the unit vector (a, b, c)."""
    along = (a * d + b * e) + c * f
    return d - along * a, e - along * b, f - along * c


@jit
def in_range(length):
    """Return whether a length is far from the limits of a double."""
    return (length > 1e-100) & (length < 1e100)


@jit
def orthonormal(a, b, c):
    """Return the lengths and directions that Gram and Schmidt's method gives for three vectors."""
    p, a0, a1, a2 = normalized(*a)
    q, b0, b1, b2 = normalized(*orthogonal_part(a0, a1, a2, *b))
    r, c0, c1, c2 = normalized(*orthogonal_part(b0, b1, b2, *orthogonal_part(a0, a1, a2, *c)))
    return p, q, r, (a0, a1, a2), (b0, b1, b2), (c0, c1, c2)


@jit
def with_logarithms(sums, lengths):
    """Return the sums with the logarithms of three lengths added."""
    first, second, third = sums
    p, q, r = lengths
    return first + log(p), second + log(q), third + log(r)


@jit
def push_frame(a, b, c, lengths, sums, k, g, coefficients, p, q, sine, cosine, tau_x, tau_s, tau_c):
    """Carry the unit vectors a, b, c over an impact and a flight, and make them orthonormal.

    `lengths` are the products of the vectors' lengths since their logarithms were last added to
    `sums`. Other arguments are those of `impact.tangent`. Returns a, b, c, lengths and sums.
    """
    a = tangent(*a, k, g, coefficients, p, q, sine, cosine, tau_x, tau_s, tau_c)
    b = tangent(*b, k, g, coefficients, p, q, sine, cosine, tau_x, tau_s, tau_c)
    c = tangent(*c, k, g, coefficients, p, q, sine, cosine, tau_x, tau_s, tau_c)
    length_a, length_b, length_c, a, b, c = orthonormal(a, b, c)
    product_a, product_b, product_c = lengths
    lengths = product_a * length_a, product_b * length_b, product_c * length_c
    if not (in_range(lengths[0]) & in_range(lengths[1]) & in_range(lengths[2])):
        sums = with_logarithms(sums, lengths)
        lengths = 1.0, 1.0, 1.0
    return a, b, c, lengths, sums


@jit
def _advance(frames, n, k, g, coefficients, states, flights, row):
    """Carry the frames of n orbits over an impact, and make them orthonormal.

    Return whether one of the products of lengths nears the limits of a double.
    """
    extremes = 0
    row = max(row, 0)  # LLVM vectorises the loop only if no index can be negative
    for i in range(n):
        at = row + i
        a0, a1, a2 = frames[_A + i], frames[_A + GROUP + i], frames[_A + 2 * GROUP + i]
        b0, b1, b2 = frames[_B + i], frames[_B + GROUP + i], frames[_B + 2 * GROUP + i]
        c0, c1, c2 = frames[_C + i], frames[_C + GROUP + i], frames[_C + 2 * GROUP + i]
        p0, q0, r0 = frames[_GROWN + i], frames[_GROWN + GROUP + i], frames[_GROWN + 2 * GROUP + i]
        p, q, r, a, b, c = orthonormal(
            push_tangent(a0, a1, a2, k, g, coefficients, states, flights, at),
            push_tangent(b0, b1, b2, k, g, coefficients, states, flights, at),
            push_tangent(c0, c1, c2, k, g, coefficients, states, flights, at),
        )
        a0, a1, a2 = a
        b0, b1, b2 = b
        c0, c1, c2 = c
        p, q, r = p0 * p, q0 * q, r0 * r
        frames[_A + i], frames[_A + GROUP + i], frames[_A + 2 * GROUP + i] = a0, a1, a2
        frames[_B + i], frames[_B + GROUP + i], frames[_B + 2 * GROUP + i] = b0, b1, b2
        frames[_C + i], frames[_C + GROUP + i], frames[_C + 2 * GROUP + i] = c0, c1, c2
        frames[_GROWN + i], frames[_GROWN + GROUP + i], frames[_GROWN + 2 * GROUP + i] = p, q, r
        extremes += 0 if in_range(p) & in_range(q) & in_range(r) else 1
    return extremes > 0


@jit
def exponents_of_orbit(x, v, w, k, g, at, out, root_finder):
    """Compute the exponents of one orbit; its frame stays in the processor's registers."""
    coefficients = impact_coefficients(k)
    a, b, c = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
    sums, lengths = (0.0, 0.0, 0.0), (1.0, 1.0, 1.0)
    missed, done, time = 0, 0, 0.0
    for m in range(at.size):
        while done < at[m]:
            x, v, w, tau, sine, cosine, tau_x, tau_s, tau_c, missed_one = step_with_flight(
                x, v, w, k, g, coefficients, root_finder
            )
            a, b, c, lengths, sums = push_frame(
                a, b, c, lengths, sums, k, g, coefficients, x, w, sine, cosine, tau_x, tau_s, tau_c
            )
            missed += missed_one
            time += tau
            done += 1
        sums, lengths = with_logarithms(sums, lengths), (1.0, 1.0, 1.0)
        for j in range(3):
            out[m, j] = sums[j] / done
        out[m, 3] = time
    return missed


@jit
def exponents_of_group(x, v, w, k, g, at, out, root_finder):
    """Compute the exponents of at most GROUP orbits."""
    n = x.size
    missed, done = 0, 0
    coefficients = impact_coefficients(k)
    states, flights = allocate_buffers()
    frames, total, time = np.zeros(_SIZE), np.zeros((3, n)), np.zeros(n)
    for i in range(n):
        frames[_A + i] = frames[_B + GROUP + i] = frames[_C + 2 * GROUP + i] = 1.0
        frames[_GROWN + i] = frames[_GROWN + GROUP + i] = frames[_GROWN + 2 * GROUP + i] = 1.0
    for m in range(at.size):
        while done < at[m]:
            impacts = min(CHUNK, at[m] - done)
            missed += advance_chunk(x, v, w, k, g, impacts, states, flights, root_finder)
            for row in range(0, impacts * GROUP, GROUP):
                if _advance(frames, n, k, g, coefficients, states, flights, row):
                    _collect(total, frames, n, False)
                for i in range(n):
                    time[i] += states[TAU + GROUP + row + i]
            done += impacts
        _collect(total, frames, n, True)
        for i in range(n):
            for j in range(3):
                out[i, m, j] = total[j, i] / done
            out[i, m, 3] = time[i]
    return missed


@jit
def _collect(total, frames, n, every):
    """Add the logarithms of lengths to the sums of every orbit, or of those with an extreme one."""
    for i in range(n):
        p, q, r = frames[_GROWN + i], frames[_GROWN + GROUP + i], frames[_GROWN + 2 * GROUP + i]
        if every or not (in_range(p) and in_range(q) and in_range(r)):
            for m in range(3):
                total[m, i] += log(frames[_GROWN + m * GROUP + i])
                frames[_GROWN + m * GROUP + i] = 1.0
