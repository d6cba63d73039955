"""Checks of claims about the chaotic sea: clusters, exponents, the energy (section 4.1)."""

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from extensions.atlas.symmetry_line import regular
from paper.values import BALL, EXPONENT, FIGURES
from pseudorigid.dynamics.variables import final_exponents
from pseudorigid.kernel.arithmetic import log

from ..analyses.stretches import in_sea, long_run, stretches
from .lookup import enclosed, energy_of, entropy_bound, formula, regular_share
from .outcomes import CORRECTED, FALSE, HOLDS, UNDECIDED, Outcome, Series, outcome_of

SHORT = FIGURES["fig7"]["impacts"]  # impacts of a run of Figure 7
ENERGIES = (FIGURES["fig8"]["energy"], FIGURES["fig2"]["energy"])
FLIGHT_MINIMUM = 3.0  # flight time above which the valley between short and long flights lies
VALLEY_DEPTH = 0.25  # of the lower of the two peaks beside it
CONNECTED = 0.95  # share of the sea's cells that each chaotic orbit enters
CHAOTIC_EXPONENT = 0.1  # that each orbit of Figure 7 exceeds
CHAOTIC_EXPONENT_RATIO = 100.0  # times the exponent that a regular orbit may have
ORBIT_PARTS = 50  # into which an orbit is divided
MAX_STANDARD_ERRORS = 5.0  # that an orbit's mean may be off by chance
MAX_EXPLAINED_VARIANCE = 0.01  # share that an uncorrelated cluster may seem to explain
# Verdicts on orbits are wrong in a share of 0.0041 in the plane (src/extensions/atlas/README.md): a
# regular share that is closer to 0 or 1 than this may be such verdicts.
MARGIN = 0.01


def clustered(clusters: xr.Dataset) -> Outcome:
    """Find the valley in the distribution of flights, and measure clusters at each cut."""
    count, edge = clusters["flights"].values, clusters["bin_edge"].values
    inner = count[:-1]  # the last bin may be cut short
    valley = int(np.argmin(np.where(edge[: inner.size] < FLIGHT_MINIMUM, np.inf, inner)))
    deep = count[valley] < VALLEY_DEPTH * min(count[:valley].max(), count[valley:].max())
    table = clusters[["cluster_impacts", "period"]].to_dataframe().reset_index()
    error = clusters["period_error"].values.max()
    rows = table.to_dict("records")
    return outcome_of(deep, valley=edge[valley], clusters=rows, period_error=error)


def uncorrelated(clusters: xr.Dataset) -> Outcome:
    """Measure how much of the next cluster's first state the first state of a cluster explains."""
    explained = clusters["dependence_low"].values[:, 0].max(axis=1)
    word = HOLDS
    if explained.max() > MAX_EXPLAINED_VARIANCE:
        word = FALSE if explained.min() > MAX_EXPLAINED_VARIANCE else CORRECTED
    numbers: dict[str, Any] = {"cuts": Series(clusters["cut"].values)}
    widest = 0.0
    for index, name in enumerate("xy"):
        chosen = {"correlation": np.s_[:, 0, index, index], "dependence": np.s_[:, 0, index]}
        for measure, entries in chosen.items():
            ends = (clusters[f"{measure}{end}"].values[entries] for end in ("", "_low", "_high"))
            value, low, high = ends
            numbers[f"{measure}_{name}"] = Series(value)
            widest = max(widest, (high - value).max(), (value - low).max())
    return Outcome(word, numbers | {"widest": widest})


def connected(spread: xr.Dataset) -> Outcome:
    """Count the cells of the sea that each chaotic orbit enters."""
    every, least = (int(spread[f"entered_{name}"].values[-1]) for name in ("any", "least"))
    word = CORRECTED if least > CONNECTED * every else FALSE
    numbers = {"impacts": int(spread["visit"].values[-1]), "every": every, "least": least}
    return Outcome(word, _orbits(spread) | numbers)


def _orbits(spread: xr.Dataset) -> dict[str, int]:
    """Return how many orbits there are, and how many of them are chaotic."""
    return {"chaotic": int(in_sea(spread).sum()), "orbits": spread.sizes["orbit"]}


def one_chaotic_sea(spread: xr.Dataset, proved: Mapping[str, bool]) -> Outcome:
    """Count the cells of the sea that each chaotic orbit enters, beside the horseshoes."""
    word, numbers, _ = connected(spread)
    crossings = {"crossings": proved["horseshoe-inner"] and proved["horseshoe-outer"]}
    known = numbers | crossings | entropy_bound(proved)
    return Outcome(FALSE if word == FALSE else UNDECIDED, known)


def regular_exponents(spread: xr.Dataset) -> Outcome:
    """Compare the exponents of orbits, all regular, with the bound for their length."""
    length = int(spread["length"].values[-1])
    largest = np.abs(spread["regular_exponent"].values[-1]).max()
    small = largest < regular_bound(length) and (spread["regular_type"] == "regular").all()
    return outcome_of(small, largest=largest, length=length, orbits=spread.sizes["island"])


