"""Symmetric periodic orbits by one-dimensional root searches on the symmetry lines of the map.

Let P be the map and R the reversor, (x, y) -> (x, -y). A symmetric orbit of even period 2m starts
on Fix R (y = 0) and returns to it after m impacts, or does so on Fix RP. An orbit of odd period 2m
+ 1 starts on Fix R and is on Fix RP after m impacts. On Fix RP the flight that follows is symmetric
in time: b + g tau/2 = 0. `newton` searches for orbits without that symmetry.
"""

import math
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from typing import SupportsFloat, SupportsIndex

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from ..kernel.arithmetic import sincos_each
from ..kernel.formulas import impact_coefficients, rebound
from .ball import Ball, require_ball
from .inputs import number, whole_number
from .polish import polished
from .variables import NAMES, TIME, described, variables

Function = Callable[[np.ndarray], np.ndarray]
_Line = tuple[Function, np.ndarray, Callable[..., np.ndarray]]

# Cells into which a symmetry line is divided to find sign changes. For the paper's ball at energies
# 0.0017, 0.01 and 0.03, ten times as many cells show no further orbit of a period up to 12.
RESOLUTION = 20_000
# Distance in section radii below which two points are the same. The error of a solution is smaller,
# and the cells of the search are wider.
SAME = 1e-9
# An orbit is polished in decimals if derivatives of P^n at its points exceed MOST_GROWTH, because
# they multiply the error of a point, if its trace is closer to 2 than PARABOLIC, by which an error
# is divided, or if |P^n z - z| exceeds CLOSURE, in section radii: about fifty roundings.
MOST_GROWTH, PARABOLIC, CLOSURE = 50.0, 1e-3, 1e-14
# |P^n z - z|, in section radii, above which a sign change is a jump of the map. At a root between
# neighbouring doubles it is 1e-16 times the multiplier.
JUMP = 1e-6
NEWTON_STEPS = 5  # at those energies and periods no more than three helped


def symmetric_orbits(ball: Ball, energy: SupportsFloat, period: SupportsIndex) -> xr.Dataset:
    """Find all symmetric orbits of a prime period that the resolution of the search shows.

    Parameters
    ----------
    ball : Ball
    energy : float
        Above the lowest energy, -g^2/(2k).
    period : int
        Number of impacts, at least 1.

    Returns
    -------
    xarray.Dataset
        x, xdot, udot just before each impact on (orbit, point), in ascending order of the
        multiplier's modulus; tau, the time of flight from that point to the next (1/omega). On
        `orbit`: type, elliptic, hyperbolic or inverse hyperbolic; trace, of the Jacobian of P^n on
        the energy surface; multiplier, its eigenvalue of largest modulus, or the modulus, 1, of an
        elliptic orbit; rotation_number, the argument of the multiplier over 2 pi, 0 to 1/2;
        total_time, the sum of
        tau. `orbit` has length 0 if none is found. The first point lies on a symmetry line.
        Points, times and traces of orbits that are unstable (MOST_GROWTH) or almost parabolic are
        right to the last bit. Those of others are right to rounding times up to MOST_GROWTH and
        `1/|trace - 2|`; for periods up to 40 all tried were good to 2e-12 section radii and traces
        to 1e-12. Attributes: resolution, the number of cells of each line; unsolved, the number of
        orbits that were seen but on which Newton's method does not converge.

    Raises
    ------
    ValueError
        The energy is below the lowest one, or the period is below 1.

    References
    ----------
    R. De Vogelaere, On the structure of symmetric periodic solutions of conservative systems, in
    Contributions to the Theory of Nonlinear Oscillations IV (1958): one-dimensional searches on
    symmetry lines.

    Examples
    --------
    >>> from pseudorigid import Ball, symmetric_orbits
    >>> symmetric_orbits(Ball(k=0.2, g=0.04), 0.01, 6)["type"].values.tolist()
    ['elliptic', 'hyperbolic', 'inverse hyperbolic']
    """
    require_ball(ball)
    period, energy = whole_number("period", period), number("energy", energy)
    orbits = ((orbit, True) for orbit in distinct_orbits(ball, energy, period))
    return dataset_of(ball, energy, period, orbits)


