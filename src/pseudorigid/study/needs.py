"""What a scene needs: what each method does to each picture, in pixels, and at what cost.

For each scene and each compiled method: the error of the picture, the impacts missed, and the
evaluations spent. What counts as error depends on the picture:

    portrait  the drift of the energy over each orbit, as a change of the section's radius: it moves
              every curve; along a curve points may slide unseen
    motion    the error of height and time at the impacts, against the judge's orbit
    tangle, closeup
              the error of one impact on the branches, times 1/(1 - 1/m) for the multiplier m of
              an impact: across a branch errors shrink by 1/m each impact, along it they do not
              show
    exponents the change of the largest exponent, averaged over the orbits

A missed impact is a point that is not on the orbit; a picture of orbits shows it whatever the
energy says. The mean exponent of a long orbit does not.
"""

import math

import numpy as np
import xarray as xr

from ..dynamics.ball import Ball
from ..figures.axes.box import Box
from ..figures.axes.plane import Plane
from ..kernel import impact as kernel
from ..kernel.arithmetic import log
from ..kernel.compiled import jit
from ..proofs import judge
from .methods import counted as own
from .work import named

METHODS = (
    own.OURS,
    *(own.scan_method(0.5, tolerance) for tolerance in own.TOLERANCES),
    *(own.scan_method(0.1, tolerance) for tolerance in own.TOLERANCES),
    own.scan_method(0.01, 1e-12),
    own.engine_method(1e-2),
    own.engine_method(1e-3),
    own.engine_method(1e-4),
)
# The scatter between orbits of an exponent after 2e5 impacts, whatever the method.
SCATTER = 0.004
BRANCH_POINTS = 2000  # of a manifold, evenly by index


def needs(scenes, artifacts):
    """Dataset (scene, method): error in pixels, missed impacts, evaluations; what is shown.

    Args:
        scenes: the checked config's.
        artifacts: (stage, scene) -> Dataset, for the periodic orbits and manifolds of the scenes.
    """
    rows = {name: _row(block, name, artifacts) for name, block in scenes.items()}
    error = np.array([row[0] for row in rows.values()])
    missed = np.array([row[1] for row in rows.values()])
    evaluations = np.array([row[2] for row in rows.values()])
    shown = np.array([row[3] for row in rows.values()])
    impacts = np.array([row[4] for row in rows.values()])
    limit = np.array([row[5] for row in rows.values()])
    orbits_show = np.array([block["picture"] != "exponents" for block in scenes.values()])
    good = (error <= limit[:, None]) & ((missed == 0) | ~orbits_show[:, None])
    cheapest = np.where(good, evaluations, np.inf).argmin(axis=1)
    return xr.Dataset(
        named(METHODS)
        | {
            "scene": ("scene", np.array(list(rows), dtype=object), {"long_name": "scene"}),
            "error": _var(("scene", "method"), error, "error of the picture in pixels"),
            "missed": _var(("scene", "method"), missed, "impacts flown past"),
            "evaluations": _var(("scene", "method"), evaluations, "evaluations an impact"),
            "impacts": _var("scene", impacts, "impacts computed for the comparison"),
            "pixel": _var("scene", shown[:, 0], "a pixel in units of the axis"),
            "line": _var("scene", shown[:, 1], "width of a line or dot in units of the axis"),
            "digit": _var("scene", shown[:, 2], "last digit of the axis' labels"),
            "limit": _var("scene", limit, "error that the picture can hide, in pixels"),
            "good": _var(("scene", "method"), good.astype(np.int8), "1 where the picture is right"),
            "cheapest": _var("scene", cheapest, "cheapest method within the limit, by its place"),
        }
    )


def _var(dims, values, text):
    return dims, np.asarray(values), {"long_name": text, "units": "1"}


