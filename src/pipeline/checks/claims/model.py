"""Checks of claims of the paper's introduction and section 2: the model and the impact."""

import numpy as np

from pseudorigid.analyses.spread import stretches

from .schema import CORRECTED, FALSE, HOLDS, formula, numbers_of, verdict_of

APPRECIABLE = 0.1  # of the energy
INFINITESIMAL = 0.1  # a strain larger than that is none


def strain_energy(sea, found):
    """Compare the mean share of strain energy over the sea with zero and its standard error."""
    strain, kinetic = (sea[f"{name}_energy"].values for name in ("strain", "kinetic"))
    share = strain / (strain + kinetic)
    error = float(share.std(ddof=1)) / np.sqrt(share.size)
    mean = float(share.mean())
    exponent = float(stretches(found, int(found.attrs["block_impacts"])).mean())
    large = mean - 3 * error > APPRECIABLE and exponent > 0.0
    return verdict_of(large, mean=mean, exponent=exponent, standard_error=error)


def homogeneous(algebra, orbits):
    """Compare the k of Figure 2 with that of a homogeneous ball."""
    solid = numbers_of(algebra)["euler_tensor"]
    used = abs(float(orbits.attrs["k"]) - solid) < 1e-12
    word = CORRECTED if used and formula(algebra, "euler_tensor")[1] else FALSE
    return word, {"solid": solid}


def infinitesimal(sea):
    """Compare the extreme strains of the sea with what is infinitesimal."""
    least, most = float(sea["least_strain"].min()), float(sea["largest_strain"].max())
    small = max(-least, most) < INFINITESIMAL
    numbers = {"least": least, "most": most, "energy": float(sea.attrs["energy"])}
    return HOLDS if small else CORRECTED, numbers


def parameters(algebra, orbits):
    """Compare the parameters of Figure 2 with the paper's, and relate them to a material."""
    numbers = numbers_of(algebra)
    ratio, solid = numbers["softness"], numbers["euler_tensor"]
    energy, k, g = (float(orbits.attrs[name]) for name in ("energy", "k", "g"))
    example = ", 5 kPa for 10 cm of water's density" if abs(ratio - 5.0) < 1e-9 else ""
    same = (energy, g) == (0.01, 0.04) and abs(k - 0.2) < 1e-12 and abs(k - solid) < 1e-12
    good = same and formula(algebra, "softness")[0]
    return verdict_of(good, energy=energy, k=k, g=g, ratio=ratio, example=example)
