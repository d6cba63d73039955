"""Certificates of the jump set: one of its points with its two images, and the set's two ends."""

from fractions import Fraction

from flint import arb, ctx

from ..enclosure.flight import fly
from ..enclosure.surface import Surface, ball_of
from .certificate_text import decimal, header

_BITS = 160
_DIGITS = 30  # points are to be good to 1e-28


def propose(surface: Surface, speed: str, radius: str) -> str:
    """Return a certificate of the jump set.

    `speed` is xdot on the rim where the flight touches, `radius` the largest error of its points.
    """
    with ctx.workprec(_BITS):
        k, g, energy = surface.constants()
        fastest = ((2 * energy - g * g * (2 + k)) / (1 + k)).sqrt().mid()
        xdot = ball_of(Fraction(speed))
        x = (g - (g * g + k * (2 * energy - (1 + k) * xdot * xdot)).sqrt()) / k
        point, far_image = _next_impact(surface, x, xdot), _next_impact(surface, x, -xdot)
        inner_end = _next_impact(surface, -g, -fastest)
        points = {
            "point": (point[0], -point[1]),
            "near_image": (x, -(1 + k) * xdot),
            "far_image": far_image,
            "outer_end": (-g, -(1 + k) * fastest),
            "inner_end": (inner_end[0], -inner_end[1]),
        }
        lines = [
            f"{name} = [{', '.join(decimal(a, _DIGITS) for a in point)}]\n"
            for name, point in points.items()
        ]
    return header("jump set", surface) + f"radius = {radius}\nspeed = {speed}\n" + "".join(lines)


def propose_smooth(k: Fraction, g: Fraction) -> str:
    """Return the certificate that no flight touches the floor at low energies."""
    threshold = g * g * (1 + k / 2)
    return (
        f'kind = "no touch"\nk = "{k}"\ng = "{g}"\n'
        f'energy_below = "{threshold}"\nroots = ["{-g}", "{g + 2 * g / k}"]\n'
    )


def _next_impact(surface: Surface, x: arb, xdot: arb) -> tuple[arb, arb]:
    """Return (x, y) of the impact after a point of the rim, rounded."""
    k, g, _ = surface.constants()
    start = None
    if xdot < 0:
        start = (-3.9 * xdot / (x * x + xdot * xdot).sqrt()).mid()
    x, v, w, _ = fly(x, xdot, -xdot, arb(0), g, start)
    return x.mid(), (v - k * w).mid()
