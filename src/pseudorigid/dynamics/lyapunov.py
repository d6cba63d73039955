"""Lyapunov exponents of orbits, by Benettin's method (`kernel.spectrum`)."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr

from ..kernel import spectrum
from ..kernel.lanes import MIN_ORBITS_FOR_LANES
from ..kernel.tangents import GROUP
from .ball import Ball, require_ball
from .ensemble import in_threads
from .inputs import StateLike, not_allowed, state_of, whole_number
from .orbits import start_state, start_variables
from .regularity import orbit_types
from .variables import TIME, described, orbit_dims


def lyapunov_spectrum(ball: Ball, state: StateLike, impacts: int, records: int = 400) -> xr.Dataset:
    """Compute the Lyapunov exponents, in nats an impact, and their convergence.

    Parameters
    ----------
    ball : Ball
    state : (x, xdot, udot) or xarray.Dataset
        Just before an impact, as for `orbit`.
    impacts : int
        Number of impacts, at least 1.
    records : int
        Number of equal parts of the orbit after which the exponents so far are recorded, at least
        1. If it exceeds `impacts`, the exponents are recorded after each impact.

    Returns
    -------
    xarray.Dataset
        exponent, dims (impact, ..., index); its last entry is the final value. `impact` holds the
        number of impacts, and time, dims (impact, ...), the time since the start (1/omega).
        exponent * impact / time is the flow's exponent, in nats per 1/omega. `index` counts the
        vectors of the frame in the order in which they are orthogonalized. The exponents tend to
        descending order, but need not be in it after a finite number of impacts: the largest one is
        `exponent.max("index")`. Arrays of states have the dim `orbit`, or orbit_0, orbit_1, ...
        From a grazing impact on, where the map has no derivative, exponents and time are NaN.

    Raises
    ------
    ValueError
        A state has xdot + udot < 0, or `impacts` or `records` is below 1.

    References
    ----------
    Kanso and Papadopoulos, eq. (32), with the factor 1/i that it lacks; Benettin, Galgani,
    Giorgilli and Strelcyn, Meccanica 15 (1980), reference [18] of the paper.

    Examples
    --------
    >>> from pseudorigid import Ball
    >>> ball = Ball(k=0.2, g=0.04)
    >>> lyapunov_spectrum(ball, ball.start(0.6, 0.01), 1000, 10)["exponent"].dims
    ('impact', 'index')
    """
    require_ball(ball)
    impacts = whole_number("impacts", impacts)
    records = min(whole_number("records", records), impacts)
    state = ball.on_section(*state_of(state))
    shape = state[0].shape
    dims = orbit_dims(shape)
    try:
        at = (np.arange(1, records + 1) * impacts) // records
        out = np.empty((state[0].size, records, 4))
    except (MemoryError, ValueError):
        raise not_allowed("records", records, "fewer: memory is short") from None

    def exponents_of_piece(x: np.ndarray, v: np.ndarray, w: np.ndarray, piece: np.ndarray) -> int:
        """Write exponents and times of some orbits, and return how many impacts a scan missed."""
        parts: Sequence[Any] = range(x.size)  # one orbit each, or slices of several
        compute = spectrum.exponents_of_orbit
        if x.size >= MIN_ORBITS_FOR_LANES:  # fewer are faster one after the other
            parts = [slice(i, i + GROUP) for i in range(0, x.size, GROUP)]
            compute = spectrum.exponents_of_group
        k, g, scan = ball.k, ball.g, ball.map.scan
        return sum(compute(x[i], v[i], w[i], k, g, at, piece[i], scan) for i in parts)

    missed = in_threads(exponents_of_piece, impacts, *(a.flatten() for a in state), out)
    ball.map.count(impacts * state[0].size, missed)
    values = out.swapaxes(0, 1).reshape(records, *shape, 4)
    exponents, time = np.ascontiguousarray(values[..., :3]), values[..., 3]
    time = np.where(np.isnan(exponents).any(axis=-1), np.nan, time)
    meaning = "Lyapunov exponent an impact, of each vector of the frame"
    table = {
        "exponent": (("impact", *dims, "index"), exponents, meaning),
        "time": (("impact", *dims), time, "time elapsed since the start", TIME),
    }
    impact = described({"impact": ("impact", at, "number of impacts")})
    return xr.Dataset(described(table), coords=impact)


def scene_exponents(
    ball: Ball, energy: float, starts: list[Any], impacts: int | list[int], records: int
) -> xr.Dataset:
    """Compute the Lyapunov exponents of the orbits of a scene, and their convergence (Figure 7).

    Starts are as in `orbits.start_state`. `impacts` is one number for all orbits, or one for each.
    Then each orbit has records of its own; `exponent` and `time` are NaN at those of the others.
    `type` is "regular", "chaotic", "undecided" or "undefined", by `regularity.orbit_types`.

    >>> from pseudorigid import Ball
    >>> spectrum = scene_exponents(Ball(k=0.2, g=0.04), 0.01, [0.6], 1000, 10)
    >>> bool(abs(spectrum["exponent"].values[-1].sum()) < 0.01)
    True
    """
    states = np.array([start_state(ball, energy, start) for start in starts])
    counts = impacts if isinstance(impacts, list) else [impacts] * len(starts)
    if len(set(counts)) > 1:
        pairs = zip(states, counts, strict=True)
        spectra = [lyapunov_spectrum(ball, state[:, None], n, records) for state, n in pairs]
        result = xr.concat(spectra, "orbit", join="outer").transpose("impact", "orbit", "index")
    else:
        result = lyapunov_spectrum(ball, tuple(states.T), counts[0], records)
    types = np.array(orbit_types(ball, states.T))
    table = described({"type": ("orbit", types, "regular or chaotic")})
    return result.assign(start_variables(starts, states) | table)
