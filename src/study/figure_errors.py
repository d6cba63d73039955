"""The error of each figure under each compiled method, in pixels, and the cost of the method.

The kind of a picture decides how its error is measured (MEASURES). A missed impact puts a point off
the orbit. A picture of orbits shows it even if the energy is exact; the mean exponent of a long
orbit does not. A pixel is that of the drawn figure, so this stage imports the modules that draw.
"""

import math
from collections.abc import Callable
from decimal import Decimal
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from paper.figures import closeup, exponents, motion
from pseudorigid.dynamics.ball import Ball, State
from pseudorigid.dynamics.orbits import start_state
from pseudorigid.dynamics.variables import of_rows, of_type, states_of
from pseudorigid.figures.axes.box import Box
from pseudorigid.figures.axes.plane import Plane
from pseudorigid.figures.canvas.style import pinned
from pseudorigid.kernel.arithmetic import log, sincos_each
from pseudorigid.kernel.compiled import jit
from pseudorigid.kernel.formulas import impact_coefficients, rebound
from pseudorigid.verified import reference_solver

from .methods import counted_methods as counted
from .stages import certified_orbit, dataset, energy_drift, is_wrong, proved_times, states_before

# The march, inflections, the best careful scan and a simpler one, the usual scans with steps 0.5
# and 0.1, the finest scan, and all engines but the coarsest.
METHODS = (
    *counted.BEST_METHODS,
    counted.CAREFUL_SCANS[0],
    *counted.SCANS[:8],
    counted.SCANS[-1],
    *counted.ENGINES[1:],
)
_AXIS = "unit of the axis"  # R for positions, 1/omega for times, 1 for exponents
# Standard deviation, between orbits, of the exponent after 2e5 impacts with any method. A
# difference below three standard errors of the orbits' mean does not show.
EXPONENT_DEVIATION = 0.004
_OTHERS, _ASIDE = 8, 1e-12  # orbits for each start that a mean exponent is compared with, and in x
BRANCH_POINTS = 2000  # of a manifold, evenly by index; one miss in a thousand shows
Block = dict[str, Any]  # a scene of the checked config
Counts = tuple[np.ndarray, np.ndarray, int]
_EACH = ("scene", "method")
_VARIABLES = {
    "scene": ("scene", "scene"),
    "error": (_EACH, "error of the picture in pixels", "pixel"),
    "missed": (_EACH, "impacts flown past"),
    "evaluations": (_EACH, "evaluations an impact"),
    "impacts": ("scene", "impacts computed for the comparison"),
    "pixel": ("scene", "a pixel in units of the axis", _AXIS),
    "limit": ("scene", "error that the picture can hide, in pixels", "pixel"),
    "good": (_EACH, "1 where the picture is right"),
    "cheapest": ("scene", "cheapest method within the limit, by its place"),
}


class PictureErrors(NamedTuple):
    """Errors of the methods in one figure; arrays have an entry for each method."""

    error: np.ndarray  # of the picture, in pixels
    missed: np.ndarray  # impacts flown past: no root, or another one
    evaluations: np.ndarray  # for one impact
    impacts: int  # computed for the comparison
    pixel: float  # in units of the axis
    limit: float = 1.0  # error that the picture can hide, in pixels
    misses_show: bool = True


def figure_errors(
    *datasets: xr.Dataset, scenes: dict[str, Block], measures: dict[str, str], inputs: list[str]
) -> xr.Dataset:
    """Compute each figure's error under each method, and which methods are good enough.

    `scenes` maps names to blocks of the checked config, with their axes, and `measures` maps the
    names to keys of MEASURES. The `datasets` are the periodic orbits and manifolds that the
    measures take, and `inputs` has the name STAGE/SCENE of each. The result has the dims (scene,
    method).
    """
    data: dict[str, dict[str, xr.Dataset]] = {name: {} for name in scenes}
    for path, artifact in zip(inputs, datasets, strict=True):
        stage, _, scene = path.partition("/")
        data[scene][stage] = artifact
    rows: list[tuple[Any, ...]] = []
    for name, block in scenes.items():
        row = MEASURES[measures[name]](block, **data[name])
        good = (row.error <= row.limit) & ((row.missed == 0) | (not row.misses_show))
        cheapest = np.where(good, row.evaluations, np.inf).argmin()
        rows.append((name, *row[:6], good.astype(np.int8), cheapest))
    return dataset("needs", METHODS, {}).assign(of_rows(_VARIABLES, rows))


