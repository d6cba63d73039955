"""Newton's method for points of periodic orbits, from many starts.

A point lies on an orbit of period n if half of n impacts ahead and the other half back in time lead
to the same point. The errors of these ways grow like the square root of the orbit's multiplier, so
that the method converges from much farther away than for P^n(z) = z. The way back is the mirror
image of the way ahead from the mirrored point, by the reversor (x, y) -> (x, -y).
"""

import math

from . import formulas
from .compiled import jit
from .impact import impact_coefficients, step_with_flight, tangent

STEPS = 30  # of Newton's method; those that converge take 5 to 15
LONGEST = 0.1  # length of a step, in section radii, to which a longer one is shortened
CLOSE = 1e-9  # length of the last step, in section radii
JUMP = 1e-6  # distance of the ways' ends, in section radii, above which a jump parts them
# Share of the ways' derivatives by which rounding moves their ends, and section radii by which a
# point may be wrong. Where the trace of P^n is close to 2, larger errors make one orbit of a chain
# look like many.
_ROUNDING, LARGEST_ERROR = 1e-16, 1e-9

_contact_speed_squared = jit(formulas.contact_speed_squared)


@jit
def _way(x, y, k, g, energy, coefficients, impacts):
    """Return the end (X, Y) of a way, and the derivatives of X, Y by x and of X, Y by y."""
    s = math.sqrt(_contact_speed_squared(k, g, energy, x, y))
    v, w = (y + k * s) / (1.0 + k), (s - y) / (1.0 + k)
    s_x, s_y = (1.0 + k) * (g - k * x) / (k * s), -y / (k * s)
    a, b, c = 1.0, k * s_x / (1.0 + k), s_x / (1.0 + k)
    p, q, r = 0.0, (1.0 + k * s_y) / (1.0 + k), (s_y - 1.0) / (1.0 + k)
    for _ in range(impacts):
        x, v, w, _, sine, cosine, tau_x, tau_s, tau_c, _ = step_with_flight(
            x, v, w, k, g, coefficients, None
        )
        a, b, c = tangent(a, b, c, k, g, coefficients, x, w, sine, cosine, tau_x, tau_s, tau_c)
        p, q, r = tangent(p, q, r, k, g, coefficients, x, w, sine, cosine, tau_x, tau_s, tau_c)
    return x, v - k * w, a, b - k * c, p, q - k * r


@jit
def close(points, k, g, energy, period, radius):
    """Replace starts (n, 2), points (x, y) of the section, by periodic points near them, or NaN.

    `radius` is the section's. Orbits of periods that divide `period` are found too.
    """
    coefficients = impact_coefficients(k)
    height = math.sqrt(k * (1.0 + k))  # the section is a disk in (x, y/height)
    ahead = (period + 1) // 2
    for i in range(len(points)):
        x, y = points[i]
        points[i] = math.nan
        for _ in range(STEPS):
            end_x, end_y, a, c, b, d = _way(x, y, k, g, energy, coefficients, ahead)
            p, q, e, h, f, j = _way(x, -y, k, g, energy, coefficients, period - ahead)
            gap_x, gap_y = end_x - p, (end_y + q) / height
            a, b, c, d = a - e, (b + f) * height, (c + h) / height, d - j
            determinant = a * d - b * c
            dx = (b * gap_y - d * gap_x) / determinant
            dy = (c * gap_x - a * gap_y) / determinant
            size = math.sqrt(dx * dx + dy * dy) / radius
            if not size < math.inf:  # the way leads off the section, or has no derivative
                break
            x += min(1.0, LONGEST / size) * dx
            y += min(1.0, LONGEST / size) * dy * height
            if size < CLOSE and max(abs(gap_x), abs(gap_y)) < JUMP * radius:
                error = _ROUNDING * (a * a + b * b + c * c + d * d) / abs(determinant)
                if error < LARGEST_ERROR:
                    points[i, 0], points[i, 1] = x, y
                break
