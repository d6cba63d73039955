"""A second checker of certificates.

It shares no code with the package, and its intervals are mpmath's, not balls of Arb. The theorems
that it uses are those of src/extensions/proofs/theory/. It takes other ways than the package's
checker:

- That no impact is missed follows from a bound on the distance of a function from its chord.
- An orbit is proved by Brouwer's theorem, and alone by a comparison vector, without elimination.
- Coverings are proved from images of single points and, again, the distance from a chord.

Doubles only propose what intervals then prove: a time near the first root, the approximate inverse
of a matrix, and the comparison vector.

THE CHORD LEMMA. Let f be twice differentiable on [a, b], and l its chord, the linear function with
l(a) = f(a) and l(b) = f(b). At each t in [a, b], for some u in (a, b),
f(t) = l(t) - f''(u) (t - a) (b - t)/2, and (t - a) (b - t) <= (b - a)^2/4. (This is the error of
linear interpolation, by Rolle's theorem.)
"""

import tomllib
from fractions import Fraction
from itertools import chain, combinations, pairwise, product
from math import gcd

import numpy as np
from mpmath import iv

iv.prec = 160  # bits; certificates have up to 36 digits
UNIT, ENDS = iv.mpf([-1, 1]), (iv.mpf(-1), iv.mpf(1))


class NotProvedError(Exception):
    """The reason why a statement is not proved."""


def demand(proved, reason):
    """Refuse what is not proved; a comparison of intervals that overlap is None."""
    if not proved:
        raise NotProvedError(reason)


def interval(number):
    return iv.mpf(number.numerator) / iv.mpf(number.denominator)


def hull(intervals):
    return iv.mpf([min(a.a for a in intervals), max(a.b for a in intervals)])


# ---- derivatives


class Series:
    """Taylor polynomial of second order in two variables, with intervals as coefficients.

    The coefficients are those of 1, p, q, p^2, p q, q^2. If those of the operands enclose functions
    and their derivatives over a set, so do those of the result: the coefficient of p^2 encloses
    half the second derivative by p at each point of the set, and so on. It stands on the left of
    an operator.
    """

    def __init__(self, *coefficients):
        self.c = coefficients + (iv.mpf(0),) * (6 - len(coefficients))

    def __add__(self, other):
        other = other.c if isinstance(other, Series) else (other, 0, 0, 0, 0, 0)
        return Series(*(a + b for a, b in zip(self.c, other, strict=True)))

    def __neg__(self):
        return Series(*(-a for a in self.c))

    def __sub__(self, other):
        return self + -other

    def __mul__(self, other):
        if not isinstance(other, Series):
            return Series(*(a * other for a in self.c))
        a, p, q, pp, pq, qq = self.c
        b, r, s, rr, rs, ss = other.c
        second = a * rr + p * r + pp * b, a * rs + p * s + q * r + pq * b, a * ss + q * s + qq * b
        return Series(a * b, a * r + p * b, a * s + q * b, *second)

    def through(self, value, slope, bend):
        """Return h of this series, from h, h' and h''/2 at its constant term: the chain rule."""
        _, p, q, *second = self.c
        squares = p**2, 2 * p * q, q**2
        second = [slope * a + bend * b for a, b in zip(second, squares, strict=True)]
        return Series(value, slope * p, slope * q, *second)


def square(a):
    return a.through(a.c[0] ** 2, 2 * a.c[0], 1) if isinstance(a, Series) else a**2


def sqrt(a):
    if isinstance(a, Series):
        root = sqrt(a.c[0])
        return a.through(root, 1 / (2 * root), -1 / (8 * root**3))
    demand(a > 0, "a root may be that of zero or of a negative number")
    return iv.sqrt(a)


