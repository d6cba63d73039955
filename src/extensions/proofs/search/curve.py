"""Search for invariant curves around elliptic orbits: Newton's method on Fourier coefficients.

It starts from an orbit in doubles on the curve with the wanted rotation number. Everything here is
midpoints: `checkers.curve` proves the result. A curve is a pair of polynomials in the form of
`checkers.circle`, of which x is even and y is odd.
"""

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from flint import acb, arb, ctx
from scipy.optimize import bisect

from pseudorigid.dynamics.orbits import orbit
from pseudorigid.dynamics.variables import chart, states_of
from study.flight import NotProvedError

from ..checkers.certificate import Finding
from ..checkers.circle import derivative, noble, real_values, rotated, transform
from ..checkers.curve import Curve, normal_vector
from ..enclosure.jets import Jet
from ..enclosure.surface import Surface, fraction_of
from .certificate_text import Theorem, fixed, header, rows
from .periodic import BITS as CENTRE_BITS
from .periodic import centre_rows, nearest_ball, points_of, polished
from .rotation_numbers import quotients_near

BITS = 320
_IMPACTS = 40_000  # of the orbit whose averages start Newton's method
_SCAN, _SCAN_IMPACTS = 120, 4000  # starts between the centre and the rim, and impacts of each
_LARGEST_STEP = 0.05  # of the rotation number from one start to the next, without a jump
_NOISE = 1e-11  # Fourier coefficients from the orbit below this are rounding errors
_SPARE_DIGITS = 4  # of a coefficient with weight 1, beyond the error
_STEPS = 6
# Of the sizes that `search` tries: the strip as a part of that in which the coefficients decay,
# cells along it, the share of the rest that its modes use, and more digits of the error.
_TRIALS = (0.4, 6, 0.6, 0.0), (0.3, 9, 0.5, 4.0)
_DIGITS_OF_ERROR = 12.0  # that the error has, besides those of the loss to the fourth power


class Sizes(NamedTuple):
    """Sizes for the checker."""

    strip: str  # half width of the strip of the error
    loss: str  # what each step of the proof loses of it
    columns: int  # cells around the circle
    rows: int  # cells from the real axis to the strip's edge
    more_rows: int  # cells beyond it
    modes: int  # Fourier modes of the curve


class _Start(NamedTuple):
    """What Newton's method starts from."""

    points: list[list[float]]  # of the orbit, the first one on y = 0
    quotients: Sequence[int]  # of the rotation number
    xs: list[float]  # the curve is the sum of xs[q] cos(2 pi q t), ys[q] sin(2 pi q t)
    ys: list[float]


def propose(theorem: Theorem, quotients: Sequence[int], strips: Sequence, error: str) -> str:
    """Return a certificate for a curve around a point (x, 0) of a symmetric orbit.

    The rotation number is that of `checkers.circle.noble`, and `strips` are the `Sizes`. Of the
    orbit's points on y = 0 the one with the greatest x is taken.
    """
    share = str(float(theorem.bounds["share"]))
    return _certificate(theorem, _start(theorem, quotients), Sizes(*strips), share, error)


def search(theorem: Theorem, rotation: float) -> tuple[str, Finding]:
    """Return a certificate for a curve, and the checker's finding, with sizes that are tried.

    The rotation number is close to the given one. Raises ValueError if no curve is found, or the
    checker's NotProvedError if the last sizes fail.
    """
    start = _start(theorem, quotients_near(rotation))
    xs, ys = start.xs, start.ys
    decay = -math.log(_NOISE / abs(xs[1])) / len(xs)  # of the coefficients per mode
    area = math.pi * abs(sum(q * x * y for q, (x, y) in enumerate(zip(xs, ys, strict=True))))
    with ctx.workprec(64):  # rounding adds less than 1e-4
        share = f"{0.9999 * area / float(theorem.bounds['surface'].area()):.5g}"
    for trial in _TRIALS:
        sizes, error = _sizes(decay, *trial)
        text = _certificate(theorem, start, sizes, share, error)
        try:
            return text, theorem.prove(text)
        except NotProvedError as refusal:
            reason = refusal
    raise reason


def _sizes(decay: float, part: float, cells: float, room: float, spare: float) -> tuple[Sizes, str]:
    """Return sizes for a strip that is a part of the widest, and the error to be reached in it."""
    strip = part * decay / (2.0 * math.pi)
    loss = strip / 6.2
    digits = math.ceil(_DIGITS_OF_ERROR + spare - 4.0 * math.log10(loss))
    modes = math.ceil(digits * math.log(10.0) / (room * (1.0 - part) * decay))
    columns = 1 << max(6, math.ceil(math.log2(cells / strip)))
    rows = math.ceil(columns * strip)
    more_rows = math.ceil(0.6 * rows)
    return Sizes(f"{strip:.4g}", f"{loss:.3g}", columns, rows, more_rows, modes), f"1e-{digits}"


