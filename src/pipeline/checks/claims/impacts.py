"""Claims of the paper's section 3 and how it computes: flight, map, energy, bounds, figures."""

import json

import numpy as np

from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.ensemble import ImpactMap

from .ledger import DERIVED, HOLDS, claim, decided, derived, formula, number_of

ROUNDING = 1e-13  # of an energy, over an orbit
SHOWN = (1e-3, 1e-5, 1e-7)  # distances from the jump curve


@claim(12, "2.1, (26)-(27)", "E", "derivations")
def flights(algebra):
    """“Between any two consecutive impacts, the motion of the center of mass is that of a point
    mass in a constant gravitational field, while the body undergoes free vibration relative to its
    undeformed spherical configuration”"""
    return derived(algebra, "flights", value="free fall, and a strain of frequency 1")


@claim(13, "(28)", "E", "derivations")
def impact_map(algebra):
    """the map from one impact to the next"""
    value = "the sign before 2k/(1+k) udot inside the square of the first line is minus"
    remark = "exact; of many solutions the smallest flight time is meant"
    return derived(algebra, "impact_map", value=value, remark=remark)


@claim(14, "3", "T", "derivations", "jumps/jumps", theorems=["jump-set", "diffeomorphism"])
def diffeomorphism(algebra, jumps, proved):
    """“The map (28) is smooth and invertible with a smooth inverse, hence is a diffeomorphism”"""
    length, error = float(jumps["length"].values[0]), float(jumps["length_error"].values[0])
    threshold = number_of(algebra, "smooth")
    energy = float(jumps["energy"].values[0])
    if length > 0.0 and formula(algebra, "smooth")[1]:
        said = "proved" if proved("jump-set", "diffeomorphism") else "computed"
        value = f"it jumps ({said}) on a curve, of computed length {length:.12f} at E = {energy:g}"
        value += f"{_second_length(jumps)}; {_steepness(jumps)}; a diffeomorphism ({said}) below "
        value += f"E = g^2 (1 + k/2) = {threshold:g}"
        evidence = "more_figures/claims/jumps.png, results/claims/jumps_jumps.nc"
        return decided(False, value, f"{error:.0e} in the length", evidence)
    return decided(True, f"no jump at E = {energy:g}", "", "more_figures/claims/jumps.png")


def _steepness(jumps):
    """How the largest derivative grows towards the jump curve, as text."""
    h = jumps["distance"].values
    touched, missed = (jumps[f"derivative_{side}"].values for side in ("touched", "missed"))
    rows = [int(np.argmin(np.abs(h - at))) for at in SHOWN]
    power = np.log(touched[rows[-1]] / touched[rows[-2]]) / np.log(h[rows[-1]] / h[rows[-2]])
    values = ", ".join(f"{touched[row]:.3g}" for row in rows)
    value = "beside its middle, where the flight just meets the floor, the largest derivative is "
    value += f"{values} at distances h = {', '.join(f'{h[row]:g}' for row in rows)}, like "
    value += f"h^{power:.3f}; where it just misses the floor, {missed[rows[-1]]:.3g}"
    return value


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
    """“Since the total system energy is conserved throughout the motion, any trajectory of the
    impact map must lie on the two-dimensional ellipsoidal energy surface”"""
    error = float(sea["energy_error"].max())
    kept = formula(algebra, "conserved_energy", "jump_conditions")[0] and error < ROUNDING
    value = "so by algebra; our orbits keep their energy to rounding"
    bound = f"below {ROUNDING:.0e}" if error < ROUNDING else f"{error:.1e}"
    evidence = f"{DERIVED}, tests/kernel/test_impact.py"
    return decided(kept, value, bound, evidence, proved=True)


