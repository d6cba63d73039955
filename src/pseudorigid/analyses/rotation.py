"""Rotation number and exponent of orbits against their start along y = 0, at several energies."""

import numpy as np
import xarray as xr

from ..dynamics.variables import ENERGY, RADIUS, described, variables
from .winding import fixed, winding

# ln of a tangent vector's growth over a chaotic orbit's second half, at least; over a regular one's
# it about doubles, ln 2.
GROWN = 6.0
LOCKED = 3e-9  # turns an impact; so near to a fraction a rotation number is taken for it
_ORBITS = {
    "place": ("start along y = 0, in section radii from the centre", RADIUS),
    "rotation": "rotation number around the fixed point",
    "exponent": "Lyapunov exponent an impact",
}


def rotation(ball, energy, energies, starts, impacts, detail, detail_impacts):
    """Rotation number around the fixed point, and exponent, of starts along y = 0.

    Parameters
    ----------
    ball : Ball
    energy : float
        The first of the energies (m omega^2 R^2).
    energies : sequence of float
        The others.
    starts : int
        How many starts at each energy, evenly from the fixed point to the section's rim.
    impacts : int
        Of each orbit.
    detail : (float, float)
        As many starts again lie evenly over this part of y = 0, in section radii, at the first
        energy.
    detail_impacts : int
        Of each of these.

    Returns
    -------
    xarray.Dataset
        On (energy, start): place, the start in section radii from the centre; rotation, turns an
        impact around the fixed point, a weighted Birkhoff average; exponent, over the second half
        of the orbit. detail_place, detail_rotation, detail_exponent (detail): the same of the
        detail. On energy: fixed_place, fixed_rotation (NaN where it is not elliptic). Attributes
        impacts and detail_impacts.

    References
    ----------
    Kanso and Papadopoulos, section 4.2, whether the map is a twist map; the average is that of
    `winding.winding`.

    Examples
    --------
    >>> from pseudorigid import Ball
    >>> found = rotation(Ball(k=0.2, g=0.04), 0.01, [0.001], 10, 200, (-0.8357, -0.8342), 200)
    >>> found.sizes["start"]
    10
    """
    levels = [float(energy), *map(float, energies)]
    middle = (np.arange(starts) + 0.5) / starts
    centres, orbits = [fixed(ball, level) for level in levels], []
    for level, (at, _) in zip(levels, centres, strict=True):
        place = at + (1.0 - at) * middle
        orbits.append((place, *winding(ball, level, place, impacts)))
    data = variables(("energy", "start"), zip(*orbits, strict=True), _ORBITS)
    at, about = zip(*centres, strict=True)
    data |= described(
        {
            "energy": ("energy", levels, "energy", ENERGY),
            "fixed_place": (
                "energy",
                at,
                "the fixed point, in section radii from the centre",
                RADIUS,
            ),
            "fixed_rotation": ("energy", about, "rotation number of the fixed point"),
        }
    )
    place = detail[0] + (detail[1] - detail[0]) * middle
    found = place, *winding(ball, energy, place, detail_impacts)
    data |= variables("detail", found, {f"detail_{name}": text for name, text in _ORBITS.items()})
    return xr.Dataset(data, attrs={"impacts": impacts, "detail_impacts": detail_impacts})


def regular(exponent, impacts):
    """Which orbits are regular, by the growth of a tangent vector over their second half.

    The exponent of a regular one is about ln 2 over half their number of impacts, or less.

    Parameters
    ----------
    exponent : ndarray
        Nats an impact, as from `rotation`.
    impacts : int
        Of each orbit.

    Returns
    -------
    ndarray of bool
    """
    return exponent * (0.5 * impacts) < GROWN


def island(dataset, row):
    """How many starts from the fixed point on lie in the main island.

    It ends where two neighbouring starts are chaotic: a layer inside it may hold one.

    Parameters
    ----------
    dataset : xarray.Dataset
        As from `rotation`.
    row : int
        Of its energies.

    Returns
    -------
    int
    """
    chaotic = ~regular(dataset["exponent"].values[row], dataset.attrs["impacts"])
    both = chaotic[:-1] & chaotic[1:]
    return int(np.argmax(both)) if both.any() else chaotic.size


def plateaus(place, turns, most=100, few=3):
    """Gaps between the curves around the fixed point: starts in one chain of islands.

    Parameters
    ----------
    place, turns : ndarray, shape (n,)
        Starts and rotation numbers of regular orbits, in order.
    most : int
        Islands in a chain, at most.
    few : int
        Neighbouring starts with one rotation number, at least.

    Returns
    -------
    list of (int, int, float, float)
        p, q and the first and last place of starts with the rotation number p/q, in lowest terms.
    """
    found = []
    for q in range(2, most + 1):
        p = np.rint(turns * q).astype(np.int64)
        hit = np.abs(turns - p / q) < LOCKED
        for number in sorted(set(p[hit].tolist())):
            (at,) = np.nonzero(hit & (p == number))
            if at.size >= few and at[-1] - at[0] == at.size - 1 and np.gcd(number, q) == 1:
                found.append((number, q, float(place[at[0]]), float(place[at[-1]])))
    return found
