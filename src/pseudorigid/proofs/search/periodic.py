"""Certificates of periodic orbits: centres from Newton's method, and the largest round box."""

from fractions import Fraction

from flint import arb, arb_mat, ctx

from .writing import decimal, header, rows

BITS = 160
DIGITS = 36
LARGEST = 2  # minus the decimal exponent of the first size that is tried


def polished(surface, points, steps=8):
    """Points ((x, y), ...), floats or balls, closer to the orbit: Newton's method on midpoints."""
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
            [(p - step[2 * i + r, 0]).mid() for r, p in enumerate(point)]
            for i, point in enumerate(points)
        ]
    return points


def propose(surface, points, holds):
    """The text of a certificate for an orbit near `points`, floats (x, y).

    `holds(text)` says whether a checker takes it: the size is the largest of one digit for which
    it does; where none is left, that of the smallest that was tried.
    """
    with ctx.workprec(BITS):
        points = polished(surface, points)
        centres = [[decimal(a, DIGITS) for a in point] for point in points]
    sizes = [Fraction(m, 10**e) for e in range(LARGEST, 13) for m in range(9, 0, -1)]
    low, high = 0, len(sizes) - 1  # what holds for a size holds for smaller ones
    while low < high:
        middle = (low + high) // 2
        if holds(_text(surface, centres, sizes[middle])):
            high = middle
        else:
            low = middle + 1
    return _text(surface, centres, sizes[high])


def _text(surface, centres, size):
    return (
        header("periodic orbit", surface)
        + f"radius = {float(size):.0e}\n"
        + rows("points", centres)
    )