@claim(16, "3", "T", "fig2/orbits", "fig8/orbits")
def half_of_it(*portraits):
    """“In fact, the trajectories are restricted to only the semi-ellipsoid defined by the
    pre-impact condition (22)”"""
    speeds = [d["xdot"].values + d["udot"].values for d in portraits]
    least = min(float(s.min()) for s in speeds)
    count = sum(s.size for s in speeds)
    value = f"least contact speed of {count:,} impacts: {least:.1e}"
    return decided(least >= 0.0, value, "none below 0", "tests/kernel/test_impact.py")


@claim(17, "(30)-(31)", "T", "derivations")
def energy_bound(algebra):
    """“Thus, the restriction (30) can be equivalently stated as”"""
    value = f"E < k/2 - g = {number_of(algebra, 'bound'):g} is enough for x < 1; but (30) does not "
    value += "follow from x < 1: it holds for 2g/k - 1 < x < 1 only"
    remark = "exact; needs g < k, which the paper's ball fulfils"
    return derived(algebra, "bound", value=value, remark=remark)


@claim(18, "2.2, (6)", "T", "derivations", "clusters/clusters")
def never_inside_out(algebra, sea):
    """“This constraint will be enforced at the outset by the appropriate choice of initial
    conditions”"""
    least = float(sea["least_strain"].min())
    bounded = formula(algebra, "bound_in_flight")[0] and least > -1.0
    value = f"E < k/2 - g is enough, in flight as well; least strain of the sea {least:.3f}"
    return decided(bounded, value, "exact bound", DERIVED, proved=True)


@claim(19, "4.1", "Q", "as_published/fig7/lyapunov")
def bisection(lyapunov):
    """“This guarantees that (22) is satisfied at impact, therefore the inequality constraint (21)
    is enforced throughout the motion of the sphere”"""
    missed, impacts = (int(lyapunov.attrs[name]) for name in ("impacts_missed", "impacts"))
    method = json.loads(lyapunov.attrs["config"])["method"]
    least = _least_contact_speed(lyapunov, method, impacts)
    value = f"(22) holds, the contact speed is at least {least:.1e}; (21) does not: {missed} of "
    value += f"{impacts:,} impacts of Figure 7 are missed by steps of {method['scan']:g} and "
    value += "bisection, and the ball dips below the floor between two steps"
    remark = "our reading: the paper names neither step nor tolerance"
    holds = missed == 0 and least >= 0.0
    return decided(holds, value, remark, "./reproduce variant as_published")


