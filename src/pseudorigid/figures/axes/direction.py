"""Directions of a sheet that shows a box. Nothing is imported that would slow the config's check.

Everything is in closed form. Matplotlib's 3-D axes multiply matrices, whose last bit depends on the
processor.
"""

from collections.abc import Sequence
from fractions import Fraction
from functools import cache

_PI = Fraction(31415926535897932384626433832795028841971693993751, 10**49)
# Bounds of a box's height over its width. With the text around it, a picture is then at most four
# times as high as wide, or as wide as high.
_FLATTEST, _HIGHEST = 0.1, 4
Direction = tuple[float, float, float]


def directions(elevation: float, azimuth: float) -> tuple[Direction, Direction, Direction]:
    """Return unit vectors to the right and up on the sheet, and to the eye, from degrees."""
    sin_a, cos_a = sincos_degrees(azimuth)
    sin_e, cos_e = sincos_degrees(elevation)
    up, eye = (-sin_e * cos_a, -sin_e * sin_a, cos_e), (cos_e * cos_a, cos_e * sin_a, sin_e)
    return (-sin_a, cos_a, 0.0), up, eye


def disproportion(
    limits: Sequence[list[float]], elevation: float, azimuth: float
) -> tuple[str, list[float], str] | None:
    """Return the longest axis, its limits and what is allowed, if a box is too high or too flat."""
    right, up, _ = directions(elevation, azimuth)
    sizes = [high - low for low, high in limits]
    wide, high = (sum(abs(a) * b for a, b in zip(step, sizes, strict=True)) for step in (right, up))
    if not (high > _HIGHEST * wide or high < _FLATTEST * wide):
        return None
    bounds = f"{_FLATTEST} to {_HIGHEST} times as high as wide, not {high / wide:.3g}"
    longest = sizes.index(max(sizes))
    axis = ("x", "xdot", "udot")[longest]
    return axis, limits[longest], f"limits that make the box in this view {bounds}"


@cache
def sincos_degrees(degrees: float) -> tuple[float, float]:
    """Return (sin, cos) of an angle in degrees, correctly rounded, from exact series."""
    angle = Fraction(degrees) % 360 * _PI / 180
    sine, cosine, term, order = Fraction(0), Fraction(0), Fraction(1), 0
    while order < 60:
        cosine, sine = cosine + term, sine + term * angle / (order + 1)
        term *= -angle * angle / ((order + 1) * (order + 2))
        order += 2
    return float(sine), float(cosine)