def _start(theorem: Theorem, quotients: Sequence[int]) -> _Start:
    """Find a curve in doubles, around the orbit's point with y = 0 and the greatest x."""
    surface, points = theorem.bounds["surface"], points_of(theorem, "elliptic")
    symmetric = [i for i, point in enumerate(points) if abs(point[1]) < 1e-9]
    if not symmetric:
        raise ValueError("the orbit has no point on y = 0")
    first = max(symmetric, key=lambda i: points[i][0])
    points = points[first:] + points[:first]
    with ctx.workprec(BITS):
        omega = float(noble(quotients)[0])
    x = _start_on_curve(surface, points, omega)
    return _Start(points, quotients, *_coefficients_of_orbit(surface, x, len(points), omega))


def _start_on_curve(surface: Surface, points: Sequence, omega: float) -> float:
    """Return the x > that of the first point at which y = 0 meets the curve of a rotation number.

    The curve nearest to the point is taken. Raises ValueError if there is none.
    """
    centre, period = points[0][0], len(points)
    with ctx.workprec(53):
        k, g, _ = surface.constants()
        rim = float(g / k + surface.radius())
    reach = rim - centre
    if period > 1:  # half way to the nearest of the other points
        others = np.asarray(points[1:], dtype=float)
        reach = 0.5 * float(np.abs(others - points[0]).max(axis=1).min())

    def excess(x: float, impacts: int = _IMPACTS) -> float:
        return turns(surface, x, points, impacts) - omega

    places = [centre + reach * i / _SCAN for i in range(1, _SCAN)]
    values: list[float] = []
    for i, x in enumerate(places):
        values.append(excess(x, _SCAN_IMPACTS))
        if i and values[-2] * values[-1] < 0.0 and abs(values[-1]) < _LARGEST_STEP:
            return float(bisect(excess, places[i - 1], x, xtol=1e-17))
    steps = enumerate(pairwise(values), 1)
    jump = next((i for i, (a, b) in steps if not abs(b - a) < _LARGEST_STEP), len(values))
    low, high = omega + min(values[:jump]), omega + max(values[:jump])
    raise ValueError(
        f"no curve with the rotation number {omega:.6g} was found on y = 0: "
        f"near the point the numbers go from {low:.4f} to {high:.4f}"
    )


def turns(surface: Surface, x: float, points: Sequence, impacts: int) -> float:
    """Return the clockwise turns of P^n around the first point, per n impacts, modulo 1."""
    z = _orbit(surface, x, len(points), impacts)
    angles = np.angle(z[0] - points[0][0] + 1j * (z[1] - points[0][1])) / (2.0 * math.pi)
    steps = np.mod(-np.diff(angles), 1.0)
    return float(_weights(steps.size) @ steps)


def _weights(size: int) -> np.ndarray:
    """Return the weights of a weighted Birkhoff average."""
    t = (np.arange(size) + 0.5) / size
    bump = np.exp(-1.0 / (t * (1.0 - t)))
    return bump / bump.sum()


def _orbit(surface: Surface, x: float, period: int, impacts: int) -> np.ndarray:
    """Return every period-th point (x, y) after the one at (x, 0) of its orbit."""
    ball = nearest_ball(surface)
    with ctx.workprec(64):
        v, w = (float(a) for a in surface.velocities(arb(x), arb(0)))
    data = orbit(ball, (x, v, w), impacts * period)
    return chart(ball.k, *states_of(data))[:, period - 1 :: period]


def _coefficients_of_orbit(
    surface: Surface, x: float, period: int, omega: float
) -> tuple[list[float], list[float]]:
    """Return x_q and y_q of the curve through (x, 0), from averages along its orbit."""
    z = _orbit(surface, x, period, _IMPACTS)
    phases = np.mod(omega * np.arange(1, z.shape[1] + 1), 1.0)
    weights = _weights(z.shape[1])
    xs, ys = [float(weights @ z[0])], [0.0]
    for q in range(1, 2000):
        angle = 2.0 * math.pi * q * phases
        xs.append(float(2.0 * (weights * z[0]) @ np.cos(angle)))
        ys.append(float(2.0 * (weights * z[1]) @ np.sin(angle)))
        if q > 4 and max(abs(a) for a in (*xs[-3:], *ys[-3:])) < _NOISE:
            break
    return xs[:-3], ys[:-3]


