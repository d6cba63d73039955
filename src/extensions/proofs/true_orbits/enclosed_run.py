"""One orbit with a proved bound on its error, so that every result can be rounded correctly.

A chaotic orbit in double precision leaves the orbit of its start after some 120 impacts. Here a
point z with as many bits as the orbit needs is mapped, each flight by its proved first root,
together with a bound on its distance from the true orbit. The true point is

    z + C e,   |e_1| <= r_1, |e_2| <= r_2,

where the columns of C follow the tangent map and are made orthogonal again at each impact (Lohner
1987). The bound grows as the orbit stretches; bits below it are dropped.
"""

from collections.abc import Mapping, Sequence

import numpy as np
from flint import arb, arb_mat, ctx

from pseudorigid.verified.flight import UndecidedError

from ..enclosure.surface import Exact, Surface, ball_of, exact

FRAME_BITS = 64  # of the frame and the bound, which includes their own roundings
GUARD_BITS = 40  # bits of a point below its bound
RESULT_BITS = 110  # accuracy that is aimed at for the last impact
LEAST_BITS = 80  # fewer are too few to round
MOST_BITS = 1_000_000  # enough for some three million impacts of the chaotic sea


class Start:
    """An exact start, which gives balls of its coordinates at any precision.

    It is a fraction of the section's radius along y = 0, or a mapping with x and y or xdot. Raises
    ValueError if a number is not exact, or the start is on or beyond the rim.
    """

    def __init__(self, surface: Surface, start: Exact | Mapping[str, Exact]) -> None:
        self.surface = surface
        values = start if isinstance(start, Mapping) else {"start": start}
        if set(values) not in ({"start"}, {"x", "y"}, {"x", "xdot"}):
            raise ValueError(
                "a start is a fraction of the section's radius, or x and y, or x and xdot"
            )
        self.numbers = {name: exact(name, values[name]) for name in sorted(values)}
        if not self._is_inside():
            raise ValueError(f"the start {self} is not inside the section's rim at {surface}")

    def __str__(self) -> str:
        return ", ".join(f"{name} = {value}" for name, value in self.numbers.items())

    def _is_inside(self) -> bool:
        """Whether s > 0, decided in exact arithmetic."""
        k, g, energy = self.surface.k, self.surface.g, self.surface.energy
        if "start" in self.numbers:
            return -1 < self.numbers["start"] < 1
        x = self.numbers["x"]
        twice_kinetic = 2 * energy + x * (2 * g - k * x)
        if "y" in self.numbers:
            return (1 + k) * twice_kinetic > self.numbers["y"] ** 2
        xdot = self.numbers["xdot"]  # of the two udot = ±sqrt((2 T - xdot^2)/k), the positive one
        square = xdot * xdot
        return twice_kinetic > square and (xdot >= 0 or twice_kinetic > (1 + k) * square)

    def balls(self) -> tuple[arb, arb]:
        """Enclose x and y at the context's precision."""
        k, g, energy = self.surface.constants()
        numbers = {name: ball_of(value) for name, value in self.numbers.items()}
        if "start" in numbers:
            return g / k + numbers["start"] * self.surface.radius(), arb(0)
        x = numbers["x"]
        if "y" in numbers:
            return x, numbers["y"]
        xdot = numbers["xdot"]
        udot = ((2 * energy + x * (2 * g - k * x) - xdot * xdot) / k).sqrt()
        return x, xdot - k * udot


class ShortOfBitsError(Exception):
    """The precision chosen at the start does not reach the end."""


