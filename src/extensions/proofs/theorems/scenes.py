"""Stages behind the pictures of the proofs; their data are doubles, rounded from balls."""

from collections.abc import Callable, Sequence
from fractions import Fraction
from itertools import pairwise
from typing import Any

import numpy as np
import xarray as xr
from flint import arb, ctx

from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.variables import AREA, ENERGY, LENGTH, SPEED, described, of_type
from pseudorigid.verified.flight import NotProvedError

from ..checkers import curve, graph, horseshoe, jump
from ..checkers.certificate import Finding
from ..checkers.hsets import HSet
from ..checkers.periodic import BITS, Point, prove
from ..checkers.twist import falling_twist, normal_form
from ..enclosure.surface import Surface, ball_of
from ..search.periodic import approximate_points
from ..search.twist import bisect_zero
from .requests import prove_curve, prove_horseshoe
from .statements import THEOREMS, Theorem

_CORNERS = (1, 1), (1, -1), (-1, -1), (-1, 1)  # p and q, around a set
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
    surface = _surface_of(ball, energy)
    theorem = THEOREMS[f"horseshoe-{connection}"]
    if (surface, period) == (theorem.bounds["surface"], theorem.bounds["period"]):
        finding = theorem.prove()
    else:
        _, finding = prove_horseshoe(surface, orbit, side=connection)
    saddles, chain = finding.parts["saddles"], finding.parts["chain"]
    sets, steps = [*saddles, *chain], len(chain) // 2
    index = [np.nan] * len(saddles) + [float(n) for n in range(-steps, steps + 1)]
    with ctx.workprec(horseshoe.BITS):
        corner_x, corner_y = _corners(sets)
        image = _doubles(_image_of_edges(surface, *chain[steps - 1 : steps + 1]))
        x, y = _doubles([hset.centre for hset in sets]).T
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
    return _dataset(table, surface)


