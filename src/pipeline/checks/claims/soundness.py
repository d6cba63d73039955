"""Whether a dataset that is handed in is one of the map it names: samples of it, computed again.

A verdict on numbers that no orbit has would say nothing about the paper. Each check takes what a
dataset says of its ball, energies and starts, and compares a sample of its numbers with the map.
"""

import json

import numpy as np

from pseudorigid.dynamics import fixed_point
from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.ensemble import ImpactMap
from pseudorigid.dynamics.lyapunov import lyapunov_spectrum
from pseudorigid.evidence.clusters import clusters
from pseudorigid.evidence.winding import fixed, winding

STATE = ("x", "xdot", "udot")
NEAR = 1e-9  # of numbers that one map gives twice
SOME = 8  # entries of a sample
SHORT = 4096  # impacts of an orbit that is followed again


def fault(stage, dataset):
    """What is wrong with a dataset of a stage, in words, or None.

    Parameters
    ----------
    stage : str
        Its name, as in "orbits"; "line" and "plane" are sweeps.
    dataset : Dataset

    Returns
    -------
    str or None
    """
    check = CHECKS.get(stage)
    try:
        return check(dataset) if check else None
    except (KeyError, IndexError, ValueError, ZeroDivisionError) as error:
        return f"it cannot be read as one ({error})"


def _ball(dataset):
    return Ball(float(dataset.attrs["k"]), float(dataset.attrs["g"])), float(
        dataset.attrs["energy"]
    )


def _off(found, given, near=NEAR):
    """Whether numbers differ by more than `near`, of the larger of them or of 1."""
    found, given = np.broadcast_arrays(*(np.asarray(a, dtype=float) for a in (found, given)))
    same = np.abs(found - given) <= near * np.maximum(1.0, np.abs(given))
    return not np.all(same | (np.isnan(found) & np.isnan(given)))


def _orbits(dataset):
    ball, energy = _ball(dataset)
    states = [dataset[name].values for name in STATE]
    if _off(ball.energy(*states), energy, 1e-11):
        return "its states are not of its energy"
    after = ball.impact(*(a.copy() for a in states))
    inner = np.ones(states[0].size, bool)
    inner[np.cumsum(dataset["row_size"].values) - 1] = False
    pairs = ((after[i][:-1][inner[:-1]], states[i][1:][inner[:-1]]) for i in range(3))
    if any(_off(found, given) for found, given in pairs):
        return "its states do not follow one another under the map"
    return None


def _periodic(dataset):
    ball, energy = _ball(dataset)
    period = dataset.sizes["point"]
    for i in range(dataset.sizes["orbit"]):
        state = [float(dataset[name].values[i, 0]) for name in STATE]
        if _off(ball.energy(*state), energy, 1e-11):
            return "its states are not of its energy"
        (a, _), (_, d) = ball.chart_jacobian(*state, impacts=period)
        trace, root = a + d, np.sqrt(abs((a + d) ** 2 - 4.0))
        kind = "elliptic" if abs(trace) < 2.0 else "hyperbolic"
        kind = "inverse hyperbolic" if trace < -2.0 else kind
        size = 1.0 if kind == "elliptic" else np.copysign(0.5 * (abs(trace) + root), trace)
        time, near = 0.0, 1e-6
        for j in range(period):
            if _off(state, [float(dataset[name].values[i, j]) for name in STATE], near):
                return "its points do not follow one another under the map"
            *state, tau = ball.impact(*state)
            time += float(tau)
        if _off(state, [float(dataset[name].values[i, 0]) for name in STATE], near):
            return "its orbits do not close"
        if str(dataset["type"].values[i]) != kind:
            return f"orbit {i} is {kind}"
        for name, found in (("trace", trace), ("multiplier", size), ("total_time", time)):
            if _off(found, float(dataset[name].values[i]), 1e-6):
                return f"its {name} is not that of orbit {i}"
    return None


