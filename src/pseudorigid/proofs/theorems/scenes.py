"""The stages behind the pictures of the proofs, for any ball and energy."""

from fractions import Fraction

from ...dynamics.variables import of_type
from ..enclosure.surface import Surface
from .pictures import horseshoe_data, twist_data
from .requests import prove_horseshoe
from .statements import THEOREMS


def scene_horseshoe(ball, energy, periodic, period, type, connection):
    """The sets of a proved horseshoe on an orbit, by one of its connections.

    Where there is a theorem about this connection its certificate is used, otherwise one is
    searched.

    Parameters
    ----------
    ball : Ball
        Its k and g are taken as the decimals that they print as.
    energy : float
        In m omega^2 R^2, taken likewise.
    periodic : xarray.Dataset
        Orbits of this period, as from `symmetric_orbits`.
    period : int
        Of the orbit.
    type : {"hyperbolic"}
        Of the orbit.
    connection : {"outer", "inner"}

    Returns
    -------
    xarray.Dataset
        As from `horseshoe_data`.

    Raises
    ------
    ValueError
        No such orbit, or what `prove_horseshoe` cannot prove.

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
        found = theorem.prove(theorem.text())
    else:
        _, found = prove_horseshoe(surface, orbit, side=connection)
    return horseshoe_data(surface, found)


def scene_twist(ball, energy, energies):
    """Proved twists of the elliptic fixed point at some energies.

    Parameters
    ----------
    ball : Ball
        Its k and g are taken as the decimals that they print as.
    energy : float
        Not used: the energies are those of the list.
    energies : list of float
        Taken as the decimals that they print as.

    Returns
    -------
    xarray.Dataset
        As from `twist_data`.

    Raises
    ------
    ValueError
        An energy at which the twist is not proved.

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


def _exact(*values):
    """The decimals that floats print as, as Fractions."""
    return [Fraction(str(value)) for value in values]
