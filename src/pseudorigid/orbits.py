"""Orbits of the impact map: impact by impact, the starts of a scene, and the motion in time
between impacts.
"""

import itertools

import numpy as np
import xarray as xr

from . import impact as kernel
from .arithmetic import sincos
from .ball import whole_number
from .compiled import jit

NAMES = {
    "x": "position at impact, downwards",
    "xdot": "velocity of the mass centre just before impact",
    "udot": "strain rate just before impact",
    "tau": "time of flight since the previous impact",
}
# Samples a flight is drawn with: at Figure 3's scale the chord of 1/200 of a flight is off by 1e-5.
SAMPLES = 200


def variables(dims, values, names=NAMES):
    """Dataset variables from arrays: {name: (dims, array, attributes)}."""
    return {
        name: (dims, array, {"long_name": names[name], "units": "1"})
        for name, array in zip(names, values, strict=True)
    }


def orbit_dims(shape):
    """The dims of many orbits: `orbit`, or of more than one dimension `orbit_0`, `orbit_1`, ..."""
    return ("orbit",) if len(shape) == 1 else tuple(f"orbit_{i}" for i in range(len(shape)))


def orbit(ball, state, impacts, keep="all"):
    """The orbit of a state, or of many, under the impact map, eq. (28).

    Args:
        ball: a Ball.
        state: (x, xdot, udot) just before an impact, scalars or arrays that broadcast.
        impacts: how many impacts, at least 1.
        keep: "all", or "last" for the final state alone, in memory that does not grow with
        `impacts`.

    Returns:
        Dataset of x, xdot, udot, tau, dims (impact, ...): one entry an impact, the start excluded;
        tau is the flight that ends there. A state of one dimension has the dim `orbit`, of more
        `orbit_0`, ... With keep="last" there is no dim `impact`.

    Raises:
        ValueError: a state with xdot + udot < 0, impacts < 1, or another `keep`.
    """
    if keep not in ("all", "last"):
        raise ValueError(f"keep = {keep!r} is not allowed: 'all' or 'last'")
    impacts = whole_number("impacts", impacts)
    state = ball.on_section(*state)
    shape = state[0].shape
    dims = orbit_dims(shape)
    columns = [a.flatten() for a in state]
    if keep == "last":
        tau = np.empty(columns[0].size)
        ball.map.steps(*columns, ball.k, ball.g, impacts, tau)
        values = [a.reshape(shape) for a in (*columns, tau)]
        return xr.Dataset(variables(dims, values), coords={"impact": impacts})
    out = np.empty((columns[0].size, impacts, 4))
    ball.map.history(*columns, ball.k, ball.g, out)
    values = [a.reshape(impacts, *shape) for a in out.T]
    return xr.Dataset(
        variables(("impact", *dims), values), coords={"impact": np.arange(1, impacts + 1)}
    )


def scene_orbits(ball, energy, starts, impacts):
    """The orbits of a scene, one after the other in a contiguous ragged array (CF).

    Args:
        energy: the energy of all of them.
        starts: fractions of the section's radius along y = 0.
        impacts: how many impacts of each.

    Returns:
        Dataset of x, xdot, udot, tau on `point`; start and row_size on `orbit`.
    """
    pieces = []
    for start, count in zip(starts, impacts, strict=True):
        out = np.empty((1, count, 4))
        ball.map.history(*(np.array([a]) for a in ball.start(start, energy)), ball.k, ball.g, out)
        pieces.append(out[0].T)
    data = variables("point", np.concatenate(pieces, axis=1))
    data["start"] = (
        "orbit",
        np.asarray(starts, dtype=float),
        {"long_name": "start along y = 0, in section radii from the centre", "units": "1"},
    )
    data["row_size"] = (
        "orbit",
        np.asarray(impacts, dtype=np.int64),
        {"long_name": "number of impacts", "units": "1", "sample_dimension": "point"},
    )
    return xr.Dataset(data)


@jit
def _flight_samples(x, b, c, g, t, position, strain):
    for i in range(t.size):
        sine, cosine = sincos(t[i])
        position[i] = x + t[i] * (b + 0.5 * g * t[i])
        strain[i] = c * sine - x * cosine


def _flights(ball, orbit):
    """(x, xdot, udot, tau) of one flight after the other from a periodic orbit's first point."""
    columns = (orbit[name].values.tolist() for name in ("x", "xdot", "udot", "tau"))
    points = list(zip(*columns, strict=True))
    if ball.scan is None:
        yield from itertools.cycle(points)
    *state, _ = points[0]
    while True:
        *after, tau = ball.impact(*state)
        yield (*state, tau)
        state = after


def motion(ball, orbit, duration):
    """x(t) and u(t), eq. (26), along a periodic orbit from an impact at t = 0.

    The orbit's own points are repeated; a scan.ScannedBall follows its first one impact by impact.

    Args:
        orbit: Dataset of one orbit with x, xdot, udot, tau on `point`, as from periodic.of_type.
        duration: the length of time.

    Returns:
        Dataset of t, position (x) and strain (u) on `sample`, both ends of each flight included,
        where position = -strain exactly; impact_t and impact_position on `impact`.
    """
    flights = _flights(ball, orbit)
    following = next(flights)
    head, low = kernel.transfer(ball.k)
    columns = [[], [], []]
    impacts = [[], []]
    time = 0.0
    while time <= duration:
        (x, xdot, udot, tau), following = following, next(flights)
        impacts[0].append(time)
        impacts[1].append(x)
        b, c, _ = kernel.rebound(xdot, udot, ball.k, head, low)
        t = tau * (np.arange(SAMPLES + 1) / SAMPLES)
        t = np.append(t[time + t < duration], duration - time) if time + tau > duration else t
        position = np.empty(t.size)
        strain = np.empty(t.size)
        _flight_samples(x, b, c, ball.g, t, position, strain)
        position[0], strain[0] = x, -x
        if time + tau <= duration:
            end = following[0]
            position[-1], strain[-1] = end, -end
        for column, values in zip(columns, (time + t, position, strain), strict=True):
            column.append(values)
        time += tau
    names = {"t": "time", "position": "position of the mass centre, downwards", "strain": "strain"}
    data = variables("sample", [np.concatenate(c) for c in columns], names)
    names = {"impact_t": "time of impact", "impact_position": "position at impact, downwards"}
    return xr.Dataset(data | variables("impact", [np.array(c) for c in impacts], names))
