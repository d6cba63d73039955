"""Failures of methods: near grazing, at near misses, along the chaotic orbit, and in its energy.

`edges` and `missed` work with any methods, `orbits` with the compiled ones, whose orbits it follows
for a million impacts. A failure is a wrong root, `work.is_wrong`.
"""

from collections.abc import Callable, Sequence

import numpy as np
import xarray as xr

from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.variables import LENGTH

from . import reference_solver, states
from .methods.counted_methods import OURS, engine_method, scan_method
from .states import BALL
from .work import dataset, is_wrong, proved_times

SIDES = (1, -1)
DISTANCES = range(13)  # s = 1 ... 1e-12
DEPTHS = range(2, 15)  # heights 1e-2 ... 1e-14; lower ones are lost in the gap's rounding errors
MILLION = 1_000_000
RECORDS = np.array([*(m * 10**e for e in range(6) for m in (1, 2, 5)), MILLION])  # impacts
AGREE_IMPACTS = 170  # by then a rounding error has grown to order one on every orbit
AGREE_STARTS = 15  # in the sea; odd, so that the median is the value of one of them
SEPARATION = 1e-3  # of x, which is visible

EDGE_METHODS = OURS, *(scan_method(step, 1e-12) for step in (0.5, 0.1, 0.01)), engine_method(1e-3)
ORBIT_METHODS = (
    OURS,
    *(scan_method(step, 1e-12) for step in (0.5, 0.2, 0.1, 0.05, 0.02, 0.01)),
    *(scan_method(0.1, tolerance) for tolerance in (1e-3, 1e-6, 1e-9)),
    engine_method(1e-2),
    engine_method(1e-3),
)


def edges(methods, count: int = 200) -> xr.Dataset:
    """Compute the share of wrong or missing roots near grazing and near misses.

    `count` states are used at each distance from grazing and each height of a maximum. In the
    dataset near (method, side, distance) is against s = xdot + udot, and touch (method, side,
    depth) against the height of a maximum of the gap.
    """

    def failing(states_at: Callable, exponents: Sequence[int]) -> np.ndarray:
        """Return failing shares (method, side, exponent) over states_at(side, exponent)."""
        shares = np.empty((len(methods), len(SIDES), len(exponents)))
        for j, side in enumerate(SIDES):
            for i, exponent in enumerate(exponents):
                columns = states_at(side, exponent)
                truth = proved_times(BALL, columns)
                for m, method in enumerate(methods):
                    shares[m, j, i] = is_wrong(method.solve(BALL, *columns)[0], truth).mean()
        return shares

    near = failing(lambda side, e: states.grazing_at(e, side, count), DISTANCES)
    touch = failing(lambda side, e: states.near_miss(side * states.TEN_TO_MINUS[e], count), DEPTHS)
    variables = {
        "near": (("method", "side", "distance"), near, "failing share, by xdot + udot"),
        "touch": (("method", "side", "depth"), touch, "failing share, by height of a maximum"),
        "side": ("side", SIDES, "sign of x + g, and of the maximum's height"),
        "distance": ("distance", DISTANCES, "minus the decimal exponent of xdot + udot"),
        "depth": ("depth", DEPTHS, "minus the decimal exponent of the maximum's height"),
    }
    return dataset(methods, variables, states=count)


def certified_orbit(ball: Ball, state, impacts: int) -> tuple[np.ndarray, np.ndarray]:
    """Return states (3, impacts) of the certified orbit from `state`, and the flight times."""
    track, _ = OURS.orbit(ball, state, impacts)
    return np.column_stack((state, track[:3, :-1])), track[3]


def energy_drift(ball: Ball, state, track: np.ndarray) -> np.ndarray:
    """Return the largest relative error of the energy so far, at each impact of `track`."""

    def energy(x, v, w):
        return (0.5 * v * v + 0.5 * ball.k * w * w) + x * (0.5 * ball.k * x - ball.g)

    first = energy(*state)
    return np.maximum.accumulate(np.abs(energy(*track[:3]) - first) / abs(first))


def orbits(impacts: int = MILLION) -> xr.Dataset:
    """Compare the methods in this package's arithmetic along the chaotic orbit.

    The dataset has missed, evaluations (method): impacts of the certified orbit that the method
    flies past, and what it spends on one; drift (method, record): the largest relative error of the
    energy so far on the method's own orbit; apart (method, impact): median over starts of the
    distance in x between the method's orbit and the proved one; agree (one, other): for how many
    impacts two methods' orbits stay within SEPARATION, the last row and column the proved orbit's.
    """
    methods = ORBIT_METHODS
    start = states.chaotic()
    columns, truth = certified_orbit(BALL, start, impacts)
    records = RECORDS[impacts >= RECORDS]
    missed, evaluations, drift = [], [], []
    for method in methods:
        tau, count = method.solve(BALL, *columns)
        missed.append(is_wrong(tau, truth).sum())
        evaluations.append(count.mean())
        track, _ = method.orbit(BALL, start, impacts)
        drift.append(energy_drift(BALL, start, track)[records - 1])
    starts = [BALL.start(f, states.ENERGY) for f in 0.52 + 0.01 * np.arange(AGREE_STARTS)]
    tracks = [[m.orbit(BALL, state, AGREE_IMPACTS)[0][0] for state in starts] for m in methods]
    tracks.append([[x for x, *_ in reference_solver.orbit(BALL, s, AGREE_IMPACTS)] for s in starts])
    tracks = np.array(tracks)
    apart = np.median(np.abs(tracks[:-1] - tracks[-1]), axis=1)
    agree = [[_agreement(a, b) for b in tracks] for a in tracks]
    distance = "median distance in x from the judge's orbit"
    variables = {
        "missed": ("method", missed, "impacts flown past"),
        "evaluations": ("method", evaluations, "evaluations an impact"),
        "drift": (("method", "record"), drift, "largest relative error of the energy"),
        "record": ("record", records, "number of impacts"),
        "apart": (("method", "impact"), apart, distance, LENGTH),
        "impact": ("impact", np.arange(1, AGREE_IMPACTS + 1), "number of impacts"),
        "agree": (("one", "other"), agree, "impacts until two orbits are apart, the judge's last"),
    }
    return dataset(methods, variables, impacts=impacts, apart=SEPARATION)


def _agreement(a: np.ndarray, b: np.ndarray) -> float:
    """Return the median over starts of the impacts before two orbits differ by SEPARATION."""
    beyond = np.abs(a - b) > SEPARATION
    first = np.where(beyond.any(axis=1), beyond.argmax(axis=1), beyond.shape[1])
    return float(np.median(first))


def missed(methods, impacts: int = MILLION) -> xr.Dataset:
    """Count the impacts of the certified chaotic orbit that both the coarsest scan and others miss.

    The methods solve only the flights for which a scan with step 0.5 gives a wrong root. What they
    miss elsewhere is not counted, so the count, missed (method), is a lower bound.
    """
    columns, certified = certified_orbit(BALL, states.chaotic(), impacts)
    hard = is_wrong(scan_method(0.5, 1e-12).solve(BALL, *columns)[0], certified)
    columns = columns[:, hard]
    truth = proved_times(BALL, columns)
    count = [is_wrong(method.solve(BALL, *columns)[0], truth).sum() for method in methods]
    variables = {"missed": ("method", count, "impacts missed, of those that scan 0.5 misses")}
    return dataset(methods, variables, impacts=impacts, hard=truth.size)