def _row(block, name, artifacts):
    ball, energy = Ball(**block["ball"]), block["energy"]
    if block["picture"] == "portrait":
        pixel = 1.0 / Box(block).view.scale
        values = _portrait(ball, energy, block, pixel)
        return *values[:3], (pixel, 0.8 * 300 / 72 * pixel, _digit(block, "x")), values[3], 1.0
    if block["picture"] == "motion":
        plane = Plane(block, ("t", "displacement"), ("", ""))
        size = _pixels(plane)
        values = _motion(ball, artifacts["periodic", name], block, size)
        return (
            *values[:3],
            (size[1], 300 / 72 * size[1], _digit(block, "displacement")),
            values[3],
            1.0,
        )
    if block["picture"] == "exponents":
        plane = Plane(block, ("impact", "exponent"), ("", ""), right=84)
        pixel = _pixels(plane)[1]
        values = _exponents(ball, energy, block, pixel)
        limit = SCATTER / math.sqrt(len(block["starts"])) / pixel
        return (
            *values[:3],
            (pixel, 0.8 * 300 / 72 * pixel, _digit(block, "exponent")),
            values[3],
            limit,
        )
    if block["picture"] == "tangle":
        pixel, axis, width = 1.0 / Box(block).view.scale, "x", 0.5
    else:
        pixel = _pixels(Plane(block, ("x", "xdot"), ("", ""), high=900, right=75))[0]
        axis, width = "x", 0.5
    values = _branches(
        ball, artifacts["periodic", name], artifacts["manifolds", name], block, pixel
    )
    return *values[:3], (pixel, width * 300 / 72 * pixel, _digit(block, axis)), values[3], 1.0


def _pixels(plane):
    """The size of a pixel on the two axes of a plane picture."""
    left, bottom, right, top = plane.frame
    (x0, x1), (y0, y1) = plane.spans
    return (x1 - x0) / (right - left), (y1 - y0) / (top - bottom)


def _digit(block, axis):
    """The last digit that the labels of an axis show."""
    ticks = block["axes"][axis]["ticks"]
    decimals = max(len(f"{tick:.10g}".partition(".")[2]) for tick in ticks)
    return float(f"1e-{decimals}")


def _portrait(ball, energy, block, pixel):
    radius = ball.section(energy)[1]
    impacts = block["impacts"]
    error, missed, evaluations = [], [], []
    for method in METHODS:
        drift, lost, spent = 0.0, 0, 0
        for start, count in zip(block["starts"], impacts, strict=True):
            state = ball.start(start, energy)
            drift = max(drift, method.orbit(ball, state, [count])[0][0, 3])
            wrong, looks = method.missed(ball, state, count)
            lost, spent = lost + wrong, spent + looks
        error.append(drift * abs(ball.energy(*state)) / (ball.k * radius) / pixel)
        missed.append(lost)
        evaluations.append(spent / sum(impacts))
    return error, missed, evaluations, sum(impacts)


def _motion(ball, periodic, block, size):
    from ..dynamics.variables import of_type

    orbit = of_type(periodic, block["type"])
    state = tuple(float(orbit[name].values[0]) for name in ("x", "xdot", "udot"))
    impacts = 1
    total = float(orbit["total_time"].values) if "total_time" in orbit else 0.0
    if total > 0.0:
        impacts = math.ceil(block["duration"] / total * block["period"])
    truth = np.array(judge.orbit(ball, state, impacts))
    proved = _times(ball, state, truth)
    error, missed, evaluations = [], [], []
    for method in METHODS:
        track, looks = method.orbit(ball, state, np.arange(1, impacts + 1))
        before = np.vstack((np.array([state]), track[:-1, :3]))
        tau, _ = method.solve(ball, *before.T.copy())
        late = np.abs(np.cumsum(tau) - np.cumsum(proved)) / size[0]
        high = np.abs(track[:, 0] - truth[:, 0]) / size[1]
        error.append(float(max(late.max(), high.max())))
        missed.append(method.missed(ball, state, impacts)[0])
        evaluations.append(looks / impacts)
    return error, missed, evaluations, impacts


def _times(ball, state, track):
    before = np.vstack((np.array([state]), track[:-1]))
    return np.array(judge.flight_times(ball, *before.T.copy()))


