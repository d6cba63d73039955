"""Diophantine rotation numbers, and trigonometric polynomials on a strip around the real axis.

A polynomial is the list of its complex coefficients c_0 ... c_M; c_(-q) is the conjugate of c_q, so
that it is real on the real axis. The strip of half width rho is |Im t| < rho.
"""

from collections.abc import Sequence
from math import factorial

from flint import acb, arb

from study.flight import NotProvedError

ORDER = 5  # of the Taylor polynomials in a cell
MOST_DIVISORS = 10_000  # of a rotation number, before its partial quotients are ones


def noble(quotients: Sequence[int], repeating: Sequence[int] = (1,)) -> tuple[arb, arb]:
    """Return omega = [0; quotients, then 1 for ever], and a sum of its small divisors.

    The sum is that of 1/sin(pi q omega)^2 over 0 < q < q_m, the denominator of the last convergent
    before the ones. README.md ("The theorem") has what follows for all q.
    """
    if not repeating:
        raise NotProvedError("the rotation number is rational: no partial quotients repeat")
    if list(repeating) != [1]:
        raise NotProvedError("the rotation number's partial quotients do not end in ones")
    if not all(isinstance(a, int) and a >= 1 for a in quotients) or not quotients:
        raise NotProvedError("the rotation number's partial quotients are not whole and positive")
    before, denominator = 0, 1
    for a in quotients:
        before, denominator = denominator, a * denominator + before
    if denominator > MOST_DIVISORS:
        raise NotProvedError("the rotation number's partial quotients are too large")
    value = (1 + arb(5).sqrt()) / 2
    for a in reversed(quotients):
        value = a + 1 / value
    sines = ((q / value).sin_pi() for q in range(1, denominator))
    return 1 / value, sum((1 / sine**2 for sine in sines), arb(0))


def derivative(waves: list[acb]) -> list[acb]:
    """Return the coefficients of a polynomial's derivative."""
    return [c * acb(0, 2 * q * arb.pi()) for q, c in enumerate(waves)]


def rotated(waves: list[acb], omega: arb) -> list[acb]:
    """Return the coefficients of K(t + omega)."""
    return [c * (acb(2 * q * omega)).exp_pi_i() for q, c in enumerate(waves)]


def values(waves: list[acb], count: int, offset: arb | int = 0, height: arb | int = 0) -> list[acb]:
    """Return the values at t = (j + offset)/count + i height, j = 0 ... count - 1."""
    folded = [acb(0)] * count
    for q, c in enumerate(waves):
        shift = (acb(2 * q * arb(offset) / count)).exp_pi_i()
        decay = (-2 * q * arb(height) * arb.pi()).exp()
        folded[q % count] += c * shift * decay
        if q:
            folded[-q % count] += c.conjugate() * shift.conjugate() / decay
    return [a * count for a in acb.dft(folded, inverse=True)]


def real_values(waves: list[acb], count: int, offset: arb | int = 0) -> list[arb]:
    """Return the real values at t = (j + offset)/count."""
    return [a.real for a in values(waves, count, offset)]


def transform(points: list[arb], most: int) -> list[acb]:
    """Return the discrete Fourier coefficients 0 ... most of real values on a grid."""
    return [a / len(points) for a in acb.dft(points)[: most + 1]]


class Cells:
    """The values of a polynomial on the cells of a row of a strip, by Taylor's theorem.

    Cell j is the rectangle around t_j = (j + 1/2)/count + i height with half the width `wide`, by
    default 1/(2 count), and half the height `half`, which may be 0.
    """

    def __init__(
        self,
        waves: list[acb],
        count: int,
        height: arb | int = 0,
        half: arb | int = 0,
        wide: arb | None = None,
    ):
        height, half = arb(height), arb(half)
        wide = arb(1) / (2 * count) if wide is None else wide
        real = bool(height == 0 and half == 0)
        self.box = acb(arb(0, wide.upper()), arb(0) if real else arb(0, half.upper()))
        reach = (wide * wide + half * half).sqrt()
        terms, self._columns = waves, []
        for order in range(ORDER + 1):
            row = values(terms, count, arb(0.5), height)
            self._columns.append([a / factorial(order) for a in row])
            terms = derivative(terms)
        size = arb(0)
        for q, c in enumerate(terms):
            size += 2 * abs(c) * (2 * q * arb.pi() * (abs(height) + half)).exp()
        rest = (size * reach ** (ORDER + 1) / factorial(ORDER + 1)).upper()
        self.rest = acb(arb(0, rest), arb(0) if real else arb(0, rest))

    def taylor(self, j: int) -> list[acb]:
        """Return the Taylor coefficients around the centre of cell j, without the remainder."""
        return [column[j] for column in self._columns]

    def __getitem__(self, j: int) -> acb:
        """Enclose the polynomial on cell j."""
        return evaluate(self.taylor(j), self.box) + self.rest


def evaluate(coefficients: list[acb], at: acb) -> acb:
    """Return the polynomial's value by Horner's rule."""
    total = coefficients[-1]
    for c in reversed(coefficients[:-1]):
        total = total * at + c
    return total
