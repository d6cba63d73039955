"""Where methods fail: near grazing, near misses, on the chaotic orbit, and in energy and agreement.

`edges` works with any methods; `orbits` with the compiled ones, whose orbits it follows for a
million impacts. A failure is a wrong root as in `work.is_wrong`.
"""

import numpy as np

from ..dynamics.variables import LENGTH
from ..proofs import reference_solver
from . import states
from .methods.counted_methods import OURS, engine_method, scan_method
from .states import BALL
from .work import dataset, is_wrong, proved_times

SIDES = (1, -1)
DISTANCES = range(13)  # s = 1 ... 1e-12
DEPTHS = range(2, 15)  # 1e-2 ... 1e-14: below, the height is lost in the gap's own roundings
MILLION = 1_000_000
RECORDS = np.array([*(m * 10**e for e in range(6) for m in (1, 2, 5)), MILLION])
AGREE_IMPACTS = 170  # by then a rounding has grown to order one in every orbit
AGREE_STARTS = 15  # of the sea, odd for a median that is one of them
SEPARATION = 1e-3  # of x: by then the eye sees it

EDGE_METHODS = OURS, *(scan_method(step, 1e-12) for step in (0.5, 0.1, 0.01)), engine_method(1e-3)
ORBIT_METHODS = (
    OURS,
    *(scan_method(step, 1e-12) for step in (0.5, 0.2, 0.1, 0.05, 0.02, 0.01)),
    *(scan_method(0.1, tolerance) for tolerance in (1e-3, 1e-6, 1e-9)),
    engine_method(1e-2),
    engine_method(1e-3),
)


def edges(methods, count=200):
    """The share of `count` states that fail, no answers and wrong roots alike.

    Parameters
    ----------
    methods : sequence
        As described in `methods`.
    count : int
        States a distance or height.

    Returns
    -------
    xarray.Dataset
        near (method, side, distance): against s = xdot + udot; touch (method, side, depth):
        against the height of a maximum of the gap.
    """
    near = _failing(methods, lambda side, e: states.grazing_at(e, side, count), DISTANCES)
    touch = _failing(
        methods, lambda side, e: states.near_miss(side * states.TEN_TO_MINUS[e], count), DEPTHS
    )
    variables = {
        "near": (("method", "side", "distance"), near, "failing share, by xdot + udot"),
        "touch": (("method", "side", "depth"), touch, "failing share, by height of a maximum"),
        "side": ("side", SIDES, "sign of x + g, and of the maximum's height"),
        "distance": ("distance", DISTANCES, "minus the decimal exponent of xdot + udot"),
        "depth": ("depth", DEPTHS, "minus the decimal exponent of the maximum's height"),
    }
    return dataset(methods, variables, states=count)


def _failing(methods, chosen, exponents):
    """Failing shares (method, side, exponent) over the states chosen(side, exponent)."""
    shares = np.empty((len(methods), len(SIDES), len(exponents)))
    for j, side in enumerate(SIDES):
        for i, exponent in enumerate(exponents):
            columns = chosen(side, exponent)
            truth = proved_times(BALL, columns)
            for place, method in enumerate(methods):
                shares[place, j, i] = is_wrong(method.solve(BALL, *columns)[0], truth).mean()
    return shares


def certified_orbit(ball, state, impacts):
    """(states (3, impacts), flight times) of the certified orbit: each state and what follows."""
    track, _ = OURS.orbit(ball, state, impacts)
    return np.column_stack((state, track[:3, :-1])), track[3]


def energy_drift(ball, state, track):
    """The largest relative error of the energy so far, at each impact of an orbit (4, impacts)."""

    def energy(x, v, w):
        return (0.5 * v * v + 0.5 * ball.k * w * w) + x * (0.5 * ball.k * x - ball.g)

    first = energy(*state)
    return np.maximum.accumulate(np.abs(energy(*track[:3]) - first) / abs(first))


def orbits(impacts=MILLION):
    """The compiled methods along the chaotic orbit.

    Parameters
    ----------
    impacts : int
        Of the long orbits; how long orbits agree is seen in AGREE_IMPACTS.

    Returns
    -------
    xarray.Dataset
        missed, evaluations (method): impacts of the certified orbit that the method flies past,
        and what it spends on one; drift (method, record): the largest relative error of the energy
        so far on the method's own orbit; apart (method, impact): median over starts of the distance
        in x between the method's orbit and the proved one; agree (one, other): for how many impacts
        two methods' orbits stay within SEPARATION, the last row and column the proved orbit's.
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
    proved = [
        np.array(reference_solver.orbit(BALL, state, AGREE_IMPACTS))[:, 0] for state in starts
    ]
    tracks = np.array([*tracks, proved])
    apart = np.median(np.abs(tracks[:-1] - tracks[-1]), axis=1)
    agree = [[_agreement(one, other) for other in tracks] for one in tracks]
    variables = {
        "missed": ("method", missed, "impacts flown past"),
        "evaluations": ("method", evaluations, "evaluations an impact"),
        "drift": (("method", "record"), drift, "largest relative error of the energy"),
        "record": ("record", records, "number of impacts"),
        "apart": (
            ("method", "impact"),
            apart,
            "median distance in x from the judge's orbit",
            LENGTH,
        ),
        "impact": ("impact", np.arange(1, AGREE_IMPACTS + 1), "number of impacts"),
        "agree": (("one", "other"), agree, "impacts until two orbits are apart, the judge's last"),
    }
    return dataset(methods, variables, impacts=impacts, apart=SEPARATION)


def _agreement(one, other):
    """The median over starts of the number of impacts before two orbits differ by SEPARATION."""
    beyond = np.abs(one - other) > SEPARATION
    first = np.where(beyond.any(axis=1), beyond.argmax(axis=1), beyond.shape[1])
    return float(np.median(first))


def missed(methods, impacts=MILLION):
    """How many of the impacts that the coarsest scan misses others miss as well.

    The certified chaotic orbit is followed for `impacts` impacts; where a scan with step 0.5
    gives a wrong root the methods are asked too. What they miss elsewhere is not counted: a lower
    bound.

    Parameters
    ----------
    methods : sequence
        As described in `methods`.
    impacts : int

    Returns
    -------
    xarray.Dataset
        missed (method).
    """
    columns, found = certified_orbit(BALL, states.chaotic(), impacts)
    hard = is_wrong(scan_method(0.5, 1e-12).solve(BALL, *columns)[0], found)
    columns = columns[:, hard]
    truth = proved_times(BALL, columns)
    count = [is_wrong(method.solve(BALL, *columns)[0], truth).sum() for method in methods]
    variables = {"missed": ("method", count, "impacts missed, of those that scan 0.5 misses")}
    return dataset(methods, variables, impacts=impacts, hard=truth.size)