def dataset_of(
    ball: Ball, energy: float, period: int, orbits: Iterable[tuple[np.ndarray, bool]]
) -> xr.Dataset:
    """Solve for orbits (4, period), each with whether it is symmetric, and return their dataset."""
    _, radius = ball.section(energy)
    solved, unsolved = [], 0
    for orbit, symmetric in orbits:
        # One of the three eigenvalues of the product of the Jacobians, eq. (33), is 1.
        x, xdot, udot, _ = orbit
        jacobians = ball.jacobian(x, xdot, udot, period)
        trace = float(np.trace(jacobians[0]) - 1.0)
        if np.max(np.abs(jacobians)) <= MOST_GROWTH and abs(trace - 2.0) >= PARABOLIC:
            first, gap = _closest(ball, energy, orbit[:3, 0], period)
            if gap <= CLOSURE * radius:
                solved.append((trace, _orbit_from(ball, first, period)))
                continue
        try:
            solved.append(polished(ball, energy, orbit, radius, symmetric))
        except ArithmeticError:
            unsolved += 1
    solved.sort(key=lambda orbit: (abs(_multiplier(orbit[0])), orbit[1][0, 0]))
    traces = np.array([trace for trace, _ in solved])
    points = np.array([orbit for _, orbit in solved]).reshape(len(solved), 4, period)
    types = np.where(traces > 0.0, "hyperbolic", "inverse hyperbolic").astype(object)
    types[np.abs(traces) < 2.0] = "elliptic"
    names = NAMES | {"tau": ("time of flight to the next point", TIME)}
    of_points = variables(("orbit", "point"), points.transpose(1, 0, 2), names)
    rotations = _rotation_number(traces)
    largest = "multiplier of largest modulus; the modulus, 1, of elliptic orbits"
    of_orbits = {
        "trace": ("orbit", traces, "trace of the Jacobian of P^n on the energy surface"),
        "multiplier": ("orbit", _multiplier(traces), largest),
        "rotation_number": ("orbit", rotations, "argument of the multiplier over 2 pi"),
        "total_time": ("orbit", points[:, 3].sum(axis=1), "sum of the times of flight", TIME),
        "type": ("orbit", types, "type of stability"),
    }
    attrs = {"k": ball.k, "g": ball.g, "energy": energy, "period": period}
    attrs |= {"resolution": RESOLUTION, "unsolved": unsolved}
    return xr.Dataset(of_points | described(of_orbits), attrs=attrs)


def distinct_orbits(ball: Ball, energy: float, period: int) -> Iterator[np.ndarray]:
    """Yield the points (4, period) of each orbit of this prime period on the symmetry lines."""
    _, radius = ball.section(energy)
    seen = np.empty((3, 0))
    for line in _lines(ball, energy, period):
        for state in _solutions(ball, line, period, radius):
            points = _orbit_from(ball, state, period)
            others = np.append(seen, points[:3, 1:], axis=1)
            if np.any(np.all(np.abs(points[:3, :1] - others) < SAME * radius, axis=0)):
                continue  # the orbit was seen before, or its prime period is a divisor
            seen = np.append(others, points[:3, :1], axis=1)
            yield points


def _lines(ball: Ball, energy: float, period: int) -> Iterator[_Line]:
    """Yield the symmetry lines on which orbits of a period are searched for.

    A line has a function from parameters (n,) to states (3, n), the parameters to search, and the
    defect of states, which is 0 for an orbit after half of its impacts.
    """
    centre, radius = ball.section(energy)
    k, g = ball.k, ball.g

    def on_r(q: np.ndarray) -> np.ndarray:
        # A rational parametrization of the circle resolves its ends, where s = 0.
        udot = radius * ((1.0 - q) * (1.0 + q) / (1.0 + q * q)) / np.sqrt(1.0 + k)
        return np.stack((centre + radius * (2.0 * q / (1.0 + q * q)), k * udot, udot))

    def off_rp(*state: np.ndarray) -> np.ndarray:
        """Return b + g tau/2, which is 0 on Fix RP, where a flight is symmetric."""
        _, after, _, tau = ball.impact(*state)
        return np.asarray(after - 0.5 * g * tau)

    # The rim is left out, because a ball there is at rest.
    inside = (2.0 * np.arange(RESOLUTION) + 1.0) / RESOLUTION - 1.0
    if period % 2:
        yield on_r, inside, off_rp
        return
    yield on_r, inside, lambda x, xdot, udot: xdot - k * udot  # y is 0 on Fix R
    longest = radius * np.sqrt(k) / g
    for sign in (1.0, -1.0):
        on_rp = partial(symmetric_flights, ball, energy, sign)
        yield on_rp, longest * np.arange(1, RESOLUTION + 1) / RESOLUTION, off_rp


def symmetric_flights(ball: Ball, energy: float, sign: float, theta: np.ndarray) -> np.ndarray:
    """Return states (3, n) whose flights of lengths 2 theta (n,) are symmetric, on Fix RP.

    There b = -g theta, x = a cos theta, c = -a sin theta, and E = g^2 theta^2/2 + k a^2/2 - g a cos
    theta, of which `sign` selects a root a. A state is NaN if there is no root, if it is off the
    section or if the floor ends the flight before.
    """
    k, g = ball.k, ball.g
    sine, cosine = sincos_each(theta)
    square = g * g * cosine * cosine + k * (2.0 * energy - g * g * theta * theta)
    a = (g * cosine + sign * np.sqrt(np.where(square >= 0.0, square, np.nan))) / k
    xdot, udot, _ = rebound(-g * theta, -a * sine, k, impact_coefficients(k))
    state = np.where(xdot + udot >= 0.0, (a * cosine, xdot, udot), np.nan)
    tau = ball.time_to_impact(*state)
    # Where an impact grazes, tau is good to 1e-8.
    return np.where(np.abs(tau - 2.0 * theta) <= 1e-7 * (1.0 + theta), state, np.nan)


