"""The impact map P between small changes T of the section, with or without its two properties.

Points are (a, b) in the unit disk: a = (x - centre)/radius, b = y/(sqrt(k (1 + k)) radius). In them
P keeps da db, and its reversor is R(a, b) = (a, -b). With z = a + i b and a strength eps, which is
within a factor of two the largest displacement of a point, changes are made of two maps of the disk
onto itself:

    twist     A(z) = p + (z - p) (1 + i t)/(1 - i t),    t = m eps (1 - |z - p|^2/r^2)^6
              for |z - p| < r = 3/4, elsewhere A(z) = z
    Moebius   M(z) = (z + c)/(1 + conj(c) z)

A turns circles around p, each by its own angle 2 atan t, so that it keeps area; it has five
continuous derivatives. There are three forms of change:

    twist     A with p = (-4 + 3 i)/20 and m = 4
    stir      A with p = (-3 + 4 i)/20 and m = 2 after A with p = (-4 - 3 i)/20 and m = -2
    shift     M with c = eps (3 + 4 i)/5, det DM = ((1 - |c|^2)/|1 + conj(c) z|^2)^2

The first two keep area as they are. As M^-1 T M with c = (-3 + 4 i)/10 they also turn circles,
because M maps circles to circles, but not concentric ones: they do not keep area. This c is one of
those for which the change of area does not cancel along curves, so that spirals are fast where no
property is kept. The shift has no counterpart that keeps area. Inverses have -m for m or -c for c.
For no T is R T R = T^-1 or T: else T P had the reversor T R, or P' were P in other coordinates.

T P (R T^-1 R) is reversible under R for every T, because R P R = P^-1:

    R (T P R T^-1 R) R = R T R R P R R R T^-1 = (R T R) P^-1 T^-1 = (T P R T^-1 R)^-1
"""

import math
from typing import NamedTuple

import numpy as np

from pseudorigid.dynamics.ball import Ball
from pseudorigid.kernel.arithmetic import narrow_log
from pseudorigid.kernel.compiled import jit
from pseudorigid.kernel.impact import impact_coefficients
from pseudorigid.kernel.tangents import (
    GROUP,
    V,
    W,
    X,
    advance_chunk,
    allocate_buffers,
    push_tangent,
)

_RADIUS = 0.75  # of the twists' circles; the largest touch the rim
_FRAME = -0.3, 0.4, 0.0  # c of the twists that do not keep area
_SHIFT = 0.6, 0.8, 0.0  # c/eps of the shift
_LEAST = 1e-30  # of 1 - a^2 - b^2, where a point is on the rim to rounding
# Rows of an orbit's data: the point, a tangent vector, the logarithm of the factors by which that
# was divided, the logarithm of the determinant of the map's iterates, the mirror image of the start
# under R, and the square of the orbit's least distance from it.
A, B, DA, DB, GROWN, AREA, MIRROR_A, MIRROR_B, NEAREST, KEPT = range(10)
# Rows of a group's data during an impact: state and tangent vector, and the change's determinant.
_X, _V, _W, _DX, _DV, _DW, _DETERMINANT = range(7)
NO_POINTS = np.empty((2, 0, 0))  # for `propagate`, which then keeps no points
# Form of a change -> (p, m) of its twists, of which a shift has none.
FORMS = {
    "twist": [(-0.2, 0.15, 4.0)],
    "stir": [(-0.2, -0.15, -2.0), (-0.15, 0.2, 2.0)],
    "shift": [],
}
# What a map keeps of its properties -> whether it keeps area, and whether it has the reversor R.
PROPERTIES = {
    "both": (True, True),
    "area": (True, False),
    "reversor": (False, True),
    "neither": (False, False),
}
# Name of a map -> the form of its change, and what it keeps.
MAPS = {
    f"{form} {kept}": (form, *has)
    for form, twists in FORMS.items()
    for kept, has in PROPERTIES.items()
    if twists or not has[0]
}


Frame = tuple[float, float, float]  # k, and the section's centre and radius in x
Slopes = tuple[float, float, float, float]  # a Jacobian (2, 2) by rows


class PerturbedMap(NamedTuple):
    """The map T P S of one ball and energy, with g = 1, for changes S before P and T after it.

    A change is an array (4, 3): c of a first M, (p, m eps) of two twists, and c of a last M, or
    zeros for the identity. `changes` holds S and T.
    """

    frame: Frame
    changes: np.ndarray

    def images(self, points: np.ndarray, impacts: int = 1) -> np.ndarray:
        """Return the images of points (2, n) after some impacts."""
        rows = orbit_rows(points)
        no_windows = np.empty((0, 2), dtype=np.int64), np.empty((2, 0, points.shape[1]))
        propagate(rows, *self, impacts, *no_windows, NO_POINTS)
        return rows[:2]


