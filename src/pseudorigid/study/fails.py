"""Where methods fail: near grazing, near misses, on the chaotic orbit, and in energy and agreement.

`edges` works with any methods; `orbits` with the compiled ones, whose orbits it follows for a
million impacts. A failure is a wrong root as in `work.is_wrong`.
"""

import numpy as np
import xarray as xr

from ..proofs import judge
from . import states
from .methods import counted as own
from .states import BALL
from .work import is_wrong, named

DISTANCES = range(13)  # s = 1 ... 1e-12
DEPTHS = range(2, 15)  # 1e-2 ... 1e-14
MILLION = 1_000_000
RECORDS = (*(m * 10**e for e in range(6) for m in (1, 2, 5)), MILLION)
AGREE_IMPACTS = 170
AGREE_STARTS = 15
APART = 1e-3  # of x: by then the eye sees it

EDGE_METHODS = (
    own.OURS,
    *(own.scan_method(step, 1e-12) for step in (0.5, 0.1, 0.01)),
    own.engine_method(1e-3),
)
ORBIT_METHODS = (
    own.OURS,
    *(own.scan_method(step, 1e-12) for step in (0.5, 0.2, 0.1, 0.05, 0.02, 0.01)),
    *(own.scan_method(0.1, tolerance) for tolerance in (1e-3, 1e-6, 1e-9)),
    own.engine_method(1e-2),
    own.engine_method(1e-3),
)


def _var(dims, values, text):
    return dims, np.asarray(values), {"long_name": text, "units": "1"}


def edges(methods, count=200):
    """Dataset: share of `count` states that fail, no answers and wrong roots alike.

    near (method, side, distance): against s = xdot + udot; touch (method, side, depth): against
    the height of a maximum of the gap.
    """
    near = np.empty((len(methods), 2, len(DISTANCES)))
    touch = np.empty((len(methods), 2, len(DEPTHS)))
    for j, side in enumerate((1, -1)):
        for i, exponent in enumerate(DISTANCES):
            near[:, j, i] = _shares(methods, states.distance(exponent, side, count))
        for i, exponent in enumerate(DEPTHS):
            touch[:, j, i] = _shares(
                methods, states.near_miss(side * float(f"1e-{exponent}"), count)
            )
    return xr.Dataset(
        named(methods)
        | {
            "near": _var(("method", "side", "distance"), near, "failing share, by xdot + udot"),
            "touch": _var(
                ("method", "side", "depth"), touch, "failing share, by height of a maximum"
            ),
            "side": _var("side", [1, -1], "sign of x + g, and of the maximum's height"),
            "distance": _var(
                "distance", list(DISTANCES), "minus the decimal exponent of xdot + udot"
            ),
            "depth": _var(
                "depth", list(DEPTHS), "minus the decimal exponent of the maximum's height"
            ),
        },
        attrs={"states": count},
    )


def _shares(methods, columns):
    truth = np.array(judge.flight_times(BALL, *columns))
    return [is_wrong(method.solve(BALL, *columns)[0], truth).mean() for method in methods]


def orbits(impacts=MILLION):
    """Dataset of the compiled methods along the chaotic orbit.

    missed: impacts of the certified orbit that the method flies past; drift (method, record): the
    largest relative error of the energy so far on the method's own orbit; apart (method, impact):
    median over starts of the distance in x between the method's orbit and the judge's; agree
    (method, method): for how many impacts two methods' orbits stay within APART, the last row and
    column the judge's.
    """
    methods = ORBIT_METHODS
    records = [n for n in RECORDS if n <= impacts]
    start = states.chaotic()
    missed, evaluations, drift = [], [], []
    for method in methods:
        wrong, count = method.missed(BALL, start, impacts)
        missed.append(wrong)
        evaluations.append(count / impacts)
        drift.append(method.orbit(BALL, start, records)[0][:, 3])
    starts = [BALL.start(f, states.ENERGY) for f in 0.52 + 0.01 * np.arange(AGREE_STARTS)]
    every = np.arange(1, AGREE_IMPACTS + 1)
    tracks = np.empty((len(methods) + 1, AGREE_STARTS, AGREE_IMPACTS))
    for j, state in enumerate(starts):
        for i, method in enumerate(methods):
            tracks[i, j] = method.orbit(BALL, state, every)[0][:, 0]
        tracks[-1, j] = np.array(judge.orbit(BALL, state, AGREE_IMPACTS))[:, 0]
    apart = np.median(np.abs(tracks[:-1] - tracks[-1]), axis=1)
    agree = [[_agreement(one, other) for other in tracks] for one in tracks]
    return xr.Dataset(
        named(methods)
        | {
            "missed": _var("method", missed, "impacts flown past"),
            "evaluations": _var("method", evaluations, "evaluations an impact"),
            "drift": _var(("method", "record"), drift, "largest relative error of the energy"),
            "record": _var("record", records, "number of impacts"),
            "apart": _var(
                ("method", "impact"), apart, "median distance in x from the judge's orbit"
            ),
            "impact": _var("impact", every, "number of impacts"),
            "agree": _var(
                ("one", "other"), agree, "impacts until two orbits are apart, the judge's last"
            ),
        },
        attrs={"impacts": impacts, "apart": APART},
    )


def _agreement(one, other):
    """The median over starts of the number of impacts before two orbits are APART."""
    beyond = np.abs(one - other) > APART
    first = np.where(beyond.any(axis=1), beyond.argmax(axis=1), beyond.shape[1])
    return float(np.median(first))


def missed(methods, impacts=MILLION):
    """Dataset: how many of the impacts that the coarsest scan misses others miss as well.

    The certified chaotic orbit is followed for `impacts` impacts; where a scan with step 0.5
    gives a wrong root the methods are asked too. What they miss elsewhere is not counted: a lower
    bound.
    """
    columns = own.hard_states(BALL, states.chaotic(), impacts, own.scan_method(0.5, 1e-12))
    truth = np.array(judge.flight_times(BALL, *columns))
    count = [is_wrong(method.solve(BALL, *columns)[0], truth).sum() for method in methods]
    text = "impacts missed, of those that scan 0.5 misses"
    attrs = {"impacts": impacts, "hard": truth.size}
    return xr.Dataset(named(methods) | {"missed": _var("method", count, text)}, attrs=attrs)
