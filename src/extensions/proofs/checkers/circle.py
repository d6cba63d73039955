"""Trigonometric polynomials on a strip around the real axis, and noble rotation numbers.

A polynomial is the sum of c_q exp(2 pi i q t), |q| <= M, and is real on the real axis. It is given
by the list c_0 ... c_M, as c_(-q) is the conjugate of c_q. The strip is |Im t| < rho.
"""

from collections.abc import Sequence
from math import factorial

from flint import acb, arb

from pseudorigid.verified.flight import NotProvedError

ORDER = 5  # of the Taylor polynomials in a cell
MOST_DENOMINATOR = 10_000  # q_m of a rotation number: the sum S has q_m - 1 terms


def noble(quotients: Sequence[int], repeating: Sequence[int] = (1,)) -> tuple[arb, arb]:
    """Return omega = [0; quotients, 1, 1, ...], and the sum S of its inverse square divisors.

    S is the sum of 1/sin(pi q omega)^2 over 0 < q < q_m, where q_m is the denominator of the last
    convergent before the ones. By S theory/curves.md ("The theorem") bounds longer sums.
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
    if denominator > MOST_DENOMINATOR:
        raise NotProvedError("the rotation number's partial quotients are too large")
    value = (1 + arb(5).sqrt()) / 2
    for a in reversed(quotients):
        value = a + 1 / value
    sines = ((q / value).sin_pi() for q in range(1, denominator))
    return 1 / value, sum((1 / sine**2 for sine in sines), arb(0))


def derivative(coefficients: list[acb]) -> list[acb]:
    """Return the coefficients of a polynomial's derivative."""
    return [c * acb(0, 2 * q * arb.pi()) for q, c in enumerate(coefficients)]


def rotated(coefficients: list[acb], omega: arb) -> list[acb]:
    """Return the coefficients of the polynomial at t + omega, as a function of t."""
    return [c * (acb(2 * q * omega)).exp_pi_i() for q, c in enumerate(coefficients)]


def values(
    coefficients: list[acb], count: int, offset: arb | int = 0, height: arb | int = 0
) -> list[acb]:
    """Return the values at t = (j + offset)/count + i height, j = 0 ... count - 1."""
    folded = [acb(0)] * count  # waves whose q agree modulo count agree on the grid
    for q, c in enumerate(coefficients):
        shift = (acb(2 * q * arb(offset) / count)).exp_pi_i()
        decay = (-2 * q * arb(height) * arb.pi()).exp()
        folded[q % count] += c * shift * decay
        if q:
            folded[-q % count] += c.conjugate() * shift.conjugate() / decay
    return [a * count for a in acb.dft(folded, inverse=True)]


def real_values(coefficients: list[acb], count: int, offset: arb | int = 0) -> list[arb]:
    """Return the real values at t = (j + offset)/count."""
    return [a.real for a in values(coefficients, count, offset)]


def transform(points: list[arb], most: int) -> list[acb]:
    """Return c_0 ... c_most of the polynomial that has these values on the grid j/n."""
    return [a / len(points) for a in acb.dft(points)[: most + 1]]


class Cells:
    """Enclosures of a polynomial on a row of rectangles in the strip, by Taylor's theorem.

    Cell j has the centre (j + 1/2)/count + i height, the half width `half_width`, by default
    1/(2 count), and the half height `half_height`; if this is 0, the cell is a segment.
    """

    def __init__(
        self,
        coefficients: list[acb],
        count: int,
        height: arb | int = 0,
        half_height: arb | int = 0,
        half_width: arb | None = None,
    ):
        height, half_height = arb(height), arb(half_height)
        half_width = arb(1) / (2 * count) if half_width is None else half_width
        real = bool(height == 0 and half_height == 0)
        self.box = acb(arb(0, half_width.upper()), arb(0) if real else arb(0, half_height.upper()))
        reach = (half_width * half_width + half_height * half_height).sqrt()
        terms, self._columns = coefficients, []
        for order in range(ORDER + 1):
            row = values(terms, count, arb(0.5), height)
            self._columns.append([a / factorial(order) for a in row])
            terms = derivative(terms)
        size = arb(0)  # of the derivative of order ORDER + 1, which `terms` is now
        for q, c in enumerate(terms):
            size += 2 * abs(c) * (2 * q * arb.pi() * (abs(height) + half_height)).exp()
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
