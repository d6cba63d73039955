"""Claims about the chaotic sea: clusters, exponents, what depends on the energy. Section 4.1."""

import numpy as np

from pseudorigid.dynamics.variables import final_exponents
from pseudorigid.evidence.rotation import regular
from pseudorigid.evidence.spread import in_sea, regular_bound, stretches

from .ledger import CORRECTED, DERIVED, FALSE, HOLDS, UNDECIDED, Verdict, claim, decided, formula
from .periodic import HORSESHOES

SHORT = 200_000  # impacts of a run of Figure 7
ENERGIES = (0.001, 0.01)  # of the paper's figures
ENDS = ("", "_low", "_high")
PRINTED = 0.235
OF_FIGURE_2 = 6.25  # E/g^2
CONNECTED = 0.95  # of the cells that any orbit enters; each has to enter more
CLEARLY = 100.0  # times the exponent that a regular orbit may have
PARTS, FAR = 50, 5.0  # of an orbit; standard errors that an orbit's mean may be off by chance
LITTLE = 0.01  # of a variance: what an uncorrelated cluster may seem to explain of the next
# A share that near to 0 or 1 may be wrong verdicts: 0.0041 of them are in the plane, docs/atlas.md.
MARGIN = 0.01


@claim(32, "4.1", "P", "clusters/clusters")
def clustered(found):
    """“the sphere may experience a sequence of densely clustered impacts before it globally
    separates from the foundation, only to come again to contact due to gravity”"""
    count, edge = found["flights"].values, found["bin_edge"].values
    last = count.size - 2  # the last bin may be cut short
    valley = int(np.argmin(count[: last + 1] + np.where(edge[: last + 1] < 3.0, count.max(), 0)))
    deep = count[valley] < 0.25 * min(count[:valley].max(), count[valley:].max())
    columns = (found[name].values for name in ("cut", "cluster_impacts", "period"))
    rows = zip(*columns, strict=True)
    pairs = [f"{cut:g}: {size:.1f} impacts, {period:.2f}" for cut, size, period in rows]
    error = float(found["period_error"].values.max())
    value = f"few flights of {edge[valley]:.1f}; impacts in a cluster and time between them, "
    value += f"cut at {'; '.join(pairs)}"
    remark = f"standard error of the times at most {error:.1g}"
    return decided(deep, value, remark, "more_figures/claims/clusters.png")


@claim(33, "4.1", "Q", "clusters/clusters")
def uncorrelated(found):
    """“In the chaotic region of Figure 2, the initial conditions for such successive clusters of
    impact appear to be completely uncorrelated”"""
    explained = found["dependence_low"].values[:, 0].max(axis=1)
    least, most = float(explained.min()), float(explained.max())
    word = FALSE if least > LITTLE else CORRECTED if most > LITTLE else HOLDS
    cuts = ", ".join(f"{cut:g}" for cut in found["cut"].values)
    parts, widest = [], 0.0
    for index, name in ((1, "y"), (0, "x")):
        at = {"correlation": np.s_[:, 0, index, index], "dependence": np.s_[:, 0, index]}
        said = {}
        for measure, place in at.items():
            value, low, high = (found[f"{measure}{end}"].values[place] for end in ENDS)
            said[measure] = ", ".join(f"{number:.3f}" for number in value)
            widest = max(widest, float((high - value).max()), float((value - low).max()))
        parts.append(
            f"the share {said['dependence']} of the variance of the next cluster's first {name}, "
            f"which correlates with this one's first {name} by {said['correlation']}"
        )
    value = f"cut at {cuts}, where a cluster begins explains {'; and '.join(parts)}"
    error = f"95 % intervals within {widest:.3f}"
    return Verdict(word, value, error, "more_figures/claims/clusters.png")


@claim(34, "4.1", "T", "spread/spread")
def connected(found):
    """“The globally connected character of the chaotic region in Figure 2 is asserted by a
    calculation of Lyapunov characteristic exponents of the map”"""
    every, least = (int(found[f"entered_{name}"].values[-1]) for name in ("any", "least"))
    impacts = int(found["visit"].values[-1])
    value = "equal exponents do not show it: two regions apart may have them. But each of the "
    value += (
        f"{_chaotic(found)} in {impacts:,} impacts enters {least} or more of the {every} cells "
    )
    value += "that any of them enters"
    word = CORRECTED if least > CONNECTED * every else FALSE
    error = "to the size of a cell; no proof"
    return Verdict(word, value, error, "results/claims/spread_spread.nc")


def _chaotic(found):
    """How many orbits of the spread's are chaotic, as text."""
    chaotic, orbits = int(in_sea(found).sum()), found.sizes["orbit"]
    return f"{chaotic} chaotic ones of {orbits} orbits that start uniformly over the section"


