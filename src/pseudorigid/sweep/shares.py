"""The regular share of the section along a line of energies or of inertias."""

from fractions import Fraction

import xarray as xr

from ..dynamics.ball import Ball
from ..dynamics.variables import ENERGY, described
from .cell import cells

_NAMES = {
    "regular": "share of the section's area with regular orbits",
    "regular_low": "lower end of its 95 % interval, starts and threshold together",
    "regular_high": "upper end of its 95 % interval, starts and threshold together",
}


def shares(
    ball: Ball,
    energy: float,
    parameter: str,
    span: list[float],
    step: float,
    starts: int,
    impacts: int,
) -> xr.Dataset:
    """Compute the regular share of the section at multiples of a step in E or k.

    A value has the bits of the sweep's cell with the same k, E/g^2, starts and impacts.

    Parameters
    ----------
    ball : Ball
    energy : float
        Along k, E/g^2 is that of this energy.
    parameter : {"energy", "k"}
    span : (float, float)
        Least and largest value of the parameter.
    step : float
        Distance between two values, which are its multiples.
    starts, impacts : int
        As for `sweep.cell.cell`.

    Returns
    -------
    xarray.Dataset
        energy, k, regular, regular_low and regular_high on `value`.

    Examples
    --------
    >>> from pseudorigid import Ball
    >>> data = shares(Ball(k=0.2, g=0.04), 0.01, "energy", [0.01, 0.02], 0.005, 10, 1000)
    >>> data["energy"].values.tolist()
    [0.01, 0.015, 0.02]
    """
    unit, low, high = (Fraction(str(value)) for value in (step, *span))
    square = Fraction(str(ball.g)) ** 2
    values = [unit * i for i in range(-int(-low // unit), int(high // unit) + 1)]
    if parameter == "energy":
        scaled = [float(value / square) for value in values]
        rows = cells(ball.k, scaled, starts, impacts)
        energies, inertias = [float(value) for value in values], [ball.k] * len(values)
    else:
        scaled = float(Fraction(str(energy)) / square)
        rows = [cells(float(k), [scaled], starts, impacts)[0] for k in values]
        energies, inertias = [float(energy)] * len(values), [float(value) for value in values]
    table = {
        "energy": ("value", energies, "energy", ENERGY),
        "k": ("value", inertias, "Euler inertia, eq. (5)"),
    }
    table |= {name: ("value", [row[name] for row in rows], text) for name, text in _NAMES.items()}
    return xr.Dataset(described(table), attrs={"starts": starts, "impacts": impacts})
