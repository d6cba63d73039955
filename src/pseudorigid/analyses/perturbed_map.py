"""The impact map P between small changes T of the section, with or without its two properties.

Points are (a, b) in the unit disk: a = (x - centre)/radius, b = y/(sqrt(k (1 + k)) radius). In them
P keeps da db, and its reversor is R(a, b) = (a, -b). With z = a + i b and a strength eps, which is
about the largest displacement of a point, the changes are

    twist     A(z) = p + (z - p) (1 + i t)/(1 - i t),    p = i/4,  t = 4 eps (1 - |z - p|^2/r^2)^6
              for |z - p| < r = 3/4, elsewhere A(z) = z
    Moebius   M(z) = (z + c)/(1 + conj(c) z),            c = eps (3 + 4 i)/5
    squeeze   D(z) = a + i (1 - eps) b

A turns circles around p, each by its own angle 2 atan t, so that it keeps area; it has five
continuous derivatives. M is analytic, with det DM = ((1 - eps^2)/|1 + conj(c) z|^2)^2. Both map the
disk onto itself and are the identity at eps = 0. D maps the disk into itself, det DD = 1 - eps.
The inverses are those with -t and -c. R A^-1 R is the twist about conj(p), by the same angles, and
R M^-1 R is M with -conj(c) for c. Neither is A^-1, A, M^-1 or M: without that, T P would have the
reversor T R, or P' would only be P in other coordinates.

T P (R T^-1 R) is reversible under R for every T, because R P R = P^-1:

    R (T P R T^-1 R) R = R T R R P R R R T^-1 = (R T R) P^-1 T^-1 = (T P R T^-1 R)^-1
"""

import math
from typing import NamedTuple

import numpy as np

from ..dynamics.ball import Ball
from ..kernel.arithmetic import narrow_log
from ..kernel.compiled import jit
from ..kernel.impact import impact_coefficients
from ..kernel.tangents import GROUP, V, W, X, advance_chunk, allocate_buffers, push_tangent

_IDENTITY, _TWIST, _MOEBIUS, _SQUEEZE = range(4)
_CENTRE, _RADIUS = (0.0, 0.25), 0.75  # of the twist's circles; the largest touches the rim
_TURN = 4.0  # t/eps at the centre: the largest displacement is 1.03 eps
_DIRECTION = 0.6, 0.8  # of c
_LEAST = 1e-30  # of 1 - a^2 - b^2, where a point is on the rim to rounding
# Rows of an orbit's data: the point, a tangent vector, the logarithm of the factors by which that
# was divided, and the logarithm of the determinant of the map's iterates.
A, B, DA, DB, GROWN, AREA, KEPT = range(7)


class PerturbedMap(NamedTuple):
    """The map T P S of one ball and energy, with g = 1, for changes S before P and T after it.

    A change is a row (kind, its two parameters, eps), of which the compiled functions take two.
    """

    k: float
    centre: float
    radius: float
    changes: np.ndarray


# Name of a map -> the changes before and after P, as signs of the parameters' second and first
# components: "mirrored" is R T^-1 R for the T after P.
MAPS = {
    "both": ("mirrored twist", "twist"),
    "area": ("", "twist"),
    "reversor": ("mirrored Moebius", "Moebius"),
    "neither": ("", "Moebius"),
    "damped": ("", "squeeze"),
}


def change(name: str, strength: float) -> np.ndarray:
    """Return the row of a change: kind, two parameters, and its strength.

    `name` is "", "twist", "Moebius" or "squeeze", or "mirrored twist" or "mirrored Moebius" for
    R T^-1 R.
    """
    side = -1.0 if name.startswith("mirrored ") else 1.0
    match name.removeprefix("mirrored "):
        case "twist":
            row = _TWIST, _CENTRE[0], side * _CENTRE[1], strength
        case "Moebius":
            row = _MOEBIUS, side * _DIRECTION[0] * strength, _DIRECTION[1] * strength, strength
        case "squeeze":
            row = _SQUEEZE, 0.0, 0.0, strength
        case _:
            row = _IDENTITY, 0.0, 0.0, 0.0
    return np.array(row, dtype=float)


def perturbed_map(ball: Ball, energy: float, name: str, strength: float) -> PerturbedMap:
    """Return one of MAPS at a strength, from 0 (the impact map itself) to below 1."""
    centre, radius = Ball(ball.k, 1.0).section(energy / (ball.g * ball.g))
    changes = np.stack([change(part, strength) for part in MAPS[name]])
    return PerturbedMap(ball.k, centre, radius, changes)