def _motion(dataset):
    ball, energy = _ball(dataset)
    t, x, u = (dataset[name].values for name in ("t", "position", "strain"))
    at, where = dataset["impact_t"].values, dataset["impact_position"].values
    if np.any(np.diff(t) < 0.0) or np.max(x + u) > 1e-12:
        return "the ball is below the floor"
    inside = (at >= t[0]) & (at <= t[-1])
    lines = (np.interp(at[inside], t, line) for line in (x, -u))
    if any(_off(line, where[inside]) for line in lines):
        return "its impacts are not on its line"
    # the motion is that of (26) where neither end of three samples is an impact
    step = np.diff(t)
    even = (np.abs(step[1:] - step[:-1]) < 1e-9) & (step[1:] > 1e-6)
    falling = (x[2:] - 2.0 * x[1:-1] + x[:-2])[even] / step[1:][even] ** 2
    if even.any() and abs(float(np.median(falling)) - ball.g) > 1e-3 * ball.g:
        return "it does not fall with its g"
    start = energy + ball.g * float(where[0]) - 0.5 * ball.k * float(where[0]) ** 2
    return "it starts beyond its energy" if start < 0.0 else None


def _manifolds(dataset):
    ball, energy = _ball(dataset)
    states = np.stack([dataset[name].values for name in STATE])
    states = states[:, ~np.isnan(states[0])]
    if _off(ball.energy(*states), energy, 1e-11):
        return "its vertices are not of its energy"
    if "point_x" in dataset.attrs:
        point = np.array([float(dataset.attrs[f"point_{name}"]) for name in ("x", "xdot")])
        if np.min(np.max(np.abs(states[:2] - point[:, None]), axis=0)) > NEAR:
            return "no branch leaves its point"
    return None


def _lyapunov(dataset):
    ball, energy = _ball(dataset)
    method = json.loads(dataset.attrs.get("config", "{}")).get("method", {})
    if "scan" in method:
        scan = ImpactMap((float(method["scan"]), float(method["tolerance"])))
        ball = Ball(ball.k, ball.g, map=scan)
    missing = "impacts_missed" in dataset.attrs
    if missing and "scan" not in method:
        return "its method is not said"
    record, start = dataset["impact"].values, dataset["start"].values
    last = record.size - 1
    if not missing:
        last = min(last, int(np.searchsorted(record, 4 * SHORT)))
    found = lyapunov_spectrum(ball, ball.start(start, energy), int(record[last]), 1)
    if _off(found["exponent"].values[0], dataset["exponent"].values[last]):
        return "its orbits have other exponents"
    if missing:
        said = [int(dataset.attrs[name]) for name in ("impacts", "impacts_missed")]
        if said != [scan.impacts, scan.missed]:
            return "other impacts are missed"
    mean, steps = dataset["exponent"].values, np.diff(record)[:, None, None]
    steps = np.abs(np.diff(mean * record[:, None, None], axis=0)) / steps
    return "its exponents leap" if np.nanmax(steps[1:, :, 0]) > 5.0 else None


def _spread(dataset):
    ball, energy = _ball(dataset)
    some = slice(0, SOME)
    start, impacts = dataset["start"].values[some], int(dataset.attrs["block_impacts"])
    found = lyapunov_spectrum(ball, ball.start(start, energy), impacts, 1)["exponent"].values[0]
    if _off(found, dataset["exponent"].values[0, some]):
        return "its first block has other exponents"
    rest = dataset["exponent"].values[..., 0]
    if np.abs(rest.mean() - found[:, 0].mean()) > 6.0 * rest.std() / np.sqrt(found.shape[0]):
        return "its exponents are not those of its first block"
    lengths = dataset["length"].values
    row = int(np.searchsorted(lengths, SHORT, side="right")) - 1
    states = ball.start(dataset["regular_start"].values, energy)
    found = lyapunov_spectrum(ball, states, int(lengths[row]), 1)["exponent"].values[0]
    if _off(found, dataset["regular_exponent"].values[row]):
        return "its regular orbits have other exponents"
    return None


