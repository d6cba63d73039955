"""Claims of the paper's introduction and section 2: the model and the impact."""

import numpy as np

from . import ledger
from .ledger import CORRECTED, FALSE, HOLDS, NOT_COMPUTED, Verdict, derived, formula, number_of

CLAIMS = []
claim = ledger.collector(CLAIMS)

APPRECIABLE = 0.1  # of the energy
INFINITESIMAL = 0.1  # a strain larger than that is none
STRAINED = ("fig2/orbits", "fig8/orbits")


@claim(
    1,
    "2.1",
    "P",
    quote="it is now assumed that Poisson's ratio is equal to zero. As a result, a single "
    "vibration mode is excited by impact",
    data=["derivations"],
)
def single_mode(data, proved):
    value = "the stretch along the force moves by itself"
    return derived(data["derivations"], "uncoupled", value=value)


@claim(
    2,
    "1",
    "P",
    quote="this energy may constitute an appreciable portion of the total energy",
    data=["clusters/clusters"],
)
def strain_energy(data, proved):
    sea = data["clusters/clusters"]
    energy = float(sea.attrs["energy"]) - float(sea.attrs["energy_at_rest"])
    share = sea["strain_energy"].values / energy
    error = float(share.std(ddof=1)) / np.sqrt(share.size)
    mean = float(share.mean())
    word = HOLDS if mean - 3 * error > APPRECIABLE else FALSE
    value = f"{mean:.4f} of the energy above rest, mean in time over the sea"
    return Verdict(word, value, f"{error:.0e}", "more_figures/claims/clusters.png")


@claim(
    3,
    "(4)-(5)",
    "E",
    words="the inertia is k m R^2 with 0 <= k <= 1; k = 1 has the mass on the surface",
    data=["derivations"],
)
def inertia(data, proved):
    value = f"0 < k <= {number_of(data['derivations'], 'shell'):.4f}"
    return derived(
        data["derivations"], "euler_tensor", "shell", value=value, remark="(4) lacks a third"
    )


@claim(
    4,
    "2.1",
    "P",
    quote="The material is assumed homogeneous, isotropic, and linearly elastic",
    data=["derivations", "fig2/orbits"],
)
def homogeneous(data, proved):
    solid = number_of(data["derivations"], "euler_tensor")
    used = float(data["fig2/orbits"].attrs["k"])
    mended = formula(data["derivations"], "euler_tensor")[1]
    word = CORRECTED if mended and abs(used - solid) < 1e-12 else FALSE
    value = f"homogeneous is k = {solid:g}, as used; k is not free then"
    return Verdict(word, value, "exact", "tests/proofs/test_derivations.py")


@claim(
    5,
    "2.1",
    "P",
    quote="The infinitesimal strain due to the deformation of the ball",
    data=["clusters/clusters"],
)
def infinitesimal(data, proved):
    sea = data["clusters/clusters"]
    least, most = float(sea["least_strain"].min()), float(sea["largest_strain"].max())
    word = HOLDS if max(-least, most) < INFINITESIMAL else FALSE
    value = f"strains from {least:.3f} to {most:.3f} at E = {float(sea.attrs['energy']):g}"
    return Verdict(word, value, "of a finite run", "more_figures/claims/clusters.png")


@claim(
    6,
    "(8), (22)",
    "T",
    quote="the pre-impact velocity of the material point of contact be positive",
    data=["derivations"],
)
def contact_speed(data, proved):
    value, remark = "xdot + udot >= 0", "a grazing impact has none"
    return derived(data["derivations"], "contact_speed", value=value, remark=remark)


@claim(7, "(9)", "E", words="the impulsive forces are -p and -R p", data=["derivations"])
def impulsive_forces(data, proved):
    value, remark = "p delta(t - t_i) in the place of p", "exact, by dimensions"
    return derived(data["derivations"], "impulsive_forces", value=value, remark=remark)


@claim(
    8,
    "(11)-(14), (25)",
    "E",
    words="the jump conditions from energy kept during impact",
    data=["derivations"],
)
def jump_conditions(data, proved):
    value = "contact speed reversed, y = xdot - k udot kept"
    return derived(data["derivations"], "impulse", "jump_conditions", value=value)


@claim(
    9,
    "(13)",
    "P",
    quote="is independent of Young's modulus",
    data=["derivations"],
)
def impulse_without_stiffness(data, proved):
    value = "mass, k and velocities alone make it"
    return derived(data["derivations"], "impulse_without_stiffness", value=value)


@claim(
    10,
    "(10), (15)-(23)",
    "E",
    words="equations of motion, and their scaling to two numbers",
    data=["derivations"],
)
def scaling(data, proved):
    value = "k and g; what is free of the unit of length, k and E/g^2"
    return derived(data["derivations"], "equations_of_motion", "scaling", value=value)


@claim(11, "(24)", "E", words="the scaled impulse is p/(m omega^2 R)", data=["derivations"])
def scaled_impulse(data, proved):
    return derived(data["derivations"], "scaled_impulse", value="p/(m omega R)")


@claim(
    54,
    "3, captions",
    "P",
    words="g = 0.04 is gravity for an elastic ball",
    data=["derivations"],
)
def softness(data, proved):
    ratio = number_of(data["derivations"], "softness")
    holds = formula(data["derivations"], "softness")[0]
    value = f"Young's modulus is {ratio:g} rho g R: 5 kPa for 10 cm of water's density"
    value = value if abs(ratio - 5.0) < 1e-9 else f"Young's modulus is {ratio:g} rho g R"
    return Verdict(HOLDS if holds else FALSE, value, "exact", "tests/proofs/test_derivations.py")


@claim(
    57,
    "2.2",
    "Q",
    quote="The resulting equations agree with those derived in [7]",
)
def agree_with_solberg(data, proved):
    return Verdict(f"{NOT_COMPUTED}: the source is not at hand", "", "", "")


@claim(58, "Figure 1", "F", words="a sketch of the ball, its position and its strain")
def sketch(data, proved):
    return Verdict(f"{NOT_COMPUTED}: a sketch, not a result", "", "", "")
