"""Which periods have symmetric orbits: their number, types and residues."""

from typing import SupportsFloat

import numpy as np
import xarray as xr

from .ball import Ball
from .inputs import whole_number
from .periodic import symmetric_orbits
from .variables import NoOrbitError, described, of_type

TYPES = ("elliptic", "hyperbolic", "inverse hyperbolic")
_LONGEST_NAMED = 12  # periods up to this are named where an orbit does not exist


def count_orbits(ball: Ball, energy: SupportsFloat, longest: int) -> xr.Dataset:
    """Count the symmetric orbits of each period, and list their types and residues.

    Parameters
    ----------
    ball : Ball
    energy : float
        It is within `ball.energy_bounds()`.
    longest : int
        The largest period that is counted. It is at least 1.

    Returns
    -------
    xarray.Dataset
        count, the number of orbits, dims (period, type), with the coordinates period, from 1 to
        `longest`, and type, "elliptic", "hyperbolic" and "inverse hyperbolic". On `orbit`, in
        order of the period: orbit_period, orbit_type and residue, Greene's, (2 - trace)/4. They
        are the orbits of `symmetric_orbits`. Attributes: line_points_seen, the least one of all
        searches, which says how complete they are.

    Raises
    ------
    ValueError
        The energy is not within the bounds, or `longest` is below 1.

    Examples
    --------
    >>> from pseudorigid import Ball, count_orbits
    >>> counts = count_orbits(Ball(k=0.2, g=0.04), 0.01, 7)["count"]
    >>> counts.sum("type").values.tolist()
    [1, 0, 0, 0, 0, 3, 2]
    """
    periods = range(1, whole_number("longest", longest) + 1)
    found = [symmetric_orbits(ball, energy, period) for period in periods]
    types = np.concatenate([orbits["type"].values for orbits in found])
    traces = np.concatenate([orbits["trace"].values for orbits in found])
    sizes = [orbits.sizes["orbit"] for orbits in found]
    count = [
        [np.count_nonzero(orbits["type"].values == word) for word in TYPES] for orbits in found
    ]
    table = {
        "count": (("period", "type"), np.array(count), "number of symmetric orbits"),
        "orbit_period": ("orbit", np.repeat(periods, sizes), "number of impacts"),
        "orbit_type": ("orbit", types, "type of stability"),
        "residue": ("orbit", (2.0 - traces) / 4.0, "Greene's residue"),
    }
    coordinates = {
        "period": ("period", np.array(periods), "number of impacts"),
        "type": ("type", np.array(TYPES, dtype=object), "type of stability"),
    }
    attrs = found[0].attrs | {
        "line_points_seen": min(orbits.attrs["line_points_seen"] for orbits in found),
        "unsolved": sum(orbits.attrs["unsolved"] for orbits in found),
    }
    del attrs["period"]
    return xr.Dataset(described(table), described(coordinates), attrs)


def orbit_of_type(
    ball: Ball, energy: float, orbits: xr.Dataset, kind: str, period: int
) -> xr.Dataset:
    """Return the first orbit of a type as `of_type` does, or name the periods that have one.

    Raises NoOrbitError.
    """
    try:
        return of_type(orbits, kind, period)
    except NoOrbitError as error:
        certified = Ball(ball.k, ball.g)
        counts = count_orbits(certified, energy, _LONGEST_NAMED)["count"].sel(type=kind)
        periods = counts["period"].values[counts.values > 0].tolist()
        words = ", ".join(map(str, periods)) or "none"
        longest = f"up to {_LONGEST_NAMED}"
        raise NoOrbitError(f"{error}; periods {longest} with one: {words}") from None


def require_own(ball: Ball, orbit: xr.Dataset) -> None:
    """Raise ValueError if an orbit's attributes are those of another ball."""
    for name, own in (("k", ball.k), ("g", ball.g)):
        if orbit.attrs.get(name, own) != own:
            words = f"the orbit is of another ball, with {name} = {orbit.attrs[name]}, not {own}"
            raise ValueError(words)
