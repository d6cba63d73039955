"""The judge: the first root of the gap, proved in ball arithmetic (Arb, through python-flint).

Between two inflections, whose times are known in closed form, f' is monotone. On a convex piece
that starts below zero there is a root if and only if the far end is above zero, and only one. On
a concave piece a root needs f' > 0 at the start, and is then before the maximum, whose height
decides. Every sign is that of a ball which excludes zero; where one does not, the precision is
raised.
"""

from flint import arb, ctx

START_BITS, MOST_BITS = 384, 8192


class _UndecidedError(Exception):
    pass


def _sign(value):
    if value > 0:
        return 1
    if value < 0:
        return -1
    if value == 0:
        return 0
    raise _UndecidedError


class _Gap:
    """f = x + b t + g t^2/2 - x cos t + c sin t after the impact of a state, in balls."""

    def __init__(self, k, g, x, v, w):
        self.g, self.x, self.s = g, x, v + w
        e = 2 * self.s / (1 + k)
        self.b, self.c = v - k * e, w - e
        self.amplitude = (x * x + self.c * self.c).sqrt()

    def look(self, t):
        """f, f', f'' at t."""
        sine, cosine = t.sin_cos()
        p, q = self.x * cosine - self.c * sine, self.x * sine + self.c * cosine
        return self.x + t * (self.b + self.g * t / 2) - p, self.b + self.g * t + q, self.g + p

    def inflections(self):
        """The times of f'' = 0 after 0 as a function of the index; None if there are none."""
        if not self.amplitude > self.g:
            return None
        phase = arb.atan2(self.c, self.x)
        angle = (-self.g / self.amplitude).acos()
        turn = 2 * arb.pi()
        first = []
        for sign in (1, -1):
            t = sign * angle - phase
            while t < 0:
                t += turn
            while t > turn:
                t -= turn
            if not t > arb(2) ** (-ctx.prec // 2):  # 0 itself, where x = -g exactly
                t += turn
            first.append(t)
        if first[1] < first[0]:
            first.reverse()
        return lambda i: first[i % 2] + (i // 2) * turn


def first_root(k, g, x, v, w):
    """The smallest t > 0 with f(t) = 0, to within 2**-150, for floats or balls.

    Raises ArithmeticError where a root is double beyond MOST_BITS.
    """
    bits = START_BITS
    while bits <= MOST_BITS:
        ctx.prec = bits
        try:
            return _first_root(*(arb(a) for a in (k, g, x, v, w)))
        except _UndecidedError:
            bits *= 2
    raise ArithmeticError("the judge cannot tell a touch from a miss")


def _first_root(k, g, x, v, w):
    f = _Gap(k, g, x, v, w)
    bend = _sign(g + x)
    if _sign(f.s) == 0 and (bend > 0 or (bend == 0 and _sign(-f.c) >= 0)):
        return arb(0)  # pressed onto the floor
    inflection = f.inflections()
    convex = bend > 0 or (bend == 0 and _sign(-f.c) > 0)
    end = _after_every_root(f)
    low, at_low = arb(0), (arb(0), -f.s, g + x)
    index = 0
    skip_from, skip_to = _hopeless(f)
    while True:
        high = end if inflection is None else inflection(index)
        if inflection is not None and skip_from < low and high < skip_to:
            pairs = int(float((skip_to - high) / (2 * arb.pi())))
            if pairs > 1:  # the parabola is too far below for any vibration to reach the floor
                index += 2 * (pairs - 1)
                low, high = inflection(index - 1), inflection(index)
                at_low = f.look(low)
        at_high = f.look(high)
        up = _sign(at_high[0])
        if convex:
            if up >= 0:
                return _solve(f, low, high)
        elif index > 0 and _sign(at_low[1]) > 0:
            if up >= 0:
                return _solve(f, low, high)
            if _sign(at_high[1]) < 0:
                top = _top(f, low, high)
                if _sign(f.look(top)[0]) > 0:
                    return _solve(f, low, top)
        low, at_low, convex = high, at_high, not convex
        index += 1
        if low > end + 20:
            raise AssertionError("the judge found no root")


def _after_every_root(f):
    square = f.b * f.b - 2 * f.g * (f.x - f.amplitude)
    return (square.sqrt() - f.b) / f.g + 1


def _hopeless(f):
    """Between these times f < x + A + b t + g t^2/2 < 0."""
    square = f.b * f.b - 2 * f.g * (f.x + f.amplitude)
    if not (square > 0 and f.b < 0):
        return arb(1), arb(0)
    return (-f.b - square.sqrt()) / f.g, (square.sqrt() - f.b) / f.g


def _bisect(up, low, high):
    """A float's worth of bisection between low (not up) and high (up)."""
    for _ in range(60):
        middle = ((low + high) / 2).mid()
        if up(middle):
            high = middle
        else:
            low = middle
    return low, high


def _top(f, low, high):
    """The time of a concave piece's maximum; its errors enter f squared."""
    low, high = _bisect(lambda t: f.look(t)[1] < 0, low.mid(), high.mid())
    t = ((low + high) / 2).mid()
    for _ in range(6):
        _, df, ddf = f.look(t)
        t = (t - df / ddf).mid()
    return t


def _solve(f, low, high):
    """The only root in [low, high], where f rises through zero; checked by the signs beside it."""
    low, high = low.mid(), high.mid()
    low, high = _bisect(lambda t: f.look(t)[0] > 0, low, high)
    t = ((low + high) / 2).mid()
    for _ in range(12):
        value, df, _ = f.look(t)
        if not df > 0:
            raise _UndecidedError
        t = (t - value / df).mid()
    beside = t * arb(2) ** -150
    if not (f.look(t - beside)[0] < 0 and f.look(t + beside)[0] > 0):
        raise _UndecidedError
    return t


def flight_times(ball, x, xdot, udot):
    """The proved tau of each state of the arrays (n,), rounded to a double."""
    states = zip(x.tolist(), xdot.tolist(), udot.tolist(), strict=True)
    return [float(first_root(ball.k, ball.g, *state)) for state in states]


def orbit(ball, state, impacts):
    """The orbit (impacts, 3) of a state, computed to 512 bits, rounded at the end."""
    k, g = arb(ball.k), arb(ball.g)
    x, v, w = (arb(float(a)) for a in state)
    rows = []
    for _ in range(impacts):
        tau = first_root(k, g, x, v, w)
        ctx.prec = 512
        f = _Gap(k, g, x, v, w)
        sine, cosine = tau.sin_cos()
        after = x * cosine - f.c * sine, f.b + g * tau, x * sine + f.c * cosine
        x, v, w = (a.mid() for a in after)
        rows.append((float(x), float(v), float(w)))
    return rows
