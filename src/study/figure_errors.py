"""The error of each figure under each compiled method, in pixels, and the cost of the method.

The kind of picture names its measure of error:

    portrait  the drift of the energy over each orbit, as a change of the section's radius, which
              moves every curve; points that slide along a curve do not show
    motion    the error of height and time at the impacts, against the proved orbit
    tangle, closeup
              the error of one impact on the branches, times 1/(1 - 1/m) for the multiplier m of an
              impact: errors across a branch shrink by 1/m each impact, errors along it do not show
    exponents the change of a tangent vector's exponent, averaged over the orbits

A missed impact puts a point off the orbit. A picture of orbits shows it even if the energy is
exact; the mean exponent of a long orbit does not.
"""

import math
from decimal import Decimal
from functools import partial
from typing import NamedTuple

import numpy as np
import xarray as xr

from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.orbits import start_state
from pseudorigid.dynamics.variables import of_type, states_of
from pseudorigid.figures.axes.box import Box
from pseudorigid.figures.canvas.style import DPI
from pseudorigid.figures.kinds import closeup, exponents, motion
from pseudorigid.kernel.arithmetic import log, sincos_each
from pseudorigid.kernel.compiled import jit
from pseudorigid.kernel.formulas import impact_coefficients, rebound

from . import reference_solver
from .failures import certified_orbit, energy_drift
from .methods.counted_methods import ENGINES, OURS, SCANS
from .work import dataset, is_wrong, proved_times

# The march, scans of 0.5 and 0.1, the finest scan, and all engines but the coarsest.
METHODS = (OURS, *SCANS[:8], SCANS[-1], *ENGINES[1:])
_AXIS = "unit of the axis"  # a scale: R for positions, 1/omega for times, 1 for exponents
# Standard deviation between orbits of an exponent after 2e5 impacts, with any method: an error
# below that of the orbits' mean does not show.
SCATTER = 0.004
BRANCH_POINTS = 2000  # of a manifold, evenly by index; one miss in a thousand shows


class Errors(NamedTuple):
    """Errors of the methods in one figure; lists have an entry for each method."""

    error: list[float]  # of the picture, in pixels
    missed: list[int]  # impacts flown past
    evaluations: list[float]  # for one impact
    impacts: int  # computed for the comparison
    axis: str  # in whose units `pixel` is
    pixel: float
    stroke: float  # width of a line or dot, in points
    limit: float = 1.0  # error that the picture can hide, in pixels
    misses_show: bool = True


def figure_errors(scenes: dict, measures: dict[str, str], artifacts: dict) -> xr.Dataset:
    """Compute each figure's error under each method, and which methods are good enough.

    `scenes` has the blocks of the checked config, with their axes, `measures` a key of MEASURES for
    each, and `artifacts` the Dataset of (stage, name), for periodic orbits and manifolds. The
    dataset is on (scene, method).
    """
    rows = []
    for name, block in scenes.items():
        data = {stage: dataset for (stage, scene), dataset in artifacts.items() if scene == name}
        rows.append(MEASURES[measures[name]](block, **data))
    error, missed, evaluations, impacts, axes, pixel, stroke, limit, misses_show = (
        np.array(column) for column in zip(*rows, strict=True)
    )
    good = (error <= limit[:, None]) & ((missed == 0) | ~misses_show[:, None])
    cheapest = np.where(good, evaluations, np.inf).argmin(axis=1)
    blocks = zip(scenes.values(), axes, strict=True)
    labels = [[f"{tick:.10g}" for tick in block["axes"][axis]["ticks"]] for block, axis in blocks]
    digit = [float(f"1e-{max(len(text.partition('.')[2]) for text in row)}") for row in labels]
    width = stroke * DPI / 72 * pixel
    each = ("scene", "method")
    variables = {
        "scene": ("scene", list(scenes), "scene"),
        "error": (each, error, "error of the picture in pixels", "pixel"),
        "missed": (each, missed, "impacts flown past"),
        "evaluations": (each, evaluations, "evaluations an impact"),
        "impacts": ("scene", impacts, "impacts computed for the comparison"),
        "pixel": ("scene", pixel, "a pixel in units of the axis", _AXIS),
        "line": ("scene", width, "width of a line or dot in units of the axis", _AXIS),
        "digit": ("scene", digit, "last digit of the axis' labels", _AXIS),
        "limit": ("scene", limit, "error that the picture can hide, in pixels", "pixel"),
        "good": (each, good.astype(np.int8), "1 where the picture is right"),
        "cheapest": ("scene", cheapest, "cheapest method within the limit, by its place"),
    }
    return dataset(METHODS, variables)


def _portrait(block: dict) -> Errors:
    ball, states, impacts = _orbits(block)
    pixel = 1.0 / Box(block).view.scale
    radius = ball.section(block["energy"])[1]
    error = []
    for method in METHODS:
        tracks = [method.orbit(ball, *each)[0] for each in zip(states, impacts, strict=True)]
        drifts = [energy_drift(ball, *each)[-1] for each in zip(states, tracks, strict=True)]
        error.append(max(drifts) * abs(ball.energy(*states[-1])) / (ball.k * radius) / pixel)
    return Errors(error, *_misses(ball, states, impacts), sum(impacts), "x", pixel, stroke=0.8)


