"""Claims of the paper's section 3 and how it computes: flight, map, energy, bounds, figures."""

import numpy as np

from .ledger import CORRECTED, DERIVED, HOLDS, Verdict, claim, decided, derived, formula, number_of

ROUNDING = 1e-13  # of an energy, over an orbit


@claim(12, "(26)-(27)", "E", "derivations")
def flights(algebra):
    """the motion between impacts"""
    return derived(algebra, "flights", value="free fall, and a strain of frequency 1")


@claim(13, "(28)", "E", "derivations")
def impact_map(algebra):
    """the map from one impact to the next"""
    value = "the sign before 2k/(1+k) udot inside the square of the first line is minus"
    remark = "exact; of many solutions the smallest flight time is meant"
    return derived(algebra, "impact_map", value=value, remark=remark)


@claim(14, "3", "T", "derivations", "jumps/jumps", theorems=["jump-set", "diffeomorphism"])
def diffeomorphism(algebra, jumps, proved):
    """“is smooth and invertible with a smooth inverse, hence is a diffeomorphism”"""
    length, error = float(jumps["length"].values[0]), float(jumps["length_error"].values[0])
    threshold = number_of(algebra, "smooth")
    energy = float(jumps["energy"].values[0])
    if length > 0.0 and formula(algebra, "smooth")[1]:
        said = "proved" if proved("jump-set", "diffeomorphism") else "computed"
        value = (
            f"it jumps on a curve of length {length:.12f} at E = {energy:g}{_second_length(jumps)}"
        )
        value += f"; smooth ({said}) below E = g^2 (1 + k/2) = {threshold:g}"
        return decided(False, value, f"{error:.0e}", "more_figures/claims/jumps.png")
    return decided(True, f"no jump at E = {energy:g}", "", "more_figures/claims/jumps.png")


def _second_length(jumps):
    """Length and error of the curve at the energy next below the first that has one, as text."""
    energy, length = jumps["energy"].values, jumps["length"].values
    below = np.flatnonzero((length > 0.0) & (energy < energy[0]))
    if not below.size:
        return ""
    row = int(below[np.argmax(energy[below])])
    error = float(jumps["length_error"].values[row])
    return f", {length[row]:.12f} (to {error:.0e}) at E = {energy[row]:g}"


@claim(15, "(29)", "T", "derivations", "clusters/clusters")
def energy_surface(algebra, sea):
    """“any trajectory of the impact map must lie on the two-dimensional ellipsoidal energy
    surface”"""
    error = float(sea["energy_error"].max())
    kept = formula(algebra, "conserved_energy")[0] and error < ROUNDING
    value = "the energy of each orbit is kept to rounding"
    bound = f"below {ROUNDING:.0e}" if error < ROUNDING else f"{error:.1e}"
    return decided(kept, value, bound, f"{DERIVED}, tests/kernel/test_impact.py")


@claim(16, "3", "T", "fig2/orbits", "fig8/orbits")
def half_of_it(*portraits):
    """“the trajectories are restricted to only the semi-ellipsoid”"""
    speeds = [d["xdot"].values + d["udot"].values for d in portraits]
    least = min(float(s.min()) for s in speeds)
    count = sum(s.size for s in speeds)
    value = f"least contact speed of {count:,} impacts: {least:.1e}"
    return decided(least >= 0.0, value, "none below 0", "tests/kernel/test_impact.py")


@claim(17, "(30)-(31)", "T", "derivations")
def energy_bound(algebra):
    """“the restriction (30) can be equivalently stated as”"""
    value = f"E < k/2 - g = {number_of(algebra, 'bound'):g}"
    remark = "needs g < k, which the paper's ball fulfils"
    return derived(algebra, "bound", value=value, remark=remark)