class Run:
    """The orbit up to `count` impacts: z, C, r and the results so far.

    `bits` is the precision at the start, `precision` the one now. `values`, (impacts, 4), has x,
    xdot, udot, tau of the impacts done, correctly rounded. Raises ValueError if more bits than
    MOST_BITS are needed.
    """

    def __init__(self, start: Start, impacts: int, bits: int) -> None:
        if bits > MOST_BITS:
            raise ValueError(
                f"{impacts} impacts of this orbit need {bits} bits, more than {MOST_BITS}"
            )
        self.surface, self.start, self.impacts, self.bits = start.surface, start, impacts, bits
        self.values = np.empty((impacts, 4))
        self.count, self.precision = 0, bits
        with ctx.workprec(bits):
            x, y = start.balls()
            self.centre = x.mid(), y.mid()
            self.radii = [abs(x - x.mid()).upper(), abs(y - y.mid()).upper()]
        self.frame = arb_mat([[1, 0], [0, 1]])

    def step(self) -> None:
        """Advance by one impact.

        Raises UndecidedError if the flight grazes to within the precision, and ShortOfBitsError if
        the bound has grown too large to round.
        """
        before = self._box(RESULT_BITS + GUARD_BITS)
        with ctx.workprec(self.precision):
            image = self.surface.impact(*self.centre)
        rows = self._jacobian()
        with ctx.workprec(FRAME_BITS):
            columns = arb_mat(rows) * self.frame
            frame, inverse = _orthogonal_frame(columns, self.radii)
            spread = [_bound(row, self.radii) for row in (inverse * columns).table()]
        known_bits = -max(_exponent(a) for a in (*spread, image.x.rad(), image.y.rad()))
        if known_bits < LEAST_BITS:
            raise ShortOfBitsError
        self.precision = min(self.precision, 64 * ((known_bits + GUARD_BITS) // 64 + 1))
        with ctx.workprec(self.precision):
            self.centre = (+image.x).mid(), (+image.y).mid()
            errors = [image.x - self.centre[0], image.y - self.centre[1]]
        with ctx.workprec(FRAME_BITS):
            self.frame = frame
            pairs = zip(spread, inverse.table(), strict=True)
            self.radii = [(a + _bound(row, errors)).upper() for a, row in pairs]
        self.values[self.count] = self._rounded(before)
        self.count += 1

    def _box(self, bits: int) -> tuple[arb, arb]:
        """Return balls around the true x and y."""
        with ctx.workprec(bits):
            x, y = (
                arb((+z).mid(), (_bound(row, self.radii) + (+z).rad()).upper())
                for z, row in zip(self.centre, self.frame.table(), strict=True)
            )
            return x, y

    def _jacobian(self) -> list[list[arb]]:
        """Enclose DP over the box around the true point, with as few bits as will do."""
        bits = FRAME_BITS
        while True:
            with ctx.workprec(bits):
                try:
                    return self.surface.jacobian(*self._box(bits))[0]
                except UndecidedError:
                    if bits >= self.precision:
                        raise
            bits *= 2

    def _rounded(self, before: tuple[arb, arb]) -> list[float]:
        """Return x, xdot, udot and tau of the impact just reached as doubles."""
        with ctx.workprec(RESULT_BITS + GUARD_BITS):
            k, g, _ = self.surface.constants()
            x, y = self._box(ctx.prec)
            xdot, udot = self.surface.velocities(x, y)
            launch = (before[1] - k * self.surface.speed(*before)) / (1 + k)  # xdot
            return [_nearest(a) for a in (x, xdot, udot, (xdot - launch) / g)]


def _orthogonal_frame(columns: arb_mat, radii: list[arb]) -> tuple[arb_mat, arb_mat]:
    """Return an exact orthogonal frame along the longer of two columns, and its inverse."""
    sizes = [(abs(columns[0, j]) + abs(columns[1, j])).upper() * radii[j] for j in (0, 1)]
    j = 0 if sizes[0] >= sizes[1] else 1
    a, b = columns[0, j].mid(), columns[1, j].mid()
    length = (a * a + b * b).sqrt()
    a, b = (a / length).mid(), (b / length).mid()
    square = a * a + b * b
    return arb_mat([[a, -b], [b, a]]), arb_mat([[a, b], [-b, a]]) / square


def _bound(row: Sequence[arb], radii: Sequence[arb]) -> arb:
    """Bound |row e| for all e with |e_j| <= |radii_j|."""
    return sum((abs(a) * abs(r) for a, r in zip(row, radii, strict=True)), arb(0))


def _exponent(value: arb) -> int:
    """Return the least e with value <= 2^e."""
    mantissa, exponent = value.upper().man_exp()
    return int(mantissa).bit_length() + int(exponent) if mantissa else -MOST_BITS


def _nearest(value: arb) -> float:
    """Return the double nearest to every number of a ball."""
    low, high = float(value.lower()), float(value.upper())
    if low == high:
        return low
    if value.contains(0) and _exponent(abs(value)) < -LEAST_BITS:
        return 0.0
    raise ShortOfBitsError
