"""Checks of claims about the chaotic sea: clusters, exponents, the energy (section 4.1)."""

import numpy as np

from pseudorigid.analyses.regularity import regular, regular_bound
from pseudorigid.analyses.spread import in_sea, stretches
from pseudorigid.dynamics.variables import final_exponents

from .schema import CORRECTED, FALSE, HOLDS, UNDECIDED, formula, verdict_of

SHORT = 200_000  # impacts of a run of Figure 7
ENERGIES = (0.001, 0.01)  # of the paper's figures
ENDS = ("", "_low", "_high")
PRINTED_EXPONENT = 0.235
OF_FIGURE_2 = 6.25  # E/g^2
CONNECTED = 0.95  # of the cells that any orbit enters; each has to enter more
CHAOTIC_EXPONENT_RATIO = 100.0  # times the exponent that a regular orbit may have
ORBIT_PARTS, MAX_STANDARD_ERRORS = (
    50,
    5.0,
)  # of an orbit; standard errors that an orbit's mean may be off by chance
MAX_EXPLAINED_VARIANCE = (
    0.01  # of a variance: what an uncorrelated cluster may seem to explain of the next
)
# A share that near to 0 or 1 may be wrong verdicts: 0.0041 of them are in the plane, docs/atlas.md.
MARGIN = 0.01


def clustered(found):
    """Find the valley in the distribution of flights, and measure clusters at each cut."""
    count, edge = found["flights"].values, found["bin_edge"].values
    last = count.size - 2  # the last bin may be cut short
    valley = int(np.argmin(count[: last + 1] + np.where(edge[: last + 1] < 3.0, count.max(), 0)))
    deep = count[valley] < 0.25 * min(count[:valley].max(), count[valley:].max())
    columns = (found[name].values for name in ("cut", "cluster_impacts", "period"))
    rows = zip(*columns, strict=True)
    clusters = "; ".join(f"{cut:g}: {size:.1f} impacts, {period:.2f}" for cut, size, period in rows)
    error = float(found["period_error"].values.max())
    return verdict_of(deep, valley=edge[valley], clusters=clusters, period_error=error)


def uncorrelated(found):
    """Measure how much of the next cluster's first state the first state of a cluster explains."""
    explained = found["dependence_low"].values[:, 0].max(axis=1)
    least, most = float(explained.min()), float(explained.max())
    word = (
        FALSE
        if least > MAX_EXPLAINED_VARIANCE
        else CORRECTED
        if most > MAX_EXPLAINED_VARIANCE
        else HOLDS
    )
    numbers, widest = {"cuts": ", ".join(f"{cut:g}" for cut in found["cut"].values)}, 0.0
    for index, name in enumerate("xy"):
        at = {"correlation": np.s_[:, 0, index, index], "dependence": np.s_[:, 0, index]}
        for measure, place in at.items():
            value, low, high = (found[f"{measure}{end}"].values[place] for end in ENDS)
            numbers[f"{measure}_{name}"] = ", ".join(f"{number:.3f}" for number in value)
            widest = max(widest, float((high - value).max()), float((value - low).max()))
    return word, numbers | {"widest": widest}


def connected(found):
    """Count the cells of the sea that each chaotic orbit enters."""
    every, least = _entered(found)
    word = CORRECTED if least > CONNECTED * every else FALSE
    impacts = int(found["visit"].values[-1])
    return word, {"orbits": _chaotic(found), "impacts": impacts, "every": every, "least": least}


def _chaotic(found):
    """How many orbits of the spread's are chaotic, as text."""
    chaotic, orbits = int(in_sea(found).sum()), found.sizes["orbit"]
    return f"{chaotic} chaotic ones of {orbits} orbits that start uniformly over the section"


def _entered(found):
    """Return how many cells any chaotic orbit enters, and how many each of them at least."""
    return (int(found[f"entered_{name}"].values[-1]) for name in ("any", "least"))


