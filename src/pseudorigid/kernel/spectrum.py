"""One step of Benettin's method, for a frame of three tangent vectors.

The analytic Jacobian, eq. (33), carries the frame over an impact, and Gram and Schmidt's method
makes it orthonormal again. The lengths are multiplied, and their logarithms are added to sums only
where a product nears the limits of a double, and at the end.
"""

import math

from .arithmetic import log
from .compiled import jit
from .impact import tangent


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