@jit
def apply(row, a, b):
    """Return the image of (a, b) under the change of a row, and its four derivatives by rows."""
    kind, first, second, strength = row[0], row[1], row[2], row[3]
    if kind == _TWIST:
        u, v = a - first, b - second
        rest = 1.0 - (u * u + v * v) / (_RADIUS * _RADIUS)
        if rest <= 0.0:
            return a, b, 1.0, 0.0, 0.0, 1.0
        square = rest * rest
        t = _TURN * strength * (square * square * square)
        scale = 1.0 / (1.0 + t * t)
        cosine, sine = (1.0 - t * t) * scale, 2.0 * t * scale
        p, q = cosine * u - sine * v, sine * u + cosine * v
        # the angle's derivative along u is `slope` u, that along v `slope` v
        slope = (-24.0 * _TURN / (_RADIUS * _RADIUS)) * strength * scale * (square * square * rest)
        du, dv = slope * u, slope * v
        slopes = cosine - q * du, -sine - q * dv, sine + p * du, cosine + p * dv
        return first + p, second + q, *slopes
    if kind == _MOEBIUS:
        # the denominator 1 + conj(c) z, and 1/denominator
        p, q = 1.0 + (first * a + second * b), first * b - second * a
        size = p * p + q * q
        u, v = a + first, b + second
        factor = (1.0 - (first * first + second * second)) / (size * size)
        real, imaginary = factor * (p * p - q * q), -2.0 * factor * (p * q)
        p, q = (u * p + v * q) / size, (v * p - u * q) / size
        return p, q, real, -imaginary, imaginary, real
    if kind == _SQUEEZE:
        return a, (1.0 - strength) * b, 1.0, 0.0, 0.0, 1.0 - strength
    return a, b, 1.0, 0.0, 0.0, 1.0


@jit
def _before(rows, first, n, k, centre, radius, change, x, v, w, tangents):
    """Apply the change before P, and write states, tangent vectors and determinants."""
    high, speed = math.sqrt(k * (1.0 + k)) * radius, math.sqrt(1.0 + k) * radius
    for i in range(n):
        j = first + i
        a, b, aa, ab, ba, bb = apply(change, rows[A, j], rows[B, j])
        da, db = aa * rows[DA, j] + ab * rows[DB, j], ba * rows[DA, j] + bb * rows[DB, j]
        tangents[3, i] = aa * bb - ab * ba
        root = math.sqrt(max((1.0 - a * a) - b * b, _LEAST))
        y, s = high * b, speed * root
        dy, ds = high * db, -speed * (a * da + b * db) / root
        x[i] = centre + radius * a
        v[i], w[i] = (y + k * s) / (1.0 + k), (s - y) / (1.0 + k)
        w[i] = max(w[i], -v[i])
        tangents[0, i] = radius * da
        tangents[1, i], tangents[2, i] = (dy + k * ds) / (1.0 + k), (ds - dy) / (1.0 + k)


@jit
def _after(rows, first, n, k, centre, radius, change, states, flights, tangents):
    """Carry tangent vectors over the flight, and apply the change after P."""
    high = math.sqrt(k * (1.0 + k)) * radius
    coefficients = impact_coefficients(k)
    for i in range(n):
        j, at = first + i, GROUP + i
        dx, dv, dw = push_tangent(
            tangents[0, i], tangents[1, i], tangents[2, i], k, 1.0, coefficients, states, flights, i
        )
        a = (states[X + at] - centre) / radius
        b = (states[V + at] - k * states[W + at]) / high
        da, db = dx / radius, (dv - k * dw) / high
        a, b, aa, ab, ba, bb = apply(change, a, b)
        rows[A, j], rows[B, j] = a, b
        rows[DA, j], rows[DB, j] = aa * da + ab * db, ba * da + bb * db
        tangents[3, i] *= aa * bb - ab * ba


@jit
def _normalize(rows, first, n, tangents):
    """Divide tangent vectors by their length, and add up logarithms."""
    first = max(first, 0)  # LLVM vectorises the loop only if no index can be negative
    for i in range(n):
        j = first + i
        da, db = rows[DA, j], rows[DB, j]
        size = abs(da) + abs(db)
        grown, area = rows[GROWN, j] + narrow_log(size), rows[AREA, j] + narrow_log(tangents[3, i])
        rows[DA, j], rows[DB, j], rows[GROWN, j], rows[AREA, j] = da / size, db / size, grown, area


@jit
def propagate(rows, k, centre, radius, changes, impacts, windows, grown, area, out):
    """Propagate orbits (KEPT, n) in place by `impacts` of a perturbed map.

    The logarithms of the tangent vectors' length and of the determinant are summed over `windows`
    (first impact, length) into `grown` and `area` (windows, n). `out` (2, n, impacts) receives a
    and b after each impact, unless it is empty. Without windows no vector is normalized.
    """
    states, flights = allocate_buffers()
    tangents = np.empty((4, GROUP))
    x, v, w = np.empty(GROUP), np.empty(GROUP), np.empty(GROUP)
    for first in range(0, rows.shape[1], GROUP):
        n = min(GROUP, rows.shape[1] - first)
        for impact in range(impacts):
            _before(rows, first, n, k, centre, radius, changes[0], x, v, w, tangents)
            advance_chunk(x[:n], v[:n], w[:n], k, 1.0, 1, states, flights, None)
            _after(rows, first, n, k, centre, radius, changes[1], states, flights, tangents)
            if len(windows) > 0:
                _normalize(rows, first, n, tangents)
            for m in range(len(windows)):
                if windows[m, 0] <= impact < windows[m, 0] + windows[m, 1]:
                    for j in range(first, first + n):
                        grown[m, j] += rows[GROWN, j]
                        area[m, j] += rows[AREA, j]
            if out.size > 0:
                out[0, first : first + n, impact] = rows[A, first : first + n]
                out[1, first : first + n, impact] = rows[B, first : first + n]
