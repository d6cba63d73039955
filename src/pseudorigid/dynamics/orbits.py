"""Orbits of the impact map, from states or from the starts of a scene."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr

from .ball import Ball, State, require_ball, require_short_flights
from .inputs import StateLike, not_allowed, one_of, state_of, whole_number
from .regularity import orbit_types
from .variables import NAMES, RADIUS, Variables, described, orbit_dims, variables


def orbit(ball: Ball, state: StateLike, impacts: int, keep: str = "all") -> xr.Dataset:
    """Compute the orbit of one state, or of many, under the impact map, eq. (28).

    Parameters
    ----------
    ball : Ball
    state : (x, xdot, udot) or xarray.Dataset
        Just before an impact, scalars or arrays that broadcast. A Dataset means its last
        state along `impact` or `point`, of each orbit in it, so that orbits can be continued.
    impacts : int
        Number of impacts after that state, at least 1.
    keep : {"all", "last"}
        "last" keeps only the final state, in memory that does not grow with `impacts`.

    Returns
    -------
    xarray.Dataset
        x, xdot, udot, tau with dims (impact, ...): one entry for each impact, without the start.
        tau is the time of the flight that ends there (1/omega). Arrays of states have the dim
        `orbit`, or orbit_0, orbit_1, ... if they have several dimensions. With keep="last" there
        is no dim `impact`.

    Raises
    ------
    ValueError
        A state has xdot + udot < 0, a single state's flight lasts 2^20/omega or longer, `impacts`
        is below 1 or needs too much memory, or `keep` is another word.

    Examples
    --------
    >>> from pseudorigid import Ball
    >>> ball = Ball(k=0.2, g=0.04)
    >>> orbit(ball, ball.start([0.5, -0.2], 0.01), 3)["x"].dims
    ('impact', 'orbit')
    >>> five = orbit(ball, ball.start(0.5, 0.01), 5)
    >>> rest = orbit(ball, orbit(ball, ball.start(0.5, 0.01), 3), 2)
    >>> bool(np.all(rest["x"].values == five["x"].values[3:]))
    True
    """
    require_ball(ball)
    one_of("keep", keep, ("all", "last"))
    impacts = whole_number("impacts", impacts)
    state = ball.on_section(*state_of(state))
    shape = state[0].shape
    dims = orbit_dims(shape)
    numbers: tuple[Any, Any] = (), impacts
    if keep == "last":
        values = [a.reshape(shape) for a in ball.after(state, impacts)]
    else:
        try:
            history = ball.history(state, impacts)
        except (MemoryError, ValueError):
            allowed = "fewer, or keep='last': memory is short"
            raise not_allowed("impacts", impacts, allowed) from None
        values = [a.reshape(impacts, *shape) for a in history.T]
        dims, numbers = ("impact", *dims), ("impact", np.arange(1, impacts + 1))
    require_short_flights(state, (a.flat[-1] for a in values))
    coordinate = described({"impact": (*numbers, "number of impacts")})
    return xr.Dataset(variables(dims, values), coords=coordinate)


def scene_orbits(
    ball: Ball, energy: float, starts: list[Any], impacts: int | list[int]
) -> xr.Dataset:
    """Compute the orbits of a scene (Figures 2 and 8) as a contiguous ragged array (CF).

    Starts are as in `start_state`. `impacts` is the number of all orbits, or a list. `type` is
    "regular", "chaotic" or "undecided" by `regularity.orbit_types`, which follows short and slow
    orbits further, and "undefined" for one that grazes exactly, as in `classify_orbits`.

    >>> from pseudorigid import Ball
    >>> scene_orbits(Ball(k=0.2, g=0.04), 0.01, [0.5, -0.2], [3, 2]).sizes["point"]
    5
    """
    impacts = impacts if isinstance(impacts, list) else [impacts] * len(starts)
    states = [start_state(ball, energy, start) for start in starts]
    pairs = zip(states, impacts, strict=True)
    pieces = [ball.history(state, count)[0].T for state, count in pairs]
    return ragged_orbits(ball, pieces, starts, states, impacts)


def ragged_orbits(
    ball: Ball, pieces: list[np.ndarray], starts: list[Any], states: list[Any], impacts: list[int]
) -> xr.Dataset:
    """Return the Dataset of `scene_orbits` from arrays (4, impacts) of x, xdot, udot and tau."""
    data = variables("point", np.concatenate(pieces, axis=1)) | start_variables(starts, states)
    data |= described({"row_size": ("orbit", np.array(impacts, np.int64), "number of impacts")})
    data["row_size"][2]["sample_dimension"] = "point"
    types = np.array(orbit_types(ball, np.transpose(states)), dtype=object)
    for orbit, piece in enumerate(pieces):
        types[orbit] = types[orbit] if np.all(piece[1] + piece[2] > 0.0) else "undefined"
    data |= described({"type": ("orbit", types, "regular or chaotic")})
    return xr.Dataset(data)


def start_state(ball: Ball, energy: float, start: Any) -> State:
    """Return the state (x, xdot, udot) of a start.

    A start is a fraction of the section's radius along y = 0, from -1 to 1, or a mapping with x and
    either xdot or y = xdot - k udot. Of two states with this xdot, the one with the larger udot is
    taken. Raises ValueError for a start off the section.
    """
    if not isinstance(start, dict):
        return ball.start(start, energy)
    if "y" in start:
        return ball.state_xy(start["x"], start["y"], energy)
    return ball.state(start["x"], start["xdot"], energy)


def start_variables(starts: Sequence[Any], states: Any) -> Variables:
    """Return dataset variables on `orbit` for some starts and their states.

    `start` is the fraction, NaN where a start is a point. start_x and start_xdot are present if one
    is.
    """
    fractions = [np.nan if isinstance(start, dict) else start for start in starts]
    meaning = "start along y = 0, in section radii from the centre"
    table = {"start": ("orbit", np.array(fractions, dtype=float), meaning, RADIUS)}
    if any(isinstance(start, dict) for start in starts):
        for name, values in zip(("x", "xdot"), np.array(states, dtype=float).T[:2], strict=True):
            table[f"start_{name}"] = "orbit", values, f"{name} of the start", NAMES[name][1]
    return described(table)
