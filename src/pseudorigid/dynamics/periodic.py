"""Symmetric periodic orbits by one-dimensional root searches on the symmetry lines of the map.

Let P be the map and R the reversor, (x, y) -> (x, -y). A symmetric orbit of even period 2m starts
on Fix R (y = 0) and returns to it after m impacts, or does so on Fix RP. An orbit of odd period 2m
+ 1 starts on Fix R and is on Fix RP after m impacts. On Fix RP the flight that follows is symmetric
in time: b + g tau/2 = 0. `newton` searches for orbits without that symmetry.

Each symmetric orbit has two points on these lines. The search finds them one by one, so that their
count says how complete it is. Fixed points are in closed form, with tau = 2 theta.
"""

import math
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from typing import SupportsFloat, SupportsIndex

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from ..kernel import formulas
from ..kernel.arithmetic import sincos_each
from ..kernel.formulas import impact_coefficients, rebound
from .ball import Ball, require_ball
from .inputs import number, whole_number
from .polish import polished
from .variables import NAMES, TIME, described, variables

Function = Callable[[np.ndarray], np.ndarray]
_Line = tuple[Function, np.ndarray, Callable[..., np.ndarray], int]

# Cells into which a symmetry line is divided to find sign changes. A cell is then halved, up to
# HALVINGS times and to MOST_CELLS in all, until its image after half of the impacts is shorter than
# FINE, in section radii.
RESOLUTION, HALVINGS, MOST_CELLS, FINE = 20_000, 8, 500_000, 0.03
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

    Fixed points, of period 1, are complete. Of longer periods, orbits may be missing where images
    of a symmetry line are so long that both points of an orbit on these lines lie within cells of
    the search; `line_points_seen` tells.

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
        orbits that were seen but on which Newton's method does not converge; line_points_seen, the
        share of the orbits' points on symmetry lines, two each, that the search found one by one.

    Raises
    ------
    ValueError
        The energy is not within `ball.energy_bounds()`, or the period is below 1.

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
    orbits, seen = distinct_orbits(ball, energy, period)
    return dataset_of(ball, energy, period, [(orbit, True) for orbit in orbits], seen)


def dataset_of(
    ball: Ball,
    energy: float,
    period: int,
    orbits: Iterable[tuple[np.ndarray, bool]],
    seen: float,
) -> xr.Dataset:
    """Solve for orbits (4, period), each with whether it is symmetric, and return their dataset.

    `seen` is the share of the points of symmetric orbits on symmetry lines that the search found.
    """
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
    attrs |= {"resolution": RESOLUTION, "unsolved": unsolved, "line_points_seen": seen}
    return xr.Dataset(of_points | described(of_orbits), attrs=attrs)


def distinct_orbits(ball: Ball, energy: float, period: int) -> tuple[list[np.ndarray], float]:
    """Return the points (4, period) of each orbit of this prime period on the symmetry lines.

    Also returned is the share of their points on these lines that were found one by one.
    """
    _, radius = ball.section(energy)
    orbits: list[np.ndarray] = []
    seen, owners = np.empty((3, 0)), np.empty((2, 0), dtype=np.int64)  # orbit and index of a point
    found = set[tuple[int, int]]()
    for state in _line_points(ball, energy, period):
        points = _orbit_from(ball, state, period)
        if np.any(_are_near(points[:3, :1], points[:3, 1:], radius)):
            continue  # the prime period is a divisor
        near = _are_near(points[:3, :1], seen, radius)
        if near.any():
            found.add((*owners[:, np.argmax(near)].tolist(),))
            continue
        found.add((len(orbits), 0))
        indices = np.stack((np.full(period, len(orbits)), np.arange(period)))
        seen, owners = np.append(seen, points[:3], axis=1), np.append(owners, indices, axis=1)
        orbits.append(points)
    return orbits, len(found) / (len(orbits) * min(period, 2)) if orbits else 1.0


def _are_near(point: np.ndarray, others: np.ndarray, radius: float) -> np.ndarray:
    """Return which points (3, n) are the same as a point (3, 1)."""
    return np.asarray(np.all(np.abs(point - others) < SAME * radius, axis=0))


def _line_points(ball: Ball, energy: float, period: int) -> Iterator[np.ndarray]:
    """Yield the states on symmetry lines that return after `period` impacts."""
    _, radius = ball.section(energy)
    for line in _lines(ball, energy, period):
        yield from _solutions(ball, line, period, radius)
    if period == 1:
        yield from fixed_points(ball, energy).T


