"""Proofs of a user's symmetric orbits, of horseshoes on them, and of invariant curves."""

import math
from collections.abc import Iterator
from contextlib import contextmanager
from fractions import Fraction

import numpy as np
import xarray as xr

from pseudorigid.dynamics.ball import Ball, require_ball
from pseudorigid.dynamics.inputs import not_allowed, number, one_of
from pseudorigid.dynamics.variables import chart, states_of
from pseudorigid.verified.flight import NotProvedError

from ..checkers import curve, horseshoe, periodic
from ..checkers.certificate import Finding
from ..enclosure.surface import Exact, Surface, exact
from ..search import curve as curve_search
from ..search import horseshoe as horseshoe_search
from ..search import periodic as orbit_search
from .statements import Theorem


def prove_orbit(
    ball: Ball | Surface, orbit: xr.Dataset, energy: Exact | None = None
) -> periodic.Orbit:
    """Prove that a periodic orbit exists, is alone in a box, and has its type.

    Parameters
    ----------
    ball : Ball or Surface
        The doubles k and g of a Ball are taken as exact; a Surface has exact numbers.
    orbit : xarray.Dataset
        One orbit of `symmetric_orbits`: x, xdot, udot on `point`, type.
    energy : int, Fraction, Decimal or str, optional
        Exact energy of a Ball's orbit; by default the double in the orbit's attributes.

    Returns
    -------
    checkers.periodic.Orbit
        Enclosures `points` (x, y), `impacts` and `trace`; `type`; and `radius`, the largest number
        of one digit for which the orbit is proved to be the only one in boxes of that size.

    Raises
    ------
    ValueError
        One line that says what cannot be proved and why.

    Examples
    --------
    >>> from pseudorigid import symmetric_orbits
    >>> from pseudorigid.dynamics.ball import Ball
    >>> orbit = symmetric_orbits(Ball(k=0.2, g=0.04), 0.01, 1).isel(orbit=0)
    >>> prove_orbit(Surface("1/5", "1/25", "1/100"), orbit).type
    'elliptic'
    """
    surface, points, kind = _request(ball, orbit, energy)
    name = f"the {kind} orbit of period {len(points)} at {surface}"
    bounds = {"surface": surface, "period": len(points), "type": kind, "radius": Fraction(0)}
    theorem = Theorem(name, name, periodic.check, bounds)
    with _errors_naming(name):
        return theorem.prove(orbit_search.propose(theorem, points)).parts["orbit"]


def prove_horseshoe(
    ball: Ball | Surface, orbit: xr.Dataset, *, side: str, energy: Exact | None = None
) -> tuple[str, Finding]:
    """Prove a horseshoe on a hyperbolic orbit by its outer or inner symmetric connection.

    Parameters
    ----------
    ball, orbit
        As for `prove_orbit`.
    side : {"outer", "inner"}
        Unstable branch of the connection at the orbit's first point: "outer" leads away from the
        mean of the orbit's points.
    energy : int, Fraction, Decimal or str, optional
        As for `prove_orbit`.

    Returns
    -------
    str, checkers.certificate.Finding
        The certificate, and the result of its checker: digits, margins, parts.

    Raises
    ------
    ValueError
        One line that says what cannot be proved and why.

    References
    ----------
    Zgliczynski and Gidea, Covering relations for multidimensional dynamical systems, J.
    Differential Equations 202 (2004). Kokubu, Wilczak and Zgliczynski, Rigorous verification of
    cocoon bifurcations in the Michelson system, Nonlinearity 20 (2007).
    """
    one_of("side", side, ("outer", "inner"))
    surface, points, kind = _request(ball, orbit, energy)
    if kind != "hyperbolic":
        raise ValueError(f"no horseshoe can be proved on the orbit: it is {kind}, not hyperbolic")
    radius = prove_orbit(ball, orbit, energy).radius
    bounds = {"surface": surface, "period": len(points), "radius": radius, "entropy": Fraction(0)}
    name = f"the horseshoe at {surface}"
    theorem = Theorem(name, name, horseshoe.check, bounds)
    with _errors_naming(name):
        text = horseshoe_search.propose(theorem, side, points=points)
        return text, theorem.prove(text)