def sine_cosine(a):
    if isinstance(a, Series):
        sine, cosine = sine_cosine(a.c[0])
        return a.through(sine, cosine, -sine / 2), a.through(cosine, -sine, -cosine / 2)
    return iv.sin(a), iv.cos(a)


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
        self.k, self.g, self.share = interval(k), interval(g), interval(1 / (1 + k))
        self.centre, self.reach = interval(g / k), interval(2 * energy + g * g / k)

    def speed(self, x, y):
        """Enclose s > 0, from k s^2 = (1 + k) (2 E + 2 g x - k x^2) - y^2, which is the energy."""
        above = -square(x - self.centre) * self.k + self.reach
        return sqrt(above * (1 / (self.share * self.k)) - square(y) * (1 / self.k))

    def velocity(self, x, y):
        """Enclose xdot = k' (y + k s) before the impact."""
        return (y + self.speed(x, y) * self.k) * self.share

    def gap(self, t, x, y, s):
        """Enclose f and f' at t; where x, y, s are Series, so is t."""
        sine, cosine = sine_cosine(t)
        versine = -cosine + 1
        height = square(t) * (self.g / 2) - s * (t * (1 - self.share) + sine * self.share)
        height = height + y * ((t - sine) * self.share) + x * versine
        slope = t * self.g - s * (-versine * self.share + 1)
        return height, slope + y * (versine * self.share) + x * sine

    def first_root(self, x, y):
        """Enclose the first root T of f for every point of a box; it is simple.

        Since f'' = g + x cos t - c sin t, it is between g - A and g + A, A = sqrt(x^2 + c^2).

        1. f(0) = 0 and f'(0) = -s. So f <= -s t + (g + A) t^2/2, which is negative for
           0 < t < 2 s/(g + A). The first half of that needs no further proof.
        2. From there to low `negative_between` proves f < 0.
        3. From low to high f' > 0, and f(high) > 0. So there is one root in between.
        """
        s = self.speed(x, y)
        state, amplitude = (x, y, s), sqrt(square(x) + square((y + s) * self.share))
        start = (s / (self.g + amplitude)).a
        near = iv.mpf(self.proposed_root(*(float(a.mid) for a in state)))
        height, slope = self.gap(near, *state)
        demand(slope > 0, "two impacts may be one: the slope of the gap may vanish")
        half = iv.mpf(abs(height).b / slope.a + iv.mpf(2) ** -56).b
        for _ in range(8):
            half *= 1.125
            low, high = (near - half).a, (near + half).b
            if start < low and self.gap(low, *state)[0] < 0 < self.gap(high, *state)[0]:
                break
        root = iv.mpf([low, high])
        isolated = start < low and self.gap(high, *state)[0] > 0 and self.gap(root, *state)[1] > 0
        demand(isolated, "no root is isolated near the proposed time")
        self.negative_between(start, low, state, (amplitude - self.g).b)
        return root

    def negative_between(self, start, end, state, concavity):
        """Prove f < 0 from start to end, where f'' >= -concavity, by halving.

        By the chord lemma f lies between a and b below the parabola l + M (t - a) (b - t)/2,
        M = concavity and h = b - a. It is negative in each of two cases, if f(a), f(b) < 0:

        - The larger of the two, plus M h^2/8, is negative, or M is.
        - |f(b) - f(a)| >= M h^2/2. Then the parabola is monotonic, hence highest at a or b.
        """
        parts = [(start, self.gap(start, *state)[0], end, self.gap(end, *state)[0])]
        while parts:
            a, at_a, b, at_b = parts.pop()
            long = b - a > 2.0**-40
            demand(at_a < 0 and at_b < 0 and long, "the ball may touch the floor earlier")
            eighth = concavity * (b - a) ** 2 / 8
            if not (concavity < 0 or (at_a + eighth < 0 and at_b + eighth < 0)
                    or abs(at_b - at_a) > 4 * eighth):  # fmt: skip
                middle = ((a + b) / 2).mid
                at_middle = self.gap(middle, *state)[0]
                parts += [(middle, at_middle, b, at_b), (a, at_a, middle, at_middle)]

    def proposed_root(self, x, y, s):
        """Propose the first root in doubles, by small steps and then by halving."""
        share, g = float(self.share.mid), float(self.g.mid)

        def gap(t):
            curvature = share * (t - np.sin(t))
            return g * t * t / 2 - s * t + (s + y) * curvature + x * (1 - np.cos(t))

        times = s / (g + abs(x) + share * abs(y + s)) + 0.02 * np.arange(1500)
        low, step = times[max(int(np.argmax(gap(times) >= 0)) - 1, 0)], 0.02
        for _ in range(60):
            step /= 2
            low += step * (gap(low + step) < 0)
        return float(low)

    def narrowed(self, root, state):
        """Narrow an enclosure of the root by interval Newton, T = m - f(m)/f'(T).

        The root is in it: f(m) = f(m) - f(root) = f'(u) (m - root) for a u in the enclosure.
        """
        while True:
            middle = root.mid
            new = middle - self.gap(middle, *state)[0] / self.gap(root, *state)[1]
            new = iv.mpf([max(new.a, root.a), min(new.b, root.b)])
            if new.delta > 0.75 * root.delta:
                return new
            root = new

    def image(self, x, y, bracket):
        """Enclose the images (x, y) of all points of a box, or of two Series over a box.

        The bracket is `first_root` of this box or of a larger one. In it lies just one root of
        each flight, the first.
        """
        s = self.speed(x, y)
        state = [a.c[0] if isinstance(a, Series) else a for a in (x, y, s)]
        time = self.narrowed(bracket, state)
        if isinstance(x, Series):
            # a root right up to an order n has a gap that begins with the order n + 1
            slope, time = self.gap(time, *state)[1], Series(time)
            for known, new in ((1, 3), (3, 6)):
                rest = self.gap(time, x, y, s)[0]
                time = Series(*time.c[:known], *(-a / slope for a in rest.c[known:new]))
        sine, cosine = sine_cosine(time)
        c = -(y + s) * self.share
        velocity = (y - s * self.k) * self.share + time * self.g
        return x * cosine - c * sine, velocity - (x * sine + c * cosine) * self.k

    def derivative(self, x, y):
        point = Series(x, iv.mpf(1)), Series(y, iv.mpf(0), iv.mpf(1))
        return [part.c[1:3] for part in self.image(*point, self.first_root(x, y))]


