"""Symmetric periodic orbits: one-dimensional root searches on the symmetry lines of the map.

With the reversor R, (x, y) -> (x, -y), and the map P, a symmetric orbit of even period 2m starts on
Fix R (y = 0) and is back there after m impacts, or does so on Fix RP; one of odd period 2m + 1
starts on Fix R and is on Fix RP after m impacts. On Fix R y = 0; on Fix RP the flight that follows
is symmetric in
time: b + g tau/2 = 0. Orbits without that symmetry are not looked for.
"""

import numpy as np
import xarray as xr

from ..kernel.arithmetic import sincos
from ..kernel.compiled import jit
from ..kernel.law import rebound, transfer
from .ball import whole_number
from .variables import NAMES, variables

# Cells into which a symmetry line is divided; each sign change between neighbours is followed.
RESOLUTION = 20_000
# Two points nearer than this, in section radii, are one.
SAME = 1e-9
TURN = float.fromhex("0x1.921fb54442d18p+2")  # 2 pi
# Largest |P^n z - z| of a solution in section radii, times |multiplier|/50 where that is larger.
CLOSURE = 1e-14
# A sign change that leaves more than this, in section radii, is a jump of the map.
JUMP = 1e-6
NEWTON_STEPS = 5


def symmetric_orbits(ball, energy, period):
    """All symmetric orbits of prime period `period` that the resolution of the search shows.

    Args:
        ball: a Ball.
        energy: above the lowest energy, -g^2/(2k).
        period: the number of impacts, at least 1.

    Returns:
        Dataset, dims (orbit, point), the orbits in the order of |multiplier|: x, xdot, udot just
        before each impact, tau the flight from that point to the next; per orbit
        type: elliptic, hyperbolic or inverse hyperbolic;
        trace: of the Jacobian of P^n on the energy surface;
        multiplier: its eigenvalue of largest modulus; for an elliptic orbit that modulus, 1;
        rotation_number: the argument of the multiplier over 2 pi, 0 to 1/2, arccos(trace/2)/(2 pi);
        total_time: the sum of tau.
        Length 0 where none is found. The first point lies on a symmetry line, unless the orbit is
        too sensitive there to be closed. Attribute resolution: the cells of each line; unsolved:
        how many orbits were seen, but close to no better than CLOSURE allows.

    Raises:
        ValueError: an energy below the bound or a period below 1.
    """
    period = whole_number("period", period)
    _, radius = ball.section(energy)
    near = SAME * radius
    seen, found = [], []
    for line in _lines(ball, energy, period):
        for state in _solutions(ball, energy, line, period, radius):
            points = _follow(ball, state, period)
            if any(np.any(_distance(points[:3, :1], p) < near) for p in seen):
                continue
            if period > 1 and np.any(_distance(points[:3, :1], points[:3, 1:]) < near):
                continue  # its prime period is a divisor
            seen.append(points[:3])
            trace = _trace(ball, points)
            limit = CLOSURE * radius * max(1.0, abs(_multiplier(trace)) / 50.0)
            # Where the orbit is too sensitive at its first point, another one serves as the first.
            for point in points[:3].T:
                first, gap = _closest(ball, energy, point, period)
                if gap <= limit:
                    found.append((trace, _follow(ball, first, period)))
                    break
    found.sort(key=lambda orbit: (abs(_multiplier(orbit[0])), orbit[1][0, 0]))
    return _dataset(ball, energy, period, found).assign_attrs(unsolved=len(seen) - len(found))


