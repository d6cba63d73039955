"""Checks of claims about periodic orbits, islands and branches of the tangle (section 4.1)."""

import json
import re
from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from pseudorigid.analyses.regularity import regular
from pseudorigid.analyses.rotation import plateaus
from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.paper import FIGURES, WINDOW

from .schema import CORRECTED, HOLDS, PROVED, UNDECIDED, Outcome, Series, outcome_of

TRANSVERSAL = 1e-8  # sine of a crossing angle above which doubles tell it from 0
STEP_BITS = range(20, 44)  # steps of differences are 2^-20 to 2^-43
TRACE_ERROR = 1e-3  # relative error of a trace by differences that counts as right
GONE = 0.1  # share of its largest value below which a residue goes to 0
BROKEN = 1.0  # residue above which there is no curve
STRETCHED_IMPACTS = 12  # twice the period, over which a branch's stretching is measured


def fixed_point(orbits: xr.Dataset, proved: Mapping[str, bool]) -> Outcome:
    """Ask for exactly one symmetric fixed point, an elliptic one."""
    one = orbits["type"].values.tolist() == ["elliptic"]
    known = all(proved.values())
    return outcome_of(one, known, x=Series(orbits["x"].values[:, 0]), unique=known)


def period_six(orbits: xr.Dataset, proved: Mapping[str, bool]) -> Outcome:
    """Ask for an elliptic and a hyperbolic orbit of period six."""
    kinds = orbits["type"].values.tolist()
    both = "elliptic" in kinds and "hyperbolic" in kinds
    exist = all(proved.values())
    return outcome_of(both, count=len(kinds), orbits=_described(orbits), exist=exist)


def in_between(orbits: xr.Dataset, proved: Mapping[str, bool]) -> Outcome:
    """Ask whether elliptic and hyperbolic points alternate around their middle."""
    kinds = orbits["type"].values.tolist()
    alternate = "elliptic" in kinds and "hyperbolic" in kinds and _alternate(orbits)
    return outcome_of(alternate, do=alternate, curves=proved["twist-six"])


def _described(orbits: xr.Dataset) -> list[dict[str, Any]]:
    """Return the type of each orbit, and its rotation number or multiplier."""
    rows = []
    for i, kind in enumerate(orbits["type"].values.tolist()):
        name = "rotation_number" if kind == "elliptic" else "multiplier"
        number = float(orbits[name].values[i])
        rows.append({"type": kind, "name": name.replace("_", " "), "number": number})
    return rows


def _alternate(orbits: xr.Dataset) -> bool:
    """Return whether elliptic and hyperbolic points alternate around their middle."""
    kinds = orbits["type"].values.tolist()
    rows = [kinds.index("elliptic"), kinds.index("hyperbolic")]
    x, y = orbits["x"].values[rows], orbits["xdot"].values[rows]
    y = y - float(orbits.attrs["k"]) * orbits["udot"].values[rows]
    angle = np.arctan2(y - y.mean(), (x - x.mean()) * float(np.abs(y).max() / np.abs(x).max()))
    owner = np.repeat([0, 1], x.shape[1])[np.argsort(angle.ravel(), kind="stable")]
    return bool(np.all(owner != np.roll(owner, 1)))


def dense(rotation: xr.Dataset, proved: Mapping[str, bool]) -> Outcome:
    """Find the widest gap of the rotation number between the curves around the fixed point."""
    place, turns = rotation["detail_place"].values, rotation["detail_rotation"].values
    good = regular(rotation["detail_exponent"].values, rotation.attrs["detail_impacts"])
    gaps = plateaus(place[good], turns[good])
    if not gaps:
        return Outcome(UNDECIDED, case="no_gap")
    p, q, first, last = max(gaps, key=lambda gap: gap[3] - gap[2])
    numbers = {"exist": proved["twist-fixed-point"], "p": p, "q": q, "first": first, "last": last}
    return Outcome(CORRECTED, numbers | {"spacing": abs(float(place[1] - place[0]))})