def _largest_exponents(spread: xr.Dataset) -> np.ndarray:
    """Return the largest exponent of each chaotic orbit, over all its blocks."""
    block = spread["exponent"].values[:, in_sea(spread)]
    return np.asarray(block.mean(axis=0).max(axis=-1))


def independent_of_start(spread: xr.Dataset) -> Outcome:
    """Compare each chaotic orbit's exponent with their mean, by the spread within the orbit."""
    block = spread["exponent"].values[:, in_sea(spread)]
    means = _largest_exponents(spread)
    # If orbits do not differ, their means spread by chance, as their parts do. Each has an error of
    # its own, because the parts of one that stays long at the edge of an island spread more.
    parts = np.array_split(block, min(ORBIT_PARTS, block.shape[0]))
    within = np.array([part.mean(axis=0).max(axis=-1) for part in parts]) - means
    errors = np.sqrt(np.sum(within * within, axis=0) / (len(parts) - 1) / len(parts))
    furthest = (np.abs(means - means.mean()) / errors).max()
    alike = furthest < MAX_STANDARD_ERRORS and means.min() > 0.0
    ends = {"least": means.min(), "most": means.max()}
    return outcome_of(alike, furthest=furthest, **ends, **_orbits(spread))


def regular_bound(length: int) -> float:
    """Return an upper bound of a regular orbit's exponents over a whole orbit, 3 ln n/n.

    ln n/n is the exponent of a tangent vector that grows exactly like n; the factor of 3 leaves
    room for any other constant of proportionality.
    """
    return 3.0 * log(float(length)) / length


def chaotic_nature(spread: xr.Dataset, proved: Mapping[str, bool]) -> Outcome:
    """Compare the exponents of chaotic orbits with the bound for regular ones of their length."""
    impacts, least = _impacts(spread), _largest_exponents(spread).min()
    bound = regular_bound(impacts)
    positive = least > CHAOTIC_EXPONENT_RATIO * bound
    numbers = {"least": least, "impacts": impacts, "bound": bound}
    return outcome_of(positive, **numbers, **_orbits(spread), **entropy_bound(proved))


def figure_7(lyapunov: xr.Dataset) -> Outcome:
    """Compare number, length and largest exponents of the orbits of Figure 7 with the paper's."""
    impacts, orbits = int(lyapunov["impact"].values[-1]), lyapunov.sizes["orbit"]
    ends = final_exponents(lyapunov)[:, 0]
    as_printed = impacts == SHORT and orbits == FIGURES["fig7"]["starts"]
    holds = as_printed and ends.min() > CHAOTIC_EXPONENT
    return outcome_of(holds, orbits=orbits, impacts=impacts, ends=Series(ends))


