"""Stages behind the pictures of the proofs; their data are doubles, rounded from balls."""

from fractions import Fraction
from itertools import pairwise

import numpy as np
import xarray as xr
from flint import arb, ctx

from ...dynamics.ball import Ball
from ...dynamics.variables import ENERGY, LENGTH, SPEED, of_type
from ..checks import horseshoe
from ..checks.birkhoff import normal_form
from ..checks.certificate import NotProvedError
from ..checks.hsets import HSet
from ..checks.periodic import BITS, prove
from ..checks.twist import falling_twist
from ..enclosure.surface import Surface, ball_of
from ..search import approximate_orbits
from ..search.twist import bisect_zero
from .requests import prove_horseshoe
from .statements import THEOREMS
from .tables import corners, dataset, doubles, surface_of

_EDGE_POINTS = 33  # along each edge of a set whose image is drawn
_RADIUS = Fraction(1, 10**8)  # of the box in which the fixed point is proved, at every energy


def scene_horseshoe(
    ball: Ball, energy: float, periodic: xr.Dataset, period: int, type: str, connection: str
) -> xr.Dataset:
    """Prove a horseshoe on an orbit, by one of its connections, and tabulate its sets.

    The certificate is that of the theorem about this connection, "outer" or "inner", if there is
    one; otherwise it is searched. The variable chain is the index along the chain, from -K to K,
    NaN at the saddles. The image is that of the set before the middle one, in units of the middle
    one's half widths, its two exit edges first. ValueError is raised if there is no such orbit, or
    `prove_horseshoe` cannot prove the horseshoe.

    >>> from pseudorigid import Ball, symmetric_orbits
    >>> ball = Ball(k=0.3, g=0.02)
    >>> five = symmetric_orbits(ball, 0.002, 5)
    >>> scene_horseshoe(ball, 0.002, five, 5, "hyperbolic", "outer").sizes["edge"]
    4
    """
    orbit = of_type(periodic, type, period)
    surface = surface_of(ball, energy)
    theorem = THEOREMS[f"horseshoe-{connection}"]
    if (surface, period) == (theorem.bounds["surface"], theorem.bounds["period"]):
        finding = theorem.prove(theorem.text())
    else:
        _, finding = prove_horseshoe(surface, orbit, side=connection)
    saddles, chain = finding.parts["saddles"], finding.parts["chain"]
    sets, steps = [*saddles, *chain], len(chain) // 2
    index = [np.nan] * len(saddles) + [float(n) for n in range(-steps, steps + 1)]
    with ctx.workprec(horseshoe.BITS):
        corner_x, corner_y = corners(sets)
        image = doubles(_image_of_edges(surface, *chain[steps - 1 : steps + 1]))
        x, y = doubles([hset.centre for hset in sets]).T
    corner, edge = ("set", "corner"), ("edge", "point")
    across = "image of a set, across the next one's"
    table = {
        "x": ("set", x, "centre of the set, position at impact", LENGTH),
        "y": ("set", y, "centre of the set, y = xdot - k udot", SPEED),
        "chain": ("set", np.array(index), "index along the chain; NaN at the saddles"),
        "corner_x": (corner, corner_x, "corners of the set, x", LENGTH),
        "corner_y": (corner, corner_y, "corners of the set, y", SPEED),
        "image_p": (edge, image[:, :, 0], f"{across} expanding direction"),
        "image_q": (edge, image[:, :, 1], f"{across} contracting direction"),
    }
    return dataset(table, surface)


def _image_of_edges(surface: Surface, source: HSet, target: HSet) -> list:
    """Return images, in the target's coordinates, of points of the edges p = -1, 1, q = -1, 1."""
    last = _EDGE_POINTS - 1
    line, sides = [arb(2 * i - last) / last for i in range(_EDGE_POINTS)], (arb(-1), arb(1))
    edges = [*([(p, q) for q in line] for p in sides), *([(p, q) for p in line] for q in sides)]
    return [
        [target.coordinates(*surface.impact(*source.box(*point))[:2]) for point in edge]
        for edge in edges
    ]


def scene_twist(ball: Ball, energy: float, energies: list[float]) -> xr.Dataset:
    """Prove and tabulate twists of the elliptic fixed point at some energies.

    The argument `energy` is not used. The `energies` rise, the fixed point must be elliptic there,
    and no power of its multiplier up to the fourth be 1; else ValueError is raised. `zero` is the
    middle of a band of width 1e-13 in which the twist is proved to fall through zero, NaN without
    one between two of the energies.

    >>> from pseudorigid import Ball
    >>> twist = scene_twist(Ball(k=0.3, g=0.02), 0.002, [0.001, 0.002])["twist"].values
    >>> bool(twist[0] > twist[1] > 0)
    True
    """
    surfaces = [surface_of(ball, energy) for energy in energies]
    twists, points = [], []
    for surface in surfaces:
        try:
            points.append(approximate_orbits.points(surface, 1, "elliptic"))
            centre = [tuple(map(Fraction, z)) for z in points[-1]]
            with ctx.workprec(BITS):
                orbit = prove(surface, centre, _RADIUS)
                twists.append(float(normal_form(surface, orbit).twists[0]))
        except (NotProvedError, ValueError, ArithmeticError) as error:
            raise ValueError(f"no twist is proved at {surface}: {error}") from None
    zeros = (
        _zero(*surfaces[i : i + 2], points[i])
        for i, (low, high) in enumerate(pairwise(twists))
        if low > 0.0 >= high
    )
    with ctx.workprec(64):
        axis = np.array([float(ball_of(surface.energy)) for surface in surfaces])
    zero = next((zero for zero in zeros if zero is not None), float("nan"))
    table = {
        "energy": ("energy", axis, "total energy", ENERGY),
        "twist": ("energy", np.array(twists), "twist of the elliptic fixed point", "1/(omega R^2)"),
        "zero": ((), zero, "energy at which the twist vanishes", ENERGY),
    }
    return dataset(table, surfaces[0])


def _zero(low: Surface, high: Surface, point: list[list[float]]) -> float | None:
    """Return the energy between two surfaces at which the twist is proved to be zero, or None."""
    with ctx.workprec(BITS):
        try:
            band, point = bisect_zero(low.k, low.g, low.energy, high.energy, point)
            centre = [tuple(Fraction(float(a)) for a in z) for z in point]
            falling_twist(band, centre, _RADIUS, order=3)
        except (NotProvedError, ArithmeticError):
            return None
        return float(band.constants()[2])
