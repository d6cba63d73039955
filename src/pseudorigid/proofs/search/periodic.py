"""Certificates of periodic orbits: centres from Newton's method, and the largest round box."""

from bisect import bisect_left
from math import ceil, sqrt

from flint import arb, arb_mat, ctx

from .certificate_text import decimals, header, rows

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
        Whether a checker takes a text; the radius is the largest for which it does.

    Returns
    -------
    str
    """
    with ctx.workprec(BITS):
        centres = rows("points", decimals(polished(surface, points), DIGITS))
    return largest(header("periodic orbit", surface), centres, holds)


def largest(before, after, holds):
    """A text with the largest radius of one digit for which it holds.

    Parameters
    ----------
    before, after : str
        The text up to the line with the radius, and behind it.
    holds : callable
        Whether a text holds; what holds for a radius must hold for smaller ones.

    Returns
    -------
    str
        That with the smallest radius if none holds.
    """
    sizes = [f"{m}e-{e:02}" for e in range(LARGEST, SMALLEST + 1) for m in range(9, 0, -1)]

    def text(size):
        return f"{before}radius = {size}\n{after}"

    first = bisect_left(sizes, True, hi=len(sizes) - 1, key=lambda size: holds(text(size)))
    return text(sizes[first])


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
