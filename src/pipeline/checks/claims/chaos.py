"""Claims about the chaotic sea: clusters, exponents, what depends on the energy. Section 4.1."""

import numpy as np

from pseudorigid.dynamics.variables import final_exponents
from pseudorigid.evidence.rotation import regular
from pseudorigid.evidence.spread import stretches

from .ledger import CORRECTED, DERIVED, FALSE, HOLDS, Verdict, claim, decided, formula

SHORT = 200_000  # impacts of a run of Figure 7
ENERGIES = (0.001, 0.01)  # of the paper's figures
ENDS = ("", "_low", "_high")
PRINTED = 0.235
PARTS, FAR = 50, 5.0  # of an orbit; standard errors that an orbit's mean may be off by chance
LITTLE = 0.01  # of a variance: what an uncorrelated cluster may seem to explain of the next


@claim(32, "4.1", "P", "clusters/clusters")
def clustered(found):
    """“the sphere may experience a sequence of densely clustered impacts before it globally
    separates from the foundation”"""
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
    return decided(deep, value, f"{error:.1g} of the times", "more_figures/claims/clusters.png")


@claim(33, "4.1", "Q", "clusters/clusters")
def uncorrelated(found):
    """“the initial conditions for such successive clusters of impact appear to be completely
    uncorrelated”"""
    explained = found["dependence_low"].values[:, 0].max(axis=1)
    strongest = np.abs(found["correlation"].values[:, 0]).max(axis=(1, 2))
    least, most = float(explained.min()), float(explained.max())
    word = FALSE if least > LITTLE else CORRECTED if most > LITTLE else HOLDS
    largest = found["dependence"].values[:, 0].max(axis=1)
    said = ", ".join(f"{share:.2f}" for share in largest)
    cuts = ", ".join(f"{cut:g}" for cut in found["cut"].values)
    value = f"a cluster explains {said} of the next one's variance, cut at {cuts}; correlations "
    value += f"up to {', '.join(f'{r:.2f}' for r in strongest)}"
    width = found["dependence_high"].values - found["dependence_low"].values
    return Verdict(word, value, f"{width.max():.1g}", "more_figures/claims/clusters.png")


@claim(34, "4.1", "T", "spread/spread")
def connected(found):
    """“The globally connected character of the chaotic region in Figure 2 is asserted by a
    calculation of Lyapunov characteristic exponents”"""
    every, least = (int(found[f"entered_{name}"].values[-1]) for name in ("any", "least"))
    impacts, orbits = int(found["visit"].values[-1]), found.sizes["orbit"]
    value = f"each of {orbits} orbits of {impacts:,} impacts enters {least} or more of the {every} "
    value += "cells that any enters; equal exponents alone would not show it"
    everywhere = least > 0.95 * every
    return decided(everywhere, value, "numerical", "more_figures/claims/spread.png")


@claim(35, "4.1", "T", "spread/spread")
def vanish(found):
    """“vanish identically for initial conditions resulting in regular trajectories”"""
    length = int(found["length"].values[-1])
    largest = float(np.abs(found["regular_exponent"].values[-1]).max())
    small = largest < 3.0 * np.log(length) / length
    value = f"at most {largest:.1e} after {length:,} impacts of {found.sizes['island']} orbits"
    return decided(small, value, "falls like ln n/n", "more_figures/claims/spread.png")


@claim(36, "4.1", "T", "spread/spread")
def independent(found):
    """“a positive maximal Lyapunov exponent that is independent of the choice of chaotic
    trajectory”"""
    block = found["exponent"].values
    means = block.mean(axis=0).max(axis=-1)
    # parts of an orbit spread by chance; if orbits do not differ, so do their means
    parts = np.array_split(block, min(PARTS, block.shape[0]))
    within = np.array([part.mean(axis=0).max(axis=-1) for part in parts]) - means
    freedom = (len(parts) - 1) * means.size
    error = np.sqrt(float(np.sum(within * within)) / freedom / len(parts))
    furthest = float(np.abs(means - means.mean()).max()) / error
    alike = furthest < FAR and float(means.min()) > 0.0
    value = f"{means.size} orbits from {means.min():.4f} to {means.max():.4f}"
    said = f"at most {furthest:.1f} standard errors from their mean"
    return decided(alike, value, said, "more_figures/claims/spread.png")


@claim(39, "Figure 7", "F", "fig7/lyapunov")
def figure_7(found):
    """“Lyapunov exponents corresponding to three distinct trajectories in the chaotic”"""
    impacts, orbits = int(found["impact"].values[-1]), found.sizes["orbit"]
    ends = final_exponents(found)[:, 0]
    good = impacts == SHORT and orbits == 3 and float(ends.min()) > 0.1
    value = f"{orbits} orbits of {impacts:,} impacts end at "
    value += ", ".join(f"{end:.4f}" for end in ends)
    return decided(good, value, "one draw", "paper_figures/fig7.png")