def motions(*datasets: xr.Dataset) -> Outcome:
    """Compare types and durations of the motions in Figures 3 and 4 with the paper's."""
    orbits, lines = datasets[:2], datasets[2:]
    times = [float(line["t"].values[-1]) for line in lines]
    one, six = (float(orbit["total_time"].values[0]) for orbit in orbits)
    elliptic = all(str(orbit["type"].values[0]) == "elliptic" for orbit in orbits)
    as_printed = times == [FIGURES[name]["duration"] for name in ("fig3", "fig4")]
    return outcome_of(elliptic and as_printed, one=one, six=six)


def differences(orbits: xr.Dataset) -> Outcome:
    """Compare traces by forward differences, at their best step, with those of the Jacobian."""
    ball = Ball(float(orbits.attrs["k"]), float(orbits.attrs["g"]))
    names, period = ("x", "xdot", "udot"), orbits.sizes["point"]
    worst = 0.0
    for orbit in range(orbits.sizes["orbit"]):
        point = np.array([float(orbits[name].values[orbit, 0]) for name in names])
        traces = [_trace(ball, point, 1.0 / (1 << bits), period) for bits in STEP_BITS]
        exact = float(orbits["trace"].values[orbit])
        errors = [abs(trace - exact) / max(1.0, abs(exact)) for trace in traces]
        worst = max(worst, min(errors))
    return outcome_of(worst < TRACE_ERROR, period=period, worst=worst)


def _trace(ball: Ball, point: np.ndarray, step: float, period: int) -> float:
    """Return the trace of the map's iterate on the energy surface by forward differences."""
    states = np.concatenate([point[:, None], point[:, None] + step * np.eye(3)], axis=1)
    x, v, w = after = [row.copy() for row in states]
    ball.map.steps(x, v, w, ball.k, ball.g, period, np.empty(4))
    return sum(float(row[i + 1] - row[0]) for i, row in enumerate(after)) / step - 1.0


def transversal(flux: xr.Dataset, proved: Mapping[str, bool]) -> Outcome:
    """Ask for crossing angles that differ from zero."""
    sines = np.abs(flux["sine"].values)
    inner, outer = sines.tolist()
    known, crossed = all(proved.values()), float(sines.min()) > TRANSVERSAL
    return outcome_of(crossed, known, known=known, inner=inner, outer=outer)


def oscillations(flux: xr.Dataset) -> Outcome:
    """Compare the areas of the lobes of the inner and the outer branches."""
    areas = [float(area) for area in flux["area"].values]
    inner, outer = (_twelve_digits(str(text)) for text in flux["digits"].values)
    errors = dict(zip(("inner_error", "outer_error"), flux["area_error"].values, strict=True))
    return outcome_of(areas[0] < 1e-3 * areas[1], inner=inner, outer=outer, **errors)


def stretching(manifolds: xr.Dataset) -> Outcome:
    """Compare how much the outer and the inner unstable branches stretch and turn."""
    inner, outer = (
        float(np.median([_stretched(manifolds, row) for row in _unstable(manifolds, side)]))
        for side in ("inner", "outer")
    )
    turns = min(_half_turns(manifolds, row) for row in _unstable(manifolds, "outer"))
    large = outer > 10.0 and outer > 3.0 * inner and turns > 1.0
    return outcome_of(large, impacts=STRETCHED_IMPACTS, inner=inner, outer=outer, turns=turns)


def _unstable(manifolds: xr.Dataset, side: str) -> np.ndarray:
    """Return the rows of the unstable branches on a side."""
    return np.flatnonzero((manifolds["side"].values == side) & (manifolds["stable"].values == 0))


def _states(manifolds: xr.Dataset, row: int) -> np.ndarray:
    """Return the states along a branch, (3, n)."""
    end = int(manifolds["row_size"].values[: row + 1].sum())
    part = slice(end - int(manifolds["row_size"].values[row]), end)
    return np.stack([manifolds[name].values[part] for name in ("x", "xdot", "udot")])


