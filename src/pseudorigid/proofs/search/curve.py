"""Search for invariant curves around elliptic orbits: Newton's method on Fourier coefficients.

It starts from an orbit in doubles on the curve with the wanted rotation number. Everything here is
midpoints: `checks.curve` proves the result.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from flint import acb, arb, ctx

from ...dynamics.orbits import orbit
from ...dynamics.variables import chart, states_of
from ..checks.certificate import Finding, NotProvedError
from ..checks.circle import noble
from ..enclosure.flight import UndecidedError
from ..enclosure.jets import Jet
from ..enclosure.surface import Surface
from . import approximate_orbits
from .certificate_text import decimal, header
from .periodic import BITS as CENTRE_BITS
from .periodic import centre_rows, polished

BITS = 320
_IMPACTS = 40_000  # of the orbit whose averages start Newton's method
_SCAN = 120  # starts between the centre and the rim
_NOISE = 1e-11  # Fourier coefficients from the orbit below this are rounding errors
_SPARE_DIGITS = 4  # of a coefficient with weight 1, beyond the error
_STEPS = 6
_CLOSE = 5e-4  # of a noble number to the wanted rotation number
_DIGITS_OF_ERROR = 18.5  # that the error has, besides those of the loss to the eighth power


class NoCurveError(ValueError):
    """No curve with the wanted rotation number was found."""


@dataclass(frozen=True)
class Strips:
    """Sizes for the checker.

    Attributes
    ----------
    strip, loss : str
        Half width of the strip of the error, and what each step of the proof loses of it.
    columns, rows, more_rows : int
        Cells around the circle, from the real axis to the strip's edge, and beyond it.
    modes : int
        Fourier modes of the curve.
    """

    strip: str
    loss: str
    columns: int
    rows: int
    more_rows: int
    modes: int


def propose(
    surface: Surface,
    points: Sequence,
    quotients: Sequence[int],
    strips: Strips,
    *,
    radius: str,
    share: str,
    error: str,
) -> str:
    """Return a certificate for a curve around a point (x, 0) of a symmetric orbit.

    The rotation number is that of `checks.circle.noble`. Of the orbit's points on y = 0 the one
    with the greatest x is taken.
    """
    points = from_symmetric_point(points)
    with ctx.workprec(CENTRE_BITS):
        centres = polished(surface, points)
    with ctx.workprec(BITS):
        omega, _ = noble(quotients)
        start = start_on_curve(surface, points, float(omega))
        xs, ys = coefficients_of_orbit(surface, start, len(points), float(omega))
        x, y = newton(surface, centres[0], len(points), xs, ys, omega, strips.modes)
        return text_of(surface, centres, quotients, strips, radius, share, error, x, y)


def search(
    surface: Surface,
    points: Sequence,
    quotients: Sequence[int],
    prove: Callable[[str], Finding],
) -> tuple[str, Finding]:
    """Return a certificate for a curve, and the checker's finding, with sizes that are tried.

    The strips follow from the decay of the coefficients of an orbit in doubles. Raises
    NoCurveError, or the checker's NotProvedError if the last sizes fail.
    """
    points = from_symmetric_point(points)
    with ctx.workprec(BITS):
        omega = float(noble(quotients)[0])
    start = start_on_curve(surface, points, omega)
    xs, ys = coefficients_of_orbit(surface, start, len(points), omega)
    decay = -math.log(_NOISE / abs(xs[1])) / len(xs)
    area = math.pi * abs(sum(q * x * y for q, (x, y) in enumerate(zip(xs, ys, strict=True))))
    with ctx.workprec(64):
        k, g, energy = (float(a) for a in surface.constants())
    section = math.pi * (2.0 * energy + g * g / k) * math.sqrt((1.0 + k) / k)
    share = f"{0.9999 * area / section:.5g}"  # rounding to five digits adds less than 1e-4
    for part, cells, room, spare in ((0.4, 6, 0.6, 0.0), (0.3, 9, 0.5, 4.0)):
        strip = part * decay / (2.0 * math.pi)
        loss = strip / 6.2
        digits = math.ceil(_DIGITS_OF_ERROR + spare - 8.0 * math.log10(loss))
        modes = math.ceil(digits * math.log(10.0) / (room * (1.0 - part) * decay))
        columns = 1 << max(6, math.ceil(math.log2(cells / strip)))
        rows = math.ceil(columns * strip)
        strips = Strips(f"{strip:.4g}", f"{loss:.3g}", columns, rows, math.ceil(0.6 * rows), modes)
        text = propose(
            surface, points, quotients, strips,
            radius="1e-6", share=share, error=f"1e-{digits}",
        )  # fmt: skip
        try:
            return text, prove(text)
        except NotProvedError as error:
            reason = error
    raise reason


def quotients_near(value: float) -> list[int]:
    """Return partial quotients for which the number of `checks.circle.noble` is close to a value.

    They are the first ones of the value's continued fraction. Raises NoCurveError for a value so
    close to a fraction of small integers that this gives no number close to it.
    """
    golden, rest, quotients = 0.5 * (1.0 + math.sqrt(5.0)), value, []
    while True:
        rest = 1.0 / rest
        quotients.append(int(rest))
        noble_value = golden
        for a in reversed(quotients):
            noble_value = a + 1.0 / noble_value
        rest -= int(rest)
        if abs(1.0 / noble_value - value) < _CLOSE:
            return quotients
        if rest < _CLOSE:
            raise NoCurveError(f"{value:.10g} is too close to a fraction of small integers")


def from_symmetric_point(points: Sequence) -> list[list[float]]:
    """Return an orbit's points from the one with y = 0 and the greatest x on.

    Raises NoCurveError if there is none.
    """
    points = [[float(a) for a in point] for point in points]
    symmetric = [i for i, point in enumerate(points) if abs(point[1]) < 1e-9]
    if not symmetric:
        raise NoCurveError("the orbit has no point on y = 0")
    first = max(symmetric, key=lambda i: points[i][0])
    return points[first:] + points[:first]


def text_of(surface, centres, quotients, strips, radius, share, error, x, y) -> str:
    """Format a certificate; the curve is the sum of x_q cos(2 pi q t), y_q sin(2 pi q t)."""
    digits = _SPARE_DIGITS - math.log10(float(error))
    weights = [
        math.ceil(digits + 2.0 * math.pi * q * float(strips.strip) / math.log(10.0))
        for q in range(len(x))
    ]
    lines = [
        header("invariant curve", surface),
        f"radius = {radius}\n",
        centre_rows(centres),
        "# The rotation number's partial quotients after 0, and those that repeat for ever.\n",
        f"quotients = [{', '.join(map(str, quotients))}]\nrepeating = [1]\n",
        f"share = {share}\nerror = {error}\nstrip = {strips.strip}\nloss = {strips.loss}\n",
        f"columns = {strips.columns}\nrows = {strips.rows}\nmore_rows = {strips.more_rows}\n",
        "# x_q and y_q: the curve is the sum of x_q cos(2 pi q t), y_q sin(2 pi q t), q = 0, ...\n",
        "coefficients = [\n",
        *(
            f"  [{_fixed(a, weight)}, {_fixed(b, weight)}],\n"
            for weight, a, b in zip(weights, x, y, strict=True)
        ),
        "]\n",
    ]
    return "".join(lines)


def _fixed(value: arb, decimals: int) -> str:
    """Format a number with this many decimals."""
    scaled = round(Fraction(decimal(value * arb(10) ** decimals, 90)))
    return f"{scaled}e-{decimals}" if scaled else "0.0"


def start_on_curve(surface: Surface, points: Sequence, omega: float) -> float:
    """Return the x > that of the first point at which y = 0 meets the curve of a rotation number.

    The curve nearest to the point is taken. Raises NoCurveError if there is none.
    """
    centre, period = float(points[0][0]), len(points)
    with ctx.workprec(53):
        k, g, _ = surface.constants()
        rim = float(g / k + surface.radius())
    reach = rim - centre if period == 1 else 0.5 * _nearest(points)
    previous = None
    for i in range(1, _SCAN):
        x = centre + reach * i / _SCAN
        value = turns(surface, x, points, 4000) - omega
        if previous is not None and previous[1] * value < 0.0 and abs(value) < 0.05:
            return _bisect(surface, points, omega, previous[0], x)
        previous = x, value
    raise NoCurveError(f"no curve with the rotation number {omega:.6g} was found on y = 0")


def _nearest(points: Sequence) -> float:
    """Return the distance between the first point and the nearest of the others."""
    first, *others = np.asarray(points, dtype=float)
    return float(min(np.abs(np.array(others) - first).max(axis=1)))


def _bisect(surface, points, omega, low, high):
    """Return the start between two at which the rotation number is omega."""
    sign = turns(surface, low, points, _IMPACTS) - omega
    for _ in range(60):
        middle = 0.5 * (low + high)
        if not low < middle < high:
            break
        if (turns(surface, middle, points, _IMPACTS) - omega) * sign > 0.0:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)


def turns(surface: Surface, x: float, points: Sequence, impacts: int) -> float:
    """Return the clockwise turns of P^n around the first point, per n impacts, modulo 1."""
    z = _orbit(surface, x, len(points), impacts)
    angles = np.angle(z[0] - points[0][0] + 1j * (z[1] - points[0][1])) / (2.0 * math.pi)
    steps = np.mod(-np.diff(angles), 1.0)
    weights = _weights(steps.size)
    return float(weights @ steps)


def _weights(size: int) -> np.ndarray:
    """Return the weights of a weighted Birkhoff average."""
    t = (np.arange(size) + 0.5) / size
    bump = np.exp(-1.0 / (t * (1.0 - t)))
    return bump / bump.sum()


def _orbit(surface: Surface, x: float, period: int, impacts: int) -> np.ndarray:
    """Return every period-th point (x, y) after the one at (x, 0) of its orbit."""
    ball = approximate_orbits.ball(surface)
    with ctx.workprec(64):
        try:
            v, w = (float(a) for a in surface.velocities(arb(x), arb(0)))
        except UndecidedError as error:
            raise NoCurveError(str(error)) from None
    data = orbit(ball, (x, v, w), impacts * period)
    return chart(ball.k, *states_of(data))[:, period - 1 :: period]


def coefficients_of_orbit(
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


def newton(surface, centre, period, xs, ys, omega, modes) -> tuple[list[arb], list[arb]]:
    """Improve a curve's coefficients until the error settles; returns x_q and y_q."""
    x, y = ([arb(a) for a in row] for row in (xs, ys))
    last = None
    for _ in range(_STEPS):
        most = min(modes, 2 * len(x) + 20)
        x, y, size = _newton_step(surface, centre, period, x, y, omega, most)
        if last is not None and not size < last * 1e-2 and most == modes:
            break
        last = size
    return x, y