def _exponents(block: dict) -> Errors:
    ball, states, impacts = _orbits(block)
    _, pixel = _pixels(exponents.plane(block))

    def vector_exponent(method, state, impacts):
        """Return the exponent of a tangent vector, which tends to the largest."""
        track, _ = method.orbit(ball, state, impacts)
        x, xdot, udot = np.column_stack((state, track[:3, :-1]))
        return _growth(ball.jacobian(x, xdot, np.maximum(udot, -xdot))) / impacts

    pairs = list(zip(states, impacts, strict=True))
    means = [
        sum(vector_exponent(method, *pair) for pair in pairs) / len(pairs) for method in METHODS
    ]
    error = [abs(mean - means[0]) / pixel for mean in means]
    limit = SCATTER / math.sqrt(len(states)) / pixel
    missed, evaluations = _misses(ball, states, impacts)
    return Errors(error, missed, evaluations, sum(impacts), "exponent", pixel, 0.8, limit, False)


def _motion(block: dict, periodic: xr.Dataset) -> Errors:
    ball = Ball(**block["ball"])
    orbit = of_type(periodic, block["type"])
    state = tuple(states_of(orbit)[:, 0].tolist())
    impacts = math.ceil(block["duration"] / float(orbit["total_time"].values) * block["period"])
    truth = np.array(reference_solver.orbit(ball, state, impacts)).T
    times = np.cumsum(proved_times(ball, np.column_stack((state, truth[:, :-1]))))
    across, up = _pixels(motion.plane(block))
    error, evaluations = [], []
    for method in METHODS:
        track, count = method.orbit(ball, state, impacts)
        late = np.abs(np.cumsum(track[3]) - times) / across
        high = np.abs(track[0] - truth[0]) / up
        error.append(float(max(late.max(), high.max())))
        evaluations.append(count / impacts)
    missed, _ = _misses(ball, [state], [impacts])
    return Errors(error, missed, evaluations, impacts, "displacement", up, stroke=1.0)


def _branches(block: dict, periodic: xr.Dataset, manifolds: xr.Dataset) -> Errors:
    ball = Ball(**block["ball"])
    if "view" in block:
        pixel = 1.0 / Box(block).view.scale
    else:
        pixel, _ = _pixels(closeup.plane(block))
    multiplier = abs(float(of_type(periodic, block["type"])["multiplier"].values))
    # a decimal power, since a power function's last bit differs between machines
    growth = float(Decimal(max(multiplier, 1.0 / multiplier)) ** (1 / Decimal(block["period"])))
    columns = states_of(manifolds)
    columns = columns[:, ~np.isnan(columns[0])]
    columns = columns[:, :: max(1, columns.shape[1] // BRANCH_POINTS)]
    columns[2] = np.maximum(columns[2], -columns[1])
    truth = proved_times(ball, columns)
    times, missed, evaluations = _solved(ball, columns, truth)
    exact = _next_states(ball, columns, truth)
    error = []
    for tau in times:
        distance = np.abs(_next_states(ball, columns, tau) - exact).max(axis=0)
        largest = distance[~is_wrong(tau, truth)].max(initial=0.0)
        error.append(largest / (1.0 - 1.0 / growth) / pixel)
    return Errors(error, missed, evaluations, truth.size, "x", pixel, stroke=0.5)


MEASURES = {
    "portrait": _portrait,
    "motion": _motion,
    "tangle": _branches,
    "closeup": _branches,
    "exponents": _exponents,
}


def _pixels(plane) -> tuple[float, float]:
    """Size of a pixel on the two axes of a plane picture."""
    left, bottom, right, top = plane.frame
    (x0, x1), (y0, y1) = plane.across.limits, plane.up.limits
    return (x1 - x0) / (right - left), (y1 - y0) / (top - bottom)


def _orbits(block: dict) -> tuple[Ball, list, list[int]]:
    """Return ball, states and numbers of impacts of a scene of orbits."""
    ball, starts, impacts = Ball(**block["ball"]), block["starts"], block["impacts"]
    states = [start_state(ball, block["energy"], start) for start in starts]
    return ball, states, impacts if isinstance(impacts, list) else [impacts] * len(starts)


def _misses(ball, states, impacts):
    """Return each method's missed impacts and evaluations an impact along certified orbits."""
    pieces = map(partial(certified_orbit, ball), states, impacts)
    columns, truth = (np.concatenate(parts, axis=-1) for parts in zip(*pieces, strict=True))
    return _solved(ball, columns, truth)[1:]


def _solved(ball, columns, truth):
    """Return each method's flight times, number of wrong ones, and evaluations a flight."""
    times, counts = zip(*(method.solve(ball, *columns) for method in METHODS), strict=True)
    return times, [is_wrong(tau, truth).sum() for tau in times], [n.mean() for n in counts]


def _next_states(ball: Ball, columns: np.ndarray, tau: np.ndarray) -> np.ndarray:
    """Return the states after flights of given times, eq. (26)."""
    x, xdot, udot = columns
    b, c, _ = rebound(xdot, udot, ball.k, impact_coefficients(ball.k))
    sine, cosine = sincos_each(tau)
    return np.array([x * cosine - c * sine, b + ball.g * tau, x * sine + c * cosine])


@jit
def _growth(jacobians):
    """Return the logarithm by which a product of matrices (n, 3, 3) stretches (1, 0, 0)."""
    a, b, c = 1.0, 0.0, 0.0
    total = 0.0
    for j in jacobians:
        p = (j[0, 0] * a + j[0, 1] * b) + j[0, 2] * c
        q = (j[1, 0] * a + j[1, 1] * b) + j[1, 2] * c
        r = (j[2, 0] * a + j[2, 1] * b) + j[2, 2] * c
        length = math.sqrt((p * p + q * q) + r * r)
        if length > 0.0 and length < math.inf:  # else the next impact grazes: no derivative
            a, b, c = p / length, q / length, r / length
            total += log(length)
    return total