def orbit_rows(points: np.ndarray) -> np.ndarray:
    """Return the data of orbits for `propagate`, (KEPT, n), from their starts (2, n)."""
    rows = np.zeros((KEPT, points.shape[1]))
    rows[:2], rows[DA], rows[DB], rows[NEAREST] = points, 0.5, 0.5, math.inf
    rows[MIRROR_A : MIRROR_A + 2] = points[0], -points[1]
    return rows


def change(form: str, keeps_area: bool, strength: float, mirrored: bool = False) -> np.ndarray:
    """Return a change T as an array (4, 3), or R T^-1 R if `mirrored`."""
    rows = np.zeros((4, 3))
    for i, twist in enumerate(FORMS[form], start=1):
        rows[i] = np.array(twist) * (1.0, 1.0, strength)
    if not FORMS[form]:
        rows[0] = np.array(_SHIFT) * strength
    elif strength > 0.0 and not keeps_area:
        rows[0] = _FRAME
        rows[3] -= rows[0]
    if mirrored:  # R turns twists the other way, and so does the inverse
        rows = rows[::-1] * np.array([(-1.0, 1.0, 0.0), *[(1.0, -1.0, 1.0)] * 2, (-1.0, 1.0, 0.0)])
    return rows


def perturbed_map(ball: Ball, energy: float, name: str, strength: float) -> PerturbedMap:
    """Return one of MAPS at a strength, from 0 (the impact map itself) to below 1."""
    centre, radius = Ball.dimensionless(ball.k).section(energy / (ball.g * ball.g))
    form, keeps_area, reversible = MAPS[name]
    before = change(form, keeps_area, strength if reversible else 0.0, mirrored=True)
    changes = np.stack([before, change(form, keeps_area, strength)])
    return PerturbedMap((ball.k, centre, radius), changes)


@jit
def _twist(
    first: float, second: float, turn: float, a: float, b: float
) -> tuple[float, float, Slopes]:
    """Return the image of (a, b) under A with p and m eps, and its derivatives by rows."""
    u, v = a - first, b - second
    rest = 1.0 - (u * u + v * v) / (_RADIUS * _RADIUS)
    if rest <= 0.0 or turn == 0.0:
        return a, b, (1.0, 0.0, 0.0, 1.0)
    square = rest * rest
    t = turn * (square * square * square)
    scale = 1.0 / (1.0 + t * t)
    cosine, sine = (1.0 - t * t) * scale, 2.0 * t * scale
    p, q = cosine * u - sine * v, sine * u + cosine * v
    # the angle's derivative along u is `slope` u, that along v `slope` v
    slope = (-24.0 / (_RADIUS * _RADIUS)) * turn * scale * (square * square * rest)
    du, dv = slope * u, slope * v
    slopes = cosine - q * du, -sine - q * dv, sine + p * du, cosine + p * dv
    return first + p, second + q, slopes


@jit
def _moebius(first: float, second: float, a: float, b: float) -> tuple[float, float, Slopes]:
    """Return the image of (a, b) under M, and its derivatives by rows."""
    if first == 0.0 == second:
        return a, b, (1.0, 0.0, 0.0, 1.0)
    # the denominator 1 + conj(c) z, and 1/denominator
    p, q = 1.0 + (first * a + second * b), first * b - second * a
    size = p * p + q * q
    u, v = a + first, b + second
    factor = (1.0 - (first * first + second * second)) / (size * size)
    real, imaginary = factor * (p * p - q * q), -2.0 * factor * (p * q)
    p, q = (u * p + v * q) / size, (v * p - u * q) / size
    return p, q, (real, -imaginary, imaginary, real)


@jit
def _product(m: Slopes, n: Slopes) -> Slopes:
    """Return the product of two matrices (2, 2), given by rows."""
    first = m[0] * n[0] + m[1] * n[2], m[0] * n[1] + m[1] * n[3]
    return first[0], first[1], m[2] * n[0] + m[3] * n[2], m[2] * n[1] + m[3] * n[3]


@jit
def apply(change: np.ndarray, a: float, b: float) -> tuple[float, ...]:
    """Return the image of (a, b) under a change, and its four derivatives by rows."""
    slopes = 1.0, 0.0, 0.0, 1.0
    for i in range(4):
        first, second = change[i, 0], change[i, 1]
        if i in (1, 2):
            a, b, more = _twist(first, second, change[i, 2], a, b)
        else:
            a, b, more = _moebius(first, second, a, b)
        slopes = _product(more, slopes)
    return a, b, slopes[0], slopes[1], slopes[2], slopes[3]


