"""A second checker of the certificates for periodic orbits, horseshoes and the diffeomorphism.

It shares no code with the package and needs nothing but Python and its standard library.
`python tests/extensions/proofs/second_checker.py` checks the package's certificates. The theorems
that it uses are those of src/extensions/proofs/README.md. It takes other ways than the package's
checker:

- Numbers are intervals of Python's integers, not balls of Arb, and sine and cosine are its own.
- That no impact is missed follows from a bound on the distance of a function from its chord.
- An orbit is proved by Brouwer's theorem, and alone by a comparison vector, without elimination.
- Coverings are proved from images of single points and, again, the distance from a chord.

Nothing rests on floating point. Doubles only propose what intervals then prove: a time near the
first root, and the approximate inverse of a matrix.

THE CHORD LEMMA is used three times. Let f be twice differentiable on [a, b], and l its chord, the
linear function with l(a) = f(a) and l(b) = f(b). At each t in [a, b], for some u in (a, b),
f(t) = l(t) - f''(u) (t - a) (b - t)/2, and (t - a) (b - t) <= (b - a)^2/4. (This is the error of
linear interpolation, by Rolle's theorem.)
"""

import re
import tomllib
from fractions import Fraction
from functools import reduce
from itertools import combinations, pairwise
from math import ceil, cos, factorial, floor, gcd, isqrt, sin
from operator import add, mul
from pathlib import Path

CERTIFICATES = Path(__file__).resolve().parents[3] / "src/extensions/proofs/certificates"


class NotProvedError(Exception):
    """The reason why a statement is not proved."""


# ---- intervals

BITS = 160  # numbers are integers times 2^-160, about 7e-49; certificates have up to 36 digits
ONE = 1 << BITS