def sea(found, proved):
    """Count the cells of the sea that each chaotic orbit enters, beside the horseshoes."""
    every, least = _entered(found)
    word = UNDECIDED if least > CONNECTED * every else FALSE
    crossings = "chaos at the crossings of the branches is proved (row 30), and "
    crossings = crossings if all(proved.values()) else ""
    return word, {"crossings": crossings, "every": every, "least": least}


def vanish(found):
    """Compare the exponents of regular orbits with the bound for their length."""
    length = int(found["length"].values[-1])
    largest = float(np.abs(found["regular_exponent"].values[-1]).max())
    small = largest < regular_bound(length)
    return verdict_of(small, largest=largest, length=length, orbits=found.sizes["island"])


def _largest_exponents(found):
    """Return the largest exponent of each chaotic orbit, over all its blocks."""
    return found["exponent"].values[:, in_sea(found)].mean(axis=0).max(axis=-1)


def independent(found):
    """Compare the spread of the exponents of chaotic orbits with that within orbits."""
    block = found["exponent"].values[:, in_sea(found)]
    means = _largest_exponents(found)
    # parts of an orbit spread by chance; if orbits do not differ, so do their means
    parts = np.array_split(block, min(ORBIT_PARTS, block.shape[0]))
    within = np.array([part.mean(axis=0).max(axis=-1) for part in parts]) - means
    freedom = (len(parts) - 1) * means.size
    error = np.sqrt(float(np.sum(within * within)) / freedom / len(parts))
    furthest = float(np.abs(means - means.mean()).max()) / error
    alike = furthest < MAX_STANDARD_ERRORS and float(means.min()) > 0.0
    ends = {"least": means.min(), "most": means.max()}
    return verdict_of(alike, orbits=_chaotic(found), furthest=furthest, **ends)


def chaotic_nature(found):
    """Compare the exponents of chaotic orbits with the bound for regular ones of their length."""
    impacts = found.sizes["block"] * int(found.attrs["block_impacts"])
    least = float(_largest_exponents(found).min())
    bound = regular_bound(impacts)
    positive = least > CHAOTIC_EXPONENT_RATIO * bound
    return verdict_of(positive, orbits=_chaotic(found), least=least, impacts=impacts, bound=bound)


def figure_7(found):
    """Compare number, length and largest exponents of the orbits of Figure 7 with the paper's."""
    impacts, orbits = int(found["impact"].values[-1]), found.sizes["orbit"]
    ends = final_exponents(found)[:, 0]
    good = impacts == SHORT and orbits == 3 and float(ends.min()) > 0.1
    ends = ", ".join(f"{end:.4f}" for end in ends)
    return verdict_of(good, orbits=orbits, impacts=impacts, ends=ends)