# ---- periodic orbits

CLOSE = Fraction(1, 10**30)  # largest distance of a certificate's point from the orbit's


def dot(row, column):
    return sum(a * b for a, b in zip(row, column, strict=True))


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
    n, size = len(centres), interval(radius)
    points, residuals = [[interval(a) for a in centre] for centre in centres], []
    matrix = [[iv.mpf(0)] * (2 * n) for _ in range(2 * n)]
    for i, (x, y) in enumerate(points):
        image, after = surface.image(x, y, surface.first_root(x, y)), (i + 1) % n
        rows = surface.derivative(x + UNIT * size, y + UNIT * size)
        for r in range(2):
            residuals.append(image[r] - points[after][r])
            for c in range(2):
                matrix[2 * i + r][2 * i + c] += rows[r][c]
            matrix[2 * i + r][2 * after + r] -= 1
    inverse = np.linalg.inv([[float(a.mid) for a in row] for row in matrix]).tolist()
    distances = [abs(dot(row, residuals)).b for row in inverse]
    rest = [[dot(row, column) for column in zip(*matrix, strict=True)] for row in inverse]
    rest = [[abs(a - (i == j)).b for j, a in enumerate(row)] for i, row in enumerate(rest)]
    at_most = np.array([float(d) for d in distances]) + max(map(float, distances)) + 1e-45
    contraction = np.eye(2 * n) - np.array([[float(a) for a in row] for row in rest])
    widths = [iv.mpf(a) for a in np.linalg.solve(contraction, at_most).tolist()]
    demand(
        all(0 < w <= size and d + dot(row, widths) < w
            for w, d, row in zip(widths, distances, rest, strict=True)),
        "the boxes are not proved to contain exactly one orbit",
    )  # fmt: skip
    boxes = iter(widths)
    orbit = [[a + UNIT * next(boxes) for a in point] for point in points]
    for first, second in combinations(orbit, 2):
        apart = any(a < b or b < a for a, b in zip(first, second, strict=True))
        demand(apart, "two points may be one: the period may be shorter")
    total = [[1, 0], [0, 1]]
    for point in orbit:
        columns = list(zip(*total, strict=True))
        total = [[dot(row, column) for column in columns] for row in surface.derivative(*point)]
    return orbit, total[0][0] + total[1][1]


def check_type(trace, expected):
    types = {"elliptic": abs(trace) < 2, "hyperbolic": trace > 2, "inverse hyperbolic": trace < -2}
    demand(types[expected], f"the orbit is not proved to be {expected}")


def check_window(surface, orbit, window):
    inside = (is_between(x, window[0]) and is_between(surface.velocity(x, y), window[1])
              for x, y in orbit)  # fmt: skip
    demand(any(inside), "no point of the orbit is proved to lie in the window of the statement")


def is_between(value, ends):
    return interval(ends[0]) < value < interval(ends[1])


def check_orbit(fields, surface, period, type, radius, window):
    """Prove the statement on a periodic orbit: period, type, window, and that it is alone.

    The boxes are larger than the certificate's by CLOSE, and the orbit's points are nearer than
    that to their centres. So the boxes contain those of the stated radius around the orbit itself.
    """
    centres, size = fields["points"], fields["radius"]
    demand(len(centres) == period, f"the certificate has {len(centres)} points, not {period}")
    demand(size >= radius > 0, "the radius is not that of the statement")
    orbit, trace = prove_orbit(surface, centres, size + CLOSE)
    check_type(trace, type)
    for value, stated in zip(chain(*orbit), chain(*centres), strict=True):
        near = is_between(value, (stated - CLOSE, stated + CLOSE))
        demand(near, f"a point of the orbit is not the stated {float(stated):.10g}")
    check_window(surface, orbit, window)
    return {"x": orbit[0][0], "trace": trace}


