"""Proofs on request: of any symmetric orbit, and of a horseshoe on any hyperbolic one."""

from fractions import Fraction

from ...dynamics.variables import states_of
from ..checks import horseshoe, periodic
from ..checks.certificate import NotProvedError
from ..enclosure.surface import Surface
from ..search import approximate_orbits
from ..search import horseshoe as horseshoes
from ..search import periodic as orbits
from .statements import Theorem


def prove_orbit(ball, orbit, energy=None):
    """Prove that a periodic orbit exists, is alone in a box, and of which type it is.

    Parameters
    ----------
    ball : Ball or Surface
        A Ball's k and g are taken as the doubles that they are; a Surface has exact numbers.
    orbit : xarray.Dataset
        One orbit of `symmetric_orbits`: x, xdot, udot on `point`, type.
    energy : int, Fraction, Decimal or str, optional
        Exact, of a Ball's orbit; otherwise the double in the orbit's attributes.

    Returns
    -------
    checks.periodic.Orbit
        Enclosures: points (x, y), impacts, trace; type; radius, the largest of one digit for
        which the orbit is proved to be the only one.

    Raises
    ------
    ValueError
        One line that says what cannot be proved and why.

    Examples
    --------
    >>> from pseudorigid import symmetric_orbits
    >>> from pseudorigid.dynamics.ball import Ball
    >>> one = symmetric_orbits(Ball(k=0.2, g=0.04), 0.01, 1).isel(orbit=0)
    >>> prove_orbit(Surface("1/5", "1/25", "1/100"), one).type
    'elliptic'
    """
    surface, points, kind = _request(ball, orbit, energy)
    what = f"the {kind} orbit of period {len(points)} at {surface}"
    bounds = {"surface": surface, "period": len(points), "type": kind, "radius": Fraction(0)}
    theorem = Theorem(what, what, periodic.check, bounds)
    try:
        text = orbits.propose(surface, points, theorem.of_any_size)
        return theorem.prove(text).parts["orbit"]
    except (NotProvedError, ArithmeticError) as error:
        raise ValueError(f"{what} cannot be proved: {error}") from None


def prove_horseshoe(ball, orbit, *, side, energy=None):
    """Prove a horseshoe on a hyperbolic orbit by its outer or inner symmetric connection.

    Parameters
    ----------
    ball : Ball or Surface
        As for `prove_orbit`.
    orbit : xarray.Dataset
        As for `prove_orbit`.
    side : {"outer", "inner"}
        Which unstable branches the connection belongs to, as its first point's lies.
    energy : int, Fraction, Decimal or str, optional
        As for `prove_orbit`.

    Returns
    -------
    str, checks.certificate.Finding
        The certificate, and what its checker proved: digits, margins, parts.

    Raises
    ------
    ValueError
        One line that says what cannot be proved and why.

    References
    ----------
    Those of `checks.horseshoe.check`.
    """
    if side not in ("outer", "inner"):
        raise ValueError(f"side = {side!r} is not allowed: 'outer' or 'inner'")
    surface, points, kind = _request(ball, orbit, energy)
    if kind != "hyperbolic":
        raise ValueError(f"no horseshoe can be proved on the orbit: it is {kind}, not hyperbolic")
    radius = prove_orbit(ball, orbit, energy).radius
    bounds = {"surface": surface, "period": len(points), "radius": radius, "entropy": Fraction(0)}
    what = f"the horseshoe at {surface}"
    theorem = Theorem(what, what, horseshoe.check, bounds | {"window": None, "crossing": None})
    sign = 1 if side == "outer" else -1
    try:
        text = horseshoes.search(
            surface, approximate_orbits.ball(surface), points, theorem.prove, sign
        )
        return text, theorem.prove(text)
    except (NotProvedError, ValueError, ArithmeticError) as error:
        raise ValueError(f"{what} cannot be proved: {error}") from None


def _request(ball, orbit, energy):
    """(surface, points (x, y), type) of a request."""
    if "orbit" in orbit.dims:
        raise ValueError("one orbit is needed: choose it with .isel(orbit=...)")
    if isinstance(ball, Surface):
        surface = ball
    else:
        energy = Fraction(float(orbit.attrs["energy"])) if energy is None else energy
        surface = Surface(Fraction(ball.k), Fraction(ball.g), energy)
    near = approximate_orbits.ball(surface)
    own, given = float(near.energy(*states_of(orbit))[0]), float(surface.energy)
    if not abs(own - given) <= 1e-6 * (abs(given) + near.g**2 / near.k):
        raise ValueError(f"the orbit's energy is {own:.6g}, not that of {surface}")
    return surface, approximate_orbits.chart(near, orbit), str(orbit["type"].item())
