"""Claims about periodic orbits, islands and the branches of the tangle. Paper, section 4.1."""

import json

import numpy as np

from pseudorigid.dynamics.ball import Ball
from pseudorigid.evidence.rotation import plateaus, regular

from .ledger import CORRECTED, HOLDS, PROVED, UNDECIDED, Verdict, claim, decided

HORSESHOES = ("horseshoe-inner", "horseshoe-outer")
SIXES = ("six-elliptic", "six-hyperbolic", "six-inverse")
TRANSVERSAL = 1e-8  # sines of crossing angles in doubles can be told from 0 above that
STEPS = range(20, 44)  # of differences, as negative powers of two
GONE = 0.1  # a residue that falls below that share of its largest goes to 0
BROKEN = 1.0  # a residue above that belongs to no curve
LATER = 12  # impacts, twice the period, over which a branch's stretching is measured


@claim(21, "4.1", "NT", "fig3/periodic", theorems=["fixed-point", "one-fixed-point"])
def fixed_point(found, proved):
    """“For this choice of parameters, the map possesses one elliptic fixed point that corresponds
    to the periodic motion shown in Figure 3”"""
    one = found["type"].values.tolist() == ["elliptic"]
    value = f"x = {', '.join(f'{float(x):.12f}' for x in found['x'].values[:, 0])}"
    known = proved("fixed-point", "one-fixed-point")
    value += ", and no other" if known else ""
    return decided(one, value, "1e-12", "paper_figures/fig3.png, ./reproduce prove", known)


@claim(22, "4.1", "NQ", "fig4/periodic", theorems=SIXES)
def period_six(orbits, proved):
    """“Further, two sets of period-six points are found to exist outside this major island”"""
    kinds = orbits["type"].values.tolist()
    both = "elliptic" in kinds and "hyperbolic" in kinds
    exist = "each proved to exist" if proved(*SIXES) else "not proved to exist"
    value = f"at least {len(kinds)}: {_named(orbits)}"
    error = f"{exist}; that there is no other symmetric one, by search"
    return decided(both, value, error, "more_figures/claims/jumps.png")


@claim(69, "4.1", "Q", "fig4/periodic", theorems=["twist-six"])
def in_between(orbits, proved):
    """“The first set consists of elliptic points surrounded by the minor islands of dominantly
    regular behavior, while the second set consists of hyperbolic points located in the chaotic
    region between successive elliptic points”"""
    kinds = orbits["type"].values.tolist()
    alternate = "elliptic" in kinds and "hyperbolic" in kinds and _alternate(orbits)
    value = f"the points of both orbits {'' if alternate else 'do not '}alternate around their "
    value += "middle"
    value += "; closed curves around the elliptic ones are proved" if proved("twist-six") else ""
    return decided(alternate, value, "by their places", "paper_figures/fig2.png, fig5.png")


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


@claim(23, "4.1", "T", "rotation/rotation", theorems=["twist-fixed-point"])
def dense(found, proved):
    """“A dense set of quasi-periodic solutions is formed around the elliptic fixed point and is
    contained inside the major island in Figure 2”"""
    place, turns = found["detail_place"].values, found["detail_rotation"].values
    good = regular(found["detail_exponent"].values, found.attrs["detail_impacts"])
    gaps = plateaus(place[good], turns[good])
    if not gaps:
        return Verdict(UNDECIDED, "no gap seen", "", "more_figures/claims/rotation.png")
    p, q, first, last = max(gaps, key=lambda gap: gap[3] - gap[2])
    exist = "curves of positive area proved" if proved("twist-fixed-point") else "curves seen"
    value = f"{exist}, but dense they are not: a chain of islands, rotation number {p}/{q}, from "
    value += f"{first:.6f} to {last:.6f} section radii on y = 0"
    error = f"{abs(float(place[1] - place[0])):.0e} radii"
    return Verdict(CORRECTED, value, error, "more_figures/claims/rotation.png")


@claim(24, "Figures 3, 4", "F", "fig3/periodic", "fig4/periodic", "fig3/motion", "fig4/motion")
def motions(*found):
    """the elliptic motions of period one and six, over 16 and 60 units of time"""
    orbits, lines = found[:2], found[2:]
    times = [float(line["t"].values[-1]) for line in lines]
    periods = [float(orbit["total_time"].values[0]) for orbit in orbits]
    elliptic = all(str(orbit["type"].values[0]) == "elliptic" for orbit in orbits)
    value = f"periods {periods[0]:.12f} and {periods[1]:.11f}"
    evidence = "paper_figures/fig3.png, fig4.png"
    return decided(elliptic and times == [16.0, 60.0], value, "1e-11", evidence)