def _solutions(ball: Ball, line: _Line, period: int, radius: float) -> Iterator[np.ndarray]:
    """Yield the states on one symmetry line that return after `period` impacts."""
    states_at, parameters, defect = line

    def defect_halfway(parameters: np.ndarray) -> np.ndarray:
        return defect(*ball.after(states_at(parameters), period // 2)[:3])

    states = states_at(np.concatenate(_sign_changes(defect_halfway, parameters)))
    _, gaps = _gaps(ball, states, period)
    states, gaps = states.reshape(3, 2, -1), gaps.reshape(2, -1)
    for root in range(gaps.shape[1]):
        if np.min(gaps[:, root]) < JUMP * radius:  # a jump changes the sign, but does not close
            yield states[:, np.argmin(gaps[:, root]), root]


def _sign_changes(value: Function, parameters: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the ends, neighbouring doubles, of sign changes of `value`, NaN off the line."""
    on_line = ~np.isnan(value(parameters))
    low, high = parameters[:-1].copy(), parameters[1:].copy()
    # Where a line ends between two parameters, its last point replaces the parameter beyond it.
    (leaves,) = np.nonzero(on_line[:-1] & ~on_line[1:])
    high[leaves] = _bisected(low[leaves], high[leaves], lambda p: ~np.isnan(value(p)))[0]
    (enters,) = np.nonzero(~on_line[:-1] & on_line[1:])
    low[enters] = _bisected(low[enters], high[enters], lambda p: np.isnan(value(p)))[1]
    at_low = value(low)
    change = at_low * value(high) <= 0.0
    at_low = at_low[change]
    return _bisected(low[change], high[change], lambda p: at_low * value(p) > 0.0)


def _bisected(
    low: np.ndarray, high: np.ndarray, goes_right: Function
) -> tuple[np.ndarray, np.ndarray]:
    """Return intervals (n,), bisected to neighbouring doubles; goes_right(middle) picks halves."""
    while True:
        middle = 0.5 * (low + high)
        if np.all((middle == low) | (middle == high)):
            return low, high
        right = goes_right(middle)
        low, high = np.where(right, middle, low), np.where(right, high, middle)


def _gaps(ball: Ball, states: np.ndarray, period: int) -> tuple[np.ndarray, np.ndarray]:
    """Return P^n z, and the largest coordinate of P^n z - z (n,), for states z (3, n)."""
    after = ball.after(states, period)[:3]
    return after, np.max(np.abs(after - states), axis=0)


def _closest(ball: Ball, energy: float, state: np.ndarray, period: int) -> tuple[np.ndarray, float]:
    """Return the state nearby from which an orbit closes best, and the gap that it leaves."""
    best, least = state, np.inf
    for _ in range(NEWTON_STEPS):
        after, gap = _gaps(ball, state[:, None], period)
        if not gap[0] < least:
            break
        best, least = state, gap[0]
        x, xdot, udot = state
        (a, b), (c, d) = ball.chart_jacobian(x, xdot, udot, period)
        y = xdot - ball.k * udot
        fx, fy = after[0, 0] - x, (after[1, 0] - ball.k * after[2, 0]) - y
        determinant = (a - 1.0) * (d - 1.0) - b * c
        if determinant == 0.0:
            break
        dx = (b * fy - (d - 1.0) * fx) / determinant
        dy = (c * fx - (a - 1.0) * fy) / determinant
        try:
            state = np.stack(ball.state_xy(x + dx, y + dy, energy))
        except ValueError:  # off the section
            break
    # The closest of the doubles around it.
    steps = np.indices((5, 5, 5)).reshape(3, -1) - 2
    neighbours = best[:, None] + steps * np.spacing(best)[:, None]
    neighbours = neighbours[:, neighbours[1] + neighbours[2] >= 0.0]
    _, gaps = _gaps(ball, neighbours, period)
    return neighbours[:, np.argmin(gaps)], float(np.min(gaps))


def _orbit_from(ball: Ball, state: np.ndarray, period: int) -> np.ndarray:
    """Return x, xdot, udot and the time of the next flight (4, period) along an orbit."""
    after = ball.history(state, period)[0].T
    return np.vstack((np.column_stack((state, after[:3, :-1])), after[3]))


def _multiplier(trace: ArrayLike) -> np.ndarray:
    """Return the eigenvalue of largest modulus at determinant 1, or the modulus, 1, if complex."""
    size = np.maximum(np.abs(trace), 2.0)
    root = np.sqrt((size - 2.0) * (size + 2.0))
    return np.where(size > 2.0, np.copysign(0.5 * (size + root), trace), 1.0)


def _rotation_number(traces: np.ndarray) -> np.ndarray:
    """Return arccos(trace/2)/(2 pi), by bisection on `sincos` for reproducible bits."""
    low, high = np.zeros(traces.size), np.full(traces.size, 0.5)
    turn = 2.0 * math.pi
    low, high = _bisected(low, high, lambda part: 2.0 * sincos_each(turn * part)[1] > traces)
    return np.where(traces <= -2.0, 0.5, 0.5 * (low + high))