def _branches(ball, periodic, manifolds, block, pixel):
    from ..dynamics.variables import of_type

    orbit = of_type(periodic, block["type"])
    multiplier = abs(float(orbit["multiplier"].values))
    multiplier = max(multiplier, 1.0 / multiplier)
    each = _root(multiplier, block["period"])
    columns = np.array([manifolds[name].values for name in ("x", "xdot", "udot")])
    columns = columns[:, ~np.isnan(columns[0])]
    columns = columns[:, :: max(1, columns.shape[1] // BRANCH_POINTS)]
    columns[2] = np.maximum(columns[2], -columns[1])
    truth = np.array(judge.flight_times(ball, *columns))
    exact = _states(ball, columns, truth)
    error, missed, evaluations = [], [], []
    for method in METHODS:
        tau, count = method.solve(ball, *columns)
        wrong = ~(np.abs(tau - truth) <= 0.1 * np.minimum(truth, 1.0))
        off = np.abs(_states(ball, columns, tau) - exact).max(axis=0)
        error.append(off[~wrong].max(initial=0.0) / (1.0 - 1.0 / each) / pixel)
        missed.append(int(wrong.sum()))
        evaluations.append(count.mean())
    return error, missed, evaluations, columns.shape[1]


def _root(value, degree):
    """value**(1/degree) by bisection, the same bits everywhere."""
    low, high = 1.0, value
    for _ in range(60):
        middle = 0.5 * (low + high)
        power = 1.0
        for _ in range(degree):
            power *= middle
        low, high = (middle, high) if power < value else (low, middle)
    return low


def _states(ball, columns, tau):
    out = np.empty_like(columns)
    _after(*columns, tau, ball.k, ball.g, out)
    return out


@jit
def _after(x, v, w, tau, k, g, out):
    """The states after flights of given times, from the exact formulas."""
    head, low = kernel.transfer(k)
    for i in range(x.size):
        b, c, _ = kernel.rebound(v[i], w[i], k, head, low)
        sine, cosine = own.sincos(tau[i])
        out[0, i] = x[i] * cosine - c * sine
        out[1, i] = b + g * tau[i]
        out[2, i] = x[i] * sine + c * cosine


@jit
def _largest_exponent(kind, step, tolerance, x, v, w, k, g, impacts):
    """The largest exponent along the method's own orbit, by one tangent vector."""
    head, low = kernel.transfer(k)
    here = np.empty((3, 1))
    jacobian = np.empty((1, 3, 3))
    a, b, c = 1.0, 0.0, 0.0
    total = 0.0
    for _ in range(impacts):
        here[0, 0], here[1, 0], here[2, 0] = x, v, max(w, -v)
        kernel.jacobians(here[0], here[1], here[2], k, g, 1, jacobian, None)
        p = (jacobian[0, 0, 0] * a + jacobian[0, 0, 1] * b) + jacobian[0, 0, 2] * c
        q = (jacobian[0, 1, 0] * a + jacobian[0, 1, 1] * b) + jacobian[0, 1, 2] * c
        r = (jacobian[0, 2, 0] * a + jacobian[0, 2, 1] * b) + jacobian[0, 2, 2] * c
        length = math.sqrt((p * p + q * q) + r * r)
        if length > 0.0 and length < math.inf:  # not differentiable where the next impact grazes
            a, b, c = p / length, q / length, r / length
            total += log(length)
        _, x, v, w, _ = own.flight(kind, step, tolerance, x, v, w, k, g, head, low)
    return total / impacts


def _exponents(ball, energy, block, pixel):
    states = [ball.start(start, energy) for start in block["starts"]]
    impacts = block["impacts"]
    means, missed, evaluations = [], [], []
    for method in METHODS:
        how = method.kind, method.step, method.tolerance
        found = [_largest_exponent(*how, *state, ball.k, ball.g, impacts) for state in states]
        means.append(sum(found) / len(found))
        lost = [method.missed(ball, state, impacts) for state in states]
        missed.append(sum(wrong for wrong, _ in lost))
        evaluations.append(sum(looks for _, looks in lost) / (impacts * len(states)))
    error = [abs(mean - means[0]) / pixel for mean in means]
    return error, missed, evaluations, impacts * len(states)
