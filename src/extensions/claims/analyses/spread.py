"""Lyapunov exponents of many orbits: how they spread, and how the spread falls with the length.

Orbits start uniformly over the whole section; `regularity` decides which of them are chaotic.
The dataset holds means over blocks, from which means over longer stretches follow. So one run gives
the long-run value, its error, and the distribution of the short runs that it consists of. If blocks
were independent, the spread of runs would fall like the reciprocal square root of their length.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr

from paper import values
from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.lyapunov import lyapunov_spectrum
from pseudorigid.dynamics.regularity import judged
from pseudorigid.dynamics.variables import LENGTH, SPEED, chart, described

from .sea import as_array, half_axes, section_points
from .stretches import spread_of_runs

_CHUNK = 4000  # impacts of each orbit in memory at once: 8 MB for 64 orbits


def spread(
    ball: Ball, energy: float, orbits: int, length: int, blocks: int, regular: Sequence[float],
    regular_impacts: int, cells: int, visits: int,
) -> xr.Dataset:  # fmt: skip
    """Compute the exponents of many orbits by blocks, and the cells that chaotic orbits enter.

    The exponents so far of the regular orbits are kept after `regular_impacts` and its halves. The
    section's bounding rectangle is divided into cells x cells cells, and those that chaotic orbits
    enter are counted after `visits` and its halves. Exponents are in the order of
    `lyapunov_spectrum`. ValueError is raised if `blocks` does not divide `length`, or no orbit is
    chaotic.

    >>> from pseudorigid import Ball
    >>> data = spread(Ball(k=0.2, g=0.04), 0.01, 5, 400, 4, [0.1], 4, 4, 4)
    >>> data["type"].values.tolist()
    ['chaotic', 'chaotic', 'chaotic', 'chaotic', 'regular']
    """
    if length % blocks:
        raise ValueError(f"blocks = {blocks} is not allowed: length = {length} is no multiple")
    x, y = section_points(ball, energy, orbits)
    states = as_array(ball.state_xy(x, y, energy))
    so_far = lyapunov_spectrum(ball, states, length, blocks)["exponent"].values
    count = np.arange(1, blocks + 1)[:, None, None]
    sums = so_far * count
    block = np.concatenate([sums[:1], sums[1:] - sums[:-1]])
    types = judged(ball, states)[0]
    chaotic = types == "chaotic"
    if not chaotic.any():
        raise ValueError(
            f"orbits = {orbits} of {length} impacts is not allowed: none is chaotic: "
            "give more orbits, longer ones or another energy"
        )
    lengths = _halves(regular_impacts)
    islands = ball.start(np.asarray(regular, dtype=float), energy)
    calm = [lyapunov_spectrum(ball, islands, n, 1)["exponent"].values[0] for n in lengths]
    data = {
        "exponent": (("block", "orbit", "index"), block, "mean exponent of a block"),
        "type": ("orbit", types, "regular or chaotic"),
        "start_x": ("orbit", x, "x of the start", LENGTH),
        "start_y": ("orbit", y, "y = xdot - k udot of the start", SPEED),
        "length": ("length", lengths, "number of impacts"),
        "regular_exponent": (("length", "island", "index"), calm, "exponent of a regular orbit"),
        "regular_type": ("island", judged(ball, islands)[0], "regular or chaotic"),
    }
    data |= _entered_cells(ball, energy, states[:, chaotic], cells, visits)
    data |= spread_of_runs(block[:, chaotic], length // blocks)
    attributes: dict[str, Any] = {"block_impacts": length // blocks}
    if (energy, {"k": ball.k, "g": ball.g}) == (values.FIGURES["fig7"]["energy"], values.BALL):
        attributes["printed_exponent"] = values.EXPONENT
    return xr.Dataset(described(data), attrs=attributes)


def _halves(number: int) -> list[int]:
    """Return number, number/2, ... above 0, in rising order."""
    return [number >> i for i in reversed(range(number.bit_length()))]


def _entered_cells(
    ball: Ball, energy: float, states: np.ndarray, cells: int, visits: int
) -> dict[str, tuple[Any, ...]]:
    """Count the cells of the chart that orbits enter, at `visits` impacts and its halves."""
    centre, (radius, high) = ball.section(energy)[0], half_axes(ball, energy)
    entered = np.zeros((states.shape[1], cells * cells), dtype=bool)
    lengths, done, counts = _halves(visits), 0, []
    for length in lengths:
        while done < length:
            out = ball.history(states, min(_CHUNK, length - done))
            states = out[:, -1, :3].T
            done += out.shape[1]
            x, y = chart(ball.k, *np.moveaxis(out[..., :3], -1, 0))
            across, up = (
                np.clip((0.5 * (coordinate + 1.0) * cells).astype(np.int64), 0, cells - 1)
                for coordinate in ((x - centre) / radius, y / high)
            )
            for orbit, numbers in enumerate(up * cells + across):
                entered[orbit, numbers] = True
        least = entered.sum(axis=1).min()
        counts.append((entered.any(axis=0).sum(), least))
    any_of, least = np.array(counts, dtype=np.int64).T
    return {
        "visit": ("visit", lengths, "number of impacts of each chaotic orbit"),
        "entered_any": ("visit", any_of, "cells entered by at least one chaotic orbit"),
        "entered_least": ("visit", least, "cells entered by the chaotic orbit that enters fewest"),
    }
