"""Claims of the paper's section 3 and how it computes: flight, map, energy, bounds, figures."""

import numpy as np

from . import ledger
from .ledger import CORRECTED, FALSE, HOLDS, PROVED, Verdict, derived, formula, number_of

CLAIMS = []
claim = ledger.collector(CLAIMS)

ROUNDING = 1e-13  # of an energy, over an orbit
PORTRAITS = ("fig2/orbits", "fig8/orbits")


@claim(12, "(26)-(27)", "E", words="the motion between impacts", data=["derivations"])
def flights(data, proved):
    value = "free fall, and a strain of frequency 1"
    return derived(data["derivations"], "flights", value=value)


@claim(13, "(28)", "E", words="the map from one impact to the next", data=["derivations"])
def impact_map(data, proved):
    value = "the sign before 2k/(1+k) udot inside the square of the first line is minus"
    remark = "exact; of many solutions the smallest flight time is meant"
    return derived(data["derivations"], "impact_map", value=value, remark=remark)


@claim(
    14,
    "3",
    "T",
    quote="is smooth and invertible with a smooth inverse, hence is a diffeomorphism",
    data=["derivations", "jumps/jumps"],
    theorems=["jump-set", "diffeomorphism"],
)
def diffeomorphism(data, proved):
    jumps = data["jumps/jumps"]
    length, error = float(jumps["length"].values[0]), float(jumps["length_error"].values[0])
    threshold = number_of(data["derivations"], "smooth")
    known = formula(data["derivations"], "smooth")[1]
    energy = float(jumps["energy"].values[0])
    if length > 0.0 and known:
        said = "proved" if proved("jump-set") and proved("diffeomorphism") else "computed"
        value = f"it jumps on a curve of length {length:.12f} at E = {energy:g}"
        value += _second_length(jumps)
        value += f"; smooth ({said}) below E = g^2 (1 + k/2) = {threshold:g}"
        return Verdict(FALSE, value, f"{error:.0e}", "more_figures/claims/jumps.png")
    return Verdict(HOLDS, f"no jump at E = {energy:g}", "", "more_figures/claims/jumps.png")


def _second_length(jumps):
    """Length and error of the curve at the energy next below the first that has one, as text."""
    energy, length = jumps["energy"].values, jumps["length"].values
    below = np.flatnonzero((length > 0.0) & (energy < energy[0]))
    if not below.size:
        return ""
    row = int(below[np.argmax(energy[below])])
    error = float(jumps["length_error"].values[row])
    return f", {length[row]:.12f} (to {error:.0e}) at E = {energy[row]:g}"


@claim(
    15,
    "(29)",
    "T",
    quote="any trajectory of the impact map must lie on the two-dimensional ellipsoidal energy "
    "surface",
    data=["derivations", "clusters/clusters"],
)
def energy_surface(data, proved):
    sea = data["clusters/clusters"]
    error = float(sea["energy_error"].max())
    good = formula(data["derivations"], "conserved_energy")[0] and error < ROUNDING
    word = HOLDS if good else FALSE
    value = "the energy of each orbit is kept to rounding"
    bound = f"below {ROUNDING:.0e}" if error < ROUNDING else f"{error:.1e}"
    return Verdict(
        word, value, bound, "tests/proofs/test_derivations.py, tests/kernel/test_impact.py"
    )


@claim(
    16,
    "3",
    "T",
    quote="the trajectories are restricted to only the semi-ellipsoid",
    data=PORTRAITS,
)
def half_of_it(data, proved):
    speeds = [d["xdot"].values + d["udot"].values for d in data.values()]
    least = min(float(s.min()) for s in speeds)
    count = sum(s.size for s in speeds)
    value = f"least contact speed of {count:,} impacts: {least:.1e}"
    word = HOLDS if least >= 0.0 else FALSE
    return Verdict(word, value, "none below 0", "tests/kernel/test_impact.py")


@claim(
    17,
    "(30)-(31)",
    "T",
    quote="the restriction (30) can be equivalently stated as",
    data=["derivations"],
)
def energy_bound(data, proved):
    value = f"E < k/2 - g = {number_of(data['derivations'], 'bound'):g}"
    remark = "needs g < k, which the paper's ball fulfils"
    return derived(data["derivations"], "bound", value=value, remark=remark)


