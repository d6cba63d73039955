"""Search for invariant curves around elliptic orbits: Newton's method on Fourier coefficients.

It starts from an orbit in doubles on the curve with the wanted rotation number. Everything here is
midpoints: `checkers.curve` proves the result. A curve is a pair of polynomials in the form of
`checkers.circle`, of which x is even and y is odd.
"""

import math
from collections.abc import Sequence
from contextlib import suppress
from functools import cache
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from flint import acb, arb, ctx
from scipy.optimize import brentq

from pseudorigid.dynamics.orbits import orbit
from pseudorigid.dynamics.variables import chart, states_of
from pseudorigid.verified.flight import NotProvedError

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
_MOST_TRIED = 20  # numbers of a scan on each side of the wanted one, to name the nearest curve
_CHAOS = 1e-4  # difference of the turns of an orbit's halves, during the scan
_SETTLED = 1e-9  # difference from the wanted rotation number on a curve, with all impacts
_NOISE = 1e-11  # Fourier coefficients from the orbit below this are rounding errors
_ROUGH = 130  # coefficients above the noise: with more, `search` would take minutes and fail
_SPARE_DIGITS = 4  # of a coefficient with weight 1, beyond the error
_STEPS = 6
# The last coefficients in the strip, as a part of the error, and how often modes are added to it.
_LARGEST_LAST, _MOST_ENLARGED = 0.25, 3
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


class _Scan(NamedTuple):
    """Orbits that start on y = 0 beyond a point of an elliptic orbit."""

    surface: Surface
    points: list[list[float]]  # of the elliptic orbit, the first one on y = 0
    regular: list[tuple[float, float]]  # x and rotation number of those that are not chaotic


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
    start = _start(_scan(theorem), quotients)
    text, _ = _certificate(theorem, start, Sizes(*strips), share, error)
    return text