def _portrait(block: Block) -> PictureErrors:
    """Measure the drift of the energy, as a change of the section's radius, which moves curves.

    Points that slide along a curve do not show.
    """
    ball, orbits, counts = _orbits(block)
    pixel = _pixel_of_box(block)
    _, radius = ball.section(block["energy"])
    error = []
    for method in METHODS:
        drifts = [energy_drift(ball, orbit[0], method.orbit(ball, *orbit)[0]) for orbit in orbits]
        drift = max(each[-1] for each in drifts)
        # radius^2 = (2E + g^2/k)/k, so that d radius = dE/(k radius); all orbits have the same E
        error.append(drift * abs(ball.energy(*orbits[-1][0])) / (ball.k * radius) / pixel)
    return PictureErrors(np.array(error), *counts, pixel)


def _exponents(block: Block) -> PictureErrors:
    """Measure the difference of a tangent vector's mean exponent from that of other orbits.

    These are orbits by the march, whose starts are close. No method has the exponent of a true
    orbit, the march neither: chaotic orbits by two methods are apart after some 100 impacts, and
    their exponents then are two draws.
    """
    ball, orbits, counts = _orbits(block)
    _, pixel = _pixels(exponents.empty_picture(block))
    means = [
        sum(_vector_exponent(method, ball, *orbit) for orbit in orbits) / len(orbits)
        for method in METHODS
    ]
    others = [
        _vector_exponent(counted.OURS, ball, (x + i * _ASIDE, xdot, udot), impacts)
        for (x, xdot, udot), impacts in orbits
        for i in range(1, _OTHERS + 1)
    ]
    error = np.abs(np.array(means) - sum(others) / len(others)) / pixel
    deviation = EXPONENT_DEVIATION * math.sqrt(1.0 / len(orbits) + 1.0 / len(others))
    limit = 3.0 * deviation / pixel
    return PictureErrors(error, *counts, pixel, limit, False)


def _vector_exponent(
    method: counted.CountedMethod, ball: Ball, state: State, impacts: int
) -> float:
    """Return the exponent of a tangent vector, which tends to the largest Lyapunov exponent."""
    track, _ = method.orbit(ball, state, impacts)
    x, xdot, udot = states_before(state, track)
    return _log_stretch(ball.jacobian(x, xdot, np.maximum(udot, -xdot))) / impacts


def _motion(block: Block, periodic: xr.Dataset) -> PictureErrors:
    """Measure the error of height and time at the impacts, against the proved orbit."""
    ball = Ball(**block["ball"])
    orbit = of_type(periodic, block["type"])
    x, xdot, udot = states_of(orbit)[:, 0].tolist()
    state = x, xdot, udot
    impacts = math.ceil(block["duration"] / float(orbit["total_time"].values) * block["period"])
    truth = np.array(reference_solver.orbit(ball, state, impacts)).T
    times = np.cumsum(proved_times(ball, np.column_stack((state, truth[:, :-1]))))
    across, up = _pixels(motion.empty_picture(block))
    error, evaluations = [], []
    for method in METHODS:
        track, count = method.orbit(ball, state, impacts)
        time_error = np.abs(np.cumsum(track[3]) - times) / across
        height_error = np.abs(track[0] - truth[0]) / up
        error.append(float(max(time_error.max(), height_error.max())))
        evaluations.append(count / impacts)
    missed, *_ = _count_misses(ball, *certified_orbit(ball, state, impacts))
    return PictureErrors(np.array(error), missed, np.array(evaluations), impacts, up)