def long_run_exponent(spread: xr.Dataset) -> Outcome:
    """Compare the printed exponent with the mean of long runs and the spread of short ones."""
    mean, error = long_run(spread)
    block = int(spread.attrs["block_impacts"])
    # Runs are as long as those of Figure 7, or as a block if that is longer.
    length = max(SHORT // block, 1) * block
    above = np.mean(stretches(spread, length) > EXPONENT)
    likely = 0.025 < above < 0.975
    word = HOLDS if abs(mean - EXPONENT) < error else CORRECTED if likely else FALSE
    numbers = {"mean": mean, "percent": 100 * above, "printed": EXPONENT, "error": error}
    short, long = (spread.sel(run=n, method="nearest") for n in (length, _impacts(spread)))
    first = spread.isel(run=0)  # the spread of longer runs is compared with n^(-1/2) from here
    ratio = float(long["deviation"] / first["deviation"] * np.sqrt(long["run"] / first["run"]))
    numbers |= {name: float(short[name]) for name in ("deviation", "skewness", "skewness_error")}
    numbers |= {"first": int(first["run"]), "last": int(long["run"]), "more": 100 * (ratio - 1.0)}
    return Outcome(word, numbers)


def opposite_exponents(algebra: xr.Dataset, spread: xr.Dataset) -> Outcome:
    """Find how far exponents are from vanishing in pairs, beside the algebra of determinants."""
    means, impacts = spread["exponent"].values.mean(axis=0), _impacts(spread)
    drift = max(np.abs(means[:, 0] + means[:, 2]).max(), np.abs(means[:, 1]).max())
    holds = formula(algebra, "determinants")[0] and drift < 100.0 / impacts
    return outcome_of(holds, drift=drift, impacts=impacts)


def third_exponent(algebra: xr.Dataset, spread: xr.Dataset) -> Outcome:
    """Find the largest middle exponent, beside the algebra of the energy."""
    middle = np.abs(spread["exponent"].values[:, :, 1].mean(axis=0)).max()
    impacts = _impacts(spread)
    kept = formula(algebra, "conserved_energy", "jump_conditions")[0]
    return outcome_of(kept and middle < 100.0 / impacts, middle=middle, impacts=impacts)


def _impacts(spread: xr.Dataset) -> int:
    """Return the number of impacts of each orbit."""
    return int(spread.attrs["block_impacts"]) * spread.sizes["block"]


def depends_on_energy(line: xr.Dataset, proved: Mapping[str, bool]) -> Outcome:
    """Compare the least and the largest regular share over the energies."""
    least, most = line["regular"].values.min(), line["regular"].values.max()
    unit = line.attrs["g"] ** 2
    shares = [regular_share(line, 0, energy / unit) for energy in ENERGIES]
    shares = [share | {"energy": share["energy"] * unit} for share in shares]
    numbers = {"low": least, "high": most, "shares": shares, "curves": enclosed(proved)}
    numbers |= {"closed": bool(numbers["curves"]), "unstable": proved["unstable"]}
    return outcome_of(least < 0.5 * most, **numbers, width=_widest(line))


def destroyed_with_energy(line: xr.Dataset, proved: Mapping[str, bool]) -> Outcome:
    """Find where the regular share rises with the energy by more than its intervals."""
    share, low, high = (line[f"regular{end}"].values[0] for end in ("", "_low", "_high"))
    falls, rises = share[-1] < 0.5 * share[0], _rises(share, low, high)
    energy = line["energy"].values * line.attrs["g"] ** 2
    rows = [
        {"before": share[a], "low": energy[a], "after": share[b], "high": energy[b]}
        for a, b in rises
    ]
    numbers = {"first": share[0], "last": share[-1], "rows": rows, "rises": bool(rises)}
    numbers |= {"width": _widest(line), "unstable": proved["unstable"]}
    doubling = "six-elliptic-doubling"
    numbers |= {"doubled": proved[doubling], "doubling": energy_of(doubling)}
    return Outcome(FALSE if not falls else CORRECTED if rises else HOLDS, numbers)


def _widest(line: xr.Dataset) -> float:
    """Return the width of the widest interval of a regular share."""
    return float((line["regular_high"] - line["regular_low"]).max())


def _rises(share: np.ndarray, low: np.ndarray, high: np.ndarray) -> list[tuple[int, int]]:
    """Return (minimum, maximum) of the rises of a curve that exceed its intervals.

    A minimum or maximum counts if on both sides, or up to the curve's end, the curve leaves it
    by more than both intervals before it passes it. Of equal values the first counts.
    """
    rises, minimum, maximum = [], 0, None
    for i in range(1, share.size):
        if maximum is None:
            if share[i] < share[minimum]:
                minimum = i
            elif low[i] > high[minimum]:
                maximum = i
        elif share[i] > share[maximum]:
            maximum = i
        elif high[i] < low[maximum]:
            rises.append((minimum, maximum))
            minimum, maximum = i, None
    return rises if maximum is None else [*rises, (minimum, maximum)]


def discontinuous(rotation: xr.Dataset) -> Outcome:
    """Count how often regular and chaotic starts change places along a half of y = 0."""
    rows = rotation.sortby("energy").sel(energy=list(ENERGIES), method="nearest")["exponent"].values
    calm = regular(rows, rotation.attrs["impacts"])
    switches, fewer = (np.sum(np.diff(some, axis=1), axis=1) for some in (calm, calm[:, ::2]))
    numbers = {"counts": switches, "energies": ENERGIES, "starts": rows.shape[1], "fewer": fewer}
    return outcome_of(switches.min() >= 3, **numbers)


def mixed_shares(plane: xr.Dataset, proved: Mapping[str, bool]) -> Outcome:
    """Count the pairs of k and E/g^2 whose regular share is neither near 0 nor near 1."""
    chaotic = [name for name in proved if name != "twist-one-zero" and proved[name]]
    low, high = (plane[f"regular_{end}"].values for end in ("low", "high"))
    mixed, bare = (np.mean((low > m) & (high < 1.0 - m)) for m in (MARGIN, 1e-9))
    return outcome_of(
        mixed > 0.5,
        mixed=100 * mixed,
        bare=100 * bare,
        pairs=low.size,
        low=MARGIN,
        high=1 - MARGIN,
        fixed_points=bool(np.isfinite(plane["trace"].values).all()),
        proved=bool(chaotic) and proved["twist-one-zero"],
        energies=Series(map(energy_of, chaotic)),
    )


def dependence_on_material(plane: xr.Dataset) -> Outcome:
    """Compare the least and the largest regular share over k at the energy of Figure 2."""
    energy = FIGURES["fig2"]["energy"] / BALL["g"] ** 2
    share = plane["regular"].sel(energy=energy, method="nearest").values
    rows = int(share.argmin()), int(share.argmax())
    least, most = (regular_share(plane, row, energy) for row in rows)
    holds = most["low"] > least["high"]
    return outcome_of(holds, energy=least["energy"], least=least, most=most)
