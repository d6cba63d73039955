"""Certificates of the jump set, and of the energies at which there is none."""

from fractions import Fraction

from flint import ctx

from study.enclosure.surface import ball_of

from ..checks.jump import BITS, stated_points
from .certificate_text import Theorem, ball_header, header, row

_DIGITS = 30  # points are to be good to 1e-28


def propose(theorem: Theorem, speed: str) -> str:
    """Return a certificate of the jump set; `speed` is xdot on the rim where the flight touches."""
    surface, radius = theorem.bounds["surface"], float(theorem.bounds["radius"])
    with ctx.workprec(BITS):
        points = stated_points(surface, ball_of(Fraction(speed)))
        lines = [
            f"{name.replace(' ', '_')} = {row(point, _DIGITS)}\n" for name, point in points.items()
        ]
    return header("jump set", surface) + f"radius = {radius:g}\nspeed = {speed}\n" + "".join(lines)


def propose_smooth(theorem: Theorem) -> str:
    """Return the certificate that no flight touches the floor below an energy."""
    k, g, energy = (theorem.bounds[name] for name in ("k", "g", "energy"))
    fields = f'energy_below = "{energy}"\nroots = ["{-g}", "{g + 2 * g / k}"]\n'
    return ball_header("no touch", k, g) + fields