@claim(25, "4.1", "Q", "fig4/periodic")
def differences(found):
    """“An approximation to this matrix is obtained by substituting all partial derivatives by
    first-order differences”"""
    ball = Ball(float(found.attrs["k"]), float(found.attrs["g"]))
    names, period = ("x", "xdot", "udot"), found.sizes["point"]
    worst = 0.0
    for orbit in range(found.sizes["orbit"]):
        point = np.array([float(found[name].values[orbit, 0]) for name in names])
        traces = [_trace(ball, point, 1.0 / (1 << bits), period) for bits in STEPS]
        exact = float(found["trace"].values[orbit])
        errors = [abs(trace - exact) / max(1.0, abs(exact)) for trace in traces]
        worst = max(worst, min(errors))
    value = f"at the best step the traces of P^{period} are right to {worst:.0e}"
    remark = "about half of the digits"
    return decided(worst < 1e-3, value, remark, "tests/kernel/test_impact.py")


def _trace(ball, point, step, period):
    """Trace on the energy surface of the map's iterate by forward differences at a point."""
    states = np.concatenate([point[:, None], point[:, None] + step * np.eye(3)], axis=1)
    after = [row.copy() for row in states]
    ball.map.steps(*after, ball.k, ball.g, period, np.empty(4))
    return sum(float(after[i][i + 1] - after[i][0]) for i in range(3)) / step - 1.0


@claim(26, "4.1", "T", "flux/flux", theorems=HORSESHOES)
def transversal(flux, proved):
    """“The stable and unstable manifolds of the heteroclinic hyperbolic period-six points
    intersect transversally, as illustrated in Figure 5”"""
    sines = np.abs(flux["sine"].values)
    crossed = float(sines.min()) > TRANSVERSAL
    known = proved(*HORSESHOES)
    inner, outer = (" and ".join(f"{s:.8g}" for s in row) for row in sines)
    value = "a transversal crossing of the inner branches and one of the outer ones, on y = 0; "
    value = value if known else ""
    value += f"sines of the angles in (x, y) at both primary crossings, computed: inner {inner}; "
    value += f"outer {outer}"
    error = "computed in 1200 bits, not enclosed"
    return decided(crossed, value, error, "more_figures/claims/flux.png, ./reproduce prove", known)


@claim(27, "4.1", "Q", "flux/flux")
def oscillations(found):
    """“Indeed, the major island is contained by two intersecting stable and unstable branches whose
    oscillations remain small until they reach the vicinity of the hyperbolic points”"""
    inner, outer = (float(a) for a in found["area"].values)
    digits = " and ".join(_short(str(text)) for text in found["digits"].values)
    value = f"areas of the lobes of the inner and the outer branches: {digits}"
    small = inner < 1e-3 * outer
    error = "; ".join(f"{float(e):.0e}" for e in found["area_error"].values)
    return decided(small, value, error, "more_figures/claims/flux.png")


@claim(60, "4.1", "Q", "fig5/manifolds")
def stretching(manifolds):
    """“The other two intersecting branches undergo enormous stretching and oscillatory bending, as
    evident by the segments traced in Figure 5”"""
    inner, outer = (
        float(np.median([_stretched(manifolds, row) for row in _unstable(manifolds, side)]))
        for side in ("inner", "outer")
    )
    turns = min(_half_turns(manifolds, row) for row in _unstable(manifolds, "outer"))
    value = f"{LATER} impacts make the outer unstable branches of Figure 5 {outer:.0f} times as "
    value += f"long, and the inner ones {inner:.1f} times; the outer ones turn by at least "
    value += f"{turns:.1f} half turns as drawn"
    large = outer > 10.0 and outer > 3.0 * inner and turns > 1.0
    return decided(large, value, "medians over the six saddles", "paper_figures/fig5.png")


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
    """A number's text with twelve digits."""
    mantissa, _, exponent = digits.partition("e")
    kept, seen = "", 0
    for char in mantissa:
        seen += char.isdigit() and (seen > 0 or char != "0")
        kept += char
        if seen == 12:
            break
    return kept + (f"e{exponent}" if exponent else "")


