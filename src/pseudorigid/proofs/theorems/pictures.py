"""What the pictures of the proofs show: datasets of doubles, rounded from balls."""

from fractions import Fraction

import numpy as np
import xarray as xr
from flint import arb, ctx

from ...dynamics.variables import ENERGY, LENGTH, SPEED, described
from ..checks import birkhoff, horseshoe, periodic
from ..enclosure.surface import Surface, ball_of
from .statements import THEOREMS, G, K

EDGE = 33  # points along each edge of a set whose image is drawn
RADIUS = Fraction(1, 10**8)  # of the box in which the fixed point is proved, at every energy


def horseshoe_data(name="horseshoe-outer"):
    """The sets of a proved horseshoe, and one covering relation in the target's coordinates.

    Parameters
    ----------
    name : str
        Of the theorem.

    Returns
    -------
    xarray.Dataset
        x, y (set): centres; corner_x, corner_y (set, corner): around each; chain (set): the index
        along the chain, from -K to K, NaN at the saddles; image_p, image_q (edge, point): the image
        of the set before the middle one, in units of the middle one's half widths, its two exit
        edges first.

    Raises
    ------
    NotProvedError
        Where the theorem's certificate does not hold.
    """
    theorem = THEOREMS[name]
    found = theorem.prove(theorem.text()).parts
    sets = [*found["saddles"], *found["chain"]]
    steps = len(found["chain"]) // 2
    index = [np.nan] * len(found["saddles"]) + [float(n) for n in range(-steps, steps + 1)]
    surface = theorem.bounds["surface"]
    with ctx.workprec(horseshoe.BITS):
        around = [(1, 1), (1, -1), (-1, -1), (-1, 1)]
        corners = np.array(
            [[[float(a) for a in one.box(arb(p), arb(q))] for p, q in around] for one in sets]
        )
        source, target = found["chain"][steps - 1], found["chain"][steps]
        image = np.array(
            [[_image(surface, source, target, *point) for point in edge] for edge in _edges(EDGE)]
        )
        centres = np.array([[float(a) for a in one.centre] for one in sets])
    corner, edge = ("set", "corner"), ("edge", "point")
    across = "image of a set, across the next one's"
    data = {
        "x": ("set", centres[:, 0], "centre of the set, position at impact", LENGTH),
        "y": ("set", centres[:, 1], "centre of the set, y = xdot - k udot", SPEED),
        "chain": ("set", np.array(index), "index along the chain; NaN at the saddles"),
        "corner_x": (corner, corners[:, :, 0], "corners of the set, x", LENGTH),
        "corner_y": (corner, corners[:, :, 1], "corners of the set, y", SPEED),
        "image_p": (edge, image[:, :, 0], f"{across} expanding direction"),
        "image_q": (edge, image[:, :, 1], f"{across} contracting direction"),
    }
    return _dataset(data, surface)


def _edges(count):
    """The four edges of the unit square as lists of (p, q): p = -1, p = 1, q = -1, q = 1."""
    line = [arb(2 * i - (count - 1)) / (count - 1) for i in range(count)]
    sides = arb(-1), arb(1)
    return [*([(p, q) for q in line] for p in sides), *([(p, q) for p in line] for q in sides)]


def _image(surface, source, target, p, q):
    image = surface.impact(*source.box(p, q))
    return [float(a) for a in target.place(image.x, image.y)]


def twist_data(energies):
    """The fixed point's twists against the energy, and the proved energy where the first is zero.

    Parameters
    ----------
    energies : list of int, Fraction, Decimal or str
        Exact; the fixed point is elliptic there, and none of its powers up to the fourth is 1.

    Returns
    -------
    xarray.Dataset
        energy, twist (energy); zero (a number): the energy at which the twist vanishes.

    Raises
    ------
    NotProvedError
        Where the fixed point, its type or its twist is not proved.
    """
    from ..search import known

    surfaces = [Surface(K, G, energy) for energy in energies]
    values = []
    for surface in surfaces:
        centre = [tuple(map(Fraction, z)) for z in known.points(surface, 1, "elliptic")]
        with ctx.workprec(periodic.BITS):
            orbit = periodic.prove(surface, centre, RADIUS)
            values.append(float(birkhoff.normal_form(surface, orbit).twists[0]))
    theorem = THEOREMS["twist-zero"]
    zero = float(theorem.prove(theorem.text()).digits["energy"])
    with ctx.workprec(64):
        axis = np.array([float(ball_of(surface.energy)) for surface in surfaces])
    data = {
        "energy": ("energy", axis, "total energy", ENERGY),
        "twist": ("energy", np.array(values), "twist of the elliptic fixed point", "1/(omega R^2)"),
        "zero": ((), zero, "energy at which the twist vanishes", ENERGY),
    }
    return _dataset(data, surfaces[0])


def _dataset(variables, surface):
    return xr.Dataset(described(variables), attrs={"k": float(surface.k), "g": float(surface.g)})
