"""Stages behind the pictures of the proofs, for any ball and energy."""

from fractions import Fraction

import xarray as xr

from ...dynamics.ball import Ball
from ...dynamics.variables import of_type
from ..enclosure.surface import Surface
from .pictures import horseshoe_data, twist_data
from .requests import prove_horseshoe
from .statements import THEOREMS


def scene_horseshoe(
    ball: Ball, energy: float, periodic: xr.Dataset, period: int, type: str, connection: str
) -> xr.Dataset:
    """Prove a horseshoe on an orbit, by one of its connections, and tabulate its sets.

    The certificate is that of the theorem about this connection, if there is one; otherwise it is
    searched.

    Parameters
    ----------
    ball : Ball
    energy : float
        This, k and g are taken as the decimals that they print as.
    periodic : xarray.Dataset
        Orbits of this period, as from `symmetric_orbits`.
    period : int
    type : {"hyperbolic"}
    connection : {"outer", "inner"}

    Returns
    -------
    xarray.Dataset
        As from `horseshoe_data`.

    Raises
    ------
    ValueError
        There is no such orbit, or `prove_horseshoe` cannot prove the horseshoe.

    References
    ----------
    Kanso and Papadopoulos, section 4.1: "a formal proof of the existence of such a set is currently
    unavailable".

    Examples
    --------
    >>> from pseudorigid import Ball, symmetric_orbits
    >>> ball = Ball(k=0.3, g=0.02)
    >>> five = symmetric_orbits(ball, 0.002, 5)
    >>> scene_horseshoe(ball, 0.002, five, 5, "hyperbolic", "outer").sizes["edge"]
    4
    """
    orbit = of_type(periodic, type, period)
    surface = Surface(*_exact(ball.k, ball.g, energy))
    theorem = THEOREMS[f"horseshoe-{connection}"]
    if (surface, period) == (theorem.bounds["surface"], theorem.bounds["period"]):
        finding = theorem.prove(theorem.text())
    else:
        _, finding = prove_horseshoe(surface, orbit, side=connection)
    return horseshoe_data(surface, finding)


def scene_twist(ball: Ball, energy: float, energies: list[float]) -> xr.Dataset:
    """Prove and tabulate twists of the elliptic fixed point at some energies.

    Parameters
    ----------
    ball : Ball
        Its k and g are taken as the decimals that they print as.
    energy : float
        Not used.
    energies : list of float
        Taken as the decimals that they print as.

    Returns
    -------
    xarray.Dataset
        As from `twist_data`.

    Raises
    ------
    ValueError
        The twist is not proved at one of the energies.

    References
    ----------
    Kanso and Papadopoulos, section 4.2 and section 5, of KAM theory for the islands.

    Examples
    --------
    >>> from pseudorigid import Ball
    >>> twist = scene_twist(Ball(k=0.3, g=0.02), 0.002, [0.001, 0.002])["twist"].values
    >>> bool(twist[0] > twist[1] > 0)
    True
    """
    return twist_data(*_exact(ball.k, ball.g), _exact(*energies))


def _exact(*values: float) -> list[Fraction]:
    """Convert floats to the decimals that they print as."""
    return [Fraction(str(value)) for value in values]