@claim(
    18,
    "2.2, (6)",
    "T",
    quote="This constraint will be enforced at the outset by the appropriate choice of initial "
    "conditions",
    data=["derivations", "clusters/clusters"],
)
def never_inside_out(data, proved):
    least = float(data["clusters/clusters"]["least_strain"].min())
    bounded = formula(data["derivations"], "bound_in_flight")[0]
    word = HOLDS if bounded and least > -1.0 else FALSE
    value = f"also in flight; least strain of the sea {least:.3f}"
    return Verdict(word, value, "exact bound", "tests/proofs/test_derivations.py")


@claim(
    19,
    "4.1",
    "Q",
    quote="This guarantees that (22) is satisfied at impact",
    data=["as_published/fig7/lyapunov"],
)
def bisection(data, proved):
    attributes = data["as_published/fig7/lyapunov"].attrs
    missed, impacts = int(attributes["impacts_missed"]), int(attributes["impacts"])
    word = FALSE if missed else HOLDS
    value = f"{missed} of {impacts:,} impacts of Figure 7 missed by steps of 0.1 and bisection"
    remark = "our reading: the paper names neither step nor tolerance"
    return Verdict(word, value, remark, "./reproduce variant as_published")


@claim(
    20,
    "Figure 2",
    "FN",
    quote="corresponding to 8 initial conditions and approximately 45,000 points",
    data=["fig2/orbits"],
)
def figure_2(data, proved):
    return _portrait(data["fig2/orbits"], 8, 45_000, "fig2.png")


@claim(
    42,
    "Figure 8",
    "FNQ",
    quote="with dominantly regular behavior around the elliptic periodic points of the map",
    data=["fig8/orbits", "atlas/line"],
)
def figure_8(data, proved):
    drawn = _portrait(data["fig8/orbits"], 6, 35_000, "fig8.png")
    line = data["atlas/line"]
    ball = data["fig8/orbits"].attrs
    row = _row(line, float(ball["energy"]) / float(ball["g"]) ** 2)
    names = ("regular", "regular_low", "regular_high")
    share, low, high = (float(line[name].values[0, row]) for name in names)
    word = drawn.verdict if low > 0.5 else FALSE
    value = f"{drawn.value}; {share:.3f} of the section is regular"
    return Verdict(word, value, f"{low:.3f} to {high:.3f}", "paper_figures/fig8.png")


@claim(
    37,
    "(32)",
    "E",
    quote="These exponents are defined by",
    data=["derivations"],
)
def exponents_defined(data, proved):
    value = "1/i times the logarithm of the growth, as i grows"
    return derived(data["derivations"], "exponents", value=value, remark="a factor 1/i is missing")


@claim(
    38,
    "(33)",
    "E",
    quote="solving a system of nine linear algebraic equations resulting from differentiating (28)",
    data=["derivations"],
)
def jacobian(data, proved):
    value = "the analytic Jacobian used here"
    return derived(data["derivations"], "jacobian", value=value, remark="exact, of (28) corrected")


@claim(
    47,
    "(36)-(38)",
    "T",
    quote="is well-defined at impact",
    data=["derivations"],
)
def one_form(data, proved):
    value = "the same before the impact and after it"
    return derived(data["derivations"], "one_form", value=value)


@claim(
    48,
    "(39)-(42)",
    "T",
    quote="the symplectic property of the map on the two-dimensional energy manifold is "
    "established",
    data=["derivations"],
)
def symplectic(data, proved):
    found = derived(data["derivations"], "area", "determinants")
    word = PROVED if found.verdict == HOLDS else found.verdict
    value = "with varying flight times, by Poincare and Cartan at fixed energy"
    return Verdict(word, value, "where P is smooth", found.evidence)


@claim(
    53,
    "5",
    "Q",
    quote="a piecewise differentiable Lagrangian system",
    data=["jumps/jumps"],
)
def piecewise(data, proved):
    length = float(data["jumps/jumps"]["length"].values[0])
    value = "one curve of jumps, smooth on either side" if length > 0.0 else "no curve of jumps"
    word = HOLDS if length > 0.0 else CORRECTED
    error = f"from {data['jumps/jumps'].sizes['point'] - 1:,} grazing states"
    return Verdict(word, value, error, "more_figures/claims/jumps.png")


def _portrait(orbits, starts, points, name):
    """Whether a portrait has as many starts as said, and about as many points."""
    found, total = orbits.sizes["orbit"], int(orbits["row_size"].sum())
    good = found == starts and abs(total - points) < 0.05 * points
    value = f"{found} starts, {total:,} points"
    remark = "starts are ours: the paper prints none"
    return Verdict(HOLDS if good else FALSE, value, remark, f"paper_figures/{name}")


def _row(line, energy):
    """Index of a cell of the atlas's line at this E/g^2."""
    return int(np.argmin(np.abs(line["energy"].values - energy)))