def _image_of_edges(surface: Surface, source: HSet, target: HSet) -> list[list[Point]]:
    """Return images, in the target's coordinates, of points of the edges p = -1, 1, q = -1, 1."""
    last = _EDGE_POINTS - 1
    line, sides = [arb(2 * i - last) / last for i in range(_EDGE_POINTS)], (arb(-1), arb(1))
    edges = [*([(p, q) for q in line] for p in sides), *([(p, q) for p in line] for q in sides)]

    def image(p: arb, q: arb) -> Point:
        x, y, *_ = surface.impact(*source.box(p, q))
        return target.coordinates(x, y)

    return [[image(*point) for point in edge] for edge in edges]


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
    surfaces = [_surface_of(ball, energy) for energy in energies]
    twists, points = [], []
    for surface in surfaces:
        try:
            points.append(approximate_points(surface, 1, "elliptic"))
            centre = [tuple(map(Fraction, z)) for z in points[-1]]
            with ctx.workprec(BITS):
                orbit = prove(surface, centre, _RADIUS)
                twists.append(float(normal_form(surface, orbit).twists[0]))
        except (NotProvedError, ValueError, ArithmeticError) as error:
            raise ValueError(f"no twist is proved at {surface}: leave it out: {error}") from None
    zeros = (
        _zero(surfaces[i], surfaces[i + 1], points[i])
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
    return _dataset(table, surfaces[0])


def _zero(low: Surface, high: Surface, point: list[list[float]]) -> float | None:
    """Return the energy between two surfaces at which the twist is proved to be zero, or None."""
    with ctx.workprec(BITS):
        try:
            band, middle = bisect_zero(low.k, low.g, low.energy, high.energy, point)
            centre = [tuple(Fraction(float(a)) for a in z) for z in middle]
            falling_twist(band, centre, _RADIUS, order=3)
        except (NotProvedError, ArithmeticError):
            return None
        return float(band.constants()[2])


def scene_curves(ball: Ball, energy: float, rotation_numbers: list[float]) -> xr.Dataset:
    """Prove invariant curves around the fixed point, and tabulate polygons inside them.

    A curve around the fixed point that is a theorem at this ball and energy is proved from its
    certificate, if its rotation number is stated to be close to one of the list; others are
    searched. Theorems about curves around longer orbits at this ball and energy are added, and the
    points that no invariant circle has inside, by the theorem `no-circle`. The rotation numbers are
    clockwise turns per impact, between 0 and 1. ValueError is raised for a curve that cannot be
    proved.

    >>> scene_curves(Ball(k=0.2, g=0.04), 0.01, [0.16885]).sizes["curve"]  # doctest: +SKIP
    2
    """
    surface = _surface_of(ball, energy)
    here = theorems_at(surface, curve.check)
    findings = [_near(surface, value, here) for value in rotation_numbers]
    findings += [it.prove() for it in here if it.bounds["period"] > 1]
    corners = [
        (x, y, place)
        for place, finding in enumerate(findings)
        for polygon in finding.parts["polygons"]
        for x, y in [*polygon, polygon[0], (np.nan, np.nan)]
    ]
    x, y, place = np.array(corners).T
    saddles = [
        (float(x), float(y))
        for theorem in theorems_at(surface, jump.check_no_circle)
        for x, y in theorem.prove().parts["orbit"].points
    ]
    saddle_x, saddle_y = np.reshape(np.array(saddles), (-1, 2)).T
    rotation, share, area = (
        [float(finding.digits[name]) for finding in findings]
        for name in ("rotation number", "share", "area")
    )
    table = {
        "x": ("corner", x, "corners of the polygons, x; NaN after each", LENGTH),
        "y": ("corner", y, "corners of the polygons, y; NaN after each", SPEED),
        "place": ("corner", place.astype(np.int64), "place of the corner's curve"),
        "saddle_x": ("saddle", saddle_x, "x of a point inside no invariant circle", LENGTH),
        "saddle_y": ("saddle", saddle_y, "y of a point inside no invariant circle", SPEED),
        "rotation": ("curve", rotation, "clockwise turns per period"),
        "share": ("curve", share, "area inside one curve, as a share of the section"),
        "area": ("curve", area, "area inside one curve", AREA),
        "period": ("curve", [len(it.parts["polygons"]) for it in findings], "period of the orbit"),
        "radius": ((), float(surface.radius()), "half of the section's width on y = 0", LENGTH),
    }
    return _dataset(table, surface)


def _near(surface: Surface, value: float, theorems: list[Theorem]) -> Finding:
    """Prove a curve with about this rotation number, from one of the theorems' if possible."""
    for theorem in theorems:
        low, high = theorem.bounds["rotation"]
        if theorem.bounds["period"] == 1 and low <= value <= high:
            return theorem.prove()
    return prove_curve(surface, surface.energy, value)[1]


def scene_graph(ball: Ball, energy: float) -> xr.Dataset:
    """Prove the graph of coverings that is a theorem at this k and E/g^2, and tabulate its sets.

    The sets that connections join come first, then those of the connections' chains. Lengths are
    multiplied by the ratio of this ball's g to the theorem's. ValueError is raised if no theorem
    states a graph at this k and E/g^2.

    >>> from pseudorigid import Ball
    >>> scene_graph(Ball(k=0.2, g=0.04), 0.005).sizes["connection"]
    4
    """
    surface = _surface_of(ball, energy)
    stated = {
        (it.k, it.energy / it.g**2): theorem
        for theorem in THEOREMS.values()
        if theorem.checker is graph.check and (it := theorem.bounds["surface"])
    }
    theorem = stated.get((surface.k, surface.energy / surface.g**2))
    if theorem is None:
        known = " and ".join(f"k = {k}, E/g^2 = {ratio}" for k, ratio in stated)
        raise ValueError(f"no graph is a theorem at {surface}: there are those at {known}")
    proved, scale = theorem.prove(), float(surface.g / theorem.bounds["surface"].g)
    sets, connections = proved.parts["graph"].sets, proved.parts["graph"].connections
    chains = [(n, hset) for n, it in enumerate(connections) for hset in it.chain]
    owner = [-1] * len(sets) + [n for n, _ in chains]
    with ctx.workprec(graph.BITS):
        corner_x, corner_y = _corners([*sets, *(hset for _, hset in chains)])
        entropy = float(proved.digits["entropy"].lower())
        radius = float(surface.radius())
    source, target, impacts = np.array([(it.source, it.target, it.impacts) for it in connections]).T
    corner = ("set", "corner")
    table = {
        "corner_x": (corner, scale * corner_x, "corners of the set, x", LENGTH),
        "corner_y": (corner, scale * corner_y, "corners of the set, y = xdot - k udot", SPEED),
        "connection": ("set", np.array(owner), "connection of the set's chain; -1 at the ends"),
        "source": ("connection", source, "set that the connection leaves"),
        "target": ("connection", target, "set to which the connection leads"),
        "impacts": ("connection", impacts, "number of impacts of the connection"),
        "entropy": ((), entropy, "proved lower bound of the entropy, in nats per impact"),
        "radius": ((), radius, "half of the section's width on y = 0", LENGTH),
    }
    return _dataset(table, surface)


def _surface_of(ball: Ball, energy: float) -> Surface:
    """Return the Surface whose k, g and energy are the decimals that the numbers print as."""
    k, g, exact_energy = (Fraction(str(value)) for value in (ball.k, ball.g, energy))
    return Surface(k, g, exact_energy)


def theorems_at(surface: Surface, checker: Callable[..., Finding]) -> list[Theorem]:
    """Return the theorems on a surface that a checker proves."""
    return [
        theorem
        for theorem in THEOREMS.values()
        if theorem.checker is checker and theorem.bounds["surface"] == surface
    ]


def _doubles(balls: Sequence[Any]) -> np.ndarray:
    """Round nested lists of balls to an array of doubles."""
    return np.array(balls, dtype=object).astype(float)


def _corners(sets: list[HSet]) -> tuple[np.ndarray, np.ndarray]:
    """Return x and y of the corners around each set, (set, corner)."""
    x, y = _doubles([[hset.box(arb(p), arb(q)) for p, q in _CORNERS] for hset in sets]).T
    return x.T, y.T


def _dataset(table: dict[str, Any], surface: Surface) -> xr.Dataset:
    """Return the dataset of a table, as for `described`, with k and g as attributes."""
    return xr.Dataset(described(table), attrs={"k": float(surface.k), "g": float(surface.g)})