class Interval:
    """All real numbers from lo to hi, two integers in units of 2^-BITS.

    The result of an operation contains the results for all numbers of its operands: lower ends are
    rounded down and upper ends up. Python's // and >> round down; -(-a // b) rounds up.
    """

    __slots__ = ("hi", "lo")

    def __init__(self, lo, hi):
        self.lo, self.hi = lo, hi

    @classmethod
    def of(cls, number):
        scaled = Fraction(number) * ONE
        return cls(floor(scaled), ceil(scaled))

    def __add__(self, other):
        return Interval(self.lo + other.lo, self.hi + other.hi)

    def __sub__(self, other):
        return Interval(self.lo - other.hi, self.hi - other.lo)

    def __neg__(self):
        return Interval(-self.hi, -self.lo)

    def __abs__(self):
        if self.lo >= 0:
            return self
        return -self if self.hi <= 0 else Interval(0, max(-self.lo, self.hi))

    def __mul__(self, other):
        a, b, c, d = self.lo, self.hi, other.lo, other.hi
        products = a * c, a * d, b * c, b * d
        return Interval(min(products) >> BITS, -(-max(products) >> BITS))

    def __truediv__(self, other):
        if other.lo <= 0 <= other.hi:
            raise NotProvedError("a divisor may be zero")
        # 1/t falls on either side of zero, so that its extremes are at the ends
        return self * Interval(ONE * ONE // other.hi, -(-ONE * ONE // other.lo))

    def __lt__(self, other):
        """Whether every number of self is below every number of the other."""
        return self.hi < other.lo

    def square(self):
        """Squares: never negative, which self * self may be."""
        low, high = abs(self).lo, abs(self).hi
        return Interval(low * low >> BITS, -(-high * high >> BITS))

    def sqrt(self):
        """Square roots: isqrt(n)^2 <= n < (isqrt(n) + 1)^2."""
        if self.lo <= 0:
            raise NotProvedError("a root may be that of zero or of a negative number")
        return Interval(isqrt(self.lo << BITS), isqrt(self.hi << BITS) + 1)

    def sine_cosine(self):
        """Sine and cosine, by the chord lemma with |f''| <= 1: at most h^2/8 from the chord."""
        low = high = sine_cosine_at(self.lo)
        if self.hi > self.lo:
            high = sine_cosine_at(self.hi)
        distance = ((self.hi - self.lo) ** 2 >> (BITS + 3)) + 1
        return [hull(ends).plus_minus(distance) for ends in zip(low, high, strict=True)]

    def plus_minus(self, radius):
        """Widen by an integer number of units on both sides."""
        return Interval(self.lo - radius, self.hi + radius)

    def middle(self):
        return (self.lo + self.hi) / (2 * ONE)


def hull(intervals):
    return Interval(min(a.lo for a in intervals), max(a.hi for a in intervals))


ZERO, HALF, UNITY, TWO = (Interval.of(Fraction(a, 2)) for a in (0, 1, 2, 4))
UNIT, PART, ENDS = Interval(-ONE, ONE), Interval(0, ONE), (-UNITY, UNITY)


def sine_cosine_at(t):
    """Enclose sine and cosine of t units, 0 <= t <= 32, by their Taylor series.

    The n-th term, t^n/n!, is computed from the one before, rounded down in units of 2^-P,
    P = BITS + 64. Its error e(n) satisfies e(n) <= e(n - 1) t/n + 1. So the errors of N terms sum
    up to at most N exp(t): an error of 1 in the m-th term leads to t^j m!/(m + j)! <= t^j/j! in
    the one j later. Here N < 2^8, since 32^200/200! < 2^-P, and exp(32) < 2^47. The series stops
    behind a term that is rounded to 0 and has n >= 2 t. The term itself is then at most
    e(n) < 2^55, and the following ones, each at most half of the one before, sum up to no more. So
    the sums are wrong by less than 2^57 units of 2^-P: less than one unit of 2^-BITS.
    """
    if not 0 <= t <= 32 * ONE:
        raise NotProvedError("a flight may be longer than 32 units of time")
    bits, wide = BITS + 64, t << 64
    term, n = 1 << bits, 0
    sums = [term, 0]  # of even and of odd powers: cosine and sine
    while term or n * ONE < 2 * t:
        n += 1
        term = (term * wide >> bits) // n
        sums[n & 1] += -term if n & 2 else term
    cosine, sine = (Interval((a >> 64) - 1, (a >> 64) + 2) for a in sums)
    return sine, cosine


# ---- derivatives


class Series:
    """Taylor polynomial of second order in two variables, with Intervals as coefficients.

    The coefficients are those of 1, p, q, p^2, p q, q^2. If those of the operands enclose functions
    and their derivatives over a set, so do those of the result: the coefficient of p^2 encloses
    half the second derivative by p at each point of the set, and so on. An Interval stands on the
    right of an operator.
    """

    __slots__ = ("c",)

    def __init__(self, *coefficients):
        self.c = coefficients

    def __add__(self, other):
        if type(other) is Interval:
            return Series(self.c[0] + other, *self.c[1:])
        return Series(*(a + b for a, b in zip(self.c, other.c, strict=True)))

    def __neg__(self):
        return Series(*(-a for a in self.c))

    def __sub__(self, other):
        return self + -other

    def __mul__(self, other):
        if type(other) is Interval:
            return Series(*(a * other for a in self.c))
        a, p, q, pp, pq, qq = self.c
        b, r, s, rr, rs, ss = other.c
        second = a * rr + p * r + pp * b, a * rs + p * s + q * r + pq * b, a * ss + q * s + qq * b
        return Series(a * b, a * r + p * b, a * s + q * b, *second)

    def through(self, value, slope, bend):
        """Return h of this series, from h, h' and h''/2 at its constant term: the chain rule."""
        _, p, q, *second = self.c
        squares = p.square(), p * q * TWO, q.square()
        second = [slope * a + bend * b for a, b in zip(second, squares, strict=True)]
        return Series(value, slope * p, slope * q, *second)

    def square(self):
        """Square of the series."""
        return self.through(self.c[0].square(), self.c[0] * TWO, UNITY)

    def sqrt(self):
        """Square root r, with r' = 1/(2 r) and r''/2 = -1/(8 r^3)."""
        root = self.c[0].sqrt()
        slope = HALF / root
        return self.through(root, slope, -(slope * slope * slope))

    def sine_cosine(self):
        """Sine and cosine of the series."""
        sine, cosine = self.c[0].sine_cosine()
        first = self.through(sine, cosine, -sine * HALF)
        return first, self.through(cosine, -sine, -cosine * HALF)


# ---- the map


class ImpactMap:
    """The impact map P of one ball at one energy, in the chart (x, y), y = xdot - k udot.

    Every result holds for the exact k, g and energy. Before an impact let s = xdot + udot, and let
    k' = 1/(1 + k). By eq. (25) the flight begins with the velocities

        b = k' (y - k s) of x,     c = -k' (y + s) of u,

    and its gap, eq. (21) with (26), is f(t) = -s t + g t^2/2 + c (sin t - t) + x (1 - cos t). Here
    s, y and x occur once each if c is inserted:

        f(t) = g t^2/2 - s ((1 - k') t + k' sin t) + k' y (t - sin t) + x (1 - cos t).

    The impact is at the first T > 0 with f(T) = 0.
    """

    def __init__(self, k, g, energy):
        self.k, self.g, self.half_g = Interval.of(k), Interval.of(g), Interval.of(g / 2)
        self.share, self.rest = Interval.of(1 / (1 + k)), Interval.of(k / (1 + k))  # k', 1 - k'
        self.over_k, self.scale = Interval.of(1 / k), Interval.of((1 + k) / k)
        self.reach, self.centre = Interval.of(2 * energy + g * g / k), Interval.of(g / k)

    def speed(self, x, y):
        """Enclose s > 0, from k s^2 = (1 + k) (2 E + 2 g x - k x^2) - y^2, which is the energy.

        The square in x is completed, so that x occurs once: 2 g x - k x^2 = g^2/k - k (x - g/k)^2.
        """
        square = -(x - self.centre).square() * self.k + self.reach
        return (square * self.scale - y.square() * self.over_k).sqrt()

    def velocity(self, x, y):
        """Enclose xdot = k' (y + k s) before the impact."""
        return (y + self.speed(x, y) * self.k) * self.share

    def gap(self, t, x, y, s):
        """Enclose f and f' at t, for Intervals or Series."""
        sine, cosine = t.sine_cosine()
        versine = -cosine + UNITY
        height = t.square() * self.half_g - s * (t * self.rest + sine * self.share)
        height = height + (t - sine) * self.share * y + versine * x
        slope = t * self.g - s * (-versine * self.share + UNITY)
        return height, slope + versine * self.share * y + sine * x

    def gap_at(self, t, state):
        return self.gap(Interval(t, t), *state)[0]

    def first_root(self, x, y):
        """Enclose the first root T of f for every point of a box; it is simple.

        Since f'' = g + x cos t - c sin t, it is between g - A and g + A, A = sqrt(x^2 + c^2).

        1. f(0) = 0 and f'(0) = -s. So f <= -s t + (g + A) t^2/2, which is negative for
           0 < t < 2 s/(g + A). The first half of that needs no further proof.
        2. From there to low `negative_between` proves f < 0.
        3. From low to high f' > 0, and f(high) > 0. So there is one root in between.
        """
        s = self.speed(x, y)
        state, c = (x, y, s), (y + s) * self.share
        amplitude = (x.square() + c.square()).sqrt()
        start = (s.lo << BITS) // (self.g + amplitude).hi
        near = int(self.approximate_root(*(a.middle() for a in state)) * 2.0**60) << (BITS - 60)
        at_near, slope = self.gap(Interval(near, near), *state)
        if not slope.lo > 0:
            raise NotProvedError("two impacts may be one: the slope of the gap may vanish")
        half = (abs(at_near).hi << BITS) // slope.lo + (ONE >> 56)
        for _ in range(8):
            half += half >> 3
            low, high = near - half, near + half
            if start < low and self.gap_at(low, state).hi < 0 < self.gap_at(high, state).lo:
                break
        rising = self.gap(Interval(low, high), *state)[1].lo > 0
        if not (rising and start < low and self.gap_at(high, state).lo > 0):
            raise NotProvedError("no root is isolated near the proposed time")
        self.negative_between(start, low, state, max(0, (amplitude - self.g).hi))
        return Interval(low, high)

    def negative_between(self, start, end, state, concavity):
        """Prove f < 0 from start to end, where f'' >= -concavity, by halving.

        By the chord lemma f lies between a and b below the parabola l + M (t - a) (b - t)/2,
        M = concavity and h = b - a. It is negative in each of two cases, if f(a) < 0 and f(b) < 0:

        - The larger of the two, plus M h^2/8, is negative.
        - |f(b) - f(a)| >= M h^2/2. Then the parabola is monotonic, hence highest at a or b.
        """
        parts = [(start, self.gap_at(start, state), end, self.gap_at(end, state))]
        while parts:
            a, at_a, b, at_b = parts.pop()
            eighth = (concavity * (b - a) ** 2 >> (2 * BITS + 3)) + 1
            rise = max(at_b.lo - at_a.hi, at_a.lo - at_b.hi)
            if max(at_a.hi, at_b.hi) >= 0 or b - a < ONE >> 40:
                raise NotProvedError("the ball may touch the floor earlier")
            if max(at_a.hi, at_b.hi) + eighth >= 0 and rise < 4 * eighth:
                middle = (a + b) // 2
                at_middle = self.gap_at(middle, state)
                parts += [(middle, at_middle, b, at_b), (a, at_a, middle, at_middle)]

    def approximate_root(self, x, y, s):
        """Propose the first root in doubles, by small steps and then by halving."""
        share, g = self.share.middle(), self.g.middle()

        def gap(t):
            curvature = share * (t - sin(t))
            return g * t * t / 2 - s * (t - curvature) + curvature * y + x * (1 - cos(t))

        step, low = 0.02, s / (g + abs(x) + share * abs(y + s))
        while gap(low + step) < 0 and low < 30:
            low += step
        for _ in range(60):
            step /= 2
            if gap(low + step) < 0:
                low += step
        return low

    def narrowed(self, root, state):
        """Narrow an enclosure of the root by interval Newton, T = m - f(m)/f'(T).

        The root is in it: f(m) = f(m) - f(root) = f'(u) (m - root) for a u in the enclosure.
        """
        while True:
            middle = (root.lo + root.hi) // 2
            step = self.gap_at(middle, state) / self.gap(root, *state)[1]
            new = Interval(max(middle - step.hi, root.lo), min(middle - step.lo, root.hi))
            if 4 * (new.hi - new.lo) > 3 * (root.hi - root.lo):
                return new
            root = new

    def image(self, x, y, bracket):
        """Enclose the images (x, y) of all points of a box, or of two Series over a box.

        The bracket is `first_root` of this box or of a larger one. In it lies just one root of
        each flight, the first.
        """
        s = self.speed(x, y)
        state = [a.c[0] if type(a) is Series else a for a in (x, y, s)]
        time = self.narrowed(bracket, state)
        if type(x) is Series:
            time = self.expanded(time, x, y, s)
        sine, cosine = time.sine_cosine()
        c = -(y + s) * self.share
        velocity = (y - s * self.k) * self.share + time * self.g
        return x * cosine - c * sine, velocity - (x * sine + c * cosine) * self.k

    def expanded(self, root, x, y, s):
        """Expand the root T in a Series, by implicit differentiation of f(T) = 0.

        If T is right up to an order n, then f(T) begins with the order n + 1, and T - f(T)/f'(root)
        is right up to this order. Here n = 0 and n = 1.
        """
        time = Series(root, *[ZERO] * 5)
        slope = self.gap(root, x.c[0], y.c[0], s.c[0])[1]
        for known, new in ((1, 3), (3, 6)):
            rest = self.gap(time, x, y, s)[0]
            terms = [-a / slope for a in rest.c[known:new]]
            time = Series(*time.c[:known], *terms, *[ZERO] * (6 - new))
        return time

    def derivative(self, x, y):
        point = Series(x, UNITY, *[ZERO] * 4), Series(y, ZERO, UNITY, *[ZERO] * 3)
        return [part.c[1:3] for part in self.image(*point, self.first_root(x, y))]


# ---- periodic orbits

CLOSE = Fraction(1, 10**30)  # largest distance of a certificate's point from the orbit's


def prove_orbit(surface, centres, radius):
    """Prove that one orbit of prime period n has its points, in order, in boxes around n centres.

    Returns enclosures of its points and of the trace of DP^n. Let F be the shooting map,
    F_i = P(z_i) - z_(i+1), on the product X of the boxes, m its centre, A an interval matrix that
    contains DF over X, and Y any matrix. For z and z' in X, F(z) - F(z') = A' (z - z') with an A'
    in A: the mean of DF along the segment. Let C >= |1 - Y A|, d >= |Y F(m)|, and let w be a vector
    with 0 < w <= radius and d + C w < w, each in all coordinates.

    1. A matrix A' in A is regular: if A' v = 0 and v /= 0, then |v| = |(1 - Y A') v| <= C |v|. At
       the coordinate where |v_i|/w_i is largest, say r, this is r w_i <= r (C w)_i < r w_i: wrong.
       So is Y, as Y A' is regular for the same reason. Hence F has at most one zero in X.
    2. z -> z - Y F(z) maps the box m +- w into itself: its distance from m is at most
       |Y F(m)| + |(1 - Y A') (z - m)| <= d + C w. By Brouwer's theorem it has a fixed point, which
       is a zero of F, since Y is regular. So the zero in X exists and is in m +- w.
    """
    n = len(centres)
    size = Interval.of(radius).hi
    if size <= 0:
        raise NotProvedError("a radius is not positive")
    points, residuals = [[Interval.of(a) for a in centre] for centre in centres], []
    matrix = [[ZERO] * (2 * n) for _ in range(2 * n)]
    for i, (x, y) in enumerate(points):
        image = surface.image(x, y, surface.first_root(x, y))
        rows = surface.derivative(x.plus_minus(size), y.plus_minus(size))
        after = (i + 1) % n
        for r in range(2):
            residuals.append(image[r] - points[after][r])
            for c in range(2):
                matrix[2 * i + r][2 * i + c] += rows[r][c]
            matrix[2 * i + r][2 * after + r] -= UNITY
    inverse = approximate_inverse([[a.middle() for a in row] for row in matrix])
    inverse = [[Interval(a, a) for a in (int(b * 2.0**BITS) for b in row)] for row in inverse]
    distances = [abs(dot(row, residuals)).hi for row in inverse]
    contraction = [[dot(row, column) for column in zip(*matrix, strict=True)] for row in inverse]
    for i, row in enumerate(contraction):
        row[i] -= UNITY
    contraction = [[abs(a).hi for a in row] for row in contraction]
    # if C contracts, this leads to the sum of C^j (d + least), which is such a vector
    widths, least = [0] * (2 * n), max(distances) + 8
    for _ in range(200):
        moved = [sum(map(mul, row, widths)) // ONE + 1 for row in contraction]
        moved = list(map(add, moved, distances))
        if max(widths) <= size and all(a < b for a, b in zip(moved, widths, strict=True)):
            break
        widths = [a + least for a in moved]
    else:
        raise NotProvedError("the boxes are not proved to contain exactly one orbit")
    widths = iter(widths)
    orbit = [[a.plus_minus(next(widths)) for a in point] for point in points]
    for first, second in combinations(orbit, 2):
        if not any(a < b or b < a for a, b in zip(first, second, strict=True)):
            raise NotProvedError("two points may be one: the period may be shorter")
    product = [[UNITY, ZERO], [ZERO, UNITY]]
    for point in orbit:
        columns, rows = list(zip(*product, strict=True)), surface.derivative(*point)
        product = [[dot(row, column) for column in columns] for row in rows]
    return orbit, product[0][0] + product[1][1]


def dot(row, column):
    return reduce(add, map(mul, row, column))


def approximate_inverse(matrix):
    """Invert a matrix of doubles by the method of Gauss and Jordan; any result may be proposed."""
    n = len(matrix)
    rows = [[*row, *(float(i == j) for j in range(n))] for i, row in enumerate(matrix)]
    for i in range(n):
        pivot = max(range(i, n), key=lambda r: abs(rows[r][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        rows[i] = [a / rows[i][i] for a in rows[i]]
        for j in range(n):
            if j != i:
                rows[j] = [a - rows[j][i] * b for a, b in zip(rows[j], rows[i], strict=True)]
    return [row[n:] for row in rows]


def check_type(trace, expected):
    """Prove the type of an orbit from the trace of DP^n."""
    types = {"elliptic": abs(trace) < TWO, "hyperbolic": trace > TWO}
    types["inverse hyperbolic"] = trace < -TWO
    if not types[expected]:
        raise NotProvedError(f"the orbit is not proved to be {expected}")


def check_window(surface, orbit, window):
    for x, y in orbit:
        if is_between(x, window[0]) and is_between(surface.velocity(x, y), window[1]):
            return
    raise NotProvedError("no point of the orbit is proved to lie in the window of the statement")


def is_between(interval, ends):
    return Interval.of(ends[0]) < interval < Interval.of(ends[1])


def check_orbit(certificate, k, g, energy, period, type, radius, window):
    """Prove the statement on a periodic orbit: period, type, window, and that it is alone.

    The boxes are larger than the certificate's by CLOSE, and the orbit's points are nearer than
    that to their centres. So the boxes contain those of the stated radius around the orbit itself.
    """
    certificate.check_constants("periodic orbit", k=k, g=g, energy=energy)
    centres, size = certificate.rows("points", 2), certificate.number("radius")
    if len(centres) != period:
        raise NotProvedError(f"the certificate has {len(centres)} points, not {period}")
    if not size >= radius:
        raise NotProvedError(f"the radius is {float(size):g}, not {float(radius):g} as stated")
    surface = ImpactMap(k, g, energy)
    orbit, trace = prove_orbit(surface, centres, size + CLOSE)
    check_type(trace, type)
    for point, centre in zip(orbit, centres, strict=True):
        for value, stated in zip(point, centre, strict=True):
            if not is_between(value, (stated - CLOSE, stated + CLOSE)):
                raise NotProvedError(f"a point of the orbit is not the stated {float(stated):.10g}")
    check_window(surface, orbit, window)
    return {"x": orbit[0][0], "trace": trace}


# ---- horseshoes


class Parallelogram:
    """The points centre + p u + q s, |p|, |q| <= 1; the map expands along u, contracts along s."""

    def __init__(self, name, row):
        self.name, self.row = name, row  # six exact numbers: centre, u, s
        values = [Interval.of(a) for a in row]
        self.centre, self.u, self.s = values[:2], values[2:4], values[4:]
        self.area = self.u[0] * self.s[1] - self.u[1] * self.s[0]

    def point(self, p, q):
        sides = zip(self.centre, self.u, self.s, strict=True)
        return [c + p * u + q * s for c, u, s in sides]

    def series(self, p, q):
        parts = zip(self.point(p, q), self.u, self.s, strict=True)
        return [Series(*part, ZERO, ZERO, ZERO) for part in parts]

    def coordinates(self, x, y):
        dx, dy, inverse = x - self.centre[0], y - self.centre[1], UNITY / self.area
        p = (dx * self.s[1] - dy * self.s[0]) * inverse
        return p, (dy * self.u[0] - dx * self.u[1]) * inverse

    def is_disjoint(self, other):
        """Whether a line along a side of one of the two sets is proved to separate them."""
        for reference, moved in ((self, other), (other, self)):
            corners = [reference.coordinates(*moved.point(p, q)) for p in ENDS for q in ENDS]
            for values in zip(*corners, strict=True):
                if hull(values) > UNITY or hull(values) < -UNITY:
                    return True
        return False


def mirrored(row):
    """Mirror a parallelogram by the reversor (x, y) -> (x, -y), which exchanges u and s."""
    x, y, ux, uy, sx, sy = row
    return [x, -y, sx, -sy, ux, -uy]


def check_relation(surface, source, target, stated):
    """Prove that the source covers the target, with the stated margins, and the cone condition.

    Let (p', q') be the target's coordinates of P. Its derivatives of second order are enclosed on
    the whole source, and its values at the corners of a grid of n by n cells, each 2/n long in p
    and in q. In a cell the chord lemma is applied along p on both edges, then along q between them.
    So p' and q' are in the hull of their values at the corners, less a part of pp/n^2 and a part of
    qq/n^2; pp and qq enclose half the second derivatives, and a part is a factor from 0 to 1. On an
    edge of the source, p = -1 or p = 1, the second part alone is needed. The grid is refined until
    the margins are the stated ones.
    """
    whole = source.series(UNIT, UNIT)
    bracket = surface.first_root(*(a.c[0] for a in whole))
    image = target.coordinates(*surface.image(*whole, bracket))
    at_centre = target.coordinates(*surface.image(*source.series(ZERO, ZERO), bracket))
    check_cones(at_centre, image, source, target)
    for n in (1, 2, 4, 8):
        nodes = [Interval.of(Fraction(2 * i - n, n)) for i in range(n + 1)]
        columns = [[surface.image(*source.point(p, q), bracket) for q in nodes] for p in nodes]
        grid = [[target.coordinates(*point) for point in column] for column in columns]
        part = Interval.of(Fraction(1, n * n)) * PART
        low, high = (hull([p for p, _ in grid[i]]) - image[0].c[5] * part for i in (0, -1))
        if high < low:
            low, high = high, low
        across = hull([q for column in grid for _, q in column])
        across = across - image[1].c[3] * part - image[1].c[5] * part
        beyond, room = min((-UNITY - low).lo, (high - UNITY).lo), (UNITY - abs(across)).lo
        least = [Interval.of(a).hi for a in stated]
        if 0 < beyond >= least[0] and 0 < room >= least[1]:
            return beyond, room
    how = "covers {}, but by less than is stated" if min(beyond, room) > 0 else "does not cover {}"
    raise NotProvedError(f"{source.name} {how.format(target.name)}")


def check_cones(at_centre, image, source, target):
    """Prove D^T Q' D - Q > 0, Q = p^2 - q^2, for all D in the interval hull of DP over the source.

    By the mean value theorem a derivative by p differs from that at the centre by at most
    |2 pp| + |pq|, one by q by at most |pq| + |2 qq|, where pp, pq and qq enclose the coefficients
    of second order. A symmetric matrix is positive if its first entry and its determinant are.
    """
    rows = []
    for part, centre in zip(image, at_centre, strict=True):
        pp, pq, qq = map(abs, part.c[3:])
        by_p, by_q = centre.c[1:3]
        rows.append((by_p.plus_minus((pp * TWO + pq).hi), by_q.plus_minus((pq + qq * TWO).hi)))
    (a, b), (c, d) = rows
    first, last = a.square() - c.square() - UNITY, b.square() - d.square() + UNITY
    if not (first.lo > 0 and (first * last - (a * b - c * d).square()).lo > 0):
        raise NotProvedError(f"cone condition not proved from {source.name} to {target.name}")


def check_horseshoe(certificate, k, g, energy, period, radius, window, crossing, entropy):
    """Prove the statement on a horseshoe: all that the page of proofs lists but the angle."""
    certificate.check_constants("horseshoe", k=k, g=g, energy=energy)
    surface = ImpactMap(k, g, energy)
    saddles, chain, leaves, enters = sets_of(certificate)
    if len(saddles) != period:
        raise NotProvedError(f"the certificate has {len(saddles)} saddles, not {period}")
    # the paper's orbit is in the sets at the saddles
    orbit, trace = prove_orbit(surface, [a.row[:2] for a in saddles], radius)
    check_type(trace, "hyperbolic")
    check_window(surface, orbit, window)
    for saddle, point in zip(saddles, orbit, strict=True):
        if not all(abs(a) < UNITY for a in saddle.coordinates(*point)):
            raise NotProvedError(f"{saddle.name} is not proved to contain the orbit's point")
    # the root of x^-period + x^-loop = 1 is above exp(h) if the left side, which falls, is above 1
    loop = len(chain) + 1 + (leaves - enters) % period
    if gcd(period, loop) != 1:
        raise NotProvedError(f"loops of {period} and {loop} impacts do not mix")
    if not exp_below(period * entropy) + exp_below(loop * entropy) > 1:
        raise NotProvedError(f"the entropy is not proved to be above {float(entropy)}")
    # M_0 tells the times of an orbit's visits, and where it crosses y = 0
    middle = chain[len(chain) // 2]
    for other in (*saddles, *chain):
        if other is not middle and not middle.is_disjoint(other):
            raise NotProvedError(f"M_0 is not proved to be disjoint from {other.name}")
    x = middle.point(UNIT, UNIT)[0]
    if not is_between(x, crossing):
        raise NotProvedError("the connection does not pass y = 0 where the statement says")
    around, along = [*saddles, saddles[0]], [saddles[leaves], *chain, saddles[enters]]
    relations, stated = [*pairwise(around), *pairwise(along)], certificate.rows("margins", 2)
    if len(stated) != len(relations):
        raise NotProvedError(f"there are {len(stated)} margins for {len(relations)} coverings")
    if min(map(min, stated)) < 0:
        raise NotProvedError("a margin of the certificate is below 0")
    margins = [
        check_relation(surface, *relation, least)
        for relation, least in zip(relations, stated, strict=True)
    ]
    beyond, room = (min(column) for column in zip(*margins, strict=True))
    return {"x": x, "beyond": Interval(beyond, beyond), "room": Interval(room, room)}


def sets_of(certificate):
    """Return the saddles' sets, the chain, and the indices of the saddles it leaves and enters.

    The second half of the chain is the mirror image of the first. That the sets at the saddles are
    mirror images of each other is checked: so the reversor maps the chain's path to itself.
    """
    rows, approach = certificate.rows("saddles", 6), certificate.rows("approach", 6)
    leaves, enters = certificate.number("leaves"), certificate.number("enters")
    if not {leaves, enters} <= set(range(len(rows))):
        raise NotProvedError("the chain of the certificate does not begin and end at its saddles")
    leaves, enters, steps = int(leaves), int(enters), len(approach)
    for i, row in enumerate(rows):
        if rows[(leaves + enters - i) % len(rows)] != mirrored(row):
            raise NotProvedError(f"S_{i} has no mirror image among the sets at the saddles")
    x, ux, uy = certificate.rows("middle", 3)[0]
    chain = [*approach, [x, 0, ux, uy, ux, -uy], *(mirrored(row) for row in reversed(approach))]
    saddles = [Parallelogram(f"S_{i}", row) for i, row in enumerate(rows)]
    chain = [Parallelogram(f"M_{i - steps}", row) for i, row in enumerate(chain)]
    return saddles, chain, leaves, enters


def exp_below(a):
    """Return Taylor's sum up to a^39, below exp(-a) by exp(-u) a^40/40! for some u."""
    return sum((-Fraction(a)) ** n / factorial(n) for n in range(40))


# ---- the diffeomorphism


def check_diffeomorphism(certificate, k, g, energy):
    """Prove that no flight touches the floor below an energy, by factors of the rim's energy.

    On the rim udot = -xdot, so that E = (1 + k) xdot^2/2 + r(x), r(x) = k x^2/2 - g x. A touch at
    the first root of a flight is on the rim and has x <= -g (src/extensions/proofs/README.md). The
    certificate has the roots of r(x) - E0, E0 the stated energy: r(x) - E0 = (k/2) (x - x1) (x -
    x2). If both are at least -g, no factor is positive at x <= -g. So E >= r(x) >= E0 there, and no
    flight touches the floor at an energy below E0.
    """
    certificate.check_constants("no touch", k=k, g=g, energy_below=energy)
    first, second = certificate.rows("roots", 2)[0]
    # the coefficients of x and of 1, after division by k/2
    if first + second != 2 * g / k or first * second != -2 * energy / k:
        raise NotProvedError("the energy of a touch is not the stated product of factors")
    if min(first, second) < -g:
        raise NotProvedError("the factors are not proved to be negative for x < -g")
    return {"energy below": Interval.of(energy)}


# ---- certificates and statements

NUMBER = re.compile(r"[+-]?\d+(\.\d*)?([eE][+-]?\d{1,3})?|[+-]?\d+/0*[1-9]\d*", re.ASCII)


class Certificate:
    """A TOML text whose numbers are exact decimals or quotients; anything else is refused."""

    def __init__(self, text):
        try:
            self.fields = tomllib.loads(text, parse_float=str)
        except (ValueError, RecursionError) as error:
            raise NotProvedError(f"the certificate cannot be read: {error}") from None

    def check_constants(self, kind, **constants):
        if self.fields.get("kind") != kind:
            raise NotProvedError(f"the certificate is not one of kind {kind!r}")
        for name, stated in constants.items():
            if self.number(name) != stated:
                raise NotProvedError(f"the certificate is of {name} = {self.number(name)}")

    def number(self, name):
        return self.exact(name, self.fields.get(name))

    def rows(self, name, width):
        """Return rows of numbers, each of this length; a single row may stand without a list."""
        rows = self.fields.get(name)
        rows = rows if isinstance(rows, list) else []
        rows = rows if all(isinstance(row, list) for row in rows) else [rows]
        if {len(row) for row in rows} != {width}:
            raise NotProvedError(f"the certificate's {name} is not of rows of {width} numbers")
        return [[self.exact(name, value) for value in row] for row in rows]

    @staticmethod
    def exact(name, value):
        if not (type(value) is int or (type(value) is str and NUMBER.fullmatch(value))):
            raise NotProvedError(f"the certificate's {name} is missing or not an exact number")
        value = Fraction(value)
        if max(abs(value.numerator), value.denominator) >= 10**100:
            raise NotProvedError(f"the certificate's {name} has more than 100 digits")
        return value


K, G = Fraction(1, 5), Fraction(1, 25)
FIGURE_6 = "0.21 0.2116 0.0925 0.0932"


def pairs(text):
    numbers = [Fraction(a) for a in text.split()]
    return tuple(zip(numbers[::2], numbers[1::2], strict=True))


def orbit_at(energy, period, kind, radius, window):
    section = {"k": K, "g": G, "energy": Fraction(energy), "period": period}
    alone = {"type": kind, "radius": Fraction(radius), "window": pairs(window)}
    return check_orbit, {**section, **alone}


def horseshoe_at(crossing, entropy):
    numbers = orbit_at("1/100", 6, "hyperbolic", "1e-4", FIGURE_6)[1]
    del numbers["type"]
    return check_horseshoe, {**numbers, "crossing": crossing, "entropy": Fraction(entropy)}


STATEMENTS = {  # of a window two x, then two xdot
    "fixed-point": orbit_at("1/100", 1, "elliptic", "4e-3", "0.0212 0.0213 0.06 0.0601"),
    "fixed-point-low": orbit_at("1/1000", 1, "elliptic", "2e-3", "0.1325 0.1326 0.0389 0.039"),
    "six-elliptic": orbit_at("1/100", 6, "elliptic", "1e-4", "-0.1519 -0.1518 0.0232 0.0233"),
    "six-hyperbolic": orbit_at("1/100", 6, "hyperbolic", "1e-4", FIGURE_6),
    "six-inverse": orbit_at("1/100", 6, "inverse hyperbolic", "5e-4", "0.3869 0.387 0.0877 0.0878"),
    "ten-elliptic": orbit_at("1/1000", 10, "elliptic", "6e-6", "0.0141 0.0142 0.0226 0.0227"),
    "twelve-elliptic": orbit_at("1/1000", 12, "elliptic", "6e-6", "-0.0059 -0.0058 0.0159 0.016"),
    "horseshoe-outer": horseshoe_at(*pairs("0.326 0.327"), "0.0185"),
    "horseshoe-inner": horseshoe_at(*pairs("0.187 0.188"), "0.0083"),
    "diffeomorphism": (check_diffeomorphism, {"k": K, "g": G, "energy": Fraction("0.00176")}),
}


def check(name, text=None, **changed):
    """Prove a statement from a certificate, by default the package's; return enclosures.

    Other numbers for the statement may be given by name. Raises NotProvedError with a reason.
    """
    checker, numbers = STATEMENTS[name]
    if text is None:
        text = (CERTIFICATES / f"{name}.toml").read_text(encoding="utf-8")
    try:
        return checker(Certificate(text), **{**numbers, **changed})
    except (ArithmeticError, ValueError) as error:  # doubles that overflow, in a proposal
        raise NotProvedError(f"nothing could be proposed: {error}") from None


if __name__ == "__main__":
    for name in STATEMENTS:
        try:
            found = ", ".join(f"{key} = {a.middle():.15g}" for key, a in check(name).items())
            print(f"{name}: proved; {found}")
        except NotProvedError as error:
            raise SystemExit(f"{name}: not proved; {error}") from None
