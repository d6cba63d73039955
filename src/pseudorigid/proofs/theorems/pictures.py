"""Datasets behind the pictures of the proofs: doubles, rounded from balls."""

from fractions import Fraction
from itertools import pairwise

import numpy as np
import xarray as xr
from flint import arb, ctx

from ...dynamics.variables import ENERGY, LENGTH, SPEED, described
from ..checks import birkhoff, horseshoe, periodic
from ..checks.certificate import Finding, NotProvedError
from ..checks.hsets import HSet
from ..enclosure.surface import Exact, Surface, ball_of

_EDGE_POINTS = 33  # along each edge of a set whose image is drawn
_RADIUS = Fraction(1, 10**8)  # of the box in which the fixed point is proved, at every energy


def horseshoe_data(surface: Surface, finding: Finding) -> xr.Dataset:
    """Tabulate the sets of a proved horseshoe, and one covering in the target's coordinates.

    Returns a Dataset with x, y (set): centres; corner_x, corner_y (set, corner): around each;
    chain (set): the index along the chain, from -K to K, NaN at the saddles; image_p, image_q
    (edge, point): the image of the set before the middle one, in units of the middle one's half
    widths, its two exit edges first.
    """
    saddles, chain = finding.parts["saddles"], finding.parts["chain"]
    sets, steps = [*saddles, *chain], len(chain) // 2
    index = [np.nan] * len(saddles) + [float(n) for n in range(-steps, steps + 1)]
    with ctx.workprec(horseshoe.BITS):
        signs = [(1, 1), (1, -1), (-1, -1), (-1, 1)]
        corners = np.array(
            [[[float(a) for a in hset.box(arb(p), arb(q))] for p, q in signs] for hset in sets]
        )
        image = np.array(
            [[_image(surface, *chain[steps - 1 : steps + 1], *point) for point in edge]
             for edge in _edges(_EDGE_POINTS)]
        )  # fmt: skip
        centres = np.array([[float(a) for a in hset.centre] for hset in sets])
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


def _edges(count: int) -> list[list[tuple[arb, arb]]]:
    """Return points (p, q) of the edges p = -1, p = 1, q = -1, q = 1 of the square."""
    line = [arb(2 * i - (count - 1)) / (count - 1) for i in range(count)]
    sides = arb(-1), arb(1)
    return [*([(p, q) for q in line] for p in sides), *([(p, q) for p in line] for q in sides)]


def _image(surface: Surface, source: HSet, target: HSet, p: arb, q: arb) -> list[float]:
    image = surface.impact(*source.box(p, q))
    return [float(a) for a in target.coordinates(image.x, image.y)]


def twist_data(k: Exact, g: Exact, energies: list[Exact]) -> xr.Dataset:
    """Tabulate the fixed point's twist against the energy, and where it falls through zero.

    The energies are in rising order. The fixed point must be elliptic there, and no power of its
    multiplier up to the fourth be 1. Returns a Dataset with energy, twist (energy) and zero, the
    middle of a band of width 1e-13 in which the twist is proved to fall through zero, NaN without
    one between two of the energies. Raises ValueError where a twist is not proved.
    """
    from ..search import approximate_orbits

    surfaces = [Surface(k, g, energy) for energy in energies]
    twists, centres = [], []
    for surface in surfaces:
        try:
            centres.append(approximate_orbits.points(surface, 1, "elliptic"))
            centre = [tuple(map(Fraction, z)) for z in centres[-1]]
            with ctx.workprec(periodic.BITS):
                orbit = periodic.prove(surface, centre, _RADIUS)
                twists.append(float(birkhoff.normal_form(surface, orbit).twists[0]))
        except (NotProvedError, ValueError, ArithmeticError) as error:
            raise ValueError(f"no twist is proved at {surface}: {error}") from None
    zeros = (
        _zero(*surfaces[i : i + 2], centres[i])
        for i, (low, high) in enumerate(pairwise(twists))
        if low > 0.0 >= high
    )
    zero = next((zero for zero in zeros if zero is not None), float("nan"))
    with ctx.workprec(64):
        axis = np.array([float(ball_of(surface.energy)) for surface in surfaces])
    data = {
        "energy": ("energy", axis, "total energy", ENERGY),
        "twist": ("energy", np.array(twists), "twist of the elliptic fixed point", "1/(omega R^2)"),
        "zero": ((), zero, "energy at which the twist vanishes", ENERGY),
    }
    return _dataset(data, surfaces[0])


def _zero(low: Surface, high: Surface, centre: list[tuple[float, float]]) -> float | None:
    """Return the energy between two surfaces at which the twist is proved to be zero, or None."""
    from ..search import twist as twist_search

    with ctx.workprec(periodic.BITS):
        low, high, point = twist_search.bisect_zero(low.k, low.g, low.energy, high.energy, centre)
        band = Surface(low.k, low.g, low.energy, high.energy - low.energy)
        box = [tuple(Fraction(float(a)) for a in z) for z in point]
        twists = []
        for surface in (low, high, band):  # over the band, the twist is continuous
            try:
                orbit = periodic.prove(surface, box, _RADIUS)
                twists.append(birkhoff.normal_form(surface, orbit).twists[0])
            except (NotProvedError, ArithmeticError):
                return None
        return float(band.constants()[2]) if twists[0] > 0 > twists[1] else None


def _dataset(variables: dict, surface: Surface) -> xr.Dataset:
    return xr.Dataset(described(variables), attrs={"k": float(surface.k), "g": float(surface.g)})