def search(theorem: Theorem, rotation: float) -> tuple[str, Finding]:
    """Return a certificate for a curve, and the checker's finding, with sizes that are tried.

    The rotation number is close to the given one. Raises ValueError if no curve is found, and
    NotProvedError, with the checker's reason, if the last sizes fail. Both name the nearest numbers
    with which curves were found.
    """
    quotients, scan = quotients_near(rotation), _scan(theorem)
    start = _start(scan, quotients)
    xs, ys = start.xs, start.ys
    if len(xs) > _ROUGH:
        words = f"a curve was found, but it is too rough: it has more than {_ROUGH} Fourier modes"
        raise NotProvedError(f"{words}{_nearest(scan, _omega(quotients))}")
    decay = -math.log(_NOISE / abs(xs[1])) / len(xs)  # of the coefficients per mode
    area = math.pi * abs(sum(q * x * y for q, (x, y) in enumerate(zip(xs, ys, strict=True))))
    with ctx.workprec(64):  # rounding adds less than 1e-4
        share = f"{0.9999 * area / float(theorem.bounds['surface'].area()):.5g}"
    for trial in _TRIALS:
        sizes, error = _sizes(decay, *trial)
        for _ in range(_MOST_ENLARGED):  # few modes would be refused, after a long check
            text, last = _certificate(theorem, start, sizes, share, error)
            if last < _LARGEST_LAST * float(error):
                break
            sizes = sizes._replace(modes=sizes.modes * 3 // 2)
        try:
            return text, theorem.prove(text)
        except NotProvedError as refusal:
            reason = refusal
    near = _nearest(scan, _omega(quotients), len(xs) - 1)
    raise NotProvedError(f"a curve was found, but {reason}{near}")


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


def _scan(theorem: Theorem) -> _Scan:
    """Find the regular orbits on y = 0, around the orbit's point with y = 0 and the greatest x."""
    surface, points = theorem.bounds["surface"], points_of(theorem, "elliptic")
    symmetric = [i for i, point in enumerate(points) if abs(point[1]) < 1e-9]
    if not symmetric:
        raise ValueError("the orbit has no point on y = 0")
    first = max(symmetric, key=lambda i: points[i][0])
    points = points[first:] + points[:first]
    centre = points[0][0]
    with ctx.workprec(53):
        k, g, _ = surface.constants()
        rim = float(g / k + surface.radius())
    reach = rim - centre
    if len(points) > 1:  # half way to the nearest of the other points
        others = np.asarray(points[1:], dtype=float)
        reach = 0.5 * float(np.abs(others - points[0]).max(axis=1).min())
    places = [centre + reach * i / _SCAN for i in range(1, _SCAN)]
    numbers = [turns(surface, x, points, _SCAN_IMPACTS, _CHAOS) for x in places]
    pairs = zip(places, numbers, strict=True)
    return _Scan(surface, points, [(x, number) for x, number in pairs if math.isfinite(number)])


def _start(scan: _Scan, quotients: Sequence[int]) -> _Start:
    """Find a curve in doubles; raises ValueError, with the nearest found, if there is none."""
    if start := _curve_in_doubles(scan, quotients):
        return start
    omega = _omega(quotients)
    words = f"no curve with the rotation number {omega:.6g} was found on y = 0"
    raise ValueError(f"{words}{_nearest(scan, omega)}")


def _nearest(scan: _Scan, omega: float, most: int = _ROUGH) -> str:
    """Name the nearest numbers with curves that are found, and have at most `most` modes."""
    known: dict[tuple[int, ...], bool] = {}

    def is_found(number: float) -> bool:
        try:
            quotients = quotients_near(number)
        except ValueError:
            return False
        if (key := tuple(quotients)) not in known:
            start = _curve_in_doubles(scan, quotients, most + 4)
            known[key] = start is not None and len(start.xs) <= most
        return known[key]

    numbers = sorted({round(n, 4) for _, n in scan.regular}, key=lambda n: abs(n - omega))
    sides = [n for n in numbers if n < omega], [n for n in numbers if n > omega]
    near = [next(filter(is_found, side[:_MOST_TRIED]), None) for side in sides]
    words = " and ".join(f"{n:g}" for n in near if n)
    return f"; nearest smooth curves found: {words}" * bool(words)


def _omega(quotients: Sequence[int]) -> float:
    """Return the double nearest to a rotation number."""
    with ctx.workprec(BITS):
        return float(noble(quotients)[0])


def _curve_in_doubles(scan: _Scan, quotients: Sequence[int], most: int = 400) -> _Start | None:
    """Find the curve of a rotation number that is nearest to the point; None if there is none.

    It has at most so many coefficients.
    """
    surface, points, regular = scan
    omega = _omega(quotients)

    def excess(x: float) -> float:
        return turns(surface, x, points, _IMPACTS) - omega

    for (x, number), (x_after, number_after) in pairwise(regular):
        if min(number, number_after) < omega < max(number, number_after):
            with suppress(ValueError):  # longer orbits may have numbers on the same side of omega
                root = brentq(excess, x, x_after, xtol=1e-17, maxiter=25, disp=False)
                if abs(excess(root)) < _SETTLED:
                    waves = _coefficients_of_orbit(surface, root, len(points), omega, most)
                    return _Start(points, quotients, *waves)
    return None


def turns(
    surface: Surface, x: float, points: Sequence, impacts: int, tolerance: float = math.inf
) -> float:
    """Return the clockwise turns of P^n around the first point, per n impacts, modulo 1.

    NaN if the two halves of the orbit differ by more than the tolerance, as they do in chaos.
    """
    z = _orbit(surface, x, len(points), impacts)
    angles = np.angle(z[0] - points[0][0] + 1j * (z[1] - points[0][1])) / (2.0 * math.pi)
    steps = np.mod(-np.diff(angles), 1.0)
    first, second = (_weights(half.size) @ half for half in np.array_split(steps, 2))
    settled = abs(first - second) <= tolerance
    return float(_weights(steps.size) @ steps) if settled else math.nan


@cache
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
    surface: Surface, x: float, period: int, omega: float, most: int
) -> tuple[list[float], list[float]]:
    """Return x_q and y_q of the curve through (x, 0), from averages along its orbit."""
    z = _orbit(surface, x, period, _IMPACTS)
    phases = np.mod(omega * np.arange(1, z.shape[1] + 1), 1.0)
    x_terms, y_terms = 2.0 * _weights(z.shape[1]) * z
    xs, ys = [float(0.5 * x_terms.sum())], [0.0]
    turn = np.exp(2j * math.pi * phases)
    wave = np.ones_like(turn)
    for q in range(1, most):
        wave *= turn
        xs.append(float(x_terms @ wave.real))
        ys.append(float(y_terms @ wave.imag))
        if q > 4 and max(abs(a) for a in (*xs[-3:], *ys[-3:])) < _NOISE:
            break
    return xs[:-3], ys[:-3]


def _certificate(
    theorem: Theorem, start: _Start, sizes: Sizes, share: str, error: str
) -> tuple[str, float]:
    """Return a certificate of the curve that Newton's method finds from a start.

    The second result is the size of its last coefficients in the strip.
    """
    surface, radius = theorem.bounds["surface"], f"{float(theorem.bounds['radius']):g}"
    with ctx.workprec(CENTRE_BITS):
        centres = polished(surface, start.points)
    with ctx.workprec(BITS):
        curve = _curve(surface, centres, start, sizes.modes)
        coefficients = _formatted(curve, sizes.strip, error)
        last = max(abs(float(abs(c))) for waves in curve for c in waves[-5:])
    text = (
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
    return text, 2 * last * math.exp(2 * math.pi * float(sizes.strip) * sizes.modes)


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