@claim(40, "4.1", "N", "spread/spread")
def long_run(found):
    """“The three maximal values converge to approximately 0.235”"""
    means = found["exponent"].values.mean(axis=0).max(axis=-1)
    error = float(means.std(ddof=1)) / np.sqrt(means.size)
    mean = float(means.mean())
    above = float(np.mean(_short_runs(found) > PRINTED))
    likely = 0.025 < above < 0.975
    word = HOLDS if abs(mean - PRINTED) < 2 * error else CORRECTED if likely else FALSE
    value = f"{mean:.5f}; {100 * above:.0f} % of runs of 200,000 exceed {PRINTED}"
    return Verdict(word, value, f"{error:.5f}", "more_figures/claims/spread.png")


def _short_runs(spread):
    """Exponents of stretches as long as a run of Figure 7, or of a block where that is longer."""
    block = int(spread.attrs["block_impacts"])
    return stretches(spread, max(SHORT // block, 1) * block)


@claim(41, "4.1", "T", "derivations", "spread/spread")
def opposite(algebra, found):
    """“The two non-vanishing exponents are equal and opposite”"""
    means = found["exponent"].values.mean(axis=0)
    impacts = int(found.attrs["block_impacts"]) * found.sizes["block"]
    drift = max(float(np.abs(means[:, 0] + means[:, 2]).max()), float(np.abs(means[:, 1]).max()))
    holds = formula(algebra, "determinants")[0] and drift < 100.0 / impacts
    value = f"|l1 + l3|, |l2| up to {drift:.0e} after {impacts:,} impacts, falling like 1/n"
    return decided(holds, value, "exact in the limit", DERIVED)


@claim(43, "4.1", "Q", "atlas/line")
def depends_on_energy(line):
    """“The presence of regular behavior in the system depends crucially on the energy”"""
    low, high = float(line["regular"].min()), float(line["regular"].max())
    value = f"regular share of the section from {low:.3f} to {high:.3f}"
    energy = line["energy"].values * float(line.attrs["g"]) ** 2
    for one in ENERGIES:
        row = int(np.argmin(np.abs(energy - one)))
        share, *ends = (float(line[f"regular{end}"].values[0, row]) for end in ENDS)
        value += f"; {share:.3f} ({ends[0]:.3f} to {ends[1]:.3f}) at E = {energy[row]:.4g}"
    return decided(low < 0.5 * high, value, _widest(line), "more_figures/atlas/line.png")


@claim(44, "4.1", "Q", "atlas/line")
def destroyed(line):
    """“the regular trajectories appear to be progressively destroyed as the total energy
    increases”"""
    share, low, high = (line[f"regular{end}"].values[0] for end in ENDS)
    falls, rises = float(share[-1]) < 0.5 * float(share[0]), _rises(low, high)
    word = FALSE if not falls else CORRECTED if rises else HOLDS
    energy = line["energy"].values * float(line.attrs["g"]) ** 2
    said = "; ".join(
        f"{share[a]:.3f} near {energy[a]:.4g} to {share[b]:.3f} near {energy[b]:.4g}"
        for a, b in rises
    )
    value = f"in trend, {share[0]:.3f} to {share[-1]:.3f}"
    value += f"; but it rises from {said}" if rises else ""
    return Verdict(word, value, _widest(line), "more_figures/atlas/line.png")


def _widest(line):
    """The widest interval of a regular share, as text."""
    width = float((line["regular_high"] - line["regular_low"]).max())
    return f"95 % intervals up to {width:.3f} wide"


def _rises(low, high):
    """(from, to) of the rises of a curve that exceed its intervals: from a minimum to a maximum.

    A rise begins where the interval's upper end is least and ends, at the latest before the curve
    falls by as much, where its lower end is greatest.
    """
    found, begin, at = [], 0, 1
    best = None
    while at < low.size:
        if best is None:
            if high[at] < high[begin]:
                begin = at
            elif low[at] > high[begin]:
                best = at
        elif low[at] > low[best]:
            best = at
        elif high[at] < low[best]:
            found.append((begin, best))
            begin, best = at, None
        at += 1
    return [*found, (begin, best)] if best is not None else found


@claim(45, "4.1", "Q", "rotation/rotation")
def discontinuous(found):
    """“does not appear to depend continuously on initial conditions”"""
    good = regular(found["exponent"].values[0], found.attrs["impacts"])
    switches = int(np.sum(good[1:] != good[:-1]))
    value = f"along y = 0 regular and chaotic starts change places {switches} times"
    starts = f"{good.size} starts"
    return decided(switches >= 3, value, starts, "more_figures/claims/rotation.png")


@claim(46, "1, 5", "Q", "atlas/plane")
def mixture(plane):
    """“an energy surface typically consists of periodic, quasi-periodic and chaotic
    trajectories”"""
    share = plane["regular"].values
    mixed = float(np.mean((share > 0.0) & (share < 1.0)))
    value = f"{100 * mixed:.0f} % of {share.size:,} pairs of k and E/g^2 have both"
    return decided(mixed > 0.5, value, "share of the cells", "more_figures/atlas/plane.png")
