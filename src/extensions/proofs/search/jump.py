"""Certificates of the jump set, of a saddle's branch that meets it, and of energies without one.

The outer branch at one saddle is mapped forwards until the next impact jumps between two of its
points. Bisection finds the point of the jump set there, and a chain of sets leads to it.
"""

from fractions import Fraction

import numpy as np
from flint import arb, ctx

from ..checkers import jump
from ..enclosure.surface import Surface, ball_of
from .certificate_text import Theorem, ball_header, header, row, rows
from .chains import DoubleMap, Parallelogram, chain
from .horseshoe import directions, mirrors
from .periodic import points_of, polished

_DIGITS = 30  # points are to be good to 1e-28
_SIZE, _LAST = 6.5e-5, 1e-3  # scales of the sets at the saddles and on the jump set
_BITS, _ROUNDS = 160, 8  # of Newton's method for the saddles
_CHAIN_DIGITS, _SADDLE_DIGITS = 12, 30
_BRANCH = np.linspace(0.4, 0.98, 4001)  # in p of the saddle's set: more than the map stretches it
_SAME, _APART = 1e-2, 5e-2  # distance of images: of neighbours, and of points with a jump between
_MOST_IMPACTS = 200
_MARGIN = 0.03  # of the coverings along the chain
_TOUCHES = 4001  # points of the jump set among which the nearest is sought
_REACH = 1.2  # of the jump set beyond the edges of the last set, in its half heights


def propose(theorem: Theorem, speed: str) -> str:
    """Return a certificate of the jump set; `speed` is xdot on the rim where the flight touches."""
    surface, radius = theorem.bounds["surface"], float(theorem.bounds["radius"])
    with ctx.workprec(jump.BITS):
        points = jump.stated_points(surface, ball_of(Fraction(speed)))
        lines = [
            f"{name.replace(' ', '_')} = {row(point, _DIGITS)}\n" for name, point in points.items()
        ]
    return header("jump set", surface) + f"radius = {radius:g}\nspeed = {speed}\n" + "".join(lines)


def propose_smooth(theorem: Theorem) -> str:
    """Return the certificate that no flight touches the floor below an energy."""
    k, g, energy = (theorem.bounds[name] for name in ("k", "g", "energy"))
    fields = f'energy_below = "{energy}"\nroots = ["{-g}", "{g + 2 * g / k}"]\n'
    return ball_header("no touch", k, g) + fields


def propose_no_circle(theorem: Theorem) -> str:
    """Return a certificate for the theorem's hyperbolic orbit.

    Raises ValueError if the branch does not meet the jump set, or no chain leads to it.
    """
    surface = theorem.bounds["surface"]
    double_map = DoubleMap(surface)
    with ctx.workprec(_BITS):
        saddles = polished(surface, points_of(theorem, "hyperbolic"), _ROUNDS)
        mirror = mirrors(saddles)
        _, expanding = directions(surface, saddles, 1)
        contracting = [[expanding[i][0], -expanding[i][1]] for i in mirror]
        sides = [[_SIZE * a for a in u + s] for u, s in zip(expanding, contracting, strict=True)]
        saddle_rows = [
            f"{row(z, _SADDLE_DIGITS)[:-1]}, {row(side, _CHAIN_DIGITS)[1:]}"
            for z, side in zip(saddles, sides, strict=True)
        ]
        source = Parallelogram(
            *(np.array(side, dtype=float) for side in (saddles[0], sides[0][:2], sides[0][2:]))
        )
    p, impacts, stretched = _crossing(double_map, source)
    point = _image(double_map, source, p, impacts)
    middle, half, tangent = _touch(surface, point)
    length = float(np.linalg.norm(stretched))
    target = Parallelogram(point, _LAST * stretched / length, tangent)
    strip = p - _LAST / length, p + _LAST / length
    found = chain(double_map, source, target, impacts, strip, _MARGIN)
    if found is None:
        raise ValueError("no chain of sets leads from the saddle to the jump set")
    chain_rows = [
        row((arb(value) for side in it for value in side), _CHAIN_DIGITS)
        for it in (*found.sets, target)
    ]
    return (
        header("jump crossing", surface)
        + "leaves = 0\n# a row: centre, expanding side, contracting side\n"
        + rows("saddles", saddle_rows)
        + "# the jump set crosses the last one\n"
        + rows("chain", chain_rows)
        + "# xdot of the touches at the two ends of the part of the jump set that crosses\n"
        + f"touches = [{middle - half:.6g}, {middle + half:.6g}]\n"
    )


def _crossing(double_map: DoubleMap, source: Parallelogram) -> tuple[float, int, np.ndarray]:
    """Return p on the branch, after how many impacts it is on S+, and the image's derivative."""
    images = source.points(_BRANCH, 0.0 * _BRANCH)
    for impacts in range(_MOST_IMPACTS + 1):
        following = double_map.step(images)
        near, far = (np.linalg.norm(np.diff(a, axis=1), axis=0) for a in (images, following))
        jumps = np.flatnonzero((near < _SAME) & (far > _APART))
        if jumps.size:
            i = int(jumps[0])
            low, high = float(_BRANCH[i]), float(_BRANCH[i + 1])
            slope = (images[:, i + 1] - images[:, i]) / (high - low)
            return _before_jump(double_map, source, low, high, impacts + 1), impacts, slope
        images = following
    raise ValueError("the branch is not seen to meet the jump set")


def _before_jump(
    double_map: DoubleMap, source: Parallelogram, low: float, high: float, impacts: int
) -> float:
    """Return the p before which the image moves little from that of `low`, by bisection."""
    start = _image(double_map, source, low, impacts)
    for _ in range(50):
        middle = (low + high) / 2.0
        same = np.linalg.norm(_image(double_map, source, middle, impacts) - start) < _SAME
        low, high = (middle, high) if same else (low, middle)
    return low


def _image(double_map: DoubleMap, source: Parallelogram, p: float, impacts: int) -> np.ndarray:
    """Return the image of a point of a set's expanding side."""
    return double_map.step(source.points(np.array([p]), np.zeros(1)), impacts)[:, 0]


def _touch(surface: Surface, point: np.ndarray) -> tuple[float, float, np.ndarray]:
    """Return xdot of the touch at a point of S+, a half width of it, and S+'s tangent there."""
    with ctx.workprec(_BITS):
        near = jump.curve(surface, _TOUCHES)[1:-1]
        curve = np.array([[float(a) for a in it] for it in near])
        fastest = float(jump.fastest_touch(surface))
    i = int(np.argmin(np.linalg.norm(curve - point, axis=1)))
    step = 2.0 * fastest / _TOUCHES  # in xdot
    slope = (curve[i + 1] - curve[i - 1]) / (2.0 * step)
    speed = fastest * (2.0 * (i + 1) - _TOUCHES) / _TOUCHES
    speed += slope @ (point - curve[i]) / (slope @ slope)
    length = np.linalg.norm(slope)
    return float(speed), float(_REACH * _LAST / length), _LAST * slope / length
