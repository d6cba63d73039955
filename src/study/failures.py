"""Failures of methods: near grazing, at near misses, along the chaotic orbit, and in its energy.

A failure is a flight time that is missing or another root's, `work.is_wrong`. The chaotic orbit is
that of `states.chaotic`, in Figure 2's sea. `edges` and `missed` work with any methods, `orbits`
with the compiled ones, whose own orbits it follows for a million impacts.
"""

from collections.abc import Sequence

import numpy as np
import xarray as xr

from pseudorigid.dynamics.ball import Ball, Result, State
from pseudorigid.dynamics.variables import LENGTH

from . import reference_solver, states
from .methods import Method
from .methods.counted_methods import OURS, engine_method, scan_method
from .states import BALL
from .work import dataset, is_wrong, proved_times

SIDES = (1, -1)  # signs of x + g at grazing, and of the maximum's height at near misses
DISTANCES = range(13)  # s = 1 ... 1e-12
DEPTHS = range(2, 15)  # heights 1e-2 ... 1e-14; lower ones are lost in the gap's rounding errors
MILLION = 1_000_000
RECORDS = np.array([*(m * 10**e for e in range(6) for m in (1, 2, 5)), MILLION])  # impacts
AGREE_IMPACTS = 170  # of each start; by then a rounding error has grown to order one
AGREE_STARTS = 15  # in the sea; odd, so that the median is the value of one of them
SEPARATION = 1e-3  # of x, which is visible

EDGE_METHODS = OURS, *(scan_method(step, 1e-12) for step in (0.5, 0.1, 0.01)), engine_method(1e-3)
ORBIT_METHODS = (
    OURS,
    *(scan_method(step, 1e-12) for step in (0.5, 0.2, 0.1, 0.05, 0.02, 0.01)),
    *(scan_method(0.1, tolerance) for tolerance in (1e-3, 1e-6, 1e-9)),
    *map(engine_method, (1e-2, 1e-3)),
)


def edges(methods: Sequence[Method], count: int = 200) -> xr.Dataset:
    """Compute the share of wrong or missing roots near grazing and near misses.

    near (method, side, distance) is the share for states at a distance s = xdot + udot from
    grazing, touch (method, side, depth) for flights whose gap has a maximum of a given height.
    `count` states are used for each side and distance or depth.
    """

    def failing(columns: np.ndarray) -> np.ndarray:
        """Return the failing share of each method."""
        return _wrong_roots(methods, columns).mean(axis=1)

    grazing = [[failing(states.grazing_at(e, side, count)) for e in DISTANCES] for side in SIDES]
    touching = [
        [failing(states.near_miss(side * states.TEN_TO_MINUS[e], count)) for e in DEPTHS]
        for side in SIDES
    ]
    near, touch = (np.array(shares).transpose(2, 0, 1) for shares in (grazing, touching))
    variables = {
        "near": (("method", "side", "distance"), near, "failing share, by xdot + udot"),
        "touch": (("method", "side", "depth"), touch, "failing share, by height of a maximum"),
        "side": ("side", SIDES, "sign of x + g, and of the maximum's height"),
        "distance": ("distance", DISTANCES, "minus the decimal exponent of xdot + udot"),
        "depth": ("depth", DEPTHS, "minus the decimal exponent of the maximum's height"),
    }
    return dataset(methods, variables, states=count)


def _wrong_roots(methods: Sequence[Method], columns: np.ndarray) -> np.ndarray:
    """Return whether each method's roots (method, n) are wrong, of flights from states (3, n)."""
    truth = proved_times(BALL, columns)
    return np.array([is_wrong(method.solve(BALL, *columns)[0], truth) for method in methods])