def _newton_step(surface, centre, period, x, y, omega, modes):
    """Return the coefficients after one Newton step, and the error before it."""
    count = 1 << (3 * modes).bit_length()
    padded = [row + [arb(0)] * (modes + 1 - len(row)) for row in (x, y)]
    waves = [_waves(padded[0], count, even=True), _waves(padded[1], count, even=False)]
    turn = [(2 * arb(q) * omega).cos_pi() + acb(0, 1) * (2 * arb(q) * omega).sin_pi()
            for q in _frequencies(count)]  # fmt: skip
    slope = [acb(0, 2 * arb.pi() * q) for q in _frequencies(count)]
    here = [_values(row) for row in waves]
    there = [_values(_times(row, turn)) for row in waves]
    tangent = [_values(_times(row, slope)) for row in waves]
    tangent_there = [_values(_times(_times(row, slope), turn)) for row in waves]
    residual, twist, normals = ([], []), [], ([], [])
    size = 0.0
    for i in range(count):
        (px, py), (lx, ly) = (here[0][i], here[1][i]), (tangent_there[0][i], tangent_there[1][i])
        image, rows = _power(surface, px, py, period)
        error = [(image[r] - there[r][i]).mid() for r in (0, 1)]
        size = max(size, *(abs(float(a)) for a in error))
        n = _normal((px, py), (tangent[0][i], tangent[1][i]), centre)
        n_there = _normal((there[0][i], there[1][i]), (lx, ly), centre)
        pushed = [(rows[r][0] * n[0] + rows[r][1] * n[1]).mid() for r in (0, 1)]
        residual[0].append(_det(error, n_there))
        residual[1].append(_det((lx, ly), error))
        twist.append(_det(pushed, n_there))
        for r in (0, 1):
            normals[r].append(n[r])
    divisor = [1 - a for a in turn]
    second = _cohomology([-a for a in residual[1]], divisor)
    mean = _mean([-a - t * b for a, t, b in zip(residual[0], twist, second, strict=True)])
    mean /= _mean(twist)
    second = [(a + mean).mid() for a in second]
    right = [-a - t * b for a, t, b in zip(residual[0], twist, second, strict=True)]
    first = _cohomology(right, divisor)
    new = []
    for r in (0, 1):
        values = [
            (p + t * a + n * b).mid()
            for p, t, a, n, b in zip(here[r], tangent[r], first, normals[r], second, strict=True)
        ]
        new.append([a / count for a in acb.dft(values)])
    x = [new[0][0].real.mid()] + [(2 * new[0][q].real).mid() for q in range(1, modes + 1)]
    y = [arb(0)] + [(-2 * new[1][q].imag).mid() for q in range(1, modes + 1)]
    return x, y, size