def long_run(found):
    """Compare the printed exponent with the mean of long runs and the spread of short ones."""
    means = _largest_exponents(found)
    error = float(means.std(ddof=1)) / np.sqrt(means.size)
    mean = float(means.mean())
    block = int(found.attrs["block_impacts"])
    # as long as a run of Figure 7, or as a block where that is longer
    runs = stretches(found, max(SHORT // block, 1) * block)
    above = float(np.mean(runs > PRINTED_EXPONENT))
    likely = 0.025 < above < 0.975
    word = HOLDS if abs(mean - PRINTED_EXPONENT) < 2 * error else CORRECTED if likely else FALSE
    numbers = {
        "mean": mean,
        "percent": 100 * above,
        "printed": PRINTED_EXPONENT,
        "standard_error": error,
    }
    return word, numbers


def opposite(algebra, found):
    """Find how far exponents are from vanishing in pairs, beside the algebra of determinants."""
    means = found["exponent"].values.mean(axis=0)
    impacts = int(found.attrs["block_impacts"]) * found.sizes["block"]
    drift = max(float(np.abs(means[:, 0] + means[:, 2]).max()), float(np.abs(means[:, 1]).max()))
    holds = formula(algebra, "determinants")[0] and drift < 100.0 / impacts
    return verdict_of(holds, drift=drift, impacts=impacts)


def depends_on_energy(line):
    """Compare the least and the largest regular share over the energies."""
    low, high = float(line["regular"].min()), float(line["regular"].max())
    energy, shares = line["energy"].values * float(line.attrs["g"]) ** 2, ""
    for one in ENERGIES:
        row = int(np.argmin(np.abs(energy - one)))
        share, *ends = (float(line[f"regular{end}"].values[0, row]) for end in ENDS)
        shares += f"; {share:.4f} ({ends[0]:.4f} to {ends[1]:.4f}) at E = {energy[row]:.4g}"
    return verdict_of(low < 0.5 * high, low=low, high=high, shares=shares, width=_widest(line))


def destroyed(line):
    """Find where the regular share rises with the energy by more than its intervals."""
    share, low, high = (line[f"regular{end}"].values[0] for end in ENDS)
    falls, rises = float(share[-1]) < 0.5 * float(share[0]), _rises(share, low, high)
    word = FALSE if not falls else CORRECTED if rises else HOLDS
    energy = line["energy"].values * float(line.attrs["g"]) ** 2
    said = "; ".join(
        f"{share[a]:.4f} at {energy[a]:.4g} to {share[b]:.4f} at {energy[b]:.4g}" for a, b in rises
    )
    said = f"; but it rises from {said}" if rises else ""
    return word, {"first": share[0], "last": share[-1], "rises": said, "width": _widest(line)}


def _widest(line):
    """Return the width of the widest interval of a regular share."""
    return float((line["regular_high"] - line["regular_low"]).max())


def _rises(share, low, high):
    """(from, to) of the rises of a curve that exceed its intervals: from a minimum to a maximum.

    A minimum or maximum counts where on both sides, or up to the curve's end, the curve leaves it
    by more than both intervals before it passes it; of equal values the first.
    """
    found, begin, best = [], 0, None
    for at in range(1, share.size):
        if best is None:
            if share[at] < share[begin]:
                begin = at
            elif low[at] > high[begin]:
                best = at
        elif share[at] > share[best]:
            best = at
        elif high[at] < low[best]:
            found.append((begin, best))
            begin, best = at, None
    return [*found, (begin, best)] if best is not None else found


def discontinuous(found):
    """Count how often regular and chaotic starts change places along y = 0."""
    energies, switches = found["energy"].values, []
    for energy in ENERGIES:
        row = int(np.argmin(np.abs(energies - energy)))
        good = regular(found["exponent"].values[row], found.attrs["impacts"])
        switches.append(int(np.sum(good[1:] != good[:-1])))
    counts = " and ".join(
        f"{count} times at E = {energy:g}" for count, energy in zip(switches, ENERGIES, strict=True)
    )
    return verdict_of(min(switches) >= 3, counts=counts, starts=good.size)


def mixture(plane):
    """Count the pairs of k and E/g^2 whose regular share is neither near 0 nor near 1."""
    low, high = (plane[f"regular_{end}"].values for end in ("low", "high"))
    mixed, bare = (
        float(np.mean((low > margin) & (high < 1.0 - margin))) for margin in (MARGIN, 1e-9)
    )
    everywhere = np.isfinite(plane["trace"].values).all()
    return verdict_of(
        mixed > 0.5,
        mixed=100 * mixed,
        bare=100 * bare,
        pairs=low.size,
        low=MARGIN,
        high=1 - MARGIN,
        fixed_points="; each has a fixed point" if everywhere else "",
    )


def material(plane):
    """Compare the least and the largest regular share over k at the energy of Figure 2."""
    column = int(np.argmin(np.abs(plane["energy"].values - OF_FIGURE_2)))
    share, low, high = (plane[f"regular{end}"].values[:, column] for end in ENDS)
    rows = int(np.argmin(share)), int(np.argmax(share))
    least, most = (
        f"{share[row]:.4f} ({low[row]:.4f} to {high[row]:.4f}) at k = {plane['k'].values[row]:.3f}"
        for row in rows
    )
    depends = float(low[rows[1]]) > float(high[rows[0]])
    return verdict_of(depends, energy=plane["energy"].values[column], least=least, most=most)
