"""The stages behind the pictures of the proofs: theorems at the paper's numbers only."""

from fractions import Fraction

from .pictures import horseshoe_data, twist_data
from .statements import HIGH, G, K


def scene_horseshoe(ball, energy, connection):
    """The sets of a proved horseshoe on the hyperbolic period-six orbit.

    Parameters
    ----------
    ball : Ball
        The paper's, k = 1/5 and g = 1/25.
    energy : float
        The paper's, 1/100.
    connection : {"outer", "inner"}

    Returns
    -------
    xarray.Dataset
        As from `horseshoe_data`.

    Raises
    ------
    ValueError
        Another ball or energy.

    References
    ----------
    Kanso and Papadopoulos, section 4.1: "a formal proof of the existence of such a set is currently
    unavailable".

    Examples
    --------
    >>> from pseudorigid import Ball
    >>> scene_horseshoe(Ball(k=0.2, g=0.04), 0.001, "outer")
    Traceback (most recent call last):
    ...
    ValueError: no theorem at k = 0.2, g = 0.04, E = 0.001: they are at k = 1/5, g = 1/25, E = 1/100
    """
    _check(ball, energy)
    return horseshoe_data(f"horseshoe-{connection}")


def scene_twist(ball, energy, energies):
    """Proved twists of the elliptic fixed point at some energies.

    Parameters
    ----------
    ball : Ball
        The paper's, k = 1/5 and g = 1/25.
    energy : float
        The paper's, 1/100.
    energies : list of float
        Taken as the decimals they print as.

    Returns
    -------
    xarray.Dataset
        As from `twist_data`.

    Raises
    ------
    ValueError
        Another ball or energy.

    References
    ----------
    Kanso and Papadopoulos, section 4.2 and section 5, of KAM theory for the islands.

    Examples
    --------
    >>> from pseudorigid import Ball
    >>> scene_twist(Ball(k=0.3, g=0.04), 0.01, [0.01])
    Traceback (most recent call last):
    ...
    ValueError: no theorem at k = 0.3, g = 0.04, E = 0.01: they are at k = 1/5, g = 1/25, E = 1/100
    """
    _check(ball, energy)
    return twist_data([str(value) for value in energies])


def _check(ball, energy):
    """ValueError unless ball and energy are those that the theorems are about."""
    given = [Fraction(str(value)) for value in (ball.k, ball.g, energy)]
    if given != [K, G, HIGH.energy]:
        raise ValueError(
            f"no theorem at k = {ball.k:g}, g = {ball.g:g}, E = {energy:g}: "
            f"they are at k = {K}, g = {G}, E = {HIGH.energy}"
        )
