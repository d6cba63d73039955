"""Comparisons of the methods. Their data are equal on every machine.

A flight time fails if it is missing or another root's (`is_wrong`).

What libraries give differs between machines in the last digits, and takes long. It was computed
once by tests/study/record.py, with what else takes long, and is read from recorded.json.
"""

import json
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from pseudorigid.dynamics.ball import Ball, State
from pseudorigid.dynamics.variables import LENGTH, described
from pseudorigid.verified import reference_solver

from . import states
from .methods import Method
from .methods.counted_methods import (
    BEST_METHODS,
    CAREFUL_SCANS,
    COUNTS,
    ENGINES,
    METHODS,
    OURS,
    SCANS,
    CountedMethod,
    scan_method,
)
from .states import BALL

SETS = {"uniform": states.uniform, "near-grazing": states.grazing}
SIDES = (1, -1)  # signs of x + g at grazing, and of the maximum's height at near misses
DISTANCES = range(13)  # s = 1 ... 1e-12
DEPTHS = range(2, 15)  # heights 1e-2 ... 1e-14; lower ones are lost in the gap's rounding errors
MILLION = 1_000_000
RECORDS = np.array([*(m * 10**e for e in range(6) for m in (1, 2, 5)), MILLION])  # impacts
AGREE_IMPACTS = 170  # of each start; by then a rounding error has grown to order one
AGREE_STARTS = 15  # in the sea; odd, so that the median is the value of one of them
SEPARATION = 1e-3  # of x, which is visible
SEA_FLIGHTS = 100_000  # on which all methods count their misses
RECORDED = Path(__file__).with_name("recorded.json")

_FINE_SCANS = SCANS[3::4]  # steps of 0.5, 0.1 and 0.01, to 1e-12
EDGE_METHODS = (*BEST_METHODS, CAREFUL_SCANS[0], CAREFUL_SCANS[3], *_FINE_SCANS, ENGINES[2])
ORBIT_METHODS = (
    *BEST_METHODS[:3],  # the others are as accurate
    *(
        replace(scan_method(step, 1e-12), family="scan 0.5 to 0.01")
        for step in (0.5, 0.2, 0.1, 0.05, 0.02, 0.01)
    ),
    *SCANS[4:7],  # steps of 0.1 with coarser tolerances
    *ENGINES[1:3],
)
MISS_METHODS = *_FINE_SCANS[:2], *BEST_METHODS[1:], *CAREFUL_SCANS[:5]


def work() -> xr.Dataset:
    """Compare accuracy, evaluations and misses of all methods, with recorded ones and times."""
    here = accuracy(METHODS).assign(missed(METHODS, [SEA_FLIGHTS] * len(METHODS)))
    parts = with_recorded(here, "work"), counts(METHODS), recorded("times")
    return xr.merge(parts, combine_attrs="override")