def _stretched(manifolds: xr.Dataset, row: int) -> float:
    """Return the length of a branch's image after STRETCHED_IMPACTS, in lengths of the branch."""
    k, g = (float(manifolds.attrs[name]) for name in ("k", "g"))
    x, v, w = states = _states(manifolds, row)
    steps = np.diff(states, axis=1)
    # The tangent map adds no length where the map jumps.
    matrices = Ball(k, g).jacobian(x[:-1], v[:-1], w[:-1], impacts=STRETCHED_IMPACTS)
    images = (matrices * steps.T[:, None, :]).sum(axis=2).T
    before, after = (np.sqrt(a[0] ** 2 + (a[1] - k * a[2]) ** 2) for a in (steps, images))
    return float(np.nansum(after) / np.nansum(before))


def _half_turns(manifolds: xr.Dataset, row: int) -> float:
    """Return by how many half turns the direction of a branch in (x, y) changes in all."""
    x, v, w = _states(manifolds, row)
    direction = np.diff(x) + 1j * np.diff(v - float(manifolds.attrs["k"]) * w)
    return float(np.nansum(np.abs(np.angle(direction[1:] / direction[:-1]))) / np.pi)


def _twelve_digits(digits: str) -> str:
    """Cut a number's text after twelve digits, but keep its exponent."""
    return re.sub(r"^(-?[0.]*(?:\d\.?){12})\d*", r"\1", digits)


def last_curve(residues: xr.Dataset) -> Outcome:
    """Find the rotation numbers between which curves break up, by the residues of convergents."""
    size = np.abs(residues["residue"].values)
    gone = size[:, -1] < GONE * size.max(axis=1)
    broken = (size[:, -1] == size.max(axis=1)) & (size[:, -1] > BROKEN)
    if not (gone.any() and broken.any()):
        return Outcome(UNDECIDED, case="no_break_up")
    numbers, period = residues["rotation"].values, int(residues["period"].values[:, -1].min())
    inside, outside = float(numbers[gone].min()), float(numbers[broken].max())
    return Outcome(HOLDS, {"inside": inside, "outside": outside, "period": period})


def window(manifolds: xr.Dataset, proved: Mapping[str, bool]) -> Outcome:
    """Ask whether the hyperbolic point lies in the window of Figure 6."""
    point = {name: float(manifolds.attrs[f"point_{name}"]) for name in WINDOW}
    inside = all(low < point[name] < high for name, (low, high) in WINDOW.items())
    return outcome_of(inside, proved["six-hyperbolic"], **point)


def horseshoe(proved: Mapping[str, bool]) -> Outcome:
    """List the connections along which a horseshoe is proved."""
    sides = [side for side in ("inner", "outer") if proved[f"horseshoe-{side}"]]
    word = PROVED if len(sides) == 2 else UNDECIDED
    return Outcome(word, {"sides": " and the ".join(sides)}, case="" if sides else "unproved")


def smale_birkhoff(jumps: xr.Dataset, proved: Mapping[str, bool]) -> Outcome:
    """Ask for proved horseshoes, and for jumps that the Smale-Birkhoff theorem does not allow."""
    energy, length = (float(jumps[name].values[0]) for name in ("energy", "length"))
    if not all(proved.values()):
        return Outcome(UNDECIDED, case="unproved")
    if length > 0.0:
        return Outcome(CORRECTED, {"energy": energy})
    return Outcome(PROVED, case="smooth")


def heteroclinic(flux: xr.Dataset) -> Outcome:
    """Ask whether branches lead from one saddle to another."""
    inner, outer = zip(flux["saddle"].values.tolist(), flux["target"].values.tolist(), strict=True)
    return outcome_of(inner[0] != inner[1] and outer[0] != outer[1], inner=inner, outer=outer)


def source_of_chaos(flux: xr.Dataset, proved: Mapping[str, bool]) -> Outcome:
    """Ask whether the sea passes the crossing outer branches and never the inner ones."""
    crossed = float(np.abs(flux["sine"].values).min()) > TRANSVERSAL
    inside, share = float(flux["sea_inside"].values[0]), float(flux["sea_out"].values[1])
    inner, outer = (float(area) for area in flux["area"].values)
    config = json.loads(flux.attrs["config"])
    impacts = int(config["orbits"]) * int(config["impacts"])
    return outcome_of(
        crossed and inside == 0.0 < share,
        said=all(proved.values()),
        share=share,
        impacts=impacts,
        passages=impacts * share * inner / outer,
    )
