"""Claims of the paper's introduction and section 2: the model and the impact."""

import numpy as np

from .ledger import CORRECTED, DERIVED, FALSE, Verdict, claim, decided, derived, formula, number_of

APPRECIABLE = 0.1  # of the energy
INFINITESIMAL = 0.1  # a strain larger than that is none


@claim(1, "2.1", "P", "derivations")
def single_mode(algebra):
    """“it is now assumed that Poisson's ratio is equal to zero. As a result, a single vibration
    mode is excited by impact”"""
    return derived(algebra, "uncoupled", value="the stretch along the force moves by itself")


@claim(2, "1", "P", "clusters/clusters")
def strain_energy(sea):
    """“this energy may constitute an appreciable portion of the total energy”"""
    energy = float(sea.attrs["energy"]) - float(sea.attrs["energy_at_rest"])
    share = sea["strain_energy"].values / energy
    error = float(share.std(ddof=1)) / np.sqrt(share.size)
    mean = float(share.mean())
    value = f"{mean:.4f} of the energy above rest, mean in time over the sea"
    large = mean - 3 * error > APPRECIABLE
    return decided(large, value, f"{error:.0e}", "more_figures/claims/clusters.png")


@claim(3, "(4)-(5)", "E", "derivations")
def inertia(algebra):
    """the inertia is k m R^2 with 0 <= k <= 1; k = 1 has the mass on the surface"""
    value = f"0 < k <= {number_of(algebra, 'shell'):.4f}"
    return derived(algebra, "euler_tensor", "shell", value=value, remark="(4) lacks a third")


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
    """“The infinitesimal strain due to the deformation of the ball”"""
    least, most = float(sea["least_strain"].min()), float(sea["largest_strain"].max())
    small = max(-least, most) < INFINITESIMAL
    value = f"strains from {least:.3f} to {most:.3f} at E = {float(sea.attrs['energy']):g}"
    return decided(small, value, "of a finite run", "more_figures/claims/clusters.png")


@claim(6, "(8), (22)", "T", "derivations")
def contact_speed(algebra):
    """“the pre-impact velocity of the material point of contact be positive”"""
    remark = "a grazing impact has none"
    return derived(algebra, "contact_speed", value="xdot + udot >= 0", remark=remark)


@claim(7, "(9)", "E", "derivations")
def impulsive_forces(algebra):
    """the impulsive forces are -p and -R p"""
    value, remark = "p delta(t - t_i) in the place of p", "exact, by dimensions"
    return derived(algebra, "impulsive_forces", value=value, remark=remark)


@claim(8, "(11)-(14), (25)", "E", "derivations")
def jump_conditions(algebra):
    """the jump conditions from energy kept during impact"""
    value = "contact speed reversed, y = xdot - k udot kept"
    return derived(algebra, "impulse", "jump_conditions", value=value)


@claim(9, "(13)", "P", "derivations")
def impulse_without_stiffness(algebra):
    """“is independent of Young's modulus”"""
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


@claim(54, "3, captions", "P", "derivations")
def softness(algebra):
    """g = 0.04 is gravity for an elastic ball"""
    ratio = number_of(algebra, "softness")
    value = f"Young's modulus is {ratio:g} rho g R"
    value += ": 5 kPa for 10 cm of water's density" if abs(ratio - 5.0) < 1e-9 else ""
    return decided(formula(algebra, "softness")[0], value, "exact", DERIVED)