def certified_orbit(ball: Ball, state: State, impacts: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the states (3, impacts) from which a certified orbit's flights start, and their times.

    The first one is `state`.
    """
    track, _ = OURS.orbit(ball, state, impacts)
    return states_before(state, track), track[3]


def states_before(state: State, track: np.ndarray) -> np.ndarray:
    """Return the states (3, n) from which flights start, for a track of `CountedMethod.orbit`."""
    return np.column_stack((np.array(state), track[:3, :-1]))


def energy_drift(ball: Ball, state: State, track: np.ndarray) -> np.ndarray:
    """Return, at each impact of a track, the largest relative error of the energy up to it."""

    def energy(x: Result, v: Result, w: Result) -> Result:
        return (0.5 * v * v + 0.5 * ball.k * w * w) + x * (0.5 * ball.k * x - ball.g)

    first = energy(*state)
    return np.maximum.accumulate(np.abs(energy(*track[:3]) - first) / abs(first))


def orbits(impacts: int = MILLION) -> xr.Dataset:
    """Compare the methods in this package's arithmetic along the chaotic orbit.

    The methods solve the flights of the certified orbit for `missed` and `evaluations`; `drift` is
    the energy error of each method's own orbit. From AGREE_STARTS other starts, `apart` is the
    median distance in x between a method's orbit and the proved one, and `agree` the median number
    of impacts for which two of these orbits, the last of them proved, stay within SEPARATION.
    """
    start = states.chaotic()
    columns, truth = certified_orbit(BALL, start, impacts)
    records = RECORDS[impacts >= RECORDS]
    missed, evaluations, drift = [], [], []
    for method in ORBIT_METHODS:
        tau, count = method.solve(BALL, *columns)
        missed.append(is_wrong(tau, truth).sum())
        evaluations.append(count.mean())
        track, _ = method.orbit(BALL, start, impacts)
        drift.append(energy_drift(BALL, start, track)[records - 1])
    positions = _positions()
    distances = np.median(np.abs(positions[:-1] - positions[-1]), axis=1)
    agree = [[_agreement(a, b) for b in positions] for a in positions]
    distance = "median distance in x from the judge's orbit"
    variables = {
        "missed": ("method", missed, "impacts flown past"),
        "evaluations": ("method", evaluations, "evaluations an impact"),
        "drift": (("method", "record"), drift, "largest relative error of the energy"),
        "record": ("record", records, "number of impacts"),
        "apart": (("method", "impact"), distances, distance, LENGTH),
        "impact": ("impact", np.arange(1, AGREE_IMPACTS + 1), "number of impacts"),
        "agree": (("one", "other"), agree, "impacts until two orbits are apart, the judge's last"),
    }
    return dataset(ORBIT_METHODS, variables, impacts=impacts, apart=SEPARATION)


def _positions() -> np.ndarray:
    """Return x (method, start, impact) of the orbits by ORBIT_METHODS, and then the proved ones."""
    starts = [BALL.start(f, states.ENERGY) for f in 0.52 + 0.01 * np.arange(AGREE_STARTS)]
    computed = [[m.orbit(BALL, s, AGREE_IMPACTS)[0][0] for s in starts] for m in ORBIT_METHODS]
    proved = [[x for x, *_ in reference_solver.orbit(BALL, s, AGREE_IMPACTS)] for s in starts]
    return np.array([*computed, proved])


def _agreement(a: np.ndarray, b: np.ndarray) -> float:
    """Return after how many impacts two methods' orbits differ by SEPARATION, median of starts."""
    beyond = np.abs(a - b) > SEPARATION
    first = np.where(beyond.any(axis=1), beyond.argmax(axis=1), beyond.shape[1])
    return float(np.median(first))


def missed(methods: Sequence[Method], impacts: int = MILLION) -> xr.Dataset:
    """Count the impacts of the certified chaotic orbit that the coarsest scan and each method miss.

    The methods solve only the flights for which a scan with step 0.5 gives a wrong root. The result
    missed (method) is therefore a lower bound of the impacts that a method misses on the orbit.
    """
    columns, certified = certified_orbit(BALL, states.chaotic(), impacts)
    hard = is_wrong(scan_method(0.5, 1e-12).solve(BALL, *columns)[0], certified)
    count = _wrong_roots(methods, columns[:, hard]).sum(axis=1)
    variables = {"missed": ("method", count, "impacts missed, of those that scan 0.5 misses")}
    return dataset(methods, variables, impacts=impacts, hard=int(hard.sum()))
