"""Checks of claims about periodic orbits, islands and branches of the tangle (section 4.1)."""

import json
import re

import numpy as np

from pseudorigid.analyses.regularity import regular
from pseudorigid.analyses.rotation import plateaus
from pseudorigid.dynamics.ball import Ball

from .schema import CORRECTED, HOLDS, PROVED, UNDECIDED, verdict_of

TRANSVERSAL = 1e-8  # sines of crossing angles in doubles can be told from 0 above that
STEPS = range(20, 44)  # of differences, as negative powers of two
GONE = 0.1  # a residue that falls below that share of its largest goes to 0
BROKEN = 1.0  # a residue above that belongs to no curve
LATER = 12  # impacts, twice the period, over which a branch's stretching is measured


def fixed_point(found, proved):
    """Ask for exactly one symmetric fixed point, an elliptic one."""
    one = found["type"].values.tolist() == ["elliptic"]
    known = all(proved.values())
    x = ", ".join(f"{float(x):.12f}" for x in found["x"].values[:, 0])
    return verdict_of(one, known, x=x, unique=", and no other" if known else "")


def period_six(orbits, proved):
    """Ask for an elliptic and a hyperbolic orbit of period six."""
    kinds = orbits["type"].values.tolist()
    exist = "each proved to exist" if all(proved.values()) else "not proved to exist"
    both = "elliptic" in kinds and "hyperbolic" in kinds
    return verdict_of(both, count=len(kinds), orbits=_named(orbits), exist=exist)


def in_between(orbits, proved):
    """Ask whether elliptic and hyperbolic points alternate around their middle."""
    kinds = orbits["type"].values.tolist()
    alternate = "elliptic" in kinds and "hyperbolic" in kinds and _alternate(orbits)
    curves = "; closed curves around the elliptic ones are proved" if proved["twist-six"] else ""
    return verdict_of(alternate, do="" if alternate else "do not ", curves=curves)


def _named(found):
    """Orbits by their kinds, with rotation number or multiplier to about twelve digits."""
    words = []
    for i, kind in enumerate(found["type"].values.tolist()):
        name = "rotation_number" if kind == "elliptic" else "multiplier"
        words.append(f"{kind}, {name.replace('_', ' ')} {float(found[name].values[i]):.11f}")
    return "; ".join(words)


def _alternate(found):
    """Whether points of the first elliptic and hyperbolic orbits alternate around their middle."""
    kinds = found["type"].values.tolist()
    rows = [kinds.index("elliptic"), kinds.index("hyperbolic")]
    x, y = found["x"].values[rows], found["xdot"].values[rows]
    y = y - float(found.attrs["k"]) * found["udot"].values[rows]
    around = np.arctan2(y - y.mean(), (x - x.mean()) * float(np.abs(y).max() / np.abs(x).max()))
    owner = np.repeat([0, 1], x.shape[1])[np.argsort(around.ravel(), kind="stable")]
    return bool(np.all(owner != np.roll(owner, 1)))


def dense(found, proved):
    """Find the widest gap of the rotation number between the curves around the fixed point."""
    place, turns = found["detail_place"].values, found["detail_rotation"].values
    good = regular(found["detail_exponent"].values, found.attrs["detail_impacts"])
    gaps = plateaus(place[good], turns[good])
    if not gaps:
        return UNDECIDED, "no gap seen", ""
    p, q, first, last = max(gaps, key=lambda gap: gap[3] - gap[2])
    known = proved["twist-fixed-point"]
    exist = "curves of positive area proved" if known else "curves seen"
    spacing = abs(float(place[1] - place[0]))
    return CORRECTED, {
        "exist": exist, "p": p, "q": q, "first": first, "last": last, "spacing": spacing,
    }  # fmt: skip


