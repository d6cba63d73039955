"""Orbits that are the orbits of their starts: every number the rounded true value.

A chaotic orbit in double precision is not that of its start beyond some 120 impacts. Here a point
z with as many bits as the orbit needs is mapped along, each flight the proved first root, and
beside it a bound on how far the true orbit may be from it: the true point is

    z + C e,   |e_1| <= r_1, |e_2| <= r_2,

where the columns of C follow the tangent map and are made orthogonal again at each impact (Lohner
1987). The bound grows as the orbit stretches; bits below it are dropped.
"""

import json
import math
import os
import time
from pathlib import Path

import numpy as np
import xarray as xr
from flint import arb, ctx

from ..dynamics.ball import Ball, whole_number
from ..dynamics.lyapunov import lyapunov_spectrum
from ..dynamics.orbits import ragged_orbits
from ..dynamics.variables import variables
from .enclosure.flight import Undecided
from .enclosure.surface import Surface, ball_of, exact

FRAME_BITS = 64
GUARD = 40  # bits of a point below its bound
RESULT_BITS = 110  # to which the last impact is meant to be known
LEAST_BITS = 80  # fewer are too few to round
MOST_BITS = 1_000_000
EVERY = 15.0  # seconds between two checkpoints


class _ShortOfBitsError(Exception):
    """The precision chosen at the start does not reach the end."""