def _power(surface, x, y, period):
    """Return the image of a point under P^n and the derivative's rows, midpoints."""
    x, y = Jet.plane(1, x.mid(), y.mid())
    for _ in range(period):
        x, y, *_ = surface.impact(x, y)
        for jet in (x, y):
            jet.coefficients[:] = [a.mid() for a in jet.coefficients]
    return (x.constant, y.constant), (x.coefficients[1:], y.coefficients[1:])


def _frequencies(count: int) -> list[int]:
    return [q if q < count // 2 else q - count for q in range(count)]


def _waves(row: list[arb], count: int, even: bool) -> list[acb]:
    """Return complex Fourier coefficients in the order of the transform."""
    waves = [acb(0)] * count
    waves[0] = acb(row[0])
    for q in range(1, len(row)):
        half = acb(row[q] / 2) if even else acb(0, -row[q] / 2)
        waves[q], waves[-q] = half, half.conjugate()
    return waves


def _times(waves: list[acb], factors: list[acb]) -> list[acb]:
    return [a * b for a, b in zip(waves, factors, strict=True)]


def _values(waves: list[acb]) -> list[arb]:
    """Return the real values of a Fourier series on the grid."""
    count = len(waves)
    return [(a.real * count).mid() for a in acb.dft(waves, inverse=True)]


def _cohomology(values: list[arb], divisor: list[acb]) -> list[arb]:
    """Solve u - u(t + omega) = f - <f> on the grid, with <u> = 0."""
    waves = [a / len(values) for a in acb.dft(values)]
    half = len(values) // 2
    solved = [
        acb(0) if q in (0, half) else a / b
        for q, (a, b) in enumerate(zip(waves, divisor, strict=True))
    ]
    return _values([a.mid() for a in solved])


def _mean(values: list[arb]) -> arb:
    return (sum(values, arb(0)) / len(values)).mid()


def _det(a, b) -> arb:
    return (a[0] * b[1] - a[1] * b[0]).mid()


def _normal(point, tangent, centre) -> tuple[arb, arb]:
    """Return N = -(K - c)/det(K - c, L)."""
    away = [(a - b).mid() for a, b in zip(point, centre, strict=True)]
    size = _det(away, tangent)
    return (-away[0] / size).mid(), (-away[1] / size).mid()