def counts(methods: Sequence[CountedMethod], count: int = 20_000) -> xr.Dataset:
    """Count what a flight costs (counted, drawn): COUNTS, on sets of states.

    The sets are those of SETS, the sea, and touches of height 1e-6.
    """
    sea, _ = certified_orbit(BALL, states.chaotic(), count)
    touches = states.near_miss(states.TEN_TO_MINUS[6], count // 10)
    drawn = {name: states_of(count) for name, states_of in SETS.items()}
    drawn |= {"sea": sea, "touches": touches}
    found = [[m.counted(BALL, *c)[1].mean(axis=1) for c in drawn.values()] for m in methods]
    texts = "sines with their cosines", "rotations by a known angle", "inverse functions"
    variables = {
        name: (("counted", "drawn"), values, f"mean number of {text} a flight")
        for name, text, values in zip(
            COUNTS, texts, np.moveaxis(np.array(found), -1, 0), strict=True
        )
    }
    names = {"counted_name": ("counted", [m.name for m in methods], "method and its settings")}
    names["drawn_set"] = "drawn", [*drawn], "set of states"
    return xr.Dataset(described(names | variables))


def accuracy(
    methods: Sequence[Method], count: int = 2000, title: str = "accuracy and work"
) -> xr.Dataset:
    """Compute (method, set): errors and evaluations on sets of states."""
    sets = [states_of(count) for states_of in SETS.values()]
    pairs = [(columns, proved_times(BALL, columns)) for columns in sets]
    values = np.array([[_accuracy(method, *pair) for pair in pairs] for method in methods])
    median, worst, wrong, six, twelve, evaluations = np.moveaxis(values, -1, 0)
    dims = ("method", "set")
    variables = {
        "state_set": ("set", list(SETS), "set of states"),
        "states": ("method", [count] * len(methods), "states of each set"),
        "median": (dims, median, "median relative error of tau"),
        "worst": (dims, worst, "worst relative error of tau among the right roots"),
        "wrong": (dims, wrong, "share of wrong roots"),
        "above_1e6": (dims, six, "share of relative errors above 1e-6, with wrong roots"),
        "above_1e12": (dims, twelve, "share of relative errors above 1e-12, with wrong roots"),
        "evaluations": (dims, evaluations, "mean number of evaluations a flight"),
    }
    return dataset(title, methods, variables)


def missed(methods: Sequence[Method], flights: Sequence[int]) -> dict[str, Any]:
    """Count the impacts that methods miss on the certified chaotic orbit, as variables.

    `missed_hard` is of the flights, among a million, for which a scan with step 0.5 has a wrong
    root. `missed_sea` is of the first `flights` ones, a number for each method.
    """
    columns, truth = certified_orbit(BALL, states.chaotic(), MILLION)
    hard = is_wrong(_FINE_SCANS[0].solve(BALL, *columns)[0], truth)

    def misses(method: Method, chosen: Any) -> int:
        return int(is_wrong(method.solve(BALL, *columns[:, chosen])[0], truth[chosen]).sum())

    sea = [misses(m, slice(n)) if n else 0 for m, n in zip(methods, flights, strict=True)]
    of_hard = f"wrong roots of the {hard.sum()} that scan 0.5 misses"
    table = {
        "missed_hard": ("method", [misses(m, hard) for m in methods], of_hard),
        "missed_sea": ("method", sea, "wrong roots of `sea` flights"),
        "sea": ("method", [*flights], "flights of the chaotic orbit, from its start"),
    }
    return described(table)


def edges() -> xr.Dataset:
    """Compare failures of all methods near grazing and near misses, with the recorded ones."""
    return with_recorded(failures(EDGE_METHODS), "edges")


def failures(methods: Sequence[Method], count: int = 200) -> xr.Dataset:
    """Compute the share of wrong or missing roots near grazing and near misses.

    near (method, side, distance) is the share for states at a distance s = xdot + udot from
    grazing, touch (method, side, depth) for flights whose gap has a maximum of a given height.
    `count` states are used for each side and distance or depth.
    """
    grazing = [[states.grazing_at(e, side, count) for e in DISTANCES] for side in SIDES]
    heights = [[side * states.TEN_TO_MINUS[e] for e in DEPTHS] for side in SIDES]
    touching = [[states.near_miss(height, count) for height in row] for row in heights]

    def failing_shares(sets: list[list[np.ndarray]]) -> np.ndarray:
        shares = [[wrong_roots(methods, columns).mean(axis=1) for columns in row] for row in sets]
        return np.array(shares).transpose(2, 0, 1)

    near, touch = failing_shares(grazing), failing_shares(touching)
    variables = {
        "near": (("method", "side", "distance"), near, "failing share, by xdot + udot"),
        "touch": (("method", "side", "depth"), touch, "failing share, by height of a maximum"),
        "side": ("side", SIDES, "sign of x + g, and of the maximum's height"),
        "distance": ("distance", DISTANCES, "minus the decimal exponent of xdot + udot"),
        "depth": ("depth", DEPTHS, "minus the decimal exponent of the maximum's height"),
    }
    return dataset("failures", methods, variables, states=count)


def drift(impacts: int = MILLION) -> xr.Dataset:
    """Compare the methods in this package's arithmetic along the orbit of `states.chaotic`.

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
    agree = [[_impacts_until_apart(a, b) for b in positions] for a in positions]
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
    return dataset("orbits", ORBIT_METHODS, variables, impacts=impacts, apart=SEPARATION)


def misses(most: int = 10 * MILLION) -> xr.Dataset:
    """Count misses among ten million flights or `most`, with the recorded counts and searches."""
    parts = missed_flights(most=most), recorded("flights"), recorded("search")
    return xr.merge(parts, compat="override")


def missed_flights(
    methods: Sequence[CountedMethod] = MISS_METHODS, most: int = 10 * MILLION
) -> xr.Dataset:
    """Count the impacts that methods miss among the flights of one certified orbit in the sea.

    missed (method, flights) is the count among the first 1e3, 1e4, ... `most` flights, and `first`
    the place of a method's first miss, -1 if there is none, with its state. Where a method and the
    march differ, the reference solver decides which of them is wrong.
    """
    flights = [10**e for e in range(3, len(str(most)))]
    places: list[list[int]] = [[] for _ in range(len(methods) + 1)]  # of misses; the march's first
    firsts = np.full((len(methods) + 1, 3), np.nan)
    state, done = states.chaotic(), 0
    while done < most:
        columns, truth = certified_orbit(BALL, state, min(MILLION, most - done))
        for i, method in enumerate(methods, 1):
            tau, _ = method.solve(BALL, *columns)
            for j in np.flatnonzero(is_wrong(tau, truth)).tolist():
                proved = proved_times(BALL, columns[:, j : j + 1])
                wrong = 0 if is_wrong(truth[j : j + 1], proved)[0] else i
                firsts[wrong] = firsts[wrong] if places[wrong] else columns[:, j]
                places[wrong].append(done + j)
        done += columns.shape[1]
        state = BALL.impact(*columns[:, -1])[:3]
    count = [[sum(place < n for place in row) for n in flights] for row in places]
    first = [min(row, default=-1) for row in places]
    variables = {
        "missed": (("method", "flights"), count, "impacts missed among the first flights"),
        "flights": ("flights", flights, "number of flights"),
        "first": ("method", first, "place of the first miss, -1 if there is none"),
        "state": (("method", "variable"), firsts, "x, xdot and udot before the first miss"),
    }
    return dataset("impacts missed", (OURS, *methods), variables)


def recorded(name: str) -> xr.Dataset:
    """Return a dataset of recorded.json."""
    return xr.Dataset.from_dict(json.loads(RECORDED.read_text(encoding="utf-8"))[name])


def with_recorded(data: xr.Dataset, name: str) -> xr.Dataset:
    """Return the methods of a dataset and then the recorded ones."""
    parts = data, recorded(name)
    return xr.concat(parts, "method", data_vars="minimal", combine_attrs="override")


def dataset(
    title: str, methods: Sequence[Method], variables: dict[str, tuple[Any, ...]], **attrs: float
) -> xr.Dataset:
    """Return a dataset of `variables`, with the names and families of methods on `method`."""
    names = {
        "name": ("method", [m.name for m in methods], "method and its settings"),
        "family": ("method", [m.family for m in methods], "methods that differ in one setting"),
    }
    texts = {"stage": "study", "title": f"Methods compared: {title}"}
    ball = {"k": BALL.k, "g": BALL.g, "energy": states.ENERGY}
    return xr.Dataset(described(names | variables), attrs=attrs | texts | ball)


def proved_times(ball: Ball, columns: np.ndarray) -> np.ndarray:
    """Return the proved flight times (n,) of states (3, n), rounded to doubles."""
    times = (reference_solver.first_root(ball.k, ball.g, *state) for state in columns.T.tolist())
    return np.array([float(tau) for tau in times])


def is_wrong(tau: np.ndarray, truth: np.ndarray) -> np.ndarray:
    """Return which tau are NaN or off by more than a tenth of the flight, or of a time unit.

    Such a tau counts as another root, not as an inaccurate one.
    """
    return ~(np.abs(tau - truth) <= 0.1 * np.minimum(truth, 1.0))


def wrong_roots(methods: Sequence[Method], columns: np.ndarray) -> np.ndarray:
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

    x, v, w = np.column_stack((np.array(state), track[:3]))
    energy = (0.5 * v * v + 0.5 * ball.k * w * w) + x * (0.5 * ball.k * x - ball.g)
    return np.maximum.accumulate(np.abs(energy[1:] - energy[0]) / abs(energy[0]))


def _accuracy(method: Method, columns: np.ndarray, truth: np.ndarray) -> tuple[float, ...]:
    """Return median and worst error, shares of wrong roots and errors, and evaluations.

    A missing root has an infinite error.
    """
    tau, count = method.solve(BALL, *columns)
    error, wrong = np.abs(tau - truth) / truth, is_wrong(tau, truth)
    error = np.where(np.isnan(error), np.inf, error)
    above = ((wrong | (error > limit)).mean() for limit in (1e-6, 1e-12))
    worst = error[~wrong].max(initial=0.0)
    return np.median(error), worst, wrong.mean(), *above, count.mean()


def _positions() -> np.ndarray:
    """Return x (method, start, impact) of the orbits by ORBIT_METHODS, and then the proved ones."""
    starts = [BALL.start(f, states.ENERGY) for f in 0.52 + 0.01 * np.arange(AGREE_STARTS)]
    computed = [[m.orbit(BALL, s, AGREE_IMPACTS)[0][0] for s in starts] for m in ORBIT_METHODS]
    proved = [[x for x, *_ in reference_solver.orbit(BALL, s, AGREE_IMPACTS)] for s in starts]
    return np.array([*computed, proved])


def _impacts_until_apart(a: np.ndarray, b: np.ndarray) -> float:
    """Return after how many impacts two methods' orbits differ by SEPARATION, median of starts."""
    beyond = np.abs(a - b) > SEPARATION
    first = np.where(beyond.any(axis=1), beyond.argmax(axis=1), beyond.shape[1])
    return float(np.median(first))