def true_orbit(k, g, energy, impacts, *, x=None, y=0, start=None, progress=None, checkpoint=None):
    """The orbit of an exact start under the impact map, eq. (28), correctly rounded.

    Parameters
    ----------
    k, g, energy : int, Fraction, Decimal or str
        The ball and its energy, exact.
    impacts : int
        How many.
    x, y : same
        The start in the chart, y = xdot - k udot.
    start : same
        In place of x and y: a fraction, -1 to 1, of the section's radius along y = 0.
    progress : callable, optional
        Called now and then with the share done, 0 to 1, and the seconds that are left.
    checkpoint : path, optional
        A file that holds what has been computed while the run lasts; a run that was killed goes on
        from there.

    Returns
    -------
    Dataset
        x, xdot, udot, tau on `impact`, the start excluded: each the double nearest to the true
        value, or 0 where that is closer to 0 than 2^-80. Attribute bits: the precision it took.

    Raises
    ------
    ValueError
        Numbers that are not exact or not allowed, a start on or beyond the rim, a flight that
        grazes to within the precision, more bits than MOST_BITS, too little memory.
    """
    surface = Surface(k, g, energy)
    place = _Start(surface, x, y, start)
    impacts = whole_number("impacts", impacts)
    _memory(impacts)
    run = _resumed(checkpoint, surface, place, impacts)
    if run is None:
        run = _Run(surface, place, impacts, _bits_needed(surface, place, impacts))
    clock = _Clock(run, progress, checkpoint)
    while run.count < impacts:
        try:
            run.step()
        except _ShortOfBitsError:
            run = _Run(surface, place, impacts, run.bits + run.bits // 4 + 100)
            clock = _Clock(run, progress, checkpoint)
        clock.tick(run)
    if checkpoint is not None:
        Path(checkpoint).unlink(missing_ok=True)
    data = variables("impact", run.values.T)
    return xr.Dataset(data, coords={"impact": np.arange(1, impacts + 1)}, attrs={"bits": run.bits})


def true_scene_orbits(k, g, energy, starts, impacts, *, progress=None, folder=None):
    """The orbits of a scene, as `dynamics.orbits.scene_orbits` returns them, correctly rounded.

    Parameters
    ----------
    k, g, energy, starts
        Exact, as for `true_orbit`; starts are fractions of the section's radius along y = 0.
    impacts : list of int
        How many of each orbit.
    progress : callable, optional
        Called with the share done and the seconds left of the orbit at work, and its index.
    folder : path, optional
        Where finished orbits and the checkpoint of the one at work are while the run lasts.
    """
    pieces = []
    for index, (start, count) in enumerate(zip(starts, impacts, strict=True)):
        pieces.append(_kept(folder, index, k, g, energy, start, count, progress))
    if folder is not None:
        for file in Path(folder).glob("orbit_*.npz"):
            file.unlink()
    return ragged_orbits(pieces, [float(exact("start", start)) for start in starts], impacts)


def _kept(folder, index, k, g, energy, start, count, progress):
    """One orbit of a scene, (4, count), from the folder if it is there."""
    report = None if progress is None else lambda *done: progress(*done, index)
    if folder is None:
        found = true_orbit(k, g, energy, count, start=start, progress=report)
        return _columns(found)
    Path(folder).mkdir(parents=True, exist_ok=True)
    identity = json.dumps([str(Surface(k, g, energy)), str(exact("start", start)), count])
    file = Path(folder) / f"orbit_{index}.npz"
    saved = _load(file)
    if saved is not None and str(saved["identity"]) == identity:
        return saved["values"]
    found = true_orbit(
        k, g, energy, count, start=start, progress=report,
        checkpoint=Path(folder) / f"orbit_{index}.part.npz",
    )  # fmt: skip
    values = _columns(found)
    _save(file, identity=identity, values=values)
    return values


def _columns(dataset):
    return np.array([dataset[name].values for name in ("x", "xdot", "udot", "tau")])


class _Start:
    """An exact start: balls of its coordinates at any precision."""

    def __init__(self, surface, x, y, start):
        if (x is None) == (start is None):
            raise ValueError("a start is x and y, or a fraction of the section's radius: one of it")
        self.surface = surface
        self.fraction = None if start is None else exact("start", start)
        self.x = None if x is None else exact("x", x)
        self.y = exact("y", y)
        inside = self._inside()
        if not inside:
            what = f"start = {self.fraction}" if x is None else f"x = {self.x}, y = {self.y}"
            raise ValueError(f"{what} is not inside the section's rim at {surface}")

    def _inside(self):
        """Exactly: whether s > 0 there."""
        if self.fraction is not None:
            return -1 < self.fraction < 1
        k, g, energy = self.surface.k, self.surface.g, self.surface.energy
        return (1 + k) * (2 * energy + self.x * (2 * g - k * self.x)) > self.y * self.y

    def balls(self):
        """(x, y) at the context's precision."""
        if self.fraction is None:
            return ball_of(self.x), ball_of(self.y)
        k, g, _ = self.surface.constants()
        return g / k + ball_of(self.fraction) * self.surface.radius(), arb(0)

    def identity(self, impacts):
        """What a checkpoint must be of."""
        parts = (self.surface.k, self.surface.g, self.surface.energy, self.fraction, self.x, self.y)
        return json.dumps([str(part) for part in parts] + [impacts])


class _Run:
    """The orbit up to `count` impacts: z, C, r and the results so far."""

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
        self.centre, self.frame = centre, ((arb(1), arb(0)), (arb(0), arb(1)))
        self.reach = [abs(a).upper() for a in off]

    def step(self):
        """One impact further."""
        before = self._box(RESULT_BITS + GUARD)
        with ctx.workprec(self.digits):
            try:
                image = self.surface.impact(*self.centre)
            except Undecided as error:
                raise self._stuck(error) from None
        rows = self._tangent()
        with ctx.workprec(FRAME_BITS):
            carried = [
                [m[0] * self.frame[0][j] + m[1] * self.frame[1][j] for j in (0, 1)] for m in rows
            ]
            frame, inverse = _frame(carried, self.reach)
            spread = [
                sum(
                    abs(inverse[i][0] * carried[0][j] + inverse[i][1] * carried[1][j])
                    * self.reach[j]
                    for j in (0, 1)
                )
                for i in (0, 1)
            ]
        known = -max(_exponent(a) for a in (*spread, image.x.rad(), image.y.rad()))
        if known < LEAST_BITS:
            raise _ShortOfBitsError
        self.digits = min(self.digits, 64 * ((known + GUARD) // 64 + 1))
        with ctx.workprec(self.digits):
            self.centre = [(+image.x).mid(), (+image.y).mid()]
            off = [image.x - self.centre[0], image.y - self.centre[1]]
        with ctx.workprec(FRAME_BITS):
            self.frame = frame
            self.reach = [
                (a + abs(row[0]) * abs(off[0]) + abs(row[1]) * abs(off[1])).upper()
                for a, row in zip(spread, inverse, strict=True)
            ]
        self.values[self.count] = self._rounded(before)
        self.count += 1

    def _box(self, bits):
        """Balls around the true x and y."""
        with ctx.workprec(bits):
            return [
                arb((+z).mid(), (abs(row[0]) * self.reach[0] + abs(row[1]) * self.reach[1]
                                 + (+z).rad()).upper())
                for z, row in zip(self.centre, self.frame, strict=True)
            ]  # fmt: skip

    def _tangent(self):
        """DP over all points that the true one may be, with as few bits as will do."""
        bits = FRAME_BITS
        while True:
            with ctx.workprec(bits):
                try:
                    return self.surface.jacobian(*self._box(bits))[0]
                except Undecided as error:
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
        numbers = [*self.centre, *self.frame[0], *self.frame[1], *self.reach]
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
        run.centre, run.frame = numbers[:2], (tuple(numbers[2:4]), tuple(numbers[4:6]))
        run.reach = numbers[6:]
        return run


def _frame(carried, reach):
    """An orthogonal frame along the longer of two carried columns, exact, and its inverse."""
    sizes = [(abs(carried[0][j]) + abs(carried[1][j])).upper() * reach[j] for j in (0, 1)]
    j = 0 if sizes[0] >= sizes[1] else 1
    a, b = carried[0][j].mid(), carried[1][j].mid()
    length = (a * a + b * b).sqrt()
    a, b = (a / length).mid(), (b / length).mid()
    square = a * a + b * b
    return ((a, -b), (b, a)), ((a / square, b / square), (-b / square, a / square))


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
    raise _ShortOfBitsError


def _bits_needed(surface, place, impacts):
    """Bits to start with, from the stretch along the orbit in double precision."""
    ball = Ball(k=float(surface.k), g=float(surface.g))
    with ctx.workprec(FRAME_BITS):
        x, y = (float(a) for a in place.balls())
    state = ball.state_xy(x, y, float(surface.energy))
    spectrum = lyapunov_spectrum(ball, state, impacts)
    stretch = spectrum["exponent"].values[:, 0] * spectrum["impact"].values
    growth = float(np.nanmax(stretch, initial=0.0)) / math.log(2.0)
    # the true orbit stretches by as much only in the mean: its spread grows like the root
    return RESULT_BITS + GUARD + int(growth + 12.0 * math.sqrt(growth)) + 64


def _memory(impacts):
    """ValueError where the results would not fit into memory."""
    needed = 200 * impacts  # bytes, as doubles in the run, the Dataset and a checkpoint
    there = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    if needed > there // 2:
        raise ValueError(f"{impacts} impacts need {needed / 1e9:.0f} GB of memory")


class _Clock:
    """Progress and checkpoints."""

    def __init__(self, run, progress, checkpoint):
        self.progress, self.checkpoint = progress, checkpoint
        self.begin = self.said = self.saved = time.monotonic()
        self.first = run.count
        self.total = self._work(run)

    def tick(self, run):
        now = time.monotonic()
        if self.progress is not None and (now - self.said > 1.0 or run.count == run.impacts):
            self.said = now
            left = self._work(run)
            spent = max(self.total - left, 1e-9)
            self.progress(run.count / run.impacts, (now - self.begin) * left / spent)
        if self.checkpoint is not None and now - self.saved > EVERY and run.count < run.impacts:
            self.saved = now
            _save(
                Path(self.checkpoint), identity=run.place.identity(run.impacts), state=run.state(),
                values=run.values[: run.count],
            )  # fmt: skip

    @staticmethod
    def _work(run):
        """What is left, in impacts of 64 bits: an impact of b costs about 1 + (b/6000)^1.6."""
        return (run.impacts - run.count) * (1.0 + (run.digits / 6000.0) ** 1.6 / 2.6)


def _resumed(checkpoint, surface, place, impacts):
    """The run of a checkpoint of this very orbit, or None."""
    saved = None if checkpoint is None else _load(Path(checkpoint))
    if saved is None or str(saved["identity"]) != place.identity(impacts):
        return None
    return _Run.restored(surface, place, impacts, str(saved["state"]), saved["values"])


def _save(path, **arrays):
    part = path.with_name(path.name + ".writing")
    with open(part, "wb") as file:
        np.savez(file, **arrays)
    os.replace(part, path)


def _load(path):
    """The arrays of a file that `_save` wrote; None if it is missing or damaged."""
    try:
        with np.load(path) as file:
            return {name: file[name] for name in file.files}
    except (OSError, ValueError, EOFError, KeyError):
        return None