def _least_contact_speed(lyapunov, method, impacts):
    """The least contact speed of the orbits of a dataset of exponents, with a method's impacts."""
    k, g, energy = (float(lyapunov.attrs[name]) for name in ("k", "g", "energy"))
    ball = Ball(k, g, map=ImpactMap((method["scan"], method["tolerance"])))
    starts = lyapunov["start"].values
    out = np.empty((starts.size, impacts // starts.size, 4))
    ball.map.history(*ball.start(starts, energy), k, g, out)
    return float((out[..., 1] + out[..., 2]).min())


@claim(20, "Figure 2", "FN", "fig2/orbits")
def figure_2(orbits):
    """“Regular and chaotic trajectories of the map for E = 0.01, k = 0.2, and g = 0.04
    corresponding to 8 initial conditions and approximately 45,000 points”"""
    return _portrait(orbits, 8, 45_000, "fig2.png")


@claim(42, "Figure 8", "FNQ", "fig8/orbits", "atlas/line")
def figure_8(orbits, line):
    """“Figure 8 depicts several trajectories for E = 0.001, k = 0.2 and g = 0.04 with dominantly
    regular behavior around the elliptic periodic points of the map”"""
    drawn = _portrait(orbits, 6, 35_000, "fig8.png")
    energy, g = (float(orbits.attrs[name]) for name in ("energy", "g"))
    row = int(np.argmin(np.abs(line["energy"].values - energy / g**2)))
    share, low, high = (
        float(line[f"regular{end}"].values[0, row]) for end in ("", "_low", "_high")
    )
    holds = drawn.verdict == HOLDS and low > 0.5
    value = f"{drawn.value}; {share:.4f} of the section is regular"
    return decided(holds, value, f"{low:.4f} to {high:.4f}", drawn.evidence)


@claim(37, "(32)", "E", "derivations")
def exponents_defined(algebra):
    """“These exponents are defined by”"""
    value = "a factor 1/i is missing; and with it, of almost every v_j the limit is the largest "
    value += "exponent, for each j: the others need the orthogonal frame of [18]"
    remark = "exact; the second by Oseledets' theorem"
    return derived(algebra, "exponents", value=value, remark=remark)


@claim(38, "(33)", "E", "derivations")
def jacobian(algebra):
    """“The components of Ji are readily obtained by solving a system of nine linear algebraic
    equations resulting from differentiating (28)”"""
    value = "the analytic Jacobian used here, of (28) corrected"
    remark = "1e-25 at three flights"
    return derived(algebra, "jacobian", value=value, remark=remark, proved=False)


@claim(71, "4.2", "T", "derivations")
def flow(algebra):
    """“It is well-known that the flow in phase space resulting from Lagrange's equations (23) away
    from impact is symplectic”"""
    return derived(algebra, "flow", value="dx ^ dxdot + k du ^ dudot is kept")


@claim(47, "(36)-(38)", "T", "derivations")
def one_form(algebra):
    """the one-form (38) is well-defined at impact, as (25) shows"""
    return derived(algebra, "one_form", value="the same before the impact and after it")


@claim(48, "abstract, (39)-(42), 5", "T", "derivations")
def symplectic(algebra):
    """“the symplectic property of the map on the two-dimensional energy manifold is
    established”"""
    value = "also with flight times that vary, by Poincare and Cartan at fixed energy"
    remark = "exact, where the map is smooth (row 14)"
    return derived(algebra, "area", value=value, remark=remark)


@claim(53, "5", "Q", "derivations")
def piecewise(algebra):
    """“The elastic impact of an pseudo-rigid sphere onto a rigid foundation gives rise to a
    piecewise differentiable Lagrangian system”"""
    value = "between impacts the motion (26) is analytic in time, at each the velocities jump by "
    value += "(25); of the impact map, which jumps as well, row 14"
    return derived(algebra, "flights", "jump_conditions", value=value)


@claim(64, "1", "Q", "derivations")
def not_strictly_hamiltonian(algebra):
    """“the system is not strictly Hamiltonian, owing to the non-smoothness of the response at
    impact”"""
    value = "the contact speed changes its sign at an impact, and the flow of a smooth Hamiltonian "
    value += "has no jumps; between impacts it is Hamiltonian"
    return derived(algebra, "jump_conditions", "flow", value=value)


@claim(61, "4.1", "Q", "derivations", "spread/spread")
def third_exponent(algebra, found):
    """“Vanishing of the third exponent is due to the use of a three-dimensional form in describing
    a system that lives on a two-dimensional energy manifold”"""
    middle = float(np.abs(found["exponent"].values[:, :, 1].mean(axis=0)).max())
    impacts = int(found.attrs["block_impacts"]) * found.sizes["block"]
    kept = formula(algebra, "conserved_energy", "jump_conditions")[0]
    value = "the third direction leads from one energy to another; the map keeps each energy, so a "
    value += "tangent vector's part across neither grows nor shrinks on average: |l2| up to "
    value += f"{middle:.0e} after {impacts:,} impacts"
    return decided(kept and middle < 100.0 / impacts, value, "falls like 1/n", DERIVED)


def _portrait(orbits, starts, points, name):
    """Whether a portrait has as many starts as said, and about as many points."""
    found, total = orbits.sizes["orbit"], int(orbits["row_size"].sum())
    as_said = found == starts and abs(total - points) < 0.05 * points
    value, remark = f"{found} starts, {total:,} points", "starts are ours: the paper prints none"
    return decided(as_said, value, remark, f"paper_figures/{name}")
