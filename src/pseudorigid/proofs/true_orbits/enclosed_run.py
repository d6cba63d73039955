"""One orbit followed with a proved bound on its error, so that every result can be rounded.

A chaotic orbit in double precision is not that of its start beyond some 120 impacts. Here a point
z with as many bits as the orbit needs is mapped along, each flight the proved first root, and
beside it a bound on how far the true orbit may be from it: the true point is

    z + C e,   |e_1| <= r_1, |e_2| <= r_2,

where the columns of C follow the tangent map and are made orthogonal again at each impact (Lohner
1987). The bound grows as the orbit stretches; bits below it are dropped.
"""

import json

import numpy as np
from flint import arb, arb_mat, ctx

from ..enclosure.flight import UndecidedError

FRAME_BITS = 64  # of the frame and the bound, whose own roundings the bound takes in
GUARD = 40  # bits of a point below its bound
RESULT_BITS = 110  # to which the last impact is meant to be known
LEAST_BITS = 80  # fewer are too few to round
MOST_BITS = 1_000_000  # some three million impacts of the sea


class ShortOfBitsError(Exception):
    """The precision chosen at the start does not reach the end."""


class Run:
    """The orbit up to `count` impacts: z, C, r and the results so far.

    Parameters
    ----------
    surface : Surface
    place : Start
    impacts : int
        How many in all.
    bits : int
        The precision at the start.

    Attributes
    ----------
    count : int
        Impacts done.
    digits : int
        The precision now.
    values : ndarray, shape (impacts, 4)
        x, xdot, udot, tau of the impacts done, correctly rounded.

    Raises
    ------
    ValueError
        More bits than MOST_BITS.
    """

    def __init__(self, surface, place, impacts, bits):
        if bits > MOST_BITS:
            raise ValueError(
                f"{impacts} impacts of this orbit need {bits} bits, more than {MOST_BITS}"
            )
        self.surface, self.place, self.impacts, self.bits = surface, place, impacts, bits
        self.values = np.empty((impacts, 4))
        self.count, self.digits = 0, bits
        with ctx.workprec(bits):
            centre = [a.mid() for a in place.balls()]
            off = [a - m for a, m in zip(place.balls(), centre, strict=True)]
        self.centre, self.frame = centre, arb_mat([[1, 0], [0, 1]])
        self.reach = [abs(a).upper() for a in off]

    def step(self):
        """One impact further.

        Raises
        ------
        ValueError
            A flight that grazes to within the precision.
        ShortOfBitsError
            Where the bound has grown too large to round.

        References
        ----------
        Lohner, Enclosing the solutions of ordinary initial and boundary value problems (1987).
        """
        before = self._box(RESULT_BITS + GUARD)
        with ctx.workprec(self.digits):
            try:
                image = self.surface.impact(*self.centre)
            except UndecidedError as error:
                raise self._stuck(error) from None
        rows = self._tangent()
        with ctx.workprec(FRAME_BITS):
            carried = arb_mat(rows) * self.frame
            frame, inverse = _frame(carried, self.reach)
            spread = [_across(row, self.reach) for row in (inverse * carried).table()]
        known = -max(_exponent(a) for a in (*spread, image.x.rad(), image.y.rad()))
        if known < LEAST_BITS:
            raise ShortOfBitsError
        self.digits = min(self.digits, 64 * ((known + GUARD) // 64 + 1))
        with ctx.workprec(self.digits):
            self.centre = [(+image.x).mid(), (+image.y).mid()]
            off = [image.x - self.centre[0], image.y - self.centre[1]]
        with ctx.workprec(FRAME_BITS):
            self.frame = frame
            pairs = zip(spread, inverse.table(), strict=True)
            self.reach = [(a + _across(row, off)).upper() for a, row in pairs]
        self.values[self.count] = self._rounded(before)
        self.count += 1

    def _box(self, bits):
        """Balls around the true x and y."""
        with ctx.workprec(bits):
            rows = zip(self.centre, self.frame.table(), strict=True)
            return [
                arb((+z).mid(), (_across(row, self.reach) + (+z).rad()).upper()) for z, row in rows
            ]

    def _tangent(self):
        """DP over all points that the true one may be, with as few bits as will do."""
        bits = FRAME_BITS
        while True:
            with ctx.workprec(bits):
                try:
                    return self.surface.jacobian(*self._box(bits))[0]
                except UndecidedError as error:
                    if bits >= self.digits:
                        raise self._stuck(error) from None
            bits *= 2

    def _rounded(self, before):
        """x, xdot, udot and tau of the impact just reached as doubles."""
        with ctx.workprec(RESULT_BITS + GUARD):
            k, g, _ = self.surface.constants()
            x, y = self._box(ctx.prec)
            xdot, udot = self.surface.velocities(x, y)
            after = (before[1] - k * self.surface.speed(*before)) / (1 + k)
            return [_nearest(a) for a in (x, xdot, udot, (xdot - after) / g)]

    def _stuck(self, error):
        return ValueError(f"the orbit cannot be followed beyond impact {self.count}: {error}")

    def state(self):
        """All of it but the results, as text."""
        numbers = [*self.centre, *self.frame.entries(), *self.reach]
        pairs = [[int(part) for part in number.man_exp()] for number in numbers]
        return json.dumps([self.bits, self.count, self.digits, [[hex(m), e] for m, e in pairs]])

    @classmethod
    def restored(cls, surface, place, impacts, state, values):
        """The run with a state and the results up to it."""
        bits, count, digits, pairs = json.loads(state)
        run = cls(surface, place, impacts, bits)
        numbers = [arb((int(m, 16), e)) for m, e in pairs]
        run.count, run.digits = count, digits
        run.values[:count] = values
        run.centre, run.frame, run.reach = numbers[:2], arb_mat(2, 2, numbers[2:6]), numbers[6:]
        return run


def _frame(carried, reach):
    """An orthogonal frame along the longer of two carried columns, exact, and its inverse."""
    sizes = [(abs(carried[0, j]) + abs(carried[1, j])).upper() * reach[j] for j in (0, 1)]
    j = 0 if sizes[0] >= sizes[1] else 1
    a, b = carried[0, j].mid(), carried[1, j].mid()
    length = (a * a + b * b).sqrt()
    a, b = (a / length).mid(), (b / length).mid()
    square = a * a + b * b
    return arb_mat([[a, -b], [b, a]]), arb_mat([[a, b], [-b, a]]) / square


def _across(row, reach):
    """A bound on |row e| for all e with |e_j| <= |reach_j|."""
    return sum(abs(a) * abs(r) for a, r in zip(row, reach, strict=True))


def _exponent(value):
    """The least e with value <= 2^e."""
    mantissa, exponent = value.upper().man_exp()
    return int(mantissa).bit_length() + int(exponent) if mantissa else -MOST_BITS


def _nearest(value):
    """The double nearest to every number of a ball."""
    low, high = float(value.lower()), float(value.upper())
    if low == high:
        return low
    if value.contains(0) and _exponent(abs(value)) < -LEAST_BITS:
        return 0.0
    raise ShortOfBitsError