def _dataset(ball, energy, period, found):
    points = np.array([p for _, p in found]).reshape(len(found), 4, period)
    traces = np.array([t for t, _ in found])
    names = NAMES | {"tau": "time of flight to the next point"}
    data = variables(("orbit", "point"), points.transpose(1, 0, 2), names)
    kinds = np.array([_kind(t) for t in traces], dtype=object)
    data["type"] = ("orbit", kinds, {"long_name": "type of stability"})
    names = {
        "trace": "trace of the Jacobian of P^n on the energy surface",
        "multiplier": "multiplier of largest modulus; the modulus, 1, of elliptic orbits",
        "rotation_number": "argument of the multiplier over 2 pi",
        "total_time": "sum of the times of flight",
    }
    values = [
        traces,
        np.array([_multiplier(t) for t in traces]),
        np.array([_rotation_number(t) for t in traces]),
        points[:, 3].sum(axis=1),
    ]
    data |= variables("orbit", values, names)
    attributes = {"k": ball.k, "g": ball.g, "energy": float(energy), "period": period}
    return xr.Dataset(data, attrs=attributes | {"resolution": RESOLUTION})


def _lines(ball, energy, period):
    """(start, parameters, defect) of each search: states along a line, and what is 0 at an
    orbit.
    """
    centre, radius = ball.section(energy)
    k, g = ball.k, ball.g

    def on_r(q):
        # a rational parameter of the circle, which resolves its ends, where s = 0, as well
        udot = radius * ((1.0 - q) * (1.0 + q) / (1.0 + q * q)) / np.sqrt(1.0 + k)
        return centre + radius * (2.0 * q / (1.0 + q * q)), k * udot, udot

    def half(x, xdot, udot):
        """y, 0 on Fix R."""
        return xdot - k * udot

    def symmetric_flight(x, xdot, udot):
        """b + g tau/2, 0 on Fix RP."""
        _, after, _, tau = ball.impact(x, xdot, udot)
        return after - 0.5 * g * tau

    # the rim itself is at rest and no orbit
    inside = (2.0 * np.arange(RESOLUTION) + 1.0) / RESOLUTION - 1.0
    yield on_r, inside, (half if period % 2 == 0 else symmetric_flight)
    if period % 2:
        return
    # A symmetric flight of length 2 theta: b = -g theta, x = a cos theta, c = -a sin theta, and a
    # from E = g^2 theta^2/2 + k a^2/2 - g a cos theta.
    longest = radius * np.sqrt(k) / g
    for sign in (1.0, -1.0):

        def on_rp(theta, sign=sign):
            sine, cosine = _sincos(theta)
            square = g * g * cosine * cosine + k * (2.0 * energy - g * g * theta * theta)
            a = (g * cosine + sign * np.sqrt(np.where(square >= 0.0, square, np.nan))) / k
            xdot, udot, _ = rebound(-g * theta, -a * sine, k, *transfer(k))
            good = xdot + udot >= 0.0
            x, xdot, udot = (np.where(good, u, np.nan) for u in (a * cosine, xdot, udot))
            tau = ball.time_to_impact(x, xdot, udot)
            first = np.abs(tau - 2.0 * theta) <= 1e-7 * (1.0 + theta)
            return tuple(np.where(first, u, np.nan) for u in (x, xdot, udot))

        yield on_rp, longest * np.arange(1, RESOLUTION + 1) / RESOLUTION, symmetric_flight


@jit
def _sincos(theta):
    sine = np.empty(theta.size)
    cosine = np.empty(theta.size)
    for i in range(theta.size):
        sine[i], cosine[i] = sincos(theta[i])
    return sine, cosine


