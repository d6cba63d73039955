"""Checks of claims about periodic orbits, their branches and islands (sections 4 and 5)."""

import re
from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from extensions.atlas.symmetry_line import regular
from extensions.claims.analyses.rotation import island, plateaus
from paper.values import FIGURES, WINDOW
from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.variables import chart, states_of

from ..analyses.branches import branch_stretching, half_turns, trace_by_differences
from ..analyses.perturbed_map import FORMS, PROPERTIES
from .lookup import bounds_of, enclosed, energy_of, formula
from .outcomes import CORRECTED, FALSE, HOLDS, PROVED, UNDECIDED, Outcome, Series, outcome_of

TRANSVERSAL = 1e-8  # sine of a crossing angle above which doubles tell it from 0
STEP_BITS = range(20, 44)  # steps of differences are 2^-20 to 2^-43
TRACE_ERROR = 1e-3  # relative error of a trace by differences that counts as right
GONE = 0.1  # share of its largest value below which a residue goes to 0
BROKEN = 1.0  # residue above which there is no curve
STRETCHED_IMPACTS = 12  # twice the period, over which a branch's stretching is measured
ROTATION_ACCURACY = 1e-8  # turns per impact
# A regular share remains, or is gone, above and below these parts of the impact map's own.
REMAINS, LOST = 0.5, 0.2
# A reversor reverses a map if it misses by less than this, in section radii; none of those tried
# does if all miss by more than this part of the strength.
REVERSED, NOT_REVERSED = 1e-9, 0.1
# The growth of areas wanders if its standard deviation grows by this factor from the shortest to
# the longest runs, which are eight times as long, to more than this part of the strength.
WANDERS, LEAST_WANDER = 2.0, 0.1
TURNS_BACK = 0.1  # share of steps against the trend from which on the rotation number turns back


def fixed_point(orbits: xr.Dataset, proved: Mapping[str, bool]) -> Outcome:
    """Ask for exactly one symmetric fixed point, an elliptic one."""
    one = orbits["type"].values.tolist() == ["elliptic"]
    known = all(proved.values())
    return outcome_of(one, known, x=Series(orbits["x"].values[:, 0]), unique=known)


def period_six(orbits: xr.Dataset, proved: Mapping[str, bool]) -> Outcome:
    """Ask for an elliptic and a hyperbolic orbit of period six."""
    types, rows = orbits["type"].values.tolist(), []
    for i, kind in enumerate(types):
        name = "rotation_number" if kind == "elliptic" else "multiplier"
        number = orbits[name].values[i]
        rows.append({"type": kind, "name": name.replace("_", " "), "number": number})
    # The paper's two sets are there; a correction says that there are more.
    both = {"elliptic", "hyperbolic"} <= {*types}
    word = FALSE if not both else CORRECTED if len(types) > 2 else HOLDS
    exist = all(proved[f"six-{kind}"] for kind in ("elliptic", "hyperbolic", "inverse"))
    born = proved["six-birth"] and proved["six-inverse-birth"]
    ends = "six-elliptic-end", "six-hyperbolic-end"
    numbers = {"count": len(types), "orbits": rows, "exist": exist, "born": born}
    numbers |= {"ended": all(proved[name] for name in ends), "ends": Series(map(energy_of, ends))}
    return Outcome(word, numbers)


def alternating_points(orbits: xr.Dataset, proved: Mapping[str, bool]) -> Outcome:
    """Ask whether elliptic and hyperbolic points alternate around their middle."""
    types = orbits["type"].values.tolist()
    alternate = {"elliptic", "hyperbolic"} <= {*types}
    if alternate:
        two = orbits.isel(orbit=[types.index("elliptic"), types.index("hyperbolic")])
        x, y = chart(orbits.attrs["k"], *states_of(two))
        angle = np.arctan2(y - y.mean(), (x - x.mean()) * np.abs(y).max() / np.abs(x).max())
        owner = np.repeat([0, 1], x.shape[1])[np.argsort(angle.ravel(), kind="stable")]
        alternate = bool(np.all(owner != np.roll(owner, 1)))
    return outcome_of(alternate, do=alternate, curves=proved["twist-six"])