@claim(62, "1", "Q", "spread/spread", theorems=HORSESHOES)
def sea(found, proved):
    """“The branches of these manifolds generate a sea of connected chaos surrounding islands
    characterized by dominantly regular behavior”"""
    every, least = (int(found[f"entered_{name}"].values[-1]) for name in ("any", "least"))
    cells = f"each chaotic orbit enters {least} or more of the {every} cells of the sea (row 34)"
    word = UNDECIDED if least > CONNECTED * every else FALSE
    value = f"chaos at the crossings of the branches is proved (row 30), and {cells}"
    value = value if proved(*HORSESHOES) else cells
    value += "; that the branches fill the whole sea is not shown"
    return Verdict(word, value, "", "results/claims/spread_spread.nc")


@claim(35, "4.1", "T", "spread/spread")
def vanish(found):
    """“the Lyapunov exponents measure the mean exponential rate of divergence of nearby
    trajectories, hence vanish identically for initial conditions resulting in regular
    trajectories”"""
    length = int(found["length"].values[-1])
    largest = float(np.abs(found["regular_exponent"].values[-1]).max())
    small = largest < regular_bound(length)
    value = f"at most {largest:.1e} after {length:,} impacts of {found.sizes['island']} orbits"
    return decided(small, value, "falls like ln n/n", "more_figures/claims/spread.png")


@claim(36, "4.1", "T", "spread/spread")
def independent(found):
    """“On the other hand, a region of connected chaos is characterized by a positive maximal
    Lyapunov exponent that is independent of the choice of chaotic trajectory”"""
    block = found["exponent"].values[:, in_sea(found)]
    means = block.mean(axis=0).max(axis=-1)
    # parts of an orbit spread by chance; if orbits do not differ, so do their means
    parts = np.array_split(block, min(PARTS, block.shape[0]))
    within = np.array([part.mean(axis=0).max(axis=-1) for part in parts]) - means
    freedom = (len(parts) - 1) * means.size
    error = np.sqrt(float(np.sum(within * within)) / freedom / len(parts))
    furthest = float(np.abs(means - means.mean()).max()) / error
    alike = furthest < FAR and float(means.min()) > 0.0
    value = f"the {_chaotic(found)} have exponents from {means.min():.4f} to {means.max():.4f}"
    said = f"at most {furthest:.1f} standard errors from their mean"
    return decided(alike, value, said, "more_figures/claims/spread.png")


@claim(66, "1", "Q", "spread/spread")
def chaotic_nature(found):
    """“The chaotic nature of the sea is evidenced by the calculation of Lyapunov characteristic
    exponents”"""
    lengths = found.sizes["block"] * int(found.attrs["block_impacts"])
    means = found["exponent"].values[:, in_sea(found)].mean(axis=0).max(axis=-1)
    value = f"the {_chaotic(found)} have exponents of at least {means.min():.4f}, where regular "
    value += f"orbits of {lengths:,} impacts stay below {regular_bound(lengths):.0e}"
    positive = float(means.min()) > CLEARLY * regular_bound(lengths)
    return decided(positive, value, "of finite runs", "more_figures/claims/spread.png")


@claim(39, "Figure 7", "F", "fig7/lyapunov")
def figure_7(found):
    """“Lyapunov exponents corresponding to three distinct trajectories in the chaotic sea of Figure
    2”"""
    impacts, orbits = int(found["impact"].values[-1]), found.sizes["orbit"]
    ends = final_exponents(found)[:, 0]
    good = impacts == SHORT and orbits == 3 and float(ends.min()) > 0.1
    value = f"{orbits} orbits of {impacts:,} impacts end at "
    value += ", ".join(f"{end:.4f}" for end in ends)
    return decided(good, value, "one draw", "paper_figures/fig7.png")


@claim(40, "4.1", "N", "spread/spread")
def long_run(found):
    """“The three maximal values converge to approximately 0.235 as the number of iterations
    increases”"""
    means = found["exponent"].values[:, in_sea(found)].mean(axis=0).max(axis=-1)
    error = float(means.std(ddof=1)) / np.sqrt(means.size)
    mean = float(means.mean())
    above = float(np.mean(_short_runs(found) > PRINTED))
    likely = 0.025 < above < 0.975
    word = HOLDS if abs(mean - PRINTED) < 2 * error else CORRECTED if likely else FALSE
    value = f"they converge to {mean:.5f}; {100 * above:.0f} % of runs of 200,000 impacts exceed "
    value += f"{PRINTED}: a run of that length is a single draw"
    return Verdict(word, value, f"{error:.5f}", "more_figures/claims/spread.png")