# ---- horseshoes


class Parallelogram:
    """The points centre + p u + q s, |p|, |q| <= 1; the map expands along u, contracts along s."""

    def __init__(self, name, row):
        self.name, self.row = name, row  # six exact numbers: centre, u, s
        values = [interval(a) for a in row]
        self.centre, self.u, self.s = values[:2], values[2:4], values[4:]
        self.area = self.u[0] * self.s[1] - self.u[1] * self.s[0]

    def point(self, p, q):
        sides = zip(self.centre, self.u, self.s, strict=True)
        return [c + p * u + q * s for c, u, s in sides]

    def series(self, p, q):
        return [Series(*part) for part in zip(self.point(p, q), self.u, self.s, strict=True)]

    def coordinates(self, x, y):
        dx, dy, inverse = x - self.centre[0], y - self.centre[1], 1 / self.area
        p = (dx * self.s[1] - dy * self.s[0]) * inverse
        return p, (dy * self.u[0] - dx * self.u[1]) * inverse

    def is_disjoint(self, other):
        """Whether a line along a side of one of the two sets is proved to separate them."""
        for reference, moved in ((self, other), (other, self)):
            corners = [reference.coordinates(*moved.point(p, q)) for p, q in product(ENDS, ENDS)]
            for values in zip(*corners, strict=True):
                if hull(values) > 1 or hull(values) < -1:
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
    at_centre = target.coordinates(*surface.image(*source.series(iv.mpf(0), iv.mpf(0)), bracket))
    check_cones(at_centre, image, source, target)
    for n in (1, 2, 4, 8):
        nodes = [iv.mpf(2 * i - n) / n for i in range(n + 1)]
        grid = [[target.coordinates(*surface.image(*source.point(p, q), bracket)) for q in nodes]
                for p in nodes]  # fmt: skip
        part = iv.mpf([0, 1]) / n**2
        low, high = (hull([p for p, _ in grid[i]]) - image[0].c[5] * part for i in (0, -1))
        if high < low:
            low, high = high, low
        across = hull([q for column in grid for _, q in column])
        across = across - image[1].c[3] * part - image[1].c[5] * part
        margins = min((-1 - low).a, (high - 1).a), (1 - abs(across)).a
        if all(0 < found >= interval(least) for found, least in zip(margins, stated, strict=True)):
            return margins
    raise NotProvedError(f"{source.name} is not proved to cover {target.name} as stated")


def check_cones(at_centre, image, source, target):
    """Prove D^T Q' D - Q > 0, Q = p^2 - q^2, for all D in the interval hull of DP over the source.

    By the mean value theorem a derivative by p differs from that at the centre by at most
    |2 pp| + |pq|, one by q by at most |pq| + |2 qq|, where pp, pq and qq enclose the coefficients
    of second order. A symmetric matrix is positive if its first entry and its determinant are.
    """
    rows = []
    for part, centre in zip(image, at_centre, strict=True):
        pp, pq, qq = (abs(a).b for a in part.c[3:])
        rows.append((centre.c[1] + UNIT * (2 * pp + pq), centre.c[2] + UNIT * (pq + 2 * qq)))
    (a, b), (c, d) = rows
    first, last = a**2 - c**2 - 1, b**2 - d**2 + 1
    proved = first > 0 and first * last - (a * b - c * d) ** 2 > 0
    demand(proved, f"cone condition not proved from {source.name} to {target.name}")