def widest_gap(rotation: xr.Dataset, proved: Mapping[str, bool]) -> Outcome:
    """Find the widest gap of the rotation number between the curves around the fixed point."""
    place, turns = rotation["detail_place"].values, rotation["detail_rotation"].values
    good = regular(rotation["detail_exponent"].values, rotation.attrs["detail_impacts"])
    gaps = plateaus(place[good], turns[good])
    if not gaps:
        return Outcome(UNDECIDED, case="no_gap")
    p, q, first, last = max(gaps, key=lambda gap: gap[3] - gap[2])
    numbers: dict[str, Any] = {"exist": proved["twist-fixed-point"], "curves": enclosed(proved)}
    numbers |= {"p": p, "q": q, "first": first, "last": last}
    numbers["once"] = proved["fixed-point-elliptic"] and proved["six-birth"]
    return Outcome(CORRECTED, numbers | {"spacing": abs(place[1] - place[0])})


def motions(*datasets: xr.Dataset) -> Outcome:
    """Compare types and durations of the motions in Figures 3 and 4 with the paper's."""
    orbits, lines = datasets[:2], datasets[2:]
    times = [line["t"].values[-1] for line in lines]
    one, six = (orbit["total_time"].values[0] for orbit in orbits)
    elliptic = all(orbit["type"].values[0] == "elliptic" for orbit in orbits)
    as_printed = times == [FIGURES[name]["duration"] for name in ("fig3", "fig4")]
    return outcome_of(elliptic and as_printed, one=one, six=six)


def finite_differences(orbits: xr.Dataset) -> Outcome:
    """Compare traces by forward differences, at their best step, with those of the Jacobian."""
    ball = Ball(orbits.attrs["k"], orbits.attrs["g"])
    points, period = states_of(orbits)[:, :, 0].T, orbits.sizes["point"]
    worst = 0.0
    for point, exact in zip(points, orbits["trace"].values, strict=True):
        traces = np.array(
            [trace_by_differences(ball, point, 1.0 / (1 << bits), period) for bits in STEP_BITS]
        )
        worst = max(worst, np.min(np.abs(traces - exact)) / max(1.0, abs(exact)))
    return outcome_of(worst < TRACE_ERROR, period=period, worst=worst)


def transversal(flux: xr.Dataset, proved: Mapping[str, bool]) -> Outcome:
    """Ask for crossing angles that differ from zero."""
    inner, outer = np.abs(flux["sine"].values)
    known, crossed = all(proved.values()), min(*inner, *outer) > TRANSVERSAL
    return outcome_of(crossed, known, known=known, inner=inner, outer=outer)


def lobe_areas(flux: xr.Dataset) -> Outcome:
    """Compare the areas of the lobes of the inner and the outer branches."""
    inner_area, outer_area = flux["area"].values
    # Twelve digits are shown, with the exponent.
    shown = [re.sub(r"^(-?[0.]*(?:\d\.?){12})\d*", r"\1", t) for t in flux["digits"].values]
    numbers = dict(zip(("inner", "outer"), shown, strict=True))
    errors = dict(zip(("inner_error", "outer_error"), flux["area_error"].values, strict=True))
    return outcome_of(inner_area < 1e-3 * outer_area, **numbers | errors)


def stretching(manifolds: xr.Dataset) -> Outcome:
    """Compare how much the outer and the inner unstable branches stretch and turn."""
    k, g = (float(manifolds.attrs[name]) for name in ("k", "g"))
    ends = np.cumsum(manifolds["row_size"].values)[:-1]
    branches = np.split(states_of(manifolds), ends, axis=1)
    unstable = manifolds["stable"].values == 0
    inner, outer = (
        [branches[row] for row in np.flatnonzero(unstable & (manifolds["side"].values == side))]
        for side in ("inner", "outer")
    )
    ball = Ball(k, g)
    short, long = (
        np.median([branch_stretching(ball, states, STRETCHED_IMPACTS) for states in s])
        for s in (inner, outer)
    )
    turns = min(half_turns(k, states) for states in outer)
    large = long > 10.0 and long > 3.0 * short and turns > 1.0
    return outcome_of(large, impacts=STRETCHED_IMPACTS, inner=short, outer=long, turns=turns)


def last_curve(residues: xr.Dataset, exclusion: xr.Dataset, proved: Mapping[str, bool]) -> Outcome:
    """Find where curves break up, by the residues of convergents, and where no curve can be."""
    size = np.abs(residues["residue"].values)
    last, largest = size[:, -1], size.max(axis=1)
    gone, broken = last < GONE * largest, (last == largest) & (last > BROKEN)
    if not (gone.any() and broken.any()):
        return Outcome(UNDECIDED, case="no_break_up")
    numbers, period = residues["rotation"].values, int(residues["period"].values[:, -1].min())
    inside, outside = numbers[gone].min(), numbers[broken].max()
    ends = {"inside": inside, "outside": outside, "circle": proved["no-circle"]}
    last = exclusion.isel(count=-1)
    ends |= {"excluded": last["share"].item(), "excluded_error": last["share_error"].item()}
    ends |= {"followed": last["impacts"].item(), "period": period, "curves": enclosed(proved)}
    return Outcome(HOLDS, ends)