def _short_runs(spread):
    """Exponents of stretches as long as a run of Figure 7, or of a block where that is longer."""
    block = int(spread.attrs["block_impacts"])
    return stretches(spread, max(SHORT // block, 1) * block)


@claim(41, "4.1", "T", "derivations", "spread/spread")
def opposite(algebra, found):
    """“The two non-vanishing exponents are equal and opposite, as in the case of symplectic maps,
    see [20, Theorem 8]”"""
    means = found["exponent"].values.mean(axis=0)
    impacts = int(found.attrs["block_impacts"]) * found.sizes["block"]
    drift = max(float(np.abs(means[:, 0] + means[:, 2]).max()), float(np.abs(means[:, 1]).max()))
    holds = formula(algebra, "determinants")[0] and drift < 100.0 / impacts
    value = f"|l1 + l3|, |l2| up to {drift:.0e} after {impacts:,} impacts, falling like 1/n"
    return decided(holds, value, "exact in the limit", DERIVED)


@claim(43, "4.1", "Q", "atlas/line")
def depends_on_energy(line):
    """“The presence of regular behavior in the system depends crucially on the energy E”"""
    low, high = float(line["regular"].min()), float(line["regular"].max())
    value = f"regular share of the section from {low:.4f} to {high:.4f}"
    energy = line["energy"].values * float(line.attrs["g"]) ** 2
    for one in ENERGIES:
        row = int(np.argmin(np.abs(energy - one)))
        share, *ends = (float(line[f"regular{end}"].values[0, row]) for end in ENDS)
        value += f"; {share:.4f} ({ends[0]:.4f} to {ends[1]:.4f}) at E = {energy[row]:.4g}"
    return decided(low < 0.5 * high, value, _widest(line), "more_figures/atlas/line.png")


@claim(44, "4.1", "Q", "atlas/line")
def destroyed(line):
    """“Further, the regular trajectories appear to be progressively destroyed as the total energy
    increases”"""
    share, low, high = (line[f"regular{end}"].values[0] for end in ENDS)
    falls, rises = float(share[-1]) < 0.5 * float(share[0]), _rises(share, low, high)
    word = FALSE if not falls else CORRECTED if rises else HOLDS
    energy = line["energy"].values * float(line.attrs["g"]) ** 2
    said = "; ".join(
        f"{share[a]:.4f} at {energy[a]:.4g} to {share[b]:.4f} at {energy[b]:.4g}" for a, b in rises
    )
    value = f"in trend, {share[0]:.4f} to {share[-1]:.4f}"
    value += f"; but it rises from {said}" if rises else ""
    return Verdict(word, value, _widest(line), "more_figures/atlas/line.png")


def _widest(line):
    """The widest interval of a regular share, as text."""
    width = float((line["regular_high"] - line["regular_low"]).max())
    return f"95 % intervals up to {width:.4f} wide"


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


@claim(45, "4.1", "Q", "rotation/rotation")
def discontinuous(found):
    """“The regular behavior observed here, as well as in Figure 2, does not appear to depend
    continuously on initial conditions”"""
    energies, switches = found["energy"].values, []
    for energy in ENERGIES:
        row = int(np.argmin(np.abs(energies - energy)))
        good = regular(found["exponent"].values[row], found.attrs["impacts"])
        switches.append(int(np.sum(good[1:] != good[:-1])))
    said = " and ".join(
        f"{count} times at E = {energy:g}" for count, energy in zip(switches, ENERGIES, strict=True)
    )
    value = f"along y = 0 regular and chaotic starts change places {said}"
    starts = f"counted on {good.size} starts each"
    return decided(min(switches) >= 3, value, starts, "more_figures/claims/rotation.png")


@claim(46, "abstract, 1", "Q", "atlas/plane")
def mixture(plane):
    """“A numerical study of this map at various energy levels reveals that an energy surface
    typically consists of periodic, quasi-periodic and chaotic trajectories”"""
    low, high = (plane[f"regular_{end}"].values for end in ("low", "high"))
    mixed, bare = (
        float(np.mean((low > margin) & (high < 1.0 - margin))) for margin in (MARGIN, 1e-9)
    )
    value = f"in {100 * mixed:.0f} % of {low.size:,} pairs of k and E/g^2 regular and chaotic "
    value += f"orbits are seen: the 95 % interval of the regular share lies between {MARGIN:g} and "
    value += f"{1 - MARGIN:g} ({100 * bare:.0f} % exclude just 0 and 1)"
    value += "; each has a fixed point" if np.isfinite(plane["trace"].values).all() else ""
    error = "0.4 % of the verdicts on orbits are wrong"
    return decided(mixed > 0.5, value, error, "more_figures/atlas/plane.png, docs/atlas.md")


@claim(65, "5", "Q", "atlas/plane")
def material(plane):
    """“the impact loading induces a mixture of regular and chaotic response depending on the
    material parameters”"""
    column = int(np.argmin(np.abs(plane["energy"].values - OF_FIGURE_2)))
    share, low, high = (plane[f"regular{end}"].values[:, column] for end in ENDS)
    least, most = int(np.argmin(share)), int(np.argmax(share))
    said = " to ".join(
        f"{share[row]:.4f} ({low[row]:.4f} to {high[row]:.4f}) at k = {plane['k'].values[row]:.3f}"
        for row in (least, most)
    )
    value = f"at E/g^2 = {plane['energy'].values[column]:.3f} the regular share goes from {said}; "
    value += "it depends on k and E/g^2 alone (row 10)"
    depends = float(low[most]) > float(high[least])
    return decided(depends, value, "95 % intervals", "more_figures/atlas/plane.png")