def motions(*found):
    """Compare types and durations of the motions in Figures 3 and 4 with the paper's."""
    orbits, lines = found[:2], found[2:]
    times = [float(line["t"].values[-1]) for line in lines]
    one, six = (float(orbit["total_time"].values[0]) for orbit in orbits)
    elliptic = all(str(orbit["type"].values[0]) == "elliptic" for orbit in orbits)
    return verdict_of(elliptic and times == [16.0, 60.0], one=one, six=six)


def differences(found):
    """Compare traces by forward differences, at their best step, with those of the Jacobian."""
    ball = Ball(float(found.attrs["k"]), float(found.attrs["g"]))
    names, period = ("x", "xdot", "udot"), found.sizes["point"]
    worst = 0.0
    for orbit in range(found.sizes["orbit"]):
        point = np.array([float(found[name].values[orbit, 0]) for name in names])
        traces = [_trace(ball, point, 1.0 / (1 << bits), period) for bits in STEPS]
        exact = float(found["trace"].values[orbit])
        errors = [abs(trace - exact) / max(1.0, abs(exact)) for trace in traces]
        worst = max(worst, min(errors))
    return verdict_of(worst < 1e-3, period=period, worst=worst)


def _trace(ball, point, step, period):
    """Trace on the energy surface of the map's iterate by forward differences at a point."""
    states = np.concatenate([point[:, None], point[:, None] + step * np.eye(3)], axis=1)
    after = [row.copy() for row in states]
    ball.map.steps(*after, ball.k, ball.g, period, np.empty(4))
    return sum(float(after[i][i + 1] - after[i][0]) for i in range(3)) / step - 1.0


def transversal(flux, proved):
    """Ask for crossing angles that differ from zero."""
    sines = np.abs(flux["sine"].values)
    known = "a transversal crossing of the inner branches and one of the outer ones, on y = 0; "
    known = known if all(proved.values()) else ""
    inner, outer = (" and ".join(f"{sine:.8g}" for sine in row) for row in sines)
    crossed = float(sines.min()) > TRANSVERSAL
    return verdict_of(crossed, all(proved.values()), known=known, inner=inner, outer=outer)


def oscillations(found):
    """Compare the areas of the lobes of the inner and the outer branches."""
    areas = [float(area) for area in found["area"].values]
    inner, outer = (_short(str(text)) for text in found["digits"].values)
    errors = zip(("inner_error", "outer_error"), found["area_error"].values, strict=True)
    return verdict_of(areas[0] < 1e-3 * areas[1], inner=inner, outer=outer, **dict(errors))


def stretching(manifolds):
    """Compare how much the outer and the inner unstable branches stretch and turn."""
    inner, outer = (
        float(np.median([_stretched(manifolds, row) for row in _unstable(manifolds, side)]))
        for side in ("inner", "outer")
    )
    turns = min(_half_turns(manifolds, row) for row in _unstable(manifolds, "outer"))
    large = outer > 10.0 and outer > 3.0 * inner and turns > 1.0
    return verdict_of(large, impacts=LATER, inner=inner, outer=outer, turns=turns)


def _unstable(manifolds, side):
    """The rows of the unstable branches on a side."""
    return np.flatnonzero((manifolds["side"].values == side) & (manifolds["stable"].values == 0))


def _line(manifolds, row):
    """The states along a branch, (3, n)."""
    end = int(manifolds["row_size"].values[: row + 1].sum())
    part = slice(end - int(manifolds["row_size"].values[row]), end)
    return np.stack([manifolds[name].values[part] for name in ("x", "xdot", "udot")])


def _stretched(manifolds, row):
    """The length in (x, y) of a branch's image after LATER impacts, in the branch's own.

    By the tangent map, so that where the map jumps nothing is added.
    """
    k, g = (float(manifolds.attrs[name]) for name in ("k", "g"))
    states = _line(manifolds, row)
    steps = np.diff(states, axis=1)
    matrices = Ball(k, g).jacobian(*(a[:-1] for a in states), impacts=LATER)
    images = (matrices * steps.T[:, None, :]).sum(axis=2).T
    before, after = (np.sqrt(a[0] ** 2 + (a[1] - k * a[2]) ** 2) for a in (steps, images))
    return np.nansum(after) / np.nansum(before)


