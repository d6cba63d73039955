"""Truncated Taylor series in a few variables, with balls as coefficients."""

from dataclasses import dataclass
from functools import cache
from itertools import accumulate, product
from math import prod
from operator import mul
from typing import Any, TypeVar

from flint import acb, arb

Coefficient = Any  # arb or acb, all of a Jet of one type
Real = TypeVar("Real", arb, "Jet")
Value = TypeVar("Value", arb, acb, "Jet")


@dataclass(frozen=True)
class Algebra:
    """Monomials of total degree up to `order`, sorted by degree, and their multiplication table."""

    order: int
    monomials: tuple[tuple[int, ...], ...]  # the exponents of each
    products: tuple[tuple[int, int, int], ...]  # (i, j, k): monomial i times j is monomial k


@cache
def algebra(variables: int, order: int, parameter_order: int | None = None) -> Algebra:
    """Return the Algebra of series in some variables up to a total degree (cached).

    With a `parameter_order` the coefficients are series in a parameter, the last variable, and
    the algebra's order is the largest total degree.
    """
    powers = product(range(order + 1), repeat=variables)
    monomials = [p for p in powers if sum(p) <= order]
    if parameter_order is not None:
        monomials = [(*p, n) for p in monomials for n in range(parameter_order + 1)]
        order += parameter_order
    monomials.sort(key=lambda p: (sum(p), [-power for power in p]))
    index = {powers: i for i, powers in enumerate(monomials)}
    products = tuple(
        (i, j, index[total])
        for i, p in enumerate(monomials)
        for j, q in enumerate(monomials)
        if (total := tuple(a + b for a, b in zip(p, q, strict=True))) in index
    )
    return Algebra(order, tuple(monomials), products)


