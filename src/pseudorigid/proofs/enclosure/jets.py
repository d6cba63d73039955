"""Truncated Taylor series in a few variables, with balls as coefficients."""

from dataclasses import dataclass
from functools import cache
from itertools import product
from math import prod

from flint import acb, arb


@dataclass(frozen=True)
class Algebra:
    """Monomials of total degree up to `order`, sorted by degree, and their multiplication table."""

    order: int
    monomials: tuple  # the exponents of each
    products: tuple  # (i, j, k): monomial i times monomial j is monomial k


@cache
def algebra(variables: int, order: int) -> Algebra:
    """Return the Algebra of series in some variables up to a total degree (cached)."""
    monomials = [p for p in product(range(order + 1), repeat=variables) if sum(p) <= order]
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
    """Truncated Taylor series: coefficients, arb or acb, of the algebra's monomials in order."""

    def __init__(self, algebra: Algebra, coefficients: list):
        self.algebra, self.coefficients = algebra, coefficients

    @classmethod
    def constant_of(cls, algebra: Algebra, value: arb | acb) -> "Jet":
        """The series of a constant."""
        return cls(algebra, [value] + [0 * value] * (len(algebra.monomials) - 1))

    @classmethod
    def plane(cls, order: int, *values: arb | acb) -> list["Jet"]:
        """The two series value + variable, for values of the variables."""
        jets = [cls.constant_of(algebra(2, order), value) for value in values]
        for i, jet in enumerate(jets, 1):
            jet.coefficients[i] = jet.coefficients[i] + 1
        return jets

    @property
    def constant(self) -> arb | acb:
        """Constant term."""
        return self.coefficients[0]

    def __getitem__(self, powers):
        return self.coefficients[self.algebra.monomials.index(powers)]

    def __add__(self, other):
        mine = self.coefficients
        if isinstance(other, Jet):
            theirs = other.coefficients
            return Jet(self.algebra, [a + b for a, b in zip(mine, theirs, strict=True)])
        return Jet(self.algebra, [mine[0] + other, *mine[1:]])

    __radd__ = __add__

    def __neg__(self):
        return Jet(self.algebra, [-a for a in self.coefficients])

    def __sub__(self, other):
        return self + (-other)

    def __rsub__(self, other):
        return (-self) + other

    def __mul__(self, other):
        if not isinstance(other, Jet):
            return Jet(self.algebra, [a * other for a in self.coefficients])
        mine, theirs = self.coefficients, other.coefficients
        out = [None] * len(mine)
        for i, j, k in self.algebra.products:
            term = mine[i] * theirs[j]
            out[k] = term if out[k] is None else out[k] + term
        return Jet(self.algebra, out)

    __rmul__ = __mul__

    def __truediv__(self, other):
        if not isinstance(other, Jet):
            return Jet(self.algebra, [a / other for a in self.coefficients])
        return self * other._inverse()

    def __rtruediv__(self, other):
        return self._inverse() * other

    def _inverse(self):
        value = self.constant
        return self._compose([(-1) ** n / value ** (n + 1) for n in range(self.algebra.order + 1)])

    def sqrt(self) -> "Jet":
        """The square root with positive constant term."""
        value = self.constant
        terms = [value.sqrt()]
        for n in range(self.algebra.order):
            terms.append(terms[-1] * (1 - 2 * n) / (value * 2 * (n + 1)))
        return self._compose(terms)

    def sin_cos(self) -> tuple["Jet", "Jet"]:
        """Sine and cosine."""
        sine, cosine = self.constant.sin_cos()
        cycle = (sine, cosine, -sine, -cosine)
        terms, factorial = [], 1
        for n in range(self.algebra.order + 2):
            terms.append(cycle[n % 4] / factorial)
            factorial *= n + 1
        shifted = [n * a for n, a in enumerate(terms)][1:]  # cos = sin', term by term
        return self._compose(terms[:-1]), self._compose(shifted)

    def at(self, *substitutes: "Jet") -> "Jet":
        """Substitute a complex jet of the same algebra for each variable."""
        total, one = (Jet.constant_of(self.algebra, acb(value)) for value in (0, 1))
        powers = [[one] for _ in substitutes]
        for row, jet in zip(powers, substitutes, strict=True):
            for _ in range(self.algebra.order):
                row.append(row[-1] * jet)
        for monomial, c in zip(self.algebra.monomials, self.coefficients, strict=True):
            first, *rest = (row[i] for row, i in zip(powers, monomial, strict=True))
            total = total + prod(rest, start=first) * c
        return total

    def _compose(self, terms):
        """The sum of terms[n] (self - constant)^n."""
        rest = Jet(self.algebra, [0 * self.constant, *self.coefficients[1:]])
        total = Jet.constant_of(self.algebra, terms[-1])
        for term in reversed(terms[:-1]):
            total = total * rest + term
        return total