@claim(18, "2.2, (6)", "T", "derivations", "clusters/clusters")
def never_inside_out(algebra, sea):
    """“This constraint will be enforced at the outset by the appropriate choice of initial
    conditions”"""
    least = float(sea["least_strain"].min())
    bounded = formula(algebra, "bound_in_flight")[0] and least > -1.0
    value = f"also in flight; least strain of the sea {least:.3f}"
    return decided(bounded, value, "exact bound", DERIVED)


@claim(19, "4.1", "Q", "as_published/fig7/lyapunov")
def bisection(lyapunov):
    """“This guarantees that (22) is satisfied at impact”"""
    missed, impacts = (int(lyapunov.attrs[name]) for name in ("impacts_missed", "impacts"))
    value = f"{missed} of {impacts:,} impacts of Figure 7 missed by steps of 0.1 and bisection"
    remark = "our reading: the paper names neither step nor tolerance"
    return decided(missed == 0, value, remark, "./reproduce variant as_published")


@claim(20, "Figure 2", "FN", "fig2/orbits")
def figure_2(orbits):
    """“corresponding to 8 initial conditions and approximately 45,000 points”"""
    return _portrait(orbits, 8, 45_000, "fig2.png")


@claim(42, "Figure 8", "FNQ", "fig8/orbits", "atlas/line")
def figure_8(orbits, line):
    """“with dominantly regular behavior around the elliptic periodic points of the map”"""
    drawn = _portrait(orbits, 6, 35_000, "fig8.png")
    energy, g = (float(orbits.attrs[name]) for name in ("energy", "g"))
    row = int(np.argmin(np.abs(line["energy"].values - energy / g**2)))
    share, low, high = (
        float(line[f"regular{end}"].values[0, row]) for end in ("", "_low", "_high")
    )
    holds = drawn.verdict == HOLDS and low > 0.5
    value = f"{drawn.value}; {share:.3f} of the section is regular"
    return decided(holds, value, f"{low:.3f} to {high:.3f}", drawn.evidence)


@claim(37, "(32)", "E", "derivations")
def exponents_defined(algebra):
    """“These exponents are defined by”"""
    value = "1/i times the logarithm of the growth, as i grows"
    return derived(algebra, "exponents", value=value, remark="a factor 1/i is missing")


@claim(38, "(33)", "E", "derivations")
def jacobian(algebra):
    """“solving a system of nine linear algebraic equations resulting from differentiating
    (28)”"""
    remark = "exact, of (28) corrected"
    return derived(algebra, "jacobian", value="the analytic Jacobian used here", remark=remark)


@claim(47, "(36)-(38)", "T", "derivations")
def one_form(algebra):
    """“is well-defined at impact”"""
    return derived(algebra, "one_form", value="the same before the impact and after it")


@claim(48, "(39)-(42)", "T", "derivations")
def symplectic(algebra):
    """“the symplectic property of the map on the two-dimensional energy manifold is
    established”"""
    value = "with varying flight times, by Poincare and Cartan at fixed energy"
    remark = "where P is smooth"
    return derived(algebra, "area", "determinants", value=value, remark=remark, proved=True)


@claim(53, "5", "Q", "jumps/jumps")
def piecewise(jumps):
    """“a piecewise differentiable Lagrangian system”"""
    length = float(jumps["length"].values[0])
    value = "one curve of jumps, smooth on either side" if length > 0.0 else "no curve of jumps"
    word = HOLDS if length > 0.0 else CORRECTED
    error = f"from {jumps.sizes['point'] - 1:,} grazing states"
    return Verdict(word, value, error, "more_figures/claims/jumps.png")


def _portrait(orbits, starts, points, name):
    """Whether a portrait has as many starts as said, and about as many points."""
    found, total = orbits.sizes["orbit"], int(orbits["row_size"].sum())
    as_said = found == starts and abs(total - points) < 0.05 * points
    value, remark = f"{found} starts, {total:,} points", "starts are ours: the paper prints none"
    return decided(as_said, value, remark, f"paper_figures/{name}")