def _clusters(dataset):
    ball, energy = _ball(dataset)
    for name in ("correlation", "dependence"):
        low, middle, high = (dataset[name + end].values for end in ("_low", "", "_high"))
        if np.any(low > middle) or np.any(middle > high):
            return f"its {name} lies outside its interval"
    middle, radius = ball.section(energy)
    if max(-dataset["least_strain"].min(), dataset["largest_strain"].max() + middle) > (
        max(middle + radius, radius) + NEAR
    ):
        return "a strain is beyond its energy"
    edge, flights = dataset["bin_edge"].values, dataset["flights"].values
    whole, time = float(flights.sum()), float(dataset["time"].sum())
    if abs(float(np.sum(flights * 0.5 * (edge[1:] + edge[:-1]))) - time) > 0.01 * time:
        return "its flights do not last as long as its orbits"
    count = dataset["count"].values
    for i, cut in enumerate(dataset["cut"].values.tolist()):
        least, most = (flights[end > cut + NEAR].sum() for end in (edge[:-1] + 2 * NEAR, edge[1:]))
        if not 0.99 * least <= count[i] <= 1.01 * most:
            return f"its flights do not make so many clusters, cut at {cut:g}"
    for name, total in (("period", time), ("cluster_impacts", whole)):
        if np.any(np.abs(count * dataset[name].values - total) > 0.03 * total):
            return f"its {name} does not fill its orbits"
    given = json.loads(dataset.attrs.get("config", "{}"))
    if "between" not in given:
        return None
    size, cuts = (32, int(given["impacts"])), dataset["cut"].values.tolist()
    found = clusters(ball, energy, given["between"], *size, cuts, dataset.sizes["lag"], 2, 1)
    for name, near in (("strain_energy", 0.02), ("least_strain", 0.02), ("largest_strain", 0.05)):
        mine, theirs = float(found[name].mean()), float(dataset[name].mean())
        if abs(mine - theirs) > near * abs(mine):
            return f"its {name} is not that of other orbits of this sea"
    for name in ("correlation", "dependence"):
        if np.max(np.abs(found[name].values - dataset[name].values)) > 0.1:
            return f"its {name} is not that of other orbits of this sea"
    return None


def _rotation(dataset):
    ball, _ = _ball(dataset)
    for row, energy in enumerate(dataset["energy"].values.tolist()):
        place, about = fixed(ball, energy)
        if _off((place, about), [dataset[f"fixed_{n}"].values[row] for n in ("place", "rotation")]):
            return f"its fixed point at E = {energy:g} is another"
    some = np.linspace(0, dataset.sizes["start"] - 1, SOME).astype(int)
    turns, grown = winding(
        ball, float(dataset["energy"][0]), dataset["place"].values[0, some],
        int(dataset.attrs["impacts"]),
    )  # fmt: skip
    other = turns, grown
    names = ("rotation", "exponent")
    if any(_off(a, dataset[n].values[0, some]) for a, n in zip(other, names, strict=True)):
        return "its orbits turn or grow otherwise"
    some = np.linspace(0, dataset.sizes["detail"] - 1, SOME).astype(int)
    impacts = int(dataset.attrs["detail_impacts"])
    place = dataset["detail_place"].values[some]
    other = winding(ball, float(dataset["energy"][0]), place, impacts)
    if any(_off(a, dataset[f"detail_{n}"].values[some]) for a, n in zip(other, names, strict=True)):
        return "its orbits in the detail turn or grow otherwise"
    return None