def prove_curve(
    ball: Ball | Surface, energy: Exact | float, rotation_number: float
) -> tuple[str, Finding]:
    """Prove an invariant curve around the elliptic fixed point, which no orbit ever crosses.

    Parameters
    ----------
    ball : Ball or Surface
        The doubles k and g of a Ball are taken as exact; of a Surface only its exact k and g count.
    energy : int, Fraction, Decimal, str or float
        Total energy. It is exact, also the double that a float is.
    rotation_number : float
        Clockwise turns per impact, between 0 and 1. The curve's own rotation number is a noble one
        within 5e-4: its partial quotients are the first few of this number's, followed by 1 for
        ever. A number too close to a fraction of small integers is refused.

    Returns
    -------
    str, checkers.certificate.Finding
        The certificate, and the result of its checker. `digits` has enclosures of the curve's
        "rotation number", of the "area" inside it and of its "share" of the section. `parts` has
        "polygons", the vertices (x, y) of a polygon between the fixed point and the curve; no orbit
        that starts inside the polygon ever leaves the curve's inside.

    Raises
    ------
    ValueError
        One line that says what cannot be proved and why. If no curve is found, or it is not proved,
        the line names the nearest rotation numbers with which curves are found, or smoother ones.

    Notes
    -----
    Larger curves take longer, up to some minutes. At k = 0.1, g = 0.03 and E = 0.015 the curve of
    the rotation number 0.141 encloses 0.0768 of the section. Energies beyond eq. (31), which limits
    those of config.yaml, are allowed.

    References
    ----------
    de la Llave, Gonzalez, Jorba and Villanueva, KAM theory without action-angle variables,
    Nonlinearity 18 (2005).

    Examples
    --------
    >>> from pseudorigid.dynamics.ball import Ball
    >>> prove_curve(Ball(k=0.2, g=0.04), 0.01, 1.5)
    Traceback (most recent call last):
    ...
    ValueError: rotation_number = 1.5 is not allowed: one number between 0 and 1
    """
    rotation = number(
        "rotation_number", rotation_number, "one number between 0 and 1", lambda v: 0.0 < v < 1.0
    )
    if isinstance(energy, float) and not math.isfinite(energy):
        raise ValueError(f"energy = {energy} is not allowed: a finite number")
    if not isinstance(ball, Surface):
        require_ball(ball)
    exact_energy = exact("energy", Fraction(energy) if isinstance(energy, float) else energy)
    k, g = (ball.k, ball.g) if isinstance(ball, Surface) else (Fraction(ball.k), Fraction(ball.g))
    surface = Surface(k, g, exact_energy)
    name = f"the invariant curve with the rotation number {rotation:.6g} at {surface}"
    bounds = {"radius": Fraction("1e-6"), "share": Fraction(0), "error": Fraction(1)}
    theorem = Theorem(name, name, curve.check, bounds | {"surface": surface, "period": 1})
    with _errors_naming(name):
        return curve_search.search(theorem, rotation)


@contextmanager
def _errors_naming(name: str) -> Iterator[None]:
    """Turn the errors of a proof that fails into a ValueError that says what was to be proved."""
    try:
        yield
    except (NotProvedError, ValueError, ArithmeticError) as error:
        raise ValueError(f"{name} cannot be proved: {error}") from None


def _request(
    ball: Ball | Surface, orbit: xr.Dataset, energy: Exact | None
) -> tuple[Surface, list[list[float]], str]:
    """Return the surface, the points (x, y) and the type of a requested orbit.

    Raises ValueError if the dataset has several orbits, or if the orbit's energy is another one.
    """
    if not isinstance(ball, Surface):
        require_ball(ball)
    names = {"x", "xdot", "udot", "type"}
    if not (isinstance(orbit, xr.Dataset) and names <= {*orbit} and orbit.sizes.get("point")):
        raise not_allowed("orbit", orbit, "one orbit of symmetric_orbits")
    if "orbit" in orbit.dims:
        raise ValueError("one orbit is needed: choose it with .isel(orbit=...)")
    if isinstance(ball, Surface):
        surface = ball
    else:
        if energy is None:
            if "energy" not in orbit.attrs:
                raise not_allowed(
                    "energy", energy, "that of the orbit, which has no such attribute"
                )
            energy = Fraction(float(orbit.attrs["energy"]))
        surface = Surface(Fraction(ball.k), Fraction(ball.g), exact("energy", energy))
    rounded, states = orbit_search.nearest_ball(surface), states_of(orbit)
    actual, expected = float(np.ravel(rounded.energy(*states))[0]), float(surface.energy)
    if not abs(actual - expected) <= 1e-6 * (abs(expected) + rounded.g**2 / rounded.k):
        raise ValueError(f"the orbit's energy is {actual:.6g}, not that of {surface}")
    return surface, chart(rounded.k, *states).T.tolist(), str(orbit["type"].item())