def _roots(ball, start, parameters, defect, impacts):
    """(low, high): the ends, neighbouring doubles, of each sign change of the defect after
    `impacts` impacts.

    A jump of the map changes sign too: what it leaves does not close and is sorted out afterwards.
    """

    def value(p):
        state = [np.array(a) for a in start(p)]
        ball.map.steps(*state, ball.k, ball.g, impacts, np.empty(p.size))
        return defect(*state)

    def halve(low, high, goes_right):
        while True:
            middle = 0.5 * (low + high)
            if np.all((middle == low) | (middle == high)):
                return low, high
            right = goes_right(value(middle))
            low, high = np.where(right, middle, low), np.where(right, high, middle)

    values = value(parameters)
    there = ~np.isnan(values)
    low, high = parameters[:-1].copy(), parameters[1:].copy()
    # Where a line ends between two parameters, the last point on it takes the place of the one
    # beyond.
    (leaves,) = np.nonzero(there[:-1] & ~there[1:])
    high[leaves] = halve(low[leaves], high[leaves], lambda v: ~np.isnan(v))[0]
    (enters,) = np.nonzero(~there[:-1] & there[1:])
    low[enters] = halve(low[enters], high[enters], np.isnan)[1]
    at_low = value(low)
    change = at_low * value(high) <= 0.0
    at_low = at_low[change]
    return halve(low[change], high[change], lambda v: at_low * v > 0.0)


def _solutions(ball, energy, line, period, radius):
    """States on one symmetry line that are back after `period` impacts, jumps left out."""
    start, parameters, defect = line
    for end in zip(*_roots(ball, start, parameters, defect, period // 2), strict=True):
        sides = np.stack(start(np.array(end)))
        _, gaps = _gaps(ball, sides, period)
        if np.min(gaps) < JUMP * radius:
            yield sides[:, np.argmin(gaps)]


def _gaps(ball, states, period):
    """Largest coordinate of P^n z - z, (n,), for states (3, n)."""
    after = states.copy()
    ball.map.steps(*after, ball.k, ball.g, period, np.empty(states.shape[1]))
    return after, _distance(after, states)


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
        dx = (b * fy - (d - 1.0) * fx) / determinant
        dy = (c * fx - (a - 1.0) * fy) / determinant
        try:
            state = np.stack(ball.state_xy(state[0] + dx, y + dy, energy))
        except ValueError:  # off the section
            break
    steps = np.arange(-2, 3)
    shift = np.stack(np.meshgrid(steps, steps, steps, indexing="ij")).reshape(3, -1)
    near = best[:, None] + shift * np.spacing(best)[:, None]
    near = near[:, near[1] + near[2] >= 0.0]
    _, gaps = _gaps(ball, near, period)
    least = int(np.argmin(gaps))
    return near[:, least], gaps[least]


def _follow(ball, state, period):
    """x, xdot, udot and the time of flight after it, (4, period), of the orbit from `state`, which
    comes first.
    """
    out = np.empty((1, period, 4))
    ball.map.history(*(np.array([a]) for a in state), ball.k, ball.g, out)
    out = out[0].T
    out[:3, 1:] = out[:3, :-1].copy()
    out[:3, 0] = state
    return out


def _distance(a, b):
    return np.max(np.abs(a - b), axis=0)


def _trace(ball, points):
    """Trace of the Jacobian of P^n on the energy surface: the third eigenvalue of eq. (33)'s
    product is 1.
    """
    jacobian = ball.jacobian(*points[:3, 0], impacts=points.shape[1])
    return float(jacobian[0, 0] + jacobian[1, 1] + jacobian[2, 2] - 1.0)


def _kind(trace):
    if abs(trace) < 2.0:
        return "elliptic"
    return "hyperbolic" if trace > 0.0 else "inverse hyperbolic"


def _multiplier(trace):
    if abs(trace) <= 2.0:
        return 1.0
    root = np.sqrt((abs(trace) - 2.0) * (abs(trace) + 2.0))
    return float(np.copysign(0.5 * (abs(trace) + root), trace))


def _rotation_number(trace):
    """arccos(trace/2)/(2 pi) by bisection on our own cosine: the same bits on every machine."""
    if abs(trace) >= 2.0:
        return 0.0 if trace > 0.0 else 0.5
    low, high = 0.0, 0.5
    while True:
        middle = 0.5 * (low + high)
        if middle in (low, high):
            return middle
        if 2.0 * sincos(TURN * middle)[1] > trace:
            low = middle
        else:
            high = middle