def _jumps(dataset):
    ball, _ = _ball(dataset)
    for row, energy in enumerate(dataset["energy"].values.tolist()):
        radius = ball.section(energy)[1]
        if _off(radius, dataset["radius"].values[row]):
            return f"its section at E = {energy:g} is another"
        x, y = dataset["x"].values[row], dataset["y"].values[row]
        there = ~np.isnan(x)
        if not there.any():
            if float(dataset["length"].values[row]) != 0.0:
                return f"it has a length without a curve at E = {energy:g}"
            continue
        length = float(np.sum(np.sqrt(np.diff(x[there]) ** 2 + np.diff(y[there]) ** 2)))
        if _off(length, dataset["length"].values[row], 1e-3):
            return f"its length is not that of its curve at E = {energy:g}"
        inside = (y * y) / (1.0 + ball.k) + ball.k * (x - ball.g / ball.k) ** 2
        if np.any(inside[there] > ball.k * radius * radius * (1.0 + NEAR)):
            return f"its curve leaves the section at E = {energy:g}"
        rim = [dataset[f"rim_{name}"].values[row][there] for name in "xy"]
        s = (rim[1] ** 2) / (1.0 + ball.k) + ball.k * (rim[0] - ball.g / ball.k) ** 2
        if _off(s, ball.k * radius * radius, 1e-6):
            return f"its grazing states at E = {energy:g} do not graze"
    return None


def _flux(dataset):
    areas, digits = dataset["area"].values, dataset["digits"].values
    if _off([float(text) for text in digits] / areas, 1.0):
        return "its areas are not their digits"
    # the inner lines are too near to each other for their vertices to say more
    outer = dataset.isel(side=1)
    if abs(float(outer["lobe_polygon"] / outer["area"]) - 1.0) > 0.01:
        return "its areas are not those of its lines"
    x, y = outer["branch_x"].values, outer["branch_y"].values
    i = int(np.argmax((y[:-1] > 0.0) != (y[1:] > 0.0)))
    dx, dy = x[i + 1] - x[i], y[i + 1] - y[i]
    if np.min(np.abs(x[i] - y[i] * dx / dy - outer["crossing_x"].values)) > 1e-3:
        return "its lines meet y = 0 elsewhere"
    # the stable branch is the mirror image of the unstable one
    sine = 2.0 * dx * dy / (dx * dx + dy * dy)
    found = np.abs(np.abs(outer["sine"].values) - abs(sine))
    return "its lines cross at other angles" if np.min(found) > 0.01 else None


def _last_curve(dataset):
    ball, energy = _ball(dataset)
    period, turns = dataset["period"].values, dataset["turns"].values
    rotation = dataset["rotation"].values
    if np.any(np.abs(turns[:, -1] / period[:, -1] - rotation) > 1.0 / period[:, -1] ** 2):
        return "its convergents are not those of its rotation numbers"
    for i in range(period.shape[0]):
        for j in range(2):
            state = ball.start(float(dataset["place"].values[i, j]), energy)
            (a, _), (_, d) = ball.chart_jacobian(*state, impacts=int(period[i, j]))
            if _off(0.25 * (2.0 - a - d), dataset["residue"].values[i, j], 0.01):
                return f"the residue of period {period[i, j]:g} is another"
    return None


def _sweep(dataset):
    low, share, high = (dataset[f"regular{end}"].values for end in ("_low", "", "_high"))
    if np.any(low > share + NEAR) or np.any(share > high + NEAR) or np.any(low < -NEAR):
        return "a share lies outside its interval"
    if np.any(high > 1.0 + NEAR):
        return "a share is above 1"
    if np.any(dataset["regular_strict"].values > share + NEAR):
        return "a share is below that with half the threshold"
    k, energy = dataset["k"].values, dataset["energy"].values
    for i, j in ((0, 0), (0, energy.size // 2), (k.size - 1, energy.size - 1)):
        theta = fixed_point.half_time(float(k[i]), float(energy[j]))
        if _off(fixed_point.trace(float(k[i]), theta), dataset["trace"].values[i, j], 1e-6):
            return "its fixed points are others"
    return None


CHECKS = {
    "orbits": _orbits,
    "periodic": _periodic,
    "motion": _motion,
    "manifolds": _manifolds,
    "lyapunov": _lyapunov,
    "spread": _spread,
    "clusters": _clusters,
    "rotation": _rotation,
    "jumps": _jumps,
    "flux": _flux,
    "last_curve": _last_curve,
    "line": _sweep,
    "plane": _sweep,
}
