"""Certificates of the jump set: a point of it, its two images and the set's two ends."""

from fractions import Fraction

from flint import arb, ctx

from ..enclosure.flight import first_root
from ..enclosure.surface import ball_of
from .certificate_text import decimal, header

BITS = 160
DIGITS = 30  # points are to be good to 1e-28


def propose(surface, speed, radius):
    """A certificate of the jump set.

    Parameters
    ----------
    surface : Surface
    speed : str
        xdot on the rim where the flight touches.
    radius : str
        By how much its points may be off.

    Returns
    -------
    str
    """
    with ctx.workprec(BITS):
        k, g, energy = surface.constants()
        fastest = ((2 * energy - g * g * (2 + k)) / (1 + k)).sqrt().mid()
        xdot = ball_of(Fraction(speed))
        x = (g - (g * g + k * (2 * energy - (1 + k) * xdot * xdot)).sqrt()) / k
        before, beyond = _flight(surface, x, xdot), _flight(surface, x, -xdot)
        first = _flight(surface, -g, -fastest)
        places = {
            "point": (before[0], -before[1]),
            "near_image": (x, -(1 + k) * xdot),
            "far_image": beyond,
            "outer_end": (-g, -(1 + k) * fastest),
            "inner_end": (first[0], -first[1]),
        }
        lines = [
            f"{name} = [{', '.join(decimal(a, DIGITS) for a in place)}]\n"
            for name, place in places.items()
        ]
    return header("jump set", surface) + f"radius = {radius}\nspeed = {speed}\n" + "".join(lines)


def propose_smooth(k, g):
    """The certificate that no flight touches the floor at low energies.

    Parameters
    ----------
    k, g : Fraction
        The ball.

    Returns
    -------
    str
    """
    threshold = g * g * (1 + k / 2)
    return (
        f'kind = "no touch"\nk = "{k}"\ng = "{g}"\n'
        f'energy_below = "{threshold}"\nroots = ["{-g}", "{g + 2 * g / k}"]\n'
    )


def _flight(surface, x, xdot):
    """(x, y) of the impact after a rim point's, midpoints."""
    k, g, _ = surface.constants()
    after = None
    if xdot < 0:
        after = (-3.9 * xdot / (x * x + xdot * xdot).sqrt()).mid()
    tau = first_root(x, -xdot, arb(0), g, after)
    sine, cosine = tau.sin_cos()
    udot = x * sine - xdot * cosine
    return (x * cosine + xdot * sine).mid(), (xdot + g * tau - k * udot).mid()