class Jet:
    """Truncated Taylor series: coefficients of the algebra's monomials in order."""

    def __init__(self, algebra: Algebra, coefficients: list[Coefficient]):
        self.algebra, self.coefficients = algebra, coefficients

    @classmethod
    def constant_of(cls, algebra: Algebra, value: Coefficient) -> "Jet":
        """Return the series of a constant."""
        return cls(algebra, [value] + [0 * value] * (len(algebra.monomials) - 1))

    @classmethod
    def plane(cls, order: int, x: Coefficient, y: Coefficient) -> "tuple[Jet, Jet]":
        """Return the series x + the first and y + the second of two variables."""
        first, second = cls.series(algebra(2, order), x, y)
        return first, second

    @classmethod
    def series(cls, algebra: Algebra, *values: Coefficient) -> "list[Jet]":
        """Return the series value + variable, for a value of each of the algebra's variables."""
        jets = [cls.constant_of(algebra, value) for value in values]
        for place, jet in enumerate(jets):
            powers = tuple(int(place == i) for i in range(len(values)))
            if powers in algebra.monomials:
                jet.coefficients[algebra.monomials.index(powers)] += 1
        return jets

    @property
    def constant(self) -> Coefficient:
        """Constant term."""
        return self.coefficients[0]

    def __getitem__(self, powers: tuple[int, ...]) -> Coefficient:
        return self.coefficients[self.algebra.monomials.index(powers)]

    def __add__(self, other: "Jet | Coefficient") -> "Jet":
        mine = self.coefficients
        if isinstance(other, Jet):
            theirs = other.coefficients
            return Jet(self.algebra, [a + b for a, b in zip(mine, theirs, strict=True)])
        return Jet(self.algebra, [mine[0] + other, *mine[1:]])

    __radd__ = __add__

    def __neg__(self) -> "Jet":
        return Jet(self.algebra, [-a for a in self.coefficients])

    def __sub__(self, other: "Jet | Coefficient") -> "Jet":
        return self + (-other)

    def __rsub__(self, other: Coefficient) -> "Jet":
        return (-self) + other

    def __mul__(self, other: "Jet | Coefficient") -> "Jet":
        if not isinstance(other, Jet):
            return Jet(self.algebra, [a * other for a in self.coefficients])
        mine, theirs = self.coefficients, other.coefficients
        out: list[Coefficient] = [None] * len(mine)
        for i, j, k in self.algebra.products:
            term = mine[i] * theirs[j]
            out[k] = term if out[k] is None else out[k] + term
        return Jet(self.algebra, out)

    __rmul__ = __mul__

    def __truediv__(self, other: "Jet | Coefficient") -> "Jet":
        if not isinstance(other, Jet):
            return Jet(self.algebra, [a / other for a in self.coefficients])
        return self * other._inverse()

    def __rtruediv__(self, other: Coefficient) -> "Jet":
        return self._inverse() * other

    def _inverse(self) -> "Jet":
        value = self.constant
        return self.compose([(-1) ** n / value ** (n + 1) for n in range(self.algebra.order + 1)])

    def sqrt(self) -> "Jet":
        """Return the square root with positive constant term."""
        value = self.constant
        terms = [value.sqrt()]
        for n in range(self.algebra.order):
            terms.append(terms[-1] * (1 - 2 * n) / (value * 2 * (n + 1)))
        return self.compose(terms)

    def sin_cos(self) -> "tuple[Jet, Jet]":
        """Return sine and cosine."""
        sine, cosine = self.constant.sin_cos()
        cycle = (sine, cosine, -sine, -cosine)
        terms, factorial = [], 1
        for n in range(self.algebra.order + 2):
            terms.append(cycle[n % 4] / factorial)
            factorial *= n + 1
        shifted = [n * a for n, a in enumerate(terms)][1:]  # cos = sin', term by term
        return self.compose(terms[:-1]), self.compose(shifted)

    def at(self, *substitutes: "Jet") -> "Jet":
        """Substitute a complex jet of the same algebra, which is 0 at 0, for each variable."""
        if not all(jet.constant == 0 for jet in substitutes):
            raise ValueError("a substitute is not 0 at 0: the series would lack terms")
        total, one = (Jet.constant_of(self.algebra, acb(value)) for value in (0, 1))
        repeated = ([jet] * self.algebra.order for jet in substitutes)
        powers = [list(accumulate(jets, mul, initial=one)) for jets in repeated]
        for monomial, c in zip(self.algebra.monomials, self.coefficients, strict=True):
            first, *rest = (row[i] for row, i in zip(powers, monomial, strict=True))
            total = total + prod(rest, start=first) * c
        return total

    def compose(self, terms: list[Coefficient]) -> "Jet":
        """Return the sum of terms[n] (self - constant)^n."""
        rest = Jet(self.algebra, [0 * self.constant, *self.coefficients[1:]])
        total = Jet.constant_of(self.algebra, terms[-1])
        for term in reversed(terms[:-1]):
            total = total * rest + term
        return total


def square_root(square: Value) -> Value:
    """Return the square root with positive real part; the square's must be positive, too."""
    value = square.constant if isinstance(square, Jet) else square
    if not value.real > 0:
        raise ArithmeticError("a square root is not proved to be analytic")
    if isinstance(square, acb):
        return _complex_root(square)
    if isinstance(square, Jet) and isinstance(value, acb):
        return _complex_series_root(square)
    return square.sqrt()


def _complex_series_root(square: Jet) -> Jet:
    """Return the square root of a complex series, by Newton steps from that of its constant."""
    total, order = Jet.constant_of(square.algebra, _complex_root(square.constant)), 0
    while order < square.algebra.order:
        excess = total * total - square
        excess.coefficients[0] = acb(0)
        total = total - excess / (total * 2)
        order = 2 * order + 1
    return total


def _complex_root(square: acb) -> acb:
    """Enclose the square roots of a set more narrowly than Arb does, from those of its midpoint.

    If s^2 = z and t^2 = m, then s = t + (z - m)/(s + t).
    """
    middle = square.mid()
    centre, root = middle.sqrt(), square.sqrt()
    for _ in range(3):
        root = intersection(root, centre + (square - middle) / (root + centre))
    return root


def intersection(a: acb, b: acb) -> acb:
    """Return the intersection of two sets that are known to meet."""
    return acb(a.real.intersection(b.real), a.imag.intersection(b.imag))