def _branches(block: Block, periodic: xr.Dataset, manifolds: xr.Dataset) -> PictureErrors:
    """Measure the error of one impact on the manifolds' branches, summed over later impacts.

    The sum is 1/(1 - 1/m) of it, for the orbit's multiplier m per impact: errors across a branch
    shrink by 1/m each impact, and errors along it do not show.
    """
    ball = Ball(**block["ball"])
    in_box = "view" in block
    pixel = _pixel_of_box(block) if in_box else _pixels(closeup.empty_picture(block))[0]
    multiplier = abs(float(of_type(periodic, block["type"])["multiplier"].values))
    # per impact; a decimal power, since a power function's last bit differs between machines
    growth = float(Decimal(max(multiplier, 1.0 / multiplier)) ** (1 / Decimal(block["period"])))
    columns = states_of(manifolds)
    columns = columns[:, ~np.isnan(columns[0])]
    columns = columns[:, :: max(1, columns.shape[1] // BRANCH_POINTS)]
    columns[2] = np.maximum(columns[2], -columns[1])
    truth = proved_times(ball, columns)
    exact = _next_states(ball, columns, truth)
    error = []
    for method in METHODS:
        tau, _ = method.solve(ball, *columns)
        distance = np.abs(_next_states(ball, columns, tau) - exact).max(axis=0)
        largest = distance[~is_wrong(tau, truth)].max(initial=0.0)
        error.append(largest / (1.0 - 1.0 / growth) / pixel)
    return PictureErrors(np.array(error), *_count_misses(ball, columns, truth), pixel)


MEASURES: dict[str, Callable[..., PictureErrors]] = {
    "portrait": _portrait,
    "motion": _motion,
    "tangle": _branches,
    "closeup": _branches,
    "exponents": _exponents,
}


def _pixel_of_box(block: dict[str, Any]) -> float:
    """Return the size of a pixel on the axes of a box, which has room for labels in its font."""
    with pinned():
        return 1.0 / Box(block).view.scale


def _pixels(plane: Plane) -> tuple[float, float]:
    """Return the size of a pixel on the two axes of a plane picture."""
    left, bottom, right, top = plane.frame
    (x0, x1), (y0, y1) = plane.across.limits, plane.up.limits
    return (x1 - x0) / (right - left), (y1 - y0) / (top - bottom)


def _orbits(block: Block) -> tuple[Ball, list[tuple[State, int]], Counts]:
    """Return the ball of a scene, each orbit's initial state and impacts, and `_count_misses`."""
    ball, starts, impacts = Ball(**block["ball"]), block["starts"], block["impacts"]
    states = [start_state(ball, block["energy"], start) for start in starts]
    each = impacts if isinstance(impacts, list) else [impacts] * len(starts)
    orbits = list(zip(states, each, strict=True))
    flights = zip(*(certified_orbit(ball, *orbit) for orbit in orbits), strict=True)
    return ball, orbits, _count_misses(ball, *(np.concatenate(part, axis=-1) for part in flights))


def _count_misses(ball: Ball, columns: np.ndarray, truth: np.ndarray) -> Counts:
    """Return each method's wrong roots, its evaluations a flight, and the number of flights.

    `truth` has the flight times (n,) from the states (3, n).
    """
    solved = [method.solve(ball, *columns) for method in METHODS]
    missed = [is_wrong(tau, truth).sum() for tau, _ in solved]
    return np.array(missed), np.array([count.mean() for _, count in solved]), truth.size


def _next_states(ball: Ball, columns: np.ndarray, tau: np.ndarray) -> np.ndarray:
    """Return the states (3, n) after flights of times `tau` from states `columns`, eq. (26)."""
    x, xdot, udot = columns
    b, c, _ = rebound(xdot, udot, ball.k, impact_coefficients(ball.k))
    sine, cosine = sincos_each(tau)
    return np.array([x * cosine - c * sine, b + ball.g * tau, x * sine + c * cosine])


@jit
def _log_stretch(jacobians: np.ndarray) -> float:
    """Return the log of the factor by which a product of matrices (n, 3, 3) stretches (1, 0, 0)."""
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
