"""The turnstile flux through the broken separatrix of a hyperbolic orbit."""

import xarray as xr

from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.inputs import number, one_of
from pseudorigid.dynamics.quantities import require_default_map

from .flux import SIDES, Side, flux


def turnstile_flux(ball: Ball, energy: float, period: int, side: Side = "outer") -> xr.Dataset:
    """Area that one impact carries through the broken separatrix of a hyperbolic orbit.

    The area is that of one lobe of the turnstile, from differences of action, and an equal area
    moves the other way.

    Parameters
    ----------
    ball : Ball
    energy : float
        In m omega^2 R^2.
    period : int
        Period of the hyperbolic orbit, even.
    side : {"outer", "inner"}
        Which branches of its manifolds form the turnstile.

    Returns
    -------
    xarray.Dataset
        area and area_error, in omega R^2; digits, the area as text with all digits that are
        certain; saddle and target, the indices of the orbit's points that the unstable branch
        leaves and meets; crossing_x (crossing), where the two primary homoclinic orbits meet y = 0.

    Raises
    ------
    ValueError
        No hyperbolic orbit of that period, an odd period, another side, or a side without lobes.

    References
    ----------
    MacKay, Meiss and Percival, Transport in Hamiltonian systems, Physica D 13 (1984).

    Examples
    --------
    >>> from pseudorigid import Ball
    >>> turnstile_flux(Ball(k=0.2, g=0.04), 0.01, 6)["digits"].item()[:14]  # doctest: +SKIP
    '0.000231071640'
    """
    require_default_map(ball)
    energy = number("energy", energy)
    period = int(number("period", period, "an even number", lambda v: v >= 2.0 and v % 2.0 == 0.0))
    one_of("side", side, SIDES[::-1])
    # The polygons and counts that `flux` adds to the areas are as small as it takes them.
    lobes = flux(ball, energy, period, 0.1, orbits=0, impacts=0, sides=(side,))
    names = ["area", "area_error", "digits", "saddle", "target", "crossing_x"]
    lobe: xr.Dataset = lobes[names].sel(side=side)
    return lobe.assign_attrs(k=ball.k, g=ball.g, energy=energy, period=period)