@claim(28, "4.1", "T", "last_curve/last_curve")
def last_curve(found):
    """“Thus, they prevent the quasi-periodic trajectories from further expanding around the
    elliptic fixed point of the map”"""
    size = np.abs(found["residue"].values)
    gone = size[:, -1] < GONE * size.max(axis=1)
    broken = (size[:, -1] == size.max(axis=1)) & (size[:, -1] > BROKEN)
    numbers, evidence = found["rotation"].values, "more_figures/claims/last_curve.png"
    if not (gone.any() and broken.any()):
        return Verdict(UNDECIDED, "no break-up between the rotation numbers", "", evidence)
    inside, outside = float(numbers[gone].min()), float(numbers[broken].max())
    value = "by Greene's criterion, which is not proved for this map: a curve with rotation number "
    value += f"{inside:.7f}, none with {outside:.7f}"
    last = int(found["period"].values[:, -1].min())
    return Verdict(HOLDS, value, f"residues of convergents up to period {last}", evidence)


@claim(29, "Figures 5, 6", "FN", "fig6/manifolds", theorems=["six-hyperbolic"])
def window(manifolds, proved):
    """one hyperbolic point lies in the window 0.21 < x < 0.2116, 0.0925 < xdot < 0.0932"""
    x, xdot = (float(manifolds.attrs[f"point_{name}"]) for name in ("x", "xdot"))
    inside = 0.21 < x < 0.2116 and 0.0925 < xdot < 0.0932
    value = f"x = {x:.12f}, xdot = {xdot:.12f}"
    evidence = "paper_figures/fig6.png, ./reproduce prove"
    return decided(inside, value, "1e-12", evidence, proved("six-hyperbolic"))


@claim(30, "4.1", "O", theorems=HORSESHOES)
def horseshoe(proved):
    """“However, a formal proof of the existence of such a set is currently unavailable”"""
    sides = [side for side in ("inner", "outer") if proved(f"horseshoe-{side}")]
    word = PROVED if len(sides) == 2 else UNDECIDED
    value = "one exists: the map is conjugate to a shift on a hyperbolic set along the "
    value = value + " and the ".join(sides) + " connections" if sides else "not proved"
    return Verdict(word, value, "ball arithmetic" if sides else "", "./reproduce prove")


@claim(63, "4.1", "T", "jumps/jumps", theorems=HORSESHOES)
def smale_birkhoff(jumps, proved):
    """“These intersections indicate the existence of a hyperbolic invariant set of points on which
    the impact map (28) is topologically equivalent to a horseshoe map as guaranteed by the
    Smale-Birkhoff theorem”"""
    energy, length = (float(jumps[name].values[0]) for name in ("energy", "length"))
    if not proved(*HORSESHOES):
        value, word = "neither are its hypotheses checked nor is a horseshoe proved", UNDECIDED
    elif length > 0.0:
        value = "the set exists, proved (row 30); but not by that theorem as it stands: it is "
        value += f"about diffeomorphisms, and at E = {energy:g} the map jumps (row 14)"
        word = CORRECTED
    else:
        value, word = "the set exists, proved (row 30)", PROVED
    return Verdict(word, value, "", "./reproduce prove")


@claim(31, "4.1", "Q", "flux/flux")
def heteroclinic(found):
    """“heteroclinic hyperbolic period-six points”"""
    pairs = list(zip(found["saddle"].values, found["target"].values, strict=True))
    apart = all(one != other for one, other in pairs)
    value = (
        "branches join neighbours: inner {} to {}, outer {} to {}; all six are points of one orbit"
    )
    value = value.format(*(int(place) for pair in pairs for place in pair))
    return decided(apart, value, "primary orbits, enclosed", "more_figures/claims/flux.png")


@claim(55, "1", "Q", "flux/flux", theorems=HORSESHOES)
def source_of_chaos(found, proved):
    """“Chaos occurs at a given energy level due to the transversal intersections of the stable
    and unstable manifolds of hyperbolic points”"""
    crossed = float(np.abs(found["sine"].values).min()) > TRANSVERSAL
    inside, share = float(found["sea_inside"].values[0]), float(found["sea_out"].values[1])
    inner, outer = (float(a) for a in found["area"].values)
    config = json.loads(found.attrs["config"])
    impacts = int(config["orbits"]) * int(config["impacts"])
    holds = crossed and inside == 0.0 < share
    said = "proved to make chaos" if proved(*HORSESHOES) else "seen"
    value = f"crossings {said}; the sea passes the outer branches at {share:.5f} of its impacts; "
    value += f"through the inner ones {impacts * share * inner / outer:.1g} passages are expected "
    value += f"in {impacts:,} impacts, by the areas of the lobes, and none is seen"
    return decided(holds, value, "of a finite run", "more_figures/claims/flux.png")
