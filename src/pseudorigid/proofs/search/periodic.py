"""Certificates of periodic orbits: centres from Newton's method, and the largest round box."""

from fractions import Fraction
from math import ceil, sqrt

from flint import arb, arb_mat, ctx

from .writing import decimal, header, rows

BITS = 160
DIGITS = 36  # the checker holds thirty of them against the orbit
LARGEST, SMALLEST = 2, 12  # minus the decimal exponents of the sizes that are tried


def polished(surface, points, steps=8):
    """Points closer to a periodic orbit, by Newton's method on midpoints.

    Parameters
    ----------
    surface : Surface
    points : sequence of (x, y)
        Floats or balls.
    steps : int

    Returns
    -------
    list of [arb, arb]
        Exact.
    """
    points = [[arb(a).mid() for a in point] for point in points]
    n = len(points)
    for _ in range(steps):
        slopes, rest = arb_mat(2 * n, 2 * n), arb_mat(2 * n, 1)
        for i, point in enumerate(points):
            j = (i + 1) % n
            matrix, image = surface.jacobian(*point)
            for r in range(2):
                for c in range(2):
                    slopes[2 * i + r, 2 * i + c] += matrix[r][c].mid()
                slopes[2 * i + r, 2 * j + r] -= 1
                rest[2 * i + r, 0] = (image[r] - points[j][r]).mid()
        step = slopes.solve(rest)
        points = [
            [_clean(p - step[2 * i + r, 0]) for r, p in enumerate(point)]
            for i, point in enumerate(points)
        ]
    return points


def _clean(value):
    """The midpoint, and 0 where only rounding is left of it."""
    middle = value.mid()
    return middle if abs(middle) > arb(2) ** (16 - ctx.prec) else arb(0)


def propose(surface, points, holds):
    """A certificate for an orbit.

    Parameters
    ----------
    surface : Surface
    points : sequence of (float, float)
        (x, y) near the orbit's.
    holds : callable
        Whether a checker takes a text; the size is the largest for which it does.

    Returns
    -------
    str
    """
    with ctx.workprec(BITS):
        points = polished(surface, points)
        centres = [[decimal(a, DIGITS) for a in point] for point in points]
    return largest(lambda size: _text(surface, centres, size), holds)


def largest(text, holds):
    """A text with the largest size of one digit for which it holds.

    Parameters
    ----------
    text : callable
        The text for a size, a Fraction.
    holds : callable
        Whether a text holds; what holds for a size must hold for smaller ones.

    Returns
    -------
    str
        That with the smallest size if none holds.
    """
    sizes = [Fraction(m, 10**e) for e in range(LARGEST, SMALLEST + 1) for m in range(9, 0, -1)]
    low, high = 0, len(sizes) - 1  # what holds for a size holds for smaller ones
    while low < high:
        middle = (low + high) // 2
        if holds(text(sizes[middle])):
            high = middle
        else:
            low = middle + 1
    return text(sizes[high])


def _text(surface, centres, size):
    return (
        header("periodic orbit", surface)
        + f"radius = {float(size):.0e}\n"
        + rows("points", centres)
    )


def propose_only_fixed_point(k, g, energy):
    """The certificate that there is no other fixed point up to an energy.

    Parameters
    ----------
    k, g, energy : Fraction

    Returns
    -------
    str
    """
    longest = ceil(100 * sqrt((2 * k * energy / g**2 + 1) / (1 + k))) / 100
    return (
        f'kind = "only fixed point"\nk = "{k}"\ng = "{g}"\n'
        f'energy_up_to = "{energy}"\ntheta_below = {longest}\n'
    )
