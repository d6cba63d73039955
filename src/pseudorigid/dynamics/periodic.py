"""Symmetric periodic orbits: one-dimensional root searches on the symmetry lines of the map.

With the reversor R, (x, y) -> (x, -y), and the map P, a symmetric orbit of even period 2m starts on
Fix R (y = 0) and is back there after m impacts, or does so on Fix RP; one of odd period 2m + 1
starts on Fix R and is on Fix RP after m impacts. On Fix RP the flight that follows is symmetric in
time: b + g tau/2 = 0. Orbits without that symmetry are not looked for.
"""

from itertools import product

import numpy as np
import xarray as xr

from ..kernel.arithmetic import sincos_each
from ..kernel.impact_law import impact_coefficients, rebound
from .inputs import number, whole_number
from .variables import NAMES, TIME, variables

# Cells into which a symmetry line is divided; each sign change between neighbours is followed. Of
# periods up to 12 of the paper's ball, at energies 0.0017, 0.01 and 0.03, ten times as many cells
# show no further orbit.
RESOLUTION = 20_000
# Two points nearer than this, in section radii, are one: a solution's error is smaller, the cells
# of the search are wider.
SAME = 1e-9
TURN = float.fromhex("0x1.921fb54442d18p+2")  # 2 pi
# Largest |P^n z - z| of a solution in section radii, some fifty units of rounding; times
# |multiplier|/50 where that is larger, since the error of z is multiplied by it.
CLOSURE = 1e-14
# A sign change that leaves more than this, in section radii, is a jump of the map: those of a root
# between neighbouring doubles leave 1e-16 times the multiplier.
JUMP = 1e-6
NEWTON_STEPS = 5  # three were the most that helped, over those energies and periods


def symmetric_orbits(ball, energy, period):
    """All symmetric orbits of a prime period that the resolution of the search shows.

    Parameters
    ----------
    ball : Ball
    energy : float
        Above the lowest energy, -g^2/(2k).
    period : int
        The number of impacts, at least 1.

    Returns
    -------
    xarray.Dataset
        On (orbit, point), the orbits in the order of |multiplier|: x, xdot, udot just before each
        impact, tau the flight from that point to the next (1/omega). On orbit: type, elliptic,
        hyperbolic or inverse hyperbolic; trace, of the Jacobian of P^n on the energy surface;
        multiplier, its eigenvalue of largest modulus, for an elliptic orbit that modulus, 1;
        rotation_number, the argument of the multiplier over 2 pi, 0 to 1/2; total_time, the sum of
        tau. Length 0 where none is found. The first point lies on a symmetry line, unless the orbit
        is too sensitive there to be closed. Attribute resolution: the cells of each line; unsolved:
        how many orbits were seen, but close to no better than CLOSURE allows.

    Raises
    ------
    ValueError
        An energy below the bound or a period below 1.

    References
    ----------
    R. De Vogelaere, On the structure of symmetric periodic solutions of conservative systems, in
    Contributions to the Theory of Nonlinear Oscillations IV (1958): one-dimensional searches on
    symmetry lines.

    Examples
    --------
    >>> from pseudorigid import Ball
    >>> symmetric_orbits(Ball(k=0.2, g=0.04), 0.01, 6)["type"].values.tolist()
    ['elliptic', 'hyperbolic', 'inverse hyperbolic']
    """
    period, energy = whole_number("period", period), number("energy", energy)
    _, radius = ball.section(energy)
    seen, orbits, found = _Points(SAME * radius), 0, []
    for line in _lines(ball, energy, period):
        for state in _solutions(ball, line, period, radius):
            points = _follow(ball, state, period)
            if seen.has(points[:3, 0]):
                continue
            if np.any(np.all(np.abs(points[:3, :1] - points[:3, 1:]) < SAME * radius, axis=0)):
                continue  # its prime period is a divisor
            seen.add(points[:3])
            orbits += 1
            # the third eigenvalue of eq. (33)'s product is 1
            trace = float(np.trace(ball.jacobian(*points[:3, 0], impacts=period)) - 1.0)
            limit = CLOSURE * radius * max(1.0, abs(_multiplier(trace)) / 50.0)
            # Where the orbit is too sensitive at its first point, another one serves as the first.
            nearest = (_closest(ball, energy, point, period) for point in points[:3].T)
            first = next((state for state, gap in nearest if gap <= limit), None)
            if first is not None:
                found.append((trace, _follow(ball, first, period)))
    found.sort(key=lambda orbit: (abs(_multiplier(orbit[0])), orbit[1][0, 0]))
    points = np.array([p for _, p in found]).reshape(len(found), 4, period)
    names = NAMES | {"tau": ("time of flight to the next point", TIME)}
    data = variables(("orbit", "point"), points.transpose(1, 0, 2), names)
    attrs = {"k": ball.k, "g": ball.g, "energy": float(energy), "period": period}
    attrs |= {"resolution": RESOLUTION, "unsolved": orbits - len(found)}
    return xr.Dataset(data | _stability(np.array([t for t, _ in found]), points[:, 3]), attrs=attrs)