def check_horseshoe(fields, surface, period, radius, window, crossing, entropy):
    """Prove the statement on a horseshoe: all that the page of proofs lists but the angle."""
    saddles, links, leaves, enters = sets_of(fields)
    demand(len(saddles) == period, f"the certificate has {len(saddles)} saddles, not {period}")
    # the paper's orbit is in the sets at the saddles
    orbit, trace = prove_orbit(surface, [a.row[:2] for a in saddles], radius)
    check_type(trace, "hyperbolic")
    check_window(surface, orbit, window)
    for saddle, point in zip(saddles, orbit, strict=True):
        inside = all(abs(a) < 1 for a in saddle.coordinates(*point))
        demand(inside, f"{saddle.name} is not proved to contain the orbit's point")
    # the root of x^-period + x^-loop = 1 is above exp(h) if the left side, which falls, is above 1
    loop, h = len(links) + 1 + (leaves - enters) % period, interval(entropy)
    demand(gcd(period, loop) == 1, f"loops of {period} and {loop} impacts do not mix")
    above = iv.exp(-period * h) + iv.exp(-loop * h) > 1
    demand(above, f"the entropy is not proved to be above {float(entropy)}")
    # M_0 tells the times of an orbit's visits, and where it crosses y = 0
    middle = links[len(links) // 2]
    for other in {*saddles, *links} - {middle}:
        demand(middle.is_disjoint(other), f"M_0 is not proved to be disjoint from {other.name}")
    x = middle.point(UNIT, UNIT)[0]
    demand(is_between(x, crossing), "the connection does not pass y = 0 where the statement says")
    around, along = [*saddles, saddles[0]], [saddles[leaves], *links, saddles[enters]]
    relations, stated = [*pairwise(around), *pairwise(along)], fields["margins"]
    demand(len(stated) == len(relations), f"{len(stated)} margins for {len(relations)} coverings")
    demand(min(map(min, stated)) >= 0, "a margin of the certificate is below 0")
    margins = [
        check_relation(surface, *relation, least)
        for relation, least in zip(relations, stated, strict=True)
    ]
    beyond, room = (min(column) for column in zip(*margins, strict=True))
    return {"x": x, "beyond": beyond, "room": room}


def sets_of(fields):
    """Return the saddles' sets, the chain, and the indices of the saddles it leaves and enters.

    The second half of the chain is the mirror image of the first. That the sets at the saddles are
    mirror images of each other is checked: so the reversor maps the chain's path to itself.
    """
    rows, approach, (x, ux, uy) = fields["saddles"], fields["approach"], fields["middle"]
    leaves, enters, steps = fields["leaves"], fields["enters"], len(approach)
    demand({leaves, enters} <= {*range(len(rows))}, "the chain does not begin and end at saddles")
    leaves, enters = int(leaves), int(enters)
    for i, row in enumerate(rows):
        image = rows[(leaves + enters - i) % len(rows)]
        demand(image == mirrored(row), f"S_{i} has no mirror image among the sets at the saddles")
    links = [*approach, [x, 0, ux, uy, ux, -uy], *(mirrored(row) for row in reversed(approach))]
    saddles = [Parallelogram(f"S_{i}", row) for i, row in enumerate(rows)]
    links = [Parallelogram(f"M_{i - steps}", row) for i, row in enumerate(links)]
    return saddles, links, leaves, enters


# ---- the diffeomorphism


def check_diffeomorphism(fields, k, g, energy):
    """Prove that no flight touches the floor below an energy, by factors of the rim's energy.

    On the rim udot = -xdot, so that E = (1 + k) xdot^2/2 + r(x), r(x) = k x^2/2 - g x. A touch at
    the first root of a flight is on the rim and has x <= -g (theory/jumps.md). The
    certificate has the roots of r(x) - E0, E0 the stated energy: r(x) - E0 = (k/2) (x - x1) (x -
    x2). If both are at least -g, no factor is positive at x <= -g. So E >= r(x) >= E0 there, and no
    flight touches the floor at an energy below E0.
    """
    first, second = fields["roots"]
    # the coefficients of x and of 1, after division by k/2
    factors = first + second == 2 * g / k and first * second == -2 * energy / k
    demand(factors, "the energy of a touch is not the stated product of factors")
    demand(min(first, second) >= -g, "the factors are not proved to be negative for x < -g")
    return {}


# ---- certificates


def exact(value):
    return [exact(a) for a in value] if isinstance(value, list) else Fraction(value)


def check(text, kind, k, g, energy, **statement):
    """Prove a statement from a certificate, and return enclosures or raise NotProvedError."""
    checker = {"periodic orbit": check_orbit, "horseshoe": check_horseshoe}.get(kind)
    try:
        fields = tomllib.loads(text, parse_float=Fraction)
        demand(fields.pop("kind") == kind, f"the certificate is not one of kind {kind!r}")
        fields = {name: exact(value) for name, value in fields.items()}
        stated = {"k": k, "g": g, "energy" if checker else "energy_below": energy}
        for name, value in stated.items():
            demand(fields[name] == value, f"the certificate is of {name} = {fields[name]}")
        if checker is None:
            return check_diffeomorphism(fields, k, g, energy)
        return checker(fields, ImpactMap(k, g, energy), **statement)
    except (ArithmeticError, ValueError, LookupError, TypeError) as error:
        raise NotProvedError(f"the certificate cannot be used: {error}") from None
