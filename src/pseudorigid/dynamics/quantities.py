"""Quantities of orbits that users ask for: rotation number, residue and regularity."""

import math
from typing import Any, SupportsIndex

import numpy as np
import xarray as xr

from ..kernel.tangents import turns_and_growth
from .ball import Ball, require_ball
from .inputs import StateLike, not_allowed, state_of, whole_number
from .regularity import LEAST_IMPACTS, around_fixed_point, first_turn, regular
from .variables import attributes_of, described, orbit_dims
from .verdict import classify_orbits as follow_until_decided

_FEWEST_IMPACTS = 100  # the first half and the second one still have tens of turns


def rotation_number(ball: Ball, state: StateLike, impacts: SupportsIndex = 10_000) -> Any:
    """Rotation number of orbits around the symmetric fixed point, in turns per impact.

    It converges fast on quasi-periodic orbits. The rotation number of a chaotic orbit is not
    defined: the average returned for it depends on `impacts`. At the fixed point itself there is
    nothing to count; `symmetric_orbits` gives the rotation number there.

    Parameters
    ----------
    ball : Ball
        With the default map.
    state : (x, xdot, udot) or xarray.Dataset
        Just before an impact, as for `orbit`. States may have different energies.
    impacts : int
        How many impacts to average over, at least 100.

    Returns
    -------
    float or ndarray
        One number per state, in the shape of the states. NaN where a state is not finite.

    Raises
    ------
    ValueError
        A state with xdot + udot < 0, too few impacts, or a ball with another map.

    References
    ----------
    Das, Saiki, Sander and Yorke, Quantitative quasiperiodicity, Nonlinearity 30 (2017): the
    weighted Birkhoff average, here with the weights (t (1 - t))^3.

    Examples
    --------
    >>> from pseudorigid import Ball, rotation_number
    >>> ball = Ball(k=0.2, g=0.04)
    >>> round(rotation_number(ball, ball.start(-0.2, 0.01)), 6)
    0.176039
    """
    impacts = whole_number("impacts", impacts, _FEWEST_IMPACTS)
    finite, orbits = _finite_orbits(ball, state)
    turns = np.full(finite.shape, math.nan)
    turns[finite], _ = turns_and_growth(ball.k, *orbits, impacts)
    return turns if turns.shape else float(turns)


def residue(orbits: xr.Dataset) -> xr.DataArray:
    """Greene's residue of periodic orbits, (2 - trace)/4.

    It is between 0 and 1 for elliptic orbits, negative for hyperbolic and above 1 for inverse
    hyperbolic ones.

    Parameters
    ----------
    orbits : xarray.Dataset
        One or more orbits of `symmetric_orbits` or `periodic_orbits`.

    Returns
    -------
    xarray.DataArray
        One residue per orbit.

    Raises
    ------
    ValueError
        A Dataset without the trace of its orbits.

    References
    ----------
    Greene, A method for determining a stochastic transition, J. Math. Phys. 20 (1979).

    Examples
    --------
    >>> from pseudorigid import Ball, residue, symmetric_orbits
    >>> residue(symmetric_orbits(Ball(k=0.2, g=0.04), 0.01, 6)).values.round(4).tolist()
    [0.2854, -0.1329, 1.6255]
    """
    if not isinstance(orbits, xr.Dataset) or "trace" not in orbits:
        value = "this Dataset" if isinstance(orbits, xr.Dataset) else orbits
        raise not_allowed("orbits", value, "a Dataset with trace, as from symmetric_orbits")
    values: xr.DataArray = (2.0 - orbits["trace"]) / 4.0
    return values.rename("residue").assign_attrs(attributes_of("Greene's residue"))