def point_in_window(manifolds: xr.Dataset, proved: Mapping[str, bool]) -> Outcome:
    """Ask whether the hyperbolic point lies in the window of Figure 6."""
    point = {name: manifolds.attrs[f"point_{name}"] for name in WINDOW}
    inside = all(low < point[name] < high for name, (low, high) in WINDOW.items())
    return outcome_of(inside, proved["six-hyperbolic"], **point)


def horseshoe(proved: Mapping[str, bool]) -> Outcome:
    """List the connections along which a horseshoe is proved."""
    sides = [side for side in ("inner", "outer") if proved[f"horseshoe-{side}"]]
    word = PROVED if len(sides) == 2 else UNDECIDED
    return Outcome(word, {"sides": " and the ".join(sides)}, case="" if sides else "unproved")


def smale_birkhoff(jumps: xr.Dataset, proved: Mapping[str, bool]) -> Outcome:
    """Ask for proved horseshoes, and for jumps that the Smale-Birkhoff theorem does not allow."""
    if not all(proved.values()):
        return Outcome(UNDECIDED, case="unproved")
    if jumps["length"].values[0] > 0.0:
        bounds = bounds_of("horseshoe-smooth")
        numbers = {"energy": jumps["energy"].values[0], "period": bounds["period"]}
        return Outcome(CORRECTED, numbers | {"smooth": float(bounds["surface"].energy)})
    return Outcome(PROVED, case="smooth")


def heteroclinic(flux: xr.Dataset) -> Outcome:
    """Ask whether branches lead from one saddle to another."""
    inner, outer = zip(flux["saddle"].values, flux["target"].values, strict=True)
    return outcome_of(inner[0] != inner[1] and outer[0] != outer[1], inner=inner, outer=outer)


def source_of_chaos(flux: xr.Dataset, proved: Mapping[str, bool]) -> Outcome:
    """Ask whether the sea passes the crossing outer branches and never the inner ones."""
    crossed = np.abs(flux["sine"].values).min() > TRANSVERSAL
    inside, share = flux["sea_inside"].values[0], flux["sea_out"].values[1]
    inner, outer = flux["area"].values
    impacts = int(flux.attrs["sea_impacts"])
    numbers = {"share": share, "share_error": flux["sea_out_error"].values[1]}
    numbers |= {"impacts": impacts, "passages": impacts * share * inner / outer}
    return outcome_of(crossed and inside == 0.0 < share, said=all(proved.values()), **numbers)


def no_twist_map(rotation: xr.Dataset, proved: Mapping[str, bool]) -> Outcome:
    """Count the turns of the rotation number across the main island at each energy."""
    energies = rotation["energy"].values
    counts = [_rises_and_falls(rotation, row) for row in range(energies.size)]
    turning = Series(
        energy
        for energy, steps in zip(energies, counts, strict=True)
        if min(steps) > TURNS_BACK * sum(steps)
    )
    numbers = {"turns": bool(turning), "energies": turning, "monotone": min(counts[0]) == 0}
    numbers |= {"energy": energies[0], "evidence": proved["twist-fixed-point"]}
    numbers |= {"zero": proved["twist-zero"], "once": proved["twist-one-zero"]}
    everywhere = "unstable", "twist-one-zero", "twist-zero"
    numbers |= {"unstable": all(proved[name] for name in everywhere)}
    return Outcome(HOLDS if turning else UNDECIDED, numbers)


def _rises_and_falls(rotation: xr.Dataset, row: int) -> tuple[int, int]:
    """Count rises and falls of the rotation number from start to start across the main island."""
    good = regular(rotation["exponent"].values[row], rotation.attrs["impacts"])
    size = island(good)
    steps = np.diff(rotation["rotation"].values[row, :size][good[:size]])
    return int(np.sum(steps > ROTATION_ACCURACY)), int(np.sum(steps < -ROTATION_ACCURACY))


