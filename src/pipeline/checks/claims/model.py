"""Claims of the paper's introduction and section 2: the model and the impact."""

import numpy as np

from pseudorigid.evidence.spread import stretches

from .ledger import (
    CORRECTED,
    DERIVED,
    FALSE,
    HOLDS,
    Verdict,
    claim,
    decided,
    derived,
    formula,
    number_of,
)

APPRECIABLE = 0.1  # of the energy
INFINITESIMAL = 0.1  # a strain larger than that is none


@claim(1, "2.1", "P", "derivations")
def single_mode(algebra):
    """“it is now assumed that Poisson's ratio is equal to zero. As a result, a single vibration
    mode is excited by impact, namely the one in the direction of the impact force”"""
    return derived(algebra, "uncoupled", value="the stretch along the force moves by itself")


@claim(59, "2.1", "P", "derivations")
def modes(algebra):
    """“Due to the nature of the loading, only three of the six modes of vibration are excited by
    impact. Of these, the two deviatoric modes have identical eigenvalues due to material and
    geometric symmetries”"""
    value = f"{number_of(algebra, 'modes'):g} modes: the volumetric one and one deviatoric one, "
    value += "at each Poisson's ratio above 0; three is the number of strains without shear. The "
    value += "eigenvalues are as stated"
    return derived(algebra, "modes", value=value)


@claim(2, "1", "P", "clusters/clusters", "spread/spread")
def strain_energy(sea, found):
    """“this energy may constitute an appreciable portion of the total energy and can significantly
    affect the dynamics of the system”"""
    strain, kinetic = (sea[f"{name}_energy"].values for name in ("strain", "kinetic"))
    share = strain / (strain + kinetic)
    error = float(share.std(ddof=1)) / np.sqrt(share.size)
    mean = float(share.mean())
    exponent = float(stretches(found, int(found.attrs["block_impacts"])).mean())
    value = f"of strain and kinetic energy together {mean:.4f} is strain energy, their means in "
    value += "time over the sea; a rigid ball repeats its flight, this one has exponent "
    value += f"{exponent:.2f}"
    large = mean - 3 * error > APPRECIABLE and exponent > 0.0
    return decided(large, value, f"{error:.0e}", "more_figures/claims/clusters.png")


@claim(3, "(4)-(5)", "E", "derivations")
def inertia(algebra):
    """“The extreme values k = 0 and k = 1 correspond, respectively, to the mass being concentrated
    at the center r = 0 and the exterior boundary r = R”"""
    value = f"k = 0 and k = 1/3: a shell has {number_of(algebra, 'shell'):.4f}"
    remark = "exact: (4) lacks a factor of a third"
    return derived(algebra, "euler_tensor", "shell", value=value, remark=remark)


@claim(67, "footnote 2", "E", "derivations")
def euler_tensor(algebra):
    """“for spherically symmetric bodies, the component matrix of the referential Euler tensor is
    diagonal with entries equal to E0”"""
    value = "diagonal, with entries a third of (4)"
    return derived(algebra, "euler_tensor", value=value)


@claim(4, "2.1", "P", "derivations", "fig2/orbits")
def homogeneous(algebra, orbits):
    """“The material is assumed homogeneous, isotropic, and linearly elastic”"""
    solid = number_of(algebra, "euler_tensor")
    used = abs(float(orbits.attrs["k"]) - solid) < 1e-12
    word = CORRECTED if used and formula(algebra, "euler_tensor")[1] else FALSE
    value = f"homogeneous is k = {solid:g}, as used; k is not free then"
    return Verdict(word, value, "exact", DERIVED)


@claim(5, "2.1", "P", "clusters/clusters")
def infinitesimal(sea):
    """“The infinitesimal strain due to the deformation of the ball relative to its reference
    configuration is denoted by u and is geometrically interpreted in Figure 1(b)”"""
    least, most = float(sea["least_strain"].min()), float(sea["largest_strain"].max())
    small = max(-least, most) < INFINITESIMAL
    value = f"the linear measure is used for strains from {least:.3f} to {most:.3f} at "
    value += f"E = {float(sea.attrs['energy']):g}"
    word = HOLDS if small else CORRECTED
    return Verdict(word, value, "extremes of a finite run", "more_figures/claims/clusters.png")


@claim(6, "(8), (22)", "T", "derivations")
def contact_speed(algebra):
    """“continuity of x and u in time necessitates that the pre-impact velocity of the material
    point of contact be positive”"""
    value = "it is not negative: at a grazing impact it is zero"
    return derived(algebra, "contact_speed", value=value)


@claim(7, "(9)", "E", "derivations")
def impulsive_forces(algebra):
    """F_x = -p (d phi_2/dx) = -p delta(t - t_i), F_u = -p (d phi_2/du) = -R p delta(t - t_i)"""
    value = "the middle members lack the delta that the last ones have"
    remark = "exact, by dimensions"
    return derived(algebra, "impulsive_forces", value=value, remark=remark)


@claim(8, "(11)-(14), (25)", "E", "derivations")
def jump_conditions(algebra):
    """the jump conditions from energy kept during impact"""
    value = "contact speed reversed, y = xdot - k udot kept"
    return derived(algebra, "impulse", "jump_conditions", value=value)


@claim(9, "(13)", "P", "derivations")
def impulse_without_stiffness(algebra):
    """“As already noted in [7], the multiplier pi is independent of Young's modulus”"""
    return derived(
        algebra, "impulse_without_stiffness", value="mass, k and velocities alone make it"
    )


@claim(10, "(10), (15)-(23)", "E", "derivations")
def scaling(algebra):
    """equations of motion, and their scaling to two numbers"""
    value = "k and g; what is free of the unit of length, k and E/g^2"
    return derived(algebra, "equations_of_motion", "scaling", value=value)


@claim(11, "(24)", "E", "derivations")
def scaled_impulse(algebra):
    """the scaled impulse is p/(m omega^2 R)"""
    return derived(algebra, "scaled_impulse", value="p/(m omega R)")


@claim(54, "4.1", "P", "derivations", "fig2/orbits")
def parameters(algebra, orbits):
    """“The phase space of the map is depicted in Figure 2 for E = 0.01, k = 0.2 and g = 0.04”"""
    ratio, solid = number_of(algebra, "softness"), number_of(algebra, "euler_tensor")
    energy, k, g = (float(orbits.attrs[name]) for name in ("energy", "k", "g"))
    value = f"E = {energy:g}, k = {k:g}, g = {g:g} here as well: by (16) and (20) a homogeneous "
    value += f"solid ball whose Young's modulus is {ratio:g} rho g R"
    value += ", 5 kPa for 10 cm of water's density" if abs(ratio - 5.0) < 1e-9 else ""
    same = (energy, g) == (0.01, 0.04) and abs(k - 0.2) < 1e-12 and abs(k - solid) < 1e-12
    good = same and formula(algebra, "softness")[0]
    return decided(good, value, "exact", f"paper_figures/fig2.png, {DERIVED}")


@claim(68, "2.2", "P", "derivations")
def redistributed(algebra):
    """“the impact events couple the response of x and u by redistributing kinetic energy between
    the rectilinear motion of the mass center and the free vibration of the sphere”"""
    value = "xdot^2/2 + k udot^2/2 is kept, and the contact speed, so each part, changes"
    return derived(algebra, "jump_conditions", value=value)


@claim(72, "(7)", "P")
def floor():
    """“ensures that the sphere does not penetrate the rigid foundation”"""
    value = "the stretched ball's lowest point is x + R (1 + u) below O, and the floor is R below O"
    return Verdict(HOLDS, value, "by hand, for u > -1", "eq. (7)")