def _half_turns(manifolds, row):
    """By how many half turns the direction of a branch in (x, y) changes in all."""
    x, v, w = _line(manifolds, row)
    direction = np.diff(x) + 1j * np.diff(v - float(manifolds.attrs["k"]) * w)
    return float(np.nansum(np.abs(np.angle(direction[1:] / direction[:-1]))) / np.pi)


def _short(digits):
    """Cut a number's text after twelve digits, its exponent kept."""
    return re.sub(r"^(-?[0.]*(?:\d\.?){12})\d*", r"\1", digits)


def last_curve(found):
    """Find the rotation numbers between which curves break up, by the residues of convergents."""
    size = np.abs(found["residue"].values)
    gone = size[:, -1] < GONE * size.max(axis=1)
    broken = (size[:, -1] == size.max(axis=1)) & (size[:, -1] > BROKEN)
    if not (gone.any() and broken.any()):
        return UNDECIDED, "no break-up between the rotation numbers", ""
    numbers, period = found["rotation"].values, int(found["period"].values[:, -1].min())
    inside, outside = float(numbers[gone].min()), float(numbers[broken].max())
    return HOLDS, {"inside": inside, "outside": outside, "period": period}


def window(manifolds, proved):
    """Ask whether the hyperbolic point lies in the window of Figure 6."""
    x, xdot = (float(manifolds.attrs[f"point_{name}"]) for name in ("x", "xdot"))
    inside = 0.21 < x < 0.2116 and 0.0925 < xdot < 0.0932
    return verdict_of(inside, proved["six-hyperbolic"], x=x, xdot=xdot)


def horseshoe(proved):
    """List the connections along which a horseshoe is proved."""
    sides = [side for side in ("inner", "outer") if proved[f"horseshoe-{side}"]]
    if not sides:
        return UNDECIDED, "not proved", ""
    value = "one exists: the map is conjugate to a shift on a hyperbolic set along the "
    value += " and the ".join(sides) + " connections"
    return PROVED if len(sides) == 2 else UNDECIDED, value, "ball arithmetic"


def smale_birkhoff(jumps, proved):
    """Ask for proved horseshoes, and for jumps that the Smale-Birkhoff theorem does not allow."""
    energy, length = (float(jumps[name].values[0]) for name in ("energy", "length"))
    if not all(proved.values()):
        return UNDECIDED, "neither are its hypotheses checked nor is a horseshoe proved", ""
    if length > 0.0:
        value = "the set exists, proved (row 30); but not by that theorem as it stands: it is "
        value += f"about diffeomorphisms, and at E = {energy:g} the map jumps (row 14)"
        return CORRECTED, value, ""
    return PROVED, "the set exists, proved (row 30)", ""


def heteroclinic(found):
    """Ask whether branches lead from one saddle to another."""
    pairs = zip(found["saddle"].values.tolist(), found["target"].values.tolist(), strict=True)
    inner, outer = pairs
    return verdict_of(inner[0] != inner[1] and outer[0] != outer[1], inner=inner, outer=outer)


def source_of_chaos(found, proved):
    """Ask whether the sea passes the crossing outer branches and never the inner ones."""
    crossed = float(np.abs(found["sine"].values).min()) > TRANSVERSAL
    inside, share = float(found["sea_inside"].values[0]), float(found["sea_out"].values[1])
    inner, outer = (float(area) for area in found["area"].values)
    config = json.loads(found.attrs["config"])
    impacts = int(config["orbits"]) * int(config["impacts"])
    return verdict_of(
        crossed and inside == 0.0 < share,
        said="proved to make chaos" if all(proved.values()) else "seen",
        share=share,
        impacts=impacts,
        passages=impacts * share * inner / outer,
    )