def _certificate(theorem: Theorem, start: _Start, sizes: Sizes, share: str, error: str) -> str:
    """Return a certificate of the curve that Newton's method finds from a start."""
    surface, radius = theorem.bounds["surface"], f"{float(theorem.bounds['radius']):g}"
    with ctx.workprec(CENTRE_BITS):
        centres = polished(surface, start.points)
    with ctx.workprec(BITS):
        coefficients = _formatted(_curve(surface, centres, start, sizes.modes), sizes.strip, error)
    return (
        header("invariant curve", surface)
        + f"radius = {radius}\n"
        + centre_rows(centres)
        + "# The rotation number's partial quotients after 0, and those that repeat for ever.\n"
        + f"quotients = [{', '.join(map(str, start.quotients))}]\nrepeating = [1]\n"
        + f"share = {share}\nerror = {error}\nstrip = {sizes.strip}\nloss = {sizes.loss}\n"
        + f"columns = {sizes.columns}\nrows = {sizes.rows}\nmore_rows = {sizes.more_rows}\n"
        + "# The curve is the sum of x_q cos(2 pi q t), y_q sin(2 pi q t), q = 0, ...\n"
        + rows("coefficients", coefficients)
    )


def _formatted(curve: Curve, strip: str, error: str) -> list[str]:
    """Format a curve's coefficients with the digits that the error in the strip demands."""
    lines = []
    digits = _SPARE_DIGITS - math.log10(float(error))
    decay = 2.0 * math.pi * float(strip) / math.log(10.0)  # in digits per mode
    for q, (x, y) in enumerate(zip(*curve, strict=True)):
        pair = (2 * x.real if q else x.real), -2 * y.imag
        decimals = math.ceil(digits + decay * q)
        lines.append(f"[{', '.join(fixed(fraction_of(value), decimals) for value in pair)}]")
    return lines


def _curve(surface: Surface, centres: list, start: _Start, modes: int) -> Curve:
    """Improve a curve by Newton's method until its error settles."""
    omega, _ = noble(start.quotients)
    curve: Curve = (
        [acb(a / 2 if q else a) for q, a in enumerate(start.xs)],
        [acb(0, -a / 2) for a in start.ys],
    )
    last = math.inf
    for _ in range(_STEPS):
        count = min(modes, 2 * len(curve[0]) + 20)
        curve, size = _newton_step(surface, centres, curve, omega, count)
        if not size < last * 1e-2 and count == modes:
            break
        last = size
    return curve


def _newton_step(
    surface: Surface, centres: list, curve: Curve, omega: arb, modes: int
) -> tuple[Curve, float]:
    """Return the curve after one Newton step, and the error before it."""
    count = 1 << (3 * modes).bit_length()
    shifted = [rotated(row, omega) for row in curve]
    here, there, tangent, tangent_there = (
        list(zip(*(real_values(row, count) for row in rows), strict=True))
        for rows in (curve, shifted, map(derivative, curve), map(derivative, shifted))
    )
    along, across, twist, normals, size = [], [], [], [], 0.0
    for i in range(count):
        image, matrix = _power(surface, here[i], len(centres))
        error = [a - b for a, b in zip(image, there[i], strict=True)]
        size = max(size, *(abs(float(a)) for a in error))
        normals.append(normal_vector(here[i], tangent[i], centres[0])[0])
        after = normal_vector(there[i], tangent_there[i], centres[0])[0]
        along.append(_det(error, after))
        across.append(_det(tangent_there[i], error))
        twist.append(_det([a * normals[i][0] + b * normals[i][1] for a, b in matrix], after))
    divisors = [1 - acb(2 * q * omega).exp_pi_i() for q in range(count // 2)]
    second = _cohomology([-a for a in across], divisors)
    rest = [-a - t * b for a, t, b in zip(along, twist, second, strict=True)]
    mean = sum(rest, arb(0)) / sum(twist, arb(0))
    second = [a + mean for a in second]
    rest = [-a - t * b for a, t, b in zip(along, twist, second, strict=True)]
    first = _cohomology(rest, divisors)
    moved = list(zip(here, tangent, first, normals, second, strict=True))
    x, y = (
        transform([(z[r] + t[r] * a + n[r] * b).mid() for z, t, a, n, b in moved], modes)
        for r in (0, 1)
    )
    return ([acb(a.real.mid()) for a in x], [acb(0, a.imag.mid()) for a in y]), size


def _power(
    surface: Surface, point: Sequence[arb], period: int
) -> tuple[list[arb], list[list[arb]]]:
    """Return the image of a point under P^n, and the derivative's rows, as midpoints."""
    x, y = point
    jets = Jet.plane(1, x.mid(), y.mid())
    for _ in range(period):
        image = surface.impact(*jets)
        jets = image.x, image.y
        for jet in jets:
            jet.coefficients[:] = [a.mid() for a in jet.coefficients]
    return [jet.constant for jet in jets], [jet.coefficients[1:] for jet in jets]


def _cohomology(values: list[arb], divisors: list[acb]) -> list[arb]:
    """Solve u - u(t + omega) = f - <f> on the grid, with <u> = 0."""
    waves = transform([a.mid() for a in values], len(divisors) - 1)
    solved = [(a / b).mid() for a, b in zip(waves[1:], divisors[1:], strict=True)]
    return real_values([acb(0), *solved], len(values))


def _det(a: Sequence[arb], b: Sequence[arb]) -> arb:
    return a[0] * b[1] - a[1] * b[0]