def classify_orbits(ball: Ball, state: StateLike, impacts: SupportsIndex = 10_000) -> xr.Dataset:
    """Decide which orbits are regular and which are chaotic.

    Each orbit is followed until the decision is safe: along a regular orbit a tangent vector grows
    in proportion to the number of impacts and the rotation number settles; along a chaotic orbit
    the vector grows exponentially. No orbit is called regular before it has made one whole turn
    around the symmetric fixed point and has been followed for as long again.

    Parameters
    ----------
    ball : Ball
        With the default map.
    state : (x, xdot, udot) or xarray.Dataset
        Just before an impact, as for `orbit`. States may have different energies.
    impacts : int
        How many impacts to follow an undecided orbit at most, at least 100. Numbers below 2,000
        mean 2,000, since shorter orbits decide too little.

    Returns
    -------
    xarray.Dataset
        type, "regular", "chaotic", "undecided" for an orbit that makes no whole turn within half of
        the impacts, or "undefined" for a state that is not finite and an orbit that grazes exactly;
        rotation_number, turns per impact around the symmetric fixed point; followed, the number of
        impacts. A state of one dimension has the dim `orbit`, of more
        `orbit_0`, ...

    Raises
    ------
    ValueError
        A state with xdot + udot < 0, too few impacts, or a ball with another map.

    Notes
    -----
    With at most 4,000 impacts about 0.6 % of decisions on random orbits of random balls were wrong.
    Nearly all of these orbits were chaotic ones that stick to an island.

    Examples
    --------
    >>> from pseudorigid import Ball, classify_orbits
    >>> ball = Ball(k=0.2, g=0.04)
    >>> classify_orbits(ball, ball.start([-0.2, 0.6], 0.01))["type"].values.tolist()
    ['regular', 'chaotic']
    """
    impacts = max(whole_number("impacts", impacts, _FEWEST_IMPACTS), LEAST_IMPACTS)
    finite, (states, centre, expected) = _finite_orbits(ball, state)
    types = np.full(finite.shape, "undefined", dtype=object)
    winding, followed = np.full(finite.shape, math.nan), np.zeros(finite.shape, dtype=np.int64)
    if finite.any():
        verdicts = follow_until_decided(ball.k, states, centre, expected, impacts)
        words = np.where(verdicts.regular, "regular", "chaotic").astype(object)
        # Few turn so slowly that the mean turn of an impact leaves it open whether one is whole.
        calm = np.flatnonzero(verdicts.regular & (abs(verdicts.winding) * verdicts.followed < 2.0))
        some = states[:, calm], centre[calm], expected[calm]
        needed = 2 * first_turn(ball.k, *some, impacts // 2)
        slow = needed > verdicts.followed[calm]
        if slow.any():
            late = calm[slow]
            some = states[:, late], centre[late], expected[late]
            turns, rate = turns_and_growth(ball.k, *some, impacts)
            unturned = np.where(needed[slow] <= impacts, "regular", "undecided")
            words[late] = np.where(regular(rate, impacts), unturned, "chaotic")
            verdicts.winding[late], verdicts.growth[late] = turns, rate
            verdicts.followed[late] = impacts
        types[finite] = np.where(np.isnan(verdicts.growth), "undefined", words)
        winding[finite], followed[finite] = verdicts.winding, verdicts.followed
    dims = orbit_dims(finite.shape)
    table = {
        "type": (dims, types, "regular, chaotic, undecided or undefined"),
        "rotation_number": (
            dims,
            winding,
            "rotation number around the fixed point, in turns per impact",
        ),
        "followed": (dims, followed, "number of impacts that the orbit was followed"),
    }
    return xr.Dataset(described(table), attrs={"k": ball.k, "g": ball.g})


def require_default_map(ball: Ball) -> None:
    """Raise ValueError for a ball whose map is not the default one, which misses no impact."""
    require_ball(ball)
    if not ball.map.certified:
        raise not_allowed("ball.map", ball.map, "the default, which misses no impact")


def _finite_orbits(ball: Ball, state: Any) -> tuple[np.ndarray, tuple[Any, Any, Any]]:
    """Return which states are finite, and their orbits as `around_fixed_point` does."""
    require_default_map(ball)
    x, xdot, udot = ball.on_section(*state_of(state))
    finite = np.isfinite(x)
    columns = [np.atleast_1d(a[finite]) for a in (x, xdot, udot)]
    return finite, around_fixed_point(ball, np.array(columns))
