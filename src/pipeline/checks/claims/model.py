"""Checks of claims of the paper's introduction and section 2: the model and the impact."""

import numpy as np
import xarray as xr

from pseudorigid.analyses.spread import stretches
from pseudorigid.dynamics.paper import BALL, FIGURES

from .schema import CORRECTED, FALSE, HOLDS, Outcome, formula, numbers_of, outcome_of

APPRECIABLE = 0.1  # share of the energy
INFINITESIMAL = 0.1  # largest strain that counts as infinitesimal
ROUNDING = 1e-12  # of k and g, which are computed from decimals
DENSITY_RATIO = 5.0  # Young's modulus over rho g R, for which claims.toml gives an example


def strain_energy(clusters: xr.Dataset, spread: xr.Dataset) -> Outcome:
    """Compare the mean share of strain energy over the sea with zero and its standard error."""
    strain, kinetic = (clusters[f"{name}_energy"].values for name in ("strain", "kinetic"))
    share = strain / (strain + kinetic)
    mean, error = share.mean(), share.std(ddof=1) / np.sqrt(share.size)
    exponent = stretches(spread, int(spread.attrs["block_impacts"])).mean()
    large = mean - 3 * error > APPRECIABLE and exponent > 0.0
    return outcome_of(large, mean=mean, exponent=exponent, standard_error=error)


def homogeneous(algebra: xr.Dataset, orbits: xr.Dataset) -> Outcome:
    """Compare the k of Figure 2 with that of a homogeneous ball."""
    solid = numbers_of(algebra)["euler_tensor"]
    used = abs(orbits.attrs["k"] - solid) < ROUNDING
    word = CORRECTED if used and formula(algebra, "euler_tensor")[1] else FALSE
    return Outcome(word, {"solid": solid})


def infinitesimal(clusters: xr.Dataset) -> Outcome:
    """Compare the extreme strains of the sea with what is infinitesimal."""
    least, most = clusters["least_strain"].values.min(), clusters["largest_strain"].values.max()
    word = HOLDS if max(-least, most) < INFINITESIMAL else CORRECTED
    return Outcome(word, {"least": least, "most": most, "energy": clusters.attrs["energy"]})


def parameters(algebra: xr.Dataset, orbits: xr.Dataset) -> Outcome:
    """Compare the parameters of Figure 2 with the paper's, and relate them to a material."""
    numbers = numbers_of(algebra)
    ratio, solid = numbers["softness"], numbers["euler_tensor"]
    energy, k, g = (float(orbits.attrs[name]) for name in ("energy", "k", "g"))
    same = (energy, g) == (FIGURES["fig2"]["energy"], BALL["g"])
    same = same and abs(k - BALL["k"]) < ROUNDING and abs(k - solid) < ROUNDING
    holds = same and formula(algebra, "softness")[0]
    example = abs(ratio - DENSITY_RATIO) < 1e-9
    return outcome_of(holds, energy=energy, k=k, g=g, ratio=ratio, example=bool(example))