def conjecture(
    algebra: xr.Dataset, control: xr.Dataset, low: xr.Dataset, proved: Mapping[str, bool]
) -> Outcome:
    """Compare the regular shares of maps that keep area, the reversor, both or neither.

    The two properties are separate if at both energies, for each form of change, the regular share
    remains with either alone and goes with neither, and if for some form the map with the reversor
    alone keeps no area at all.
    """
    rows = [_control_row(data, form) for data in (control, low) for form in FORMS]
    unkept = [row for row in rows if row["unkept"]]
    everywhere = len({row["energy"] for row in rows} - {row["energy"] for row in unkept}) == 0
    separate = everywhere and all(row["separate"] for row in rows)
    if not (separate and formula(algebra, "area", "reversible")[1]):
        return Outcome(UNDECIDED, case="mixed")
    numbers: dict[str, Any] = {"strength": control.attrs["shown"], "unkept": unkept}
    numbers["impacts"] = int(control["length"][-1])
    numbers["same"] = [row for row in rows if len(row["shares"]) == len(PROPERTIES)]
    numbers["shift"] = [row for row in rows if len(row["shares"]) < len(PROPERTIES)]
    numbers["unchanged"] = numbers["shift"]  # one row for each energy
    numbers["captured"] = [each for row in rows for each in row["captured"]]
    numbers |= {name: max(row[name] for row in rows) for name in ("others", "error")}
    return Outcome(CORRECTED, numbers | {"known": all(proved.values())})


def _control_row(control: xr.Dataset, form: str) -> dict[str, Any]:
    """Return the shares for one form of change at the strength that is shown, and what they say."""
    strength, energy = (float(control.attrs[name]) for name in ("shown", "energy"))
    kept = [name for name in PROPERTIES if f"{form} {name}" in control["map"]]
    rows = control.sel(strength=strength, map=[f"{form} {name}" for name in kept])
    share, low, high = (rows[f"class_{end}"].isel(length=-1) for end in ("share", "low", "high"))
    regular = {end.name: end.sel({"class": "regular"}).values for end in (share, low, high)}
    itself = float(control["class_share"].sel({"class": "regular"})[0, 0, -1])
    alone = [kept.index(name) for name in ("area", "reversor") if name in kept]
    defect = dict(zip(kept, rows["defect"].values, strict=True))
    separate = regular["class_low"][alone].min() > REMAINS * itself
    separate &= regular["class_high"][-1] < LOST * itself and defect["reversor"] < REVERSED
    separate &= defect.get("area", np.inf) > NOT_REVERSED * strength
    # If any area is kept, no orbit attracts, and areas grow by bounded factors along all others.
    attracted = share.sel({"class": "spiral"}).values
    captured = [
        {"attracted": value, "form": form, "kept": name, "energy": energy}
        for name, value in zip(kept, attracted, strict=True)
        if value > 0.0
    ]
    wander = rows["wander"].values[kept.index("reversor")]
    unkept = low.sel({"class": "spiral"}).values[kept.index("reversor")] > 0.0
    return {
        "form": form,
        "energy": energy,
        "itself": itself,
        "shares": Series(regular["class_share"]),
        "separate": bool(separate),
        "captured": captured,
        "unkept": bool(unkept or wander[-1] > max(WANDERS * wander[0], strength * LEAST_WANDER)),
        "others": np.nanmax(regular["class_share"] - rows["symmetric"].values),
        "error": 0.5 * np.max(regular["class_high"] - regular["class_low"]),
    }


def kam(proved: Mapping[str, bool]) -> Outcome:
    """List the theorems of invariant curves that are proved, near points and of visible size."""
    sized = {name: known for name, known in proved.items() if name.startswith("curve-")}
    names = Series(name for name, known in proved.items() if known and name not in sized)
    word = PROVED if all(proved.values()) else UNDECIDED
    numbers = {"names": names, "curves": enclosed(sized), "closed": any(sized.values())}
    return Outcome(word, numbers, case="" if names else "unproved")


def like_kam(proved: Mapping[str, bool]) -> Outcome:
    """Ask for the theorems of invariant curves."""
    return Outcome(HOLDS) if all(proved.values()) else Outcome(UNDECIDED, case="unproved")


def like_twist_maps(rotation: xr.Dataset, proved: Mapping[str, bool]) -> Outcome:
    """Count the rises and falls of the rotation number at the lowest energy."""
    rises, falls = _rises_and_falls(rotation, 0)
    monotone = min(rises, falls) == 0 < max(rises, falls)
    numbers = {"known": all(proved.values()), "energy": rotation["energy"].values[0]}
    numbers |= {"falls": falls > rises, "steps": rises + falls}
    return Outcome(HOLDS if monotone else UNDECIDED, numbers)