def fixed_points(ball: Ball, energy: float) -> np.ndarray:
    """Return the states (3, n) of all fixed points of the map.

    With the formulas of `fixed_point`, energies of fixed points fall and rise once between
    multiples of pi of theta = tau/2. A root beyond pi counts if no earlier impact ends the flight.
    """
    k, e = ball.k, energy / (ball.g * ball.g)
    longest = math.sqrt((2.0 * k * e + 1.0) / (1.0 + k))  # E is larger beyond this theta
    ends = math.pi * np.arange(int(longest / math.pi) + 2)

    def rest_and_slope(theta: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return 1 - theta cot(theta) and its derivative."""
        sine, cosine = sincos_each(theta)
        return 1.0 - theta * cosine / sine, (theta / sine - cosine) / sine

    def falls(theta: np.ndarray) -> np.ndarray:
        rest, slope = rest_and_slope(theta)
        return np.asarray((1.0 + k) * theta + rest * slope < 0.0)

    def is_below(theta: np.ndarray) -> np.ndarray:
        rest, _ = rest_and_slope(theta)
        return np.asarray((1.0 + k) * theta * theta + rest * rest - 1.0 < 2.0 * k * e)

    with np.errstate(all="ignore"):
        lowest, _ = _bisected(ends[:-1], ends[1:], falls)
        rising = _bisected(lowest, ends[1:], is_below)[0]
        falling = _bisected(ends[:-1], lowest, lambda theta: ~is_below(theta))[1]
        theta = np.concatenate((rising, falling))
        x = ball.g / k * (1.0 - rest_and_slope(theta)[0])
        states = np.stack(formulas.chart_state(k, ball.g, energy, x, 0.0))
    states = states[:, np.isfinite(states).all(axis=0)]
    _, gaps = _gaps(ball, states, 1)
    return states[:, gaps < JUMP * ball.section(energy)[1]]


def _refined(ball: Ball, line: _Line, radius: float) -> np.ndarray:
    """Return the parameters of a line, and more where its image is stretched.

    Cells are halved as in a bisection, so that this does not change the bits of a solution.
    """
    states_at, parameters, defect, impacts = line

    def ends(parameters: np.ndarray) -> np.ndarray:
        image = ball.after(states_at(parameters), impacts)[:3]
        return np.vstack((image, defect(*image)))

    found = ends(parameters)
    for _ in range(HALVINGS):
        # A comparison with NaN, off the line, is false.
        wide = np.max(np.abs(found[:, 1:] - found[:, :-1]), axis=0) > FINE * radius
        if not wide.any() or parameters.size > MOST_CELLS:
            break
        at = np.flatnonzero(wide) + 1
        middle = 0.5 * (parameters[at - 1] + parameters[at])
        found = np.insert(found, at, ends(middle), axis=1)
        parameters = np.insert(parameters, at, middle)
    return parameters


def _lines(ball: Ball, energy: float, period: int) -> Iterator[_Line]:
    """Yield the symmetry lines on which orbits of a period are searched for.

    A line has a function from parameters (n,) to states (3, n), the parameters to search, the
    defect of states, which is 0 for an orbit after half of its impacts, and their number.
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
    half, odd = divmod(period, 2)

    def off_r(x: np.ndarray, xdot: np.ndarray, udot: np.ndarray) -> np.ndarray:
        return np.asarray(xdot - k * udot)  # y is 0 on Fix R

    yield on_r, inside, off_rp if odd else off_r, half
    if period == 1:
        return
    longest = radius * np.sqrt(k) / g
    for sign in (1.0, -1.0):
        on_rp = partial(symmetric_flights, ball, energy, sign)
        thetas = longest * np.arange(1, RESOLUTION + 1) / RESOLUTION
        yield on_rp, thetas, off_r if odd else off_rp, half + odd


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
    states_at, _, defect, impacts = line

    def defect_halfway(parameters: np.ndarray) -> np.ndarray:
        return defect(*ball.after(states_at(parameters), impacts)[:3])

    states = states_at(np.concatenate(_sign_changes(defect_halfway, _refined(ball, line, radius))))
    _, gaps = _gaps(ball, states, period)
    states, gaps = states.reshape(3, 2, -1), gaps.reshape(2, -1)
    for root in range(gaps.shape[1]):
        if np.min(gaps[:, root]) < JUMP * radius:  # a jump changes the sign, but does not close
            yield states[:, np.argmin(gaps[:, root]), root]


def _sign_changes(value: Function, parameters: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the ends, neighbouring doubles, of sign changes of `value`, NaN off the line."""
    found = value(parameters)
    low, high, at_low, at_high = (
        a.copy() for a in (parameters[:-1], parameters[1:], found[:-1], found[1:])
    )
    # Where a line ends between two parameters, its last point replaces the parameter beyond it.
    enters, leaves = np.isnan(at_low), np.isnan(at_high)
    (ends,) = np.nonzero(enters != leaves)
    if ends.size:
        enter = enters[ends]
        on, off = _bisected(low[ends], high[ends], lambda p: np.isnan(value(p)) == enter)
        low[ends], high[ends] = np.where(enter, off, low[ends]), np.where(enter, high[ends], on)
        at_low[ends], at_high[ends] = value(low[ends]), value(high[ends])
    change = at_low * at_high <= 0.0
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