@jit
def _before(
    rows: np.ndarray, first: int, n: int, frame: Frame, change: np.ndarray, group: np.ndarray
) -> None:
    """Apply the change before P to n orbits, and write states, tangent vectors and determinants."""
    k, centre, radius = frame
    high, speed = math.sqrt(k * (1.0 + k)) * radius, math.sqrt(1.0 + k) * radius
    for i in range(n):
        j = first + i
        a, b, aa, ab, ba, bb = apply(change, rows[A, j], rows[B, j])
        da, db = aa * rows[DA, j] + ab * rows[DB, j], ba * rows[DA, j] + bb * rows[DB, j]
        group[_DETERMINANT, i] = aa * bb - ab * ba
        root = math.sqrt(max((1.0 - a * a) - b * b, _LEAST))
        y, s = high * b, speed * root
        dy, ds = high * db, -speed * (a * da + b * db) / root
        group[_X, i] = centre + radius * a
        group[_V, i] = (y + k * s) / (1.0 + k)
        group[_W, i] = max((s - y) / (1.0 + k), -group[_V, i])
        group[_DX, i] = radius * da
        group[_DV, i], group[_DW, i] = (dy + k * ds) / (1.0 + k), (ds - dy) / (1.0 + k)


@jit
def _after(
    rows: np.ndarray, first: int, n: int, frame: Frame, change: np.ndarray,
    flown: tuple[np.ndarray, np.ndarray], group: np.ndarray,
) -> None:  # fmt: skip
    """Carry tangent vectors over flights, `flown`, and apply the change after P to n orbits."""
    (k, centre, radius), (states, flights) = frame, flown
    high = math.sqrt(k * (1.0 + k)) * radius
    coefficients = impact_coefficients(k)
    for i in range(n):
        j, at = first + i, GROUP + i
        vector = group[_DX, i], group[_DV, i], group[_DW, i]
        dx, dv, dw = push_tangent(*vector, k, 1.0, coefficients, states, flights, i)
        a = (states[X + at] - centre) / radius
        b = (states[V + at] - k * states[W + at]) / high
        da, db = dx / radius, (dv - k * dw) / high
        a, b, aa, ab, ba, bb = apply(change, a, b)
        rows[A, j], rows[B, j] = a, b
        u, v = a - rows[MIRROR_A, j], b - rows[MIRROR_B, j]
        rows[NEAREST, j] = min(rows[NEAREST, j], u * u + v * v)
        rows[DA, j], rows[DB, j] = aa * da + ab * db, ba * da + bb * db
        group[_DETERMINANT, i] *= aa * bb - ab * ba


@jit
def _normalize(rows: np.ndarray, first: int, n: int, determinants: np.ndarray) -> None:
    """Divide tangent vectors by their length, and add up logarithms."""
    first = max(first, 0)  # LLVM vectorises the loop only if no index can be negative
    for i in range(n):
        j = first + i
        da, db = rows[DA, j], rows[DB, j]
        size = abs(da) + abs(db)
        grown, area = rows[GROWN, j] + narrow_log(size), rows[AREA, j] + narrow_log(determinants[i])
        rows[DA, j], rows[DB, j], rows[GROWN, j], rows[AREA, j] = da / size, db / size, grown, area


@jit
def propagate(
    rows: np.ndarray, frame: Frame, changes: np.ndarray, impacts: int, windows: np.ndarray,
    sums: np.ndarray, out: np.ndarray,
) -> None:  # fmt: skip
    """Propagate orbits (KEPT, n) in place by `impacts` of a perturbed map.

    The logarithms of the tangent vectors' length and of the determinant are summed over `windows`
    (first impact, length) into `sums` (2, windows, n). `out` (2, n, impacts) receives a and b after
    each impact, unless it is empty. Without windows no vector is normalized.
    """
    flown = states, flights = allocate_buffers()
    group = np.empty((7, GROUP))
    for first in range(0, rows.shape[1], GROUP):
        n = min(GROUP, rows.shape[1] - first)
        last = first + n
        for impact in range(impacts):
            _before(rows, first, n, frame, changes[0], group)
            x, v, w = group[_X, :n], group[_V, :n], group[_W, :n]
            advance_chunk(x, v, w, frame[0], 1.0, 1, states, flights, None)
            _after(rows, first, n, frame, changes[1], flown, group)
            if len(windows) > 0:
                _normalize(rows, first, n, group[_DETERMINANT])
            for m in range(len(windows)):
                if windows[m, 0] <= impact < windows[m, 0] + windows[m, 1]:
                    sums[0, m, first:last] += rows[GROWN, first:last]
                    sums[1, m, first:last] += rows[AREA, first:last]
            if out.size > 0:
                out[0, first:last, impact] = rows[A, first:last]
                out[1, first:last, impact] = rows[B, first:last]
