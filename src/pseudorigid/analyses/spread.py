"""How the Lyapunov exponents of many orbits spread, and how the spread shrinks with their length.

Orbits start uniformly over the whole section; the exponents decide which of them are chaotic. They
are kept as means over blocks; means over longer stretches follow from them. So one run gives the
long-run value, its error, and the distribution of the short runs that it is made of.
"""

import numpy as np
import xarray as xr

from ..dynamics.lyapunov import lyapunov_spectrum
from ..dynamics.variables import LENGTH, RADIUS, SPEED, chart, described
from ..kernel.arithmetic import log
from .sea import section_points

# Impacts of each orbit that are held in memory at once: 8 MB of 64 orbits.
_CHUNK = 4000


def spread(ball, energy, orbits, length, blocks, regular, regular_impacts, cells, visits):
    """Exponents of many orbits, block by block, and what part of the sea each chaotic one enters.

    Parameters
    ----------
    ball : Ball
    energy : float
        In m omega^2 R^2.
    orbits, length : int
        How many orbits, and how many impacts each has. They start uniformly over the section, in
        islands as well as in the sea.
    blocks : int
        Into how many equal blocks an orbit is divided.
    regular : sequence of float
        Starts of regular orbits on y = 0, in section radii.
    regular_impacts : int
        Their length; the exponents so far are kept at that number and its halves.
    cells : int
        The section's bounding rectangle has cells x cells cells.
    visits : int
        Impacts of each chaotic orbit of which the cells they are in are kept; counts at this
        number and its halves.

    Returns
    -------
    xarray.Dataset
        exponent (block, orbit, index): mean over a block, not over all blocks so far, nats an
        impact, in the order of `lyapunov_spectrum`. regular_exponent (length, island, index): over
        the first `length` impacts. entered_any, entered_all (visit): cells entered by at least one
        of the chaotic orbits, by each of them; entered_least: by the one that enters fewest.
        start_x, start_y (orbit), where y = xdot - k udot; regular_start (island); and the attribute
        block_impacts, the impacts of a block.

    Raises
    ------
    ValueError
        A length that is no multiple of blocks, no chaotic orbit, or a start beyond the section.

    References
    ----------
    Kanso and Papadopoulos, eq. (32), with the factor 1/i that it lacks.

    Examples
    --------
    >>> from pseudorigid import Ball
    >>> found = spread(Ball(k=0.2, g=0.04), 0.01, 5, 400, 4, [0.1], 4, 4, 4)
    >>> in_sea(found)
    array([ True,  True,  True,  True, False])
    """
    if length % blocks:
        raise ValueError(f"blocks = {blocks} is not allowed: length = {length} is no multiple")
    x, y = section_points(ball, energy, orbits)
    states = ball.state_xy(x, y, energy)
    so_far = lyapunov_spectrum(ball, states, length, blocks)["exponent"].values
    count = np.arange(1, blocks + 1)[:, None, None]
    sums = so_far * count
    block = np.concatenate([sums[:1], sums[1:] - sums[:-1]])
    chaotic = _chaotic(so_far[-1].max(axis=-1), length)
    if not chaotic.any():
        raise ValueError(f"orbits = {orbits} of {length} impacts is not allowed: none is chaotic")
    data = {
        "exponent": (("block", "orbit", "index"), block, "mean exponent of a block"),
        "start_x": ("orbit", x, "x of the start", LENGTH),
        "start_y": ("orbit", y, "y = xdot - k udot of the start", SPEED),
    }
    data |= _regular(ball, energy, np.asarray(regular, dtype=float), regular_impacts)
    data |= _entered(ball, energy, [a[chaotic] for a in states], cells, visits)
    return xr.Dataset(described(data), attrs={"block_impacts": length // blocks})


def regular_bound(length):
    """A bound that the exponents of regular orbits of so many impacts keep, 3 ln n/n.

    Their tangent vectors grow in proportion to the number of impacts.
    """
    return 3.0 * log(float(length)) / length


def _chaotic(exponent, length):
    """Which orbits of so many impacts are chaotic, by their largest exponents."""
    return exponent > regular_bound(length)


def in_sea(dataset):
    """Which of the orbits that start over the section are chaotic.

    Parameters
    ----------
    dataset : xarray.Dataset
        As from `spread`.

    Returns
    -------
    ndarray of bool, shape (orbits,)
        Those whose largest exponent exceeds `regular_bound`.
    """
    length = int(dataset.attrs["block_impacts"]) * dataset.sizes["block"]
    return _chaotic(dataset["exponent"].values.mean(axis=0).max(axis=-1), length)


def _halves(number):
    """number, number/2, ... above 0, in rising order."""
    return np.array([number >> i for i in reversed(range(int(number).bit_length()))])


def _regular(ball, energy, starts, impacts):
    lengths = _halves(impacts)
    states = ball.start(starts, energy)
    found = [lyapunov_spectrum(ball, states, int(n), 1)["exponent"].values[0] for n in lengths]
    return {
        "length": ("length", lengths, "number of impacts"),
        "regular_start": ("island", starts, "start along y = 0, in section radii", RADIUS),
        "regular_exponent": (("length", "island", "index"), found, "exponent of a regular orbit"),
    }


def _entered(ball, energy, states, cells, visits):
    """Counts of cells of the chart that orbits enter, at `visits` impacts and its halves."""
    centre, radius = ball.section(energy)
    high = np.sqrt(ball.k * (1.0 + ball.k)) * radius
    states = [a.copy() for a in states]
    seen = np.zeros((states[0].size, cells * cells), dtype=bool)
    lengths, done, counts = _halves(visits), 0, []
    for length in lengths.tolist():
        while done < length:
            out = np.empty((len(seen), min(_CHUNK, length - done), 4))
            ball.map.history(*states, ball.k, ball.g, out)
            done += out.shape[1]
            x, y = chart(ball.k, *np.moveaxis(out[..., :3], -1, 0))
            across, up = _cell((x - centre) / radius, cells), _cell(y / high, cells)
            for orbit, places in enumerate(up * cells + across):
                seen[orbit, places] = True
        each = seen.sum(axis=1)
        counts.append((int(seen.any(axis=0).sum()), int(seen.all(axis=0).sum()), int(each.min())))
    any_of, all_of, least = np.array(counts, dtype=np.int64).T
    return {
        "visit": ("visit", lengths, "number of impacts of each chaotic orbit"),
        "entered_any": ("visit", any_of, "cells entered by at least one chaotic orbit"),
        "entered_all": ("visit", all_of, "cells entered by each chaotic orbit"),
        "entered_least": ("visit", least, "cells entered by the chaotic orbit that enters fewest"),
    }


def _cell(place, cells):
    """The cell, 0 to cells - 1, of places between -1 and 1."""
    return np.clip((0.5 * (place + 1.0) * cells).astype(np.int64), 0, cells - 1)


def stretches(dataset, length):
    """The largest exponent of each stretch of `length` impacts of the chaotic orbits.

    Parameters
    ----------
    dataset : xarray.Dataset
        As from `spread`.
    length : int
        A multiple of its block_impacts.

    Returns
    -------
    ndarray, shape (stretches,)
        Nats an impact.
    """
    block = dataset["exponent"].values[:, in_sea(dataset)]
    count = length // int(dataset.attrs["block_impacts"])
    whole = block[: block.shape[0] // count * count]
    return whole.reshape(-1, count, *block.shape[1:]).mean(axis=1).max(axis=-1).ravel()