class _Points:
    """Points of space, kept in boxes of the size `near`, so that a neighbour is found at once."""

    def __init__(self, near):
        self.near, self.boxes = near, {}

    def add(self, points):
        """Add points (3, n)."""
        for point in points.T.tolist():
            self.boxes.setdefault(self._box(point), []).append(point)

    def has(self, point):
        """Whether a point is nearer than `near` in every coordinate."""
        i, j, k = self._box(point)
        for box in product((i - 1, i, i + 1), (j - 1, j, j + 1), (k - 1, k, k + 1)):
            for other in self.boxes.get(box, ()):
                if max(abs(a - b) for a, b in zip(point, other, strict=True)) < self.near:
                    return True
        return False

    def _box(self, point):
        return tuple(int(value / self.near // 1.0) for value in point)


def _stability(traces, tau):
    """Variables on `orbit` from the traces (n,) and the flights (n, period)."""
    kinds = np.where(traces > 0.0, "hyperbolic", "inverse hyperbolic").astype(object)
    kinds[np.abs(traces) < 2.0] = "elliptic"
    names = {
        "trace": "trace of the Jacobian of P^n on the energy surface",
        "multiplier": "multiplier of largest modulus; the modulus, 1, of elliptic orbits",
        "rotation_number": "argument of the multiplier over 2 pi",
        "total_time": ("sum of the times of flight", TIME),
    }
    values = traces, _multiplier(traces), _rotation_number(traces), tau.sum(axis=1)
    return variables("orbit", values, names) | {
        "type": ("orbit", kinds, {"long_name": "type of stability"})
    }


def _lines(ball, energy, period):
    """(start, parameters, defect) of each search: states along a line, what is 0 at an orbit."""
    centre, radius = ball.section(energy)
    k, g = ball.k, ball.g

    def on_r(q):
        # a rational parameter of the circle, which resolves its ends, where s = 0, as well
        udot = radius * ((1.0 - q) * (1.0 + q) / (1.0 + q * q)) / np.sqrt(1.0 + k)
        return np.stack((centre + radius * (2.0 * q / (1.0 + q * q)), k * udot, udot))

    def symmetric_flight(x, xdot, udot):
        """b + g tau/2, 0 on Fix RP."""
        _, after, _, tau = ball.impact(x, xdot, udot)
        return after - 0.5 * g * tau

    # the rim itself is at rest and no orbit
    inside = (2.0 * np.arange(RESOLUTION) + 1.0) / RESOLUTION - 1.0
    if period % 2:
        yield on_r, inside, symmetric_flight
        return
    yield on_r, inside, lambda x, xdot, udot: xdot - k * udot  # y, 0 on Fix R
    # A symmetric flight of length 2 theta: b = -g theta, x = a cos theta, c = -a sin theta, and a
    # from E = g^2 theta^2/2 + k a^2/2 - g a cos theta.
    longest = radius * np.sqrt(k) / g
    for sign in (1.0, -1.0):

        def on_rp(theta, sign=sign):
            sine, cosine = sincos_each(theta)
            square = g * g * cosine * cosine + k * (2.0 * energy - g * g * theta * theta)
            a = (g * cosine + sign * np.sqrt(np.where(square >= 0.0, square, np.nan))) / k
            xdot, udot, _ = rebound(-g * theta, -a * sine, k, impact_coefficients(k))
            state = np.where(xdot + udot >= 0.0, (a * cosine, xdot, udot), np.nan)
            tau = ball.time_to_impact(*state)
            # no earlier impact has ended the flight; where it grazes tau is good to 1e-8
            return np.where(np.abs(tau - 2.0 * theta) <= 1e-7 * (1.0 + theta), state, np.nan)

        yield on_rp, longest * np.arange(1, RESOLUTION + 1) / RESOLUTION, symmetric_flight


def _solutions(ball, line, period, radius):
    """States on one symmetry line that are back after `period` impacts, jumps left out."""
    start, parameters, defect = line

    def value(p):
        state = start(p)
        ball.map.steps(*state, ball.k, ball.g, period // 2, np.empty(p.size))
        return defect(*state)

    ends = np.concatenate(_sign_changes(value, parameters))
    states = start(ends)
    _, gaps = _gaps(ball, states, period)
    states, gaps = states.reshape(3, 2, -1), gaps.reshape(2, -1)
    for root in range(gaps.shape[1]):
        if np.min(gaps[:, root]) < JUMP * radius:  # a jump changes sign too, but does not close
            yield states[:, np.argmin(gaps[:, root]), root]


def _sign_changes(value, parameters):
    """(low, high): the ends, neighbouring doubles, of each sign change of `value`.

    It takes arrays (n,) and is NaN beyond the ends of a line.
    """
    there = ~np.isnan(value(parameters))
    low, high = parameters[:-1].copy(), parameters[1:].copy()
    # Where a line ends between two parameters, the last point on it takes the place of the one
    # beyond.
    (leaves,) = np.nonzero(there[:-1] & ~there[1:])
    high[leaves] = _halve(low[leaves], high[leaves], lambda p: ~np.isnan(value(p)))[0]
    (enters,) = np.nonzero(~there[:-1] & there[1:])
    low[enters] = _halve(low[enters], high[enters], lambda p: np.isnan(value(p)))[1]
    at_low = value(low)
    change = at_low * value(high) <= 0.0
    at_low = at_low[change]
    return _halve(low[change], high[change], lambda p: at_low * value(p) > 0.0)


def _halve(low, high, goes_right):
    """Bisection of intervals (n,) down to neighbouring doubles; goes_right(middle) is boolean."""
    while True:
        middle = 0.5 * (low + high)
        if np.all((middle == low) | (middle == high)):
            return low, high
        right = goes_right(middle)
        low, high = np.where(right, middle, low), np.where(right, high, middle)


def _gaps(ball, states, period):
    """P^n z and the largest coordinate of P^n z - z, (n,), for states z (3, n)."""
    after = states.copy()
    ball.map.steps(*after, ball.k, ball.g, period, np.empty(states.shape[1]))
    return after, np.max(np.abs(after - states), axis=0)


def _closest(ball, energy, state, period):
    """(state, gap) of an orbit next to `state`, to the last bit.

    Newton steps on P^n z = z in the chart, while they close better; then, of the doubles up to two
    units in the last place away, the one that closes best.
    """
    best, least = state, np.inf
    for _ in range(NEWTON_STEPS):
        after, gap = _gaps(ball, state[:, None], period)
        if not gap[0] < least:
            break
        best, least = state, gap[0]
        (a, b), (c, d) = ball.chart_jacobian(*state, impacts=period)
        y = state[1] - ball.k * state[2]
        fx, fy = after[0, 0] - state[0], (after[1, 0] - ball.k * after[2, 0]) - y
        determinant = (a - 1.0) * (d - 1.0) - b * c
        if determinant == 0.0:
            break
        dx = (b * fy - (d - 1.0) * fx) / determinant
        dy = (c * fx - (a - 1.0) * fy) / determinant
        try:
            state = np.stack(ball.state_xy(state[0] + dx, y + dy, energy))
        except ValueError:  # off the section
            break
    shift = np.indices((5, 5, 5)).reshape(3, -1) - 2
    near = best[:, None] + shift * np.spacing(best)[:, None]
    near = near[:, near[1] + near[2] >= 0.0]
    _, gaps = _gaps(ball, near, period)
    return near[:, np.argmin(gaps)], np.min(gaps)


def _follow(ball, state, period):
    """x, xdot, udot and the flight that follows, (4, period), along the orbit from `state` on."""
    out = np.empty((1, period, 4))
    ball.map.history(*(np.array([a]) for a in state), ball.k, ball.g, out)
    after = out[0].T
    return np.vstack((np.column_stack((state, after[:3, :-1])), after[3]))


def _multiplier(trace):
    """The eigenvalue of largest modulus at determinant 1; where it is complex the modulus, 1."""
    size = np.maximum(np.abs(trace), 2.0)
    root = np.sqrt((size - 2.0) * (size + 2.0))
    return np.where(size > 2.0, np.copysign(0.5 * (size + root), trace), 1.0)


def _rotation_number(traces):
    """arccos(trace/2)/(2 pi) by bisection on our own cosine: the same bits on every machine."""
    low, high = np.zeros(traces.size), np.full(traces.size, 0.5)
    low, high = _halve(low, high, lambda turn: 2.0 * sincos_each(TURN * turn)[1] > traces)
    return np.where(traces <= -2.0, 0.5, 0.5 * (low + high))
